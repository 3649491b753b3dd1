"""Everything that was compared with anything, with its number: ``python benchmarks/validation.py`` checks
all.

Runs the comparisons of `benchmarks/compared`, and takes those that other measurements wrote from their
files. `benchmarks/run.py` writes them to ``validation.csv``, which fills benchmarks/README.md. Files of real
ships are looked for in the folder that SEACRANE_SHARED names; without it their rows stay as they were. A
difference beyond its bound ends the call, and nothing is written.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "benchmarks" / "results"
sys.path.extend(map(str, [ROOT / "tests", *(ROOT / "tests").glob("*/")]))

from compared import (  # noqa: E402
    crane,
    engine,
    events,
    extreme_values,
    files,
    heavy_lines,
    hull,
    hydraulics,
    lines,
    orders,
    real_ships,
    reeving,
    roll_and_mooring,
    sea,
    two_hulls,
)
from compared.row import Row  # noqa: E402

COMPARISONS = (
    files.mechanisms,
    engine.independent,
    engine.formulations,
    files.peers,
    engine.jacobians,
    engine.going_on,
    engine.energy,
    engine.momentum,
    engine.books,
    crane.statics,
    crane.masses,
    files.ships,
    files.linear_model,
    files.wave_sum,
    sea.spectrum,
    sea.drift,
    hull.hydrostatics,
    hull.sections,
    files.database,
    two_hulls.capytaine,
    roll_and_mooring.roll_damping,
    roll_and_mooring.moorings,
    files.wires,
    events.bouncing_ball,
    reeving.closed_forms,
    reeving.exudyn,
    hydraulics.solver,
    hydraulics.closed_forms,
    hydraulics.exudyn,
    heavy_lines.catenary,
    heavy_lines.swinging,
    heavy_lines.peers,
    lines.snatches,
    lines.rigid_limit,
    extreme_values.judges,
    extreme_values.narrow_band,
    orders.orders,
)

TAKEN = (  # tables whose numbers are compared
    "a-wire-that-goes-slack", "extremes-by-method", "linear-model-against-runs",
    "quickest-setting-within-a-payload-error",
)  # fmt: skip


def rows() -> Iterator[tuple[str, ...]]:
    """Cells of every comparison; each is said as soon as it is there."""
    for comparison in COMPARISONS:
        for row in comparison():
            yield checked(row).cells
    shared = os.environ.get("SEACRANE_SHARED")
    if shared:
        for of_ships in (real_ships.closures, roll_and_mooring.far_fields, two_hulls.codes):
            yield from (checked(row).cells for row in of_ships(Path(shared)))
        return
    old = files.records(RESULTS / "validation.csv")
    names = (*real_ships.FILES, two_hulls.RM3)
    yield from (tuple(row.values()) for row in old if row["compared"].startswith(names))


def checked(row: Row) -> Row:
    """The row, unless it is beyond its bound."""
    print("; ".join(row.cells), flush=True)
    if row.limit is not None and not row.difference <= row.limit:
        raise SystemExit(f"{row.compared}: {row.difference:g} exceeds {row.limit:g}")
    return row


if __name__ == "__main__":
    for _ in rows():
        pass
