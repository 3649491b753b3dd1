"""What runs side by side in vector lanes cost, against each by itself."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from seacrane import Method, Outputs, Run, Scene, _core, cases
from seacrane.analysis import Evaluator
from seacrane.ensembles.other_sea import with_sea
from seacrane.run.lanes import INSTRUCTIONS, advance_side_by_side, module_of

from .section import Section
from .timing import best_seconds

SEEDS = 16
END = 100.0  # s
ROUNDS = 2000  # evaluations that are timed together
FINE = 1e-9


def lanes(*, repeats: int) -> Section:
    """Case 2: one evaluation, and the loop of 100 s of 16 seeds, by lanes."""
    scene = cases.case2()
    scenes = [with_sea(scene, {"seed": seed}) for seed in range(1, SEEDS + 1)]
    right = _tracks(_stepped(_begun(scenes, FINE), 1))
    rows = []
    for count in (1, *(lanes for lanes in INSTRUCTIONS if module_of(lanes) is not None)):
        tracks = _tracks(_stepped(_begun(scenes, 1e-2), count))
        loop = _loop(scenes, count, repeats)
        rows.append(
            [count, 1e9 * _evaluation(scenes, count, repeats), 1e3 * loop / SEEDS, SEEDS * END / loop,
             float(np.abs(tracks - right).max())]
        )  # fmt: skip
    return Section(
        title="Runs side by side",
        text=(
            f"Case 2 in {SEEDS} seas, CPU time of one thread: one evaluation for a lane, and the loop of "
            f"{END:g} s with tsit5 at rtol 1e-2 and positions every second, for a run. The error is "
            f"the largest of the payload over all seas. Best of {repeats}."
        ),
        head=[
            "lanes",
            "one evaluation, ns a lane",
            "loop, ms a run",
            "simulated s per s",
            "payload error, m",
        ],
        rows=rows,
    )


def _begun(scenes: Sequence[Scene], rtol: float) -> list[Run]:
    method = Method(integrator="tsit5" if rtol > FINE else "dop853", rtol=rtol, formulation="recursive")
    outputs = Outputs(dt_out=1.0, channels=("position",))
    return [Run(scene, END, method=method, outputs=outputs) for scene in scenes]


def _stepped(runs: Sequence[Run], count: int) -> Sequence[Run]:
    for first in range(0, len(runs), count):
        together = runs[first : first + count]
        if count > 1:
            advance_side_by_side(together, count, lambda _: None)
        for run in together:
            run.advance(END)
    return runs


def _tracks(runs: Sequence[Run]) -> Any:
    return np.array([run.result().select("position", body="payload") for run in runs])


def _loop(scenes: Sequence[Scene], count: int, repeats: int) -> float:
    """CPU seconds of all runs, without what prepares them."""
    begun = [_begun(scenes, 1e-2) for _ in range(repeats)]
    return best_seconds(lambda: _stepped(begun.pop(), count), repeats=repeats)


def _evaluation(scenes: Sequence[Scene], count: int, repeats: int) -> float:
    models = [scene.compile() for scene in scenes[:count]]
    if count == 1:
        state, evaluator = models[0].initial_state, Evaluator(models[0], "recursive")
        return best_seconds(lambda: evaluator.repeat(0.0, state, ROUNDS, 0.025), repeats=repeats) / ROUNDS
    lanes = _core.LaneEvaluator(module_of(count), models)
    start = lanes.start()
    return best_seconds(lambda: lanes.repeat(0.0, start, ROUNDS, 0.025), repeats=repeats) / ROUNDS / count
