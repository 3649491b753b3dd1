"""Everything one record tells of its extremes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of, positive_of
from seacrane.plotting.panel import Line, Panel, Sheet
from seacrane.plotting.table import Table
from seacrane.sea.crossings import expected_crossings
from seacrane.statistics.estimate import (
    THREE_HOURS,
    Estimate,
    Extremes,
    Maximum,
    gaussian_maximum,
    maxima_table,
)
from seacrane.statistics.record import (
    SpectrumEstimate,
    by_chi_squared,
    crests,
    highest_third,
    record_of,
    spectrum_estimate,
    up_crossings,
    warn_of_repeat,
    warn_of_start,
)
from seacrane.statistics.tail import FEWEST_PEAKS, Tail, peaks_over_threshold
from seacrane.warnings import PoorFitWarning

LEVELS = 200  # of a curve
LOWEST = 0.03  # crossings in the exposure time that are drawn
MOST_KURTOSIS = 3.0  # excess, of records whose largest value a Gaussian process may tell


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RecordExtremes(Extremes):
    """Statistics of one record. Made by `record_extremes` and `extremes`; prints as a table.

    Attributes
    ----------
    name, unit : str
        What was recorded.
    duration, exposure : float
        Of the record, and of what is asked, s.
    skewness, kurtosis : float
        Both 0 for a Gaussian process: the latter is the excess over 3.
    static : float
        What the dynamic factor is taken of.
    significant : float
        Mean of the highest third of crests above the mean of the record.
    crossing_rate, period : float
        Up-crossings of the mean, 1/s, and the time between two, s.
    crests : ndarray, shape (n,)
        The largest value between each two up-crossings, ascending.
    gaussian : Maximum
        Rayleigh's: as if the process were Gaussian, every crossing independent, sqrt(2 ln N). The intervals
        hold the scatter of the standard deviation.
    clumped : Maximum
        Vanmarcke's: the same with crossings in clumps, by the bandwidth of the spectrum.
    tail : Tail or None
        Peaks over a threshold; None where the record has too few.
    over_threshold : Maximum or None
        From this tail.
    """

    mean: float
    std: float
    largest: float
    skewness: float
    kurtosis: float
    significant: float
    crossing_rate: float
    crests: Array
    spectrum: SpectrumEstimate
    gaussian: Maximum
    clumped: Maximum
    tail: Tail | None
    over_threshold: Maximum | None

    @property
    def period(self) -> float:
        """Mean time between two up-crossings of the mean, s."""
        return 1.0 / self.crossing_rate

    @property
    def maximum(self) -> Maximum:
        """By peaks over the threshold; where these are too few, as if Gaussian with clumps."""
        return self.over_threshold or self.clumped

    def exceedance(self, levels: Any) -> Array:
        """Share of the crests above levels."""
        above = self.crests.size - np.searchsorted(self.crests, np.asarray(levels, dtype=float), side="right")
        return np.asarray(above / self.crests.size)

    def sheet(self) -> Sheet:
        """Crossings over levels: one is left at the most probable maximum."""
        top = max(self.largest, self.gaussian.p90.value, self.maximum.p90.value)
        levels = np.linspace(self.mean, top, LEVELS)
        counted = self.crests.size * self.exceedance(levels) * self.exposure / self.duration
        clumped = _crossings(self, levels, self.spectrum.bandwidth)
        lines = [
            Line(label="crests counted", values=_frequent(counted)),
            Line(label="Rayleigh", values=_frequent(_crossings(self, levels, None)), colour=1, style="--"),
            Line(label="clumped, Vanmarcke", values=_frequent(clumped), colour=2, style="--"),
        ]
        if self.tail is not None:
            above = np.where(levels >= self.tail.threshold, levels, np.nan)
            fitted = _frequent(self.tail.crossings(above, self.exposure))
            lines.append(Line(label="peaks over threshold", values=fitted, colour=3))
        return Sheet(
            title=f"{self.name}: crossings in {self.exposure:g} s",
            caption="Up-crossings of levels above the mean. One is left at the most probable maximum.",
            abscissa=levels, abscissa_name=self.name, abscissa_unit=self.unit, logarithmic=True,
            panels=(Panel(quantity="crossings", unit="-", lines=tuple(lines)),),
            marks={"most probable maximum": np.array([self.maximum.mpm.value])},
        )  # fmt: skip

    def _shown(self) -> Table:
        title = (
            f"{self.name} [{self.unit}], {self.duration:.4g} s: mean {self.mean:.4g}, std {self.std:.4g}, "
            f"significant crest {self.significant:.4g}, largest {self.largest:.4g}, "
            f"period {self.period:.4g} s. Maximum in {self.exposure:g} s, 95 % intervals:"
        )
        found = {"Rayleigh, sqrt(2 ln N)": self.gaussian, "clumped, Vanmarcke": self.clumped}
        if self.over_threshold is not None:
            found["peaks over threshold"] = self.over_threshold
        words = "Too few crests for peaks over a threshold."
        if self.tail is not None:
            words = (
                f"Threshold {self.tail.threshold:.4g} ({'chosen' if self.tail.chosen else 'given'}), "
                f"{self.tail.peaks.size} clusters, {self.tail.kind} tail, extremal index "
                f"{self.tail.extremal_index:.2f}."
            )
        return maxima_table(found, self.unit, title, words)


def _crossings(found: RecordExtremes, levels: Array, bandwidth: float | None) -> Array:
    cycles = found.crossing_rate * found.exposure
    reduced = (levels - found.mean) / found.std
    return np.array([expected_crossings(one, cycles=cycles, bandwidth=bandwidth) for one in reduced.tolist()])


def _frequent(crossings: Array) -> Array:
    """Without what is too rare to draw."""
    return np.where(crossings >= LOWEST, crossings, np.nan)


def record_extremes(
    values: Any,
    *,
    interval: float,
    exposure: float = THREE_HOURS,
    tail: str = "pareto",
    threshold: float | None = None,
    static: float | None = None,
    repeat: float | None = None,
    name: str = "record",
    unit: str = "-",
) -> RecordExtremes:
    """Estimate the largest value in an exposure time from one record.

    Parameters
    ----------
    values : array_like, shape (n,)
        At even times, any unit; for smallest values give them negative.
    interval : float
        Between two values, s; a tenth of the shortest period or less.
    exposure : float
        s; default 3 h.
    tail : str
        Of the peaks over the threshold: "pareto" (default; generalised), or "exponential", which is on the
        safe side of a Gaussian process.
    threshold : float, optional
        By default the lowest acceptable; `tail.threshold` tells which.
    static : float, optional
        What the dynamic factor is taken of; default the mean of the record.
    repeat : float, optional
        After which the sea repeats, s.
    name, unit : str
        What the table calls it.

    Raises
    ------
    SceneError
        For a record that is too short, does not vary or never crosses its mean, has too few crests and is
        far from Gaussian, or a number out of range.

    Warns
    -----
    StartTransientWarning, RepeatingSeaWarning, PoorFitWarning
    """
    record, step = record_of(values), positive_of("interval", interval)
    asked = positive_of("exposure", exposure)
    duration, mean, std = record.size * step, float(record.mean()), float(record.std())
    crossings = up_crossings(record, mean).size
    heights = crests(record, mean)
    if heights.size < 2:
        raise SceneError("values: the record crosses its mean fewer than three times; make it longer")
    warn_of_start(record, crossings)
    warn_of_repeat(repeat, duration)
    spectrum, rate = spectrum_estimate(record, interval=step), crossings / duration
    found = peaks_over_threshold(mean + heights, duration=duration, threshold=threshold, kind=tail)
    if found is not None and not found.accepted:
        warn_caller(
            f"the {tail} tail does not describe the {found.peaks.size} peaks over {found.threshold:.4g}: "
            "take another threshold= or tail=, or the maxima of many seeds",
            PoorFitWarning,
        )
    reduced = (record - mean) / std
    kurtosis = float(np.mean(reduced**4)) - 3.0
    if found is None and kurtosis > MOST_KURTOSIS:
        _refuse_or_warn_of_few(heights.size, kurtosis)
    return RecordExtremes(
        name=name, unit=unit, duration=duration, exposure=asked, mean=mean, std=std,
        largest=float(record.max()),
        skewness=float(np.mean(reduced**3)), kurtosis=kurtosis,
        static=mean if static is None else number_of("static", static), significant=highest_third(heights),
        crossing_rate=rate, crests=np.sort(mean + heights), spectrum=spectrum,
        gaussian=_gaussian(mean, std, rate, asked, spectrum, None),
        clumped=_gaussian(mean, std, rate, asked, spectrum, max(spectrum.bandwidth, 1e-6)),
        tail=found, over_threshold=None if found is None else found.maximum(asked),
    )  # fmt: skip


def _refuse_or_warn_of_few(crests: int, kurtosis: float) -> None:
    """Of snaps between which nothing happens: no tail is fitted, and no Gaussian process is like it."""
    told = (
        f"{crests} crests of a record that is far from Gaussian (excess kurtosis {kurtosis:.3g}), as of a "
        "line that is slack but for snaps: too few"
    )
    fix = "make the record longer, or take the maxima of many seeds (seed_extremes)"
    if crests < FEWEST_PEAKS:
        raise SceneError(f"values: {told} for a largest value; {fix}")
    warn_caller(
        f"values: {told} for peaks over a threshold, and the estimates as of a Gaussian process are far "
        f"below what comes; {fix}",
        PoorFitWarning,
    )


def _gaussian(
    mean: float, std: float, rate: float, exposure: float, spectrum: SpectrumEstimate, bandwidth: float | None
) -> Maximum:
    """The Gaussian maximum, with intervals from the scatter of the standard deviation."""
    low, high = np.sqrt(by_chi_squared(spectrum.variance_degrees)).tolist()
    unit = gaussian_maximum(std=1.0, rate=rate, exposure=exposure, bandwidth=bandwidth)

    def scaled(one: Estimate) -> Estimate:
        level = std * one.value
        return Estimate(value=mean + level, low=mean + low * level, high=mean + high * level)

    return Maximum(mpm=scaled(unit.mpm), mean=scaled(unit.mean), p90=scaled(unit.p90), exposure=exposure)
