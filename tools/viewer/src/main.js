// The page of seacrane.view: puts the parts together and runs the clock.
import {
  AmbientLight, Box3, Color, DirectionalLight, GridHelper, HemisphereLight, PerspectiveCamera, Quaternion, Scene, Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Arrow, GROUPS, newtons, roundScale } from './arrows.js';
import { bodyGroup } from './bodies.js';
import { bookmarks } from './camera.js';
import { Labels } from './labels.js';
import { Clearance, PointMark } from './marks.js';
import { Motion } from './motion.js';
import { savePicture, startFilm } from './save.js';
import { Sea } from './sea.js';
import { Strip } from './strip.js';
import { Series, floats, gunzip } from './unpack.js';
import { Wheel } from './wheels.js';
import { Track, Wire } from './wires.js';

const SKY = 0xdfeaf2;
const SHOWN_FORCES = { none: [], main: ['link', 'wave'], all: ['link', 'wave', 'joint'] };
const SHOWN_NAMES = { none: -1, main: 1, all: 3 };
const $ = (id) => document.getElementById(id);

class Page {
  constructor(data, buffer) {
    Object.assign(this, { data, buffer, time: 0, playing: false, dirty: true, view: 'overview' });
    this.motion = new Motion(buffer, data.motion);
    this.start = this.motion.start;
    this.end = Math.max(this.motion.end, this.start + data.least);
    this.scene = new Scene();
    this.makeRenderer();
    this.makeBodies();
    this.makeSea();
    this.makeLines();
    this.makeArrows();
    this.makeMarks();
    this.makeLabels();
    this.makeCamera();
    this.strip = new Strip($('strip'), data.strip, data.stages, buffer, this.motion, (t) => this.seek(t));
    this.makeControls();
    addEventListener('resize', () => this.size());
    this.strip.size();
    $('caption').open = $('stage').clientHeight > 420 && $('stage').clientWidth > 700;
    $('caption').addEventListener('toggle', () => this.shift());
    addEventListener('hashchange', () => this.readAddress());
    this.size();
    this.readAddress();
    this.render();
  }

  makeRenderer() {
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    const gl = this.renderer.getContext();
    const about = gl.getExtension('WEBGL_debug_renderer_info');
    const name = about ? gl.getParameter(about.UNMASKED_RENDERER_WEBGL) : '';
    this.software = /swiftshader|llvmpipe|software|basic render/i.test(name);
    this.renderer.setPixelRatio(this.software ? 1 : Math.min(2, window.devicePixelRatio || 1));
    $('stage').prepend(this.renderer.domElement);
    this.renderer.domElement.setAttribute('role', 'img');
    this.renderer.domElement.setAttribute('aria-label', $('caption').textContent.replace(/\s+/g, ' ').trim());
    this.scene.background = new Color(SKY);
    const sun = new DirectionalLight(0xffffff, 1.9);
    sun.position.set(0.35, -0.45, 0.75);
    const fill = new DirectionalLight(0xffffff, 0.8);
    fill.position.set(0.4, 0.9, 0.3);
    this.scene.add(new HemisphereLight(0xffffff, 0x6a7f8c, 1.2), new AmbientLight(0xffffff, 0.35), sun, fill);
  }

  makeBodies() {
    this.bodies = this.data.bodies.map((body) => bodyGroup(body, this.buffer));
    this.wheels = this.data.wheels.map((wheel) => new Wheel(wheel, this.buffer));
    this.scene.add(...this.bodies, ...this.wheels.map(({ group }) => group));
    this.boxes = this.bodies.map((group) => new Box3().setFromObject(group));
    this.move(this.start);
    const all = new Box3();
    for (const u of [0, 0.5, 1]) {
      this.move(this.start + u * (this.motion.end - this.start));
      this.bodies.forEach((group) => all.expandByObject(group));
      this.wheels.forEach(({ group }) => all.expandByObject(group));
    }
    this.all = all;
    this.centre = all.getCenter(new Vector3());
    this.radius = 0.5 * all.getSize(new Vector3()).length() || 1;
    this.thin = 0.0018 * this.radius;
  }

  makeSea() {
    if (!this.data.sea) {
      const size = 10 ** Math.ceil(Math.log10(4 * this.radius));
      const grid = new GridHelper(size, 40, 0x8a97a3, 0xc3cdd4);
      grid.rotateX(Math.PI / 2);
      this.scene.add(grid);
      this.grid = size / 40;
      return;
    }
    this.grid = 10;
    const components = floats(this.buffer, this.data.sea);
    const options = { software: this.software, radius: 9 * this.radius, centre: this.centre, sky: SKY, grid: this.grid };
    this.sea = new Sea(components, options);
    this.scene.add(this.sea.mesh);
  }

  makeLines() {
    const forces = Object.entries(this.data.forces).map(([name, series]) => [name, new Series(this.buffer, series)]);
    this.forces = new Map(forces);
    this.wires = this.data.wires.map((wire) => new Wire(wire, 1.1 * this.thin));
    this.wires.forEach((wire) => this.scene.add(wire.mesh));
    this.tracks = this.motion.frames < 2 ? [] : this.data.tracks.map(
      (track) => new Track(track, this.motion, { recent: 30, whole: 600, colour: track.colour }),
    );
    this.tracks.forEach((track) => this.scene.add(...track.group));
  }

  makeArrows() {
    this.scales = {};
    for (const { group, largest } of this.data.arrows) this.scales[group] = roundScale(largest, 0.3 * this.radius);
    this.arrows = this.data.arrows.map(
      (arrow) => new Arrow(arrow, this.buffer, this.scales[arrow.group].perNewton, 2.2 * this.thin),
    );
    this.arrows.forEach((arrow) => this.scene.add(arrow.group));
  }

  makeMarks() {
    const points = this.data.points.map((point) => new PointMark(point, 2.2 * this.thin));
    this.gaps = this.data.clearances.map((one) => new Clearance(one));
    this.marks = [...points, ...this.gaps];
    this.marks.forEach(({ object }) => this.scene.add(object));
    this.points = points;
  }

  makeLabels() {
    this.labels = new Labels($('labels'));
    const few = this.data.bodies.length <= 6;
    this.data.bodies.forEach((body, i) => {
      const rank = { vessel: 0, payload: 0 }[body.role] ?? (few ? 1 : 2);
      const box = this.boxes[i];
      const top = body.role === 'vessel' ? new Vector3(0, 0, box.max.z + 0.07 * this.radius) : box.getCenter(new Vector3());
      this.labels.add(body.name, rank, () => top.clone().applyMatrix4(this.bodies[i].matrixWorld), body.role);
    });
    this.data.tracks.filter((track) => track.kind === 'tip').forEach((track) => {
      this.labels.add(track.name, 1, () => this.motion.point(track.at, this.time), 'tip');
    });
    this.wires.forEach((wire) => {
      const element = this.labels.add(wire.name, 2, () => (wire.mesh.visible ? wire.middle : null), 'wire');
      wire.label = { element, entry: this.labels.labels.find((one) => one.element === element) };
    });
    const tips = this.data.tracks.map(({ at }) => `${at}`);
    this.points.filter(({ at }) => !tips.includes(`${at}`)).forEach((point) => {
      this.labels.add(point.name, 2, () => (point.object.visible ? point.object.position.clone() : null), 'point');
    });
    this.gaps.forEach((gap) => {
      gap.label = this.labels.add('', 0.7, () => (gap.object.visible ? gap.middle : null), 'gap');
    });
    this.arrows.forEach((arrow) => {
      arrow.label = this.labels.add('', 0.5, () => {
        if (!arrow.group.visible || arrow.small) return null;
        const up = new Vector3(0, 1, 0).applyQuaternion(arrow.group.quaternion);
        return arrow.group.position.clone().addScaledVector(up, arrow.value(this.motion, this.time).length() * arrow.scale);
      }, arrow.kind);
    });
  }

  makeCamera() {
    this.camera = new PerspectiveCamera(38, 1, 0.01 * this.radius, 25 * this.radius);
    this.camera.up.set(0, 0, 1);
    this.control = new OrbitControls(this.camera, this.renderer.domElement);
    this.control.addEventListener('change', () => { this.dirty = true; });
    this.control.addEventListener('start', () => { this.view = ''; });
    const vessel = this.data.bodies.findIndex((body) => body.role === 'vessel');
    const payloads = this.data.bodies.map((body, i) => ({ ...body, i })).filter((body) => body.role === 'payload');
    this.move(this.start);
    const ahead = vessel < 0 ? new Vector3(1, 0, 0) : new Vector3(1, 0, 0).applyQuaternion(this.bodies[vessel].quaternion);
    this.move(this.motion.end);
    const at = payloads.length ? this.bodies[payloads[0].i].position : this.centre.clone().add(new Vector3(0, 1, 0));
    const port = new Vector3(-ahead.y, ahead.x, 0);
    const side = port.dot(at.clone().sub(this.centre)) >= 0 ? 1 : -1;
    const close = payloads.slice(0, 2).map((body) => ({
      name: body.name,
      size: Math.max(4 * this.boxes[body.i].getSize(new Vector3()).length(), 0.45 * this.radius),
      place: () => this.bodies[body.i].position.clone(),
    }));
    const heading = Math.atan2(ahead.y, ahead.x);
    this.bookmarks = bookmarks({ box: this.all, heading, side, close, opening: () => this.opening() });
    this.move(this.start);
  }

  // Half tangents of what is seen beside the caption.
  opening() {
    const up = Math.tan((0.5 * this.camera.fov * Math.PI) / 180);
    const { clientWidth: width, clientHeight: height } = $('stage');
    return { up, across: (up * (width - this.covered)) / height };
  }

  look(name) {
    if (!this.bookmarks[name]) return;
    this.view = name;
    const { target, position, follows } = this.bookmarks[name]();
    this.follows = follows;
    this.camera.position.copy(position);
    this.control.target.copy(target);
    this.control.update();
    this.dirty = true;
  }

  makeControls() {
    const names = Object.keys(this.bookmarks);
    for (const name of names) $('view').append(new Option(name, name));
    $('view').onchange = () => { this.look($('view').value); this.writeAddress(); };
    $('play').onclick = () => this.play(!this.playing);
    $('picture').onclick = () => savePicture(this.renderer.domElement, document.title);
    $('film').onclick = () => this.film();
    Object.assign($('time'), { min: this.start, max: this.end, step: 'any' });
    $('time').oninput = () => this.seek(+$('time').value);
    for (const id of ['forces', 'names', 'tracks', 'marks', 'real', 'water']) $(id).onchange = () => { this.dirty = true; };
    const keys = {
      ' ': () => this.play(!this.playing),
      ArrowRight: (event) => this.seek(this.time + (event.shiftKey ? 5 : 0.2)),
      ArrowLeft: (event) => this.seek(this.time - (event.shiftKey ? 5 : 0.2)),
      Home: () => this.seek(this.start),
      End: () => this.seek(this.end),
      '+': () => this.faster(1),
      '-': () => this.faster(-1),
      f: () => this.next('forces'),
      n: () => this.next('names'),
      t: () => $('tracks').click(),
      c: () => $('marks').click(),
      s: () => $('real').click(),
      p: () => $('picture').click(),
      r: () => $('film').click(),
    };
    names.slice(0, 9).forEach((name, i) => { keys[i + 1] = () => { this.look(name); this.writeAddress(); }; });
    addEventListener('keydown', (event) => {
      const own = event.target.matches('select, summary') || (event.target.matches('button') && event.key === ' ');
      if (own || event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
      event.preventDefault();
      keys[event.key](event);
    });
  }

  next(id) {
    const box = $(id);
    box.selectedIndex = (box.selectedIndex + 1) % box.options.length;
    this.dirty = true;
  }

  faster(by) {
    const box = $('speed');
    box.selectedIndex = Math.min(box.options.length - 1, Math.max(0, box.selectedIndex + by));
  }

  play(on) {
    this.playing = on;
    if (on && this.time >= this.end) this.time = this.start;
    $('play').textContent = on ? 'pause' : 'play';
    this.last = performance.now();
    if (!on) this.writeAddress();
    this.dirty = true;
  }

  // From now on, as it is played, until it is asked for again.
  film() {
    if (this.endFilm) this.endFilm();
    this.endFilm = this.endFilm ? null : startFilm(this.renderer.domElement, document.title);
    $('film').textContent = this.endFilm ? 'end film' : 'film';
    if (this.endFilm) this.play(true);
  }

  seek(t) {
    this.time = Math.min(this.end, Math.max(this.start, t));
    this.dirty = true;
    if (!this.playing) this.writeAddress();
  }

  readAddress() {
    const parts = new URLSearchParams(location.hash.slice(1));
    const t = Number.parseFloat(parts.get('t'));
    if (parts.get('view')) this.look(parts.get('view'));
    if (Number.isFinite(t)) { this.playing = false; this.time = Math.min(this.end, Math.max(this.start, t)); }
    else if (!this.read) this.time = this.start;
    this.read = true;
    this.dirty = true;
  }

  writeAddress() {
    const view = this.view && this.view !== 'overview' ? `&view=${encodeURIComponent(this.view)}` : '';
    try {
      history.replaceState(null, '', `#t=${+this.time.toFixed(2)}${view}`);
    } catch { /* a page inside a page has no address of its own */ }
  }

  move(t) {
    this.bodies.forEach((group, i) => {
      this.motion.pose(i, t, group.position, group.quaternion);
      group.updateMatrixWorld(true);
    });
    this.wheels.forEach((wheel) => wheel.show(this.motion, t));
  }

  size() {
    this.strip.size();
    const { clientWidth: width, clientHeight: height } = $('stage');
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.fov = width < height ? 60 : 38;
    this.shift();
    this.dirty = true;
  }

  // The middle of the picture is the middle of what the caption leaves free.
  shift() {
    const { clientWidth: width, clientHeight: height } = $('stage');
    this.covered = $('caption').open && width > 700 ? $('caption').offsetWidth : 0;
    this.camera.setViewOffset(width, height, -0.5 * this.covered, 0, width, height);
    if (this.view && this.bookmarks) this.look(this.view);
    this.dirty = true;
  }

  render() {
    const t = this.time;
    this.move(t);
    if (this.follows && this.view) {
      const step = this.follows().sub(this.control.target);
      this.control.target.add(step);
      this.camera.position.add(step);
      this.control.update();
    }
    this.camera.updateMatrixWorld();
    this.showLines(t);
    if (this.sea) {
      this.sea.mesh.visible = $('water').checked;
      this.sea.show(t, this.camera.position);
    }
    this.renderer.render(this.scene, this.camera);
    this.labels.show(this.camera, $('stage').clientWidth, $('stage').clientHeight, SHOWN_NAMES[$('names').value]);
    this.strip.show(t);
    this.drawAxes();
    $('time').value = t;
    const stage = this.data.stages.findLast(([, start]) => start <= t);
    $('now').textContent = stage ? `${stage[0]}, ${t.toFixed(2)} s` : `${t.toFixed(2)} s`;
    $('view').value = this.view;
    $('time').setAttribute('aria-valuetext', `${t.toFixed(1)} seconds`);
    this.dirty = false;
  }

  showLines(t) {
    for (const wire of this.wires) {
      wire.show(this.motion, t, $('real').checked);
      const force = this.forces.get(wire.element);
      const pull = force ? ` ${newtons(Math.max(0, force.linear(0, this.motion.place(t))))}` : '';
      wire.label.element.textContent = wire.slack ? `${wire.name} (slack)` : `${wire.name}${pull}`;
      wire.label.entry.rank = wire.slack ? 0.6 : 2;
    }
    for (const track of this.tracks) {
      track.group.forEach((line) => { line.visible = $('tracks').checked; });
      track.show(t);
    }
    for (const mark of this.marks) {
      mark.object.visible = $('marks').checked;
      mark.show(this.motion, t);
    }
    for (const gap of this.gaps) gap.label.textContent = gap.text;
    const shown = SHOWN_FORCES[$('forces').value];
    for (const arrow of this.arrows) {
      arrow.group.visible = shown.includes(arrow.kind);
      arrow.show(this.motion, t);
      const several = arrow.kind === 'joint' ? `${arrow.name} ` : '';
      arrow.label.textContent = `${several}${newtons(arrow.value(this.motion, t).length())}`;
    }
    this.writeLegend(shown);
  }

  writeLegend(shown) {
    const text = JSON.stringify([shown, this.sea ? this.sea.drawn.length : 0]);
    if (text === this.legend) return;
    this.legend = text;
    const row = (colour, words) => {
      const line = document.createElement('div');
      const mark = document.createElement('i');
      mark.style.background = colour;
      line.append(mark, words);
      return line;
    };
    const rows = shown.filter((group) => this.scales[group]).map(
      (group) => row(GROUPS[group].colour, `${GROUPS[group].text}: ${+this.scales[group].metres.toPrecision(3)} m = ${newtons(this.scales[group].newtons)}`),
    );
    if (this.sea) {
      const { drawn, all } = this.sea;
      const some = drawn.length < all.length ? `, the ${drawn.length} largest of ${all.length} waves` : '';
      rows.push(row('#3d8299', `grid on the water: ${this.grid} m${some}`));
    } else rows.push(row('#8a97a3', `grid at z = 0: ${+this.grid.toPrecision(3)} m`));
    $('legend').replaceChildren(...rows);
  }

  // The directions of the inertial axes as the camera sees them.
  drawAxes() {
    const pen = $('axes').getContext('2d');
    const [half, long] = [55, 36];
    pen.clearRect(0, 0, 2 * half, 2 * half);
    pen.font = 'bold 12px sans-serif';
    const turn = new Quaternion().copy(this.camera.quaternion).invert();
    const axes = [['x', '#b3261e', 1, 0, 0], ['y', '#1b7a3a', 0, 1, 0], ['z', '#1f4fa3', 0, 0, 1]];
    for (const [name, colour, ...along] of axes) {
      const { x, y } = new Vector3(...along).applyQuaternion(turn);
      pen.strokeStyle = colour;
      pen.fillStyle = colour;
      pen.lineWidth = 2.5;
      pen.beginPath();
      pen.moveTo(half, half);
      pen.lineTo(half + long * x, half - long * y);
      pen.stroke();
      pen.fillText(name, half + (long + 9) * x - 4, half - (long + 9) * y + 4);
    }
  }

  loop(now) {
    if (this.playing) {
      this.time += (Math.min(now - this.last, 500) / 1000) * +$('speed').value;
      if (this.time >= this.end) this.time = this.start;
    }
    this.last = now;
    if (this.playing || this.dirty) this.render();
    requestAnimationFrame((next) => this.loop(next));
  }

  // What tests and scripts may ask.
  face() {
    return {
      seek: (t) => { this.seek(t); this.render(); },
      look: (name) => { this.look(name); this.render(); },
      pose: (body, t) => {
        const { position: p, quaternion: q } = this.motion.pose(this.data.bodies.findIndex(({ name }) => name === body), t);
        return [...p.toArray(), q.w, q.x, q.y, q.z];
      },
      wheel: (name, t) => {
        const { position: p, quaternion: q } = this.wheels.find((wheel) => wheel.name === name).pose(this.motion, t);
        return [...p.toArray(), q.w, q.x, q.y, q.z];
      },
      elevation: (x, y, t) => this.sea.elevation(x, y, t),
      absent: () => this.wires.filter((wire) => !wire.mesh.visible).map((wire) => wire.name),
      slack: () => this.wires.filter((wire) => wire.slack).map((wire) => wire.name),
      clearance: (name) => this.gaps.find((gap) => gap.name === name).nearest(this.motion, this.time).distance,
      stage: () => $('now').textContent,
      wire: (name) => this.wires.find((wire) => wire.name === name).label.element.textContent,
      software: this.software,
      wavesDrawn: this.sea ? this.sea.drawn.length : 0,
    };
  }
}

async function main() {
  try {
    const data = JSON.parse($('data').textContent);
    const page = new Page(data, await gunzip($('blob').textContent.trim()));
    window.seacrane = page.face();
    requestAnimationFrame((now) => { page.last = now; page.loop(now); });
    document.documentElement.dataset.ready = 'true';
  } catch (error) {
    $('trouble').hidden = false;
    $('trouble').textContent = `This picture needs a browser with WebGL 2: ${error.message}`;
    document.documentElement.dataset.ready = 'failed';
    console.error(error);
  }
}
main();
