"""Cranes: one that gives, stiffness at the hook in series, snaps; two in one scene, roles of parts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from named import on_joint

from seacrane import (
    Curve,
    Result,
    Scene,
    SceneError,
    Stage,
    balance,
    cases,
    equilibrium,
    shipped_database,
    simulate,
    statics,
)
from seacrane.crane import Payload, load_crane
from seacrane.warnings import LargeSwingWarning

G = 9.80665
STIFFNESS, EA = 4e6, 3e7


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


def test_n_falls_count_by_their_square_at_the_hook_and_a_floating_ship_is_held() -> None:
    """n^2 EA / l0; the block is the hook, and what hangs below it on slings counts for nothing."""
    scene = Scene()
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_crane(s1=1.5, s2=1.0)
    slings = {"angle_deg": 60, "EA": 5e7}
    scene.add_hoist(mass=20e3, size=(4, 4, 3), length=10.0, EA=EA, falls=2, block_mass=1e3, slings=slings)
    told = statics(scene)
    rope = float(told["line unstretched length hoist"])
    assert told["hook stiffness"] == pytest.approx(4.0 * EA / rope, rel=1e-6)


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


@pytest.mark.warns("LineLengthWarning")
@pytest.mark.parametrize("stiffness", [None, STIFFNESS])
def test_a_snap_follows_the_combined_stiffness(stiffness: float | None) -> None:
    """W + v sqrt(k m) of a load snatched off the ground, to the dampers and the crane's own mass."""
    mass, rate = 200e3, 0.3
    load = {"mass": mass, "size": (6, 6, 4), "EA": 1e8, "on": "ground", "length": None}
    scene = hung(stiffness, slack=0.3, winch={"lag": 0.0}, damping=False, **load)
    lift = Stage(name="lift", duration=8.0, commands={"hoist.rate": -rate})
    peak = simulate(scene, [lift], dt_out=0.005).curve("line_tension[hoist]").max()
    line = 1e8 / (float(scene.loads["hoist"].length.evaluate([0.0])[0, 0]) - 0.3)
    series = line if stiffness is None else 1.0 / (1.0 / line + 1.0 / stiffness)
    assert peak == pytest.approx(mass * G + rate * np.sqrt(series * mass), rel=0.02)


def test_it_stands_as_described_under_its_weight_and_its_load() -> None:
    scene = hung()
    whole = hung(None)
    assert np.ptp(simulate(scene, 5.0).curve("position[load, z]")) < 1e-4
    of_crane = [sum(b.mass for b in one.bodies.values()) for one in (scene, whole)]
    assert of_crane[0] == pytest.approx(of_crane[1], rel=1e-12)


def test_it_leans_in_the_plane_of_its_jib() -> None:
    """The hinge is across the jib at any slew angle, so that a sag moves the tip along its radius alone."""
    scene = Scene()
    roles = scene.add_crane(base="ground", slew=1.2, s1=1.5, s2=1.0, stiffness=STIFFNESS, payload_mass=20e3)
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


FEET = {"": (0.0, 0.0, 0.0), "aft ": (-60.0, 5.0, 0.0)}
PARTS = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}
ENDS = {"": (-0.6, 0.5, 0.3), "aft ": (0.4, 0.2, 0.6)}
LOADS = {"": 10e3, "aft ": 25e3}


def cranes(*prefixes: str) -> Scene:
    """Cranes on a fixed base, each with its own payload and its own swing-out."""
    scene = Scene(name="cranes")
    for prefix in prefixes:
        payload = Payload(mass=LOADS[prefix])
        scene.add_crane(base="ground", foot=FEET[prefix], payload=payload, prefix=prefix)
        for name, joint in PARTS.items():
            scene.add_channel(joint=prefix + joint)
            scene.add_actuator(name=prefix + name, joint=prefix + joint)
    loads = balance(scene).loads
    like = cases.case2(hs=0.0, memory="none").actuators
    for prefix in prefixes:
        for name, end in zip(PARTS, ENDS[prefix], strict=True):
            scene.replace(
                prefix + name, kind="actuator", stiffness=like[name].stiffness, damping=like[name].damping,
                feed_forward=loads[prefix + name],
                reference=Curve.quintic(start_time=0.0, end_time=4.0, start=0.0, end=end),
            )  # fmt: skip
    return scene


RUN: dict[str, Any] = {"t_end": 3.0, "integrator": "rk4", "dt": 0.02}


@pytest.fixture(scope="module")
def both() -> Result:
    with pytest.warns(LargeSwingWarning):
        return simulate(cranes("", "aft "), **RUN)


@pytest.mark.warns(sometimes=["LargeSwingWarning"])
@pytest.mark.parametrize("prefix", FEET)
def test_two_cranes_on_a_fixed_base_move_as_each_does_alone(both: Result, prefix: str) -> None:
    alone = simulate(cranes(prefix), **RUN)
    for body in alone.coords["body"]:
        one, other = (run.select("position", body=body) for run in (both, alone))
        np.testing.assert_allclose(one, other, atol=1e-9)
    for channel, dim, labels, scale in (
        ("stroke", "cylinder", ("main", "knuckle"), 1e-9),
        ("stroke_rate", "cylinder", ("main", "knuckle"), 1e-9),
        ("cylinder_force", "cylinder", ("main", "knuckle"), 1e-2), ("slew_angle", "slew", ("slew",), 1e-9),
        ("slew_torque", "slew", ("slew",), 1e-2), ("link_tension", "hook", ("hook",), 1e-3),
    ):  # fmt: skip
        for label in labels:
            one = both.select(channel, **{dim: prefix + label})
            single = len(labels) == 1
            other = alone[channel] if single else alone.select(channel, **{dim: prefix + label})
            assert not single or alone.dims[channel] == ("time",)
            np.testing.assert_allclose(one, other, atol=scale)
    assert alone["stroke"][-1, 0] == pytest.approx(ENDS[prefix][1], rel=0.2)


@pytest.mark.warns("FreeCraneWarning")
def test_roles_of_a_crane_by_hand() -> None:
    for name in ("A", "main_cylinder"):  # a name is no role
        slide = on_joint("box", axis=(0, 0, 1), joint=name)
        assert not {"slew_angle", "stroke"} & set(simulate(slide, t_end=1.0))
    scene = on_joint("box", axis=(0, 0, 1), joint="hoist")
    scene.add_roles(cylinders={"lift": "hoist"})
    result = simulate(scene, t_end=0.5)
    np.testing.assert_array_equal(result.select("stroke", cylinder="lift"), result["coordinate"][:, 0])
    with pytest.raises(SceneError, match="prefix '' is used twice"):
        scene.add_roles(cylinders={"lift": "hoist"})
