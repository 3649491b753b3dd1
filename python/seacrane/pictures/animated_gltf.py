"""A drawing as an animated glTF model: a node for each body, wheel and wire."""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.pictures.drawing import Drawing
from seacrane.pictures.drawn_bodies import Look
from seacrane.pictures.pose_curves import quaternion_rate
from seacrane.pictures.shapes import HULL, WIRES, BoxShape, HullShape, MeshShape, body_colour, rgb
from seacrane.pictures.wheels import turns
from seacrane.version import __version__

GENERATOR = '"generator":"seacrane '  # what the head of every model says
UPRIGHT = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]  # z up becomes glTF's y up; quaternion x, y, z, w
UP = np.array([0.0, 0.0, 1.0])
SMALLEST = 1e-6  # m: shorter wires have no direction
FLOAT, UNSIGNED = 5126, 5125
VERTICES, INDICES = 34962, 34963
TYPES = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}
HEADER, CHUNK = struct.Struct("<4sII"), struct.Struct("<I4s")
LARGEST = 2**32 - 2**20  # bytes: lengths have 32 bits
Faces = NDArray[np.intp]
SIDES, WIRE_SIDES = 16, 8  # of a tube, of a wire
NEAR = 1e-3  # m: faces that near to the waterline are below it
# Corners of a box, anticlockwise from outside, by their places in `BoxShape.points`.
QUADS = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
BOX_FACES = np.array(QUADS)[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)


def gltf_of(drawing: Drawing) -> bytes:
    """The model as a .glb file, as of `View.save_gltf`; SceneError for a run too long for one file.

    Its animation is a cubic spline with the velocities of the run, from 0 s at the first output; `extras` of
    the scene tell the time of that. Wires and links are nodes that turn and stretch.
    """
    model = _Model(drawing)
    model.bodies()
    model.wheels()
    model.wires()
    return model.glb.to_bytes()


class _Model:
    """The document as it is made."""

    def __init__(self, drawing: Drawing) -> None:
        self.drawing, self.motion = drawing, drawing.motion
        self.nodes: list[dict[str, Any]] = [{"name": drawing.title, "rotation": UPRIGHT, "children": []}]
        self.materials: dict[str, int] = {}
        self.meshes: list[dict[str, Any]] = []
        self.channels: list[dict[str, Any]] = []
        self.samplers: list[dict[str, Any]] = []
        self.glb = Glb({
            "asset": {"version": "2.0", "generator": f"seacrane {__version__}"},
            "scene": 0,
            "scenes": [{"nodes": [0], "extras": {"start_s": self.motion.start}}],
            "nodes": self.nodes, "meshes": self.meshes, "materials": [], "accessors": [], "bufferViews": [],
        })  # fmt: skip
        self.times = -1
        if len(self.motion.times) > 1:
            self.times = self.glb.add(self.motion.times - self.motion.start, bounds=True)
            run = {"name": "run", "channels": self.channels, "samplers": self.samplers}
            self.glb.document["animations"] = [run]

    def bodies(self) -> None:
        """Every body with its shapes, at its centre of mass."""
        motion, drawing = self.motion, self.drawing
        rate = quaternion_rate(motion.quaternion, motion.angular_velocity)
        for i, name in enumerate(motion.bodies):
            mesh = self._mesh(name, surfaces_of(drawing.looks[name], i))
            place, turn = motion.position[:, i], _xyzw(motion.quaternion[:, i])
            node = self._node(name, mesh, translation=place[0], rotation=turn[0])
            self.nodes[node]["extras"] = {"role": drawing.looks[name].role}
            paths = {"translation": (place, motion.velocity[:, i]), "rotation": (turn, _xyzw(rate[:, i]))}
            for path, (values, rates) in paths.items():  # tangent, value, tangent: the page's Hermite curves
                knots = np.stack([rates, values, rates], axis=1).reshape(-1, values.shape[1])
                self._sampler(node, path, knots, "CUBICSPLINE")

    def wheels(self) -> None:
        """Sheaves and drums, below the nodes of their bodies."""
        for wheel in self.drawing.wheels:
            number, *centre = wheel.at
            mesh = self._mesh(wheel.name, surfaces_of(wheel.look, 0))
            node = self._node(wheel.name, mesh, below=1 + int(number), translation=np.array(centre))
            if wheel.angle is not None:
                turn = _xyzw(turns(wheel.axis, wheel.angle))
                self.nodes[node]["rotation"] = turn[0].tolist()
                self._sampler(node, "rotation", turn, "LINEAR")

    def wires(self) -> None:
        """Every wire as a bar of one metre along z, which is moved, turned and stretched."""
        drawing, motion = self.drawing, self.motion
        seen = 0.001 * (float(np.linalg.norm(np.ptp(drawing.box, axis=0))) or 2.0)
        for wire in drawing.wires:
            vertices, faces = tube(np.zeros(3), UP, max(seen, float(wire["radius"])), WIRE_SIDES)
            bar = Surface(vertices=vertices, faces=faces, colour=WIRES[wire["kind"]])
            start, end = drawing.ends_of(wire, motion.position, motion.quaternion)
            length = np.maximum(np.linalg.norm(end - start, axis=1), SMALLEST)
            turn = _from_z((end - start) / length[:, None])
            there = np.where(drawing.absent(wire, motion.times), SMALLEST, 1.0)
            scale = np.column_stack([there, there, there * length])
            paths = {"translation": start, "rotation": turn, "scale": scale}
            first = {path: values[0] for path, values in paths.items()}
            node = self._node(wire["name"], self._mesh(wire["name"], [bar]), **first)
            for path, values in paths.items():
                self._sampler(node, path, values, "LINEAR")

    def _node(self, name: str, mesh: int, *, below: int = 0, **pose: Array) -> int:
        self.nodes[below].setdefault("children", []).append(len(self.nodes))
        self.nodes.append({"name": name, "mesh": mesh} | {key: value.tolist() for key, value in pose.items()})
        return len(self.nodes) - 1

    def _mesh(self, name: str, surfaces: Sequence[Surface]) -> int:
        """Without normals: faces are then flat."""
        primitives = [
            {
                "attributes": {"POSITION": self.glb.add(one.vertices, target=VERTICES, bounds=True)},
                "indices": self.glb.add(np.ravel(one.faces), target=INDICES),
                "material": self._material(one.colour),
            }
            for one in map(_used, surfaces)
        ]
        self.meshes.append({"name": name, "primitives": primitives})
        return len(self.meshes) - 1

    def _material(self, colour: str) -> int:
        if colour not in self.materials:
            self.materials[colour] = len(self.materials)
            paint = {"baseColorFactor": [*map(_linear, rgb(colour)), 1.0], "metallicFactor": 0.0,
                     "roughnessFactor": 0.8}  # fmt: skip
            material = {"name": colour, "pbrMetallicRoughness": paint, "doubleSided": True}
            self.glb.document["materials"].append(material)
        return self.materials[colour]

    def _sampler(self, node: int, path: str, values: Array, interpolation: str) -> None:
        if self.times < 0:
            return
        self.channels.append({"sampler": len(self.samplers), "target": {"node": node, "path": path}})
        sampler = {"input": self.times, "output": self.glb.add(values), "interpolation": interpolation}
        self.samplers.append(sampler)


def _used(surface: Surface) -> Surface:
    """Without vertices of other surfaces."""
    kept, faces = np.unique(surface.faces, return_inverse=True)
    return Surface(vertices=surface.vertices[kept], faces=faces.reshape(-1, 3), colour=surface.colour)


def _xyzw(quaternion: Array) -> Array:
    return np.roll(quaternion, -1, axis=-1)


def _linear(value: float) -> float:
    """Linear colours of sRGB ones."""
    return round(value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4, 6)


def _from_z(direction: Array) -> Array:
    """Quaternions (n, 4), x y z w, that turn z into unit vectors (n, 3).

    The shortest way to the first of them, and from there the shortest: no jump unless a wire turns round.
    """
    from scipy.spatial.transform import Rotation

    first = Rotation.from_quat(_shortest(UP, direction[:1])[0])
    turn = (Rotation.from_quat(_shortest(direction[0], direction)) * first).as_quat()
    flips = np.where(np.sum(turn[1:] * turn[:-1], axis=1) < 0.0, -1.0, 1.0)
    return np.asarray(turn * np.cumprod(np.concatenate([[1.0], flips]))[:, None])


def _shortest(start: Array, ends: Array) -> Array:
    """Quaternions that turn a unit vector (3,) into others (n, 3)."""
    half = np.column_stack([np.cross(start, ends), 1.0 + ends @ start])
    across = np.cross(start, np.eye(3)[int(np.argmin(np.abs(start)))])
    half[np.linalg.norm(half, axis=1) < 1e-6] = (*across, 0.0)
    return np.asarray(half / np.linalg.norm(half, axis=1, keepdims=True))


@dataclass
class Glb:
    """A document that grows: it holds lists of glTF, and `add` stores numbers and gives their accessor."""

    document: dict[str, Any]
    parts: list[bytes] = field(default_factory=list)
    size: int = 0

    def add(self, values: Any, *, target: int | None = None, bounds: bool = False) -> int:
        """Numbers (n,) or (n, 3 or 4) in single precision, or as indices if they are whole.

        `bounds`: whether to tell the lowest and highest, as glTF demands of positions and times.
        """
        array = np.asarray(values)
        whole = array.dtype.kind in "iu"
        array = array.astype("<u4" if whole else "<f4")
        data = array.tobytes()
        view = {"buffer": 0, "byteOffset": self.size, "byteLength": len(data)}
        self.document["bufferViews"].append(view | ({} if target is None else {"target": target}))
        accessor = {
            "bufferView": len(self.document["bufferViews"]) - 1,
            "componentType": UNSIGNED if whole else FLOAT,
            "count": len(array),
            "type": TYPES[1 if array.ndim == 1 else array.shape[1]],
        }
        if bounds:
            rows = array.reshape(len(array), -1)
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        self.document["accessors"].append(accessor)
        self.parts.append(data)
        self.size += len(data)
        return len(self.document["accessors"]) - 1

    def to_bytes(self) -> bytes:
        """The file; SceneError where it would be too large for the format."""
        document = self.document | {"buffers": [{"byteLength": self.size}]}
        text = json.dumps(document, allow_nan=False, separators=(",", ":")).encode("ascii")
        text += b" " * (-len(text) % 4)
        total = HEADER.size + 2 * CHUNK.size + len(text) + self.size
        if total > LARGEST:
            title = self.document["nodes"][0]["name"]
            raise SceneError(
                f"view: the glTF model of {title!r} takes {total} bytes, above {LARGEST}; save a shorter run"
            )
        chunks = [CHUNK.pack(len(text), b"JSON"), text, CHUNK.pack(self.size, b"BIN\0"), *self.parts]
        return b"".join([HEADER.pack(b"glTF", 2, total), *chunks])


@dataclass(frozen=True, kw_only=True, eq=False)
class Surface:
    """Triangles `faces` (m, 3), anticlockwise from outside, of `vertices` (n, 3), m; `colour` "#rrggbb"."""

    vertices: Array
    faces: Faces
    colour: str


def surfaces_of(look: Look, number: int) -> list[Surface]:
    """What a body, by its number among the bodies, shows: relative to its centre of mass, body axes."""
    found: list[Surface] = []
    for shape in look.shapes:
        if isinstance(shape, HullShape):
            found += _hull(shape)
            continue
        if isinstance(shape, MeshShape):
            vertices, faces = shape.vertices, shape.faces
        elif isinstance(shape, BoxShape):
            vertices, faces = shape.points, BOX_FACES
        else:
            vertices, faces = tube(shape.start, shape.end, shape.radius, SIDES)
        colour = body_colour(shape.colour, look.role, number)
        found.append(Surface(vertices=vertices, faces=faces, colour=colour))
    return found


def _hull(shape: HullShape) -> list[Surface]:
    """Below the still waterline, above it, and the deck."""
    height = shape.vertices[shape.faces][..., 2]
    top = float(shape.vertices[:, 2].max())
    deck = height.min(axis=1) > top - 1e-3 * abs(top) - 1e-4
    below = ~deck & (height.max(axis=1) <= shape.waterline + NEAR)
    parts = (("below", below), ("above", ~deck & ~below), ("deck", deck))
    there = [(HULL[name], shape.faces[part]) for name, part in parts if part.any()]
    return [Surface(vertices=shape.vertices, faces=faces, colour=colour) for colour, faces in there]


def tube(start: Array, end: Array, radius: float, sides: int) -> tuple[Array, Faces]:
    """A closed round bar: vertices (2 sides + 2, 3) and triangles."""
    along = np.asarray(end) - np.asarray(start)
    along = along / (float(np.linalg.norm(along)) or 1.0)
    across = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
    across /= float(np.linalg.norm(across)) or 1.0
    angle = 2.0 * np.pi * np.arange(sides)[:, None] / sides
    ring = radius * (np.cos(angle) * across + np.sin(angle) * np.cross(along, across))
    vertices = np.concatenate([start + ring, end + ring, [start, end]])
    i, j = np.arange(sides), (np.arange(sides) + 1) % sides
    first, last = np.full(sides, 2 * sides), np.full(sides, 2 * sides + 1)
    faces = [(i, j, sides + j), (i, sides + j, sides + i), (j, i, first), (sides + i, sides + j, last)]
    return vertices, np.concatenate([np.column_stack(columns) for columns in faces])
