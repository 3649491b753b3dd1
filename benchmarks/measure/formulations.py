"""Both formulations: an evaluation, 100 s of the cases, the vessel alone, and two runs at a time."""

from __future__ import annotations

import threading
import time
from typing import Any

from seacrane import Model, Run, Scene

from .scenes import SCENES
from .section import Section
from .timing import evaluation_ns, timed_run

T_END = 100.0  # s
FAST = {"integrator": "tsit5", "rtol": 1e-2}  # 1 cm on the payload of case 2
AIM_VESSEL, AIM_THREADS = 30_000, 1.8


def formulations(*, repeats: int) -> Section:
    """Cost of an evaluation and of 100 s by either formulation."""
    rows: list[list[Any]] = []
    for name in ("case1", "case2", "case3", "vessel", "case2, no memory", "case2, calm water"):
        scene = SCENES[name]()
        model = scene.compile()
        for kind in ("redundant", "recursive"):
            ns = evaluation_ns(model, repeats=2 * repeats, formulation=kind)
            tight = timed_run(scene, model=model, repeats=repeats, t_end=T_END, formulation=kind)
            fast = timed_run(scene, model=model, repeats=repeats, t_end=T_END, formulation=kind, **FAST)
            rows.append([name, kind, round(ns), 1e3 * tight.cpu, 1e3 * fast.cpu, round(T_END / fast.cpu)])
    return Section(
        title="Formulations",
        text=(
            "One evaluation, and the CPU time of 100 s with all default channels every 0.1 s: dopri5 at rtol "
            "1e-6, and tsit5 at rtol 1e-2. The aim for the recursive form of case2 is 3,000 ns."
        ),
        head=["scene", "formulation", "evaluation, ns", "dopri5 1e-6, ms", "tsit5 1e-2, ms",
              "times real time (tsit5)"],
        rows=rows,
    )  # fmt: skip


def _advance_all(scene: Scene, model: Model, threads: int, t_end: float) -> float:
    """Wall time of as many equal runs at a time, s."""
    runs = [Run(scene, model=model, t_end=t_end, dt_out=1.0, formulation="recursive") for _ in range(threads)]
    workers = [threading.Thread(target=run.advance, args=(t_end,)) for run in runs]
    start = time.perf_counter()
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    return time.perf_counter() - start


def throughput(*, repeats: int) -> Section:
    """The vessel alone, and runs of one model in two threads."""
    vessel = SCENES["vessel"]()
    rows: list[list[Any]] = []
    for label, settings in {
        "vessel, all channels every 0.1 s": {},
        "vessel, all channels every 1 s": {"dt_out": 1.0},
        "vessel, `vessel_motion` every 1 s": {"dt_out": 1.0, "channels": ["vessel_motion"]},
    }.items():
        run = timed_run(vessel, repeats=repeats, t_end=1000.0, formulation="recursive", **FAST, **settings)
        rows.append([label, 1e3 * run.wall, round(1000.0 / run.wall), f"at least {AIM_VESSEL}"])
    scene = SCENES["case2"]()
    model = scene.compile()
    one = min(_advance_all(scene, model, 1, 200.0) for _ in range(repeats))
    two = min(_advance_all(scene, model, 2, 200.0) for _ in range(repeats))
    rows.append(["case2, one thread", 1e3 * one, round(200.0 / one), None])
    rows.append(["case2, two threads, both runs", 1e3 * two, round(400.0 / two), None])
    rows.append(["two threads over one, throughput", None, 2.0 * one / two, f"at least {AIM_THREADS}"])
    return Section(
        title="The vessel alone, and two threads",
        text=(
            "Wall times. The vessel in waves runs for 1,000 s by tsit5 at rtol 1e-2. Case 2 runs for 200 s "
            "by dopri5 at rtol 1e-6, with outputs every 1 s; threads share one model. "
            f"Best of {repeats}."
        ),
        head=["run", "wall, ms", "times real time, or ratio", "aim"],
        rows=rows,
    )
