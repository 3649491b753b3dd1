"""The scene report: counts by hand, what assembly corrected, what is absent, cost, fastest mode."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np
import pytest
from test_scene_file import every_kind

from seacrane import Curve, Scene, SceneError, cases
from seacrane.analysis import scene_report as scene_report_module
from seacrane.analysis.scene_report import scene_report


def section(scene: Scene, name: str) -> dict[str, Any]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # redundant joints
        return dict(scene_report(scene)[name])


def pendulum(*, position: tuple[float, float, float] = (1.0, 0.0, 0.0), **settings: Any) -> Scene:
    scene = Scene(name="pendulum", **settings)
    scene.add_body(name="bob", mass=2.0, inertia=[0.1, 0.1, 0.1], position=position)
    scene.add_joint(
        kind="revolute", name="pin", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0)
    )
    return scene


def test_counts_of_case_2() -> None:
    scene = cases.case2(count=30)
    size = section(scene, "size")
    memory = sum(len(block.a) for block in scene.vessels["vessel"].memory)
    expected = {
        "bodies": 10, "joints": 11, "drivers": 0,
        "coordinates": 60, "constraints": 46, "degrees_of_freedom": 14,
        "compiled_coordinates": 54, "compiled_constraints": 40, "pose states": 70, "velocity states": 60,
        "memory states": memory, "wave components": 30, "input slots": 3 * 3 + 3,
    }  # fmt: skip
    assert {name: size[name] for name in expected} == expected
    assert memory > 0
    states = [size[f"{kind} states"] for kind in ("pose", "velocity", "memory", "work")]
    assert size["states"] == sum(states)


def test_elements_of_case_2_by_name() -> None:
    scene = cases.case2(count=5)
    elements = section(scene, "elements")
    assert elements["bodies"] == list(scene.bodies)
    assert elements["revolute joints"] == [
        "A (tower to king)",
        "C (king to main_jib)",
        "F (main_jib to knuckle_jib)",
    ]
    assert elements["distance joints"] == ["link (knuckle_jib to payload)"]
    assert elements["weld joints"] == ["deck (vessel to tower)"]
    assert elements["actuators"][0] == "slew (A angle)"
    assert elements["vessels"] == ["vessel (vessel)"]
    assert "springs" not in elements


def test_euler_angles_take_one_state_less_per_body() -> None:
    assert section(pendulum(orientation="euler_xyz"), "size")["pose states"] == 6
    assert section(pendulum(orientation="euler_xyz"), "size")["states"] == 6 + 6 + 2


def test_kinks_of_curves_are_counted() -> None:
    scene = pendulum()
    jump = Curve.constant(value=0.0).then(time=3.0, curve=Curve.constant(value=1.0))
    scene.add_actuator(joint="pin", stiffness=1.0, reference=jump)
    assert section(scene, "size")["times where a curve has a kink"] == 1


def test_assembly_tells_what_it_moved() -> None:
    exact = section(pendulum(), "assembly")
    assert exact["constraint residual as described [m or rad]"] == 0.0
    assert "body moved most" not in exact
    scene = Scene()
    scene.add_body(name="plate", mass=1.0, inertia=[1, 1, 1])
    scene.add_body(name="block", mass=1.0, inertia=[1, 1, 1], position=(0.0, 0.0, 1.0))
    scene.add_joint(kind="weld", name="base", first="ground", second="plate")
    scene.add_joint(kind="prismatic", name="rail", first="plate", second="block", axis=(0, 0, 1))
    moved = scene.copy(bodies={})
    moved.add_body(name="plate", mass=1.0, inertia=[1, 1, 1])
    moved.add_body(
        name="block", mass=1.0, inertia=[1, 1, 1], position=(0.02, 0.0, 1.0), velocity=(0.0, 0.3, 0.0)
    )
    found = section(moved, "assembly")
    assert found["constraint residual as described [m or rad]"] == pytest.approx(0.02, rel=1e-12)
    assert found["constraint residual at the start [m or rad]"] < 1e-12
    assert found["largest translation by assembly [m]"] == pytest.approx(0.02, rel=1e-6)
    assert found["largest change of velocity [m/s or rad/s]"] == pytest.approx(0.3, rel=1e-6)
    assert found["body moved most"] == "block"


def test_redundant_joints_are_named() -> None:
    scene = pendulum()
    scene.add_joint(
        kind="revolute", name="pin again", first="ground", second="bob", point=(0, 2, 0), axis=(0, 1, 0)
    )
    found = section(scene, "assembly")
    assert found["rank of the constraints"] == 5
    assert found["redundant constraints"] == 5
    assert found["reactions not unique (minimum norm given)"] == ["pin", "pin again"]
    assert section(scene, "size")["degrees_of_freedom"] == 1
    assert "reactions not unique (minimum norm given)" not in section(pendulum(), "assembly")


def test_what_is_absent() -> None:
    alone = Scene(gravity=0.0)
    alone.add_body(name="stone", mass=1.0, inertia=[1, 1, 1])
    assert section(alone, "left out")["absent"] == [
        "joints", "drivers", "actuators", "vessels", "waves", "fluid memory", "gravity"
    ]  # fmt: skip
    vessel = section(cases.vessel(hs=0.0, memory="none"), "left out")
    assert {"waves", "fluid memory"} <= set(vessel["absent"])
    assert vessel["vessels without memory"] == ["vessel"]
    assert vessel["bodies without weight of their own"] == ["vessel"]
    assert "vessels without memory" not in section(cases.vessel(hs=0.0), "left out")


def test_missing_roll_damping_is_told() -> None:
    scene = Scene()
    scene.add_body(name="hull", mass=1.0, inertia=[1, 1, 1])
    scene.add_vessel(body="hull", restoring=np.diag([0, 0, 1.0, 1.0, 1.0, 0]))
    assert section(scene, "left out")["vessels without viscous roll damping"] == ["hull"]
    assert "vessels without viscous roll damping" not in section(cases.vessel(hs=0.0), "left out")


def test_joints_without_constraints_are_told() -> None:
    scene = Scene()
    scene.add_body(name="kite", mass=1.0, inertia=[1, 1, 1])
    scene.add_joint(kind="free", name="air", first="ground", second="kite")
    assert section(scene, "left out")["joints that constrain nothing"] == ["air"]


def test_cost_lists_every_part_of_an_evaluation() -> None:
    cost = section(cases.case1(count=5), "cost")
    parts = {"kinematics", "inertia", "constraint rows", "loads, waves, memory", "assembly and factorisation"}
    assert {f"{part} [ns]" for part in parts | {"solution", "rates", "whole evaluation"}} <= set(cost)
    assert all(value > 0.0 for value in cost.values())


@pytest.mark.parametrize("stiffness", [50.0, 5000.0])
def test_fastest_mode_of_a_spring_and_a_mass(stiffness: float) -> None:
    scene = Scene(gravity=0.0)
    scene.add_body(name="mass", mass=2.0, inertia=[1, 1, 1])
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="mass", axis=(1, 0, 0))
    scene.add_actuator(joint="rail", stiffness=stiffness)
    fastest = section(scene, "modes")["fastest_mode_per_s"]
    assert fastest == pytest.approx(math.sqrt(stiffness / 2.0), rel=1e-5)


def test_all_but_the_cost_is_the_same_at_every_call() -> None:
    scene = cases.case2(count=5)
    first, second = scene_report(scene), scene.report()
    assert {k: v for k, v in first.items() if k != "cost"} == {k: v for k, v in second.items() if k != "cost"}


def test_a_scene_that_does_not_compile_has_no_report() -> None:
    with pytest.raises(SceneError, match="no bodies"):
        Scene().report()


def test_every_load_is_in_the_report() -> None:
    scene = every_kind()
    joint = next(name for name, found in scene.joints.items() if found.kind in ("prismatic", "revolute"))
    scene.add_end_stop(joint=joint, minimum=-50.0)
    scene.add_soft_stop(joint=joint, minimum=-60.0, stiffness=1e4)
    scene.add_friction(joint=joint, load=1.0, speed=1e-3)
    rows = dict(scene_report_module.elements_of(scene))
    told = " ".join(name for names in rows.values() for name in names)
    tables = (scene.point_forces, scene.springs, scene.force_tables, scene.function_forces, scene.loads)
    for table in (*tables, scene.vessels, scene.actuators, scene.drivers):
        for name in table:
            assert name in told, name
