"""extremes.csv: the rows of an atlas as a table."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from seacrane.accuracy.row import UNKNOWN, Row
from seacrane.plotting.panel import save_table
from stability_atlas.points import POINTS, relative_error, relative_uncertainty

COLUMNS = ("axis", "value", "formulation", "integrator", "setting", "verdict", "error", "uncertainty",
           "motion", "drift", "left", "energy", "steps", "rejected_steps", "evaluations", "dense_solves",
           "simulated_s", "cpu_s", "message")  # fmt: skip


def write_csv(path: Path, rows: Sequence[Row]) -> None:
    """All rows; `error` and `uncertainty` are over `motion` (m), empty where there is no number."""
    save_table(COLUMNS, list(map(_cells, rows)), path)


def _cells(row: Row) -> list[Any]:
    name, method = POINTS.name, row.method
    return [
        row.case["axis"], row.case["value"], method.formulation, method.integrator, method.setting,
        row.verdict, relative_error(row), relative_uncertainty(row), row.motion.get(name, UNKNOWN),
        row.drift, row.left, row.energy, row.steps, row.rejected_steps, row.evaluations, row.dense_solves,
        row.simulated_s, row.cpu_s, row.message,
    ]  # fmt: skip
