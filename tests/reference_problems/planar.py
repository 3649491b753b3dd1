"""Planar mechanisms of spatial bodies and joints, in the x-y or the x-z plane."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Scene
from seacrane.arrays import Array

# Plane -> its two axes in space, and the axis about which positive angles turn the first into the second.
PLANES = {"xy": np.array([[1.0, 0, 0], [0, 1.0, 0]]), "xz": np.array([[1.0, 0, 0], [0, 0, 1.0]])}


def place(plane: str, point: Any) -> Array:
    """A point of the plane in space."""
    return np.asarray(np.asarray(point, dtype=float) @ PLANES[plane])


def normal(plane: str) -> Array:
    return np.cross(*PLANES[plane])


def add_body(
    scene: Scene, plane: str, name: str, *, mass: float, inertia: float, origin: Any, angle: float,
    center: Any = (0.0, 0.0), velocity: Any = (0.0, 0.0), rate: float = 0.0
) -> None:  # fmt: skip
    """Origin and centre (body axes) lie in the plane; `angle` turns its body axes from the plane's."""
    turn = normal(plane)
    scene.add_body(
        name=name, mass=mass, inertia=np.full(3, inertia), center_of_mass=place(plane, center),
        position=place(plane, origin), quaternion=np.append(np.cos(0.5 * angle), np.sin(0.5 * angle) * turn),
        velocity=place(plane, velocity), angular_velocity=rate * turn
    )  # fmt: skip


def add_pin(
    scene: Scene, plane: str, name: str, first: str, second: str, point: Any, *, kind: str = "revolute"
) -> None:
    """A hinge across the plane; "spherical" and "cylindrical" ones leave out rows that a loop holds."""
    axis = {} if kind == "spherical" else {"axis": normal(plane)}
    scene.add_joint(kind=kind, name=name, first=first, second=second, point=place(plane, point), **axis)


def angles(plane: str, quaternions: Array) -> Array:
    """Angles of bodies (k, n) that turn in the plane, continuous over the outputs."""
    half = np.arctan2(quaternions[..., 1:] @ normal(plane), quaternions[..., 0])
    return np.asarray(2.0 * np.unwrap(half, axis=0))
