"""Where points of bodies are and how they move, out of what the core records of bodies."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.inputs.frames import cross, rotation_matrix

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
POSE = ("position", "quaternion")
MOTION = (*POSE, "velocity", "angular_velocity")


def position_of(scene: Description, arrays: Mapping[str, Array], body: str, point: ArrayLike) -> Array:
    """The position of a point of a body, or of the ground, inertial frame, m, shape (time, 3)."""
    if body not in scene.bodies:  # the ground
        return np.broadcast_to(np.asarray(point, float), (len(arrays["position"]), 3)).copy()
    return np.asarray(arrays["position"][:, place_in(scene, body)] + _lever(scene, arrays, body, point))


def velocity_of(scene: Description, arrays: Mapping[str, Array], body: str, point: ArrayLike) -> Array:
    """The velocity of a point of a body, or of the ground, inertial frame, m/s, shape (time, 3)."""
    if body not in scene.bodies:
        return np.zeros((len(arrays["position"]), 3))
    place = place_in(scene, body)
    turning = cross(arrays["angular_velocity"][:, place], _lever(scene, arrays, body, point))
    return np.asarray(arrays["velocity"][:, place] + turning)


def relative_motion(
    scene: Description, arrays: Mapping[str, Array], point: str, to: str, axes: str, *, velocity: bool
) -> Array:
    """Motion of a named point over another along the axes of a body, m; its rate, m/s; shape (time, 3)."""
    ends = [scene.points[name] for name in (point, to)]
    over, below = (position_of(scene, arrays, one.body, one.point) for one in ends)
    told = over - below
    if velocity:
        fast, slow = (velocity_of(scene, arrays, one.body, one.point) for one in ends)
        rate = fast - slow
        if axes in scene.bodies:
            rate -= cross(arrays["angular_velocity"][:, place_in(scene, axes)], told)
        told = rate
    if axes not in scene.bodies:
        return np.asarray(told)
    turn = rotation_matrix(arrays["quaternion"][:, place_in(scene, axes)])
    return np.asarray((told[:, None, :] @ turn)[:, 0])


def place_in(scene: Description, body: str) -> int:
    """The column of a body in the core's channels of bodies."""
    return list(scene.bodies).index(body)


def _lever(scene: Description, arrays: Mapping[str, Array], body: str, point: ArrayLike) -> Array:
    """From the centre of mass of a body to a point of it, inertial frame, m."""
    in_body = np.asarray(point, float) - np.asarray(scene.bodies[body].center_of_mass)
    turn = arrays["quaternion"][:, place_in(scene, body)]
    w, axis = turn[:, :1], turn[:, 1:]
    across = cross(axis, in_body)
    return np.asarray(in_body + 2.0 * (w * across + cross(axis, across)))
