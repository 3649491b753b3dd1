"""Where the bodies of a crane are at values of its coordinates, and how they move with its joints."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from seacrane.arrays import Array
from seacrane.crane.data import FREEDOMS, HOME, CraneData, JointData, Placed
from seacrane.errors import SceneError
from seacrane.hydro.data.rigid_mass import cross_matrix
from seacrane.inputs.checked import number_of
from seacrane.inputs.plausible import angle_of
from seacrane.one_thread import one_thread

CLOSED = 1e-8  # of the crane's extent: gap of a loop that counts as closed
STEPS, LAST = 10, 6  # of Newton's method: on the way from home, and at the pose
UNITS = {"revolute": "rad", "prismatic": "m"}


@dataclass(frozen=True, eq=False)
class Pose:
    """A crane at values of its coordinates."""

    moved: Mapping[str, Placed]  # motion of every body from home, crane-foot frame
    values: Mapping[str, Array]  # of every joint of the tree, rad and m; of a spherical one its rotation


STILL = np.zeros((3, 4))


def pose_of(data: CraneData, coordinates: Mapping[str, float]) -> Pose:
    """The crane at values of its coordinates, by label or short name.

    Coordinates that are not given stay at home; those of a loop follow the ones that are given, on the way
    from home on which these grow together.

    Raises SceneError for an unknown coordinate, a value out of its range, or a loop that cannot close.
    """
    given = _given(data, coordinates)
    values = {
        one.name: np.eye(3) if one.kind == "spherical" else np.zeros(FREEDOMS[one.kind])
        for one in data.tree.values()
    }
    looped = in_loops(data)
    free = [joint for joint in looped if joint.name not in given]
    steps = STEPS if any(joint.name in given for joint in looped) else 1
    for step in range(1, steps + LAST) if looped else ():
        values |= {name: min(step / steps, 1.0) * value for name, value in given.items()}
        _close(data, free, values)
    values |= given
    moved = _motions(data, values)
    worst = max((float(np.abs(_gap(joint, moved)).max()) for joint in data.closing_joints), default=0.0)
    if not worst <= CLOSED * extent_of(data):
        asked = ", ".join(f"{label} {value:g}" for label, value in coordinates.items()) or "its home pose"
        raise SceneError(
            f"crane {data.name!r}: its loops stay open by {worst:.3g} m with {asked}; give values that its "
            "closing joints allow"
        )
    return Pose(moved, values)


def in_loops(data: CraneData) -> list[JointData]:
    """Joints of the tree between the bodies of a closing joint, that move."""
    carrier = {joint.second: joint for joint in data.tree.values()}

    def inwards(body: str) -> set[str]:
        found = set()
        while body in carrier:
            found.add(carrier[body].name)
            body = carrier[body].first
        return found

    looped = {name for one in data.closing_joints for name in inwards(one.first) ^ inwards(one.second)}
    return [joint for name, joint in data.tree.items() if name in looped and FREEDOMS[joint.kind]]


def extent_of(data: CraneData) -> float:
    """Largest distance between its joints, tip and centres of mass, m; 1 where there is none."""
    points = [joint.point for joint in data.joints]
    points += [data.tip[1], *(body.center for body in data.bodies), np.zeros(3)]
    found = np.array(points)
    return float(np.linalg.norm(found.max(axis=0) - found.min(axis=0))) or 1.0


def twists(joint: JointData, moved: Mapping[str, Placed]) -> list[Array]:
    """Velocities (3, 4) of what is beyond a joint, for each of its coordinates (of a spherical one x, y, z):
    the matrix of its rotation, and in the last column the velocity of what is at the crane foot."""
    first, second = moved[joint.first], moved[joint.second]
    if joint.kind == "prismatic":
        assert joint.axis is not None
        return [np.column_stack([np.zeros((3, 3)), first.axes @ joint.axis])]
    axes = [*np.eye(3)] if joint.kind == "spherical" else []
    axes += [] if joint.axis is None else [first.axes @ joint.axis]
    axes += [] if joint.second_axis is None else [second.axes @ joint.second_axis]
    at = first.point(joint.point)
    return [np.column_stack([cross_matrix(axis), -cross_matrix(axis) @ at]) for axis in axes]


def gap_rates(data: CraneData, joints: Iterable[JointData], moved: Mapping[str, Placed]) -> Array:
    """Rates of the gaps of all closing joints (rows) with the coordinates of joints of the tree.

    A joint that carries both sides of a gap turns it as a whole: that closes nothing, and counts as none.
    """
    columns = []
    for joint in joints:
        beyond = data.beyond(joint.name)
        for twist in twists(joint, moved):
            rows = []
            for one in data.closing_joints:
                sides = [body in beyond for body in (one.first, one.second)]
                if all(sides) or not any(sides):
                    rows.append(np.zeros(3 + len(one.crossing)))
                    continue
                before, after = (twist if own else STILL for own in sides)
                rows.append(_gap_rate(one, moved, before, after))
            columns.append(np.concatenate(rows))
    return np.array(columns).T


def _close(data: CraneData, free: Iterable[JointData], values: dict[str, Array]) -> None:
    """Move free joints by a step of Newton's method."""
    moved = _motions(data, values)
    gaps = np.concatenate([_gap(joint, moved) for joint in data.closing_joints])
    rates = gap_rates(data, free, moved)
    if rates.size == 0 or not np.all(np.isfinite(rates)):
        return
    with one_thread:
        left = np.linalg.lstsq(rates, -gaps, rcond=None)[0]
    for joint in free:
        step, left = np.split(left, [FREEDOMS[joint.kind]])
        if joint.kind == "spherical":
            values[joint.name] = turned(moved[joint.first].axes.T @ step) @ values[joint.name]
        else:
            values[joint.name] = values[joint.name] + step


def _given(data: CraneData, coordinates: Mapping[str, float]) -> dict[str, Array]:
    """Values by the names of joints."""
    found: dict[str, Array] = {}
    for label, given in coordinates.items():
        joint = data.led_by(label)
        if joint.name in found:
            raise SceneError(f"crane {data.name!r}: {label!r} is given under two names; give one of them")
        value = number_of(f"crane {data.name!r}: {label}", given)
        low, high = joint.range or (-np.inf, np.inf)
        if not (np.isfinite(value) and low <= value <= high):
            raise SceneError.of(
                f"crane {data.name!r}: {label}",
                f"is {value:g} {UNITS[joint.kind]}, outside its range of "
                f"{low:g} to {high:g}; give one within",
            )
        if joint.kind == "revolute":
            angle_of(f"crane: {label}", value)
        found[joint.name] = np.array([value])
    return found


def _motions(data: CraneData, values: Mapping[str, Array]) -> dict[str, Placed]:
    moved = {data.root: HOME}
    for joint in data.tree.values():
        moved[joint.second] = moved[joint.first].inner(_motion(joint, values[joint.name]))
    return moved


def _motion(joint: JointData, values: Array) -> Placed:
    """The motion of the second body relative to the first one."""
    if joint.kind == "prismatic":
        assert joint.axis is not None
        return Placed(np.eye(3), values[0] * joint.axis)
    turn = values if joint.kind == "spherical" else np.eye(3)
    for axis, value in zip((joint.axis, joint.second_axis), values, strict=False):
        turn = turn if axis is None else turn @ turned(value * axis)
    return Placed(turn, joint.point - turn @ joint.point)


def turned(vector: Array) -> Array:
    """Rotation matrix (3, 3) of a rotation vector (3,), rad: Rodrigues' formula."""
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return np.eye(3)
    across = cross_matrix(vector / angle)
    return np.asarray(np.eye(3) + np.sin(angle) * across + (1.0 - np.cos(angle)) * (across @ across))


def _gap(joint: JointData, moved: Mapping[str, Placed]) -> Array:
    """What keeps a closing joint from fitting: m, and sines of angles."""
    first, second = moved[joint.first], moved[joint.second]
    sines = [(first.axes @ one) @ (second.axes @ other) for one, other in joint.crossing]
    return np.array([*(second.point(joint.point) - first.point(joint.point)), *sines])


def _gap_rate(joint: JointData, moved: Mapping[str, Placed], before: Array, after: Array) -> Array:
    """The rate of `_gap`, where both bodies move at the twists `before` and `after`."""
    first, second = moved[joint.first], moved[joint.second]
    apart = after @ [*second.point(joint.point), 1.0] - before @ [*first.point(joint.point), 1.0]
    turning = (after - before)[:, :3]
    sines = [(first.axes @ one) @ turning @ (second.axes @ other) for one, other in joint.crossing]
    return np.array([*apart, *sines])
