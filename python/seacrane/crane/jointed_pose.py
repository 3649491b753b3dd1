"""Where the bodies of a jointed crane are at values of its coordinates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.jointed_data import FREEDOMS, JointData, JointedData
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.one_thread import one_thread

Array = NDArray[np.float64]
CLOSED = 1e-8  # of the crane's extent: gap of a loop that counts as closed
POLISHED = 3
UNITS = {"revolute": "rad", "prismatic": "m"}


@dataclass(frozen=True, eq=False)
class Moved:
    """A rigid motion from home: x to rotation x + shift, crane-foot frame, m."""

    rotation: Array
    shift: Array

    def point(self, at: Array) -> Array:
        """Where a point of the home pose is."""
        return np.asarray(self.rotation @ at + self.shift)

    def after(self, other: Moved) -> Moved:
        """The motion `other`, and then this one."""
        return Moved(self.rotation @ other.rotation, self.point(other.shift))


HOME = Moved(np.eye(3), np.zeros(3))


def pose_of(data: JointedData, coordinates: Mapping[str, float]) -> dict[str, Moved]:
    """Motion of every body from home.

    Coordinates that are not given stay at home; those of a loop follow the ones that are given.

    Raises SceneError for an unknown coordinate, a value out of its range, or a loop that cannot close.
    """
    given = _given(data, coordinates)
    start = {joint.name: np.zeros(FREEDOMS[joint.kind]) for joint in data.joints} | given
    if not data.closing_joints:
        return _motions(data, start)
    from scipy.optimize import least_squares

    looped = _in_loops(data)
    free = [one for one in data.joints if FREEDOMS[one.kind] and one.name in looped - given.keys()]
    sizes = np.cumsum([FREEDOMS[joint.kind] for joint in free])[:-1]

    def filled(values: Array) -> dict[str, Array]:
        return start | {joint.name: part for joint, part in zip(free, np.split(values, sizes), strict=True)}

    def gaps(values: Array) -> Array:
        moved = _motions(data, filled(values))
        return np.concatenate([_gap(joint, moved) for joint in data.closing_joints])

    count = sum(FREEDOMS[joint.kind] for joint in free)
    with one_thread:
        found = least_squares(gaps, np.zeros(count), xtol=1e-15, ftol=1e-15, gtol=1e-15)
        values = found.x
        for _ in range(POLISHED):  # the search ends where its steps are small, Newton's where the gaps are
            values = values - np.linalg.lstsq(found.jac, gaps(values), rcond=None)[0]
    worst, extent = float(np.abs(gaps(values)).max()), extent_of(data)
    if worst > CLOSED * extent:
        asked = ", ".join(f"{label} {value:g}" for label, value in coordinates.items()) or "its home pose"
        raise SceneError(
            f"crane {data.name!r}: its loops stay open by {worst:.3g} m with {asked}; give values that its "
            "closing joints allow"
        )
    return _motions(data, filled(values))


def _in_loops(data: JointedData) -> set[str]:
    """Joints of the tree between the bodies of a closing joint."""
    carrier = {joint.second: joint for joint in data.joints}

    def inwards(body: str) -> set[str]:
        found = set()
        while body in carrier:
            found.add(carrier[body].name)
            body = carrier[body].first
        return found

    return {name for one in data.closing_joints for name in inwards(one.first) ^ inwards(one.second)}


def extent_of(data: JointedData) -> float:
    """Largest distance between its joints, tip and centres of mass, m; 1 where there is none."""
    points = [joint.point for joint in (*data.joints, *data.closing_joints)]
    points += [data.tip[1], *(body.properties.center_of_mass for body in data.bodies), np.zeros(3)]
    found = np.array(points)
    return float(np.linalg.norm(found.max(axis=0) - found.min(axis=0))) or 1.0


def _given(data: JointedData, coordinates: Mapping[str, float]) -> dict[str, Array]:
    """Values by the names of joints."""
    known, joints = data.coordinates, {joint.name: joint for joint in data.joints}
    found = {}
    for label, given in coordinates.items():
        if label not in known:
            raise SceneError(
                f"crane {data.name!r}: has no coordinate {label!r}; it has "
                f"{', '.join(map(repr, known)) or 'none'}"
            )
        joint = joints[known[label]]
        value = number_of(f"crane {data.name!r}: {label}", given)
        low, high = joint.range or (-np.inf, np.inf)
        if not (np.isfinite(value) and low <= value <= high):
            raise SceneError(
                f"crane {data.name!r}: {label} is {value:g} {UNITS[joint.kind]}, outside its range of "
                f"{low:g} to {high:g}; give one within"
            )
        found[joint.name] = np.array([value])
    return found


def _motions(data: JointedData, values: Mapping[str, Array]) -> dict[str, Moved]:
    moved = {data.root: HOME}
    for joint in data.joints:
        moved[joint.second] = moved[joint.first].after(_motion(joint, values[joint.name]))
    return moved


def _motion(joint: JointData, values: Array) -> Moved:
    """The motion of the second body relative to the first one."""
    if joint.kind == "prismatic":
        assert joint.axis is not None
        return Moved(np.eye(3), values[0] * joint.axis)
    turn = np.eye(3)
    for vector in _turns(joint, values):
        turn = turn @ turned(vector)
    return Moved(turn, joint.point - turn @ joint.point)


def _turns(joint: JointData, values: Array) -> Sequence[Array]:
    """Rotation vectors, one after the other."""
    if joint.kind == "spherical":
        return [values]
    axes = [axis for axis in (joint.axis, joint.second_axis) if axis is not None]
    return [value * axis for value, axis in zip(values, axes, strict=False)]


def turned(vector: Array) -> Array:
    """Rotation matrix (3, 3) of a rotation vector (3,), rad: Rodrigues' formula."""
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross))


def _gap(joint: JointData, moved: Mapping[str, Moved]) -> Array:
    """What keeps a closing joint from fitting: m, and sines of angles."""
    first, second = moved[joint.first], moved[joint.second]
    apart = second.point(joint.point) - first.point(joint.point)
    if joint.kind == "spherical":
        return apart
    assert joint.axis is not None
    if joint.second_axis is not None:
        return np.append(apart, (first.rotation @ joint.axis) @ (second.rotation @ joint.second_axis))
    return np.concatenate([apart, np.cross(first.rotation @ joint.axis, second.rotation @ joint.axis)])
