"""What ordinary lifts cost, alone and side by side."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterator
from typing import Any

from seacrane import Curve, Run, Scene, Stage, cases, ensemble, shipped_database
from seacrane.crane import Payload
from seacrane.run.lanes import USUAL, advance_side_by_side, module_of
from seacrane.scene import Piston, Pump, Relief, Valve

from .section import Section
from .sources import CRANE, LANES, LINE
from .timing import best_seconds, evaluation_ns

END = 100.0  # s
RTOL = 1e-3
MEMBERS, REPEATS = 8, 3
HOOK = {"hook": "hook_load.max"}
OIL = {
    "pump": Pump(pressure=32e6, makeup_flow=0.05), "relief": Relief(pressure=35e6, flow=0.05),
    "valve": Valve(rated_flow=0.03, rated_drop=1e6, spool_lag=0.03), "piston": Piston(viscous_friction=2e6),
}  # fmt: skip


def _ship(seed: int, **crane: Any) -> Scene:
    scene = Scene(name="ordinary lift")
    scene.add_vessel(shipped_database())
    scene.add_crane(slew=-1.2, s1=1.4, s2=1.0, **crane)
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=150.0, seed=seed)
    return scene


def on_a_wire(seed: int, rung: str = "elastic", **crane: Any) -> Scene:
    """Shipped hull and crane, 60 t on the wire of a winch, air on the load."""
    scene = _ship(seed, **crane)
    scene.add_hoist(
        mass=60e3, size=(4.0, 4.0, 4.0), length=14.0, EA=4e8, rung=rung,
        winch={"lag": 0.3, "maximum_rate": 1.0},
    )  # fmt: skip
    return scene


def compensated(seed: int) -> Scene:
    """The same with active heave compensation of its winch."""
    scene = on_a_wire(seed)
    scene.add_heave_compensation("ahc", body="vessel", point=(10.0, 15.0, 20.0), winch="hoist", lag=0.1)
    return scene


def driven(seed: int, rung: str = "elastic") -> Scene:
    """The same on a crane that drivers move in all its joints."""
    scene = on_a_wire(seed, rung, held=False)
    for joint, way in (("A", 0.7), ("main_cylinder", 0.4), ("knuckle_cylinder", -0.3)):
        curve = Curve.quintic(start_time=5.0, end_time=0.9 * END, start=0.0, end=way)
        scene.add_driver(joint, curve=curve)
    return scene


def in_oil(seed: int) -> Scene:
    """A load on the crane's rod, both cylinders in closed valves' oil."""
    return _ship(seed, payload=Payload(mass=40e3), held=True, hydraulics={"main": OIL, "knuckle": OIL})


LIFTS: dict[str, Callable[[int], Scene]] = {
    "elastic wire": on_a_wire,
    "quasi-static wire": lambda seed: on_a_wire(seed, "quasi-static"),
    "elastic wire, compensated": compensated,
    "elastic wire, crane driven": driven,
    "quasi-static wire, crane driven": lambda seed: driven(seed, "quasi-static"),
    "oil in both cylinders": in_oil,
    "case 2": lambda seed: cases.case2(seed=seed),
}
STAGES = [Stage(name="wait", duration=0.4 * END), Stage(name="go on", duration=0.6 * END)]


def lifts() -> Iterator[list[Any]]:
    """Cost of a lift by its parts, and members a second alone and in lanes."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name, make in LIFTS.items():
            yield _row(name, make, [])
        yield _row("elastic wire, in two stages", on_a_wire, STAGES)


def _row(name: str, make: Callable[[int], Scene], stages: list[Stage]) -> list[Any]:
    scenes = [make(seed) for seed in range(1, USUAL + 1)]
    alone = _loop(scenes[:1])
    together = None if module_of(USUAL) is None else _loop(scenes) / USUAL
    run = _begun(scenes[0])
    run.advance(END)
    told = run.result().stats
    formulation = str(told["formulation"])
    cost = evaluation_ns(scenes[0].compile(), repeats=REPEATS, count=1000, formulation=formulation)
    rates = [_members(scenes[0], stages, lanes) for lanes in (1, None)]
    return [
        name, formulation, told["evaluations"], cost, 1e3 * alone,
        None if together is None else 1e3 * together, rates[0], rates[1], _kept_apart(scenes),
    ]  # fmt: skip


def _begun(scene: Scene) -> Run:
    return Run(scene, END, rtol=RTOL, dt_out=2.0, channels=["hook_load"])


def _stepped(runs: list[Run]) -> list[Run]:
    if len(runs) > 1:
        advance_side_by_side(runs, USUAL, lambda _: None)
    for run in runs:
        run.advance(END)
    return runs


def _loop(scenes: list[Scene]) -> float:
    """CPU seconds of all runs, without what prepares them."""
    begun = [[_begun(scene) for scene in scenes] for _ in range(REPEATS)]
    return best_seconds(lambda: _stepped(begun.pop()), repeats=REPEATS)


def _kept_apart(scenes: list[Scene]) -> str:
    runs = _stepped([_begun(scene) for scene in scenes])
    return str(next((run.lanes["kept_apart"] for run in runs if "kept_apart" in run.lanes), ""))


def _members(scene: Scene, stages: list[Stage], lanes: int | None) -> float:
    """Members a second of the whole call."""
    given: dict[str, Any] = {"stages": stages} if stages else {"t_end": END}

    def call() -> None:
        ensemble(
            scene,
            over={"seed": range(1, MEMBERS + 1)},
            keep=HOOK,
            lanes=lanes,
            rtol=RTOL,
            dt_out=2.0,
            **given,
        )

    begun = time.process_time()
    call()
    first = time.process_time() - begun
    return MEMBERS / min(first, best_seconds(call, repeats=max(1, REPEATS - 1)))


SECTION = Section(
    title="Ordinary lifts",
    text=(
        "Shipped hull and crane in Hs 1.5 m, 60 t on a winch's wire with air drag (40 t on the rod where "
        f"oil is in the cylinders). {END:g} s, default method at rtol {RTOL:g}, hook load every 2 s. The "
        "loop is of one run alone, and for one of four side by side in vector lanes. Members a second are "
        f"of the whole call of `ensemble` with {MEMBERS} seeds on one thread, without lanes and with. CPU "
        f"time, best of {REPEATS}."
    ),
    head=["lift", "formulation", "evaluations", "ns an evaluation", "loop alone, ms", "loop in lanes, ms",
          "members a second alone", "in lanes", "kept apart"],
    rows=lifts,
    sources=(*CRANE, *LANES, *LINE, "cpp/seacrane/elements/loads"),
)  # fmt: skip
