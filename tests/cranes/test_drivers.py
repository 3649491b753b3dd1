"""Prescribed motion, the loads it needs, and those loads put back."""

from __future__ import annotations

import numpy as np
import pytest
from multibody_runs import ACTUATORS, crane_scene, ramp, record, swing_out

from seacrane import Curve, Run, Scene, SceneError
from seacrane.analysis import driven, inverse_dynamics, reflected_inertia
from seacrane.scene import spline_curve

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

MOTIONS = ("x", "y", "z", "roll", "pitch", "yaw")


def test_drivers_on_a_free_joint_prescribe_all_six_motions() -> None:
    scene = Scene(gravity=9.81)
    scene.add_body(name="ship", mass=5.0, inertia=(1.0, 2.0, 3.0), center_of_mass=(0.1, 0.0, -0.2))
    scene.add_joint(kind="free", name="motion", first="ground", second="ship")
    curves = {}
    for i, motion in enumerate(MOTIONS):
        curves[motion] = Curve.harmonic(amplitude=0.2 + 0.05 * i, omega=1.0 + 0.3 * i, phase=0.5 * i)
        scene.add_driver(joint="motion", coordinate=motion, curve=curves[motion])
        scene.record_coordinate(joint="motion", coordinate=motion, name=motion)
    assert scene.compile().degrees_of_freedom == 0
    out = record(scene, 5.0)
    for i, motion in enumerate(MOTIONS):
        expected = curves[motion].evaluate(out["time"])
        np.testing.assert_allclose(out["coordinate"][:, i], expected[:, 0], atol=1e-11)
        np.testing.assert_allclose(out["coordinate_rate"][:, i], expected[:, 1], atol=1e-11)
    # Newton at the centre of mass: drivers along the inertial axes are the only supports.
    force = 5.0 * (out["acceleration"][:, 0] + [0.0, 0.0, 9.81])
    np.testing.assert_allclose(out["driver_force"][:, :3], force, atol=1e-9 * np.abs(force).max())


def test_a_driven_hinge_goes_round_many_times() -> None:
    scene = Scene()
    scene.add_body(name="rotor", mass=1.0, inertia=(1, 1, 1))
    scene.add_joint(kind="revolute", name="shaft", first="ground", second="rotor")
    scene.add_driver(joint="shaft", curve=ramp(10.0))
    scene.record_coordinate(joint="shaft")
    out = record(scene, 5.0)
    np.testing.assert_allclose(out["angular_velocity"][:, 0, 2], 10.0, atol=1e-10)
    np.testing.assert_allclose(np.unwrap(out["coordinate"][:, 0]), 10.0 * out["time"], atol=1e-9)


def jerked() -> Scene:
    """A driven cart whose acceleration jumps at 1 s, with a pendulum that answers to it."""
    scene = Scene(gravity=9.81)
    scene.add_body(name="cart", mass=1.0, inertia=(1, 1, 1))
    scene.add_body(name="bob", mass=2.0, inertia=(0.1, 0.1, 0.1), position=(0.0, 0.0, -1.0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="cart", axis=(1, 0, 0))
    scene.add_joint(kind="revolute", name="pin", first="cart", second="bob", point=(0, 0, 0), axis=(0, 1, 0))
    swing = Curve.harmonic(start_time=1.0, offset=-1.0, amplitude=1.0, omega=6.0)
    scene.add_driver(joint="rail", curve=Curve.constant(value=0.0).then(time=1.0, curve=swing))
    return scene


def test_a_run_cut_at_a_jump_of_the_reference_goes_on_from_its_other_side() -> None:
    scene = jerked()
    assert scene.compile().breakpoints == [1.0]
    whole = record(scene, 2.0, rtol=1e-9)
    run = Run(scene, t_end=2.0, dt_out=0.05, rtol=1e-9)
    for stop in (0.7, 1.0, 1.3, 2.0):
        run.advance(stop)
    cut = run.core.channels()
    for name in ("position", "velocity", "quaternion"):
        np.testing.assert_allclose(cut[name], whole[name], atol=1e-7)
    assert np.ptp(whole["position"][:, 1, 0]) > 0.1


def test_forces_of_a_driven_crane_return_its_motion_when_they_act_alone() -> None:
    references = swing_out(4.0)
    scene = crane_scene(references=references)
    needed = record(driven(scene), 4.0, rtol=1e-10, dt_out=0.02)
    actuated = crane_scene(references=references)
    actuated.actuators.clear()
    for i, (name, joint) in enumerate(ACTUATORS.items()):
        curve = spline_curve(times=needed["time"], values=needed["driver_force"][:, i])
        actuated.add_actuator(name=name, joint=joint, feed_forward=curve)
    assert actuated.compile().degrees_of_freedom == 8
    out = record(actuated, 4.0, rtol=1e-10, dt_out=0.02)
    expected = np.column_stack([references[name].evaluate(out["time"])[:, 0] for name in ACTUATORS])
    assert np.ptp(expected, axis=0).min() > 0.9
    # Quintic spline of 0.02 s samples: relative error of the forces near (w h)^6 with w below 10 rad/s, 6e-5
    # of the little that changes so fast; the crane is free to drift by twice its integral.
    np.testing.assert_allclose(out["coordinate"], expected, atol=1e-5)
    np.testing.assert_allclose(out["position"], needed["position"], atol=1e-4)


def test_inverse_dynamics_by_algebra_agrees_with_the_driven_simulation() -> None:
    scene = crane_scene(payload=False, references=swing_out(4.0))
    times = np.linspace(0.0, 4.0, 9)
    loads = inverse_dynamics(scene, times=times)
    out = record(driven(scene), 4.0, dt_out=0.5)
    for i, name in enumerate(ACTUATORS):
        np.testing.assert_allclose(
            loads[name], out["driver_force"][:, i], rtol=1e-7, atol=1e-7 * np.abs(loads[name]).max()
        )
        assert np.ptp(loads[name]) > 1e3


def test_inverse_dynamics_needs_every_motion() -> None:
    with pytest.raises(SceneError, match=r"5 degree\(s\) of freedom are not prescribed"):
        inverse_dynamics(crane_scene(payload=True, references=swing_out(4.0)), times=[0.0])


def test_reflected_inertia_by_hand() -> None:
    """Two links in line on hinges about z: parallel axes, and a cart that carries a mass on a lever."""
    scene = Scene(gravity=9.81)
    scene.add_body(name="inner", mass=3.0, inertia=(0.1, 0.2, 0.3), position=(0.5, 0.0, 0.0))
    scene.add_body(name="outer", mass=2.0, inertia=(0.2, 0.25, 0.4), position=(1.0, 0.6, 0.0))
    scene.add_joint(kind="revolute", name="root", first="ground", second="inner", point=(0, 0, 0))
    scene.add_joint(kind="revolute", name="elbow", first="inner", second="outer", point=(1, 0, 0))
    scene.add_actuator(joint="root")
    scene.add_actuator(joint="elbow")
    inertia = reflected_inertia(scene)
    assert inertia["elbow"] == pytest.approx(0.4 + 2.0 * 0.36, rel=1e-9)
    assert inertia["root"] == pytest.approx(0.3 + 3.0 * 0.25 + 0.4 + 2.0 * (1.0 + 0.36), rel=1e-9)


def test_reflected_inertia_of_a_cylinder_is_that_of_its_jib_over_the_lever_arm_squared() -> None:
    """The jib weighs; cylinder, barrel and rod do not: m = J / (dq/ds)^-2 with law of cosines."""
    scene = Scene(gravity=9.81)
    jib = np.array([2.0, 0.0, 0.0])
    foot, head = np.array([0.0, 0.0, -1.0]), np.array([1.0, 0.0, 0.0])
    along = (head - foot) / np.linalg.norm(head - foot)
    scene.add_body(name="jib", mass=10.0, inertia=(0.1, 3.0, 3.0), position=jib)
    for name, at in (("barrel", 0.3), ("rod", 0.7)):
        scene.add_body(name=name, mass=1e-6, inertia=(1e-7, 1e-7, 1e-7), position=foot + at * (head - foot))
    across = (0.0, 1.0, 0.0)
    scene.add_joint(kind="revolute", name="C", first="ground", second="jib", point=(0, 0, 0), axis=across)
    scene.add_joint(
        kind="universal",
        name="B",
        first="ground",
        second="barrel",
        point=foot,
        axis=across,
        second_axis=np.cross(across, along),
    )
    scene.add_joint(kind="spherical", name="D", first="rod", second="jib", point=head)
    scene.add_joint(kind="prismatic", name="cylinder", first="barrel", second="rod", point=foot, axis=along)
    scene.add_actuator(joint="cylinder")
    lever = np.linalg.norm(np.cross(head, along))  # of the cylinder's line about C
    expected = (3.0 + 10.0 * 4.0) / lever**2
    assert reflected_inertia(scene)["cylinder"] == pytest.approx(expected, rel=1e-5)
