"""What the kind of fluid memory costs over a whole run."""

from __future__ import annotations

from typing import Any

from seacrane import cases

from .section import Section
from .speed import T_END
from .timing import Timed, evaluation_ns, timed_run

KINDS = ("per-pair", "by-motion", "convolution")
SCENES = {"case2": cases.case2, "vessel": cases.vessel}


def memory_speed(*, repeats: int) -> Section:
    """Case 2 and the vessel alone with every kind, in turns, over the runs with memory per pair."""
    rows = [row for name in SCENES for row in _rows(name, repeats)]
    return Section(
        title="Kinds of fluid memory over a run",
        text=(
            f"{T_END:g} s with defaults, best of {repeats} runs of each kind in turns; CPU time of the loop, "
            "and its ratio over that per pair."
        ),
        head=["scene", "memory", "states", "one evaluation, ns", "evaluations", "run, ms", "ratio"],
        rows=rows,
    )


def _rows(name: str, repeats: int) -> list[list[Any]]:
    scenes = {kind: SCENES[name](memory=kind) for kind in KINDS}
    models = {kind: scene.compile() for kind, scene in scenes.items()}
    best: dict[str, Timed] = {}
    costs = dict.fromkeys(KINDS, float("inf"))
    for _ in range(repeats):
        for kind in KINDS:
            done = timed_run(scenes[kind], model=models[kind], repeats=1, t_end=T_END)
            if kind not in best or done.cpu < best[kind].cpu:
                best[kind] = done
            costs[kind] = min(costs[kind], evaluation_ns(models[kind], repeats=1))
    return [
        [
            name,
            kind,
            models[kind].memory_states,
            round(costs[kind]),
            best[kind].counters["evaluations"],
            1e3 * best[kind].cpu,
            best[kind].cpu / best["per-pair"].cpu,
        ]
        for kind in KINDS
    ]
