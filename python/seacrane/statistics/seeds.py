"""The largest values of several seeds: by Gumbel's distribution and by rank, and how many are enough."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of, positive_of
from seacrane.plotting.panel import Line, Panel, Sheet
from seacrane.plotting.table import Table
from seacrane.statistics.estimate import EULER, P90_REDUCED, TAILS, Estimate, Extremes, Maximum, maxima_table
from seacrane.statistics.record import ROUNDING, listed
from seacrane.warnings import FewSeedsWarning, PoorFitWarning

FEWEST = 3
FEW = 10  # below which the fit test finds nothing
POOR = 0.05  # probability of a worse fit below which Gumbel's is not believed
REDUCED = {"mpm": 0.0, "mean": EULER, "p90": P90_REDUCED}  # in one record
ASKED = tuple(REDUCED)
NORMAL = 1.959964  # half width of the 95 % interval in standard deviations
DRAWS, FEWEST_DRAWS, VALUES = 4000, 500, 2_000_000  # samples that a bootstrap draws; values in all of them
BLOCK = 200_000  # values held at a time
SEED = 20250101
STEPS = 60  # of Newton's iteration, which has converged long before


def gumbel_fit(maxima: Array) -> tuple[Array, Array]:
    """Location and scale (...) of every row of maxima (..., k), not all equal, by maximum likelihood."""
    shifted = maxima - maxima.min(axis=-1, keepdims=True)
    mean = shifted.mean(axis=-1)
    scale = shifted.std(axis=-1) * np.sqrt(6.0) / np.pi
    for _ in range(STEPS):
        weight = np.exp(-shifted / scale[..., None])
        total = weight.sum(axis=-1)
        first = (shifted * weight).sum(axis=-1) / total
        second = (shifted**2 * weight).sum(axis=-1) / total
        step = (scale - mean + first) / (1.0 + (second - first**2) / scale**2)
        scale = np.maximum(scale - step, 0.2 * scale)
        if np.all(np.abs(step) <= 1e-12 * scale):
            break
    weight = np.exp(-shifted / scale[..., None])
    return maxima.min(axis=-1) - scale * np.log(weight.mean(axis=-1)), scale


def anderson_darling(maxima: Array, location: Array, scale: Array) -> Array:
    """Anderson and Darling's distance of every row from the Gumbel distribution that was fitted to it."""
    reduced = np.sort((maxima - location[..., None]) / scale[..., None], axis=-1)
    log_below = -np.exp(-reduced)
    log_above = np.log(-np.expm1(log_below))
    odd = 2.0 * np.arange(1, maxima.shape[-1] + 1) - 1.0
    return np.asarray(-maxima.shape[-1] - (odd * (log_below + log_above[..., ::-1])).mean(axis=-1))


@lru_cache(maxsize=32)
def standard_fits(count: int) -> tuple[Array, Array, Array]:
    """Location, scale and Anderson-Darling distance fitted to samples of the standard distribution.

    Of a family of location and scale they depend on the number of values alone: what they scatter by is the
    parametric bootstrap of every fit to as many maxima.
    """
    random = np.random.Generator(np.random.Philox(SEED))
    left = min(DRAWS, max(FEWEST_DRAWS, VALUES // count))
    blocks = []
    while left > 0:
        rows = min(left, max(1, BLOCK // count))
        draws = random.gumbel(size=(rows, count))
        location, scale = gumbel_fit(draws)
        blocks.append(np.array([location, scale, anderson_darling(draws, location, scale)]))
        left -= rows
    location, scale, distance = np.concatenate(blocks, axis=1)
    fits = (location, scale, distance)
    for one in fits:
        one.setflags(write=False)
    return fits


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class SeedExtremes(Extremes):
    """Statistics of the maxima of several seeds. Made by `seed_extremes` and `extremes`; prints as a table.

    Attributes
    ----------
    name, unit : str
        What was recorded.
    maxima : ndarray, shape (k,)
        One of each seed, ascending.
    duration, exposure : float
        Of each record, and of what is asked, s.
    static : float
        Of which half widths and the dynamic factor do not count.
    location, scale : float
        Of the Gumbel distribution of the maxima in one record, by maximum likelihood.
    fit_probability : float
        Probability that a Gumbel sample of as many fits worse (Anderson-Darling, parametric bootstrap).
    gumbel : Maximum
        In the exposure time, from this distribution.
    empirical : Maximum
        The same from the ordered maxima alone; intervals by their ranks, without any distribution.
    """

    maxima: Array
    location: float
    scale: float
    fit_probability: float
    gumbel: Maximum
    empirical: Maximum

    @property
    def maximum(self) -> Maximum:
        """By Gumbel's distribution."""
        return self.gumbel

    def relative_half_width(self, number: str = "mpm") -> float:
        """Half width of the 95 % interval over the dynamic part of "mpm", "mean" or "p90"."""
        estimate: Estimate = getattr(self.gumbel, _asked(number))
        return estimate.half_width / abs(estimate.value - self.static)

    def seeds_needed(self, half_width: float = 0.02, *, number: str = "mpm") -> int:
        """How many seeds bring the 95 % interval to +- `half_width` of the dynamic part.

        Parameters
        ----------
        half_width : float
            Share, such as 0.02.
        number : str
            "mpm", "mean" or "p90".

        Returns
        -------
        int
            At least 3, by the scatter of maximum likelihood with many seeds.
        """
        share = positive_of("half_width", half_width)
        estimate: Estimate = getattr(self.gumbel, _asked(number))
        reduced = float(REDUCED[number] + np.log(self.exposure / self.duration))
        # The variance of location + reduced * scale by maximum likelihood, times the number of maxima.
        variance = 6.0 / np.pi**2 * (np.pi**2 / 6.0 + (1.0 - EULER + reduced) ** 2)
        one = self.scale * np.sqrt(variance)
        return max(FEWEST, int(np.ceil((NORMAL * one / (share * abs(estimate.value - self.static))) ** 2)))

    def sheet(self) -> Sheet:
        """Maxima over Gumbel's reduced variable."""
        count = self.maxima.size
        reduced = -np.log(-np.log((np.arange(count) + 0.5) / count))
        fitted = (self.maxima - self.location) / self.scale
        lines = (
            Line(label="seeds", values=reduced, style="o"),
            Line(label="Gumbel, maximum likelihood", values=fitted, colour=1),
        )
        caption = (
            "Gumbel's distribution is the straight line. F is the share of seeds with a smaller maximum."
        )
        return Sheet(
            title=f"{self.name}: maxima of {count} seeds of {self.duration:g} s on Gumbel paper",
            caption=caption, abscissa=self.maxima, abscissa_name=self.name, abscissa_unit=self.unit,
            panels=(Panel(quantity="-ln(-ln F)", unit="-", lines=lines),),
            marks={"most probable maximum of a record": np.array([self.location])},
        )  # fmt: skip

    def _shown(self) -> Table:
        title = (
            f"{self.name} [{self.unit}], {self.maxima.size} seeds of {self.duration:g} s. "
            f"Maximum in {self.exposure:g} s, 95 % intervals:"
        )
        words = (
            f"Fit: a Gumbel sample is worse with probability {self.fit_probability:.2g}. "
            f"+-2 % of the most probable maximum takes {self.seeds_needed()} seeds."
        )
        return maxima_table({"Gumbel": self.gumbel, "empirical": self.empirical}, self.unit, title, words)


def seed_extremes(
    maxima: Any,
    *,
    duration: float,
    exposure: float | None = None,
    static: float = 0.0,
    half_width: float | None = None,
    number: str = "mpm",
    name: str = "maximum",
    unit: str = "-",
) -> SeedExtremes:
    """Estimate the largest value in an exposure time from the maxima of several seeds.

    Parameters
    ----------
    maxima : array_like, shape (k,)
        One of each seed, at least 3, any unit; for smallest values give them negative.
    duration : float
        Of each record, without its start, s.
    exposure : float, optional
        s; by default that of the records. Another one moves Gumbel's location by
        scale ln(exposure / duration).
    static : float
        Subtracted where a share of the value is told, for seeds change the dynamic part alone.
    half_width : float, optional
        Asked half width of the 95 % interval, as a share of the dynamic part: a FewSeedsWarning tells if it
        is not reached. By default one comes below ten seeds.
    number : str
        Of which: "mpm" (default), "mean" or "p90".
    name, unit : str
        What the table calls it.

    Raises
    ------
    SceneError
        For fewer than 3 maxima, maxima that are all equal, or a number out of range.

    Warns
    -----
    FewSeedsWarning, PoorFitWarning
    """
    values = listed(
        "maxima", maxima, fewest=FEWEST, finite="leave failed seeds out", varied="were the seeds different?"
    )
    values, length = np.sort(values), positive_of("duration", duration)
    asked = length if exposure is None else positive_of("exposure", exposure)
    share = None if half_width is None else positive_of("half_width", half_width)
    location, scale = (float(one) for one in gumbel_fit(values))
    worse = standard_fits(values.size)[2] > anderson_darling(values, np.array(location), np.array(scale))
    found = SeedExtremes(
        name=name, unit=unit, maxima=values, duration=length, exposure=asked,
        static=number_of("static", static), location=location, scale=scale,
        fit_probability=float(worse.mean()),
        gumbel=_gumbel_maximum(values.size, location, scale, length, asked),
        empirical=_empirical_maximum(values, length, asked),
    )  # fmt: skip
    _judge(found, share, _asked(number))
    return found


def _asked(number: str) -> str:
    if number not in ASKED:
        raise SceneError(f"number={number!r}: choose from {', '.join(ASKED)}")
    return number


def _judge(found: SeedExtremes, share: float | None, number: str) -> None:
    """Warn of too few seeds and of a poor fit."""
    count = found.maxima.size
    if share is None and count < FEW:
        warn_caller(
            f"{count} seeds: the fit cannot be tested with fewer than {FEW}, and {number} is known to "
            f"+-{100.0 * found.relative_half_width(number):.2g} %",
            FewSeedsWarning,
        )
    if share is not None and found.relative_half_width(number) > share:
        warn_caller(
            f"{count} seeds give {number} to +-{100.0 * found.relative_half_width(number):.2g} %, not "
            f"+-{100.0 * share:.2g} %: about {found.seeds_needed(share, number=number)} would",
            FewSeedsWarning,
        )
    if found.fit_probability < POOR:
        warn_caller(
            f"Gumbel's distribution does not describe these maxima (a Gumbel sample fits worse "
            f"with probability {found.fit_probability:.2g}): look at plot_extremes, and take the empirical "
            "numbers",
            PoorFitWarning,
        )


def gumbel_maximum_of(maxima: Array, duration: float = 1.0, exposure: float = 1.0) -> Maximum:
    """Of 3 finite maxima or more of records of a duration, in an exposure time (s); warns of nothing."""
    if (same := _common(maxima)) is not None:
        return Maximum(mpm=same, mean=same, p90=same, exposure=exposure)
    location, scale = (float(one) for one in gumbel_fit(np.sort(maxima)))
    return _gumbel_maximum(maxima.size, location, scale, duration, exposure)


def _common(values: Array) -> Estimate | None:
    """What all values are, where they are equal."""
    one = float(values[0])
    equal = np.ptp(values) <= ROUNDING * np.abs(values).max()
    return Estimate(value=one, low=one, high=one) if equal else None


def _gumbel_maximum(count: int, location: float, scale: float, duration: float, exposure: float) -> Maximum:
    """Estimates, and intervals by a parametric bootstrap of (estimate - value) / scale.

    Of a family of location and scale this is exact for any number of maxima.
    """
    drawn_location, drawn_scale, _ = standard_fits(count)

    def estimate(reduced: float) -> Estimate:
        at = reduced + float(np.log(exposure / duration))
        pivot = (drawn_location + at * drawn_scale - at) / drawn_scale
        low, high = np.quantile(pivot, TAILS)
        value = location + at * scale
        return Estimate(value=value, low=float(value - scale * high), high=float(value - scale * low))

    return Maximum(**{name: estimate(REDUCED[name]) for name in ASKED}, exposure=exposure)


def _empirical_maximum(ascending: Array, duration: float, exposure: float) -> Maximum:
    """Quantiles of the ordered maxima, at 1/e for the most probable one, and their mean.

    In `exposure / duration` records the distribution is that of one to this power.
    """
    records = exposure / duration
    rank = np.arange(ascending.size + 1) / ascending.size
    mean = float(np.sum(ascending * np.diff(rank**records)))
    return Maximum(
        mpm=_ordered(ascending, float(np.exp(-1.0 / records))),
        mean=mean_of(ascending) if records == 1.0 else Estimate(value=mean),
        p90=_ordered(ascending, 0.9 ** (1.0 / records)),
        exposure=exposure,
    )


def mean_of(values: Array) -> Estimate:
    """The mean of independent values, with its interval by Student's t."""
    from scipy.stats import t

    if (same := _common(values)) is not None:
        return same
    half = float(t.ppf(TAILS[1], values.size - 1) * values.std(ddof=1)) / values.size**0.5
    mean = float(values.mean())
    return Estimate(value=mean, low=mean - half, high=mean + half)


def _ordered(ascending: Array, share: float) -> Estimate:
    """A quantile, between those ordered values that enclose it with a probability of 95 %."""
    from scipy.stats import binom

    below, above = (int(binom.ppf(tail, ascending.size, share)) for tail in TAILS)
    above = min(above, ascending.size) + 1
    edged = np.concatenate([[-np.inf], ascending, [np.inf]])
    value = float(np.quantile(ascending, share, method="weibull"))
    return Estimate(value=value, low=float(edged[below]), high=float(edged[above]))
