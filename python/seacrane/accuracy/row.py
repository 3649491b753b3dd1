"""Rows of an experiment, each one case run with one method: on disk, from which it goes on, and as tables."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from seacrane.accuracy.quantities import ErrorMeasures
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.whole_file import read_whole
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
LARGEST_FILE = 2**28  # bytes; a row takes some hundred


@dataclass(frozen=True, kw_only=True)
class Row:
    """One run of an experiment.

    Attributes
    ----------
    case : What tells the case from the others of the experiment, by name.
    method : As asked for.
    stepped : The formulation that was stepped; empty before.
    verdict : "completed", "refused", "stopped" or "slow"; "not finite", "unnamed", "hung" and "crashed" must
        not occur. Empty: not measured yet.
    message : Why it did not complete, or what the row leaves out.
    errors : By quantity, against the reference; what the run does not give is left out.
    uncertainty : How far tight runs differ, by quantity: no error below can be told.
    motion : Largest distance of each quantity from its start, in the reference, else in the run.
    drift, left : Largest constraint error before and after projection, m or rad.
    energy : Largest energy balance over the absolute work or the kinetic energy, whichever is larger.
    simulated_s, wall_s, cpu_s : Simulated; least wall and processor time of the loop over the repeats, s.
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

    def ended(self, verdict: str, message: str | BaseException) -> Row:
        """The row with how its run ended, on one line."""
        return replace(self, verdict=verdict, message=" ".join(str(message).split()))


def front(rows: Sequence[Row], quantity: str, *, cost: str = "cpu_s") -> list[bool]:
    """Which rows no other beats in both cost, an attribute, and largest error of a quantity (Pareto)."""
    costs = [getattr(row, cost) for row in rows]
    errors = [row.error(quantity) for row in rows]
    usable = [i for i, row in enumerate(rows) if row.stable and math.isfinite(errors[i] + costs[i])]
    on = [False] * len(rows)
    best = math.inf
    for i in sorted(usable, key=lambda i: (costs[i], errors[i])):
        if errors[i] < best:
            best, on[i] = errors[i], True
    return on


class RowFile:
    """Rows on disk, one per line under a first line that says which experiment they belong to.

    A file of another experiment (another scene, version or list of quantities) is begun anew.
    """

    def __init__(self, path: Path | None, experiment: Mapping[str, Any]) -> None:
        self.path = path
        self.rows: dict[str, Row] = {}
        if path is None:
            return
        head = json.dumps({**experiment, "columns": [part.name for part in fields(Row)]}, sort_keys=True)
        text = read_whole(path, LARGEST_FILE, "remove it") if path.is_file() else b""
        lines = text.decode("utf-8", "replace").splitlines()
        if lines and lines[0] == head:
            for line in lines[1:]:
                try:
                    kept = json.loads(line)
                    row = kept["row"]  # as `dataclasses.asdict` gives it
                    errors = {name: ErrorMeasures(**value) for name, value in row["errors"].items()}
                    row |= {"method": Method(**row["method"]), "errors": errors}
                    self.rows[kept["key"]] = Row(**row)
                except (ValueError, TypeError, KeyError, RecursionError):  # a line cut short by an interrupt
                    continue
        with atomic_write(path) as draft:
            lines = [head, *(_line(key, row) for key, row in self.rows.items())]
            draft.write_text("\n".join(lines) + "\n", encoding="utf-8")

    def add(self, key: str, row: Row) -> None:
        """Keep a row under the key that it had before it was measured."""
        self.rows[key] = row
        if self.path is not None:
            with self.path.open("a", encoding="utf-8") as file:
                file.write(_line(key, row) + "\n")


def _line(key: str, row: Row) -> str:
    return json.dumps({"key": key, "row": asdict(row)})
