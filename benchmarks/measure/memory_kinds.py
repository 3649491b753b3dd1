"""What each kind of fluid memory costs: per evaluation, per sample of a convolution, and over a whole run."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from seacrane import cases
from seacrane.analysis import Evaluator

from .section import Section
from .sources import CRANE
from .timing import Timed, timed_run

PART = "loads, waves, memory"
SAMPLE = "sample of a convolution, per its step"
KINDS = ("per-pair", "by-motion", "convolution")
SCENES = {"vessel": cases.vessel, "case2": cases.case2}
T_END, REPEATS = 100.0, 3  # s, -


def memory_kinds() -> Iterator[list[Any]]:
    """The vessel alone and case 2 with every kind, runs in turns, over the runs with memory per pair."""
    for name, make in SCENES.items():
        scenes = {kind: make(memory=kind) for kind in KINDS}
        floor = _parts(make(memory="none").compile())[PART]
        models = {kind: scene.compile() for kind, scene in scenes.items()}
        best: dict[str, Timed] = {}
        for _ in range(REPEATS):
            for kind in KINDS:
                done = timed_run(scenes[kind], model=models[kind], repeats=1, t_end=T_END)
                best[kind] = min(done, best.get(kind, done), key=lambda run: run.cpu)
        for kind in KINDS:
            parts, run = _parts(models[kind]), best[kind]
            yield [
                name, kind, models[kind].memory_states, round(parts[PART] - floor),
                parts[SAMPLE] / 1e3 if SAMPLE in parts else None, run.counters["evaluations"], 1e3 * run.cpu,
                run.cpu / best["per-pair"].cpu,
            ]  # fmt: skip


def _parts(model: Any) -> dict[str, float]:
    """Shortest time of every part of an evaluation, ns."""
    state = np.array(model.initial_state)
    runs = [Evaluator(model).time_parts(0.0, state, 4_000) for _ in range(REPEATS)]
    return {name: min(run[name] for run in runs) for name in runs[0]}


SECTION = Section(
    title="Kinds of fluid memory",
    text=(
        "The memory's share of one evaluation, as the part `loads, waves, memory` less that of the scene "
        "without memory. A convolution also takes a sample of the motion, once per step of its own and not "
        f"once per evaluation. Then {T_END:g} s with defaults, CPU time of the loop, and its ratio over that "
        f"per pair; best of {REPEATS}, in turns."
    ),
    head=[
        "scene",
        "memory",
        "states",
        "ns per evaluation",
        "us per sample",
        "evaluations",
        "run, ms",
        "ratio",
    ],
    rows=memory_kinds,
    sources=CRANE,
)
