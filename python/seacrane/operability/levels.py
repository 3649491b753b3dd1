"""A criterion's statistic: of a Gaussian response by its moments, of one record, and of several seeds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.inputs.caller import silently
from seacrane.operability.criterion import Criterion
from seacrane.result import Result
from seacrane.statistics.estimate import CONFIDENCE, Estimate
from seacrane.statistics.gaussian import gaussian_maximum
from seacrane.statistics.record import crests
from seacrane.statistics.seeds import seed_extremes

Array = NDArray[np.float64]
FEWEST_SEEDS = 3
NARROWEST = 1e-6  # bandwidth


def gaussian_level(criterion: Criterion, moments: Array) -> float:
    """The criterion's statistic of a Gaussian response over its standard deviation, from the value at rest.

    Parameters
    ----------
    moments : (3,) m0, m1, m2 over frequency in rad/s.
    """
    if criterion.statistic == "significant":
        return 2.0
    m0, m1, m2 = moments
    sides = len(criterion.sides)
    bandwidth = np.sqrt(max(1.0 - m1**2 / (m0 * m2), 0.0))
    width = max(float(bandwidth) / sides, NARROWEST) if criterion.maxima == "clumped" else None
    # To either side: twice the crossings, in clumps with Vanmarcke's factor of half the bandwidth.
    found = gaussian_maximum(
        std=1.0,
        rate=sides * float(np.sqrt(m2 / m0)) / (2.0 * np.pi),
        exposure=criterion.span,
        bandwidth=width,
    )
    return float(getattr(found, criterion.statistic).value)


@dataclass(frozen=True, kw_only=True)
class RecordNumbers:
    """What is kept of a channel of a run: its largest, smallest, significant high and significant low value.

    Attributes
    ----------
    names : mapping of str to str
        Names along its dimensions.
    after : s: earlier outputs are left out.
    stage : Of a lift in stages: the outputs of this one alone.
    """

    channel: str
    names: Mapping[str, str] = field(default_factory=dict)
    after: float = 0.0
    stage: str = ""

    def __call__(self, result: Result) -> Array:
        """The numbers of a result."""
        values = result.curve(self.channel, **self.names)
        part = result.part(after=self.after, stage=self.stage or None)
        least, largest = result.reached(self.channel, part=part, **self.names)
        return record_numbers(values[part], float(least.min()), float(largest.max()))


def record_numbers(values: Array, least: float = np.inf, largest: float = -np.inf) -> Array:
    """Largest, smallest, significant high and low value of a record (n,) that reached `least` and `largest`.

    Crests and troughs are those of the parabola through their neighbours.
    """
    mean = float(values.mean())
    high, low = crests(values, mean), crests(-values, -mean)
    return np.array(
        [
            max(float(values.max()), mean + high.max(initial=0.0), largest),
            min(float(values.min()), mean - low.max(initial=0.0), least),
            mean + _highest_third(high) if high.size else float(values.max()),
            mean - _highest_third(low) if low.size else float(values.min()),
        ]
    )


def _highest_third(heights: Array) -> float:
    return float(np.sort(heights)[-max(1, heights.size // 3) :].mean())


def reached(criterion: Criterion, numbers: Array, rest: float) -> Array:
    """How far records went from the value at rest towards the bound: largest, or significant, by the numbers.

    Parameters
    ----------
    numbers : (..., 4) `record_numbers` of each record.
    """
    first = 2 if criterion.statistic == "significant" else 0
    sides = [
        numbers[..., first] - rest if side > 0.0 else rest - numbers[..., first + 1]
        for side in criterion.sides
    ]
    return np.asarray(np.max(sides, axis=0))


def seeds_level(criterion: Criterion, values: Array, duration: float | None) -> Estimate:
    """The criterion's statistic of several seeds, from the value at rest, with its 95 % interval.

    Parameters
    ----------
    values : (n,) `reached` of each, NaN where a seed failed.
    duration : Of each record, s; None: each is one lift, and so is what is asked for.

    Returns
    -------
    Estimate
        Infinite where fewer than three seeds came to their end.
    """
    good = values[np.isfinite(values)]
    if good.size < FEWEST_SEEDS:
        return Estimate(value=np.inf, low=np.inf, high=np.inf)
    if criterion.statistic == "significant":
        return _mean(good)
    if np.ptp(good) <= 1e-12 * np.abs(good).max():
        return Estimate(value=float(good[0]), low=float(good[0]), high=float(good[0]))
    with silently():  # the interval is part of the answer
        spans = (1.0, 1.0) if duration is None else (duration, criterion.span)
        found = seed_extremes(good, duration=spans[0], exposure=spans[1])
    estimate: Any = getattr(found.gumbel, criterion.statistic)
    return Estimate(value=estimate.value, low=estimate.low, high=estimate.high)


def _mean(values: Array) -> Estimate:
    from scipy.stats import t

    half = float(t.ppf((1.0 + CONFIDENCE) / 2.0, values.size - 1) * values.std(ddof=1)) / values.size**0.5
    mean = float(values.mean())
    return Estimate(value=mean, low=mean - half, high=mean + half)
