"""Water that is described twice and not alike, parts without volume, and lines that slam shakes."""

from __future__ import annotations

from contextlib import nullcontext
from typing import Any

import numpy as np
import pytest

from seacrane import Curve, Scene, SceneError, shipped_database, simulate
from seacrane.sea import SeaState, WaveSystem, jonswap
from seacrane.warnings import LineRungWarning
from seacrane.water import BoxPart, PlatePart, TablePart

G = 9.80665


def test_what_a_hull_that_floats_displaces_is_not_counted_twice() -> None:
    """Parts without volume, and in the air, are taken."""
    scene = Scene(name="afloat", gravity=G)
    scene.add_vessel(shipped_database())
    scene.add_immersed("vessel", parts=[BoxPart(size=(40.0, 0.4, 0.4), fill=0.0)], name="bilge keel")
    scene.add_immersed("vessel", parts=[BoxPart(size=(4.0, 4.0, 2.0), point=(0.0, 0.0, 12.0))], name="hut")
    heave = simulate(scene, 5.0, dt_out=1.0).select("position", body="vessel", axis="z")
    assert np.abs(heave - heave[0]).max() < 1e-6
    scene.add_immersed("vessel", parts=[PlatePart(size=(9.0, 1.0), thickness=0.1)], name="bottom")
    with pytest.raises(SceneError, match=r"'bottom\.1': displaces .* m3 as a part of 'vessel'.*volume"):
        scene.compile()


@pytest.mark.parametrize(
    ("bed", "depth", "tp", "told"),
    [
        (14.0, np.inf, 8.0, "'bed': lies 14 m.*infinite depth"), (80.0, 14.0, 8.0, "lies 80 m.*14 m deep"),
        (40.0, np.inf, 16.0, "wavenumbers differ by"), (14.0, 14.0, 8.0, ""), (14.0, np.inf, 5.0, ""),
    ],
)  # fmt: skip
def test_a_seabed_has_the_depth_of_the_sea(bed: float, depth: float, tp: float, told: str) -> None:
    scene = Scene(name="landed", gravity=G)
    scene.add_body("load", mass=1e4, inertia=(1e4,) * 3, position=(0.0, 0.0, -bed + 3.0))
    scene.add_contact("load", on="ground", points=[(0.0, 0.0, 0.0)], place=(0.0, 0.0, -bed), name="bed")
    wind = WaveSystem(spectrum=jonswap(hs=1.5, tp=tp), direction_deg=0.0)
    scene.add_sea(sea=SeaState(systems=[wind], depth=depth), vessel=None)
    with pytest.raises(SceneError, match=told) if told else nullcontext():
        scene.compile()


def frame(height: float = 1.0) -> TablePart:
    given: dict[str, Any] = {"depths": [0, 1, 2], "volumes": [0, 0, 0], "drag_area": (1, 1, 1)}
    rows = [[0.0] * 3, [1e3] * 3, [1e3] * 3]
    return TablePart(height=height, added_masses=rows, source="mine", **given)


@pytest.mark.parametrize("formulation", ["recursive", "redundant"])
def test_a_table_without_volume_keeps_its_drag_and_its_ledger(formulation: str) -> None:
    scene = Scene(name="frame", gravity=G)
    scene.add_body("load", mass=1e3, inertia=(1e3,) * 3, position=(0.0, 0.0, 2.0))
    scene.add_immersed("load", parts=[frame()])
    run = simulate(scene, 20.0, dt_out=0.1, formulation=formulation, integrator="dop853", rtol=1e-9)
    assert -run["velocity"][-1, 0, 2] == pytest.approx(np.sqrt(1e3 * G / (0.5 * 1025.0)), rel=1e-6)
    assert np.abs(run["energy_balance"]).max() < 1e-6 * run["absolute_work"].max()


def test_its_drag_is_that_of_the_height_that_is_wet() -> None:
    pulls = []
    for depth in (1.0, 2.0, 4.0, 9.0):
        scene = Scene(name="towed", gravity=G)
        scene.add_body(
            "load", mass=1e3, inertia=(1e3,) * 3, position=(0.0, 0.0, 2.0 - depth), velocity=(3.0, 0.0, 0.0)
        )
        scene.add_immersed("load", parts=[frame(4.0)])
        force = simulate(scene, 0.01, dt_out=0.01, channels=["load_force"])["load_force"][0].reshape(3)
        pulls.append(-force[0] / (0.5 * 1025.0 * 9.0))
    share = np.array([0.25, 0.5, 1.0, 1.0])  # with a rounded end
    assert pulls == pytest.approx(share + share**2 - share**3, rel=1e-6)


def lowered(start: float, *, side: float = 9.0) -> Scene:
    scene, mass = Scene(name="mudmat", gravity=G), 30e3
    scene.add_body("load", mass=mass, size=(6, 4, 2), position=(0, 0, start))
    lifted = 1025.0 * side**2 * 0.1 if start < 0.0 else 0.0
    scene.add_line(
        "w", first="ground", first_point=(0, 0, start + 31.0), second="load", EA=4e8, rung="auto",
        tension_at_start=(mass - lifted) * G,
    )  # fmt: skip
    scene.add_winch("w", rate=Curve.quintic(start_time=1.0, end_time=4.0, start=0.0, end=0.5), lag=0.3)
    scene.add_immersed("load", parts=[PlatePart(size=(side, side), thickness=0.1)])
    return scene


def test_what_may_be_struck_by_the_water_hangs_on_elastic_lines() -> None:
    told = simulate(lowered(2.0), 3.0).stats["line_rungs"]
    assert told.startswith("w: elastic: immersed part 'load.1' is not under water, and slam is faster than")
    assert simulate(lowered(-20.0), 3.0).stats["line_rungs"].startswith("w: quasi-static")


def test_what_came_out_and_was_struck_again_is_run_again_with_elastic_lines() -> None:
    scene = lowered(-0.5, side=1.0)
    down = Curve.quintic(start_time=5.0, end_time=8.0, start=-0.5, end=0.5)
    up = Curve.quintic(start_time=1.0, end_time=3.0, start=0.0, end=-0.5)
    scene.replace("w", rate=up.then(time=5.0, curve=down))
    with pytest.warns(LineRungWarning, match=r"part 'load\.1': slam is fast, and it met water at t = \d+"):
        run = simulate(scene, 12.0, dt_out=0.1)
    assert run.stats["line_rungs"].startswith("w: elastic: a first run was not")
    assert run["position"][:, 0, 2].max() > 0.1, "it was out"


def test_the_seabed_of_a_chain_counts_too() -> None:
    scene = Scene(name="chain", gravity=G)
    scene.add_body("buoy", mass=1e4, inertia=(1e4,) * 3)
    line: dict[str, Any] = {"EA": 1e7, "length": 45.0, "mass_per_length": 40.0, "segments": 4}
    line["seabed"] = {"depth": 14.0, "stiffness": 1e5, "friction": 0.0}
    ends: dict[str, Any] = {"first": "ground", "first_point": (40.0, 0.0, -14.0), "second": "buoy"}
    scene.add_line("chain", rung="with mass", **ends, **line)
    scene.add_sea(vessel=None, hs=1.5, tp=8.0)
    with pytest.raises(SceneError, match=r"seabed of 'chain.*14 m"):
        scene.compile()
