"""One record: checked values, up-crossings of its mean, the crest between each two, and its spectrum."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.brief import brief
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import numbers_of, positive_of
from seacrane.statistics.estimate import TAILS
from seacrane.warnings import RepeatingSeaWarning, StartTransientWarning

Places = NDArray[np.intp]
FEWEST_VALUES = 64
ROUNDING = 1e-12  # of its size by which a constant may vary
SEGMENTS = 15  # of a spectrum, half overlapping, where the record is long enough
PARTS = 20  # of a record, of which the first fifth is compared with the rest
CYCLES = 5.0  # that a part must hold at least
UNLIKELY = 0.002  # probability, for each of mean and variance, of a warning without cause
CLEAR_MEAN, CLEAR_SPREAD = 0.25, 0.1  # of the standard deviation: smaller changes are let pass


def listed(what: str, given: Any, *, fewest: int, finite: str, varied: str) -> Array:
    """One list of finite numbers that are not all equal, or a SceneError with what mends it."""
    values = numbers_of(what, given)
    if values.ndim != 1 or values.size < fewest:
        raise SceneError(f"{what} of shape {values.shape}: give one list of at least {fewest}")
    if not np.isfinite(values).all():
        raise SceneError(f"{what}: not all are finite; {finite}")
    if np.ptp(values) <= ROUNDING * np.abs(values).max():
        raise SceneError(f"{what}: all are {values[0]:g}; {varied}")
    return values


def record_of(values: Any) -> Array:
    """Values of a record that varies, at least 64, any unit, or a SceneError."""
    return listed(
        "values", values, fewest=FEWEST_VALUES, finite="take a part of the record without gaps",
        varied="a record that does not vary has no extremes",
    )  # fmt: skip


def up_crossings(values: Array, level: float) -> Places:
    """Index of the last value at or below `level` before each up-crossing."""
    above = values > level
    return np.flatnonzero(~above[:-1] & above[1:])


def crests(values: Array, level: float) -> Array:
    """Largest value between each two up-crossings of `level`, by the parabola through its neighbours.

    One for each whole cycle, in the order of time, as heights above `level`.
    """
    starts = up_crossings(values, level)
    if starts.size < 2:
        return np.empty(0)
    tops = np.array([a + 1 + int(np.argmax(values[a + 1 : b + 1])) for a, b in pairwise(starts.tolist())])
    return np.asarray(_vertex(values, tops) - level)


def highest_third(heights: Array) -> float:
    """Mean of the highest third of crests."""
    return float(np.sort(heights)[-max(1, heights.size // 3) :].mean())


def _vertex(values: Array, tops: Places) -> Array:
    """Top of the parabola through each largest value and its two neighbours."""
    before, top, after = values[tops - 1], values[tops], values[tops + 1]
    bend = 2.0 * top - before - after
    slope = 0.5 * (after - before)
    rise = np.divide(slope**2, 2.0 * bend, out=np.zeros_like(top), where=bend > 0.0)
    return np.asarray(top + np.where(np.abs(slope) <= bend, rise, 0.0))


def start_differs(values: Array, cycles: float) -> bool | None:
    """Whether the first fifth differs from the rest in mean or standard deviation, beyond chance.

    None where the record is too short to tell: fewer than 50 cycles.
    """
    parts = PARTS if cycles >= CYCLES * PARTS else PARTS // 2
    if cycles < CYCLES * parts:
        return None
    rows = values[: values.size - values.size % parts].reshape(parts, -1)
    spread = float(values[values.size // 5 :].std()) or 1.0
    mean, variance = rows.mean(axis=1) / spread, rows.var(axis=1) / spread**2
    return _stands_out(mean, CLEAR_MEAN) or _stands_out(variance, 2.0 * CLEAR_SPREAD)


def _stands_out(numbers: Array, clear: float) -> bool:
    """Whether the first fifth differs from the rest by more than the rest's own scatter explains."""
    from scipy.stats import t

    first, rest = numbers[: numbers.size // 5], numbers[numbers.size // 5 :]
    difference = abs(float(first.mean() - rest.mean()))
    scatter = float(rest.std(ddof=1)) * np.sqrt(1.0 / first.size + 1.0 / rest.size)
    return bool(difference > clear and difference > scatter * t.ppf(1.0 - UNLIKELY / 2.0, rest.size - 1))


def warn_of_start(values: Array, cycles: float) -> None:
    """Warn with StartTransientWarning."""
    if start_differs(values, cycles):
        warn_caller(
            "the first fifth of the record differs from the rest in mean or standard deviation: leave the "
            "start out, with after= in s",
            StartTransientWarning,
        )


def warn_of_repeat(repeat: float | None, duration: float) -> None:
    """Warn with RepeatingSeaWarning if a sea comes back on itself within a record."""
    if repeat is not None and repeat < duration:
        warn_caller(
            f"the sea repeats after {repeat:g} s within a record of {duration:g} s: its maxima are those of "
            f"{repeat:g} s; take more components, or placement='jittered'",
            RepeatingSeaWarning,
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class SpectrumEstimate:
    """One-sided spectrum of a record. Made by `spectrum_estimate`.

    Attributes
    ----------
    omega : ndarray, shape (m,)
        rad/s, evenly spaced from above zero.
    density : ndarray, shape (m,)
        Squared unit of the record times s/rad; its integral is the variance.
    degrees_of_freedom : float
        Of each density: half-overlapping Hann segments count by their correlation.
    duration : float
        Of the record, s.
    """

    omega: Array
    density: Array
    degrees_of_freedom: float
    duration: float

    __repr__ = brief

    def moment(self, order: int) -> float:
        """Integral of omega^order times density."""
        return float(np.sum(self.omega**order * self.density) * self.omega[0])

    @property
    def std(self) -> float:
        """Square root of the variance."""
        return float(np.sqrt(self.moment(0)))

    @property
    def crossing_rate(self) -> float:
        """Up-crossings of the mean by a Gaussian process, sqrt(m2 / m0) / 2 pi, 1/s."""
        return float(np.sqrt(self.moment(2) / self.moment(0)) / (2.0 * np.pi))

    @property
    def bandwidth(self) -> float:
        """Vanmarcke's sqrt(1 - m1^2 / (m0 m2)): 0 for one frequency, towards 1 for many."""
        ratio = self.moment(1) ** 2 / (self.moment(0) * self.moment(2))
        return float(np.sqrt(max(0.0, 1.0 - ratio)))

    @property
    def variance_degrees(self) -> float:
        """Degrees of freedom of the variance of a Gaussian process: T m0^2 / (pi int S^2), and at least 1."""
        square = float(np.sum(self.density**2) * self.omega[0]) / (1.0 + 2.0 / self.degrees_of_freedom)
        return max(1.0, self.duration * self.moment(0) ** 2 / (np.pi * square))

    def interval(self) -> tuple[Array, Array]:
        """Bounds of the 95 % interval of every density, by chi-squared."""
        low, high = by_chi_squared(self.degrees_of_freedom).tolist()
        return self.density * low, self.density * high


def by_chi_squared(degrees: float) -> Array:
    """Ends (2,) of the 95 % interval of a variance, over its estimate with so many degrees of freedom."""
    from scipy.stats import chi2

    return np.asarray(degrees / chi2.ppf(TAILS[::-1], degrees))


def spectrum_estimate(values: Any, *, interval: float, segments: int = SEGMENTS) -> SpectrumEstimate:
    """Estimate the spectrum of a record by Welch's method: half-overlapping Hann segments.

    Parameters
    ----------
    values : array_like, shape (n,)
        At even times, any unit.
    interval : float
        Between two values, s.
    segments : int
        How many, at least 1; fewer are taken where each would have fewer than 64 values.

    Raises
    ------
    SceneError
        For a record with fewer than 64 values, one that does not vary, or a number out of range.
    """
    from scipy.signal import welch

    record, step = record_of(values), positive_of("interval", interval)
    if not isinstance(segments, (int, np.integer)) or segments < 1:
        raise SceneError(f"segments={segments!r}: give a whole number of at least 1")
    length = min(record.size, max(FEWEST_VALUES, 2 * record.size // (int(segments) + 1)))
    count = 1 + 2 * (record.size - length) // length
    # 2 K over 1 + 2 (1 - 1/K) / 36: neighbouring Hann segments that overlap by half correlate by 1/6.
    degrees = 2.0 * count / (1.0 + 2.0 * (1.0 - 1.0 / count) / 36.0)
    frequency, density = welch(record - record.mean(), fs=1.0 / step, nperseg=length, detrend=False)
    return SpectrumEstimate(
        omega=2.0 * np.pi * frequency[1:], density=density[1:] / (2.0 * np.pi),
        degrees_of_freedom=degrees, duration=record.size * step,
    )  # fmt: skip
