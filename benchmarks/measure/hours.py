"""What loose tolerances make of a load that hangs nearly still for three hours."""

from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np

from seacrane import Scene, simulate
from seacrane.crane import Payload
from seacrane.hydro import shipped_database
from seacrane.warnings import GrowingModeWarning

from .section import Section

HOUR, SETTLED = 3600.0, 600.0  # s
HOURS = 3
SETTINGS: list[dict[str, Any]] = [
    {"integrator": "dop853", "rtol": 1e-9},
    {"integrator": "tsit5", "rtol": 1e-2},
    {"integrator": "tsit5", "rtol": 1e-3},
    {"integrator": "tsit5", "rtol": 1e-4},
    {"integrator": "dopri5", "rtol": 1e-2},
    {"integrator": "dopri5", "rtol": 1e-3},
    {"integrator": "dopri5", "rtol": 1e-4},
    {"integrator": "dopri5", "rtol": 1e-6},
    {"integrator": "verner65", "rtol": 1e-2},
    {"integrator": "rk4", "dt": 0.1},
]


def hours() -> Section:
    """Standard deviation of the hook load by hour, by several settings."""
    scenes = {"yes": _scene(damping=True), "no": _scene(damping=False)}
    rows = [_row(scene, damped, setting) for damped, scene in scenes.items() for setting in SETTINGS]
    return Section(
        title="Hook load of three hours",
        text=(
            "The scene of `examples/jobs/three_hours.py`, its memory per pair: 50 t below the crane in head "
            "waves, with the small damping of loads and without. Standard deviation of the hook load, kN, "
            f"hour by hour from {SETTLED:g} s on. Growth is what `GrowingModeWarning` tells of a mode's "
            "amplitude, each hour; nothing where it does not warn, or warns of ringing alone."
        ),
        head=["integrator", "rtol or dt", "damping", "steps", "mean step, s",
              *(f"hour {i + 1}, kN" for i in range(HOURS)), "energy error over work", "growth an hour"],
        rows=rows,
    )  # fmt: skip


def _scene(*, damping: bool) -> Scene:
    scene, ship = Scene(name="three hours"), shipped_database()
    scene.add_vessel(ship, memory="per-pair")
    scene.add_crane(
        slew=-np.pi / 2, s1=1.0, s2=2.0, payload=Payload(mass=50e3, link_length=25.0), held=True,
        damping=damping,
    )  # fmt: skip
    scene.add_ballast()
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=180.0, count=300)
    return scene


def _row(scene: Scene, damped: str, setting: dict[str, Any]) -> list[Any]:
    t_end = SETTLED + HOURS * HOUR
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = simulate(scene, t_end=t_end, dt_out=0.5, **setting)
    told = [str(one.message) for one in caught if issubclass(one.category, GrowingModeWarning)]
    growth = re.search(r"factor of (\S+) an hour", told[0]) if told else None
    load = result["link_tension"] / 1e3
    hour = np.floor((result.time - SETTLED) / HOUR)
    integrator, tolerance = setting.values()
    steps = int(result.stats["steps"])
    return [
        integrator,
        tolerance,
        damped,
        steps,
        t_end / steps,
        *(float(load[hour == i].std()) for i in range(HOURS)),
        float(np.abs(result["energy_balance"]).max() / result["absolute_work"][-1]),
        float(growth[1]) if growth else None,
    ]
