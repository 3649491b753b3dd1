"""Parts of a body in the water as they are described: boxes, cylinders, spheres; of a table its extent."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import Description
from seacrane.description.wet_parts import immersed_parts
from seacrane.pictures.shapes import BoxShape, MeshShape, Shape, TubeShape

Array = NDArray[np.float64]
AROUND, DOWN = 16, 8  # faces of a sphere
THINNEST = 0.01  # m, that is drawn of a plate


def wet_shapes(scene: Description, body: str) -> list[Shape]:
    """Of all its parts, relative to its centre of mass, body axes, m."""
    centre = np.asarray(scene.bodies[body].center_of_mass, dtype=float)
    parts = [part for part in immersed_parts(scene).values() if part.body == body and part.shape != "disc"]
    return [_shape(part, centre) for part in parts]


def _shape(part: _core.ImmersedPart, centre: Array) -> Shape:
    at, axes, size = np.asarray(part.point) - centre, np.asarray(part.axes), np.asarray(part.size)
    if part.shape == "cylinder":
        half = 0.5 * size[0] * axes[:, 0]
        return TubeShape(start=at - half, end=at + half, radius=0.5 * float(size[1]))
    if part.shape == "sphere":
        return _sphere(at, 0.5 * float(size[0]))
    return BoxShape(centre=at, axes=axes, size=np.maximum(size, THINNEST))


def _sphere(at: Array, radius: float) -> MeshShape:
    """Rows of points from pole to pole, each face two triangles."""
    polar, around = np.linspace(0.0, np.pi, DOWN + 1), 2.0 * np.pi * np.arange(AROUND) / AROUND
    rows = [np.sin(polar)[:, None] * np.cos(around), np.sin(polar)[:, None] * np.sin(around)]
    points = np.stack([*rows, np.broadcast_to(np.cos(polar)[:, None], rows[0].shape)], axis=-1)
    down, to = np.meshgrid(np.arange(DOWN), np.arange(AROUND), indexing="ij")
    here, beside = down * AROUND + to, down * AROUND + (to + 1) % AROUND
    below = np.stack([here, here + AROUND, beside + AROUND], axis=-1)
    above = np.stack([here, beside + AROUND, beside], axis=-1)
    faces = np.concatenate([below.reshape(-1, 3), above.reshape(-1, 3)])
    return MeshShape(vertices=at + radius * points.reshape(-1, 3), faces=faces)
