"""Rigid bodies, joints, forces and one vessel from plain records; accelerations and multipliers by eq. (35).

Schema of `System.from_records` (JSON types; SI, radians; every point and axis is given in the inertial
frame in the start pose; "ground" or null is the fixed ground):

``gravity``        [gx, gy, gz], default [0, 0, -9.81]; not applied to the vessel's body
``bodies``         list of {name, mass, inertia (3x3 about the centre of mass, body axes), position (centre of
                   mass), quaternion (w, x, y, z, body to inertial), velocity?, angular_velocity? (inertial),
                   gravity? (false: no weight)}
``joints``         list of {kind, name, first, second, point, axis?, second_axis?, second_point?, length?,
                   coordinate? (value at the start, default 0)}; kinds: weld revolute prismatic cylindrical
                   universal spherical planar distance free. `point` is the point on the first body and,
                   unless `second_point` is given, on the second too. universal: `axis` is fixed on the
                   first body, `second_axis` on the second. planar: `axis` is the normal, fixed on the
                   first body. distance: from `point` to `second_point`, `length` defaulting to their
                   distance at the start
``drivers``        list of {joint, motion? (free joints: surge sway heave roll pitch yaw; the position of
                   `point` in the inertial frame and yaw-pitch-roll angles), reference (curve)}
``actuators``      list of {joint, stiffness, damping, feedforward, reference (curve)}; the load on the
                   second body along (about) the axis is stiffness (ref - s) + damping (refdot - sdot) +
                   feedforward
``springs``        list of {first, second, first_point, second_point, stiffness, damping, rest_length}
``point_forces``   list of {body, point, force ([fx, fy, fz] in the inertial frame, or a function of time)}
``vessel``         {body, reference_point (default origin), rest_position (default reference_point),
                   added_mass, damping, restoring (6x6 at the reference point, yaw-following frame),
                   quadratic_roll_damping, station_keeping {stiffness [kx, ky, kpsi], damping [...]},
                   constant_load (6, yaw-following), memory {A, B, C, D} or {blocks: [{inputs, outputs, A,
                   B, C, D?}]} (0-based motions), waves {omega (k), force_real (k, 6), force_imag (k, 6)}:
                   F(t) = Re sum F_k exp(i omega_k t)}

Curves are described in `reference_curves`. Unknown keys are refused.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import reference_curves
from .constraint_rows import ConstraintRows, RowValues
from .forces import Actuators, PointForces, Springs
from .joints import JointCoordinates, add_driver, add_joint, body_index
from .kinematics import BodyVectors, Motion, VectorMotion
from .linear_solve import rank, solve_full_rank, solve_redundant
from .rotation import Array, cross, dot, matrix_from_quaternion, nearest_rotation, rotation_exponential
from .vessel import Vessel, VesselLoads, WaveLoads

KEYS = {"gravity", "bodies", "joints", "drivers", "actuators", "springs", "point_forces", "vessel"}
RCOND = 1e-4  # for redundant systems only: see `solve_redundant`


@dataclass(frozen=True)
class Evaluation:
    """Everything known at one state: accelerations (6 n), multipliers (m), and what they came from."""

    acceleration: Array
    multipliers: Array
    rows: RowValues
    memory_rate: Array
    power: float
    energy: float
    actuator_loads: Array
    coordinates: Array
    coordinate_rates: Array
    vectors: VectorMotion
    vessel: VesselLoads | None


class System:
    """Compiled system; build it with `from_records`."""

    def __init__(self, records: Mapping[str, Any], wave_loads: WaveLoads | None = None) -> None:
        unknown = sorted(set(records) - KEYS)
        if unknown:
            raise ValueError(f"records hold unknown keys {unknown}; known are {sorted(KEYS)}")
        bodies = list(records["bodies"])
        self.body_names = [str(b["name"]) for b in bodies]
        index = {name: i for i, name in enumerate(self.body_names)}
        if len(index) != len(bodies) or "ground" in index:
            raise ValueError(f"body names {self.body_names} must differ from each other and from 'ground'")
        self.mass = np.array([float(b["mass"]) for b in bodies])
        self.inertia = np.array([b["inertia"] for b in bodies], dtype=float).reshape(-1, 3, 3)
        for name, mass, inertia in zip(self.body_names, self.mass, self.inertia, strict=True):
            if not mass > 0.0 or not np.allclose(inertia, inertia.T) or np.linalg.eigvalsh(inertia)[0] <= 0.0:
                raise ValueError(f"body {name!r}: mass {mass} and inertia must be positive (definite)")
        self.start = self._start_motion(bodies)
        self.vectors = BodyVectors()
        self.rows = ConstraintRows(len(bodies), self.vectors)
        self.joints = [
            add_joint(record, k, index, self.start, self.vectors, self.rows)
            for k, record in enumerate(records.get("joints", []))
        ]
        self.joint_names = [j.name for j in self.joints]
        by_name = {j.name: j for j in self.joints}
        self.driver_names: list[str] = []
        for record in records.get("drivers", []):
            joint = by_name[record["joint"]]
            curve = reference_curves.from_record(record["reference"])
            add_driver(joint, record.get("motion"), curve, self.start, self.vectors, self.rows)
            self.driver_names.append(
                record["joint"] + (f".{record['motion']}" if record.get("motion") else "")
            )
        self.coordinates = JointCoordinates(self.joints, self.start, self.vectors)
        self.actuators = Actuators(records.get("actuators", []), by_name, self.coordinates)
        self.springs = Springs(records.get("springs", []), index, self.start, self.vectors)
        self.point_forces = PointForces(records.get("point_forces", []), index, self.start, self.vectors)
        self.vessel = self._vessel(records.get("vessel"), index, wave_loads)
        self.weight = self._weights(records, bodies)
        self._finish()

    @classmethod
    def from_records(cls, records: Mapping[str, Any], *, wave_loads: WaveLoads | None = None) -> System:
        """Build from the records of the module's description; `wave_loads` (t -> 6) replaces vessel.waves."""
        return cls(records, wave_loads)

    @staticmethod
    def _start_motion(bodies: list[Mapping[str, Any]]) -> Motion:
        zero = [0.0, 0.0, 0.0]
        r = np.array([*(b["position"] for b in bodies), zero], dtype=float)
        v = np.array([*(b.get("velocity", zero) for b in bodies), zero], dtype=float)
        w = np.array([*(b.get("angular_velocity", zero) for b in bodies), zero], dtype=float)
        rotation = np.array([*(matrix_from_quaternion(b["quaternion"]) for b in bodies), np.eye(3)])
        return Motion(r, rotation, v, w)

    def _vessel(
        self, record: Mapping[str, Any] | None, index: Mapping[str, int], wave_loads: WaveLoads | None
    ) -> Vessel | None:
        if record is None:
            return None
        body = body_index(record["body"], index, "vessel")
        return Vessel(record, body, self.start, self.vectors, wave_loads)

    def _weights(self, records: Mapping[str, Any], bodies: list[Mapping[str, Any]]) -> Array:
        gravity = np.asarray(records.get("gravity", [0.0, 0.0, -9.81]), dtype=float)
        has_weight = np.array([bool(b.get("gravity", True)) for b in bodies])
        if self.vessel is not None:
            has_weight[self.vessel.body] = False
        return np.outer(self.mass * has_weight, gravity)

    def _finish(self) -> None:
        self.rows.freeze()
        self.vectors.freeze()
        n = len(self.mass)
        self.memory_states = 0 if self.vessel is None else len(self.vessel.memory.a)
        curves = [*self.actuators.curves, *(d.curve for d in self.rows.drivers)]
        self.breaks = sorted({b for curve in curves for b in curve.breaks})
        linear = 6 * np.arange(n)[:, None] + np.arange(3)
        self._linear_diagonal = (linear.ravel(), linear.ravel())
        angular = linear + 3
        self._angular = (angular[:, :, None], angular[:, None, :])
        x = self.vectors.evaluate(self.start)
        values = self.rows.evaluate(0.0, x)
        mass, _ = self._mass_matrix(self.start, self._vessel_loads(0.0, x, np.zeros(self.memory_states)))
        self.rank = rank(mass, self.matrix(values))
        self.redundant = self.rank < self.rows.count

    @property
    def degrees_of_freedom(self) -> int:
        """Velocities minus independent constraints (drivers count as constraints)."""
        return 6 * len(self.mass) - self.rank

    def matrix(self, values: RowValues) -> Array:
        """D (m, 6 n) without the ground's columns."""
        return values.matrix[:, :-1].reshape(self.rows.count, 6 * len(self.mass))

    def _vessel_loads(self, t: float, x: VectorMotion, memory: Array) -> VesselLoads | None:
        return None if self.vessel is None else self.vessel.loads(t, x, memory)

    def _mass_matrix(self, motion: Motion, vessel: VesselLoads | None) -> tuple[Array, Array]:
        """Mass matrix (6 n, 6 n) with the added mass, and inertias J (n, 3, 3) in the inertial frame."""
        n = len(self.mass)
        mass = np.zeros((6 * n, 6 * n))
        mass[self._linear_diagonal] = np.repeat(self.mass, 3)
        rotation = motion.rotation[:-1]
        j = rotation @ self.inertia @ rotation.transpose(0, 2, 1)
        mass[self._angular] = j
        if self.vessel is not None and vessel is not None:
            k = 6 * self.vessel.body
            mass[k : k + 6, k : k + 6] += vessel.inertia
        return mass, j

    def evaluate(self, t: float, motion: Motion, memory: Array) -> Evaluation:
        """Accelerations, multipliers, energy and power at one state."""
        x = self.vectors.evaluate(motion)
        values = self.rows.evaluate(t, x)
        vessel = self._vessel_loads(t, x, memory)
        mass, j = self._mass_matrix(motion, vessel)

        w = motion.w[:-1]
        momentum = np.matmul(j, w[:, :, None])[:, :, 0]
        wrench = np.zeros((len(self.mass) + 1, 6))
        wrench[:-1, :3] = self.weight
        wrench[:-1, 3:] = -cross(w, momentum)
        s, s_rate = self.coordinates.evaluate(x)
        loads = self.actuators.loads(t, s, s_rate)
        power = self.actuators.apply(loads, s_rate, x, wrench) + self.point_forces.apply(t, x, wrench)
        spring_power, energy = self.springs.apply(x, wrench)
        power += spring_power
        energy += 0.5 * float(self.mass @ dot(motion.v[:-1], motion.v[:-1]) + np.sum(w * momentum))
        energy -= float(np.sum(self.weight * motion.r[:-1]))
        memory_rate = np.zeros(0)
        if self.vessel is not None and vessel is not None:
            wrench[self.vessel.body] += vessel.wrench
            k = self.vessel.body
            twist = np.concatenate([motion.v[k], motion.w[k]])
            energy += vessel.energy + 0.5 * float(twist @ vessel.inertia @ twist)
            power += vessel.power
            memory_rate = vessel.memory_rate

        acceleration, multipliers = self.solve(mass, values, wrench[:-1].ravel(), values.gamma, RCOND)
        for driver, rate in zip(self.rows.drivers, self.rows.driver_rates(t), strict=True):
            power += multipliers[driver.row] * rate
        return Evaluation(
            acceleration, multipliers, values, memory_rate, power, energy, loads, s, s_rate, x, vessel
        )

    def solve(
        self, mass: Array, values: RowValues, force: Array, gamma: Array, rcond: float
    ) -> tuple[Array, Array]:
        """Solve eq. (35) for one right-hand side."""
        if not self.rows.count:
            return np.asarray(np.linalg.solve(mass, force), dtype=float), np.zeros(0)
        if self.redundant:
            return solve_redundant(mass, self.matrix(values), force, gamma, rcond)
        return solve_full_rank(mass, self.matrix(values), force, gamma)

    def reactions(self, e: Evaluation) -> tuple[Array, Array]:
        """Constraint force and moment (joints, 3) on the second body, inertial frame, at the joint's
        point.
        """
        count = len(self.joints)
        wrench = np.zeros((count + 1, 6))
        rows = np.arange(self.rows.count)
        np.add.at(
            wrench,
            self.rows.joint_of_row,
            e.rows.matrix[rows, self.rows.second_of_row] * e.multipliers[:, None],
        )
        force, moment = wrench[:count, :3], wrench[:count, 3:]
        if count:
            points = np.array([j.reaction_point for j in self.joints])
            second = np.array([j.second for j in self.joints])
            moment = moment + cross(e.vectors.motion.r[second] - e.vectors.point(points), force)
        return force, moment

    def driver_loads(self, e: Evaluation) -> Array:
        """Loads of the drivers on the second body along their coordinates, in the order of `driver_names`."""
        return np.array([e.multipliers[d.row] for d in self.rows.drivers])

    def project(self, t: float, motion: Motion, memory: Array) -> Motion:
        """Nearest motion, in the mass metric, that satisfies the constraints on position and velocity
        level.
        """
        out = motion.copy()
        out.rotation[:-1] = nearest_rotation(out.rotation[:-1])
        if not self.rows.count:
            return out
        best = np.inf
        zero = np.zeros(6 * len(self.mass))
        for _ in range(12):
            x = self.vectors.evaluate(out)
            values = self.rows.evaluate(t, x)
            mass, _j = self._mass_matrix(out, self._vessel_loads(t, x, memory))
            error = float(np.max(np.abs(values.residual)))
            if error < 1e-13 or error > 0.5 * best:
                break
            best = error
            step, _l = self.solve(mass, values, zero, -values.residual, RCOND)
            self._displace(out, step)
        if not error < 1e-7:
            joint = int(self.rows.joint_of_row[int(np.argmax(np.abs(values.residual)))])
            worst = self.joint_names[joint] if joint >= 0 else "driver"
            raise ValueError(f"joint {worst!r} does not close at t = {t} s: residual {error:.3g} m or rad")
        correction, _l = self.solve(mass, values, zero, -values.rate, RCOND)
        step = correction.reshape(-1, 6)
        out.v[:-1] += step[:, :3]
        out.w[:-1] += step[:, 3:]
        return out

    @staticmethod
    def _displace(motion: Motion, step: Array) -> None:
        steps = step.reshape(-1, 6)
        motion.r[:-1] += steps[:, :3]
        motion.rotation[:-1] = rotation_exponential(steps[:, 3:]) @ motion.rotation[:-1]
