"""What a run of the lift cases costs, in both formulations; one evaluation by its parts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from seacrane import Scene
from seacrane.analysis import Evaluator

from .scenes import SCENES
from .section import Section
from .sources import CRANE, ENGINE
from .timing import evaluation_ns, timed_run

T_END, REPEATS = 100.0, 5
FAST: dict[str, Any] = {"integrator": "tsit5", "rtol": 1e-2}  # 1 cm on the payload of case 2
OUTPUTS: dict[str, dict[str, Any]] = {
    "case2, outputs every 1 s": {"dt_out": 1.0},
    "case2, `position` only, every 0.1 s": {"channels": ["position"]},
    "case2, start and end only": {"dt_out": T_END},
}
FORMULATIONS = ("recursive", "redundant")


def speed() -> Iterator[list[Any]]:
    """Every scene in both formulations, and case 2 with less to record."""
    for name, make in SCENES.items():
        for formulation in FORMULATIONS:
            yield _row(name, make(), formulation, {})
    for name, outputs in OUTPUTS.items():
        yield _row(name, SCENES["case2"](), "recursive", outputs)


def _row(name: str, scene: Scene, formulation: str, outputs: dict[str, Any]) -> list[Any]:
    model = scene.compile()
    given: dict[str, Any] = {"model": model, "repeats": REPEATS, "t_end": T_END, "formulation": formulation}
    usual = timed_run(scene, **given, **outputs)
    fast = timed_run(scene, **given, **outputs, **FAST)
    return [
        name, formulation, model.states,
        evaluation_ns(model, repeats=2 * REPEATS, formulation=formulation),
        1e3 * usual.cpu, round(T_END / usual.cpu), usual.counters["evaluations"],
        1e3 * fast.cpu, round(T_END / fast.cpu),
    ]  # fmt: skip


def parts() -> list[list[Any]]:
    """Shortest time of every part of an evaluation of case 2, in both formulations."""
    model = SCENES["case2"]().compile()
    state = np.array(model.initial_state)
    found: dict[str, dict[str, float]] = {}
    for formulation in FORMULATIONS:
        evaluator = Evaluator(model, formulation)
        runs = [evaluator.time_parts(0.0, state, 500) for _ in range(10 * REPEATS)]
        for name in runs[0]:
            found.setdefault(name, {})[formulation] = min(run[name] for run in runs)
    return [
        [name, *(round(one[form]) if form in one else None for form in FORMULATIONS)]
        for name, one in found.items()
    ]


SPEED = Section(
    title="Speed of 100 s",
    text=(
        "One evaluation of the whole right-hand side, and the CPU time of the loop over 100 s, recording "
        "included. The default is `dopri5` at rtol 1e-6 with every default channel every 0.1 s; beside it "
        f"runs `tsit5` at rtol 1e-2. Memory per pair, 200 wave components by table; best of {REPEATS}. The "
        "default of `formulation` takes the recursive form where it can. Aims for case2: 3,000 ns, and 300 "
        "times real time."
    ),
    head=["scene", "formulation", "states", "evaluation, ns", "CPU, ms", "times real time", "evaluations",
          "`tsit5`: CPU, ms", "`tsit5`: times real time"],
    rows=speed,
    sources=ENGINE,
)  # fmt: skip
PARTS = Section(
    title="One evaluation of case 2 by part",
    text="`Evaluator.time_parts`, ns, each part repeated alone, in the recursive and the redundant form.",
    head=["part", *FORMULATIONS],
    rows=parts,
    sources=CRANE,
)
