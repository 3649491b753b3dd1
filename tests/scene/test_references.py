"""What a driver or an actuator is asked to follow: jumps, ranges and half turns are not passed over."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest

from seacrane import (
    Curve,
    Frame,
    Result,
    Run,
    SampledController,
    Scene,
    SceneError,
    SimulationError,
    simulate,
)
from seacrane.warnings import (
    DriverImpulseWarning,
    FreeCraneWarning,
    FullTurnWarning,
    OutsideRangeWarning,
    SoftGainsWarning,
)


def rail(curve: Curve | None = None, **actuator: object) -> Scene:
    """10 t on a vertical rail, driven or held by an actuator."""
    scene = Scene(name="hoist")
    scene.add_body(name="load", mass=10e3, inertia=[1e4, 1e4, 1e4])
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="load", axis=(0, 0, 1))
    scene.record_coordinate(joint="rail")
    if curve is not None:
        scene.add_driver(joint="rail", curve=curve)
    if actuator:
        scene.add_actuator(name="winch", joint="rail", **actuator)
    return scene


def slewing(**actuator: object) -> Scene:
    """A turntable with an actuator: critically damped at 2 rad/s."""
    scene = Scene(name="turntable", gravity=0.0)
    scene.add_body(name="table", mass=1.0, inertia=[1, 1, 1])
    scene.add_joint(kind="revolute", name="pin", first="ground", second="table", axis=(0, 0, 1))
    scene.record_coordinate(joint="pin")
    scene.add_actuator(name="slew", joint="pin", **{"stiffness": 4.0, "damping": 4.0, **actuator})
    return scene


def turned(result: Result) -> float:
    """Degrees in all, counted by the body's own rate."""
    rate = result["angular_velocity"][:, 0, 2]
    return float(np.degrees(np.sum(0.5 * (rate[1:] + rate[:-1]) * np.diff(result.time))))


def crane(*, held: bool | None = None) -> Scene:
    scene = Scene(name="crane")
    scene.add_crane(base="ground", s1=1.0, s2=1.0, held=held)
    return scene


@pytest.fixture(autouse=True)
def _no_other_warnings() -> object:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def test_a_driver_s_reference_that_jumps_is_refused_with_its_time_and_size() -> None:
    jump = Curve.constant(value=0.0).then(time=1.0, curve=Curve.constant(value=2.0))
    with pytest.raises(SceneError, match=r"driver 'rail.displacement'.*jumps by 2 m at t = 1 s"):
        simulate(rail(jump), t_end=2.0)


def test_a_jump_outside_the_run_is_no_jump_of_it() -> None:
    jump = Curve.constant(value=0.0).then(time=3.0, curve=Curve.constant(value=2.0))
    assert simulate(rail(jump), t_end=2.0)["coordinate"][-1, 0] == pytest.approx(0.0)


def test_a_driver_s_rate_that_jumps_is_warned_of() -> None:
    ramp = Curve.pieces(starts=[1.0, 2.0], coefficients=[[0, 0.5, 0, 0, 0, 0], [0.5, 0, 0, 0, 0, 0]])
    with pytest.warns(DriverImpulseWarning, match=r"jumps in rate by 0.5 m/s at t = 1 s"):
        simulate(rail(ramp), t_end=3.0)


def test_smooth_references_and_whole_turns_of_an_angle_pass() -> None:
    lift = Curve.quintic(start_time=0.0, end_time=1.0, start=0.0, end=2.0)
    assert simulate(rail(lift), t_end=2.0)["coordinate"][-1, 0] == pytest.approx(2.0)
    scene = Scene(gravity=0.0)
    scene.add_body(name="crank", mass=1.0, inertia=[1, 1, 1])
    scene.add_joint(kind="revolute", name="pin", first="ground", second="crank")
    turns = {"starts": [0.0, 1.0], "coefficients": [[0, 2 * np.pi, 0, 0, 0, 0], [0, 2 * np.pi, 0, 0, 0, 0]]}
    scene.add_driver(joint="pin", curve=Curve.pieces(**turns))
    assert turned(simulate(scene, t_end=2.0)) == pytest.approx(720.0)


def test_an_actuator_may_be_asked_to_jump_along_a_slide() -> None:
    step = Curve.constant(value=0.0).then(time=1.0, curve=Curve.constant(value=0.5))
    gains = {"stiffness": 4e5, "damping": 1e5, "feed_forward": 10e3 * 9.80665}
    assert simulate(rail(reference=step, **gains), t_end=9.0)["coordinate"][-1, 0] == pytest.approx(
        0.5, abs=1e-3
    )


@pytest.mark.parametrize("degrees", [270.0, -270.0, 180.0, 360.0])
def test_a_reference_half_a_turn_from_the_start_is_refused(degrees: float) -> None:
    with pytest.raises(SceneError, match=rf"actuator 'slew'.*starts {degrees:g} deg from the angle"):
        simulate(slewing(reference=np.radians(degrees)), t_end=1.0)


@pytest.mark.parametrize("degrees", [270.0, -270.0, 720.0])
def test_a_reference_that_leads_beyond_half_a_turn_is_followed_all_the_way(degrees: float) -> None:
    lead = Curve.quintic(start_time=0.0, end_time=20.0, start=0.0, end=np.radians(degrees))
    with pytest.warns(FullTurnWarning, match="is recorded between -180 and 180 deg"):
        result = simulate(slewing(reference=lead), t_end=30.0, dt_out=0.05)
    assert turned(result) == pytest.approx(degrees, abs=0.1)
    assert "half a turn from its reference" not in result.stats["validity"]


def test_a_reference_that_jumps_by_half_a_turn_is_refused() -> None:
    jump = Curve.constant(value=0.0).then(time=1.0, curve=Curve.constant(value=np.radians(200.0)))
    with pytest.raises(SceneError, match=r"jumps by 200 deg at t = 1 s, half a turn or more"):
        simulate(slewing(reference=jump), t_end=2.0)


def test_an_input_that_jumps_by_half_a_turn_is_refused() -> None:
    run = Run(slewing(), t_end=1.0)
    with pytest.raises(SceneError, match=r"input 'slew.reference' jumps by 200 deg"):
        run.set_inputs({"slew.reference": np.radians(200.0)})


def test_an_angle_that_falls_half_a_turn_behind_is_warned_of() -> None:
    lead = Curve.quintic(start_time=0.0, end_time=0.2, start=0.0, end=np.radians(300.0))
    with pytest.warns(
        FullTurnWarning, match=r"actuator 'slew': came to be half a turn from its reference 1 time"
    ):
        result = simulate(slewing(reference=lead, stiffness=4.0, damping=0.4), t_end=40.0)
    assert turned(result) == pytest.approx(-60.0, abs=1.0)


@pytest.mark.parametrize("coordinate", ["roll", "yaw"])
def test_a_spring_about_a_free_joint_s_angle_is_harmonic_through_half_a_turn(coordinate: str) -> None:
    """Closed form: 3 rad + 0.5 sin(2 t), which passes 180 deg both ways."""
    scene = Scene(gravity=0.0)
    axis = {"roll": 0, "yaw": 2}[coordinate]
    start = np.zeros(4)
    start[0], start[1 + axis] = np.cos(1.5), np.sin(1.5)
    scene.add_body(
        name="body", mass=1.0, inertia=[1, 1, 1], quaternion=start, angular_velocity=np.eye(3)[axis]
    )
    own = Frame()
    scene.add_joint(
        kind="free", name="motion", first="ground", second="body", first_frame=own, second_frame=own
    )
    scene.add_actuator(name="spring", joint="motion", coordinate=coordinate, stiffness=4.0, reference=3.0)
    result = simulate(scene, t_end=5.0, rtol=1e-9)
    angle = 2.0 * np.unwrap(np.arctan2(result["quaternion"][:, 0, 1 + axis], result["quaternion"][:, 0, 0]))
    np.testing.assert_allclose(angle, 3.0 + 0.5 * np.sin(2.0 * result.time), atol=1e-6)


@pytest.mark.parametrize(("stroke", "kind"), [(-1.5, "driver"), (4.5, "driver"), (-1.5, "actuator")])
def test_a_reference_outside_the_crane_s_strokes_is_refused(stroke: float, kind: str) -> None:
    """The data file's 0 to 5 m, from the described stroke of 1 m on."""
    scene = crane()
    reference = Curve.quintic(start_time=0.0, end_time=10.0, start=0.0, end=stroke)
    if kind == "driver":
        scene.add_driver(joint="main_cylinder", curve=reference, name="main")
    else:
        scene.add_actuator(joint="main_cylinder", reference=reference, stiffness=1.0, name="main")
    with pytest.raises(
        SceneError, match=rf"{kind} 'main': asks for .* = {stroke:g} .*outside its range of -1 to 4"
    ):
        simulate(scene, t_end=20.0)


def test_a_reference_that_leaves_the_range_between_its_ends_is_refused() -> None:
    scene = rail(Curve.harmonic(amplitude=1.2, omega=2.0, phase=-np.pi / 2))
    scene.add_range(joint="rail", minimum=-1.0, maximum=1.0)
    with pytest.raises(SceneError, match=r"asks for rail.displacement = -?1\.[12]"):
        simulate(scene, t_end=np.pi)


def test_a_stroke_that_leaves_its_range_in_a_run_is_warned_of() -> None:
    """Without a load along them the cylinders let the jibs fall."""
    scene = crane(held=False)
    with (
        pytest.warns(FreeCraneWarning, match="it falls"),
        pytest.warns(OutsideRangeWarning, match=r"range '\w+_cylinder'.*outside -1 to 4 from the described"),
    ):
        result = simulate(scene, t_end=3.0)
    assert "outside -1 to 4" in result.stats["validity"]


def test_ranges_are_kept_by_copies_and_files_and_checked(tmp_path: Path) -> None:
    scene = crane()
    scene.save(tmp_path / "crane.json")
    assert Scene.load(tmp_path / "crane.json").ranges == scene.ranges == scene.copy().ranges
    assert (scene.ranges["main_cylinder"].minimum, scene.ranges["main_cylinder"].maximum) == (-1.0, 4.0)
    with pytest.raises(SceneError, match="'main_cylinder': the name is used twice"):
        scene.add_range(joint="main_cylinder", minimum=0.0, maximum=1.0)
    with pytest.raises(SceneError, match="the minimum must be below the maximum"):
        scene.add_range(joint="A", minimum=1.0, maximum=1.0)


def test_gains_too_soft_for_the_load_are_warned_of_and_others_are_not() -> None:
    weight = 10e3 * 9.80665
    with pytest.warns(SoftGainsWarning, match=r"actuator 'winch': ends 0.98\d+ m from its reference"):
        simulate(rail(stiffness=1e5, damping=5e4), t_end=20.0)
    simulate(rail(stiffness=1e5, damping=5e4, feed_forward=weight), t_end=20.0)
    simulate(rail(stiffness=1e6, damping=2e5), t_end=20.0)


def test_a_reference_without_gains_is_warned_of() -> None:
    lead = Curve.quintic(start_time=0.0, end_time=5.0, start=0.0, end=1.0)
    with pytest.warns(SoftGainsWarning, match="ends 57.3 deg from its reference"):
        simulate(slewing(reference=lead, stiffness=0.0, damping=0.0), t_end=20.0)


def test_two_controllers_of_one_input_are_refused() -> None:
    def up(time: float, measured: object) -> dict[str, float]:
        return {"winch.force": 1.0}

    def down(time: float, measured: object) -> dict[str, float]:
        return {"winch.force": -1.0} if time > 0.25 else {}

    controllers = [SampledController(period=0.1, function=up), SampledController(period=0.2, function=down)]
    with pytest.raises(
        SimulationError, match=r"down'? sets input 'winch.force', which .*up'? sets too"
    ) as caught:
        simulate(rail(stiffness=1e6, damping=1e5), t_end=1.0, controllers=controllers)
    assert caught.value.result.time[-1] == pytest.approx(0.4, abs=0.11)


def test_two_controllers_of_different_inputs_work_together() -> None:
    def force(time: float, measured: object) -> dict[str, float]:
        return {"winch.force": 10e3 * 9.80665}

    def reference(time: float, measured: object) -> dict[str, float]:
        return {"winch.reference": 0.1}

    controllers = [SampledController(period=0.1, function=f) for f in (force, reference)]
    result = simulate(rail(stiffness=4e5, damping=1e5), t_end=10.0, controllers=controllers)
    assert result["coordinate"][-1, 0] == pytest.approx(0.1, abs=1e-3)
