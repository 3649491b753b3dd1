"""Joint records to constraint rows, joint coordinates and reaction points."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .constraint_rows import ConstraintRows
from .kinematics import BodyVectors, Motion, VectorMotion
from .reference_curves import ReferenceCurve
from .rotation import Array, cross, dot

JOINT_ROWS = {
    "weld": 6,
    "revolute": 5,
    "prismatic": 5,
    "cylindrical": 4,
    "universal": 4,
    "spherical": 3,
    "planar": 3,
    "distance": 1,
    "free": 0,
}
MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
SMALL = 1e-9


@dataclass(frozen=True)
class Joint:
    """A joint of the compiled system.

    `p1`, `p2` are the body-vector indices of its point on either body, `axis` that of its axis on the first
    body, `t1`, `t2` those of the perpendicular vectors on either body that measure its angle; -1 if it has
    none.
    """

    name: str
    kind: str
    index: int
    first: int
    second: int
    p1: int
    p2: int
    axis: int
    t1: int
    t2: int
    coordinate_start: float

    @property
    def reaction_point(self) -> int:
        """Point of the reaction: on the second body for a distance joint, else on the first."""
        return self.p2 if self.kind == "distance" else self.p1


def unit(values: Any, name: str) -> Array:
    """Unit vector of three numbers."""
    vector = np.asarray(values, dtype=float)
    length = float(np.linalg.norm(vector)) if vector.shape == (3,) else float("nan")
    if not (np.isfinite(length) and length > 0.0):
        raise ValueError(f"{name} = {values!r} must hold three finite numbers, not all zero")
    return vector / length


def perpendicular_pair(axis: Array) -> tuple[Array, Array]:
    """Two unit vectors that complete the axis to a right-handed triad (t1 x t2 = axis)."""
    t1 = cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    t1 /= np.linalg.norm(t1)
    return t1, cross(axis, t1)


def add_joint(
    record: Mapping[str, Any],
    index: int,
    bodies: Mapping[str, int],
    start: Motion,
    vectors: BodyVectors,
    rows: ConstraintRows,
) -> Joint:
    """Register the vectors and rows of one joint record (schema: `system` module)."""
    name, kind = str(record["name"]), str(record["kind"])
    if kind not in JOINT_ROWS:
        raise ValueError(f"joint {name!r}: kind {kind!r} is unknown; use one of {sorted(JOINT_ROWS)}")
    first, second = body_index(record.get("first"), bodies, name), body_index(record["second"], bodies, name)
    if first == second:
        raise ValueError(f"joint {name!r} joins body {record['second']!r} to itself")
    point = np.asarray(record["point"], dtype=float)
    second_point = record.get("second_point")
    other = point if second_point is None else np.asarray(second_point, dtype=float)

    def on(body: int, vector: Any) -> int:
        return vectors.add(body, start.rotation[body], vector)

    p1, p2 = on(first, point - start.r[first]), on(second, other - start.r[second])
    axis = t1 = t2 = -1
    if kind in ("weld", "spherical", "universal", "revolute"):
        rows.add("coincide", index, first, second, p1, p2)
    if kind == "weld":
        e = np.eye(3)
        for i, j in ((0, 1), (1, 2), (2, 0)):
            rows.add("perpendicular", index, first, second, on(first, e[i]), on(second, e[j]))
    elif kind == "distance":
        length = float(record.get("length", np.linalg.norm(other - point)))
        if not length > 0.0:
            raise ValueError(f"joint {name!r}: length = {length} must be positive; set second_point")
        rows.add("distance", index, first, second, p1, p2, length)
    elif kind == "universal":
        a1, a2 = unit(record["axis"], f"{name} axis"), unit(record["second_axis"], f"{name} second_axis")
        if abs(float(a1 @ a2)) > SMALL:
            raise ValueError(
                f"joint {name!r}: axis . second_axis = {a1 @ a2:.3g}; they must be perpendicular"
            )
        rows.add("perpendicular", index, first, second, on(first, a1), on(second, a2))
    elif kind in ("revolute", "prismatic", "cylindrical", "planar"):
        a = unit(record["axis"], f"{name} axis")
        b1, b2 = perpendicular_pair(a)
        axis, t1, t2 = on(first, a), on(first, b1), on(second, b1)
        u2, along = on(first, b2), on(second, a)
        rows.add("perpendicular", index, first, second, t1, along)
        rows.add("perpendicular", index, first, second, u2, along)
        if kind == "prismatic":
            rows.add("perpendicular", index, first, second, u2, t2)
        if kind in ("prismatic", "cylindrical"):
            for across, direction in ((t1, b1), (u2, b2)):
                rows.add("slide", index, first, second, p1, p2, across, float(direction @ (other - point)))
        if kind == "planar":
            rows.add("slide", index, first, second, p1, p2, axis, float(a @ (other - point)))
    coordinate = float(record.get("coordinate", 0.0))
    return Joint(name, kind, index, first, second, p1, p2, axis, t1, t2, coordinate)


def body_index(name: Any, bodies: Mapping[str, int], owner: str) -> int:
    """Index of a body by name; None or "ground" is the fixed ground (the index after the last body)."""
    if name is None or name == "ground":
        return len(bodies)
    if name not in bodies:
        raise ValueError(f"{owner!r}: body {name!r} is unknown; use one of {sorted(bodies)} or 'ground'")
    return bodies[name]


def add_driver(
    joint: Joint,
    motion: str | None,
    curve: ReferenceCurve,
    start: Motion,
    vectors: BodyVectors,
    rows: ConstraintRows,
) -> None:
    """Prescribe the coordinate of a revolute or prismatic joint, or one motion of a free joint to the
    ground.
    """
    first, second = joint.first, joint.second
    if joint.kind == "revolute":
        row = rows.add(
            "spin", joint.index, first, second, joint.axis, joint.t1, joint.t2, joint.coordinate_start
        )
        rows.drive(row, curve, is_angle=True)
    elif joint.kind == "prismatic":
        offset = start_extension(joint, start, vectors) - joint.coordinate_start
        row = rows.add("slide", joint.index, first, second, joint.p1, joint.p2, joint.axis, offset)
        rows.drive(row, curve, is_angle=False)
    elif joint.kind == "free" and motion in MOTIONS:
        if first != len(start.r) - 1:
            raise ValueError(
                f"driver of {joint.name!r}: the first body of a driven free joint must be the ground"
            )
        k = MOTIONS.index(motion)
        if k < 3:
            axis = vectors.add(first, start.rotation[first], np.eye(3)[k])
            row = rows.add("slide", joint.index, first, second, joint.p1, joint.p2, axis, 0.0)
        else:
            row = rows.add("attitude", joint.index, first, second, k)
        rows.drive(row, curve, is_angle=k >= 3)
    else:
        raise ValueError(
            f"driver of {joint.name!r} ({joint.kind}, motion {motion!r}): drive a revolute or prismatic "
            f"joint, or a free one with motion one of {list(MOTIONS)}"
        )


def start_extension(joint: Joint, start: Motion, vectors: BodyVectors) -> float:
    """Distance along the axis between the joint's points in the start pose."""
    p1, p2, a = (
        start.rotation[vectors.owners[i]] @ vectors.local[i] for i in (joint.p1, joint.p2, joint.axis)
    )
    return float(a @ (start.r[joint.second] + p2 - start.r[joint.first] - p1))


class JointCoordinates:
    """Coordinates and rates of revolute (angle) and prismatic, cylindrical (distance) joints."""

    def __init__(self, joints: list[Joint], start: Motion, vectors: BodyVectors) -> None:
        self.joints = [j for j in joints if j.kind in ("revolute", "prismatic", "cylindrical")]
        self.names = [j.name for j in self.joints]
        self.first = np.array([j.first for j in self.joints], dtype=int)
        self.second = np.array([j.second for j in self.joints], dtype=int)
        self.is_angle = np.array([j.kind == "revolute" for j in self.joints], dtype=bool)
        self.p1, self.p2, self.axis, self.t1, self.t2 = (
            np.array([getattr(j, key) for j in self.joints], dtype=int)
            for key in ("p1", "p2", "axis", "t1", "t2")
        )
        self.offset = np.array(
            [
                -j.coordinate_start
                if j.kind == "revolute"
                else start_extension(j, start, vectors) - j.coordinate_start
                for j in self.joints
            ]
        )

    def evaluate(self, x: VectorMotion) -> tuple[Array, Array]:
        """Coordinates (angles within pi of minus the offset) and rates, one per joint in `names`."""
        if not self.joints:
            return np.zeros(0), np.zeros(0)
        a, t1, t2 = x.g[self.axis], x.g[self.t1], x.g[self.t2]
        angle = np.arctan2(dot(a, cross(t1, t2)), dot(t1, t2))
        angle_rate = dot(a, x.motion.w[self.second] - x.motion.w[self.first])
        d = x.point(self.p2) - x.point(self.p1)
        d_rate = x.point_velocity(self.p2) - x.point_velocity(self.p1)
        distance, distance_rate = dot(a, d), dot(a, d_rate) + dot(x.rate[self.axis], d)
        return (
            np.where(self.is_angle, angle, distance) - self.offset,
            np.where(self.is_angle, angle_rate, distance_rate),
        )
