"""A row of an experiment: one case run with one method."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from seacrane.accuracy.quantities import ErrorMeasures
from seacrane.run.method import Method

UNKNOWN = math.nan
COMPLETED = "completed"
REFUSED = "refused"  # an error before the first step, or a scene that cannot be made
STOPPED = "stopped"  # a SimulationError on the way
SLOW = "slow"  # beyond the processor time that the experiment grants a run
NOT_FINITE = "not finite"  # a NaN or an infinity in the result
UNNAMED = "unnamed"  # an exception that is none of seacrane's
HUNG = "hung"  # did not even answer the interrupt
CRASHED = "crashed"  # took the process with it
FORBIDDEN = (NOT_FINITE, UNNAMED, HUNG, CRASHED)
LEAST_MOTION = 1e-9  # what rests within it has no relative error


@dataclass(frozen=True, kw_only=True)
class Row:
    """One run of an experiment.

    Attributes
    ----------
    case : mapping of str to str or float
        What tells the case from the others of the experiment, by name.
    method : As asked for.
    stepped : The formulation that was stepped; empty before.
    verdict : str
        "completed", "refused", "stopped" or "slow"; "not finite", "unnamed", "hung" and "crashed" must not
        occur. Empty: not measured yet.
    message : Why it did not complete, or what the row leaves out.
    errors : mapping of str to ErrorMeasures
        By quantity, against the reference; what the run does not give is left out.
    uncertainty : mapping of str to float
        How far tight runs differ, by quantity: no error below can be told.
    motion : mapping of str to float
        Largest distance of each quantity from its start, in the reference, else in the run.
    drift, left : Largest constraint error before and after projection, m or rad.
    energy : float
        Largest energy balance over the absolute work or the kinetic energy, whichever is larger.
    simulated_s, wall_s, cpu_s : float
        Simulated time; least wall time and processor time of the loop over the repeats, s.
    """

    case: Mapping[str, str | float]
    method: Method
    stepped: str = ""
    verdict: str = ""
    message: str = ""
    errors: Mapping[str, ErrorMeasures] = field(default_factory=dict)
    uncertainty: Mapping[str, float] = field(default_factory=dict)
    motion: Mapping[str, float] = field(default_factory=dict)
    drift: float = UNKNOWN
    left: float = UNKNOWN
    energy: float = UNKNOWN
    steps: int = 0
    rejected_steps: int = 0
    evaluations: int = 0
    dense_solves: int = 0
    simulated_s: float = UNKNOWN
    wall_s: float = UNKNOWN
    cpu_s: float = UNKNOWN

    @property
    def key(self) -> str:
        """What tells rows of one experiment apart."""
        return "|".join([*map(str, self.case.values()), self.method.name])

    @property
    def formulation(self) -> str:
        """The one that was stepped, or else asked for."""
        return self.stepped or self.method.formulation

    @property
    def stable(self) -> bool:
        """Whether the run reached its end with finite values."""
        return self.verdict == COMPLETED

    def error(self, quantity: str) -> float:
        """Largest error of a quantity over time; NaN where the row has none."""
        return self.errors[quantity].largest if quantity in self.errors else UNKNOWN

    def relative_error(self, quantity: str) -> float:
        """The error over the motion; NaN where it rests."""
        return self._over_motion(quantity, self.error(quantity))

    def relative_uncertainty(self, quantity: str) -> float:
        """How far tight runs differ, over the motion; NaN where that is not known."""
        return self._over_motion(quantity, self.uncertainty.get(quantity, UNKNOWN))

    def _over_motion(self, quantity: str, value: float) -> float:
        motion = self.motion.get(quantity, UNKNOWN)
        return value / motion if motion > LEAST_MOTION else UNKNOWN

    def ended(self, verdict: str, message: str | BaseException) -> Row:
        """The row with how its run ended, on one line."""
        return replace(self, verdict=verdict, message=" ".join(str(message).split()))

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Row:
        """From the mapping that `dataclasses.asdict` gives."""
        errors = {name: ErrorMeasures(**value) for name, value in data["errors"].items()}
        return cls(**{**data, "method": Method(**data["method"]), "errors": errors})


def front(rows: Sequence[Row], quantity: str, *, cost: str = "cpu_s") -> list[bool]:
    """Which rows no other beats in both cost, an attribute, and largest error of a quantity (Pareto)."""
    costs = [getattr(row, cost) for row in rows]
    usable = [
        i for i, row in enumerate(rows) if row.stable and np.isfinite([row.error(quantity), costs[i]]).all()
    ]
    on = [False] * len(rows)
    best = math.inf
    for i in sorted(usable, key=lambda i: (costs[i], rows[i].error(quantity))):
        if rows[i].error(quantity) < best:
            best, on[i] = rows[i].error(quantity), True
    return on
