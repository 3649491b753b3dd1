"""A number with its interval, and the three numbers that tell a largest value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from seacrane.plotting.table import Column, Table

EULER = float(np.euler_gamma)
P90_COUNT = -float(np.log(0.9))  # mean number of exceedances of what is exceeded with probability 0.1
P90_REDUCED = -float(np.log(P90_COUNT))  # reduced Gumbel variable of that value
CONFIDENCE = 0.95  # of every interval


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """A number and its 95 % interval.

    Attributes
    ----------
    value, low, high : float
        `low` is minus infinity, `high` infinity, where the data bound nothing on that side; both are
        nan where no interval was formed.
    """

    value: float
    low: float = float("nan")
    high: float = float("nan")

    @property
    def half_width(self) -> float:
        """Half the length of the interval."""
        return 0.5 * (self.high - self.low)

    def __str__(self) -> str:
        interval = "" if np.isnan(self.low) else f" ({self.low:.4g} to {self.high:.4g})"
        return f"{self.value:.4g}{interval}"


@dataclass(frozen=True, kw_only=True)
class Maximum:
    """The largest value in an exposure time.

    Attributes
    ----------
    mpm : Estimate
        Most probable maximum.
    p90 : Estimate
        Exceeded in one exposure of ten.
    exposure : float
        s.
    """

    mpm: Estimate
    mean: Estimate
    p90: Estimate
    exposure: float


HEADS = {"mpm": "most probable", "mean": "mean", "p90": "P90"}


def maxima_table(found: Mapping[str, Maximum], unit: str, title: str, remark: str) -> Table:
    """Most probable maximum, mean and P90 by each of several methods, with their intervals."""
    columns = []
    for name, head in HEADS.items():
        every: list[Estimate] = [getattr(one, name) for one in found.values()]
        values, texts = [one.value for one in every], ("", list(map(str, every)))
        columns.append(Column(name=name, values=values, unit=unit, head=head, read=texts))
        for end in ("low", "high"):
            values = [getattr(one, end) for one in every]
            columns.append(Column(name=f"{name}_{end}", values=values, unit=unit, printed=False))
    methods = Column(name="method", head="", values=list(found))
    return Table(axes=[methods], columns=columns, title=title, remarks=[remark])
