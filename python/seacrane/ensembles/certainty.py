"""How narrowly a statistic is known after some seeds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from seacrane.ensembles.members import Value
from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.targets import Target
from seacrane.errors import SceneError
from seacrane.statistics.estimate import CONFIDENCE, Estimate

Array = NDArray[np.float64]


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
