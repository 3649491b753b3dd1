"""Force elements: state feedback on joint coordinates, linear spring-dampers, point forces.

Each adds wrenches (force; moment about the centre of mass, inertial frame) to an array (n + 1, 6) and returns
the power of its non-conservative part and its potential energy.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from . import reference_curves
from .constraint_rows import wrap
from .joints import Joint, JointCoordinates, body_index
from .kinematics import BodyVectors, Motion, VectorMotion
from .rotation import Array, cross, dot


class Actuators:
    """Load K (ref - s) + D (refdot - sdot) + feedforward on the second body along (about) the joint axis."""

    def __init__(
        self, records: Sequence[Mapping[str, Any]], joints: Mapping[str, Joint], coordinates: JointCoordinates
    ) -> None:
        self.names = [str(r["joint"]) for r in records]
        for name in self.names:
            if name not in coordinates.names:
                raise ValueError(f"actuator on {name!r}: not a revolute, prismatic or cylindrical joint")
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
        reference = np.array([curve(t)[:2] for curve in self.curves])
        error = reference[:, 0] - s[self.slot]
        error = np.where(self.is_angle, [wrap(e) for e in error], error)
        error_rate = reference[:, 1] - s_rate[self.slot]
        forward = np.array([curve(t)[0] for curve in self.feedforward])
        return np.asarray(self.stiffness * error + self.damping * error_rate + forward)

    def apply(self, loads: Array, s_rate: Array, x: VectorMotion, wrench: Array) -> float:
        """Add the loads, equal and opposite on the same line; returns their power."""
        if not self.curves:
            return 0.0
        along = loads[:, None] * x.g[self.axis]
        force = np.where(self.is_angle[:, None], 0.0, along)
        couple = np.where(self.is_angle[:, None], along, 0.0)
        point, r = x.point(self.p1), x.motion.r
        for body, sign in ((self.second, 1.0), (self.first, -1.0)):
            moment = couple + cross(point - r[body], force)
            np.add.at(wrench, body, sign * np.concatenate([force, moment], axis=1))
        return float(loads @ s_rate[self.slot])


class Springs:
    """Linear spring-dampers between two points; tension positive."""

    def __init__(
        self,
        records: Sequence[Mapping[str, Any]],
        bodies: Mapping[str, int],
        start: Motion,
        vectors: BodyVectors,
    ) -> None:
        ends = []
        for r in records:
            pair = []
            for side in ("first", "second"):
                body = body_index(r.get(side), bodies, "spring")
                point = np.asarray(r[f"{side}_point"], dtype=float)
                pair.append((body, vectors.add(body, start.rotation[body], point - start.r[body])))
            ends.append(pair)
        self.first, self.i1, self.second, self.i2 = (
            np.array([e[k // 2][k % 2] for e in ends], dtype=int) for k in range(4)
        )
        self.stiffness = np.array([float(r["stiffness"]) for r in records])
        self.damping = np.array([float(r.get("damping", 0.0)) for r in records])
        self.rest = np.array([float(r["rest_length"]) for r in records])

    def apply(self, x: VectorMotion, wrench: Array) -> tuple[float, float]:
        """Add the loads; returns (power of damping, elastic energy)."""
        if not len(self.rest):
            return 0.0, 0.0
        d = x.point(self.i2) - x.point(self.i1)
        length = np.sqrt(dot(d, d))
        e = d / length[:, None]
        rate = dot(e, x.point_velocity(self.i2) - x.point_velocity(self.i1))
        stretch = length - self.rest
        pull = ((self.stiffness * stretch + self.damping * rate)[:, None]) * e
        for body, index, sign in ((self.first, self.i1, 1.0), (self.second, self.i2, -1.0)):
            load = sign * pull
            np.add.at(wrench, body, np.concatenate([load, cross(x.g[index], load)], axis=1))
        return -float(self.damping @ rate**2), float(0.5 * self.stiffness @ stretch**2)


Force = Callable[[float], Array]


class PointForces:
    """Forces given in the inertial frame, constant or as functions of time, at body-fixed points."""

    def __init__(
        self,
        records: Sequence[Mapping[str, Any]],
        bodies: Mapping[str, int],
        start: Motion,
        vectors: BodyVectors,
    ) -> None:
        self.body = [body_index(r["body"], bodies, "point force") for r in records]
        self.point = [
            vectors.add(b, start.rotation[b], np.asarray(r["point"], dtype=float) - start.r[b])
            for b, r in zip(self.body, records, strict=True)
        ]
        self.force: list[Force] = [self._force(r["force"]) for r in records]

    @staticmethod
    def _force(value: Any) -> Force:
        if callable(value):
            return lambda t: np.asarray(value(t), dtype=float)
        fixed = np.asarray(value, dtype=float)
        if fixed.shape != (3,):
            raise ValueError(f"point force {value!r} must hold three numbers or be a function of time")
        return lambda t: fixed

    def apply(self, t: float, x: VectorMotion, wrench: Array) -> float:
        """Add the loads; returns their power."""
        power = 0.0
        for body, index, force in zip(self.body, self.point, self.force, strict=True):
            f = force(t)
            wrench[body, :3] += f
            wrench[body, 3:] += cross(x.g[index], f)
            power += float(f @ x.point_velocity(index))
        return power
