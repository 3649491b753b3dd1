"""What leaving physics out of case 2 loses, by `trade`; and the picture of docs/trade.md."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from seacrane import cases, simulate, trade
from seacrane.accuracy.quantities import compare, quantities_of

from .section import RESULTS, Section, significant
from .sources import CRANE

FIGURE = RESULTS.parents[1] / "docs" / "figures" / "trade_case2.png"
BUDGET = 30  # runs of the default setting, beside the reference
FULL = ("per-pair", "table", "full")
WORDS = {
    ("none", "table", "full"): "no memory",
    ("convolution", "table", "full"): "memory by convolution",
    ("per-pair", "exact", "full"): "waves summed exactly (the setting's own error)",
    ("per-pair", "table", "crane locked"): "crane locked",
    ("per-pair", "table", "vessel prescribed"): "vessel prescribed, one-way",
    ("per-pair", "table", "payload as weight"): "payload as a constant weight",
    ("per-pair", "table", "frequency domain"): "frequency domain at the start pose",
}
COLUMNS = {
    "payload, m": ("payload_position", 1.0),
    "roll, deg": ("roll", np.degrees(1.0)),
    "hook tension, kN": ("hook_load", 1e-3),
    "cylinder force, kN": ("cylinder_force", 1e-3),
}


def physics() -> Iterator[list[str]]:
    """A row for each scene with less physics."""
    measured = trade(cases.case2(), budget=BUDGET, progress=False)
    measured.plot(over="cpu_s").savefig(FIGURE, dpi=110)
    rows = {tuple(row.case.values()): row for row in measured.rows}
    for key, row in rows.items():
        if key != FULL:
            errors = ((row.error(quantity), scale) for quantity, scale in COLUMNS.values())
            yield [_words(*key), *(_told(*one) for one in errors)]
    yield from _memories()


def _memories() -> Iterator[list[str]]:
    """Other memories than that per pair, by a tight run of each."""
    scene = cases.case2()
    quantities = quantities_of(scene, scene.compile(), [name for name, _ in COLUMNS.values()])
    how: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-8}
    truth = simulate(scene, 100.0, **how)
    for kind in ("by-motion", "convolution"):
        found = simulate(cases.case2(memory=kind), 100.0, **how)
        apart = (
            compare(quantities[q].values(truth), quantities[q].values(found)) for q, _ in COLUMNS.values()
        )
        scaled = zip(apart, COLUMNS.values(), strict=True)
        yield [f"memory {kind}", *(_told(one.largest, scale) for one, (_, scale) in scaled)]


def _told(error: float, scale: float) -> str:
    return "" if np.isnan(error) else significant(error * scale, 2)


def _words(memory: str, waves: str, rung: str) -> str:
    if (memory, waves, rung) in WORDS:
        return WORDS[memory, waves, rung]
    if ":" in memory:
        kind, states = memory.split(":")
        return f"memory {kind.replace('-', ' ')}, {states} states"
    return waves.replace("table", "wave table").replace("of 200", "strongest of 200")


SECTION = Section(
    title="What leaving physics out of case 2 loses",
    name="trade-of-case-2-physics",
    text=(
        "Largest errors over 100 s, by `trade` with the default setting; of other memories than that per "
        "pair between two tight runs."
    ),
    head=["changed", *COLUMNS],
    rows=physics,
    sources=(*CRANE, "python/seacrane/accuracy"),
)
