"""Frequency-domain identification of one retardation function as a stable rational function.

Model, with ``s = i omega``::

    B(omega) + i omega A(omega) = N(s) / P(s) + s A_inf + K_0 / s

``P`` has degree n and is a product of factors ``s^2 + q1 s + q0`` (and ``s + p`` for odd n) with positive
coefficients, so that every model tried is stable by construction and none is ever reflected. ``N`` has degree
n - 1 (the retardation function starts at a finite value) and, for radiation, a zero at s = 0 (no net drift
force). ``N``, and ``A_inf`` and ``K_0`` where they are unknown, enter linearly and are eliminated by least
squares at every step of a Gauss-Newton search over the factors (variable projection: Golub & Pereyra 1973;
for ships compare Perez & Fossen 2009, doi 10.4173/mic.2009.1.1).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.hydro_data import AdditionalMatrices
from seacrane.hydro.data.hydro_group_data import Hydrodynamics
from seacrane.hydro.data.memory_model import RADIATION, FitRow, MemoryModel
from seacrane.one_thread import one_thread

Tables = tuple[Array, Array]  # of added mass and of damping
OUTSIDE_WEIGHT = 0.2
AUDIT_WEIGHT = 3.0
NATURAL_FREQUENCY_RANGE = (0.1, 4.0)
DAMPING_RATIO_RANGE = (0.01, 1.2)
NEGLIGIBLE = 1e-4  # a panel code's noise in pairs that a box makes zero is a fifth of it
FEWEST_FREQUENCIES = 8


@dataclass(frozen=True, kw_only=True, eq=False)
class RationalFit:
    """``numerator`` (n,) and ``denominator`` (n + 1,), highest power first; `four_r2` of the fit."""

    numerator: Array
    denominator: Array
    added_mass_infinite: float
    static_stiffness: float
    quality: dict[str, float]

    def kernel(self, omega: Array) -> Complex:
        """Retardation function at ``omega`` (n,)."""
        s = 1j * omega
        return np.asarray(np.polyval(self.numerator, s) / np.polyval(self.denominator, s))

    @property
    def worst(self) -> float:
        """The smaller R2 of the trusted band."""
        return worst_r2(self.quality)


@dataclass(frozen=True, kw_only=True, eq=False)
class IdentificationData:
    """One entry's data (n,), which of them are ``trusted`` (n,) bool, and what is known beside them.

    ``dissipation_limit`` gives, at any frequencies, the (low, high) between which the fitted damping is to
    stay: above zero on the diagonal, within the geometric mean of the fitted diagonals elsewhere. ``weight``
    (n,), where it is given, is that of a misfit of the damping, and times omega that of the added mass.
    """

    omega: Array
    added_mass: Array
    damping: Array
    trusted: NDArray[np.bool_]
    added_mass_infinite: float | None
    zero_at_origin: bool = True
    static_stiffness: bool = False
    dissipation_limit: Callable[[Array], tuple[Array, Array]] | None = None
    weight: Array | None = None


def fit_lowest_order(
    data: IdentificationData, *, orders: range, error: Callable[[RationalFit], float], limit: float,
    gain: float = 0.0, allowed: Callable[[RationalFit], bool] = lambda fit: True,
) -> RationalFit:  # fmt: skip
    """Fit of the lowest of some orders whose ``error`` keeps ``limit``, else the best one found.

    Higher orders are better by the share ``gain``, and ``allowed``; or else they are not taken.
    """
    best: tuple[float, RationalFit] | None = None
    start: list[Array] = []
    for order in orders:
        fit, parameters = fit_order(data, order=order, starts=start)
        start = [parameters]
        found = error(fit)
        if best is not None and not allowed(fit):
            continue
        if best is None or found < (1.0 - gain) * best[0]:
            best = (found, fit)
        if found <= limit:
            break
    assert best is not None
    return best[1]


def fit_order(data: IdentificationData, *, order: int, starts: list[Array]) -> tuple[RationalFit, Array]:
    """Best fit of one order over several starts, among them ``starts``, parameters of lower orders."""
    from scipy.optimize import least_squares

    problem = _Problem(data, order)
    low, high = problem.bounds()
    best: tuple[float, Array] | None = None
    for guess in problem.starting_points(starts):
        inside = np.clip(guess, low + 1e-6, high - 1e-6)
        with one_thread:
            found = least_squares(
                problem.residual, inside, bounds=(low, high), method="trf", xtol=1e-10, max_nfev=60
            )
        if best is None or found.cost < best[0]:
            best = (float(found.cost), found.x)
    assert best is not None
    return problem.result(best[1]), best[1]


class _Problem:
    """Least-squares problem of one order: parameters are log natural frequencies and log damping ratios."""

    def __init__(self, data: IdentificationData, order: int) -> None:
        self.data, self.order = data, order
        self.pairs, self.real = divmod(order, 2)
        inside = data.trusted
        weight = np.where(inside, 1.0, OUTSIDE_WEIGHT)
        self.scale_a, self.scale_b = (
            weight / (float(np.sqrt(np.sum((x - x.mean()) ** 2))) or 1.0)
            for x in (data.added_mass[inside], data.damping[inside])
        )
        if data.weight is not None:
            self.scale_b, self.scale_a = data.weight, data.weight * data.omega
        known = data.added_mass_infinite
        self.target = np.concatenate(
            [data.damping * self.scale_b, (data.added_mass - (known or 0.0)) * self.scale_a]
        )
        s = 1j * data.omega
        first = 1 if data.zero_at_origin else 0
        self.powers = np.stack([s**k for k in range(first, order)], axis=1)
        zero = np.zeros_like(data.omega)
        extra = [np.zeros((2 * len(zero), 0))]  # columns of A_inf and K_0 where they are unknown
        if known is None:
            extra.append(np.concatenate([zero, self.scale_a])[:, None])
        if data.static_stiffness:
            extra.append(np.concatenate([zero, -self.scale_a / data.omega**2])[:, None])
        self.extra = np.hstack(extra)
        self.audit = np.geomspace(0.02, 50.0, 80)
        self.audit_powers = np.stack([(1j * self.audit) ** k for k in range(first, order)], axis=1)
        if data.dissipation_limit is not None:
            self.audit_low, self.audit_high = data.dissipation_limit(self.audit)

    def bounds(self) -> tuple[Array, Array]:
        """Box of the parameters: natural frequencies, then damping ratios, then the real pole."""
        frequency, ratio = np.log(NATURAL_FREQUENCY_RANGE), np.log(DAMPING_RATIO_RANGE)
        kinds = [frequency] * self.pairs + [ratio] * self.pairs + [frequency] * self.real
        box = np.array(kinds)
        return box[:, 0], box[:, 1]

    def starting_points(self, lower: list[Array]) -> list[Array]:
        """Spread poles at two damping ratios, and the lower order's poles with one more factor."""
        low, high = self.data.omega[self.data.trusted][[0, -1]]
        low = max(low, 0.4)
        spread = np.log(np.geomspace(low, 0.9 * high, self.pairs + 2)[1:-1])
        middle = [0.5 * np.log(low * high)] * self.real
        points = [np.concatenate([spread, np.full(self.pairs, np.log(z)), middle]) for z in (0.15, 0.5)]
        for known in lower:
            pairs, real = divmod(len(known), 2)
            if self.pairs == pairs:  # one real pole more
                points += [np.append(known, np.log(p)) for p in (0.5, 1.5)]
            elif self.pairs == pairs + 1 and real:  # the real pole becomes a pair
                w = known[-1]
                points.append(np.concatenate([known[:pairs], [w], known[pairs : 2 * pairs], [np.log(0.9)]]))
        return points

    def denominator(self, parameters: Array) -> Array:
        """Coefficients (order + 1,), highest power first."""
        polynomial = np.ones(1)
        for i in range(self.pairs):
            w, z = np.exp(parameters[i]), np.exp(parameters[self.pairs + i])
            polynomial = np.convolve(polynomial, [1.0, 2.0 * z * w, w * w])
        if self.real:
            polynomial = np.convolve(polynomial, [1.0, np.exp(parameters[-1])])
        return polynomial

    def _columns(self, denominator: Array) -> Array:
        s = 1j * self.data.omega
        basis = self.powers / np.polyval(denominator, s)[:, None]
        damping = basis.real * self.scale_b[:, None]
        added_mass = basis.imag / self.data.omega[:, None] * self.scale_a[:, None]
        return np.hstack([np.vstack([damping, added_mass]), self.extra])

    def _coefficients(self, columns: Array) -> Array:
        size = np.linalg.norm(columns, axis=0)
        size[size == 0.0] = 1.0
        return np.asarray(np.linalg.lstsq(columns / size, self.target, rcond=1e-12)[0] / size)

    def residual(self, parameters: Array) -> Array:
        """Weighted misfit of B and A; for diagonal entries also the fitted damping's dips below zero."""
        denominator = self.denominator(parameters)
        columns = self._columns(denominator)
        coefficients = self._coefficients(columns)
        misfit = columns @ coefficients - self.target
        if self.data.dissipation_limit is None:
            return np.asarray(misfit)
        count = self.powers.shape[1]
        damping = (self.audit_powers @ coefficients[:count] / np.polyval(denominator, 1j * self.audit)).real
        excess = np.maximum(damping - self.audit_high, 0.0) + np.minimum(damping - self.audit_low, 0.0)
        return np.asarray(np.concatenate([misfit, AUDIT_WEIGHT * self.scale_b.max() * excess]))

    def result(self, parameters: Array) -> RationalFit:
        """Coefficients and R2 of one set of parameters."""
        data = self.data
        denominator = self.denominator(parameters)
        coefficients = self._coefficients(self._columns(denominator))
        count = self.powers.shape[1]
        extra = list(coefficients[count:])
        infinite = extra.pop(0) if data.added_mass_infinite is None else data.added_mass_infinite
        stiffness = extra.pop(0) if data.static_stiffness else 0.0
        numerator = np.zeros(self.order)
        numerator[:count] = coefficients[:count][::-1]
        kernel = np.polyval(numerator, 1j * data.omega) / np.polyval(denominator, 1j * data.omega)
        added_mass = infinite + kernel.imag / data.omega - stiffness / data.omega**2
        return RationalFit(
            numerator=numerator,
            denominator=denominator,
            added_mass_infinite=float(infinite),
            static_stiffness=float(stiffness),
            quality=four_r2((data.added_mass, data.damping), (added_mass, kernel.real), data.trusted),
        )


def r_squared(data: Array, model: Array) -> float:
    """Coefficient of determination, 1 minus the misfit's variance over the data's."""
    total = float(np.sum((data - data.mean()) ** 2))
    if total == 0.0:
        return 1.0 if np.array_equal(data, model) else -np.inf
    return 1.0 - float(np.sum((data - model) ** 2)) / total


def four_r2(data: Tables, fitted: Tables, inside: NDArray[np.bool_]) -> dict[str, float]:
    """R2 of added mass and damping (n,), by their names in `FitRow`: of those ``inside`` (n,), and of all."""
    names = ("r2_added_mass", "r2_damping")
    both = list(zip(names, data, fitted, strict=True))
    return {name: r_squared(x[inside], model[inside]) for name, x, model in both} | {
        f"{name}_all": r_squared(x, model) for name, x, model in both
    }


def worst_r2(quality: dict[str, float]) -> float:
    """The smaller of those ``inside``."""
    return min(quality["r2_added_mass"], quality["r2_damping"])


def pair_r2(
    pair: tuple[int, int], data: Tables, fitted: Tables, inside: NDArray[np.bool_]
) -> dict[str, float]:
    """`four_r2` of a pair (j, k) of tables (n, m, m), those of the data made symmetric."""
    j, k = pair
    a, b = (0.5 * (x[:, j, k] + x[:, k, j]) for x in data)
    return four_r2((a, b), (fitted[0][:, j, k], fitted[1][:, j, k]), inside)


def fit_row(
    cause: str, pair: tuple[int, int], poles: Complex, quality: dict[str, float], least: float
) -> FitRow:
    """Row of a pair with a `four_r2`, accepted where the worst is not below ``least``."""
    return FitRow(
        cause=cause, output=pair[0], input=pair[1], order=len(poles), **quality,
        slowest_decay=float(-poles.real.max()), fastest_pole=float(np.abs(poles).max()),
        accepted=worst_r2(quality) >= least,
    )  # fmt: skip


def judged_rows(
    model: MemoryModel, database: Hydrodynamics, cause: str, pairs: Iterable[tuple[int, int]], least: float
) -> list[FitRow]:
    """Rows of pairs (j <= k) of a cause that the model has blocks for, against a database's data."""
    radiation = cause == RADIATION
    parts: dict[str, Hydrodynamics | AdditionalMatrices] = {RADIATION: database}
    part = (parts | {one.cause: one for one in database.additional})[cause]
    fitted = (model.frequency_response if radiation else model.additional_response)(database.omega)
    data, inside = (part.added_mass, part.damping), within(database.omega, model.band)
    rows, blocks = [], [(one, one.poles) for one in model.blocks if one.cause == cause]
    for j, k in pairs:
        of_pair = [poles for one, poles in blocks if j in one.outputs and k in one.inputs]
        if of_pair:
            poles = np.concatenate(of_pair)
            rows.append(fit_row(cause, (j, k), poles, pair_r2((j, k), data, fitted, inside), least))
    return rows


def symmetric(matrices: Array) -> Array:
    """The symmetric part of matrices (..., m, m)."""
    return np.asarray(0.5 * (matrices + matrices.swapaxes(-1, -2)))


def judged_band(
    database: Hydrodynamics, band: tuple[float, float] | None = None
) -> tuple[tuple[float, float], NDArray[np.bool_]]:
    """``band``, or the trusted one, or that of all frequencies, in rad/s; and which (n,) lie in it.

    Raises ValueError: too few do.
    """
    low, high = map(float, band or database.trusted_band or database.omega[[0, -1]])
    inside = within(database.omega, (low, high))
    if inside.sum() < FEWEST_FREQUENCIES:
        raise ValueError(
            f"database {database.name!r}: the band {low:.4g} to {high:.4g} rad/s holds {inside.sum()} "
            f"frequencies; a memory needs {FEWEST_FREQUENCIES} or more: widen it"
        )
    return (low, high), inside


def within(omega: Array, band: tuple[float, float]) -> NDArray[np.bool_]:
    """Which frequencies (n,) lie in a band, ends included."""
    return np.asarray((omega >= band[0] - 1e-9) & (omega <= band[1] + 1e-9))


def memory_entries(
    added_mass: Array, damping: Array, omega: Array, *, mirrored: bool = False
) -> Iterator[tuple[int, int]]:
    """Entries (j <= k) with any memory, judged against the geometric mean of their diagonals.

    ``mirrored``: of a vessel alike to port and starboard, whose surge, heave and pitch know nothing of sway,
    roll and yaw; what a file holds there is noise.
    """
    variation = np.ptp(added_mass, axis=0) * float(np.mean(omega)) + np.abs(damping).max(axis=0)
    diagonal = np.sqrt(np.diag(variation))
    motions = len(diagonal)
    for offset in range(motions):  # diagonals first: they bound the damping of the others
        for j in range(motions - offset):
            k = j + offset
            if mirrored and offset % 2:
                continue
            if variation[j, k] > NEGLIGIBLE * diagonal[j] * diagonal[k] and variation[j, k] > 0.0:
                yield j, k


def motion_groups(pairs: list[tuple[int, int]]) -> list[list[int]]:
    """Motions that hang together through ``pairs``, each group in increasing order."""
    groups: list[set[int]] = []
    for pair in pairs:
        touched = [group for group in groups if group & set(pair)]
        groups = [group for group in groups if group not in touched]
        groups.append(set(pair).union(*touched))
    return sorted(sorted(group) for group in groups)


def dissipation_limit(
    fits: dict[tuple[int, int], RationalFit], j: int, k: int
) -> Callable[[Array], tuple[Array, Array]]:
    """Bounds of the fitted damping: a 2 x 2 damping matrix is positive if b_jk^2 <= b_jj b_kk."""

    def limit(omega: Array) -> tuple[Array, Array]:
        if j == k:
            return np.zeros_like(omega), np.full_like(omega, np.inf)
        bound = np.zeros_like(omega)
        if (j, j) in fits and (k, k) in fits:
            a, b = (np.maximum(fits[i, i].kernel(omega).real, 0.0) for i in (j, k))
            bound = np.sqrt(a * b)
        return -bound, bound

    return limit
