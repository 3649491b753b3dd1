"""Rows of an atlas, and their file, from which a call that was stopped goes on."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from seacrane.files.atomic import atomic_write
from seacrane.version import __version__

UNKNOWN = math.nan
COMPLETED = "completed"
REFUSED = "refused"  # a SceneError before the first step
STOPPED = "stopped"  # a SimulationError on the way
SLOW = "slow"  # beyond the processor time that the atlas grants a run
NOT_FINITE = "not finite"  # a NaN or an infinity in the result
UNNAMED = "unnamed"  # any other exception
HUNG = "hung"  # did not even answer the interrupt
CRASHED = "crashed"  # took the process with it
FORBIDDEN = (NOT_FINITE, UNNAMED, HUNG, CRASHED)


@dataclass(frozen=True, kw_only=True)
class Row:
    """One run of an atlas.

    Attributes
    ----------
    axis : str
    value : float
    formulation, integrator, setting : str
    verdict : str
        "completed", "refused", "stopped" or "slow"; "not finite", "unnamed", "hung" and "crashed" must not
        occur.
    error : float
        Largest distance (m) of points on the bodies, their centres of mass and three around each at 1 m, from
        those of the reference, over the largest distance these move in it.
    uncertainty : float
        The same between two tight runs that differ in equations and method: no error below can be told.
    motion : float
        That largest distance they move, m; where there is no reference, in the run itself.
    drift, left : float
        Largest constraint error before and after projection, m or rad.
    energy : float
        Largest energy balance over the absolute work or the kinetic energy, whichever is larger.
    steps, rejected_steps, evaluations, dense_solves : int
    simulated_s, wall_s : float
    message : str
        What the engine said when it did not complete.
    """

    axis: str
    value: float
    formulation: str
    integrator: str
    setting: str
    verdict: str = ""
    error: float = UNKNOWN
    uncertainty: float = UNKNOWN
    motion: float = UNKNOWN
    drift: float = UNKNOWN
    left: float = UNKNOWN
    energy: float = UNKNOWN
    steps: int = 0
    rejected_steps: int = 0
    evaluations: int = 0
    dense_solves: int = 0
    simulated_s: float = 0.0
    wall_s: float = UNKNOWN
    message: str = ""

    @property
    def method(self) -> str:
        """Formulation, integrator and setting, in words."""
        return " ".join(part for part in (self.formulation, self.integrator, self.setting) if part)

    @property
    def key(self) -> str:
        """What tells rows of one atlas apart."""
        return f"{self.axis}|{self.value!r}|{self.method}"


class RowFile:
    """Rows on disk, one per line, under a line that names the version; another version begins anew."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.rows: dict[str, Row] = {}
        head = json.dumps({"seacrane_version": __version__, "columns": [f.name for f in fields(Row)]})
        lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
        if lines and lines[0] == head:
            for line in lines[1:]:
                try:
                    row = Row(**json.loads(line))
                except (ValueError, TypeError):  # the line that an interrupted call was writing
                    continue
                self.rows[row.key] = row
        with atomic_write(path) as draft:
            draft.write_text(
                "\n".join([head, *(json.dumps(asdict(row)) for row in self.rows.values())]) + "\n",
                encoding="utf-8",
            )

    def add(self, row: Row) -> None:
        """Keep a row."""
        self.rows[row.key] = row
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(asdict(row)) + "\n")


def write_csv(path: Path, rows: Sequence[Row]) -> None:
    """All rows as a table; empty where there is no number."""
    names = [field.name for field in fields(Row)]
    with atomic_write(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        for row in rows:
            writer.writerow([_text(getattr(row, name)) for name in names])


def _text(value: float | str) -> str:
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.4g}"
    return str(value)
