"""Damped oscillators behind a group of motions, fitted to what they do to the motions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.memory.oscillators import (
    FLOOR,
    LOWEST_FREQUENCY,
    SLOWEST_DECAY,
    GroupData,
    Oscillators,
    Problem,
    first_guess,
)
from seacrane.one_thread import one_thread

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
Places = tuple[NDArray[np.intp], NDArray[np.intp]]

DATA_WEIGHT = 0.05  # of the misfit of A and B, beside that of the motions: keeps what no motion feels sane
PLACES = 6  # tried for each new mass
GLANCE, LOOK, SEARCH = 10, 40, 120  # evaluations for every place, for the best two, and for the best
SMALL_GAIN = 1e-4  # of the sum of squares in one step, below which a search ends
MOST_DAMPING = 1e12


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionData:
    """A group's data, and what a misfit of its kernel does to the motions.

    ``group`` as `GroupData` at n frequencies; ``lever`` (n, p, p) complex: weighted motions by misfit of the
    p pairs ``np.triu_indices`` of the kernel ``K(i w)``, on the group's scale.
    """

    group: GroupData
    lever: ComplexArray


@one_thread
def fit_to_motions(data: MotionData, lower: Oscillators | None) -> Oscillators:
    """Best fit with one mass more than ``lower``, or with one per motion where there is no lower one."""
    guesses = [first_guess(data.group)] if lower is None else _one_more(data.group, lower)
    problem = MotionProblem(data, len(guesses[0].w))
    found = [problem.search(problem.pack(guess), GLANCE) for guess in guesses]
    found = [problem.search(each[0], LOOK) for each in sorted(found, key=lambda each: each[1])[:2]]
    quick = [each for each in found if problem.oscillators(each[0]).slowest_decay >= SLOWEST_DECAY]
    best = min(quick or found, key=lambda each: each[1])
    last = problem.search(best[0], SEARCH)
    slow = problem.oscillators(last[0]).slowest_decay < SLOWEST_DECAY
    return problem.oscillators(best[0] if quick and slow else last[0])


def _one_more(data: GroupData, lower: Oscillators) -> list[Oscillators]:
    """``lower`` and one mass at several frequencies, coupled to what the damping lacks most there."""
    missing = data.damping - lower.transfer(data.omega).real
    n = len(lower.w)
    guesses = []
    for w in np.geomspace(1.6 * LOWEST_FREQUENCY, 0.9 * float(data.omega[data.trusted][-1]), PLACES):
        values, vectors = np.linalg.eigh(missing[np.abs(data.omega - w).argmin()])
        dampers = np.zeros((n + 1, n + 1))
        dampers[:n, :n], dampers[n, n] = lower.dampers, 0.5 * w + FLOOR
        row = vectors[:, -1] * np.sqrt(max(values[-1], 0.01) * 0.5 * w)
        guesses.append(
            Oscillators(w=np.append(lower.w, w), dampers=dampers, coupling=np.vstack([lower.coupling, row]))
        )
    return guesses


class MotionProblem(Problem):
    """Least squares of the misfit of the motions, and a little of that of B and A, over log w, L and b.

    The infinite-frequency added mass enters both linearly and is eliminated from them together. ``damped``
    are the entries of L that are searched, all of the lower triangle where it is None.
    """

    def __init__(self, data: MotionData, masses: int, damped: Places | None = None) -> None:
        super().__init__(data.group, masses)
        if damped is not None:
            self.lower = damped
        w = data.group.omega[:, None]
        self.weigh = self._weights(data.lever)
        self.target = data.group.damping[:, self.j, self.k] + 1j * w * (
            data.group.added_mass[:, self.j, self.k]
            - (
                0.0
                if data.group.added_mass_infinite is None
                else data.group.added_mass_infinite[self.j, self.k]
            )
        )
        self.known = data.group.added_mass_infinite is not None
        pairs = len(self.j)
        columns = self._rows(np.broadcast_to(1j * w[:, :, None] * np.eye(pairs), (len(w), pairs, pairs)))
        self.unit = np.linalg.qr(columns)[0]
        self.columns = columns

    def _weights(self, lever: ComplexArray) -> FloatArray:
        """Weights (n, 2 p, 2 p) of the kernel's real and imaginary parts: of the motions, and of the data."""
        n, p = len(lever), len(self.j)
        out = np.zeros((n, 4 * p, 2 * p))
        out[:, :p, :p], out[:, :p, p:] = lever.real, -lever.imag
        out[:, p : 2 * p, :p], out[:, p : 2 * p, p:] = lever.imag, lever.real
        pair = np.arange(p)
        out[:, 2 * p + pair, pair] = DATA_WEIGHT * self.weight_b
        out[:, 3 * p + pair, p + pair] = DATA_WEIGHT * self.weight_a / self.data.omega[:, None]
        return np.asarray(np.linalg.qr(out)[1])

    def _rows(self, kernel: ComplexArray) -> FloatArray:
        """Weighted motions and data of a kernel (n, p, ...), two rows for each pair and frequency."""
        parts = np.concatenate([kernel.real, kernel.imag], axis=1)
        weighted = self.weigh @ parts.reshape(*parts.shape[:2], -1)
        return np.asarray(weighted.reshape(-1, *kernel.shape[2:]))

    def _left(self, rows: FloatArray) -> FloatArray:
        """What the best infinite-frequency added mass leaves; in place, the rows are large."""
        if not self.known:
            rows -= self.unit @ (self.unit.T @ rows)
        return rows

    def misfit(self, parameters: FloatArray) -> FloatArray:
        """Rows of the model less the data, and the dampers' sizes."""
        kernel = self.oscillators(parameters).transfer(self.data.omega)[:, self.j, self.k]
        return np.concatenate([self._left(self._rows(kernel - self.target)), self.sizes(parameters)[0]])

    def slope(self, parameters: FloatArray) -> FloatArray:
        """Derivative of `misfit`."""
        rows = self._left(self._rows(self.kernel_slope(parameters)))
        return np.concatenate([rows, self.sizes(parameters)[1]])

    def infinite(self, model: Oscillators) -> FloatArray:
        """Infinite-frequency added mass (m, m) that goes best with a model."""
        if self.data.added_mass_infinite is not None:
            return self.data.added_mass_infinite
        kernel = model.transfer(self.data.omega)[:, self.j, self.k]
        values = np.linalg.lstsq(self.columns, self._rows(self.target - kernel), rcond=None)[0]
        out = np.zeros((self.m, self.m))
        out[self.j, self.k] = out[self.k, self.j] = values
        return out

    def search(self, start: FloatArray, evaluations: int) -> tuple[FloatArray, float]:
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
