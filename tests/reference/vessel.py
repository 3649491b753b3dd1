"""Hydrodynamic loads on a floating body (paper eqs. 24-31 in the frame-consistent form of the design).

With psi the yaw angle, P = blockdiag(Rz(psi), Rz(psi)) and V the inertial twist of the reference point,
u = P^T V, the load on the reference point is

    P ( -A du/dt - B u - b4 |u4| u4 e4 - mu + waves(t) + constant )  +  restoring  +  station keeping,

    x' = Am x + Bm u,   mu = Cm x + Dm u.

Restoring is -grad of 1/2 eta^T C eta, eta = (0, 0, heave, roll, pitch, 0) from rest with yaw-pitch-roll
angles; station keeping -grad of 1/2 (kx x^2 + ky y^2 + kpsi psi^2) with dampers on the rates of x, y and psi.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .kinematics import BodyVectors, Motion, VectorMotion
from .rotation import Array, angle_rate_matrix, cross, skew, yaw_matrix, yaw_pitch_roll

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
    def none(cls) -> MemoryModel:
        return cls(np.zeros((0, 0)), np.zeros((0, 6)), np.zeros((6, 0)), np.zeros((6, 6)))

    @classmethod
    def from_record(cls, record: Mapping[str, Any] | None) -> MemoryModel:
        """Full matrices A, B, C, D, or blocks with 0-based `inputs` and `outputs` that are placed and
        summed.
        """
        if not record:
            return cls.none()
        blocks = record.get("blocks")
        if blocks is None:
            blocks = [{**record, "inputs": range(6), "outputs": range(6)}]
        total = cls.none()
        for block in blocks:
            total = total.joined(cls._placed(block))
        return total

    @classmethod
    def _placed(cls, block: Mapping[str, Any]) -> MemoryModel:
        inputs, outputs = list(block["inputs"]), list(block["outputs"])
        a = np.atleast_2d(np.asarray(block["A"], dtype=float))
        b, c, d = np.zeros((len(a), 6)), np.zeros((6, len(a))), np.zeros((6, 6))
        b[:, inputs] = np.reshape(np.asarray(block["B"], dtype=float), (len(a), len(inputs)))
        c[outputs] = np.reshape(np.asarray(block["C"], dtype=float), (len(outputs), len(a)))
        if block.get("D") is not None:
            direct = np.reshape(np.asarray(block["D"], dtype=float), (len(outputs), len(inputs)))
            d[np.ix_(outputs, inputs)] = direct
        return cls(a, b, c, d)

    def joined(self, other: MemoryModel) -> MemoryModel:
        """Both models side by side, outputs added."""
        n, m = len(self.a), len(other.a)
        a = np.zeros((n + m, n + m))
        a[:n, :n], a[n:, n:] = self.a, other.a
        return MemoryModel(a, np.vstack([self.b, other.b]), np.hstack([self.c, other.c]), self.d + other.d)

    def transfer(self, omega: float) -> np.ndarray[Any, np.dtype[np.complex128]]:
        """Complex retardation function K(i omega) (6, 6)."""
        states = np.linalg.solve(1j * omega * np.eye(len(self.a)) - self.a, self.b.astype(complex))
        return np.asarray(self.c @ states + self.d)


def waves_from_record(record: Mapping[str, Any] | None) -> WaveLoads | None:
    """Loads t -> Re sum_k F_k exp(i omega_k t) (6), F_k = force_real + i force_imag including the
    amplitude.
    """
    if not record:
        return None
    omega = np.asarray(record["omega"], dtype=float)
    amplitude = np.asarray(record["force_real"], dtype=float) + 1j * np.asarray(
        record["force_imag"], dtype=float
    )
    if amplitude.shape != (len(omega), 6):
        raise ValueError(f"waves: force has shape {amplitude.shape}, needs ({len(omega)}, 6)")
    transposed = np.ascontiguousarray(amplitude.T)
    return lambda t: np.asarray((transposed @ np.exp(1j * t * omega)).real)


@dataclass(frozen=True)
class VesselLoads:
    """Loads about the centre of mass; `inertia` (6, 6) is the added mass there."""

    wrench: Array
    inertia: Array
    memory_rate: Array
    power: float
    energy: float
    wave: Array
    memory_force: Array


class Vessel:
    """Compiled hydrodynamics of one body."""

    def __init__(
        self,
        record: Mapping[str, Any],
        body: int,
        start: Motion,
        vectors: BodyVectors,
        wave_loads: WaveLoads | None,
    ) -> None:
        self.body = body
        point = np.asarray(record.get("reference_point", [0.0, 0.0, 0.0]), dtype=float)
        self.point = vectors.add(body, start.rotation[body], point - start.r[body])
        self.rest = np.asarray(record.get("rest_position", point), dtype=float)
        self.added_mass, self.damping, self.restoring = (
            _six_by_six(record.get(key), key) for key in ("added_mass", "damping", "restoring")
        )
        stiff = self.restoring.copy()
        stiff[2:5, 2:5] = 0.0
        if np.any(stiff) or not np.allclose(self.restoring, self.restoring.T):
            raise ValueError(
                "vessel restoring: must be symmetric, with entries in heave, roll and pitch only"
            )
        self.quadratic_roll = float(record.get("quadratic_roll_damping", 0.0))
        station = record.get("station_keeping") or {}
        self.station_stiffness = np.asarray(station.get("stiffness", [0.0] * 3), dtype=float)
        self.station_damping = np.asarray(station.get("damping", [0.0] * 3), dtype=float)
        self.constant = np.asarray(record.get("constant_load", [0.0] * 6), dtype=float)
        self.memory = MemoryModel.from_record(record.get("memory"))
        self.waves = wave_loads or waves_from_record(record.get("waves"))

    def wave_force(self, t: float) -> Array:
        """Wave load in the yaw-following frame."""
        return np.zeros(6) if self.waves is None else np.asarray(self.waves(t), dtype=float)

    def displacement(self, x: VectorMotion) -> Array:
        """Surge, sway, heave from rest and roll, pitch, yaw of yaw-pitch-roll (6)."""
        angles = yaw_pitch_roll(x.motion.rotation[self.body])
        return np.concatenate([x.point(self.point) - self.rest, angles])

    def loads(self, t: float, x: VectorMotion, memory: Array) -> VesselLoads:
        """Evaluate; the added-mass inertia is returned, its velocity terms are part of the wrench."""
        lever, w = x.g[self.point], x.motion.w[self.body]
        eta = self.displacement(x)
        rates = angle_rate_matrix(eta[4], eta[5])
        yaw = np.kron(np.eye(2), yaw_matrix(eta[5]))
        twist = np.concatenate([x.point_velocity(self.point), w])
        angle_rates = rates @ w
        u = yaw.T @ twist

        mu = self.memory.c @ memory + self.memory.d @ u
        wave = self.wave_force(t)
        local = wave + self.constant - self.damping @ u - mu
        local[3] -= self.quadratic_roll * abs(u[3]) * u[3]
        dissipative = yaw @ local
        station_rate = np.array([twist[0], twist[1], angle_rates[2]])
        drag = -self.station_damping * station_rate
        dissipative[:2] += drag[:2]
        dissipative[3:] += rates[2] * drag[2]

        station = np.array([eta[0], eta[1], eta[5]])
        pull = -self.station_stiffness * station
        restoring = -self.restoring @ eta
        conservative = np.concatenate(
            [[pull[0], pull[1], restoring[2]], rates.T @ np.array([restoring[3], restoring[4], pull[2]])]
        )
        energy = 0.5 * float(self.station_stiffness @ station**2) - 0.5 * float(restoring @ eta)

        # du/dt = P^T (dV/dt - psidot ez x V); dV/dt holds w x (w x lever) besides the accelerations
        convective = np.concatenate(
            [
                x.bias[self.point] - angle_rates[2] * cross(UP, twist[:3]),
                -angle_rates[2] * cross(UP, w),
            ]
        )
        added = yaw @ self.added_mass @ yaw.T
        load = dissipative + conservative - added @ convective
        transfer = np.eye(6)
        transfer[:3, 3:] = -skew(lever)
        return VesselLoads(
            transfer.T @ load,
            transfer.T @ added @ transfer,
            self.memory.a @ memory + self.memory.b @ u,
            float(dissipative @ twist),
            energy,
            wave,
            mu,
        )


def _six_by_six(values: Any, name: str) -> Array:
    matrix = np.zeros((6, 6)) if values is None else np.asarray(values, dtype=float)
    if matrix.shape != (6, 6) or not np.all(np.isfinite(matrix)):
        raise ValueError(f"vessel {name}: needs a finite 6 x 6 matrix, has shape {matrix.shape}")
    return matrix
