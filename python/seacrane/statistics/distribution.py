"""The distribution of a number over seeds with several values each, which depend on one another."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of, numbers_of
from seacrane.plotting.table import Answer, Column, Table
from seacrane.statistics.estimate import TAILS, Estimate
from seacrane.warnings import FewSeedsWarning

DRAWS, SEED = 2000, 20260  # of the bootstrap
TOLD = (0.5, 0.9, 0.95, 0.99)
FEW = 10  # seeds


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Distribution(Answer):
    """How a number is distributed over seeds and, say, start times in their seas. Prints as a table.

    What begins at several times in one sea depends on one another, so that intervals come from seeds drawn
    anew, each with all of its values (a cluster bootstrap: A. C. Davison and D. V. Hinkley, "Bootstrap
    Methods and their Application", 1997, 3.8). With k seeds they are widened as Student's t with k - 1
    degrees of freedom is wider than the normal distribution.

    Attributes
    ----------
    values : ndarray, shape (k, n)
        Of k seeds; NaN where one failed, which is left out.
    """

    name: str
    unit: str
    values: Array

    @property
    def count(self) -> int:
        """Values that there are."""
        return int(np.isfinite(self.values).sum())

    @property
    def failed(self) -> int:
        """Values that failed."""
        return self.values.size - self.count

    @property
    def mean(self) -> Estimate:
        """Over all values."""
        sums = np.nansum(self.values, axis=1)
        value, spread = self._resampled(sums)
        return Estimate(value=value, low=value - spread, high=value + spread)

    def quantile(self, probability: float) -> Estimate:
        """The smallest value that a share of all of them does not exceed.

        Its interval holds the values whose own share has an interval that holds it.

        Parameters
        ----------
        probability : float
            Between 0 and 1.
        """
        share = number_of("probability", probability)
        if not 0.0 < share < 1.0:
            raise SceneError(f"probability is {share:g}; give a share between 0 and 1")
        value = float(self._ordered[int(np.ceil(share * self.count - 1e-9)) - 1])
        if self.values.shape[0] < 2:
            return Estimate(value=value)
        return Estimate(
            value=value,
            low=self._first(lambda below: below.high >= share),
            high=self._first(lambda below: below.low >= share),
        )

    def exceedance(self, level: float) -> Estimate:
        """The share of values above a level, in the unit of the values."""
        return self._share_of(self.values > number_of("level", level))

    def __repr__(self) -> str:
        return f"<Distribution of {self.name!r}: {self._told}>"

    @property
    def _told(self) -> str:
        seeds, each = self.values.shape
        return f"{seeds} seeds with {each} values each"

    def _shown(self) -> Table:
        found = {"mean": self.mean, **{f"{100.0 * share:g} %": self.quantile(share) for share in TOLD}}
        found["largest"] = Estimate(value=float(np.nanmax(self.values)))
        failed = [f"{self.failed} values failed and are left out."] if self.failed else []
        numbers = {key: [getattr(one, key) for one in found.values()] for key in ("value", "low", "high")}
        return Table(
            axes=[Column(name="share", head="not exceeded by", values=list(found))],
            columns=[
                Column(name=key, values=values, unit=self.unit, read=(self.unit, values), form=".5g")
                for key, values in numbers.items()
            ],
            title=f"{self.name}: {self._told}",
            remarks=["95 % intervals by resampling seeds.", *failed],
        )  # fmt: skip

    @cached_property
    def _ordered(self) -> Array:
        """The finite values, ascending."""
        return np.sort(self.values[np.isfinite(self.values)])

    @cached_property
    def _drawn(self) -> Array:
        """How often each seed is drawn, in each draw of the bootstrap."""
        seeds = self.values.shape[0]
        random = np.random.Generator(np.random.Philox(SEED))
        return random.multinomial(seeds, np.full(seeds, 1.0 / seeds), size=DRAWS).astype(float)

    def _first(self, reached: Callable[[Estimate], bool]) -> float:
        """The first value of which the share that it is not exceeded by reaches something, or infinity."""
        values = self._ordered
        place = bisect_left(
            range(values.size), True, key=lambda i: reached(self._share_of(self.values <= values[i]))
        )
        return float(values[place]) if place < values.size else float("inf")

    def _resampled(self, sums: Array) -> tuple[float, float]:
        """A sum over the seeds for each value, and half of its 95 % interval; not a number for one seed."""
        from scipy.stats import t

        counts, seeds = np.isfinite(self.values).sum(axis=1), self.values.shape[0]
        value = float(sums.sum() / counts.sum())
        if seeds < 2:
            return value, float("nan")
        found = (self._drawn @ sums) / np.maximum(self._drawn @ counts, 1.0)
        wider = float(t.ppf(TAILS[1], seeds - 1)) * (seeds / (seeds - 1.0)) ** 0.5
        return value, wider * float(found.std())

    def _share_of(self, hits: NDArray[np.bool_]) -> Estimate:
        """A share with its interval, even in its log odds; of none and of all, by the seeds alone."""
        value, half = self._resampled(hits.sum(axis=1))
        if np.isnan(half):
            return Estimate(value=value)
        if value in (0.0, 1.0):  # each of k seeds is the same: all of them with a chance of 2.5 %
            most = 1.0 - TAILS[0] ** (1.0 / self.values.shape[0])
            return Estimate(value=value, low=value * (1.0 - most), high=value + (1.0 - value) * most)
        odds, wide = np.log(value / (1.0 - value)), half / (value * (1.0 - value))
        low, high = (float(1.0 / (1.0 + np.exp(-end))) for end in (odds - wide, odds + wide))
        return Estimate(value=value, low=low, high=high)


def distribution(values: Any, *, name: str = "values", unit: str = "") -> Distribution:
    """How a number is distributed over seeds that have several values each.

    Parameters
    ----------
    values : array_like, shape (k, n)
        n values, such as of start times in one sea, of each of k seeds; NaN where one failed.
    name, unit : str
        What the table calls it.

    Raises
    ------
    SceneError
        For other shapes, infinite values, or none that is finite.

    Warns
    -----
    FewSeedsWarning
        For fewer than ten seeds: with one there is no interval.
    """
    table = numbers_of("values", values)
    if table.ndim != 2 or not table.size:
        raise SceneError(f"values of shape {table.shape}: give a table with a row for each seed")
    if np.isinf(table).any() or not np.isfinite(table).any():
        raise SceneError("values: not one is finite, or some are infinite; leave what failed as NaN")
    if table.shape[0] < FEW:
        told = "there is no interval" if table.shape[0] == 1 else "intervals are wide"
        warn_caller(f"{name}: {table.shape[0]} seeds: {told}; give ten or more", FewSeedsWarning)
    return Distribution(name=name, unit=unit, values=table)
