"""Hydrodynamic loads on a floating body (paper eqs. 24-31 in the frame-consistent form of the design).

With psi the yaw angle, P = blockdiag(Rz(psi), Rz(psi)) and V the inertial twist of the reference point,
u = P^T V, the load on the reference point is

    P ( -A du/dt - B u - b4 |u4| u4 e4 - mu + waves(t) )  +  restoring  +  station keeping,

    x' = Am x + Bm u,   mu = Cm x + Dm u.

Restoring is -grad of 1/2 eta^T C eta, eta = (0, 0, heave, roll, pitch, 0) from rest with yaw-pitch-roll
angles; station keeping -grad of 1/2 (kx x^2 + ky y^2 + kpsi psi^2) with dampers on the rates of x, y and psi.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from .kinematics import BodyVectors, Motion, VectorMotion
from .rotation import Array, angle_rate_matrix, cross, skew

WaveLoads = Callable[[float], Array]
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class MemoryModel:
    """State space with inputs u (6) and outputs mu (6): matrices a (n, n), b (n, 6), c (6, n), d (6, 6)."""

    a: Array
    b: Array
    c: Array
    d: Array

    @classmethod
    def from_record(cls, record: Mapping[str, Any] | None) -> MemoryModel:
        """Blocks with 0-based `inputs` and `outputs`, placed side by side and summed."""
        blocks = record["blocks"] if record else []
        n = sum(len(block["A"]) for block in blocks)
        a, b, c, d = np.zeros((n, n)), np.zeros((n, 6)), np.zeros((6, n)), np.zeros((6, 6))
        first = 0
        for block in blocks:
            inputs, outputs, k = list(block["inputs"]), list(block["outputs"]), len(block["A"])
            here = slice(first, first + k)
            a[here, here] = np.reshape(block["A"], (k, k))
            b[here, inputs] = np.reshape(block["B"], (k, len(inputs)))
            c[outputs, here] = np.reshape(block["C"], (len(outputs), k))
            if block.get("D") is not None:
                d[np.ix_(outputs, inputs)] += np.reshape(block["D"], (len(outputs), len(inputs)))
            first += k
        return cls(a, b, c, d)

    def transfer(self, omega: float) -> np.ndarray[Any, np.dtype[np.complex128]]:
        """Complex retardation function K(i omega) (6, 6)."""
        states = np.linalg.solve(1j * omega * np.eye(len(self.a)) - self.a, self.b.astype(complex))
        return np.asarray(self.c @ states + self.d)


def waves_from_record(record: Mapping[str, Any] | None) -> WaveLoads:
    """Loads t -> Re sum_k F_k exp(i omega_k t) (6), F_k = force_real + i force_imag with the amplitude."""
    if not record:
        return lambda t: np.zeros(6)
    omega = np.asarray(record["omega"], dtype=float)
    amplitude = np.asarray(record["force_real"]) + 1j * np.asarray(record["force_imag"])
    transposed = np.ascontiguousarray(amplitude.T)
    return lambda t: np.asarray((transposed @ np.exp(1j * t * omega)).real)


@dataclass(frozen=True)
class VesselLoads:
    """Loads about the centre of mass; `inertia` (6, 6) is the added mass there."""

    wrench: Array
    inertia: Array
    memory_rate: Array
    wave: Array
    memory_force: Array


class Vessel:
    def __init__(
        self, record: Mapping[str, Any], body: int, start: Motion, vectors: BodyVectors,
        wave_loads: WaveLoads | None,
    ) -> None:  # fmt: skip
        self.body = body
        self.rest = np.asarray(record["reference_point"], dtype=float)
        self.point = vectors.add(body, start.rotation[body], self.rest - start.r[body])
        self.added_mass, self.damping, self.restoring = (
            np.asarray(record[key], dtype=float) for key in ("added_mass", "damping", "restoring")
        )
        self.quadratic_roll = float(record["quadratic_roll_damping"])
        self.station_stiffness, self.station_damping = (
            np.asarray(record["station_keeping"][key], dtype=float) for key in ("stiffness", "damping")
        )
        self.memory = MemoryModel.from_record(record.get("memory"))
        self.waves = wave_loads or waves_from_record(record.get("waves"))

    def displacement(self, x: VectorMotion) -> Array:
        """Surge, sway, heave from rest and roll, pitch, yaw of yaw-pitch-roll (6)."""
        angles = Rotation.from_matrix(x.motion.rotation[self.body]).as_euler("ZYX")
        return np.concatenate([x.point(self.point) - self.rest, angles[::-1]])

    def loads(self, t: float, x: VectorMotion, memory: Array) -> VesselLoads:
        """The added-mass inertia is returned, its velocity terms are part of the wrench."""
        lever, w = x.g[self.point], x.motion.w[self.body]
        eta = self.displacement(x)
        rates = angle_rate_matrix(eta[4], eta[5])
        yaw = np.kron(np.eye(2), Rotation.from_rotvec(eta[5] * UP).as_matrix())
        twist = np.concatenate([x.point_velocity(self.point), w])
        angle_rates = rates @ w
        u = yaw.T @ twist

        mu = self.memory.c @ memory + self.memory.d @ u
        wave = np.asarray(self.waves(t), dtype=float)
        local = wave - self.damping @ u - mu
        local[3] -= self.quadratic_roll * abs(u[3]) * u[3]
        load = yaw @ local
        drag = -self.station_damping * np.array([twist[0], twist[1], angle_rates[2]])
        pull = drag - self.station_stiffness * np.array([eta[0], eta[1], eta[5]])
        restoring = -self.restoring @ eta
        load[:3] += [pull[0], pull[1], restoring[2]]
        load[3:] += rates.T @ np.array([restoring[3], restoring[4], pull[2]])

        # du/dt = P^T (dV/dt - psidot ez x V); dV/dt holds w x (w x lever) besides the accelerations
        turning = np.concatenate([cross(UP, twist[:3]), cross(UP, w)])
        convective = -angle_rates[2] * turning
        convective[:3] += x.bias[self.point]
        added = yaw @ self.added_mass @ yaw.T
        transfer = np.eye(6)
        transfer[:3, 3:] = -skew(lever)
        return VesselLoads(
            transfer.T @ (load - added @ convective), transfer.T @ added @ transfer,
            self.memory.a @ memory + self.memory.b @ u, wave, mu
        )  # fmt: skip
