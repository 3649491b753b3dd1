"""A number with its interval, and the three numbers that tell a largest value."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

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

    def cells(self, name: str) -> list[str]:
        """Name, most probable maximum, mean and P90 as texts."""
        return [name, str(self.mpm), str(self.mean), str(self.p90)]


HEAD = ("", "most probable", "mean", "P90")
