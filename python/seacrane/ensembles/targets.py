"""What `until` asks for, and how certainly the seeds so far tell it."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.ensembles.dataset import Outcome
from seacrane.ensembles.kept import Kept
from seacrane.ensembles.members import Value
from seacrane.ensembles.study import Keep
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import shown
from seacrane.statistics.estimate import CONFIDENCE, Estimate
from seacrane.statistics.seeds import ASKED, FEWEST, REDUCED, gumbel_maximum_of, mean_of

EXTREMES = ("maximum", "minimum")
WIDENED = 1.05  # of intervals: stopping where one happens to be narrow costs coverage, which this restores
LONGEST = 80  # characters of a name in a message


@dataclass(frozen=True, kw_only=True)
class Target:
    """A statistic over seeds, and how narrowly it is to be known."""

    variable: str  # name of what is kept
    number: str  # "mpm", "mean" or "p90" of largest or smallest values, else "mean"
    half_width: float  # of the 95 % interval, as a share of the dynamic part
    sign: float = 1.0  # or -1 for smallest values
    gumbel: bool = False  # whether values are extremes; else their mean is asked for
    static: str | None = None  # what is kept for the static part; None: zero

    @property
    def name(self) -> str:
        """As `until` has it."""
        return f"{self.variable}.{self.number}"

    def estimate(self, values: Array, failed: int = 0) -> Estimate:
        """The statistic of the values of some seeds, with its interval; infinite for fewer than 3.

        Where seeds failed, the interval holds whatever they would have given: that of the ordered values of
        all seeds, whose places those that did not fail have where all others are smaller, or all are larger.
        """
        if values.size < FEWEST:
            middle = float(values.mean()) if values.size else float("nan")
            return Estimate(value=middle, low=-np.inf, high=np.inf)
        found = self._extreme(values) if self.gumbel else mean_of(values)
        more = (WIDENED - 1.0) * found.half_width
        found = Estimate(value=found.value, low=found.low - more, high=found.high + more)
        if not failed:
            return found
        low, high = self._ranked(values, failed)
        return Estimate(value=found.value, low=min(found.low, low), high=max(found.high, high))

    def _ranked(self, values: Array, failed: int) -> tuple[float, float]:
        """Ends of the interval of the ordered values of all seeds."""
        from scipy.stats import binom

        count, end = values.size + failed, (1.0 - CONFIDENCE) / (2.0 * WIDENED)
        below, above = (int(binom.ppf(share, count, self._share)) for share in (end, 1.0 - end))
        edged = np.concatenate([[-np.inf], np.sort(self.sign * values), [np.inf]])
        ends = float(edged[max(below - failed, 0)]), float(edged[min(above + 1, values.size + 1)])
        return ends if self.sign > 0.0 else (-ends[1], -ends[0])

    @property
    def _share(self) -> float:
        """Share of values below the statistic, by Gumbel's distribution or a symmetric one."""
        return float(np.exp(-np.exp(-REDUCED[self.number]))) if self.gumbel else 0.5

    def length(self, values: Array, share: float) -> float:
        """What an interval is left with, however many seeds there are, where this share of them fails."""
        low, high = ((self._share - less) / (1.0 - share) for less in (share, 0.0))
        if values.size < FEWEST or low <= 0.0 or high >= 1.0:
            return float("inf")
        return float(np.ptp(np.quantile(self.sign * values, [low, high])))

    def _extreme(self, values: Array) -> Estimate:
        found: Estimate = getattr(gumbel_maximum_of(self.sign * values), self.number)
        if self.sign > 0.0:
            return found
        return Estimate(value=-found.value, low=-found.high, high=-found.low)


def targets_of(until: Any, keep: Keep) -> tuple[Target, ...]:
    """The targets of `until`, or a SceneError that names what is wrong in it."""
    if not isinstance(until, Mapping) or not until:
        raise SceneError(f"until is {shown(until)}; give half widths by name, {{'hook_load.mpm': 0.02}}")
    return tuple(_target(name, share, keep) for name, share in until.items())


def _target(name: Any, share: Any, keep: Keep) -> Target:
    if not isinstance(name, str) or name.count(".") != 1:
        raise SceneError(f"until: {shown(name)} is no statistic; give '<kept>.<number>', such as 'load.mpm'")
    variable, number = name.split(".")
    if variable not in keep:
        near = difflib.get_close_matches(variable, keep, n=1, cutoff=0.3)
        raise SceneError(
            f"until: nothing is kept as {shown(variable)}"
            + (f"; nearest: {near[0]!r}" if near else "")
            + f"; kept are {', '.join(keep)}"
        )
    what = keep[variable]
    label = name if len(name) <= LONGEST else f"{name[:LONGEST]}..."
    numbers = ("mean",) if isinstance(what, Kept) and what.what not in EXTREMES else ASKED
    if number not in numbers:
        raise SceneError(
            f"until: {label}: {shown(number)} is no number of it; choose from {', '.join(numbers)}"
        )
    width = number_of(f"until: {label}", share)
    if not 0.0 < width < 1.0:
        raise SceneError(f"until: {label} is {width:g}; give a share between 0 and 1, such as 0.02")
    if not isinstance(what, Kept):
        return Target(variable=variable, number=number, half_width=width, gumbel=number != "mean")
    if what.what == "series":
        raise SceneError(f"until: {variable} is a series; keep its maximum or its mean")
    if what.what not in EXTREMES:
        return Target(variable=variable, number=number, half_width=width)
    return Target(
        variable=variable, number=number, half_width=width, gumbel=True,
        sign=-1.0 if what.what == "minimum" else 1.0, static=f"{variable}_mean",
    )  # fmt: skip


def with_static_parts(keep: Keep, targets: tuple[Target, ...]) -> Keep:
    """Also the means of the channels whose extremes are asked for: their static parts."""
    out = dict(keep)
    for target in targets:
        if target.static is None:
            continue
        what = keep[target.variable]
        assert isinstance(what, Kept)
        mean = Kept(channel=what.channel, what="mean", names=what.names, after=what.after, stage=what.stage)
        if out.setdefault(target.static, mean) != mean:
            raise SceneError(
                f"keep: the name {target.static!r} is that of the static part of {target.variable!r}; rename"
            )
    return out


@dataclass(frozen=True, kw_only=True)
class Certainty:
    """A statistic over the seeds of one combination of parameters.

    Attributes
    ----------
    name : str
        As `until` has it, such as "hook_load.mpm".
    parameters : mapping
        What the seeds share.
    estimate : Estimate
        With its 95 % interval, which allows for stopping at a narrow one, and for whatever seeds that failed
        would have given.
    static : float
        Of which half widths do not count.
    seeds : int
        That did not fail.
    asked : float
        Half width that was asked for, as a share of the dynamic part.
    failed : int
        Seeds that failed.
    futile : bool
        Whether so many failed that more seeds would not make it as narrow as was asked for.
    """

    name: str
    estimate: Estimate
    static: float
    seeds: int
    asked: float
    parameters: Mapping[str, Value] = field(default_factory=dict)
    failed: int = 0
    futile: bool = False

    @property
    def half_width(self) -> float:
        """Half width of the interval, as a share of the dynamic part."""
        half, dynamic = self.estimate.half_width, abs(self.estimate.value - self.static)
        if half == 0.0:
            return 0.0
        return half / dynamic if dynamic > 0.0 and np.isfinite(half) else float("inf")

    @property
    def reached(self) -> bool:
        """Whether it is as narrow as was asked for."""
        return self.half_width <= self.asked

    def __str__(self) -> str:
        at = ", ".join(f"{name}={value}" for name, value in self.parameters.items())
        named = f"{self.name}{f' ({at})' if at else ''}"
        if not self.seeds:
            return f"{named}: all {self.failed} seeds failed"
        if self.failed and not np.isfinite(self.half_width):
            return (
                f"{named}: {self.estimate.value:.4g} of {self.seeds} seeds, {self.failed} failed: no interval"
            )
        failed = f", {self.failed} failed and may have given anything" if self.failed else ""
        return (
            f"{named}: {self.estimate}, +-{100.0 * self.half_width:.2g} % of the dynamic part, "
            f"{self.seeds} seeds{failed}"
        )


def certainty_of(target: Target, outcomes: Sequence[Outcome], parameters: Mapping[str, Value]) -> Certainty:
    """What the members of one combination of parameters tell.

    Raises SceneError where what is kept is no single number.
    """
    good = [one for one in outcomes if not one.failure]
    values = np.array([_single(target.variable, one) for one in good])
    static = 0.0
    if target.static is not None and good:
        static = float(np.mean([_single(target.static, one) for one in good]))
    return known(target, values, len(outcomes) - len(good), static=static, parameters=parameters)


def known(
    target: Target, values: Array, failed: int, *, static: float, parameters: Mapping[str, Value]
) -> Certainty:
    """What the values of seeds tell, of which so many more failed."""
    estimate = target.estimate(values, failed)
    return Certainty(
        name=target.name, estimate=estimate, static=static, seeds=values.size, asked=target.half_width,
        parameters=parameters, failed=failed,
        futile=bool(failed) and _futile(target, values, failed, abs(estimate.value - static)),
    )  # fmt: skip


def _futile(target: Target, values: Array, failed: int, dynamic: float) -> bool:
    """Whether the least share that fails, by those that did, leaves too wide an interval by itself."""
    from scipy.stats import beta

    least = float(beta.ppf((1.0 - CONFIDENCE) / 2.0, failed, values.size + 1))
    return not 0.5 * target.length(values, least) <= target.half_width * dynamic


def _single(name: str, outcome: Outcome) -> float:
    kept = outcome.kept[name]
    if kept.values.ndim:
        dims = ", ".join(
            f"{dim}= one of {', '.join(map(str, kept.coords.get(dim, ())))}" for dim in kept.dims
        )
        raise SceneError(f"until: {name} is several numbers; keep one of them: give at with {dims}")
    return float(kept.values)
