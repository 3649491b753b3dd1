"""What leaving physics out of case 2 loses; and the picture of docs/trade.md."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from seacrane import Scene, answers, cases, simulate, trade
from seacrane.accuracy.quantities import compare, quantities_of

from .section import RESULTS, Section, significant
from .sources import CRANE

FIGURE = RESULTS.parents[1] / "docs" / "figures" / "trade_case2.png"
BUDGET = 30  # runs of the default setting, beside the reference
COLUMNS = {
    "payload, m": ("payload_position", 1.0),
    "roll, deg": ("roll", np.degrees(1.0)),
    "hook tension, kN": ("hook_load", 1e-3),
    "cylinder force, kN": ("cylinder_force", 1e-3),
}


def physics() -> Iterator[list[str]]:
    """A row for each scene with less physics; and the picture."""
    trade(cases.case2(), budget=BUDGET, progress=False).plot().savefig(FIGURE, dpi=110)
    scene = cases.case2()
    quantities = quantities_of(scene, scene.compile(), [name for name, _ in COLUMNS.values()])
    truth = simulate(scene, 100.0, integrator="dop853", rtol=1e-8)
    for name, other in _changed(scene).items():
        found = simulate(other, 100.0, integrator="dop853", rtol=1e-8)
        yield [name, *(
            significant(compare(quantities[q].values(truth), quantities[q].values(found)).largest * scale, 2)
            for q, scale in COLUMNS.values()
        )]  # fmt: skip


def _changed(scene: Scene) -> dict[str, Scene]:
    waves = scene.waves
    assert waves is not None
    count = len(waves.omega)
    return {
        "no memory": answers.with_memory(scene, "none"),
        "memory by-motion": cases.case2(memory="by-motion"),
        "memory convolution": cases.case2(memory="convolution"),
        "waves summed exactly": scene.copy(waves=replace(waves, evaluation="exact")),
        f"{count // 2} strongest of {count} components": scene.copy(
            waves=answers.strongest(waves, count // 2)
        ),
        f"{count // 4} strongest of {count} components": scene.copy(
            waves=answers.strongest(waves, count // 4)
        ),
        "crane locked": answers.locked(scene),
    }


SECTION = Section(
    title="What leaving physics out of case 2 loses",
    name="trade-of-case-2-physics",
    text="Largest differences over 100 s between tight runs.",
    head=["changed", *COLUMNS],
    rows=physics,
    sources=(*CRANE, "python/seacrane/accuracy"),
)
