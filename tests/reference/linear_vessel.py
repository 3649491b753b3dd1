"""Frequency-domain solution and eigenvalues of a free vessel: what small motions must agree with.

Equation (10) of the paper: [-w^2 (M + A(w)) + i w B(w) + C] eta = F, motions Re eta exp(i w t). With a memory
model K the retardation enters as i w K(i w) eta, so A(w) = A_inf + Im K / w and B(w) = B + Re K.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .rotation import Array
from .vessel import MemoryModel

Complex = np.ndarray[Any, np.dtype[np.complex128]]


@dataclass(frozen=True)
class LinearVessel:
    """M + A_inf, B, C (all 6x6, station keeping included in B and C) and a memory model."""

    mass: Array
    damping: Array
    restoring: Array
    memory: MemoryModel

    def response(self, omega: ArrayLike, force: ArrayLike) -> Complex:
        """Steady motions (k, 6) under force amplitudes (k, 6) at frequencies (k)."""
        w = np.asarray(omega, dtype=float)
        memory = np.array([self.memory.transfer(float(value)) for value in w])
        w = w[:, None, None]
        impedance = -(w**2) * self.mass + 1j * w * (self.damping + memory) + self.restoring
        return np.asarray(np.linalg.solve(impedance, np.asarray(force, dtype=complex)[:, :, None])[:, :, 0])

    def eigenvalues(self) -> Complex:
        """Eigenvalues of free motion, 1/s: of d/dt (eta, eta', x)."""
        n = len(self.memory.a)
        inverse = np.linalg.inv(self.mass)
        a = np.zeros((12 + n, 12 + n))
        a[:6, 6:12] = np.eye(6)
        a[6:12, :6] = -inverse @ self.restoring
        a[6:12, 6:12] = -inverse @ (self.damping + self.memory.d)
        a[6:12, 12:] = -inverse @ self.memory.c
        a[12:, 6:12], a[12:, 12:] = self.memory.b, self.memory.a
        return np.asarray(np.linalg.eigvals(a).astype(complex))
