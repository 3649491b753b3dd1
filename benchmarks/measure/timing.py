"""Best of several: on a shared machine the quickest of equal runs is the one least disturbed.

CPU times are those of the calling thread, which does all the work; they leave out what others take.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import Model, Scene
from seacrane.accuracy.case import Case, timed
from seacrane.analysis import Evaluator
from seacrane.run.method import settled

Array = NDArray[np.float64]


def best_seconds(function: Callable[[], object], *, repeats: int) -> float:
    """Shortest CPU time of a call, s."""
    times = []
    for _ in range(repeats):
        start = time.thread_time()
        function()
        times.append(time.thread_time() - start)
    return min(times)


@dataclass(frozen=True, kw_only=True)
class Timed:
    """Equal runs: shortest wall time and CPU time of the loop (s), its counters, and its channels."""

    wall: float
    cpu: float
    counters: dict[str, Any]
    channels: dict[str, Array]


def timed_run(
    scene: Scene, *, model: Model | None = None, repeats: int, t_end: float, **settings: Any
) -> Timed:
    """Run a scene several times; compiling and preparing are not part of the wall time."""
    method, outputs = settled(None, None, settings)
    case = Case(scene=scene, t_end=t_end, dt_out=outputs.dt_out, compiled=model)
    done = timed(case, method, outputs.channels, repeats=repeats)
    channels = dict(done.result().channels)
    return Timed(wall=done.wall_s, cpu=done.cpu_s, counters=dict(done.stats), channels=channels)


def evaluation_ns(model: Model, *, repeats: int, count: int = 4_000, formulation: str = "redundant") -> float:
    """Nanoseconds of one evaluation of the whole right-hand side.

    Time advances by 25 ms per call, as it does on average in 100 s of case 2 with default settings, so that
    new blocks of the wave table are entered as often as in a run.
    """
    evaluator, state = Evaluator(model, formulation), np.array(model.initial_state)
    evaluator.repeat(0.0, state, count // 10, 25e-3)
    return best_seconds(lambda: evaluator.repeat(0.0, state, count, 25e-3), repeats=repeats) / count * 1e9
