"""Means over seeds made surer by a cheap model of the same seeds, whose mean is known from many more."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.statistics.estimate import TAILS, Estimate
from seacrane.statistics.record import listed

FOLDS = 10  # parts of the seeds: the coefficient for each comes from all others
FEWEST = 10  # seeds
FAILED = "leave failed seeds out, of values and of controls"
LOOSE = 0.5  # correlation below which a control is left out: it saves less than a third


@dataclass(frozen=True, kw_only=True)
class ControlledMean:
    """The mean of a number over seeds, with a control variate. Made by `controlled_mean`; prints in words.

    Attributes
    ----------
    estimate : Estimate
        With the control where it is used, else `plain`.
    plain : Estimate
        The mean of the values alone.
    correlation : float
        Between values and controls.
    used : bool
        Whether the control is used: not where the correlation is below 0.5.
    seeds, controls : int
        How many values there are, and how many controls tell their mean.
    """

    estimate: Estimate
    plain: Estimate
    correlation: float
    used: bool
    seeds: int
    controls: int

    @property
    def gain(self) -> float:
        """Seeds without a control that tell as much as one with it: ratio of squared half widths."""
        return float((self.plain.half_width / self.estimate.half_width) ** 2)

    def __str__(self) -> str:
        words = f"{self.seeds} seeds, correlation {self.correlation:.2f}"
        if not self.used:
            return f"{self.estimate}, {words}: no control, for its correlation is below {LOOSE}"
        return f"{self.estimate}, {words}: gain {self.gain:.2g} (plain: {self.plain})"


def controlled_mean(values: Any, *, controls: Any, many_controls: Any) -> ControlledMean:
    """Estimate the mean of a number over seeds with the help of a control variate.

    The mean is that of ``value - b (control - m)``, where m is the mean of many independent controls. The
    coefficient b of each tenth of the seeds is the regression over the other nine, so that it brings no bias.

    Parameters
    ----------
    values : array_like, shape (k,)
        One of each seed, at least 10, such as largest hook loads.
    controls : array_like, shape (k,)
        What the cheap model gives for the same seeds, such as `LinearControl.extremes`.
    many_controls : array_like, shape (n,)
        The same of other seeds, 10,000 as a rule and more than k: their scatter is part of the interval.

    Raises
    ------
    SceneError
        For fewer than 10 seeds, lists of other lengths, or numbers that are not finite or all equal.
    """
    y, c, many = (
        listed(name, one, fewest=FEWEST, finite=FAILED, varied="were the seeds different?")
        for name, one in (("values", values), ("controls", controls), ("many_controls", many_controls))
    )
    if y.size != c.size:
        raise SceneError(f"controls: are {c.size} for {y.size} values; give one of each seed, in their order")
    if many.size <= y.size:
        raise SceneError(f"many_controls: are {many.size} for {y.size} values; give more, such as 10,000")
    plain = _interval(float(y.mean()), float(y.var(ddof=1)) / y.size, y.size - 1)
    correlation = float(np.corrcoef(y, c)[0, 1])
    used = abs(correlation) >= LOOSE
    estimate = _controlled(y, c, many) if used else plain
    return ControlledMean(
        estimate=estimate, plain=plain, correlation=correlation, used=used, seeds=y.size, controls=many.size
    )


def _controlled(y: Array, c: Array, many: Array) -> Estimate:
    centre = float(many.mean())
    part = np.arange(y.size) % min(FOLDS, y.size)
    slope = np.empty(y.size)
    for fold in range(int(part.max()) + 1):
        rest = part != fold
        slope[part == fold] = np.cov(y[rest], c[rest])[0, 1] / c[rest].var(ddof=1)
    left = y - slope * (c - centre)
    variance = float(left.var(ddof=1)) / y.size + float(slope.mean() ** 2 * many.var(ddof=1)) / many.size
    return _interval(float(left.mean()), variance, y.size - 2)


def _interval(value: float, variance: float, freedom: int) -> Estimate:
    from scipy.stats import t

    half = float(t.ppf(TAILS[1], freedom)) * variance**0.5
    return Estimate(value=value, low=value - half, high=value + half)
