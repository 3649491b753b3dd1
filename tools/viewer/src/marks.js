// Named points, and clearances: the box, and the shortest way to it from the nearest of its points.
import { BoxGeometry, BufferGeometry, EdgesGeometry, Group, Line, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, SphereGeometry, Vector3 } from 'three';

const POINT = 0x1d2b36;
const GAP = 0xb3261e;

export class PointMark {
  constructor({ name, at }, radius) {
    Object.assign(this, { name, at });
    this.object = new Mesh(new SphereGeometry(radius, 12, 8), new MeshLambertMaterial({ color: POINT }));
  }

  show(motion, t) {
    motion.point(this.at, t, this.object.position);
  }
}

export class Clearance {
  constructor({ name, points, at, size }) {
    Object.assign(this, { name, points, body: at[0], centre: new Vector3(...at.slice(1)), half: new Vector3(...size).multiplyScalar(0.5) });
    this.box = new LineSegments(new EdgesGeometry(new BoxGeometry(...size)), new LineBasicMaterial({ color: GAP }));
    this.way = new Line(new BufferGeometry(), new LineBasicMaterial({ color: GAP }));
    this.way.frustumCulled = false;
    this.object = new Group().add(this.box, this.way);
  }

  // Distance of the nearest point from the box, m, negative inside; and both ends of the way.
  nearest(motion, t) {
    const pose = this.body < 0 ? null : motion.pose(this.body, t);
    const found = this.points.map((point) => {
      const from = motion.point(point, t);
      const local = from.clone();
      if (pose) local.sub(pose.position).applyQuaternion(pose.quaternion.clone().invert());
      local.sub(this.centre);
      const over = new Vector3(Math.abs(local.x), Math.abs(local.y), Math.abs(local.z)).sub(this.half);
      const inside = Math.max(over.x, over.y, over.z);
      const distance = inside < 0 ? inside : over.clampScalar(0, Infinity).length();
      const to = local.clamp(this.half.clone().negate(), this.half).add(this.centre);
      if (pose) to.applyQuaternion(pose.quaternion).add(pose.position);
      return { from, to, distance };
    });
    return found.reduce((a, b) => (b.distance < a.distance ? b : a));
  }

  show(motion, t) {
    motion.point([this.body, ...this.centre.toArray()], t, this.box.position);
    if (this.body >= 0) this.box.quaternion.copy(motion.pose(this.body, t).quaternion);
    const { from, to, distance } = this.nearest(motion, t);
    this.way.geometry.dispose();
    this.way.geometry = new BufferGeometry().setFromPoints([from, to]);
    this.middle = from.lerp(to, 0.5);
    this.text = `${this.name} ${distance.toFixed(2)} m`;
  }
}
