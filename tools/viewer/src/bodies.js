// Hulls, crane members, payloads: meshes that move with their bodies.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, CylinderGeometry, DoubleSide, EdgesGeometry, Group, LineBasicMaterial,
  LineSegments, Matrix4, Mesh, MeshLambertMaterial, Vector3,
} from 'three';
import { floats, whole } from './unpack.js';

export function bodyGroup(body, buffer) {
  const group = new Group();
  for (const shape of body.shapes) group.add(shape.vertices ? surface(shape, buffer) : part(shape));
  return group;
}

function part(shape) {
  const { colour } = shape;
  const box = shape.kind === 'box';
  const geometry = box ? new BoxGeometry(...shape.size) : tube(shape);
  const mesh = new Mesh(geometry, new MeshLambertMaterial({ color: colour }));
  if (box) {
    const [ax, ay, az] = [0, 3, 6].map((i) => new Vector3(...shape.axes.slice(i, i + 3)));
    mesh.applyMatrix4(new Matrix4().makeBasis(ax, ay, az).setPosition(...shape.centre));
  }
  const lines = new LineBasicMaterial({ color: new Color(colour).multiplyScalar(0.3) });
  mesh.add(new LineSegments(new EdgesGeometry(geometry, 40), lines));
  return mesh;
}

function tube({ ends, radius }) {
  const [start, end] = [new Vector3(...ends.slice(0, 3)), new Vector3(...ends.slice(3))];
  const along = end.clone().sub(start);
  const geometry = new CylinderGeometry(radius, radius, along.length(), 20);
  const middle = start.add(end).multiplyScalar(0.5);
  const up = new Vector3(0, 1, 0);
  geometry.applyMatrix4(alongAxis(up, along.normalize()));
  return geometry.translate(middle.x, middle.y, middle.z);
}

function alongAxis(from, to) {
  const turn = new Mesh();
  turn.quaternion.setFromUnitVectors(from, to);
  return new Matrix4().makeRotationFromQuaternion(turn.quaternion);
}

// Flat faces; those of a hull coloured by where they lie: antifouling below the still waterline, sides, deck.
function surface(shape, buffer) {
  const vertices = floats(buffer, shape.vertices);
  const faces = whole(buffer, shape.faces);
  const points = new Float32Array(3 * faces.length);
  const colours = new Float32Array(3 * faces.length);
  const top = vertices.reduce((most, value, i) => (i % 3 === 2 ? Math.max(most, value) : most), -Infinity);
  for (let f = 0; f < faces.length; f += 3) {
    const corners = [0, 1, 2].map((k) => [...vertices.slice(3 * faces[f + k], 3 * faces[f + k] + 3)]);
    const heights = corners.map((corner) => corner[2]);
    const flat = Math.min(...heights) > top - 1e-3 * Math.abs(top) - 1e-4;
    const wet = Math.max(...heights) <= shape.waterline + 1e-3;
    const { deck, below, above } = shape.colours ?? {};
    const colour = new Color(shape.colour ?? (flat ? deck : wet ? below : above));
    corners.forEach((corner, k) => {
      points.set(corner, 3 * (f + k));
      colours.set([colour.r, colour.g, colour.b], 3 * (f + k));
    });
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  geometry.setAttribute('color', new BufferAttribute(colours, 3));
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, new MeshLambertMaterial({ vertexColors: true, side: DoubleSide }));
  mesh.add(new LineSegments(new EdgesGeometry(geometry, 35), new LineBasicMaterial({ color: 0x1d2b36 })));
  return mesh;
}
