"""What contacts press on: decks, fenders, guide posts and pipes, where they are described."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import Description
from seacrane.description.places import place_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.pictures.pose_curves import Motion
from seacrane.pictures.shapes import BoxShape, MeshShape, Shape, TubeShape
from seacrane.pictures.wheels import Wheel
from seacrane.pictures.wires import end_of

Array = NDArray[np.float64]
PLATE = 0.05  # m, that is drawn of a plane, below it
MARGIN = 1.0  # m, of a plane beyond the points that come down on it
AROUND = 24  # faces of a pipe
SURFACE = "surface"
UP = np.array([0.0, 0.0, 1.0])


def surfaces_of_contacts(scene: Description, motion: Motion) -> Iterator[Wheel]:
    """Each as something on its body, or on the ground, that does not turn."""
    for name, contact in scene.loads.items():
        if isinstance(contact, _core.Contact):
            at = end_of(scene, motion.bodies, contact.on, contact.place)
            yield Wheel(name=name, kind=SURFACE, at=at, axis=UP, shapes=[_shape(scene, contact)])


def _shape(scene: Description, contact: _core.Contact) -> Shape:
    """About the place of the surface, in axes of its body."""
    axes, size = np.asarray(contact.axes, dtype=float), np.asarray(contact.size, dtype=float)
    if contact.surface == "box":
        return BoxShape(centre=np.zeros(3), axes=axes, size=size)
    if contact.surface == "post":
        half = 0.5 * float(size[2]) * axes[:, 2]
        return TubeShape(start=-half, end=half, radius=0.5 * float(size[1]))
    if contact.surface == "pipe":
        return _pipe(axes, size)
    return _plate(axes, _points(scene, contact) @ axes)


def _points(scene: Description, contact: _core.Contact) -> Array:
    """Points of a contact as described, from its place, in axes of the surface's body, (n, 3), m."""
    places = np.array([place_of(scene, body=contact.body, point=point) for point in contact.points])
    away = places - place_of(scene, body=contact.on, point=contact.place)
    body = scene.bodies.get(contact.on)
    return away if body is None else np.asarray(away @ rotation_matrix(body.quaternion))


def _plate(axes: Array, points: Array) -> BoxShape:
    """A piece of a plane below points (n, 3) in its own axes."""
    low, high = points[:, :2].min(axis=0) - MARGIN, points[:, :2].max(axis=0) + MARGIN
    centre = axes @ np.array([*(0.5 * (low + high)), -0.5 * PLATE])
    return BoxShape(centre=centre, axes=axes, size=np.array([*(high - low), PLATE]))


def _pipe(axes: Array, size: Array) -> MeshShape:
    """A wall between inner and outer diameter: four rings of points."""
    turn = 2.0 * np.pi * np.arange(AROUND) / AROUND
    circle = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(AROUND)])
    inner, outer, half = 0.5 * size[0] * circle, 0.5 * size[1] * circle, 0.5 * size[2] * UP
    rings = [inner - half, outer - half, outer + half, inner + half]
    here, beside = np.arange(AROUND), (np.arange(AROUND) + 1) % AROUND
    faces = []
    for one in range(4):
        first, second = one * AROUND, (one + 1) % 4 * AROUND
        faces += [np.column_stack([first + here, first + beside, second + beside])]
        faces += [np.column_stack([first + here, second + beside, second + here])]
    return MeshShape(vertices=np.concatenate(rings) @ axes.T, faces=np.concatenate(faces))
