// Bookmarks: where the camera may stand. `of` are the middle and the half extent of what is looked at.
import { Vector3 } from 'three';

const WHOLE = {
  overview: [0.72, 0.95, 0.42],
  port: [0, 1, 0.16],
  starboard: [0, -1, 0.16],
  bow: [1, 0, 0.16],
  stern: [-1, 0, 0.22],
  top: [-0.001, 0, 1],
};

export function bookmarks({ centre, radius, heading, side, close }) {
  const found = {};
  for (const [name, [x, y, z]] of Object.entries(WHOLE)) {
    const out = new Vector3(x, name === 'overview' ? y * side : y, z).normalize();
    out.applyAxisAngle(new Vector3(0, 0, 1), heading);
    found[name] = () => ({ target: centre.clone(), position: centre.clone().addScaledVector(out, 1.8 * radius) });
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
