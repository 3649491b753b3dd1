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

from seacrane.arrays import Array, Complex
from seacrane.one_thread import one_thread

Places = tuple[NDArray[np.intp], NDArray[np.intp]]

OUTSIDE_WEIGHT = 0.2
FLOOR = 0.02  # 1/s, smallest eigenvalue of R: decays; more would dissipate in long waves, as no data do
SMALL_PAIR = 0.02  # spreads below this share of the geometric mean of their diagonals count as that large
LOWEST_FREQUENCY = 0.15  # rad/s of a hidden spring and mass
HIGHEST_FREQUENCY = 1.6  # the same, over the last frequency of the data
DAMPER_WEIGHT = 3e-3  # of the diagonal of R in the least squares: no fast poles beyond the data
DATA_WEIGHT = 0.05  # of the misfit of A and B, beside that of the motions: keeps what no motion feels sane
LARGEST = 30.0
SLOWEST_DECAY = 0.05  # 1/s; models that forget more slowly are taken only where there is no other
PLACES = 6  # tried for each new mass
GLANCE, LOOK, SEARCH = 10, 40, 120  # evaluations: every place, the best two, the best
SMALL_GAIN = 1e-4  # of the sum of squares in one step, below which a search ends
MOST_DAMPING = 1e12


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionData:
    """Symmetric, scaled data of a group of m motions at n frequencies, and how its kernel moves them.

    ``omega`` (n,) rad/s; ``added_mass`` and ``damping`` (n, m, m), both divided by the outer product of the
    same scale; ``trusted`` (n,) bool; ``added_mass_infinite`` (m, m) on the same scale, None: estimated;
    ``lever`` (n, p, p) complex: weighted motions by misfit of the p pairs ``np.triu_indices`` of ``K(i w)``.
    """

    omega: Array
    added_mass: Array
    damping: Array
    trusted: NDArray[np.bool_]
    added_mass_infinite: Array | None
    lever: Complex


@dataclass(frozen=True, kw_only=True, eq=False)
class Oscillators:
    """``w`` (n,) rad/s, ``dampers`` R (n, n) in 1/s, ``coupling`` b (n, m)."""

    w: Array
    dampers: Array
    coupling: Array

    @property
    def slowest_decay(self) -> float:
        """Smallest -Re of the poles, 1/s."""
        return float(-np.linalg.eigvals(self.state_space()[0]).real.max())

    def transfer(self, omega: Array) -> Complex:
        """``K(i omega)`` (n, m, m) at ``omega`` (n,)."""
        return np.asarray(1j * omega[:, None, None] * (self.coupling.T @ self.deflection(omega)))

    def deflection(self, omega: Array) -> Complex:
        """Positions of the masses (n, masses, m) under unit motions: ``(s^2 + s R + W^2)^-1 b``."""
        s = 1j * omega[:, None, None]
        stiffness = s * s * np.eye(len(self.w)) + s * self.dampers + np.diag(self.w**2)
        force = np.broadcast_to(self.coupling.astype(complex), (len(omega), *self.coupling.shape))
        return np.asarray(np.linalg.solve(stiffness, force))

    def state_space(self) -> tuple[Array, Array]:
        """``A = [[0, W], [-W, -R]]``, ``B = [0; b]``; with C = B^T P = I certifies it, as A + A^T <= 0."""
        n = len(self.w)
        a = np.zeros((2 * n, 2 * n))
        a[:n, n:], a[n:, :n], a[n:, n:] = np.diag(self.w), -np.diag(self.w), -self.dampers
        return a, np.vstack([np.zeros_like(self.coupling), self.coupling])

    def with_mass(self, w: float, damper: float, coupling: Array) -> Oscillators:
        """One mass more, coupled to motions alone."""
        n = len(self.w)
        dampers = np.zeros((n + 1, n + 1))
        dampers[:n, :n], dampers[n, n] = self.dampers, damper
        return Oscillators(
            w=np.append(self.w, w), dampers=dampers, coupling=np.vstack([self.coupling, coupling])
        )


class OscillatorParameters:
    """What a search for oscillators varies: angles that keep log w within its bounds, entries of L, and b.

    ``lower`` are the places of the entries of L that are searched.
    """

    def __init__(self, omega: Array, motions: int, masses: int, lower: Places) -> None:
        self.n, self.m, self.lower = masses, motions, lower
        self.bottom = np.log(LOWEST_FREQUENCY)
        self.span = np.log(HIGHEST_FREQUENCY * omega[-1]) - self.bottom

    def pack(self, guess: Oscillators) -> Array:
        """Parameters: angles that keep w within its bounds, the lower triangle of L, b."""
        share = np.clip((np.log(guess.w) - self.bottom) / self.span, 0.005, 0.995)
        factor = np.linalg.cholesky(guess.dampers - FLOOR * np.eye(self.n) + 1e-6 * np.eye(self.n))
        return np.concatenate([np.arcsin(2.0 * share - 1.0), factor[self.lower], guess.coupling.ravel()])

    def unpack(self, parameters: Array) -> tuple[Array, Array, Array]:
        """w, L and b."""
        w = np.exp(self.bottom + self.span * 0.5 * (1.0 + np.sin(parameters[: self.n])))
        rest = np.clip(parameters[self.n :], -LARGEST, LARGEST)
        factor = np.zeros((self.n, self.n))
        count = len(self.lower[0])
        factor[self.lower] = rest[:count]
        return w, factor, rest[count:].reshape(self.n, self.m)

    def oscillators(self, parameters: Array) -> Oscillators:
        """The model that the parameters stand for."""
        w, factor, coupling = self.unpack(parameters)
        return Oscillators(w=w, dampers=factor @ factor.T + FLOOR * np.eye(self.n), coupling=coupling)

    def angle_slope(self, parameters: Array) -> Array:
        """Derivative of w over the angles."""
        w = self.unpack(parameters)[0]
        return np.asarray(w * 0.5 * self.span * np.cos(parameters[: self.n]))

    def sizes(self, parameters: Array) -> tuple[Array, Array]:
        """Weighted sizes (masses,) of the dampers, and their derivative."""
        factor = self.unpack(parameters)[1]
        p, q = self.lower
        slope = np.zeros((self.n, len(parameters)))
        slope[p, self.n + np.arange(len(p))] = 2.0 * DAMPER_WEIGHT * factor[p, q]
        return DAMPER_WEIGHT * np.sum(factor**2, axis=1), slope


class MotionProblem(OscillatorParameters):
    """Least squares of the misfit of the motions, and a little of that of B and A, over log w, L and b.

    The infinite-frequency added mass enters both linearly and is eliminated from them together.
    """

    def __init__(self, data: MotionData, masses: int) -> None:
        super().__init__(data.omega, data.damping.shape[1], masses, np.tril_indices(masses))
        self.data = data
        self.j, self.k = j, k = np.triu_indices(self.m)
        weight = np.where(data.trusted, 1.0, OUTSIDE_WEIGHT)[:, None]
        self.weight_a = weight / self._spread(data.added_mass)
        self.weight_b = weight / self._spread(data.damping)
        w, known = data.omega[:, None], data.added_mass_infinite
        self.weigh = self._weights(data.lever)
        fixed = 0.0 if known is None else known[j, k]
        self.target = data.damping[:, j, k] + 1j * w * (data.added_mass[:, j, k] - fixed)
        pairs = len(j)
        self.columns = self._rows(np.broadcast_to(1j * w[:, :, None] * np.eye(pairs), (len(w), pairs, pairs)))
        self.unit = np.linalg.qr(self.columns)[0]

    def _spread(self, matrices: Array) -> Array:
        """Unit (entries,) in which the squared misfit is 1 - R2."""
        inside = matrices[self.data.trusted]
        spread = np.sqrt(np.sum((inside - inside.mean(axis=0)) ** 2, axis=0))
        diagonal = np.sqrt(np.maximum(spread.diagonal(), 1e-300))
        floor = SMALL_PAIR * np.outer(diagonal, diagonal)
        return np.asarray(np.maximum(spread, floor)[self.j, self.k])

    def kernel_slope(self, parameters: Array) -> Complex:
        """Derivative (n, entries, parameters) of the kernel, by ``d (Q^-1) = -Q^-1 dQ Q^-1`` with Q the
        oscillators' stiffness."""
        w, factor, _ = self.unpack(parameters)
        x = self.oscillators(parameters).deflection(self.data.omega)
        s: Complex = np.asarray(1j * self.data.omega[:, None, None])
        left, right = x[:, :, self.j].swapaxes(1, 2), x[:, :, self.k].swapaxes(1, 2)
        d_w = -2.0 * s * w * left * right * self.angle_slope(parameters)
        y = factor.T @ x
        y_left, y_right = y[:, :, self.j].swapaxes(1, 2), y[:, :, self.k].swapaxes(1, 2)
        p, q = self.lower
        d_factor = -(s**2) * (left[:, :, p] * y_right[:, :, q] + y_left[:, :, q] * right[:, :, p])
        d_b = np.zeros((len(s), len(self.j), self.n, self.m), dtype=complex)
        entry = np.arange(len(self.j))
        d_b[:, entry, :, self.j] += np.moveaxis(right, 1, 0)
        d_b[:, entry, :, self.k] += np.moveaxis(left, 1, 0)
        return np.concatenate([d_w, d_factor, s * d_b.reshape(len(s), len(self.j), -1)], axis=2)

    def _weights(self, lever: Complex) -> Array:
        """Weights (n, 2 p, 2 p) of the kernel's real and imaginary parts: of the motions, and of the data."""
        n, p = len(lever), len(self.j)
        out = np.zeros((n, 4 * p, 2 * p))
        out[:, :p, :p], out[:, :p, p:] = lever.real, -lever.imag
        out[:, p : 2 * p, :p], out[:, p : 2 * p, p:] = lever.imag, lever.real
        pair = np.arange(p)
        out[:, 2 * p + pair, pair] = DATA_WEIGHT * self.weight_b
        out[:, 3 * p + pair, p + pair] = DATA_WEIGHT * self.weight_a / self.data.omega[:, None]
        return np.asarray(np.linalg.qr(out)[1])

    def _rows(self, kernel: Complex) -> Array:
        """Weighted motions and data of a kernel (n, p, ...), two rows for each pair and frequency."""
        parts = np.concatenate([kernel.real, kernel.imag], axis=1)
        weighted = self.weigh @ parts.reshape(*parts.shape[:2], -1)
        return np.asarray(weighted.reshape(-1, *kernel.shape[2:]))

    def misfit(self, parameters: Array) -> Array:
        """Rows of the model less the data, and the dampers' sizes."""
        kernel = self.oscillators(parameters).transfer(self.data.omega)[:, self.j, self.k]
        return np.concatenate([self._left(kernel - self.target), self.sizes(parameters)[0]])

    def slope(self, parameters: Array) -> Array:
        """Derivative of `misfit`."""
        return np.concatenate([self._left(self.kernel_slope(parameters)), self.sizes(parameters)[1]])

    def _left(self, kernel: Complex) -> Array:
        """What the best infinite-frequency added mass leaves of a kernel's rows."""
        rows = self._rows(kernel)
        if self.data.added_mass_infinite is None:
            rows -= self.unit @ (self.unit.T @ rows)
        return rows

    def infinite(self, model: Oscillators) -> Array:
        """Infinite-frequency added mass (m, m) that goes best with a model."""
        if self.data.added_mass_infinite is not None:
            return self.data.added_mass_infinite
        kernel = model.transfer(self.data.omega)[:, self.j, self.k]
        values = np.linalg.lstsq(self.columns, self._rows(self.target - kernel), rcond=None)[0]
        out = np.zeros((self.m, self.m))
        out[self.j, self.k] = out[self.k, self.j] = values
        return out

    def search(self, start: Array, evaluations: int) -> tuple[Array, float]:
        """Parameters and half the sum of squares after a Levenberg-Marquardt search (normal equations)."""
        x, damping = start, 1e-2
        residual = self.misfit(x)
        cost = float(residual @ residual)
        for _ in range(evaluations):
            jacobian = self.slope(x)
            square, right = jacobian.T @ jacobian, jacobian.T @ residual
            scale = np.diag(square) + 1e-9 * np.trace(square) / len(square)
            before = cost
            while damping < MOST_DAMPING:
                step = np.linalg.solve(square + damping * np.diag(scale), -right)
                tried = self.misfit(x + step)
                new = float(tried @ tried)
                if new < cost:
                    x, residual, cost, damping = x + step, tried, new, max(0.2 * damping, 1e-9)
                    break
                damping *= 4.0
            if cost > before * (1.0 - SMALL_GAIN):
                break
        return x, 0.5 * cost


@one_thread
def fit_to_motions(data: MotionData, lower: Oscillators | None) -> Oscillators:
    """Best fit with one mass more than ``lower``, or with one per motion where there is no lower one."""
    if lower is None:  # one uncoupled mass per motion, at the peak of its damping
        peaks = data.omega[np.diagonal(data.damping, axis1=1, axis2=2).argmax(axis=0)]
        w = np.clip(peaks, LOWEST_FREQUENCY, None)
        guesses = [Oscillators(w=w, dampers=np.diag(w), coupling=np.diag(np.sqrt(w)))]
    else:  # and one mass at several frequencies, coupled to what the damping lacks most there
        missing, guesses = data.damping - lower.transfer(data.omega).real, []
        for w in np.geomspace(1.6 * LOWEST_FREQUENCY, 0.9 * float(data.omega[data.trusted][-1]), PLACES):
            values, vectors = np.linalg.eigh(missing[np.abs(data.omega - w).argmin()])
            row = vectors[:, -1] * np.sqrt(max(values[-1], 0.01) * 0.5 * w)
            guesses.append(lower.with_mass(w, 0.5 * w + FLOOR, row))
    problem = MotionProblem(data, len(guesses[0].w))
    found = [problem.search(problem.pack(guess), GLANCE) for guess in guesses]
    found = [problem.search(each[0], LOOK) for each in sorted(found, key=lambda each: each[1])[:2]]
    quick = [each for each in found if problem.oscillators(each[0]).slowest_decay >= SLOWEST_DECAY]
    best = min(quick or found, key=lambda each: each[1])
    last = problem.search(best[0], SEARCH)
    slow = problem.oscillators(last[0]).slowest_decay < SLOWEST_DECAY
    return problem.oscillators(best[0] if quick and slow else last[0])
