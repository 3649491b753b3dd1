"""What the states of the fluid memory cost: per evaluation, and over a whole run."""

from __future__ import annotations

from typing import Any

from .scenes import SCENES
from .section import Section
from .speed import T_END
from .timing import evaluation_ns, timed_run

PAIRS = (("case2", "case2, no memory"), ("vessel", "vessel, no memory"))


def memory_cost(*, repeats: int) -> Section:
    """Each scene with its memory over the same scene without."""
    rows = [_row(kept, dropped, repeats) for kept, dropped in PAIRS]
    return Section(
        title="Fluid memory",
        text=(
            "100 s with defaults, with memory over without; CPU time, best of "
            f"{repeats}. Without memory there is no radiation damping, so the vessel moves more and the "
            "integrator takes other steps. The two runs therefore solve different problems, and only the "
            "costs of one evaluation can be compared."
        ),
        head=["scene", "memory states", "all states", "one evaluation, ratio", "evaluations with", "without",
              "whole run, ratio"],
        rows=rows,
    )  # fmt: skip


def _row(kept: str, dropped: str, repeats: int) -> list[Any]:
    scenes = [SCENES[name]() for name in (kept, dropped)]
    models = [scene.compile() for scene in scenes]
    costs = [evaluation_ns(model, repeats=2 * repeats) for model in models]
    runs = [
        timed_run(scene, model=model, repeats=repeats, t_end=T_END)
        for scene, model in zip(scenes, models, strict=True)
    ]
    return [
        kept,
        models[0].memory_states,
        models[0].states,
        costs[0] / costs[1],
        *(run.counters["evaluations"] for run in runs),
        runs[0].cpu / runs[1].cpu,
    ]
