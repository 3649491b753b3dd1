"""Shapes as triangles of one colour each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.pictures.drawn_bodies import Look
from seacrane.pictures.palette import HULL, body_colour
from seacrane.pictures.shapes import BoxShape, HullShape, MeshShape, Shape, TubeShape

Array = NDArray[np.float64]
Faces = NDArray[np.intp]

SIDES = 16  # of a tube
NEAR = 1e-3  # m: faces that near to the waterline are below it
# Corners of a box, anticlockwise from outside, by their places in `BoxShape.points`.
QUADS = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


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
        found += _hull(shape) if isinstance(shape, HullShape) else [_part(shape, look.role, number)]
    return found


def _part(shape: Shape, role: str, number: int) -> Surface:
    if isinstance(shape, MeshShape):
        colour, vertices, faces = shape.colour, shape.vertices, shape.faces
    elif isinstance(shape, BoxShape):
        colour, vertices, faces = shape.colour, shape.points, _box_faces()
    else:
        assert isinstance(shape, TubeShape)
        colour, (vertices, faces) = shape.colour, tube(shape.start, shape.end, shape.radius)
    return Surface(vertices=vertices, faces=faces, colour=body_colour(colour, role, number))


def _hull(shape: HullShape) -> list[Surface]:
    """Below the still waterline, above it, and the deck."""
    height = shape.vertices[shape.faces][..., 2]
    top = float(shape.vertices[:, 2].max())
    deck = height.min(axis=1) > top - 1e-3 * abs(top) - 1e-4
    below = ~deck & (height.max(axis=1) <= shape.waterline + NEAR)
    parts = (("below", below), ("above", ~deck & ~below), ("deck", deck))
    return [
        Surface(vertices=shape.vertices, faces=shape.faces[part], colour=HULL[name])
        for name, part in parts
        if part.any()
    ]


def _box_faces() -> Faces:
    return np.array([(a, b, c) for q in QUADS for a, b, c in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))])


def tube(start: Array, end: Array, radius: float, sides: int = SIDES) -> tuple[Array, Faces]:
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
