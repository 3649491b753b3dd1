"""How narrowly a statistic is known after some seeds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from seacrane.ensembles.members import Value
from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.targets import Target
from seacrane.errors import SceneError
from seacrane.statistics.estimate import Estimate


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
        With its 95 % interval, which allows for stopping at a narrow one.
    static : float
        Of which half widths do not count.
    seeds : int
        That did not fail.
    asked : float
        Half width that was asked for, as a share of the dynamic part.
    """

    name: str
    estimate: Estimate
    static: float
    seeds: int
    asked: float
    parameters: Mapping[str, Value] = field(default_factory=dict)

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
        return (
            f"{self.name}{f' ({at})' if at else ''}: {self.estimate}, +-{100.0 * self.half_width:.2g} % of "
            f"the dynamic part, {self.seeds} seeds"
        )


def certainty_of(target: Target, outcomes: Sequence[Outcome], parameters: Mapping[str, Value]) -> Certainty:
    """What the members of one combination of parameters tell.

    Raises
    ------
    SceneError
        Where what is kept is no single number.
    """
    good = [one for one in outcomes if not one.failure]
    values = np.array([_single(target.variable, one) for one in good])
    static = 0.0
    if target.static is not None and good:
        static = float(np.mean([_single(target.static, one) for one in good]))
    return Certainty(
        name=target.name, estimate=target.estimate(values), static=static, seeds=len(good),
        asked=target.half_width, parameters=parameters,
    )  # fmt: skip


def _single(name: str, outcome: Outcome) -> float:
    kept = outcome.kept[name]
    if kept.values.ndim:
        dims = ", ".join(
            f"{dim}= one of {', '.join(map(str, kept.coords.get(dim, ())))}" for dim in kept.dims
        )
        raise SceneError(f"until: {name} is several numbers; keep one of them: give at with {dims}")
    return float(kept.values)
