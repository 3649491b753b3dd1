"""Rows of a trade: what each setting costs and what error it brings; and their file, for a later call."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.files.atomic import atomic_write
from seacrane.trading.quantities import ErrorMeasures

NOT_DEFINED = math.nan


@dataclass(frozen=True, kw_only=True)
class Row:
    """One measured setting.

    Attributes
    ----------
    formulation, integrator : str
    rtol, dt : float
        The tolerance, or the step (s); the other is 0.
    memory, waves, rung : str
        The physics that was kept.
    wall_s, simulated_s : float
        Least wall time of the loop over the repeats, and the time simulated, s.
    evaluations : int
    errors : mapping of str to ErrorMeasures
        By quantity; a quantity that a rung does not give is left out.
    drift : float
        Largest constraint residual before projection, m or rad.
    energy : float
        Largest energy balance over the absolute work by then.
    stable : bool
        Whether the run finished with finite values.
    reason : str
        Why it did not, or what the row leaves out.
    """

    formulation: str
    integrator: str
    rtol: float
    dt: float
    memory: str
    waves: str
    rung: str
    wall_s: float = NOT_DEFINED
    simulated_s: float = NOT_DEFINED
    evaluations: int = 0
    errors: Mapping[str, ErrorMeasures] = field(default_factory=dict)
    drift: float = NOT_DEFINED
    energy: float = NOT_DEFINED
    stable: bool = False
    reason: str = ""

    @property
    def setting(self) -> str:
        """The tolerance or the step, in words."""
        return f"rtol={self.rtol:g}" if self.rtol else f"dt={self.dt:g}" if self.dt else ""

    @property
    def key(self) -> str:
        """What tells rows of one trade apart."""
        return "|".join((self.formulation, self.integrator, self.setting, self.memory, self.waves, self.rung))

    def error(self, quantity: str) -> float:
        """Largest error of a quantity over time; NaN where the row has none."""
        return self.errors[quantity].largest if quantity in self.errors else NOT_DEFINED

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Row:
        """From the mapping that `dataclasses.asdict` gives."""
        errors = {name: ErrorMeasures(**value) for name, value in data["errors"].items()}
        return cls(**{**data, "errors": errors})


def front(rows: Sequence[Row], quantity: str) -> list[bool]:
    """Which rows no other beats in both wall time and largest error of a quantity (Pareto)."""
    usable = [
        i for i, row in enumerate(rows) if row.stable and np.isfinite([row.error(quantity), row.wall_s]).all()
    ]
    on = [False] * len(rows)
    best = math.inf
    for i in sorted(usable, key=lambda i: (rows[i].wall_s, rows[i].error(quantity))):
        if rows[i].error(quantity) < best:
            best, on[i] = rows[i].error(quantity), True
    return on


class RowFile:
    """Rows on disk, one per line under a first line that says which trade they belong to.

    A file of another trade (another scene, version or list of quantities) is begun anew.
    """

    def __init__(self, path: Path, key: Mapping[str, Any]) -> None:
        self.path = path
        self.rows: dict[str, Row] = {}
        head = json.dumps(dict(key), sort_keys=True)
        lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
        if lines and lines[0] == head:
            for line in lines[1:]:
                try:
                    kept = json.loads(line)
                    self.rows[kept["key"]] = Row.from_data(kept["row"])
                except (ValueError, TypeError, KeyError):  # the line that an interrupted call was writing
                    continue
        with atomic_write(path) as draft:
            lines = [head, *(_line(name, row) for name, row in self.rows.items())]
            draft.write_text("\n".join(lines) + "\n", encoding="utf-8")

    def add(self, key: str, row: Row) -> None:
        """Keep a row under the key that it had before it was measured."""
        self.rows[key] = row
        with self.path.open("a", encoding="utf-8") as file:
            file.write(_line(key, row) + "\n")


def _line(key: str, row: Row) -> str:
    return json.dumps({"key": key, "row": asdict(row)})


def write_csv(
    path: Path, rows: Sequence[Row], quantities: Mapping[str, str], on_front: Sequence[bool]
) -> None:
    """Write trade.csv; `quantities` maps names to units.

    `error_<quantity>` is the largest over time; further columns hold the root mean square
    `rms_<quantity>`, the error of the standard deviation `std_<quantity>`, and `simulated_s`.
    """
    head = ["formulation", "integrator", "setting", "memory", "waves", "rung", "wall_s", "evaluations",
            *(f"error_{name}" for name in quantities), "drift", "energy", "stable", "reason", "pareto",
            *(f"{kind}_{name}" for kind in ("rms", "std") for name in quantities), "simulated_s"]  # fmt: skip
    with atomic_write(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(head)
        for row, pareto in zip(rows, on_front, strict=True):
            errors = [row.errors.get(name) for name in quantities]
            writer.writerow(
                [row.formulation, row.integrator, row.setting, row.memory, row.waves, row.rung,
                 _text(row.wall_s), row.evaluations,
                 *(_text(e.largest if e else NOT_DEFINED) for e in errors), _text(row.drift),
                 _text(row.energy), row.stable, row.reason, pareto,
                 *(_text(e.rms if e else NOT_DEFINED) for e in errors),
                 *(_text(e.std if e else NOT_DEFINED) for e in errors), _text(row.simulated_s)]
            )  # fmt: skip


def _text(value: float) -> str:
    """A number of a table; empty where there is none."""
    return "" if math.isnan(value) else f"{value:.6g}"
