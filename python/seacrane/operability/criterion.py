"""What a lift may reach in a sea: a channel, a statistic of it over an exposure time, and a value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from seacrane.arrays import Array
from seacrane.description.channels import unit_of
from seacrane.description.pick import pick_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of, name_of, number_of, positive_of, text_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.result import Result
from seacrane.statistics.estimate import THREE_HOURS, Estimate, gaussian_maximum
from seacrane.statistics.record import crests, highest_third
from seacrane.statistics.seeds import gumbel_maximum_of, mean_of

MAXIMA = {"clumped": "clumped, Vanmarcke", "rayleigh": "Rayleigh, sqrt(2 ln N)"}
STATISTICS = {
    "significant": "significant",
    "mpm": "most probable maximum",
    "mean": "mean maximum",
    "p90": "P90 maximum",
}
FEWEST_SEEDS = 3
NARROWEST = 1e-6  # bandwidth


@named
@dataclass(frozen=True, kw_only=True)
class Criterion:
    """What a statistic of a channel may reach.

    Attributes
    ----------
    channel : str
        As results name it, such as "hook_load", or a selector with names in brackets, as of `Result.select`:
        "position[payload, z]"; of a lift in stages that of one stage, "hook_load[stage=lift]".
    maximum, minimum : float, optional
        One of both, in the SI unit of the channel (rad for angles).
    names : mapping of str to str
        Names along the channel's dimensions, such as ``{"body": "payload", "axis": "z"}``.
    statistic : str
        "mpm" (default), "mean" or "p90" of the largest value in the exposure time, or "significant": the mean
        of the highest third of crests. Of a minimum, the same of the smallest value and of troughs.
    exposure : float, optional
        s; default 3 h. Of a lift in stages it is left out: the largest value is that of one lift.
    motion : bool
        Whether `maximum` bounds the distance from the value at rest, to either side. Default False: the value
        itself.
    maxima : {"clumped", "rayleigh"}
        How the linear model counts crests: in Vanmarcke's clumps (default), or each by itself, Rayleigh's
        sqrt(2 ln N) of the standards, which is higher. With `motion` N counts both sides. Runs count their
        own.
    name : str
        Default: the channel and the names.
    stage : str
        Of a lift in stages: the outputs of this one alone.

    Raises
    ------
    SceneError
        For a value that makes no sense, or an unknown channel. Whether a scene has it is known when asked.
    """

    channel: str
    maximum: float | None = None
    minimum: float | None = None
    names: Mapping[str, str] = field(default_factory=dict)
    statistic: str = "mpm"
    exposure: float | None = None
    motion: bool = False
    maxima: str = "clumped"
    name: str = ""
    stage: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.names, Mapping):
            raise SceneError(f"criterion: names is {shown(self.names)}; give names by dimension")
        pick = pick_of("criterion", self.channel, self.names)
        if pick.after is not None:
            raise SceneError(f"criterion {pick}: after is not a criterion's; what asks for it says start_up")
        if pick.stage is not None and self.stage:
            raise SceneError(f"criterion {pick}: stage is given twice; leave one out")
        channel = pick.channel
        object.__setattr__(self, "stage", text_of("criterion: stage", self.stage) or pick.stage or "")
        object.__setattr__(self, "channel", channel)
        object.__setattr__(self, "names", dict(pick.names))
        of_stage = [f"in {self.stage}"] if self.stage else []
        usual = " ".join([channel.replace("_", " "), *map(str, self.names.values()), *of_stage])
        object.__setattr__(self, "name", name_of("criterion", self.name, usual))
        self._require_bound()
        for what, known in (("statistic", STATISTICS), ("maxima", MAXIMA)):
            if (given := getattr(self, what)) not in known:
                raise SceneError(
                    f"criterion {self.name!r}: {what} is {shown(given)}; choose from {', '.join(known)}"
                )
        if self.exposure is not None:
            positive_of(f"criterion {self.name!r}: exposure", self.exposure, "s")

    def _require_bound(self) -> None:
        if (self.maximum is None) == (self.minimum is None):
            raise SceneError(f"criterion {self.name!r}: give maximum or minimum, and not both")
        given = self.minimum if self.maximum is None else self.maximum
        if not np.isfinite(number_of(f"criterion {self.name!r}: bound", given)):
            raise SceneError(f"criterion {self.name!r}: bound is {self.bound}; give a finite number")
        if not flag_of(f"criterion {self.name!r}: motion", self.motion):
            return
        if self.maximum is None or not self.maximum > 0.0:
            raise SceneError(
                f"criterion {self.name!r}: motion=True bounds a distance; give a maximum above zero"
            )

    @property
    def span(self) -> float:
        """The exposure time, s, of a lift without stages."""
        return THREE_HOURS if self.exposure is None else self.exposure

    @property
    def bound(self) -> float:
        """The maximum, or the minimum."""
        return float(self.minimum if self.maximum is None else self.maximum)  # type: ignore[arg-type]

    @property
    def sides(self) -> tuple[float, ...]:
        """Signs of the channel of which the largest value counts."""
        if self.motion:
            return (1.0, -1.0)
        return (1.0,) if self.minimum is None else (-1.0,)

    def allowance(self, rest: float) -> float:
        """From the value at rest to the bound, in the unit of the channel; negative beyond it."""
        return self.bound if self.motion else self.sides[0] * (self.bound - rest)

    def told(self, *, one_lift: bool = False) -> str:
        """The criterion in words, over its exposure time or over one lift in stages."""
        what, asked = "value", STATISTICS[self.statistic]
        if self.motion:
            what = "motion to either side"
        if self.minimum is not None:
            asked = asked.replace("maximum", "minimum")
        over = " in one lift" if one_lift else f" in {self.span:g} s"
        over = "" if self.statistic == "significant" else over
        sign = "<=" if self.minimum is None else ">="
        unit = unit_of(self.channel, self.names.values())
        linear = "" if one_lift or self.statistic == "significant" else f"; linear: {MAXIMA[self.maxima]}"
        return f"{self.name}: {what}, {asked}{over} {sign} {self.bound:g} {unit}{linear}"


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
            mean + highest_third(high) if high.size else float(values.max()),
            mean - highest_third(low) if low.size else float(values.min()),
        ]
    )


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

    Of `reached` (n,) by each, NaN where a seed failed, in records of a duration (s); None: each is one lift,
    and so is what is asked for. Infinite where fewer than three seeds came to their end.
    """
    good = values[np.isfinite(values)]
    if good.size < FEWEST_SEEDS:
        return Estimate(value=np.inf, low=np.inf, high=np.inf)
    if criterion.statistic == "significant":
        return mean_of(good)
    spans = (1.0, 1.0) if duration is None else (duration, criterion.span)
    found: Estimate = getattr(gumbel_maximum_of(good, *spans), criterion.statistic)
    return found
