"""What the scene makes of what a script writes: frames, defaults, copies, inputs; elements by name."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from named import on_joint, pendulum
from numpy.testing import assert_allclose, assert_array_equal

from seacrane import Curve, Frame, Run, Scene, SceneError, cases, simulate
from seacrane.analysis.scene_report import scene_report
from seacrane.inputs.frames import rotation_matrix

QUARTER = (np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5))  # 90 deg about z


def turned_pair() -> Scene:
    scene = Scene()
    scene.add_body("a", mass=1.0, inertia=[1, 1, 1], position=(1, 2, 3))
    scene.add_body("b", mass=1.0, inertia=[1, 1, 1], position=(4, 2, 3), quaternion=QUARTER)
    return scene


def mass_on_rail(**actuator: float | Curve) -> Scene:
    """4 kg on a frictionless rail along x without gravity, pushed by an actuator."""
    scene = on_joint("cart", mass=4.0, gravity=0.0)
    scene.add_actuator(name="motor", joint="rail", **actuator)
    return scene


def test_a_joint_point_in_the_inertial_frame_becomes_one_in_each_body() -> None:
    """b's x axis points to inertial y: (-2, 3, 1) in the inertial frame is (3, 2, 1) in b. The default is the
    origin of the second body; frames on the bodies are taken as they are."""
    scene = turned_pair()
    joint = scene.add_joint("j", kind="spherical", first="a", second="b", point=(2, 5, 4))
    assert_allclose(joint.first_frame.point, [1.0, 3.0, 1.0], atol=1e-15)
    assert_allclose(joint.second_frame.point, [3.0, 2.0, 1.0], atol=1e-15)
    usual = scene.add_joint("k", kind="spherical", first="a", second="b")
    assert_allclose([usual.first_frame.point, usual.second_frame.point], [(3, 0, 0), (0, 0, 0)], atol=1e-15)
    frames = Frame(point=(0.1, 0.2, 0.3)), Frame(axes=[[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    given = {"first_frame": frames[0], "second_frame": frames[1]}
    own = scene.add_joint("l", kind="revolute", first="a", second="b", **given)
    assert (own.first_frame, own.second_frame) == frames
    ends = {"point": (1, 2, 3), "second_point": (4, 6, 3)}
    wire = scene.add_joint("wire", kind="distance", first="a", second="b", **ends)
    assert wire.length == pytest.approx(5.0, rel=1e-15)


def test_the_joint_axis_is_z_of_both_frames_and_the_described_pose_is_zero() -> None:
    scene, axis = turned_pair(), np.array([1.0, -2.0, 0.5])
    joint = scene.add_joint("j", kind="revolute", first="a", second="b", axis=7.0 * axis)
    frames = {"a": joint.first_frame, "b": joint.second_frame}
    inertial = [rotation_matrix(scene.bodies[name].quaternion) @ frame.axes for name, frame in frames.items()]
    assert_allclose(inertial[0], inertial[1], atol=1e-14)
    assert_allclose(inertial[0][:, 2], axis / np.linalg.norm(axis), atol=1e-14)
    scene.add_channel(joint="j")
    assert abs(simulate(scene, t_end=0.0)["coordinate"][0, 0]) < 1e-14


def test_what_is_handed_out_is_a_copy_and_a_compiled_model_stays() -> None:
    scene = turned_pair()
    scene.bodies["a"].position[0] = 99.0
    assert_array_equal(scene.bodies["a"].position, [1.0, 2.0, 3.0])
    model = scene.compile()
    start = np.array(model.initial_state)
    model.initial_state[:] = 7.0
    assert_array_equal(model.initial_state, start)
    added = scene.add_body("c", mass=1.0, inertia=[1.0, 2.0, 2.5])
    assert_array_equal(added.inertia, np.diag([1.0, 2.0, 2.5]))
    assert model.bodies == ["a", "b"] and scene.compile().bodies == ["a", "b", "c"]


def test_default_coordinates_and_names() -> None:
    scene = turned_pair()
    scene.add_joint("hinge", kind="revolute", first="ground", second="a")
    scene.add_joint("sleeve", kind="cylindrical", first="ground", second="b")
    assert scene.add_driver("hinge", curve=0.0).name == "hinge.angle"
    assert scene.add_actuator("sleeve").coordinate == "displacement"
    scene.add_channel(joint="sleeve", coordinate="angle", name="turn")
    assert scene.recorded == {"turn": ("sleeve", "angle")}
    crane = Scene()
    crane.add_crane(base="ground", held=False)
    assert crane.add_actuator("main").name == "main"  # as the crane calls its cylinder
    assert crane.add_driver("knuckle", curve=0.0).name == "knuckle_cylinder.displacement"


def test_inputs_hold_until_they_are_set_again() -> None:
    """4 kg pushed by 2 N for 1 s, then let go, then stopped within 2 s by -1 N: x = 0.25 + 0.5 + 0.5 m."""
    run = Run(mass_on_rail(), t_end=4.0)
    for force, until in ((2.0, 1.0), (0.0, 2.0), (-1.0, 4.0)):
        run.set_inputs({"motor.force": force})
        run.advance(until)
    assert run.measure()["coordinate"][0] == pytest.approx(1.25, rel=1e-9)
    assert run.measure()["coordinate_rate"][0] == pytest.approx(0.0, abs=1e-9)
    assert run.measure()["actuator_force"][0] == -1.0
    # The reference input adds to the reference.
    run = Run(mass_on_rail(stiffness=100.0, damping=40.0, reference=0.5), t_end=20.0)
    run.set_inputs({"motor.reference": 0.25})
    run.advance(20.0)
    assert run.measure()["coordinate"][0] == pytest.approx(0.75, abs=1e-6)


def test_a_point_force_input_turns_with_the_body_when_asked() -> None:
    scene = Scene(gravity=0.0)
    scene.add_body("puck", mass=2.0, inertia=[1, 1, 1], quaternion=QUARTER)
    scene.add_force("puck", name="thruster", force=(0, 0, 0), body_axes=True)
    run = Run(scene, t_end=1.0)
    run.set_inputs({"thruster.force": (4.0, 0.0, 0.0)})  # body x is inertial y
    run.advance(1.0)
    assert_allclose(run.measure()["position"][0], [0.0, 1.0, 0.0], atol=1e-9)


@pytest.mark.parametrize(("t_end", "dt_out", "expected"), [(1.0, 0.25, 5), (1.0, 0.3, 5), (0.0, 0.1, 1),
                                                           (0.3, 0.1, 4)])  # fmt: skip
def test_outputs_start_at_zero_and_end_at_the_end(t_end: float, dt_out: float, expected: int) -> None:
    result = simulate(mass_on_rail(), t_end=t_end, dt_out=dt_out)
    assert result.time.size == expected
    assert result.time[0] == 0.0 and result.time[-1] == t_end
    assert_allclose(np.diff(result.time)[:-1], dt_out, rtol=1e-12)


def hung() -> Scene:
    scene, ends = Scene(name="trolley"), {"point": (0.0, 0.0, 0.0), "second_point": (0.0, 0.0, -4.0)}
    scene.add_body("trolley", mass=100.0, inertia=(10.0,) * 3)
    scene.add_body("load", mass=50.0, inertia=(5.0,) * 3, position=(0, 0, -4))
    scene.add_joint("rail", kind="prismatic", first="ground", second="trolley", axis=(1, 0, 0))
    scene.add_joint("wire", kind="distance", first="trolley", second="load", **ends)
    scene.add_line(joint="wire", rung="rigid")
    scene.add_actuator("rail", name="drive", stiffness=10.0)
    scene.add_channel(joint="rail", minimum=-3.0, maximum=3.0)
    scene.add_channel(joint="rail")
    return scene


def test_a_replaced_element_takes_the_place_of_the_old_one() -> None:
    scene = hung()
    before = list(scene.bodies)
    heavier = scene.replace("load", mass=70.0)
    assert scene.bodies["load"] is heavier and heavier.mass == 70.0
    assert list(scene.bodies) == before
    assert_array_equal(heavier.position, (0.0, 0.0, -4.0))
    tension = simulate(scene, t_end=0.1, channels=["tension"])["tension"]
    assert_allclose(tension, 70.0 * scene.gravity, rtol=1e-9)
    scene.replace("drive", feed_forward=3.0)
    assert scene.actuators["drive"].feed_forward == Curve.constant(value=3.0)
    assert scene.actuators["drive"].stiffness == 10.0
    assert scene.add_driver("rail", curve=0.0).curve == Curve.constant(value=0.0)


WRONG: tuple[tuple[Callable[[Scene], Any], str], ...] = (
    (lambda s: s.replace("lost", mass=1.0), "scene 'trolley'.*no element 'lost'"),
    (lambda s: s.replace("wire", length=3.0), "'wire'.*several elements; pass kind='joint' or 'load'"),
    (lambda s: s.remove("load", kind="bodies"), "kind 'bodies' is unknown; choose body"),
    (lambda s: s.replace("load", weight=3.0), "body 'load': cannot change 'weight'"),
    (lambda s: s.replace("load", name="cargo"), "cannot change 'name'"),
    (lambda s: s.replace("load", mass="heavy"), "body 'load': mass is 'heavy'"),
    (lambda s: s.remove("load"), "body 'load': joint 'wire' refer to it"),
    (lambda s: s.remove("rail", kind="joint"), "joint 'rail': .*'drive', range 'rail', recorded"),
    (lambda s: s.remove("wire", kind="joint"), "joint 'wire': load 'wire' refer to it"),
)


@pytest.mark.parametrize(("do", "told"), WRONG, ids=[row[1] for row in WRONG])
def test_what_cannot_be_done_is_refused_and_changes_nothing(do: Callable[[Scene], Any], told: str) -> None:
    scene = hung()
    with pytest.raises((SceneError, TypeError), match=told):
        do(scene)
    assert scene == hung()


def test_elements_are_removed_from_the_outside_in() -> None:
    scene = hung()
    scene.remove("wire", kind="load")
    for name in ("wire", "load", "drive"):
        scene.remove(name)
    for kind in ("range", "recorded coordinate"):
        scene.remove("rail", kind=kind)
    for name in ("rail", "trolley"):
        scene.remove(name)
    assert scene == Scene(name="trolley")


def test_a_vessel_in_a_sea_is_kept() -> None:
    scene = cases.vessel()
    with pytest.raises(SceneError, match=r"vessel 'vessel': the waves on it .*refer to it"):
        scene.remove("vessel", kind="vessel")
    scene.waves = None
    scene.remove("vessel", kind="vessel")
    assert not scene.vessels and not scene.provenance
    scene.remove("vessel")
    assert not scene.bodies


UNIQUE = "reactions not unique (minimum norm given)"


def section(scene: Scene, name: str) -> dict[str, Any]:
    with warnings.catch_warnings(action="ignore"):  # redundant joints
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


def test_fastest_mode_of_a_spring_and_a_mass() -> None:
    scene = on_joint("mass", mass=2.0, gravity=0.0)
    scene.add_actuator("rail", stiffness=5000.0)
    assert section(scene, "modes")["fastest_mode_per_s"] == pytest.approx(50.0, rel=1e-5)
