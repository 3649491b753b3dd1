"""What hangs on lines and winches counts where luffing ropes and hydraulic cylinders start."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from seacrane import Scene, SceneError, simulate
from seacrane.crane import Payload, load_crane

G, LOAD = 9.80665, 40e3  # m/s2, kg
OIL: dict[str, Any] = {
    "pump_pressure": 32e6, "rated_flow": 0.05, "rated_drop": 1e6, "spool_lag": 0.03, "gain": 0.8,
    "viscous_friction": 2e6,
}  # fmt: skip


def hung(
    scene: Scene, tip: tuple[str, Any], *, below: float = 12.0, drum: tuple[str, Any] | None = None
) -> None:
    """A load at rest on a hoist from the tip; with a drum its rope runs on to there."""
    place = scene.place_of(body=tip[0], point=tip[1])
    inertia = (LOAD, LOAD, LOAD)
    scene.add_body(name="load", mass=LOAD, inertia=inertia, position=place - (0.0, 0.0, below))
    path = [tip, ("load", (0.0, 0.0, 0.0))] if drum is None else [drum, tip, ("load", (0.0, 0.0, 0.0))]
    scene.add_line(
        name="hoist", bodies=[body for body, _ in path], points=[point for _, point in path], EA=3e8,
        tension_at_start=LOAD * scene.gravity,
    )  # fmt: skip
    scene.add_winch(line="hoist")


def lattice(*, drum: bool = False, link: bool = False) -> Scene:
    scene = Scene(name="lattice")
    load = Payload(mass=LOAD, size=(3.0, 3.0, 3.0)) if link else None
    scene.add_crane(
        load_crane("lattice_boom_100t"), base="ground", foot=(0, 0, 0), coordinates={"boom": 0.9}, held=True,
        payload=load, damping=False,
    )  # fmt: skip
    if not link:
        hung(scene, ("boom", (-48.0, 0.0, 0.0)), drum=("house", (4.0, 0.0, 2.0)) if drum else None)
    return scene


def at_start(scene: Scene) -> float:
    return float(simulate(scene, 0.1, dt_out=0.1).select("line_tension", line="luffing rope")[0])


def test_a_load_on_a_hoist_pulls_at_the_luffing_rope_and_one_that_runs_to_the_house_relieves_it() -> None:
    """By its tension times the lever arm of its upper part about the hinge, over falls and their arm."""
    plain, over, linked = lattice(), lattice(drum=True), lattice(link=True)
    for scene in (plain, over, linked):
        scene.add_luffing_rope()
    assert at_start(plain) == pytest.approx(at_start(linked), rel=1e-7)
    head = 48.0 * np.array([-math.cos(0.9), math.sin(0.9)])
    mast = np.array([8.0, 13.0])
    drum = np.asarray(over.place_of(body="house", point=(4.0, 0.0, 2.0)))[[0, 2]] - (-2.0, 15.0)

    def arm(to: Any) -> float:
        pull = (to - head) / np.linalg.norm(to - head)
        return abs(float(head[0] * pull[1] - head[1] * pull[0]))

    relieved = LOAD * G * arm(drum) / arm(mast) / 12.0
    assert at_start(plain) - at_start(over) == pytest.approx(relieved, rel=1e-7)
    for scene, within in ((plain, 1e-5), (over, 1e-4)):
        assert np.ptp(simulate(scene, 3.0, dt_out=0.5).select("position", body="load", axis="z")) < within


POSE = {"slew": -1.0, "s1": 2.0, "s2": 3.0}


def knuckle(payload: Payload | None = None) -> Scene:
    scene = Scene(name="oil")
    oil = {"main": OIL, "knuckle": OIL}
    scene.add_crane(base="ground", payload=payload, damping=False, hydraulics=oil, held=True, **POSE)
    return scene


def test_pressures_hold_a_load_that_hangs_on_a_winch() -> None:
    linked, hoisted = knuckle(Payload(mass=LOAD)), knuckle()
    tip = hoisted.roles[""].tip
    hung(hoisted, tip)
    empty = hoisted.loads["main_cylinder"].pressure
    found = hoisted.hold_pressures()
    for name, ram in found.items():
        assert ram.pressure == pytest.approx(linked.loads[name].pressure, rel=1e-9)
        assert hoisted.loads[name] == ram
    assert found["main_cylinder"].pressure > empty + 1e5
    result = simulate(hoisted, 2.0, dt_out=0.5, rtol=1e-7)
    assert np.ptp(result["hydraulic_stroke"], axis=0) == pytest.approx(0.0, abs=1e-6)
    scene = knuckle()
    scene.add_body(name="load", mass=LOAD, inertia=(LOAD, LOAD, LOAD), position=(0, 0, 50))
    with pytest.raises(SceneError, match=r"body 'load' accelerates by 9.81"):
        scene.hold_pressures()
    with pytest.raises(SceneError, match="no hydraulic cylinder"):
        lattice().hold_pressures()
