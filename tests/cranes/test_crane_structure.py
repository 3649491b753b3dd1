"""A crane that gives: stiffness at the hook in series, snaps that follow it, at rest as described."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Scene, Stage, equilibrium, simulate, simulate_stages, statics
from seacrane.crane import load_crane
from seacrane.warnings import LineLengthWarning

G = 9.80665
STIFFNESS, EA, MASS, RATE = 4e6, 3e7, 200e3, 0.3


def hung(stiffness: float | None = STIFFNESS, **given: Any) -> Scene:
    scene = Scene(name="gives")
    scene.add_crane(base="ground", s1=1.5, s2=1.0, stiffness=stiffness)
    scene.add_hoist(**{"mass": 20e3, "size": (4, 4, 3), "length": 10.0, "EA": EA} | given)
    return scene


@pytest.mark.parametrize("rung", ["elastic", "quasi-static", "auto"])
@pytest.mark.parametrize("stiffness", [None, STIFFNESS])
def test_hook_stiffness_is_that_of_rope_and_crane_in_series(rung: str, stiffness: float | None) -> None:
    """1/k = 1/k_tip + l0/EA. The crane's own weight above its hinge takes a little off k_tip."""
    scene = hung(stiffness, rung=rung)
    told = statics(scene)
    line = EA / float(told["line unstretched length hoist"])
    series = line if stiffness is None else 1.0 / (1.0 / line + 1.0 / stiffness)
    assert told["hook stiffness"] == pytest.approx(series, rel=1e-6 if stiffness is None else 0.01)
    assert f"{1e6 / told['hook stiffness']:.4g}  mm/kN" in str(told)


def test_a_rod_and_a_rigid_wire_are_as_stiff_as_the_crane() -> None:
    assert statics(hung(None, rung="rigid", EA=None))["hook stiffness"] == np.inf
    assert statics(hung(rung="rigid", EA=None))["hook stiffness"] == pytest.approx(STIFFNESS, rel=0.02)


def test_a_heavier_load_sags_by_what_the_stiffness_tells() -> None:
    """Two rest states of their own against the slope at one: 1 t more sags by dW / k."""
    heights = []
    for mass in (20e3, 21e3):
        scene = hung()
        scene.replace("load", mass=mass)
        heights.append(simulate(scene, 0.1, start=equilibrium(scene)).curve("position[load, z]")[0])
    assert heights[0] - heights[1] == pytest.approx(1e3 * G / statics(hung())["hook stiffness"], rel=2e-3)


def test_it_stands_as_described_under_its_weight_and_its_load() -> None:
    scene = hung()
    whole = hung(None)
    assert np.ptp(simulate(scene, 5.0).curve("position[load, z]")) < 1e-4
    of_crane = [sum(b.mass for b in one.bodies.values()) for one in (scene, whole)]
    assert of_crane[0] == pytest.approx(of_crane[1], rel=1e-12)
    rod = Scene()
    rod.add_crane(base="ground", s1=1.5, s2=1.0, payload_mass=20e3, stiffness=STIFFNESS)
    assert np.ptp(simulate(rod, 5.0).curve("position[payload, z]")) < 1e-4


def snap(stiffness: float | None) -> tuple[float, float]:
    """Largest tension of a load snatched off the ground at a constant rate, N; and the line's EA / l0."""
    scene = Scene()
    scene.add_crane(base="ground", s1=1.5, s2=1.0, stiffness=stiffness)
    scene.add_hoist(
        mass=MASS, size=(6, 6, 4), EA=1e8, on="ground", slack=0.3, winch={"lag": 0.0}, damping=False
    )
    lift = Stage(name="lift", duration=8.0, commands={"hoist.rate": -RATE})
    with pytest.warns(LineLengthWarning):
        result = simulate_stages(scene, [lift], dt_out=0.005)
    length = float(scene.loads["hoist"].length.evaluate([0.0])[0, 0]) - 0.3
    return float(result.curve("line_tension[hoist]").max()), 1e8 / length


@pytest.mark.parametrize("stiffness", [None, STIFFNESS])
def test_a_snap_follows_the_combined_stiffness(stiffness: float | None) -> None:
    """W + v sqrt(k m), to the dampers and the crane's own mass; by two masses and springs closer."""
    peak, line = snap(stiffness)
    series = line if stiffness is None else 1.0 / (1.0 / line + 1.0 / stiffness)
    assert peak == pytest.approx(MASS * G + RATE * np.sqrt(series * MASS), rel=0.02)


@pytest.mark.parametrize("slew", [0.0, 1.2])
def test_it_leans_in_the_plane_of_its_jib(slew: float) -> None:
    """The hinge is across the jib at any slew angle, so that a sag moves the tip along its radius alone."""
    scene = Scene()
    roles = scene.add_crane(base="ground", slew=slew, s1=1.5, s2=1.0, stiffness=STIFFNESS, payload_mass=20e3)
    joint = scene.joints[str(roles.structure)]
    foot = scene.bodies[joint.first]
    assert foot.mass < 0.01 * scene.bodies[joint.second].mass
    for mass in (20e3, 200e3):
        scene.replace("payload", mass=mass)
        told = statics(scene)
        if mass == 20e3:
            before = told
    sag = float(before["tip height"] - told["tip height"])
    assert sag == pytest.approx(180e3 * G / STIFFNESS, rel=0.05), "200 t far above the hinge push it on"
    assert told["slew torque"] == pytest.approx(0.0, abs=1.0)


def test_a_crane_of_joints_gives_too(tmp_path: Path) -> None:
    scene = Scene()
    scene.add_crane(load_crane("lattice_boom_100t"), base="ground", payload_mass=20e3, stiffness=STIFFNESS)
    assert np.ptp(simulate(scene, 3.0).curve("position[payload, z]")) < 1e-3
    assert statics(scene)["hook stiffness"] == pytest.approx(STIFFNESS, rel=0.05)
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json") == scene
