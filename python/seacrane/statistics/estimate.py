"""A number with its interval, and the three numbers that tell a largest value, as of a Gaussian process."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of
from seacrane.inputs.described import described
from seacrane.plotting.panel import Sheet, draw
from seacrane.plotting.table import Answer, Column, Table
from seacrane.sea.crossings import expected_crossings, level_crossed

if TYPE_CHECKING:
    from matplotlib.figure import Figure

EULER = float(np.euler_gamma)
P90_COUNT = -float(np.log(0.9))  # mean number of exceedances of what is exceeded with probability 0.1
P90_REDUCED = -float(np.log(P90_COUNT))  # reduced Gumbel variable of that value
CONFIDENCE = 0.95  # of every interval
TAILS = ((1.0 - CONFIDENCE) / 2.0, (1.0 + CONFIDENCE) / 2.0)  # probabilities below its ends
THREE_HOURS = 10800.0  # s


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


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Extremes(Answer):
    """What extremes of records and of seeds share: see each."""

    name: str
    unit: str
    duration: float
    exposure: float
    static: float

    @property
    @abstractmethod
    def maximum(self) -> Maximum:
        """The largest value in the exposure time."""

    @property
    def dynamic_factor(self) -> float:
        """Most probable maximum over the static value."""
        if self.static == 0.0:
            raise SceneError("static=0: a dynamic factor needs a static value; give static=")
        return self.maximum.mpm.value / self.static

    @abstractmethod
    def sheet(self) -> Sheet:
        """The panel of `plot_extremes` with its numbers."""

    __repr__ = Answer.__str__


def plot_extremes(found: Extremes) -> Figure:
    """Draw what `extremes` returned.

    Parameters
    ----------
    found : RecordExtremes or SeedExtremes
        Of one record: up-crossings in the exposure time over the level, counted and fitted; the most probable
        maximum is where one crossing is left. Of several seeds: their maxima on Gumbel paper, where Gumbel's
        distribution is a straight line.

    Raises
    ------
    SceneError
        For anything else.
    """
    if not isinstance(found, Extremes):
        raise SceneError(f"found is {described(found)}; give what extremes() returns")
    return draw(found.sheet())


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


def gaussian_maximum(
    *,
    std: float,
    rate: float,
    exposure: float = THREE_HOURS,
    mean: float = 0.0,
    bandwidth: float | None = None,
) -> Maximum:
    """Estimate the largest value of a Gaussian process in an exposure time, by its up-crossings.

    Parameters
    ----------
    std, mean : float
        Standard deviation and mean, any unit.
    rate : float
        Up-crossings of the mean, 1/s.
    exposure : float
        s; default 3 h.
    bandwidth : float, optional
        Vanmarcke's sqrt(1 - m1^2 / (m0 m2)), which lets neighbouring crests of a narrow-band process count as
        one. By default they count as independent: the usual sqrt(2 ln N), which is too high there.

    Returns
    -------
    Maximum
        Without intervals. Its `mpm` is the level crossed once on average.

    Raises
    ------
    SceneError
        For a number out of range.
    """
    spread, cycles = positive_of("std", std), positive_of("rate", rate) * positive_of("exposure", exposure)
    centre = number_of("mean", mean)
    width = None if bandwidth is None else positive_of("bandwidth", bandwidth)
    if width is not None and width > 1.0:
        raise SceneError(f"bandwidth={width:g}: is at most 1")

    def level(count: float) -> float:
        return centre + spread * level_crossed(count, cycles=cycles, bandwidth=width)

    return Maximum(
        mpm=Estimate(value=level(1.0)),
        mean=Estimate(value=centre + spread * _mean_level(cycles, width)),
        p90=Estimate(value=level(P90_COUNT)),
        exposure=float(exposure),
    )


def _mean_level(cycles: float, bandwidth: float | None) -> float:
    """Integral over levels of the probability that one is crossed at all."""
    from scipy.integrate import quad

    def crossed(level: float) -> float:
        return float(-np.expm1(-expected_crossings(level, cycles=cycles, bandwidth=bandwidth)))

    top = float(np.sqrt(2.0 * np.log(max(cycles, 1.0)))) + 4.0
    return float(quad(crossed, 0.0, top, limit=200)[0])
