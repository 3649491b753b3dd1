"""Search for the oscillators of several hulls together, at a cost that their number allows.

The form is that of `oscillators`, ``K = s b^T x``, ``x = (s^2 + s R + W^2)^-1 b``, and so are its least
squares: a misfit D of the kernel moves the motions by ``left (s D) right``, so that the sum of squares is
``Re tr(D^* H D M)``, ``H = |s|^2 left^* left``, ``M = right right^*``. Every parameter changes K by a matrix
``u v^T + v u^T``. The product of two of these in that sum of squares is made of ``u^* H u`` and ``v^T M v``
alone: the normal matrix of Gauss and Newton is a sum of Kronecker products over the frequencies, and no
matrix over pairs of motions and frequencies is made.

Masses are in the order of their frequencies, and share dampers with their next ones: R is a band.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array, Complex
from seacrane.hydro.memory.oscillators import (
    FLOOR,
    LOWEST_FREQUENCY,
    MOST_DAMPING,
    OUTSIDE_WEIGHT,
    OscillatorParameters,
    Oscillators,
)
from seacrane.one_thread import one_thread

BAND = 5  # masses that share dampers: each with so many less one on either side
DATA_WEIGHT = 0.2  # of the misfit of the data over the spreads of their diagonals, beside that of motions
SPARSE = 3  # the data themselves count at every third frequency
BEYOND = 1.25  # of the upper end of the band: the highest mass of a guess
A_PLACE = 3  # masses at one frequency, about


@dataclass(frozen=True, kw_only=True, eq=False)
class CoupledData:
    """Symmetric, scaled data of m coupled motions at n frequencies, and how a misfit of them is felt.

    ``omega`` (n,) rad/s; ``kernel`` (n, m, m), ``damping + i omega added_mass`` over the outer product of the
    same scale; ``trusted`` (n,) bool; ``added_mass_infinite`` (m, m), None: estimated; ``left`` (n, motions,
    m) and ``right`` (n, m, h): a misfit D of the kernel moves the weighted motions by ``left (i w D) right``.
    """

    omega: Array
    kernel: Complex
    trusted: NDArray[np.bool_]
    added_mass_infinite: Array | None
    left: Complex
    right: Complex


class Felt:
    """The sum of squares of a misfit (n, m, m) of the kernel: of the motions, and a little of the data."""

    def __init__(self, data: CoupledData) -> None:
        self.data, self.s = data, np.asarray(1j * data.omega[:, None, None], dtype=complex)
        n, m = data.kernel.shape[:2]
        known = data.added_mass_infinite
        self.target = data.kernel - (0.0 if known is None else self.s * known)
        self.some = np.arange(0, n, SPARSE)
        inside = data.kernel.real[data.trusted]
        spread = np.sqrt(np.sum((inside - inside.mean(axis=0)) ** 2, axis=0)).diagonal()
        size = np.diag(1.0 / np.maximum(spread, 1e-300)).astype(complex)
        weight = 0.5 * SPARSE * (DATA_WEIGHT * np.where(data.trusted, 1.0, OUTSIDE_WEIGHT)) ** 2
        self.j, self.k = np.triu_indices(m)
        self.once = np.where(self.j == self.k, 0.5, 1.0)  # a pair stands twice in a matrix
        self.hold = np.concatenate([np.empty_like(data.kernel), weight[self.some, None, None] * size])
        self.move = np.concatenate(
            [data.right @ data.right.conj().swapaxes(1, 2), np.broadcast_to(size, (len(self.some), m, m))]
        )
        self.emphasise(np.ones(data.left.shape[1]))

    def emphasise(self, motions: Array) -> None:
        """Weigh the squares of the motions anew."""
        left = self.data.left
        held = left.conj().swapaxes(1, 2) @ (motions[:, None] * left)
        self.hold[: len(self.s)] = np.abs(self.s) ** 2 * held
        self.factor = None
        if self.data.added_mass_infinite is None:
            self.factor = np.linalg.cholesky(self._of_infinite())

    def twice(self, values: Complex) -> Complex:
        """Values (n, ...) at the frequencies of the motions and at those of the data."""
        return np.concatenate([values, values[self.some]])

    def __call__(self, misfit: Complex) -> Complex:
        """Half the derivative of the sum of squares, (n, m, m), symmetric."""
        n, some = len(self.s), self.some
        felt = self.hold[:n] @ misfit @ self.move[:n]
        felt[some] += self.hold[n:] @ misfit[some] @ self.move[n:]
        return np.asarray(0.5 * (felt + felt.swapaxes(1, 2)))

    def _of_infinite(self) -> Array:
        """Normal matrix (p, p) of the infinite-frequency added mass."""
        j, k, m = self.j, self.k, self.hold.shape[1]
        inertia = self.twice(np.abs(self.s) ** 2) * self.hold
        whole = real_sum([_flat(inertia)], [_flat(self.move)]).reshape(m, m, m, m)
        a, b, c, d = j[:, None], k[:, None], j[None], k[None]
        pairs = whole[a, c, d, b] + whole[a, d, c, b] + whole[b, c, d, a] + whole[b, d, c, a]
        return np.asarray(pairs * self.once[:, None] * self.once)

    def infinite(self, misfit: Complex) -> Array:
        """Infinite-frequency added mass (m, m) that goes best with a misfit, zero where it is known."""
        from scipy.linalg import cho_solve

        out = np.zeros(self.target.shape[1:])
        if self.factor is not None:
            felt = np.sum((self.s.conj() * self(misfit)).real, axis=0)[self.j, self.k]
            values = cho_solve((self.factor, True), 2.0 * self.once * felt)
            out[self.j, self.k] = out[self.k, self.j] = -values
        return out

    def infinite_of(self, model: Oscillators) -> Array:
        """Infinite-frequency added mass (m, m) that goes best with a model."""
        known = self.data.added_mass_infinite
        return self.infinite(model.transfer(self.data.omega) - self.target) if known is None else known


def _flat(values: Complex) -> Complex:
    return values.reshape(len(values), -1)


def real_sum(left: Sequence[Complex], right: Sequence[Complex]) -> Array:
    """``Re sum_n left[..., n, i] right[..., n, j]`` of arrays that follow each other in n."""
    rows = np.concatenate([*(one.real for one in left), *(-one.imag for one in left)], axis=-2)
    columns = np.concatenate([*(one.real for one in right), *(one.imag for one in right)], axis=-2)
    return np.asarray(rows.swapaxes(-1, -2) @ columns)


class CoupledProblem(OscillatorParameters):
    """Least squares over log w, a band of L, and b."""

    def __init__(self, felt: Felt, masses: int) -> None:
        width = [(np.arange(off, masses), np.arange(masses - off)) for off in range(min(BAND, masses))]
        rows, columns = (np.concatenate(each) for each in zip(*width, strict=True))
        super().__init__(felt.data.omega, felt.target.shape[1], masses, (rows, columns))
        self.felt, self.width = felt, len(width)

    def steps(self, guess: Oscillators) -> Iterator[Oscillators]:
        """The models of a Levenberg-Marquardt search. Motions may be emphasised between two of them."""
        from scipy.linalg import cho_factor, cho_solve

        parameters, damping = self.pack(guess), 1e-2
        while True:
            here = _Point(self, parameters)
            square, right = here.normal_equations()
            diagonal = np.diagonal(square).copy()
            diagonal += 1e-9 * diagonal.mean()
            while damping < MOST_DAMPING:
                held = square.copy()
                held.flat[:: len(square) + 1] += damping * diagonal
                with one_thread:  # SciPy came with threads of its own
                    factor = cho_factor(held, lower=True, overwrite_a=True, check_finite=False)
                    step = cho_solve(factor, right, check_finite=False)
                tried = _Point(self, here.parameters - step)
                if tried.cost < here.cost:
                    parameters, damping = tried.parameters, max(0.2 * damping, 1e-9)
                    break
                damping *= 4.0
            yield self.oscillators(parameters)


class _Point:
    """The misfit where a search is, its sum of squares, and the derivatives of this."""

    def __init__(self, problem: CoupledProblem, parameters: Array) -> None:
        self.problem, self.parameters, felt = problem, parameters, problem.felt
        model = problem.oscillators(parameters)
        self.x = model.deflection(felt.data.omega)
        misfit = felt.s * (model.coupling.T @ self.x) - felt.target
        self.misfit = misfit + felt.s * felt.infinite(misfit)
        self.pull = felt(self.misfit)
        self.sizes, slope = problem.sizes(parameters)
        self.size_slope = slope[:, : -model.coupling.size]
        self.cost = float(np.vdot(self.misfit, self.pull).real + self.sizes @ self.sizes)

    def normal_equations(self) -> tuple[Array, Array]:
        """Gauss and Newton's matrix, and half the gradient, with the best added mass at each point.

        A coupling changes the kernel by ``e z^T + z e^T``, z = s x and e a unit vector; a damper by
        ``z y^T + y z^T``, y = -L^T z; a frequency by ``z t^T + t z^T``, t in proportion to x.
        """
        problem, felt = self.problem, self.problem.felt
        n, m, s = problem.n, problem.m, felt.s
        w, factor, _ = problem.unpack(self.parameters)
        z = s * self.x
        t = -(w * problem.angle_slope(self.parameters))[:, None] * self.x
        every: Complex = np.concatenate([z, -factor.T @ z, t], axis=1)
        vectors = felt.twice(every)
        held, moved = vectors.conj() @ felt.hold, vectors.conj() @ felt.move.swapaxes(1, 2)
        both = vectors.swapaxes(1, 2)
        across = held @ both, moved @ both  # (a, b): a^* H b, and b^T M a^*
        of_mass = slice(0, n)
        sources = [(slice(2 * n, 3 * n), of_mass)]
        sources += [(slice(off, n), slice(n, 2 * n - off)) for off in range(problem.width)]
        own = _among_sources(across, sources, n) + self.size_slope.T @ self.size_slope
        mixed = np.concatenate([_by_vectors(held, moved, across, one, of_mass) for one in sources])
        mixed = mixed.swapaxes(1, 2).reshape(len(own), n * m)
        square = np.block([[own, mixed], [mixed.T, self._among_couplings(held, moved, across)]])
        right = every.conj()
        turned = right @ self.pull
        slopes = [2.0 * np.sum((turned[:, u] * right[:, v]).real, axis=(0, 2)) for u, v in sources]
        coupling = 2.0 * np.sum((s.conj() * (self.x.conj() @ self.pull)).real, axis=0)
        gradient = np.concatenate(slopes) + self.size_slope.T @ self.sizes
        if felt.factor is not None:
            square -= self._of_infinite(held, moved, sources)
        return square, np.concatenate([gradient, coupling.ravel()])

    def _among_couplings(self, held: Complex, moved: Complex, across: tuple[Complex, Complex]) -> Array:
        n, m, felt = self.problem.n, self.problem.m, self.problem.felt
        crossed = real_sum([_flat(held[:, :n])], [_flat(moved[:, :n].conj())])
        crossed = (crossed + crossed.T).reshape(n, m, n, m).transpose(0, 3, 2, 1)
        left = [_flat(one[:, :n, :n]) for one in across]
        right = [_flat(felt.move.swapaxes(1, 2)), _flat(felt.hold)]
        straight = real_sum(left, right).reshape(n, n, m, m)
        return np.asarray((crossed + straight.transpose(0, 2, 1, 3)).reshape(n * m, n * m))

    def _of_infinite(self, held: Complex, moved: Complex, sources: list[tuple[slice, slice]]) -> Array:
        """What the added mass that goes best with each point takes from the matrix."""
        from scipy.linalg import solve_triangular

        felt, n, m = self.problem.felt, self.problem.n, self.problem.m
        j, k = felt.j, felt.k
        s = felt.twice(felt.s)
        risen, moving = (s * held).swapaxes(0, 1), moved.swapaxes(0, 1)
        own = np.concatenate([real_sum([risen[v], risen[u]], [moving[u], moving[v]]) for u, v in sources])
        first = real_sum([_flat(s * held[:, :n])], [_flat(felt.move.swapaxes(1, 2))]).reshape(n, m, m, m)
        second = real_sum([_flat(s * moved[:, :n])], [_flat(felt.hold)]).reshape(n, m, m, m)
        every = first + second.transpose(0, 3, 2, 1)  # mass, j, motion of the coupling, k
        coupled = (every[:, j, :, k] + every[:, k, :, j]).reshape(len(j), n * m)
        rows = np.concatenate([(own[:, j, k] + own[:, k, j]).T, coupled], axis=1) * felt.once[:, None]
        part = solve_triangular(felt.factor, rows, lower=True, check_finite=False)
        return np.asarray(part.T @ part)


def _among_sources(across: tuple[Complex, Complex], sources: list[tuple[slice, slice]], n: int) -> Array:
    """Products of ``u v^T + v u^T`` among each other.

    Vectors are of three kinds, n of each. What two kinds make of each other lies in one row here, and a block
    of it is a piece of that row: its sums are one long loop, and what stands between its lines is left out.
    """
    planes = [one.reshape(-1, 3, n, 3, n).transpose(1, 3, 0, 2, 4) for one in across]
    held, moved = (
        [part.reshape(3, 3, -1, n * n) for part in (one.real.copy(), one.imag.copy())] for one in planes
    )

    def product(a: tuple[slice, slice], b: tuple[slice, slice], size: int) -> Array:
        (i, p), (j, q), (k, r), (m, s) = (divmod(each.start, n) for each in (*a, *b))
        left, right = slice(p * n + q, p * n + q + size), slice(r * n + s, r * n + s + size)
        sums = (
            np.einsum("ni,ni->i", one[i, j, :, left], other[k, m, :, right])
            for one, other in zip(held, moved, strict=True)
        )
        return np.asarray(next(sums) - next(sums))

    rows: list[list[Array]] = []
    for i, (u, v) in enumerate(sources):
        row = [rows[k][i].T for k in range(i)]
        for c, d in sources[i:]:
            high, wide = u.stop - u.start, c.stop - c.start
            size = (high - 1) * n + wide
            crossed = product((v, c), (u, d), size) + product((u, d), (v, c), size)
            whole = crossed + product((v, d), (u, c), size) + product((u, c), (v, d), size)
            row.append(np.resize(whole, (high, n))[:, :wide])
        rows.append(row)
    return np.block(rows)


def _by_vectors(
    held: Complex, moved: Complex, across: tuple[Complex, Complex], one: tuple[slice, slice], of: slice
) -> Array:
    """Products (sources, m, masses) of ``u v^T + v u^T`` with ``e z^T + z e^T``."""
    u, v = one
    left = [held[:, v], moved[:, u], held[:, u], moved[:, v]]
    right = [across[1][:, u, of], across[0][:, v, of], across[1][:, v, of], across[0][:, u, of]]
    return real_sum([part.swapaxes(0, 1) for part in left], [part.swapaxes(0, 1) for part in right])


def first_guess(data: CoupledData, masses: int) -> Oscillators:
    """Masses at some frequencies of the band, coupled to the motions by which most is radiated there.

    The damping of a mass has the integral ``pi / 2 b b^T`` over the frequency: a step's share of the data.
    """
    edges = np.linspace(LOWEST_FREQUENCY, BEYOND * data.omega[data.trusted][-1], masses // A_PLACE + 3)
    middles, step = 0.5 * (edges[1:] + edges[:-1]), edges[1] - edges[0]
    nearest = np.abs(data.omega - middles[:, None]).argmin(axis=1)
    values, vectors = np.linalg.eigh(data.kernel.real[nearest])
    place, rank = np.unravel_index(np.sort(np.argsort(-values, axis=None)[:masses]), values.shape)
    size = np.sqrt(np.maximum(values[place, rank], 1e-3) * step * 2.0 / np.pi)
    apart = 0.1 * step * (np.arange(masses) % A_PLACE - 1.0)
    return Oscillators(
        w=middles[place] + apart, dampers=(step + FLOOR) * np.eye(masses),
        coupling=vectors[place, :, rank] * size[:, None],
    )  # fmt: skip
