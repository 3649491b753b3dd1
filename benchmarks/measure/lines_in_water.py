"""What a line with mass costs in water: one evaluation, and a run, by what it is in and how it stretches."""

from __future__ import annotations

import time

import numpy as np

from seacrane import Run, Scene, equilibrium
from seacrane.analysis import Evaluator
from seacrane.run import Outputs

from .section import Section

SEGMENTS, LENGTH, LOAD, COMPONENTS = 40, 1000.0, 40e3, 200  # -, m, kg, -
T_END = 30.0  # s
COUNT = 300


def lines_in_water(*, repeats: int) -> Section:
    """40 segments from below the surface down: a medium, a rung of the segments, and what a run takes."""
    rows = []
    for medium in ("air", "still water", "sea"):
        for rung in ("quasi-static", "elastic"):
            scene = _hanging(medium, rung)
            rows.append([medium, rung, *_cost(scene, repeats)])
    return Section(
        title="Lines in water",
        text=(
            f"{LENGTH:g} m of wire in {SEGMENTS} segments, from 5 m below the surface on, {LOAD / 1e3:g} t "
            "on it. "
            f"The sea has {COMPONENTS} components (Hs 2 m, Tp 8 s). One evaluation, recursive form, and runs "
            f"of {T_END:g} s by the default method from rest, without finding it; best of all repeats."
        ),
        head=["in", "segments", "evaluation [us]", "evaluations per s", "times real time"],
        rows=rows,
    )


def _hanging(medium: str, rung: str) -> Scene:
    scene = Scene(name="line in water")
    if medium == "sea":
        scene.add_sea(vessel=None, hs=2.0, tp=8.0, gamma=3.3, direction_deg=135.0, count=COMPONENTS, seed=1)
    place = (0.0, 0.0, -5.0 - LENGTH)
    scene.add_body(name="load", mass=LOAD, inertia=(1e5, 1e5, 1e5), position=place)
    scene.add_line(
        "wire", "ground", "load", first_point=(0.0, 0.0, -5.0), second_point=(0.0, 0.0, 0.0),
        rung="with mass", EA=4e8, length=LENGTH, mass_per_length=25.0, segments=SEGMENTS, segment_rung=rung,
        diameter=0.06, medium="air" if medium == "air" else "sea",
    )  # fmt: skip
    return scene


def _cost(scene: Scene, repeats: int) -> tuple[float, float, float]:
    """us of an evaluation, evaluations and times real time of a run."""
    model = scene.compile()
    state = np.array(model.initial_state)
    evaluator = Evaluator(model, "recursive")
    took = [evaluator.time_parts(0.0, state, COUNT)["whole evaluation"] for _ in range(repeats)]
    start, fastest, evaluations = equilibrium(scene), np.inf, 0
    for _ in range(repeats):
        run = Run(scene, T_END, start=start, outputs=Outputs(dt_out=0.1, channels=["line_tension"]))
        began = time.thread_time()
        run.advance(T_END)
        fastest = min(fastest, time.thread_time() - began)
        evaluations = run.stats()["evaluations"]
    return 1e-3 * min(took), evaluations / T_END, T_END / fastest
