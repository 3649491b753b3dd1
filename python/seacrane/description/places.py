"""Where points of bodies and joints are as described, and how they move in what the core records."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import GROUND, Description, require
from seacrane.description.expression import Curve
from seacrane.errors import SceneError
from seacrane.inputs.checked import shaped_of, text_of
from seacrane.inputs.frames import cross, euler_matrix, rotation_matrix

ORIGIN = (0.0, 0.0, 0.0)
POSE = ("position", "quaternion")
MOTION = (*POSE, "velocity", "angular_velocity")
Pose = tuple[Array, Array]
AXES = {"displacement": 2, "x": 0, "y": 1, "z": 2}
ANGLES = ("angle", "roll", "pitch", "yaw")


def apart(scene: Description, what: str, *ends: tuple[str, Any]) -> float:
    """Distance of two points of bodies as described, m; SceneError for a body that is not there."""
    first, second = (
        placed(scene, require(scene, what, "body", body, ground=True), point) for body, point in ends
    )
    return float(np.linalg.norm(second - first))


def place_of(scene: Description, body: str, point: Any = ORIGIN) -> Array:
    """Where a point is in the pose described, in the inertial frame, m.

    What hangs below a crane's tip is placed by it: ``x, y, z = scene.place_of("tip")``.

    Parameters
    ----------
    body : str
        Of the scene, or "ground". In its place the name of one of the scene's points, or "tip", after the
        prefix of its crane; a body of that name comes first.
    point : array_like, shape (3,)
        In the coordinates of the body, m; default: its origin.

    Returns
    -------
    ndarray, shape (3,)

    Raises
    ------
    SceneError
        For a name that is not in the scene, or a point that is not three numbers.
    """
    return placed(scene, *on_body(scene, "place", body, point))


def on_body(scene: Description, what: str, name: str, point: Any) -> tuple[str, Array]:
    """A body and a point in its coordinates, m, by the name of a body or a point; errors as of `place_of`."""
    name = text_of(f"{what}: body", name)
    offset = np.array(shaped_of(f"{what} on {name!r}: point", point, (3,)))
    if name == GROUND or name in scene.bodies:
        return name, offset
    tips = {f"{one.prefix}tip": one.tip for one in scene.roles.values() if one.tip is not None}
    named = tips | {point_name: (one.body, one.point) for point_name, one in scene.points.items()}
    if name in named:
        body, own = named[name]
        return body, np.asarray(own, dtype=float) + offset
    bodies = ", ".join(map(repr, scene.bodies)) or "none"
    points = f", and points {', '.join(map(repr, named))}" if named else ""
    raise SceneError(f"{what}: there is no body {name!r}, the scene has {bodies}{points}; add it first")


def placed(scene: Description, body: str, point: Any) -> Array:
    """As `place_of`; whatever is no body is the ground."""
    local = np.asarray(point, dtype=float)
    if body not in scene.bodies:
        return local
    origin, turn = described_pose(scene, body)
    return np.asarray(origin + turn @ local)


def described_pose(scene: Description, body: str) -> Pose:
    """Origin and rotation of a body as described; whatever is no body stands still, as the ground."""
    if body not in scene.bodies:
        return np.zeros(3), np.eye(3)
    held = scene.bodies[body]
    return np.asarray(held.position), rotation_matrix(held.quaternion)


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


def place_along(scene: Description, arrays: Mapping[str, Array], place: Curve) -> Array:
    """A coordinate of a named point, or of a body's centre of mass, along the axes of a body from its origin.

    m, or its rate as who stands on the body sees it, m/s; shape (time,).
    """
    if place.text in scene.points:
        at = scene.points[place.text].body, scene.points[place.text].point
    else:
        at = place.text, scene.bodies[place.text].center_of_mass
    origin = place.along, ORIGIN
    told = position_of(scene, arrays, *at) - position_of(scene, arrays, *origin)
    if place.is_rate:
        turning = cross(arrays["angular_velocity"][:, place_in(scene, place.along)], told)
        told = velocity_of(scene, arrays, *at) - velocity_of(scene, arrays, *origin) - turning
    turn = rotation_matrix(arrays["quaternion"][:, place_in(scene, place.along)])
    return np.asarray((told[:, None, :] @ turn)[:, 0, "xyz".index(place.axis[-1])])


def place_in(scene: Description, body: str) -> int:
    """The column of a body in the core's channels of bodies."""
    return list(scene.bodies).index(body)


def _lever(scene: Description, arrays: Mapping[str, Array], body: str, point: ArrayLike) -> Array:
    """From the centre of mass of a body to a point of it, inertial frame, m."""
    in_body = np.asarray(point, float) - np.asarray(scene.bodies[body].center_of_mass)
    return _core.turned(arrays["quaternion"][:, place_in(scene, body)], in_body)


def wrapped(angle: Array) -> Array:
    """The same directions between -pi and pi."""
    return angle - 2.0 * np.pi * np.floor(angle / (2.0 * np.pi) + 0.5)


def coordinate_at(scene: Description, joint: str, coordinate: str, pose: Callable[[str], Pose]) -> Array:
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


def _side(scene: Description, body: str, frame: _core.Frame, pose: Callable[[str], Pose]) -> Pose:
    """The joint's point (n, 3) and axes (n, 3, 3) on a body, inertial frame."""
    if body not in scene.bodies:
        return frame.point[None], frame.axes[None]
    centre, turn = pose(body)
    return centre + turn @ (frame.point - scene.bodies[body].center_of_mass), turn @ frame.axes


def start_pose(scene: Description, model: _core.Model, body: str) -> Pose:
    """Centre of mass (1, 3) and rotation (1, 3, 3) of a body at the assembled start."""
    index = place_in(scene, body)
    size = model.twist_index(0) // len(scene.bodies)
    values = np.asarray(model.initial_state)[size * index : size * (index + 1)]
    turn = rotation_matrix(values[3:]) if size == 7 else euler_matrix(values[3:])
    floating = any(vessel.body == body for vessel in scene.vessels.values())
    lever = scene.bodies[body].center_of_mass if floating else np.zeros(3)
    return (values[:3] + turn @ lever)[None], turn[None]
