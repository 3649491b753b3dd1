// Bookmarks: where the camera may stand, so that a box of things just fits into the part of the picture left free.
import { Vector3 } from 'three';

const WHOLE = {
  overview: [0.72, 0.95, 0.42],
  port: [0, 1, 0.16],
  starboard: [0, -1, 0.16],
  bow: [1, 0, 0.16],
  stern: [-1, 0, 0.22],
  top: [0, -0.001, 1],
};

const MARGIN = 0.9; // corners of the box are empty

export function bookmarks({ box, heading, side, close, opening }) {
  const found = {};
  const centre = box.getCenter(new Vector3());
  for (const [name, [x, y, z]] of Object.entries(WHOLE)) {
    const out = new Vector3(x, name === 'overview' ? y * side : y, z).normalize();
    out.applyAxisAngle(new Vector3(0, 0, 1), heading);
    found[name] = () => {
      const far = MARGIN * distance(box, centre, out, opening());
      return { target: centre.clone(), position: centre.clone().addScaledVector(out, far) };
    };
  }
  for (const { name, place, size } of close) {
    const out = new Vector3(0.6, 0.75 * side, 0.3).normalize().applyAxisAngle(new Vector3(0, 0, 1), heading);
    found[name] = () => {
      const target = place();
      return { target, position: target.clone().addScaledVector(out, size), follows: place };
    };
  }
  return found;
}

// How far out a camera must stand for every corner to lie within the opening's half tangents.
function distance(box, centre, out, { across, up }) {
  const right = new Vector3(0, 0, 1).cross(out).normalize();
  const top = out.clone().cross(right);
  let far = 0;
  for (let i = 0; i < 8; i++) {
    const corner = new Vector3(
      i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z,
    ).sub(centre);
    const wide = Math.max(Math.abs(corner.dot(right)) / across, Math.abs(corner.dot(top)) / up);
    far = Math.max(far, corner.dot(out) + wide);
  }
  return far;
}
