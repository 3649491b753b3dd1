"""A crane that gives: stiffness at the hook in series, snaps that follow it, at rest as described."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from seacrane import Lift, Scene, SceneError, Stage, equilibrium, simulate, simulate_stages, statics
from seacrane.crane import load_crane
from seacrane.crane.builder import FOOT, KnuckleBoomCrane
from seacrane.crane.structure import leaning
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


def test_n_falls_and_slings_count_and_a_ship_does_not() -> None:
    """n falls of a rope: n^2 EA / l0 at the hook; the block is the hook, and a floating ship is held."""
    from seacrane import shipped_database

    told = []
    for base in ("ground", "vessel"):
        scene = Scene()
        if base == "vessel":
            scene.add_vessel(shipped_database(), memory="none")
        scene.add_crane(base=base, s1=1.5, s2=1.0)
        scene.add_hoist(mass=20e3, size=(4, 4, 3), length=10.0, EA=EA, falls=2, block_mass=1e3,
                        slings={"angle_deg": 60, "EA": 5e7})  # fmt: skip
        told.append(statics(scene))
    for one in told:
        rope = float(one["line unstretched length hoist"])
        assert one["hook stiffness"] == pytest.approx(4.0 * EA / rope, rel=1e-6)


def test_a_rod_and_a_rigid_wire_are_as_stiff_as_the_crane() -> None:
    assert statics(hung(None, rung="rigid", EA=None))["hook stiffness"] == np.inf
    assert statics(hung(rung="rigid", EA=None))["hook stiffness"] == pytest.approx(STIFFNESS, rel=0.02)


def test_a_slack_line_has_no_stiffness_to_tell() -> None:
    scene = Scene()
    scene.add_crane(base="ground", s1=1.5, s2=1.0)
    scene.add_hoist(mass=20e3, size=(4, 4, 3), EA=EA, on="ground", slack=0.3)
    told = statics(scene)
    assert np.isnan(told["hook stiffness"])
    assert str(told).split("hook stiffness")[1].split()[:2] == ["-", "mm/kN"]


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


def two_masses(line: float, tip: float) -> float:
    """The same by two masses and two springs: the crane's own mass at its tip, and the load, which stands."""
    crane = KnuckleBoomCrane.load()
    _, lean = leaning(crane.parts(foot=FOOT, slew=0.0, s1=1.5, s2=1.0))
    damper = 0.02 * 2.0 * np.sqrt(line * MASS)

    def rates(t: float, y: Any) -> list[float]:
        sag, down, lift, up = y  # of the tip, and of the load over its deck
        pull = max(0.0, line * (RATE * t - sag - lift) + damper * (RATE - down - up))
        rise = max(pull / MASS - G, 0.0) if lift <= 0.0 else pull / MASS - G
        return [down, (pull - tip * sag - lean.damping(tip) * down) / lean.inertia, up, rise]

    solved = solve_ivp(rates, (0.0, 6.0), [0.0] * 4, max_step=0.002)
    sag, down, lift, up = solved.y
    return float(np.max(line * (RATE * solved.t - sag - lift) + damper * (RATE - down - up)))


@pytest.mark.parametrize("stiffness", [None, STIFFNESS])
def test_a_snap_follows_the_combined_stiffness(stiffness: float | None) -> None:
    """W + v sqrt(k m), to the dampers and the crane's own mass; by two masses and springs closer."""
    peak, line = snap(stiffness)
    series = line if stiffness is None else 1.0 / (1.0 / line + 1.0 / stiffness)
    assert peak == pytest.approx(MASS * G + RATE * np.sqrt(series * MASS), rel=0.02)
    if stiffness is not None:
        assert peak == pytest.approx(two_masses(line, stiffness), rel=0.005)


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


def test_radii_are_those_of_the_crane_upright() -> None:
    told = statics(hung(), radius=[24.0, 22.0])
    assert told["tip radius"] == pytest.approx([24.0, 22.0], abs=0.1)


def test_lift_files_have_it_and_nonsense_is_refused() -> None:
    text = {
        "format": "seacrane lift", "version": 2, "scene": {"name": "gives"},
        "crane": [{"base": "ground", "s1_m": 1.5, "s2_m": 1.0, "stiffness_N_per_m": 4e6}],
        "hoist": [{"mass_kg": 20e3, "size_m": [4, 4, 3], "length_m": 10, "EA_N": 3e7}],
    }  # fmt: skip
    assert Lift(text).scene() == hung()
    with pytest.raises(SceneError, match=r"stiffness is 0.0 N/m; give a finite number above zero"):
        hung(0.0)
