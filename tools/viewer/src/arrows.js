// Forces as arrows, each group with one scale for the whole run.
import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshLambertMaterial, Vector3 } from 'three';
import { Series } from './unpack.js';

export const GROUPS = {
  link: { colour: '#c2185b', text: 'link tension' },
  wave: { colour: '#6a1fb0', text: 'wave force on the vessel' },
  joint: { colour: '#11784a', text: 'joint reaction' },
};
const UP = new Vector3(0, 1, 0);

export class Arrow {
  constructor(arrow, buffer, scale, thickness) {
    Object.assign(this, { name: arrow.name, kind: arrow.group, at: arrow.at, scale, thickness });
    this.force = new Series(buffer, arrow.force);
    const material = new MeshLambertMaterial({ color: GROUPS[arrow.group].colour, depthTest: false, transparent: true, opacity: 0.9 });
    this.shaft = new Mesh(new CylinderGeometry(1, 1, 1, 10).translate(0, 0.5, 0), material);
    this.head = new Mesh(new ConeGeometry(1, 1, 14).translate(0, 0.5, 0), material);
    this.group = new Group().add(this.shaft, this.head);
    this.group.renderOrder = 5;
    [this.shaft, this.head].forEach((mesh) => { mesh.renderOrder = 5; });
  }

  value(motion, t) {
    const place = motion.place(t);
    return new Vector3(...[0, 1, 2].map((row) => this.force.linear(row, place)));
  }

  show(motion, t) {
    const force = this.value(motion, t);
    const length = force.length() * this.scale;
    this.small = length < 2 * this.thickness;
    this.group.children.forEach((mesh) => { mesh.visible = !this.small; });
    if (this.small) return;
    const head = Math.min(5 * this.thickness, 0.5 * length);
    this.shaft.scale.set(this.thickness, length - head, this.thickness);
    this.head.scale.set(2.4 * this.thickness, head, 2.4 * this.thickness);
    this.head.position.set(0, length - head, 0);
    this.group.quaternion.setFromUnitVectors(UP, force.normalize());
    motion.point(this.at, t, this.group.position);
  }
}

// Metres per newton such that the largest is no longer than `longest`, with round numbers of newtons and metres.
export function roundScale(largest, longest) {
  const metres = 10 ** Math.floor(Math.log10(longest));
  const wanted = (metres * largest) / longest;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const round = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= wanted * 0.999);
  return { perNewton: metres / round, metres, newtons: round };
}

export function newtons(force) {
  const [size, unit] = force >= 1e6 ? [1e6, 'MN'] : force >= 1e3 ? [1e3, 'kN'] : [1, 'N'];
  return `${+(force / size).toPrecision(3)} ${unit}`;
}
