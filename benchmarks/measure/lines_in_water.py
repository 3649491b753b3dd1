"""What a line with mass costs in water: one evaluation, and a run, by what it is in and how it stretches."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

import numpy as np

from seacrane import Run, Scene, equilibrium
from seacrane.analysis import Evaluator, fastest_mode
from seacrane.run import Outputs

from .section import Section
from .sources import LINE, RUN, STEPS, WATER

LENGTH, LOAD, COMPONENTS, REPEATS = 1000.0, 40e3, 200, 3  # m, kg, -, -
T_END = 30.0  # s
COUNT = 300


def lines_in_water() -> Iterator[list[Any]]:
    """A medium, how many segments and their rung, and what a run takes."""
    for medium, count in (("air", 10), ("air", 40), ("still water", 40), ("sea", 40)):
        for rung in ("quasi-static", "elastic"):
            scene = _hanging(medium, count, rung)
            yield [medium, count, rung, fastest_mode(scene.compile()), *_cost(scene)]


def _hanging(medium: str, count: int, rung: str) -> Scene:
    scene = Scene(name="line in water")
    if medium == "sea":
        scene.add_sea(vessel=None, hs=2.0, tp=8.0, gamma=3.3, direction_deg=135.0, count=COMPONENTS, seed=1)
    place = (0.0, 0.0, -5.0 - LENGTH)
    scene.add_body(name="load", mass=LOAD, inertia=(1e5, 1e5, 1e5), position=place)
    scene.add_line(
        "wire", "ground", "load", first_point=(0.0, 0.0, -5.0), second_point=(0.0, 0.0, 0.0), EA=4e8,
        length=LENGTH, wire={"mass_per_length": 25.0, "segments": count, "diameter": 0.06,
        "medium": "air" if medium == "air" else "sea"}, rung=rung,
    )  # fmt: skip
    return scene


def _cost(scene: Scene) -> tuple[float, float, float]:
    """us of an evaluation, evaluations and times real time of a run."""
    model = scene.compile()
    state = np.array(model.initial_state)
    evaluator = Evaluator(model, "recursive")
    took = [evaluator.time_parts(0.0, state, COUNT)["whole evaluation"] for _ in range(REPEATS)]
    start, fastest, evaluations = equilibrium(scene), np.inf, 0
    for _ in range(REPEATS):
        run = Run(scene, T_END, start=start, outputs=Outputs(dt_out=0.1, channels=["line_tension"]))
        began = time.thread_time()
        run.advance(T_END)
        fastest = min(fastest, time.thread_time() - began)
        evaluations = run.stats()["evaluations"]
    return 1e-3 * min(took), evaluations / T_END, T_END / fastest


SECTION = Section(
    title="Lines with mass",
    text=(
        f"{LENGTH:g} m of wire in segments, from 5 m below the surface on, {LOAD / 1e3:g} t on it. The sea "
        f"has {COMPONENTS} components (Hs 2 m, Tp 8 s). The fastest mode, one evaluation in the recursive "
        f"form, and runs of {T_END:g} s by the default method from rest, without finding it; best of "
        f"{REPEATS}."
    ),
    head=["in", "segments", "stretch", "fastest mode, 1/s", "evaluation [us]", "evaluations per s",
          "times real time"],
    rows=lines_in_water,
    sources=(*STEPS, *WATER, *RUN, *LINE, "cpp/seacrane/elements/loads/seabed_node.hpp"),
)  # fmt: skip
