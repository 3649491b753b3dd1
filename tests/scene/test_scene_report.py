"""The scene report: counts by hand, what assembly corrected, what is absent, cost, fastest mode."""

from __future__ import annotations

import warnings
from typing import Any

import pytest
from named import on_joint, pendulum

from seacrane import Curve, Scene, cases
from seacrane.analysis.scene_report import scene_report

UNIQUE = "reactions not unique (minimum norm given)"


def section(scene: Scene, name: str) -> dict[str, Any]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # redundant joints
        return dict(scene_report(scene)[name])


def test_counts_and_elements_of_case_2() -> None:
    scene = cases.case2(count=30)
    report = scene_report(scene)
    size, elements = dict(report["size"]), dict(report["elements"])
    memory = sum(len(block.a) for block in scene.vessels["vessel"].memory)
    expected = {"bodies": 10, "joints": 11, "drivers": 0, "coordinates": 60, "constraints": 46,
                "degrees_of_freedom": 14, "compiled_coordinates": 54, "compiled_constraints": 40,
                "pose states": 70, "velocity states": 60, "memory states": memory, "wave components": 30,
                "input slots": 3 * 3 + 3}  # fmt: skip
    assert {name: size[name] for name in expected} == expected and memory > 0
    assert size["states"] == sum(size[f"{kind} states"] for kind in ("pose", "velocity", "memory", "work"))
    assert elements["bodies"] == list(scene.bodies)
    assert elements["distance joints"] == ["link (knuckle_jib to payload)"]
    cost = dict(report["cost"])
    parts = ("kinematics", "inertia", "constraint rows", "loads, waves, memory", "whole evaluation")
    assert {f"{part} [ns]" for part in parts} <= set(cost) and min(cost.values()) > 0.0


def test_euler_angles_and_kinks() -> None:
    size = section(pendulum(orientation="euler_xyz"), "size")
    assert size["pose states"] == 6 and size["states"] == 6 + 6 + 2
    scene = pendulum()
    jump = Curve.constant(value=0.0).then(time=3.0, curve=Curve.constant(value=1.0))
    scene.add_actuator("pin", stiffness=1.0, reference=jump)
    assert section(scene, "size")["times where a curve has a kink"] == 1


def test_assembly_tells_what_it_moved() -> None:
    exact = section(pendulum(), "assembly")
    assert exact["constraint residual as described [m or rad]"] == 0.0
    assert "body moved most" not in exact and UNIQUE not in exact
    scene = Scene()
    scene.add_body("plate", mass=1.0, inertia=[1, 1, 1])
    scene.add_body("block", mass=1.0, inertia=[1, 1, 1], position=(0, 0, 1))
    scene.add_joint("base", kind="weld", first="ground", second="plate")
    scene.add_joint("rail", kind="prismatic", first="plate", second="block", axis=(0, 0, 1))
    scene.replace("block", position=(0.02, 0, 1), velocity=(0, 0.3, 0))
    found = section(scene, "assembly")
    assert found["constraint residual as described [m or rad]"] == pytest.approx(0.02, rel=1e-12)
    assert found["constraint residual at the start [m or rad]"] < 1e-12
    assert found["largest translation by assembly [m]"] == pytest.approx(0.02, rel=1e-6)
    assert found["largest change of velocity [m/s or rad/s]"] == pytest.approx(0.3, rel=1e-6)
    assert found["body moved most"] == "block"


def test_what_is_absent() -> None:
    alone = Scene(gravity=0.0)
    alone.add_body("stone", mass=1.0, inertia=[1, 1, 1])
    alone.add_joint("air", kind="free", first="ground", second="stone")
    left = section(alone, "left out")
    assert left["absent"] == ["drivers", "actuators", "vessels", "waves", "fluid memory", "gravity"]
    assert left["joints that constrain nothing"] == ["air"]
    vessel = section(cases.vessel(hs=0.0, memory="none"), "left out")
    assert {"waves", "fluid memory"} <= set(vessel["absent"])
    assert vessel["vessels without memory"] == vessel["bodies without weight of their own"] == ["vessel"]
    assert "vessels without memory" not in section(cases.vessel(hs=0.0), "left out")


def test_fastest_mode_of_a_spring_and_a_mass() -> None:
    scene = on_joint("mass", mass=2.0, gravity=0.0)
    scene.add_actuator("rail", stiffness=5000.0)
    assert section(scene, "modes")["fastest_mode_per_s"] == pytest.approx(50.0, rel=1e-5)
