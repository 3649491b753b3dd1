"""The table of a trade, and the rows that no other beats."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from seacrane.accuracy.quantities import Quantity
from seacrane.accuracy.row import UNKNOWN, Row, write_table
from seacrane.plotting.answer import Table


def write_csv(path: Path, rows: Sequence[Row], quantities: Sequence[str], on_front: Sequence[bool]) -> None:
    """Write trade.csv.

    `error_<quantity>` is the largest over time; further columns hold the root mean square
    `rms_<quantity>`, the error of the standard deviation `std_<quantity>`, and `simulated_s`.
    """
    columns = [
        "formulation", "integrator", "setting", "memory", "waves", "rung", "wall_s", "evaluations",
        *(f"error_{name}" for name in quantities), "drift", "energy", "stable", "reason", "pareto",
        *(f"{kind}_{name}" for kind in ("rms", "std") for name in quantities), "simulated_s",
    ]  # fmt: skip
    cells = [_cells(row, quantities, pareto) for row, pareto in zip(rows, on_front, strict=True)]
    write_table(path, columns, cells, digits=6)


def front_table(
    rows: Sequence[Row],
    quantities: Mapping[str, Quantity],
    uncertainty: Mapping[str, float],
    best: Sequence[Row],
    about: Mapping[str, Any],
    said: Sequence[str],
) -> Table:
    """How well the reference is known, the front of the first quantity, and what is said of both."""
    known = ", ".join(f"{name} {uncertainty[name]:.1g} {one.unit}" for name, one in quantities.items())
    head = ["formulation", "integrator", "setting", "memory", "waves", "rung", "CPU [ms]"]
    cells = [
        [row.formulation, row.method.integrator, row.method.setting, *map(str, row.case.values()),
         f"{row.cpu_s * 1e3:.3g}", *(f"{row.error(name):.2g}" for name in quantities)]
        for row in best
    ]  # fmt: skip
    unstable = sum(not row.stable for row in rows)
    title = (
        f"reference known within {known}\n"
        f"{len(rows)} rows, {unstable} of them not stable; Pareto front in {next(iter(quantities))}:"
    )
    head += [f"{name} [{one.unit}]" for name, one in quantities.items()]
    caption = (
        f"Trade of {about['scene']!r}, {about['t_end']:g} s: {len(best)} of {len(rows)} settings, which no "
        f"other beats in both CPU time and error of {next(iter(quantities))}"
    )
    return Table(head=head, rows=cells, title=title, caption=caption, remarks=said)


def _cells(row: Row, quantities: Sequence[str], pareto: bool) -> list[Any]:
    def errors(part: str) -> list[float]:
        return [getattr(row.errors[q], part) if q in row.errors else UNKNOWN for q in quantities]

    method, case = row.method, row.case
    return [
        row.formulation, method.integrator, method.setting, case["memory"], case["waves"], case["rung"],
        row.wall_s, row.evaluations, *errors("largest"), row.drift, row.energy, row.stable, row.message,
        pareto, *errors("rms"), *errors("std"), row.simulated_s,
    ]  # fmt: skip
