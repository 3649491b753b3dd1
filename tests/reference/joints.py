"""Joint records to constraint rows, joint coordinates and reaction points."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy import vecdot as dot

from .constraint_rows import ConstraintRows
from .kinematics import BodyVectors, Motion, VectorMotion
from .rotation import Array, cross


@dataclass(frozen=True)
class Joint:
    """Indices of body vectors: its point on either body, its axis on the first, and the vectors across that
    measure its angle; -1: none. `offset` is how far apart its points are along the axis at the start."""

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
    offset: float

    @property
    def reaction_point(self) -> int:
        """On the second body for a distance joint, else on the first."""
        return self.p2 if self.kind == "distance" else self.p1


def add_joint(
    record: Mapping[str, Any], index: int, bodies: Mapping[str, int], start: Motion, vectors: BodyVectors,
    rows: ConstraintRows,
) -> Joint:  # fmt: skip
    """Register the vectors and rows of one joint record (schema: `system` module)."""
    name, kind = str(record["name"]), str(record["kind"])
    first, second = body_index(record.get("first"), bodies), body_index(record["second"], bodies)
    point = np.asarray(record["point"], dtype=float)
    other = np.asarray(record.get("second_point", point), dtype=float)

    def on(body: int, vector: Any) -> int:
        return vectors.add(body, start.rotation[body], vector)

    p1, p2 = on(first, point - start.r[first]), on(second, other - start.r[second])
    axis = t1 = t2 = -1
    offset = 0.0
    if kind in ("weld", "spherical", "universal", "revolute"):
        rows.add("coincide", index, first, second, p1, p2)
    if kind == "weld":
        e = np.eye(3)
        for i, j in ((0, 1), (1, 2), (2, 0)):
            rows.add("perpendicular", index, first, second, on(first, e[i]), on(second, e[j]))
    elif kind == "distance":
        length = float(record.get("length", np.linalg.norm(other - point)))
        rows.add("distance", index, first, second, p1, p2, length)
    elif kind == "universal":
        a1, a2 = unit(record["axis"]), unit(record["second_axis"])
        rows.add("perpendicular", index, first, second, on(first, a1), on(second, a2))
    elif kind in ("revolute", "prismatic"):
        a = unit(record["axis"])
        b1 = cross(a, np.eye(3)[int(np.argmin(np.abs(a)))])
        b1 /= np.linalg.norm(b1)
        b2 = cross(a, b1)
        axis, t1, t2 = on(first, a), on(first, b1), on(second, b1)
        u2, along = on(first, b2), on(second, a)
        rows.add("perpendicular", index, first, second, t1, along)
        rows.add("perpendicular", index, first, second, u2, along)
        if kind == "prismatic":
            offset = float(a @ (other - point))
            rows.add("perpendicular", index, first, second, u2, t2)
            for across, direction in ((t1, b1), (u2, b2)):
                rows.add("slide", index, first, second, p1, p2, across, float(direction @ (other - point)))
    return Joint(name, kind, index, first, second, p1, p2, axis, t1, t2, offset)


def unit(values: Any) -> Array:
    vector = np.asarray(values, dtype=float)
    return np.asarray(vector / np.linalg.norm(vector))


def body_index(name: Any, bodies: Mapping[str, int]) -> int:
    """None or "ground" is the fixed ground, the index after the last body."""
    return len(bodies) if name in (None, "ground") else bodies[name]


class JointCoordinates:
    """Coordinates and rates of revolute (angle) and prismatic (distance) joints, zero at the start."""

    def __init__(self, joints: list[Joint]) -> None:
        self.joints = [j for j in joints if j.kind in ("revolute", "prismatic")]
        self.names = [j.name for j in self.joints]
        self.is_angle = np.array([j.kind == "revolute" for j in self.joints], dtype=bool)
        self.first, self.second, self.p1, self.p2, self.axis, self.t1, self.t2 = (
            np.array([getattr(j, key) for j in self.joints], dtype=int)
            for key in ("first", "second", "p1", "p2", "axis", "t1", "t2")
        )
        self.offset = np.array([j.offset for j in self.joints])

    def evaluate(self, x: VectorMotion) -> tuple[Array, Array]:
        """Coordinates (angles within pi) and rates, one per joint in `names`."""
        if not self.joints:
            return np.zeros(0), np.zeros(0)
        a, t1, t2 = x.g[self.axis], x.g[self.t1], x.g[self.t2]
        angle = np.arctan2(dot(a, cross(t1, t2)), dot(t1, t2))
        angle_rate = dot(a, x.motion.w[self.second] - x.motion.w[self.first])
        d = x.point(self.p2) - x.point(self.p1)
        d_rate = x.point_velocity(self.p2) - x.point_velocity(self.p1)
        distance_rate = dot(a, d_rate) + dot(x.rate[self.axis], d)
        coordinate = np.where(self.is_angle, angle, dot(a, d)) - self.offset
        return coordinate, np.where(self.is_angle, angle_rate, distance_rate)
