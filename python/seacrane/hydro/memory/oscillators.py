"""Passive rational matrix: damped, coupled oscillators behind the motions.

With ``s = i omega``, n hidden unit masses, springs ``W = diag(w)``, a damping matrix ``R`` and couplings
``b`` (n, m) to the m motions::

    K(s) = s b^T (s^2 I + s R + W^2)^-1 b,        R = L L^T + FLOOR I

Whatever w, L and b are, this is symmetric, positive real, zero at s = 0 and of relative degree one: what a
retardation function of radiation has to be. All entries share the 2 n poles. The search runs over w, L and b,
so no candidate is ever corrected for passivity afterwards. (Mechanical networks as positive-real functions:
Brune 1931; the Hamiltonian form: van der Schaft & Jeltsema 2014, doi 10.1561/2600000002.)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

OUTSIDE_WEIGHT = 0.2
FLOOR = 0.02  # 1/s, smallest eigenvalue of R: decays; more would dissipate in long waves, as no data do
SMALL_PAIR = 0.02  # spreads below this share of the geometric mean of their diagonals count as that large
LOWEST_FREQUENCY = 0.15  # rad/s of a hidden spring and mass
HIGHEST_FREQUENCY = 1.6  # the same, over the last frequency of the data
DAMPER_WEIGHT = 3e-3  # of the diagonal of R in the least squares: no fast poles beyond the data
LARGEST = 30.0
SLOWEST_DECAY = 0.05  # 1/s; models that forget more slowly are taken only where there is no other


@dataclass(frozen=True, kw_only=True, eq=False)
class GroupData:
    """Symmetric, scaled data of one group of m motions, at n frequencies.

    ``omega`` (n,) rad/s; ``added_mass`` and ``damping`` (n, m, m), both divided by the outer product of the
    same scale; ``trusted`` (n,) bool; ``added_mass_infinite`` (m, m) on the same scale, None: estimated.
    """

    omega: FloatArray
    added_mass: FloatArray
    damping: FloatArray
    trusted: NDArray[np.bool_]
    added_mass_infinite: FloatArray | None


@dataclass(frozen=True, kw_only=True, eq=False)
class Oscillators:
    """``w`` (n,) rad/s, ``dampers`` R (n, n) in 1/s, ``coupling`` b (n, m)."""

    w: FloatArray
    dampers: FloatArray
    coupling: FloatArray

    @property
    def states(self) -> int:
        """A position and a velocity of every mass."""
        return 2 * len(self.w)

    @property
    def slowest_decay(self) -> float:
        """Smallest -Re of the poles, 1/s."""
        return float(-np.linalg.eigvals(self.state_space()[0]).real.max())

    def transfer(self, omega: FloatArray) -> ComplexArray:
        """``K(i omega)`` (n, m, m) at ``omega`` (n,)."""
        return np.asarray(1j * omega[:, None, None] * (self.coupling.T @ self.deflection(omega)))

    def deflection(self, omega: FloatArray) -> ComplexArray:
        """Positions of the masses (n, masses, m) under unit motions: ``(s^2 + s R + W^2)^-1 b``."""
        s = 1j * omega[:, None, None]
        stiffness = s * s * np.eye(len(self.w)) + s * self.dampers + np.diag(self.w**2)
        force = np.broadcast_to(self.coupling.astype(complex), (len(omega), *self.coupling.shape))
        return np.asarray(np.linalg.solve(stiffness, force))

    def state_space(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """``A = [[0, W], [-W, -R]]``, ``B = [0; b]``, ``C = B^T``: as A + A^T <= 0, P = I certifies it."""
        n = len(self.w)
        a = np.zeros((2 * n, 2 * n))
        a[:n, n:], a[n:, :n], a[n:, n:] = np.diag(self.w), -np.diag(self.w), -self.dampers
        b = np.vstack([np.zeros_like(self.coupling), self.coupling])
        return a, b, b.T.copy()


def first_guess(data: GroupData) -> Oscillators:
    """One uncoupled mass per motion, at the peak of its damping."""
    peaks = data.omega[np.diagonal(data.damping, axis1=1, axis2=2).argmax(axis=0)]
    w = np.clip(peaks, LOWEST_FREQUENCY, None)
    return Oscillators(w=w, dampers=np.diag(w), coupling=np.diag(np.sqrt(w)))


class Problem:
    """What a search over log w, L and b goes through: its parameters, weights of B and A, and derivatives."""

    def __init__(self, data: GroupData, masses: int) -> None:
        self.data, self.n, self.m = data, masses, data.damping.shape[1]
        self.j, self.k = np.triu_indices(self.m)
        self.lower = np.tril_indices(masses)
        self.bottom = np.log(LOWEST_FREQUENCY)
        self.span = np.log(HIGHEST_FREQUENCY * data.omega[-1]) - self.bottom
        weight = np.where(data.trusted, 1.0, OUTSIDE_WEIGHT)[:, None]
        self.weight_a = weight / self._spread(data.added_mass)
        self.weight_b = weight / self._spread(data.damping)

    def _spread(self, matrices: FloatArray) -> FloatArray:
        """Unit (entries,) in which the squared misfit is 1 - R2."""
        inside = matrices[self.data.trusted]
        spread = np.sqrt(np.sum((inside - inside.mean(axis=0)) ** 2, axis=0))
        diagonal = np.sqrt(np.maximum(spread.diagonal(), 1e-300))
        floor = SMALL_PAIR * np.outer(diagonal, diagonal)
        return np.asarray(np.maximum(spread, floor)[self.j, self.k])

    def pack(self, guess: Oscillators) -> FloatArray:
        """Parameters: angles that keep w within its bounds, the lower triangle of L, b."""
        share = np.clip((np.log(guess.w) - self.bottom) / self.span, 0.005, 0.995)
        factor = np.linalg.cholesky(guess.dampers - FLOOR * np.eye(self.n) + 1e-6 * np.eye(self.n))
        return np.concatenate([np.arcsin(2.0 * share - 1.0), factor[self.lower], guess.coupling.ravel()])

    def _unpack(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        w = np.exp(self.bottom + self.span * 0.5 * (1.0 + np.sin(parameters[: self.n])))
        rest = np.clip(parameters[self.n :], -LARGEST, LARGEST)
        factor = np.zeros((self.n, self.n))
        count = len(self.lower[0])
        factor[self.lower] = rest[:count]
        return w, factor, rest[count:].reshape(self.n, self.m)

    def oscillators(self, parameters: FloatArray) -> Oscillators:
        """The model that the parameters stand for."""
        w, factor, coupling = self._unpack(parameters)
        return Oscillators(w=w, dampers=factor @ factor.T + FLOOR * np.eye(self.n), coupling=coupling)

    def sizes(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Weighted sizes (masses,) of the dampers, and their derivative."""
        factor = self._unpack(parameters)[1]
        p, q = self.lower
        slope = np.zeros((self.n, len(parameters)))
        slope[p, self.n + np.arange(len(p))] = 2.0 * DAMPER_WEIGHT * factor[p, q]
        return DAMPER_WEIGHT * np.sum(factor**2, axis=1), slope

    def kernel_slope(self, parameters: FloatArray) -> ComplexArray:
        """Derivative (n, entries, parameters) of the kernel, by ``d (Q^-1) = -Q^-1 dQ Q^-1`` with Q the
        oscillators' stiffness."""
        w, factor, _ = self._unpack(parameters)
        x = self.oscillators(parameters).deflection(self.data.omega)
        s: ComplexArray = np.asarray(1j * self.data.omega[:, None, None])
        left, right = x[:, :, self.j].swapaxes(1, 2), x[:, :, self.k].swapaxes(1, 2)
        by_angle = w * 0.5 * self.span * np.cos(parameters[: self.n])
        d_w = -2.0 * s * w * left * right * by_angle
        y = factor.T @ x
        y_left, y_right = y[:, :, self.j].swapaxes(1, 2), y[:, :, self.k].swapaxes(1, 2)
        p, q = self.lower
        d_factor = -(s**2) * (left[:, :, p] * y_right[:, :, q] + y_left[:, :, q] * right[:, :, p])
        return np.concatenate([d_w, d_factor, self._by_coupling(s, left, right)], axis=2)

    def _by_coupling(self, s: ComplexArray, left: ComplexArray, right: ComplexArray) -> ComplexArray:
        """Derivatives (n, entries, masses * m) of the kernel with respect to b."""
        out = np.zeros((len(s), len(self.j), self.n, self.m), dtype=complex)
        entry = np.arange(len(self.j))
        out[:, entry, :, self.j] += np.moveaxis(right, 1, 0)
        out[:, entry, :, self.k] += np.moveaxis(left, 1, 0)
        return np.asarray(s * out.reshape(len(s), len(self.j), -1))
