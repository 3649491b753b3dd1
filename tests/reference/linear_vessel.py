"""Frequency-domain and linear time-domain solutions of a free vessel: what small motions must agree with.

Equation (10) of the paper: [-w^2 (M + A(w)) + i w B(w) + C] eta = F, motions Re eta exp(i w t). With a memory
model K the retardation enters as i w K(i w) eta, so A(w) = A_inf + Im K / w and B(w) = B + Re K.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .rotation import Array, skew
from .vessel import MemoryModel

Complex = np.ndarray[Any, np.dtype[np.complex128]]


def rigid_mass(mass: float, inertia: ArrayLike, center: ArrayLike) -> Array:
    """6x6 mass about a point from the inertia about the centre of mass at `center` from it (paper eq. 12)."""
    s = skew(np.asarray(center, dtype=float))
    m = np.zeros((6, 6))
    m[:3, :3] = mass * np.eye(3)
    m[:3, 3:], m[3:, :3] = -mass * s, mass * s
    m[3:, 3:] = np.asarray(inertia, dtype=float) - mass * s @ s
    return m


def motion_amplitude(
    omega: ArrayLike, mass: Array, added_mass: Array, damping: Array, restoring: Array, force: ArrayLike
) -> Complex:
    """Complex motions (k, 6) from M, C (6, 6), A(w), B(w) (k, 6, 6) or (6, 6), F (k, 6)."""
    w = np.asarray(omega, dtype=float)[:, None, None]
    impedance = -(w**2) * (mass + added_mass) + 1j * w * damping + restoring
    return np.asarray(np.linalg.solve(impedance, np.asarray(force, dtype=complex)[:, :, None])[:, :, 0])


@dataclass(frozen=True)
class LinearVessel:
    """M + A_inf, B, C (all 6x6, station keeping included in B and C) and a memory model."""

    mass: Array
    damping: Array
    restoring: Array
    memory: MemoryModel

    @classmethod
    def from_records(cls, records: dict[str, Any]) -> LinearVessel:
        """Linearise a scene's vessel alone about its start (reference point at rest, no yaw)."""
        v = records["vessel"]
        hull = next(b for b in records["bodies"] if b["name"] == v["body"])
        center = np.asarray(hull["position"]) - np.asarray(v.get("reference_point", [0.0, 0.0, 0.0]))
        empty = np.zeros((6, 6))
        damping = np.array(v.get("damping", empty), dtype=float)
        restoring = np.array(v.get("restoring", empty), dtype=float)
        station = v.get("station_keeping") or {"stiffness": [0.0] * 3, "damping": [0.0] * 3}
        for k, motion in enumerate((0, 1, 5)):
            restoring[motion, motion] += station["stiffness"][k]
            damping[motion, motion] += station["damping"][k]
        mass = rigid_mass(hull["mass"], hull["inertia"], center) + np.asarray(v.get("added_mass", empty))
        return cls(mass, damping, restoring, MemoryModel.from_record(v.get("memory")))

    def added_mass_and_damping(self, omega: ArrayLike) -> tuple[Array, Array]:
        """A(w) - A_inf and B(w) (k, 6, 6) that the memory model and B amount to."""
        w = np.asarray(omega, dtype=float)
        k = np.array([self.memory.transfer(float(value)) for value in w])
        return k.imag / w[:, None, None], k.real + self.damping

    def response(self, omega: ArrayLike, force: ArrayLike) -> Complex:
        """Steady motions (k, 6) under force amplitudes (k, 6) at frequencies (k)."""
        added, damping = self.added_mass_and_damping(omega)
        return motion_amplitude(omega, self.mass, added, damping, self.restoring, force)

    def state_matrix(self) -> Array:
        """Matrix of d/dt (eta, eta', x) for free motion."""
        n = len(self.memory.a)
        inverse = np.linalg.inv(self.mass)
        a = np.zeros((12 + n, 12 + n))
        a[:6, 6:12] = np.eye(6)
        a[6:12, :6] = -inverse @ self.restoring
        a[6:12, 6:12] = -inverse @ (self.damping + self.memory.d)
        a[6:12, 12:] = -inverse @ self.memory.c
        a[12:, 6:12], a[12:, 12:] = self.memory.b, self.memory.a
        return a

    def eigenvalues(self) -> Complex:
        """Eigenvalues of free motion, 1/s."""
        return np.asarray(np.linalg.eigvals(self.state_matrix()).astype(complex))

    def simulate(
        self, times: ArrayLike, eta: ArrayLike, rate: ArrayLike, omega: ArrayLike = (), force: ArrayLike = ()
    ) -> tuple[Array, Array]:
        """Motions and rates (k, 6) from a start with memory at zero, under harmonic forces; exact in time.

        The steady part comes from `response`, the transient from the matrix exponential.
        """
        from scipy.linalg import expm

        t = np.asarray(times, dtype=float)
        w = np.asarray(omega, dtype=float)
        f = np.asarray(force, dtype=complex).reshape(len(w), 6)
        n = len(self.memory.a)
        steady = np.zeros((len(w), 12 + n), dtype=complex)
        for k, (frequency, amplitude) in enumerate(zip(w, f, strict=True)):
            motion = self.response([frequency], amplitude[None])[0]
            steady[k, :6], steady[k, 6:12] = motion, 1j * frequency * motion
            kernel = 1j * frequency * np.eye(n) - self.memory.a
            steady[k, 12:] = np.linalg.solve(kernel, self.memory.b @ steady[k, 6:12])
        start = np.concatenate([np.asarray(eta, dtype=float), np.asarray(rate, dtype=float), np.zeros(n)])
        free = start - steady.sum(axis=0).real
        a = self.state_matrix()
        transient = np.array([expm(a * value) @ free for value in t])
        forced = (np.exp(1j * np.outer(t, w)) @ steady).real
        total = transient + forced
        return total[:, :6], total[:, 6:12]
