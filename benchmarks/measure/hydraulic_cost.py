"""What hydraulic cylinders cost: case 2 on oil over case 2 on ideal actuators."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import Scene, cases
from seacrane.accuracy.case import Case, timed
from seacrane.crane import load_crane
from seacrane.run.method import Method
from seacrane.scene import Accumulator, Piston, Pump, Valve

from .section import Section
from .sources import CRANE

Array = NDArray[np.float64]
T_END, DT_OUT = 100.0, 0.2  # s
OIL: dict[str, Any] = {"pump": Pump(pressure=32e6), "piston": Piston(viscous_friction=2e6)}
GAS = {"accumulator": Accumulator(volume=0.05, pressure=2e6, flow=0.004)}
LAGS = (0.05, 1.0 / (2.0 * math.pi * 35.0), 0.0)  # s: a pilot-operated valve, a small servo valve, none
TIGHT = Method(integrator="dopri5", rtol=1e-7)
IDEAL = Method(integrator="dopri5", rtol=1e-2)
REPEATS = 2
LENGTHS = {"main": 8.5, "knuckle": 6.8}  # m, of the retracted cylinders
METHODS = (
    Method(integrator="dopri5", rtol=1e-2),
    Method(integrator="dopri5", rtol=1e-3),
    Method(integrator="dopri5-stiff", rtol=3e-3),
    Method(integrator="dopri5-stiff", rtol=1e-3),
    Method(integrator="bs32", rtol=1e-2),
    Method(integrator="tsit5", rtol=1e-3),
    Method(integrator="cvode-bdf", rtol=1e-4),
)


def hydraulic_case2(*, spool_lag: float, gas: bool) -> Scene:
    """Case 2 with both cylinders on oil; with accumulators it has six pressures."""
    scene, crane = cases.case2(), load_crane()
    references = {name: scene.actuators[name].reference for name in ("main", "knuckle")}
    for name in references:
        scene.remove(name)
    for name, reference in references.items():
        barrel, rod = (crane.body(f"{name}_{part}").members[0] for part in ("barrel", "rod"))
        full = math.pi / 4.0 * barrel.inner_diameter**2
        scene.add_hydraulic_cylinder(
            name=name, first=f"{name}_barrel", second=f"{name}_rod", full_area=full,
            rod_side_area=full - math.pi / 4.0 * rod.outer_diameter**2,
            retracted_length=LENGTHS[name], stroke=5.0, reference=reference,
            valve=Valve(rated_flow=0.05, rated_drop=1e6, gain=0.8, rate_gain=2.0, spool_lag=spool_lag),
            **OIL | (GAS if gas else {}),
        )  # fmt: skip
    return scene


def hydraulic_cost() -> Iterator[list[Any]]:
    """Cost and error of methods on both kinds of spool; the ideal actuators run again beside every row."""
    ideal, first = _run(cases.case2(), IDEAL, REPEATS)
    own_error, least = _apart(ideal, _path(cases.case2())), first[1]
    done: list[tuple[str, str, Method, tuple[int, float], float]] = []
    for lag in LAGS:
        for gas in (True, False):
            scene = hydraulic_case2(spool_lag=lag, gas=gas)
            truth = _path(scene)
            for method in METHODS:
                path, cost = _run(scene, method, REPEATS)
                pressures = f"{6 if gas else 4} pressures, 2 spools"
                done.append((pressures, f"{1e3 * lag:.1f}", method, cost, _apart(path, truth)))
                least = min(least, _run(cases.case2(), IDEAL, REPEATS)[1][1])
    for cylinders, lag_ms, method, cost, error in [("ideal actuators", "", IDEAL, first, own_error), *done]:
        cpu = least if method is IDEAL and not lag_ms else cost[1]
        yield [
            cylinders, lag_ms, f"{method.integrator} {method.rtol:g}", cost[0], cost[0] / first[0], 1e3 * cpu,
            cpu / least, T_END / cpu, error,
        ]  # fmt: skip


def _apart(path: Array, truth: Array) -> float:
    """Largest distance, mm."""
    return 1e3 * float(np.linalg.norm(path - truth, axis=1).max())


def _run(scene: Scene, method: Method, repeats: int) -> tuple[Array, tuple[int, float]]:
    case = Case(scene=scene, t_end=T_END, dt_out=DT_OUT)
    done = timed(case, method, ["position"], repeats=repeats)
    place = done.result()["position"][:, list(scene.bodies).index("payload")]
    return place, (int(done.stats["evaluations"]), float(done.cpu_s))


def _path(scene: Scene) -> Array:
    return _run(scene, TIGHT, 1)[0]


SECTION = Section(
    title="Hydraulic cylinders",
    text=(
        f"{T_END:g} s of case 2, its main and knuckle cylinder on oil with two chambers and a spool each, "
        "and an accumulator each for six pressures. Errors are those of the payload's place against the "
        f"same scene with a spool of that lag solved tightly (`{TIGHT.integrator}`, {TIGHT.rtol:g}); CPU "
        "times are those of the loop, the least of some runs. The ideal actuators are run again beside "
        "every other row, and their least time is what all are compared with."
    ),
    head=["cylinders", "spool lag, ms", "method", "evaluations", "over ideal", "CPU, ms", "CPU over ideal",
          "times real time", "payload error, mm"],
    rows=hydraulic_cost,
    sources=(*CRANE, "cpp/seacrane/elements/loads/hydraulic*"),
)  # fmt: skip
