"""100 s of the lift cases with default settings, and what each ingredient costs."""

from __future__ import annotations

from typing import Any

from .scenes import SCENES
from .section import Section
from .timing import Timed, timed_run

T_END = 100.0  # s
AIM = 300


def speed(*, repeats: int) -> Section:
    """Wall time and ratio to real time of every scene, and of case 2 with less to record."""
    rows: list[list[Any]] = []
    for name, make in SCENES.items():
        scene = make()
        run = timed_run(scene, repeats=repeats, t_end=T_END)
        rows.append(_row(name, run))
    scene = SCENES["case2"]()
    model = scene.compile()
    for label, settings in {
        "case2, outputs every 1 s": {"dt_out": 1.0},
        "case2, `position` only, every 0.1 s": {"channels": ["position"]},
        "case2, start and end only": {"dt_out": T_END},
    }.items():
        run = timed_run(scene, model=model, repeats=repeats, t_end=T_END, **settings)
        rows.append(_row(label, run))
    return Section(
        title="Speed of 100 s",
        text=(
            "Defaults: dopri5 at rtol 1e-6, every default channel every 0.1 s, memory per pair, 200 wave "
            f"components by table. Times of the loop, recording included; best of {repeats}. The aim for "
            f"case2 is {AIM} times real time."
        ),
        head=["scene", "wall, ms", "CPU, ms", "times real time (wall)", "times real time (CPU)",
              "over case2 (CPU)", "evaluations", "steps", "rejected", "us per evaluation, all in"],
        rows=[[*row[:5], row[2] / rows[0][2], *row[5:]] for row in rows],
    )  # fmt: skip


def _row(name: str, run: Timed) -> list[Any]:
    counters = run.counters
    return [
        name,
        1e3 * run.wall,
        1e3 * run.cpu,
        round(T_END / run.wall),
        round(T_END / run.cpu),
        counters["evaluations"],
        counters["steps"],
        counters["rejected_steps"],
        1e6 * run.cpu / counters["evaluations"],
    ]
