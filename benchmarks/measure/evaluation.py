"""Cost of one evaluation of the right-hand side, in all and by part."""

from __future__ import annotations

import numpy as np

from seacrane.analysis import Evaluator

from .scenes import SCENES
from .section import Section
from .timing import evaluation_ns

COUNT, TIMES = 500, 10  # short bursts, so that many of them run undisturbed
AIM_NS = 20_000


def whole(*, repeats: int) -> Section:
    """One evaluation of every scene; waves by table or exactly, memory or none."""
    costs = {name: evaluation_ns(make().compile(), repeats=2 * repeats) for name, make in SCENES.items()}
    return Section(
        title="One evaluation",
        text=(
            "The whole right-hand side at the start, time advancing 25 ms per call; best of "
            f"{2 * repeats} times 4,000. The aim for case2 is {AIM_NS:,} ns."
        ),
        head=["scene", "ns", "over case2"],
        rows=[[name, round(ns), ns / costs["case2"]] for name, ns in costs.items()],
    )


def parts(*, repeats: int, formulation: str = "redundant") -> Section:
    """Case 2 by part, quickest of several for each."""
    model = SCENES["case2"]().compile()
    evaluator, state = Evaluator(model, formulation), np.array(model.initial_state)
    measured = [evaluator.time_parts(0.0, state, COUNT) for _ in range(TIMES * repeats)]
    quickest = {name: min(m[name] for m in measured) for name in measured[0]}
    total = quickest["whole evaluation"]
    return Section(
        title="One evaluation of case 2 by part" + (", recursive" if formulation == "recursive" else ""),
        text=(
            "`Evaluator.time_parts`, each part repeated alone; wall time, best of "
            f"{TIMES * repeats} times {COUNT:,}."
        ),
        head=["part", "ns", "share"],
        rows=[[name, round(ns), f"{100.0 * ns / total:.0f} %"] for name, ns in quickest.items()],
    )
