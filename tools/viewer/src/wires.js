// Links, wires, springs and cylinders. A slack wire is drawn with its own length, hanging to one side of its chord; one that a
// stage of the lift has not is hidden.
import { BufferAttribute, BufferGeometry, CatmullRomCurve3, CylinderGeometry, Line, LineBasicMaterial, Mesh, MeshLambertMaterial, TubeGeometry, Vector3 } from 'three';

const POINTS = 33;
const SLACK = 1e-3; // of the length
const UP = new Vector3(0, 1, 0); // along which a bar is made

export class Wire {
  constructor(wire, thickness) {
    Object.assign(this, wire);
    this.thickness = Math.max(thickness, wire.radius);
    this.mesh = new Mesh(new BufferGeometry(), new MeshLambertMaterial({ color: wire.colours[0] }));
    this.mesh.frustumCulled = false;
    this.slack = false;
  }

  there(t) {
    return !this.absent.some(([start, end]) => start <= t && t < end);
  }

  // As thick as it is, where that is known and asked for; else thick enough to be seen.
  show(motion, t, real) {
    const thickness = real && this.size > 0 ? this.size : this.thickness;
    this.mesh.visible = this.there(t);
    const [from, to] = [motion.point(this.from, t), motion.point(this.to, t)];
    if (this.reach > 0) to.lerpVectors(from, to, Math.min(1, this.reach / from.distanceTo(to)));
    const chord = from.distanceTo(to);
    this.slack = this.mesh.visible && this.length > 0 && chord < this.length * (1 - SLACK);
    const points = this.slack ? hanging(from, to, this.length) : [from, to];
    this.middle = this.slack ? points[POINTS >> 1] : from.clone().lerp(to, 0.5);
    this.mesh.material.color.set(this.colours[this.slack ? 1 : 0]);
    this.mesh.geometry.dispose();
    if (this.radius > 0) {
      this.mesh.geometry = new CylinderGeometry(thickness, thickness, chord, 16);
      this.mesh.position.copy(this.middle);
      this.mesh.quaternion.setFromUnitVectors(UP, to.clone().sub(from).normalize());
      return;
    }
    const curve = new CatmullRomCurve3(points);
    this.mesh.geometry = new TubeGeometry(curve, this.slack ? 48 : 1, thickness, 6, false);
  }
}

// A half wave over the chord, downwards or, under a vertical chord, sideways, as high as the length asks for.
function hanging(from, to, length) {
  const along = to.clone().sub(from);
  const chord = Math.max(along.length(), 1e-6 * length);
  along.divideScalar(chord);
  const side = new Vector3(0, 0, -1).addScaledVector(along, along.z);
  if (side.length() < 0.2) side.set(1, 0, 0).addScaledVector(along, -along.x);
  side.normalize();
  const curve = (depth) => Array.from({ length: POINTS }, (_, i) => {
    const u = i / (POINTS - 1);
    return from.clone().addScaledVector(along, chord * u).addScaledVector(side, depth * Math.sin(Math.PI * u));
  });
  let [low, high] = [0, length];
  for (let i = 0; i < 30; i++) {
    const middle = 0.5 * (low + high);
    const points = curve(middle);
    const long = points.reduce((sum, p, k) => sum + (k ? p.distanceTo(points[k - 1]) : 0), 0);
    if (long < length) low = middle; else high = middle;
  }
  return curve(low);
}

// Where a point has been: all of a short run faintly, the last while strongly.
export class Track {
  constructor(track, motion, { recent, whole, colour }) {
    Object.assign(this, { track, motion, recent });
    this.line = new Line(new BufferGeometry(), new LineBasicMaterial({ color: colour }));
    this.line.frustumCulled = false;
    this.group = [this.line];
    if (motion.end - motion.start <= whole) {
      const points = [];
      for (let i = 0; i < motion.frames; i++) points.push(motion.point(track.at, motion.start + i * motion.interval));
      const all = new Line(new BufferGeometry().setFromPoints(points), new LineBasicMaterial({ color: colour, transparent: true, opacity: 0.5 }));
      this.group.push(all);
    }
  }

  show(t) {
    const first = Math.max(this.motion.start, t - this.recent);
    const count = Math.max(2, Math.ceil((t - first) / this.motion.interval) + 1);
    const points = new Float32Array(3 * count);
    for (let i = 0; i < count; i++) {
      this.motion.point(this.track.at, first + ((t - first) * i) / (count - 1)).toArray(points, 3 * i);
    }
    this.line.geometry.dispose();
    this.line.geometry = new BufferGeometry();
    this.line.geometry.setAttribute('position', new BufferAttribute(points, 3));
  }
}
