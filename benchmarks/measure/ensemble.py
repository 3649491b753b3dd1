"""What a member of an ensemble costs beside the loop, and how many workers share."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import nullcontext
from typing import Any

from seacrane import Kept, Run, Scene, cases, ensemble, simulate
from seacrane.ensembles.other_sea import with_sea

from .section import Section
from .timing import best_seconds

TRACK = {"track": Kept(channel="position", names={"body": "payload"}, interval=1.0)}
HOW: dict[str, Any] = {"rtol": 1e-2, "dt_out": 1.0}
SHORT = 0.1  # s


def one_member(*, repeats: int) -> Section:
    """CPU time of the parts of one member."""
    scene = cases.case2()

    def stepped() -> Run:
        run = _run(scene)
        run.advance(100.0)
        return run

    done = stepped()
    waves = with_sea(scene, {"seed": 2}).waves
    assert waves is not None
    describing = best_seconds(cases.case2, repeats=repeats)
    sea = best_seconds(lambda: with_sea(scene, {"seed": 2}), repeats=repeats)
    once_more = best_seconds(lambda: _run(scene), repeats=repeats)
    fresh = iter([cases.case2() for _ in range(2 * repeats)])
    preparing = best_seconds(lambda: _run(next(fresh)), repeats=repeats)
    first = best_seconds(lambda: simulate(next(fresh), SHORT), repeats=repeats)
    short = best_seconds(lambda: simulate(scene, SHORT), repeats=repeats)
    again = best_seconds(lambda: done.in_sea(waves), repeats=repeats)
    loop = best_seconds(stepped, repeats=repeats) - once_more
    result = best_seconds(done.result, repeats=repeats)
    return Section(
        title="One member of an ensemble",
        text=(
            "CPU time in ms of the parts of one member: case 2, 100 s, default method at rtol 1e-2, payload "
            "every second. A function describes the whole lift, and its run is checked and compiled. Of a "
            "scene only the sea is made again and compiled. To end is to look for what is out of range and "
            f"to make the result. Two rows are of `simulate` to {SHORT:g} s with all usual channels, whose "
            "loop is next to nothing: of a scene that nobody looked at before, and of one that was run "
            f"before. Best of {repeats}."
        ),
        head=["part", "ms"],
        rows=[
            ["describe the lift (function)", 1e3 * describing],
            ["prepare the run (function)", 1e3 * preparing],
            ["prepare the run (scene that was run before)", 1e3 * once_more],
            ["make the sea again (scene)", 1e3 * sea],
            ["prepare the run in it (scene)", 1e3 * again],
            ["step", 1e3 * loop],
            ["end", 1e3 * result],
            ["all of a short run (function)", 1e3 * first],
            ["all of a short run (scene that was run before)", 1e3 * short],
        ],
    )


def workers(*, repeats: int, members: int = 16, t_end: float = 1000.0) -> Section:
    """Wall time of an ensemble by executor."""
    scene = cases.case2()

    def wall(executor: Executor | None) -> float:
        start = time.perf_counter()
        ensemble(
            scene, over={"seed": range(members)}, keep=TRACK, t_end=t_end,
            executor=executor, **HOW,
        )  # fmt: skip
        return time.perf_counter() - start

    kinds: list[tuple[str, Callable[[], Any]]] = [
        ("none", nullcontext),
        ("two threads", lambda: ThreadPoolExecutor(2)),
        ("two processes", lambda: ProcessPoolExecutor(2)),
    ]
    rows = []
    for name, opened in kinds:
        with opened() as executor:
            wall(executor)
            rows.append([name, min(wall(executor) for _ in range(repeats))])
    return Section(
        title="Ensembles by executor",
        text=(
            f"Wall time in s of {members} seeds of case 2, {t_end:g} s each, default method at rtol 1e-2, "
            f"payload every second. Best of {repeats}. Load of the machine, with this: "
            f"{os.getloadavg()[0]:.1f} on {os.cpu_count()} cores; ratios tell of workers only where nothing "
            "else ran."
        ),
        head=["executor", "wall, s"],
        rows=rows,
    )


def _run(scene: Scene) -> Run:
    return Run(scene, 100.0, channels=["position"], **HOW)
