// Sheaves, and drums that turn about their axes, on their bodies.
import { Quaternion, Vector3 } from 'three';
import { bodyGroup } from './bodies.js';
import { Series } from './unpack.js';

export class Wheel {
  constructor(wheel, buffer) {
    Object.assign(this, { name: wheel.name, at: wheel.at, axis: new Vector3(...wheel.axis) });
    this.angle = wheel.angle && new Series(buffer, wheel.angle);
    this.group = bodyGroup(wheel, buffer);
  }

  pose(motion, t) {
    const position = motion.point(this.at, t);
    const angle = this.angle ? this.angle.linear(0, motion.place(t)) : 0;
    const quaternion = new Quaternion().setFromAxisAngle(this.axis, angle);
    if (this.at[0] >= 0) quaternion.premultiply(motion.pose(this.at[0], t).quaternion);
    return { position, quaternion };
  }

  show(motion, t) {
    const { position, quaternion } = this.pose(motion, t);
    this.group.position.copy(position);
    this.group.quaternion.copy(quaternion);
    this.group.updateMatrixWorld(true);
  }
}
