"""Joint coordinates from the poses of bodies, as the core measures them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.inputs.frames import euler_matrix, rotation_matrix

Array = NDArray[np.float64]
Pose = tuple[Array, Array]
AXES = {"displacement": 2, "x": 0, "y": 1, "z": 2}
ANGLES = ("angle", "roll", "pitch", "yaw")


class Jointed(Protocol):
    """A `Description`, as far as the places of its bodies and joints need one."""

    @property
    def name(self) -> str: ...
    @property
    def length_scale(self) -> float: ...
    @property
    def bodies(self) -> Mapping[str, _core.Body]: ...
    @property
    def joints(self) -> Mapping[str, _core.Joint]: ...
    @property
    def vessels(self) -> Mapping[str, _core.VesselHydrodynamics]: ...


def wrapped(angle: Array) -> Array:
    """The same directions between -pi and pi."""
    return angle - 2.0 * np.pi * np.floor(angle / (2.0 * np.pi) + 0.5)


def coordinate_at(scene: Jointed, joint: str, coordinate: str, pose: Callable[[str], Pose]) -> Array:
    """Values (n,) of a joint coordinate, m or rad; `pose` tells centre of mass and rotation of a body."""
    described = scene.joints[joint]
    point_a, a = _side(scene, described.first, described.first_frame, pose)
    point_b, b = _side(scene, described.second, described.second_frame, pose)
    if coordinate in AXES:
        return np.asarray(np.sum(a[..., :, AXES[coordinate]] * (point_b - point_a), axis=-1))
    between = np.swapaxes(a, -1, -2) @ b
    if coordinate == "roll":
        return np.arctan2(between[..., 2, 1], between[..., 2, 2])
    if coordinate == "pitch":
        return np.arcsin(np.clip(-between[..., 2, 0], -1.0, 1.0))
    return np.arctan2(between[..., 1, 0], between[..., 0, 0])


def _side(scene: Jointed, body: str, frame: _core.Frame, pose: Callable[[str], Pose]) -> Pose:
    """The joint's point (n, 3) and axes (n, 3, 3) on a body, inertial frame."""
    if body not in scene.bodies:
        return frame.point[None], frame.axes[None]
    centre, turn = pose(body)
    return centre + turn @ (frame.point - scene.bodies[body].center_of_mass), turn @ frame.axes


def start_pose(scene: Jointed, model: _core.Model, body: str) -> Pose:
    """Centre of mass (1, 3) and rotation (1, 3, 3) of a body at the assembled start."""
    index = list(scene.bodies).index(body)
    size = model.twist_index(0) // len(scene.bodies)
    values = np.asarray(model.initial_state)[size * index : size * (index + 1)]
    turn = rotation_matrix(values[3:]) if size == 7 else euler_matrix(values[3:])
    floating = any(vessel.body == body for vessel in scene.vessels.values())
    lever = scene.bodies[body].center_of_mass if floating else np.zeros(3)
    return (values[:3] + turn @ lever)[None], turn[None]
