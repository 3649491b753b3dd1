"""What a script writes and what the scene makes of it: frames, defaults, copies, inputs, warnings."""

from __future__ import annotations

import numpy as np
import pytest
from named import on_joint
from numpy.testing import assert_allclose, assert_array_equal

from seacrane import Curve, Frame, Run, SampledController, Scene, SceneError, _core, cases, simulate
from seacrane.inputs.frames import axes_along, rotation_matrix

QUARTER = (np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5))  # 90 deg about z


def turned_pair() -> Scene:
    """Two bodies away from the origin, the second turned by 90 deg about z."""
    scene = Scene()
    scene.add_body("a", mass=1.0, inertia=[1, 1, 1], position=(1.0, 2.0, 3.0))
    scene.add_body("b", mass=1.0, inertia=[1, 1, 1], position=(4.0, 2.0, 3.0), quaternion=QUARTER)
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
    joint = scene.add_joint("j", kind="spherical", first="a", second="b", point=(2.0, 5.0, 4.0))
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
    scene.record_coordinate(joint="j")
    assert abs(simulate(scene, t_end=0.0)["coordinate"][0, 0]) < 1e-14


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, -1, 0), (0, 0, 3), (1, 1, 1), (-0.2, 1e-9, 1)])
def test_axes_along_any_direction_are_right_handed(axis: tuple[float, float, float]) -> None:
    axes = axes_along("axis", axis)
    assert_allclose(axes.T @ axes, np.eye(3), atol=1e-14)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert_allclose(axes[:, 2], np.array(axis) / np.linalg.norm(axis), atol=1e-15)


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


def test_a_copy_may_be_changed_alone() -> None:
    scene = mass_on_rail()
    scene.notes["kind"] = "rail"
    other = scene.copy(name="other", gravity=1.0)
    other.add_body("extra", mass=1.0, inertia=[1, 1, 1])
    other.notes["kind"] = "changed"
    other.actuators.clear()
    other.recorded.clear()
    held = [*scene.bodies], [*scene.actuators], [*scene.recorded], scene.notes, scene.name, scene.gravity
    assert held == (["cart"], ["motor"], ["rail"], {"kind": "rail"}, "cart", 0.0)


def test_default_coordinates_and_names() -> None:
    scene = turned_pair()
    scene.add_joint("hinge", kind="revolute", first="ground", second="a")
    scene.add_joint("sleeve", kind="cylindrical", first="ground", second="b")
    assert scene.add_driver("hinge", curve=0.0).name == "hinge.angle"
    assert scene.add_actuator("sleeve").coordinate == "displacement"
    scene.record_coordinate(joint="sleeve", coordinate="angle", name="turn")
    assert scene.recorded == {"turn": ("sleeve", "angle")}


def test_numbers_and_constant_curves_are_the_same_to_an_actuator() -> None:
    forces = 2.0, Curve.constant(value=2.0)
    ends = [simulate(mass_on_rail(feed_forward=force), t_end=3.0)["coordinate"][-1, 0] for force in forces]
    assert ends[0] == ends[1] == pytest.approx(0.5 * 2.0 / 4.0 * 3.0**2, rel=1e-9)


def test_inputs_hold_until_they_are_set_again() -> None:
    """4 kg pushed by 2 N for 1 s, then let go, then stopped within 2 s by -1 N: x = 0.25 + 0.5 + 0.5 m."""
    run = Run(mass_on_rail(), t_end=4.0)
    for force, until in ((2.0, 1.0), (0.0, 2.0), (-1.0, 4.0)):
        run.set_inputs({"motor.force": force})
        run.advance(until)
    assert run.measure()["coordinate"][0] == pytest.approx(1.25, rel=1e-9)
    assert run.measure()["coordinate_rate"][0] == pytest.approx(0.0, abs=1e-9)
    assert run.measure()["actuator_force"][0] == -1.0


def test_the_reference_input_adds_to_the_reference() -> None:
    run = Run(mass_on_rail(stiffness=100.0, damping=40.0, reference=0.5), t_end=20.0)
    run.set_inputs({"motor.reference": 0.25})
    run.advance(20.0)
    assert run.measure()["coordinate"][0] == pytest.approx(0.75, abs=1e-6)


def test_a_point_force_input_turns_with_the_body_when_asked() -> None:
    scene = Scene(gravity=0.0)
    scene.add_body("puck", mass=2.0, inertia=[1, 1, 1], quaternion=QUARTER)
    scene.add_point_force("thruster", body="puck", force=(0, 0, 0), body_axes=True)
    run = Run(scene, t_end=1.0)
    run.set_inputs({"thruster.force": (4.0, 0.0, 0.0)})  # body x is inertial y
    run.advance(1.0)
    assert_allclose(run.measure()["position"][0], [0.0, 1.0, 0.0], atol=1e-9)


def test_a_controller_is_called_at_its_period_and_not_at_the_end() -> None:
    times: list[float] = []

    def note(now: float, measured: object) -> dict[str, float]:
        times.append(now)
        return {}

    simulate(mass_on_rail(), t_end=1.0, controllers=[SampledController(period=0.1, function=note)])
    assert_allclose(times, np.arange(10) * 0.1, atol=1e-12)


def test_a_run_goes_on_from_a_state_to_the_same_bits() -> None:
    """A checkpoint taken where a one-step method stands costs nothing: the later run is the same run."""
    scene = mass_on_rail(stiffness=3.0)
    scene.add_point_force("push", body="cart", force=(1.0, 0.0, 0.0))
    whole = Run(scene, t_end=4.0, integrator="rk4", dt=0.25)
    whole.advance(2.0)
    checkpoint = whole.core.state
    whole.advance(4.0)
    later = simulate(scene, t_end=4.0, integrator="rk4", dt=0.25, start=checkpoint)
    assert later.time[0] == 2.0
    assert_array_equal(later["coordinate"][-1], whole.measure()["coordinate"])


def door(*heights: float) -> Scene:
    scene = Scene()
    scene.add_body("door", mass=5.0, inertia=[1, 1, 1], position=(1.0, 0.0, 0.0))
    for height in heights:
        hinge = {"point": (0, height, 0), "axis": (0, 1, 0)}
        scene.add_joint(f"hinge {height:g}", kind="revolute", first="ground", second="door", **hinge)
    return scene


def test_redundant_joints_warn_by_name_and_the_motion_is_that_of_one() -> None:
    one = simulate(door(0.0), t_end=2.0)
    with pytest.warns(UserWarning, match=r"hinge 0, hinge 2 are redundant \(5 more than needed\)"):
        two = simulate(door(0.0, 2.0), t_end=2.0)
    assert_allclose(two["position"], one["position"], atol=1e-6)
    weight = one["reaction_force"].sum(axis=1)
    assert_allclose(two["reaction_force"].sum(axis=1), weight, rtol=1e-5, atol=1e-3)


def test_names_of_one_kind_differ_and_kinds_do_not_share_names() -> None:
    scene = mass_on_rail()
    with pytest.raises(SceneError, match=r"actuator 'motor': .*twice"):
        scene.add_actuator(name="motor", joint="rail")
    scene.add_spring("motor", first="ground", second="cart", stiffness=1.0)
    scene.compile()


@pytest.mark.parametrize(("t_end", "dt_out", "expected"), [(1.0, 0.25, 5), (1.0, 0.3, 5), (0.0, 0.1, 1),
                                                           (0.3, 0.1, 4)])  # fmt: skip
def test_outputs_start_at_zero_and_end_at_the_end(t_end: float, dt_out: float, expected: int) -> None:
    result = simulate(mass_on_rail(), t_end=t_end, dt_out=dt_out)
    assert result.time.size == expected
    assert result.time[0] == 0.0 and result.time[-1] == t_end
    assert_allclose(np.diff(result.time)[:-1], dt_out, rtol=1e-12)


def test_integrator_names_are_those_that_run() -> None:
    for name in _core.integrator_names():
        end = simulate(mass_on_rail(feed_forward=2.0), t_end=1.0, integrator=name)["coordinate"][-1, 0]
        bound = 3e-3 if name == "semi-implicit-euler" else 1e-4  # order 1: a half step of 2 ms late
        assert end == pytest.approx(0.25, rel=bound), name


def test_channels_asked_for_are_those_recorded_and_a_scene_offers_what_it_has() -> None:
    lone = Scene()
    lone.add_body("stone", mass=1.0, inertia=[1, 1, 1])
    offered = set(lone.compile().channel_names(defaults_only=False))
    of_joints = {"coordinate", "actuator_force", "reaction_force"}
    assert not offered & (of_joints | {"driver_force", "tension", "wave_force"})
    assert of_joints <= set(mass_on_rail().compile().channel_names())
    wanted = ["slew_angle", "stroke", "cylinder_force", "link_tension"]
    assert sorted(simulate(cases.case2(), t_end=1.0, channels=wanted).channels) == sorted(wanted)
