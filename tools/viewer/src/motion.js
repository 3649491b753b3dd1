// Poses between the frames: cubic Hermite curves of positions and of quaternions, as seacrane/pictures/pose_curves.py.
import { Quaternion, Vector3 } from 'three';
import { Series } from './unpack.js';

export class Motion {
  constructor(buffer, data) {
    Object.assign(this, { start: data.start, interval: data.interval });
    for (const name of ['position', 'quaternion', 'velocity', 'angular_velocity']) {
      this[name] = new Series(buffer, data[name]);
    }
    this.frames = this.position.frames;
    this.end = this.start + this.interval * (this.frames - 1);
  }

  place(t) {
    const at = (Math.min(Math.max(t, this.start), this.end) - this.start) / this.interval;
    const frame = Math.max(0, Math.min(Math.floor(at), this.frames - 2));
    return { frame, u: this.frames > 1 ? at - frame : 0 };
  }

  pose(body, t, position = new Vector3(), quaternion = new Quaternion()) {
    const { frame, u } = this.place(t);
    const next = Math.min(frame + 1, this.frames - 1);
    const h = this.interval;
    const weights = [(1 + 2 * u) * (1 - u) ** 2, u * (1 - u) ** 2 * h, u * u * (3 - 2 * u), u * u * (u - 1) * h];
    const mix = (a, b, c, d) => weights[0] * a + weights[1] * b + weights[2] * c + weights[3] * d;
    const p = [0, 1, 2].map((k) => {
      const row = 3 * body + k;
      const { position: x, velocity: v } = this;
      return mix(x.get(row, frame), v.get(row, frame), x.get(row, next), v.get(row, next));
    });
    position.set(...p);
    const [a, b] = [frame, next].map((i) => this.turn(body, i));
    const q = [0, 1, 2, 3].map((k) => mix(a.q[k], a.rate[k], b.q[k], b.rate[k]));
    quaternion.set(q[1], q[2], q[3], q[0]).normalize();
    return { position, quaternion };
  }

  turn(body, frame) {
    const [w, x, y, z] = [0, 1, 2, 3].map((k) => this.quaternion.get(4 * body + k, frame));
    const [a, b, c] = [0, 1, 2].map((k) => this.angular_velocity.get(3 * body + k, frame));
    const rate = [-(a * x + b * y + c * z), w * a + b * z - c * y, w * b + c * x - a * z, w * c + a * y - b * x];
    return { q: [w, x, y, z], rate: rate.map((value) => value / 2) };
  }

  // A point [body, x, y, z] in the inertial frame; body -1 is the ground.
  point([body, x, y, z], t, out = new Vector3()) {
    out.set(x, y, z);
    if (body < 0) return out;
    const { position, quaternion } = this.pose(body, t);
    return out.applyQuaternion(quaternion).add(position);
  }
}
