"""Spectrum of a record by Welch's method, with its degrees of freedom and moments."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import positive_of
from seacrane.statistics.estimate import TAILS
from seacrane.statistics.record import FEWEST_VALUES, record_of

Array = NDArray[np.float64]
SEGMENTS = 15  # half overlapping, where the record is long enough


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
    frequency, density = welch(record - record.mean(), fs=1.0 / step, nperseg=length, detrend=False)
    return SpectrumEstimate(
        omega=2.0 * np.pi * frequency[1:], density=density[1:] / (2.0 * np.pi),
        degrees_of_freedom=_degrees(count), duration=record.size * step,
    )  # fmt: skip


def _degrees(count: int) -> float:
    """2 K over 1 + 2 (1 - 1/K) / 36: neighbouring Hann segments that overlap by half correlate by 1/6."""
    return 2.0 * count / (1.0 + 2.0 * (1.0 - 1.0 / count) / 36.0)
