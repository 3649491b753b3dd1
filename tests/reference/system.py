"""Rigid bodies, joints, forces and one vessel from plain records; accelerations and multipliers by eq. (35).

Schema of the records (SI, radians; points and axes in the inertial frame in the start pose; "ground" or null
is the fixed ground):

``gravity``        [gx, gy, gz]; not applied to the vessel's body
``bodies``         {name, mass, inertia (3x3 about the centre of mass, body axes), position (centre of mass),
                   quaternion (w, x, y, z, body to inertial), gravity? (false: no weight)}, at rest
``joints``         {kind, name, first, second, point, axis?, second_axis?, second_point?, length?}: weld,
                   revolute, prismatic, universal (`second_axis` is fixed on the second body), spherical,
                   distance (from `point` to `second_point`, `length` defaulting to their distance)
``actuators``      {joint, stiffness, damping, feedforward, reference (curve)}; load on the second body along
                   (about) the axis: stiffness (ref - s) + damping (refdot - sdot) + feedforward
``point_forces``   {body, point, force ([fx, fy, fz] in the inertial frame)}
``vessel``         {body, reference_point, added_mass, damping, restoring (6x6 at the reference point,
                   yaw-following frame), quadratic_roll_damping, station_keeping {stiffness [kx, ky, kpsi],
                   damping [...]}, memory {blocks: [{inputs, outputs, A, B, C, D}]} (0-based motions),
                   waves {omega (k), force_real (k, 6), force_imag (k, 6)} for Re sum F_k exp(i omega_k t)}

Curves are described in `reference_curves`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from .constraint_rows import ConstraintRows, RowValues
from .forces import Actuators, PointForces
from .joints import JointCoordinates, add_joint
from .kinematics import BodyVectors, Motion, VectorMotion
from .rotation import Array, cross, nearest_rotation
from .vessel import Vessel, VesselLoads, WaveLoads


@dataclass(frozen=True)
class Evaluation:
    """Accelerations (6 n) and multipliers (m) at one state, and what they came from."""

    acceleration: Array
    multipliers: Array
    rows: RowValues
    actuator_loads: Array
    vectors: VectorMotion
    vessel: VesselLoads


class System:
    """Compiled from the records of the module's description; `wave_loads` (t -> 6) replaces vessel.waves."""

    def __init__(self, records: Mapping[str, Any], wave_loads: WaveLoads | None = None) -> None:
        bodies = list(records["bodies"])
        self.body_names = [str(b["name"]) for b in bodies]
        index = {name: i for i, name in enumerate(self.body_names)}
        self.mass = np.array([float(b["mass"]) for b in bodies])
        self.inertia = np.array([b["inertia"] for b in bodies], dtype=float).reshape(-1, 3, 3)
        at_rest = np.zeros((len(bodies) + 1, 3))
        turned = [b["quaternion"] for b in bodies]
        self.start = Motion(
            np.array([*(b["position"] for b in bodies), np.zeros(3)], dtype=float),
            np.array([*Rotation.from_quat(np.roll(turned, -1, axis=1)).as_matrix(), np.eye(3)]),
            at_rest, at_rest.copy(),
        )  # fmt: skip
        self.vectors = BodyVectors()
        self.rows = ConstraintRows(len(bodies))
        self.joints = [
            add_joint(record, k, index, self.start, self.vectors, self.rows)
            for k, record in enumerate(records["joints"])
        ]
        self.joint_names = [j.name for j in self.joints]
        self.coordinates = JointCoordinates(self.joints)
        self.actuators = Actuators(records.get("actuators", []), self.coordinates)
        self.point_forces = PointForces(records.get("point_forces", []), index, self.start, self.vectors)
        weighing, at = (
            np.array([bool(b.get("gravity", True)) for b in bodies]), index[records["vessel"]["body"]]
        )  # fmt: skip
        self.vessel = Vessel(records["vessel"], at, self.start, self.vectors, wave_loads)
        weighing[at] = False
        self.weight = np.outer(self.mass * weighing, np.asarray(records["gravity"], dtype=float))
        self.rows.freeze()
        self.vectors.freeze()
        self.memory_states = len(self.vessel.memory.a)
        self.breaks = sorted({b for curve in self.actuators.curves for b in curve.breaks})
        linear = 6 * np.arange(len(self.mass))[:, None] + np.arange(3)
        self._linear_diagonal = (linear.ravel(), linear.ravel())
        self._angular = ((linear + 3)[:, :, None], (linear + 3)[:, None, :])
        x = self.vectors.evaluate(self.start)
        mass, _ = self._mass_matrix(self.start, self.vessel.loads(0.0, x, np.zeros(self.memory_states)))
        # rank counts in the mass metric
        whitened = np.linalg.solve(np.linalg.cholesky(mass), self.matrix(self.rows.evaluate(x)).T)
        sigma = np.linalg.svd(whitened / np.linalg.norm(whitened, axis=0), compute_uv=False)
        self.rank = int(np.sum(sigma > 1e-10 * sigma[0]))

    def matrix(self, values: RowValues) -> Array:
        """D (m, 6 n) without the ground's columns."""
        return values.matrix[:, :-1].reshape(self.rows.count, 6 * len(self.mass))

    def _mass_matrix(self, motion: Motion, vessel: VesselLoads) -> tuple[Array, Array]:
        """Mass matrix (6 n, 6 n) with the added mass, and inertias J (n, 3, 3) in the inertial frame."""
        n = len(self.mass)
        mass = np.zeros((6 * n, 6 * n))
        mass[self._linear_diagonal] = np.repeat(self.mass, 3)
        rotation = motion.rotation[:-1]
        j = rotation @ self.inertia @ rotation.transpose(0, 2, 1)
        mass[self._angular] = j
        k = 6 * self.vessel.body
        mass[k : k + 6, k : k + 6] += vessel.inertia
        return mass, j

    def evaluate(self, t: float, motion: Motion, memory: Array) -> Evaluation:
        """Accelerations and multipliers at one state."""
        x = self.vectors.evaluate(motion)
        values = self.rows.evaluate(x)
        vessel = self.vessel.loads(t, x, memory)
        mass, j = self._mass_matrix(motion, vessel)
        w = motion.w[:-1]
        wrench = np.zeros((len(self.mass) + 1, 6))
        wrench[:-1, :3] = self.weight
        wrench[:-1, 3:] = -cross(w, np.matmul(j, w[:, :, None])[:, :, 0])
        loads = self.actuators.loads(t, *self.coordinates.evaluate(x))
        self.actuators.apply(loads, x, wrench)
        self.point_forces.apply(x, wrench)
        wrench[self.vessel.body] += vessel.wrench
        acceleration, multipliers = self.solve(mass, values, wrench[:-1].ravel(), values.gamma)
        return Evaluation(acceleration, multipliers, values, loads, x, vessel)

    def solve(self, mass: Array, values: RowValues, force: Array, gamma: Array) -> tuple[Array, Array]:
        """[M, -D^T; D, 0] [a; lambda] = [f; gamma], eqs. (9) and (35): pivoted LU of the whole system after
        scaling by the diagonal of the mass matrix and by row length."""
        rows, n, m = self.matrix(values), len(mass), self.rows.count
        s = 1.0 / np.sqrt(np.diagonal(mass))
        scaled = rows * s
        e = 1.0 / np.sqrt(np.einsum("ij,ij->i", scaled, scaled))
        scaled *= e[:, None]
        system = np.zeros((n + m, n + m))
        system[:n, :n] = mass * s * s[:, None]
        system[:n, n:] = -scaled.T
        system[n:, :n] = scaled
        solution = np.linalg.solve(system, np.concatenate([s * force, e * gamma]))
        return s * solution[:n], e * solution[n:]

    def reactions(self, e: Evaluation) -> tuple[Array, Array]:
        """Force and moment (joints, 3) on the second body, inertial frame, at the joint's point."""
        count = len(self.joints)
        wrench = np.zeros((count, 6))
        rows = np.arange(self.rows.count)
        loads = e.rows.matrix[rows, self.rows.second_of_row] * e.multipliers[:, None]
        np.add.at(wrench, self.rows.joint_of_row, loads)
        force, moment = wrench[:, :3], wrench[:, 3:]
        points = np.array([j.reaction_point for j in self.joints])
        second = np.array([j.second for j in self.joints])
        return force, moment + cross(e.vectors.motion.r[second] - e.vectors.point(points), force)

    def project(self, t: float, motion: Motion, memory: Array) -> Motion:
        """Nearest motion, in the mass metric, that satisfies the constraints on position and velocity."""
        out = motion.copy()
        out.rotation[:-1] = nearest_rotation(out.rotation[:-1])
        best, zero = np.inf, np.zeros(6 * len(self.mass))
        for _ in range(12):
            x = self.vectors.evaluate(out)
            values = self.rows.evaluate(x)
            mass, _j = self._mass_matrix(out, self.vessel.loads(t, x, memory))
            error = float(np.max(np.abs(values.residual)))
            if error < 1e-13 or error > 0.5 * best:
                break
            best = error
            steps = self.solve(mass, values, zero, -values.residual)[0].reshape(-1, 6)
            out.r[:-1] += steps[:, :3]
            out.rotation[:-1] = Rotation.from_rotvec(steps[:, 3:]).as_matrix() @ out.rotation[:-1]
        if not error < 1e-7:
            raise ValueError(f"the joints do not close at t = {t} s: residual {error:.3g} m or rad")
        step = self.solve(mass, values, zero, -self.matrix(values) @ out.twists())[0].reshape(-1, 6)
        out.v[:-1] += step[:, :3]
        out.w[:-1] += step[:, 3:]
        return out
