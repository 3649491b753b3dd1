"""What two vessels in one water cost: an evaluation, and ten minutes with and without their coupling."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from seacrane import Scene, Stage, Until, simulate
from seacrane.analysis import Evaluator
from seacrane.crane import load_crane
from seacrane.hydro import two_barges

from .section import Section
from .sources import CRANE, LINE

T_END = 600.0  # s
COUNT = 500
REPEATS = 3
SEA = {"hs": 1.0, "tp": 7.0, "direction_deg": 150.0, "seed": 1}
MASS, SIZE, DECK = 60e3, (8.0, 6.0, 5.0), 2.5  # kg, m, m
FEET = [(x, y, -2.5) for x in (-3.5, 3.5) for y in (-2.5, 2.5)]
LIFT = (
    Stage(name="wait", duration=300.0),
    Stage(
        name="lift off", until=Until.clear("feet", minimum=2.0), maximum_duration=60.0,
        commands={"hoist.rate": -0.4},
    ),
    Stage(name="hoist", duration=280.0, commands={"hoist.rate": 0.0}),
)  # fmt: skip


def feeder() -> Iterator[list[object]]:
    """One vessel, two without and with coupling, and a lift off one of them by the other's crane."""
    waters = {"without coupling": None, "with coupling": 0.03}
    single = _timed("one vessel", _one(), [])
    rows = [single]
    rows += [_timed(f"two vessels, {water}", _two(lid), []) for water, lid in waters.items()]
    rows += [_timed(f"feeder lift, {water}", _lift(lid), LIFT) for water, lid in waters.items()]
    yield from ([*row, float(row[2]) / float(single[2])] for row in rows)  # type: ignore[arg-type]


def _one() -> Scene:
    scene = Scene(name="one vessel", gravity=9.81)
    scene.add_vessel(two_barges(lid_damping=None)["crane vessel"], name="crane vessel", mooring=60.0)
    scene.add_sea(vessel="crane vessel", **SEA)
    return scene


def _two(lid: float | None) -> Scene:
    scene = Scene(name="two vessels", gravity=9.81)
    scene.add_vessel(two_barges(lid_damping=lid), mooring=60.0)
    for vessel in scene.vessels:
        scene.add_sea(vessel=vessel, **SEA)
    return scene


def _lift(lid: float | None) -> Scene:
    scene = _two(lid)
    scene.add_crane(
        load_crane("lattice_boom_100t"), base="crane vessel", foot=(0.0, 6.0, 3.0),
        coordinates={"slew": -0.5 * np.pi, "boom": 1.176},
    )  # fmt: skip
    scene.add_ballast(vessel="crane vessel")
    scene.add_hoist(
        mass=MASS, size=SIZE, on="feeder", height=DECK, slack=1.0, EA=3e8, damping=False,
        feet={"points": FEET, "friction": 0.4, "name": "feet"},
        winch={"maximum_acceleration": 0.5, "lag": 0.2},
    )  # fmt: skip
    return scene


def _timed(name: str, scene: Scene, stages: Sequence[Stage]) -> list[object]:
    """Name, states of the memory, us of an evaluation, evaluations, times real time."""
    model = scene.compile()
    state = np.array(model.initial_state)
    evaluator = Evaluator(model, "recursive")
    took = min(evaluator.time_parts(0.0, state, COUNT)["whole evaluation"] for _ in range(REPEATS))

    def run() -> object:
        if stages:
            return simulate(scene, stages, dt_out=0.1, rtol=0.001, channels=["contact_least_gap"])
        return simulate(scene, T_END, dt_out=0.1, rtol=1e-3, channels=["vessel_motion"])

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        seconds, result = _fastest(run)
    stats = result.stats  # type: ignore[attr-defined]
    return [name, stats["memory_states"], 1e-3 * took, stats["evaluations"], stats["simulated_s"] / seconds]


def _fastest(run: Callable[[], object]) -> tuple[float, object]:
    fastest, result = np.inf, None
    for _ in range(REPEATS):
        began = time.thread_time()
        result = run()
        fastest = min(fastest, time.thread_time() - began)
    return float(fastest), result


SECTION = Section(
    title="Two vessels in one water",
    text=(
        f"Runs of ten minutes in a sea of 200 components (Hs {SEA['hs']:g} m, Tp {SEA['tp']:g} s), rtol "
        "1e-3, recursive form. The feeder lift has a crane, a load of 60 t on four feet with friction, an "
        f"elastic wire with a winch, stages and outputs every 0.1 s. Best of {REPEATS}."
    ),
    head=["scene", "states of the memory", "evaluation [us]", "evaluations", "times real time",
          "evaluation over one vessel's"],
    rows=feeder,
    sources=(*CRANE, *LINE, "cpp/seacrane/elements/loads/contact*", "cpp/seacrane/elements/loads/winch.hpp",
             "python/seacrane/data/*"),
)  # fmt: skip
