"""Jumps, ranges and half turns of what a driver or an actuator is asked to follow are not passed over."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from named import on_joint

from seacrane import Curve, Frame, Result, Run, Scene, simulate
from seacrane.errors import SceneError
from seacrane.warnings import (
    FullTurnWarning,
)

WEIGHT = 10e3 * 9.80665


def rail(curve: Curve | None = None, **actuator: Any) -> Scene:
    """10 t on a vertical rail, driven or held by an actuator."""
    scene = on_joint("load", mass=10e3, inertia=1e4, axis=(0, 0, 1))
    if curve is not None:
        scene.add_driver("rail", curve=curve)
    if actuator:
        scene.add_actuator(name="winch", joint="rail", **actuator)
    return scene


def slewing(**actuator: Any) -> Scene:
    """A turntable with an actuator: critically damped at 2 rad/s."""
    scene = on_joint("table", kind="revolute", joint="pin", axis=(0, 0, 1), gravity=0.0)
    scene.add_actuator(name="slew", joint="pin", **{"stiffness": 4.0, "damping": 4.0, **actuator})
    return scene


def turned(result: Result) -> float:
    """Degrees in all, counted by the body's own rate."""
    rate = result["angular_velocity"][:, 0, 2]
    return float(np.degrees(np.sum(0.5 * (rate[1:] + rate[:-1]) * np.diff(result.time))))


def to(end: float, *, until: float = 1.0) -> Curve:
    return Curve.quintic(start_time=0.0, end_time=until, start=0.0, end=end)


def jump(end: float, *, time: float = 1.0) -> Curve:
    return Curve.constant(value=0.0).then(time=time, curve=Curve.constant(value=end))


def out_of_range_between_its_ends() -> None:
    scene = rail(Curve.harmonic(amplitude=1.2, omega=2.0, phase=-np.pi / 2))
    scene.add_channel(joint="rail", minimum=-1.0, maximum=1.0)
    simulate(scene, t_end=np.pi)


def out_of_stroke(stroke: float, driver: bool) -> None:
    """Of the data file's 0 to 5 m, from the described stroke of 1 m on."""
    scene, reference = Scene(name="crane"), to(stroke, until=10.0)
    scene.add_crane(base="ground", s1=1.0, s2=1.0)
    if driver:
        scene.add_driver("main_cylinder", curve=reference, name="main")
    else:
        scene.add_actuator("main_cylinder", reference=reference, stiffness=1.0, name="main")
    simulate(scene, t_end=20.0)


REFUSED: dict[str, Callable[[], Any]] = {
    r"driver 'rail.displacement'.*jumps by 2 m at t = 1 s": lambda: simulate(rail(jump(2.0)), t_end=2.0),
    r"jumps by 200 deg at t = 1 s, half a turn or more": lambda: simulate(
        slewing(reference=jump(np.radians(200.0))), t_end=2.0
    ),
    r"input 'slew.reference' jumps by 200 deg": lambda: Run(slewing(), t_end=1.0).set_inputs(
        {"slew.reference": np.radians(200.0)}
    ),
    r"asks for rail.displacement = -?1\.[12]": out_of_range_between_its_ends,
    r"driver 'main': asks for .* = 4.5 .*outside its range of -1 to 4": lambda: out_of_stroke(4.5, True),
    r"actuator 'main': asks for .* = -1.5 .*outside its range of -1 to 4": lambda: out_of_stroke(-1.5, False),
}


@pytest.mark.parametrize("told", REFUSED)
def test_what_cannot_be_followed_is_refused_with_its_time_and_size(told: str) -> None:
    with pytest.raises(SceneError, match=told):
        REFUSED[told]()


def test_what_is_smooth_or_outside_the_run_or_of_an_actuator_along_a_slide_passes() -> None:
    assert simulate(rail(jump(2.0, time=3.0)), t_end=2.0)["coordinate"][-1, 0] == pytest.approx(0.0)
    assert simulate(rail(to(2.0)), t_end=2.0)["coordinate"][-1, 0] == pytest.approx(2.0)
    stepped = rail(reference=jump(0.5), stiffness=4e5, damping=1e5, feed_forward=WEIGHT)
    assert simulate(stepped, t_end=9.0)["coordinate"][-1, 0] == pytest.approx(0.5, abs=1e-3)
    crank, row = slewing(), [0, 2 * np.pi, 0, 0, 0, 0]  # whole turns are no jumps of an angle
    crank.actuators.clear()
    crank.add_driver("pin", curve=Curve.pieces(starts=[0.0, 1.0], coefficients=[row, row]))
    with pytest.warns(FullTurnWarning, match="recorded between -180 and 180"):
        assert turned(simulate(crank, t_end=2.0)) == pytest.approx(720.0)


@pytest.mark.parametrize("degrees", [-270.0, 720.0])
def test_a_reference_that_leads_beyond_half_a_turn_is_followed_all_the_way(degrees: float) -> None:
    with pytest.warns(FullTurnWarning, match="is recorded between -180 and 180 deg"):
        result = simulate(slewing(reference=to(np.radians(degrees), until=20.0)), t_end=30.0, dt_out=0.05)
    assert turned(result) == pytest.approx(degrees, abs=0.1)
    assert "half a turn from its reference" not in result.stats["validity"]


def test_an_angle_that_falls_half_a_turn_behind_is_warned_of() -> None:
    lead = to(np.radians(300.0), until=0.2)
    with pytest.warns(FullTurnWarning, match=r"'slew': came to be half a turn from its reference 1 time"):
        result = simulate(slewing(reference=lead, damping=0.4), t_end=40.0)
    assert turned(result) == pytest.approx(-60.0, abs=1.0)


@pytest.mark.parametrize(("coordinate", "axis"), [("roll", 0), ("yaw", 2)])
def test_a_spring_about_a_free_joint_is_harmonic_through_half_a_turn(coordinate: str, axis: int) -> None:
    """Closed form: 3 rad + 0.5 sin(2 t), which passes 180 deg both ways."""
    scene, start, own = Scene(gravity=0.0), np.zeros(4), Frame()
    start[0], start[1 + axis] = np.cos(1.5), np.sin(1.5)
    state = {"quaternion": start, "angular_velocity": np.eye(3)[axis]}
    scene.add_body("body", mass=1.0, inertia=[1, 1, 1], **state)
    frames = {"first_frame": own, "second_frame": own}
    scene.add_joint("motion", kind="free", first="ground", second="body", **frames)
    scene.add_actuator(name="spring", joint="motion", coordinate=coordinate, stiffness=4.0, reference=3.0)
    result = simulate(scene, t_end=5.0, rtol=1e-9)
    angle = 2.0 * np.unwrap(np.arctan2(result["quaternion"][:, 0, 1 + axis], result["quaternion"][:, 0, 0]))
    np.testing.assert_allclose(angle, 3.0 + 0.5 * np.sin(2.0 * result.time), atol=1e-6)
