"""State feedback on joint coordinates, and forces at points, added to wrenches (n + 1, 6), inertial frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import reference_curves
from .joints import JointCoordinates, body_index
from .kinematics import BodyVectors, Motion, VectorMotion
from .rotation import Array, cross


class Actuators:
    """Load K (ref - s) + D (refdot - sdot) + feedforward on the second body along (about) the joint axis."""

    def __init__(self, records: Sequence[Mapping[str, Any]], coordinates: JointCoordinates) -> None:
        self.names = [str(r["joint"]) for r in records]
        self.slot = np.array([coordinates.names.index(name) for name in self.names], dtype=int)
        self.is_angle = coordinates.is_angle[self.slot]
        self.first, self.second = coordinates.first[self.slot], coordinates.second[self.slot]
        self.axis, self.p1 = coordinates.axis[self.slot], coordinates.p1[self.slot]
        self.stiffness, self.damping = (
            np.array([float(r.get(key, 0.0)) for r in records]) for key in ("stiffness", "damping")
        )
        self.curves, self.feedforward = (
            [reference_curves.from_record(r.get(key, 0.0)) for r in records]
            for key in ("reference", "feedforward")
        )

    def loads(self, t: float, s: Array, s_rate: Array) -> Array:
        """Signed actuator loads, N or N m."""
        if not self.curves:
            return np.zeros(0)
        reference = np.array([curve(t) for curve in self.curves])
        error = reference[:, 0] - s[self.slot]
        error = np.where(self.is_angle, np.remainder(error + np.pi, 2.0 * np.pi) - np.pi, error)
        error_rate = reference[:, 1] - s_rate[self.slot]
        forward = np.array([curve(t)[0] for curve in self.feedforward])
        return np.asarray(self.stiffness * error + self.damping * error_rate + forward)

    def apply(self, loads: Array, x: VectorMotion, wrench: Array) -> None:
        """Add the loads, equal and opposite on the same line."""
        if not self.curves:
            return
        along = loads[:, None] * x.g[self.axis]
        force = np.where(self.is_angle[:, None], 0.0, along)
        couple = along - force
        point, r = x.point(self.p1), x.motion.r
        for body, sign in ((self.second, 1.0), (self.first, -1.0)):
            moment = couple + cross(point - r[body], force)
            np.add.at(wrench, body, sign * np.concatenate([force, moment], axis=1))


class PointForces:
    def __init__(
        self, records: Sequence[Mapping[str, Any]], bodies: Mapping[str, int], start: Motion,
        vectors: BodyVectors,
    ) -> None:  # fmt: skip
        self.at: list[tuple[int, int, Array]] = []
        for r in records:
            body = body_index(r["body"], bodies)
            arm = vectors.add(body, start.rotation[body], np.asarray(r["point"], dtype=float) - start.r[body])
            self.at.append((body, arm, np.asarray(r["force"], dtype=float)))

    def apply(self, x: VectorMotion, wrench: Array) -> None:
        for body, arm, force in self.at:
            wrench[body, :3] += force
            wrench[body, 3:] += cross(x.g[arm], force)
