"""Wind and current by coefficients against closed forms."""

from __future__ import annotations

from contextlib import nullcontext
from typing import Any

import numpy as np
import pytest

from seacrane import Curve, FlowCoefficients, Scene, SceneError, _core, simulate
from seacrane.analysis import Evaluator
from seacrane.arrays import Array
from seacrane.scene import gust_curve
from seacrane.scene.wind_current import npd_spectrum
from seacrane.sea import jonswap, realise_waves
from seacrane.warnings import DoubleCountedDampingWarning

MASS = 2e6
AREAS: dict[str, float] = {"frontal_area": 400.0, "lateral_area": 1500.0, "length": 100.0}


def smooth() -> FlowCoefficients:
    """Even and odd functions of the angle, half a circle of them."""
    angle = np.linspace(0.0, np.pi, 37)
    y, yaw = 0.9 * np.sin(angle), 0.1 * np.sin(2.0 * angle)
    y[[0, -1]] = yaw[[0, -1]] = 0.0
    return FlowCoefficients(angle=angle, x=0.8 * np.cos(angle), y=y, yaw=yaw)


FLOW: dict[str, Any] = {"coefficients": smooth(), "body": "block", **AREAS}


def block(**pose: Any) -> Scene:
    """A free body without weight, its centre of mass off its origin."""
    scene = Scene(name="block")
    of: dict[str, Any] = {"mass": MASS, "inertia": [1e9, 2e9, 3e9], "center_of_mass": (1.0, 2.0, 3.0)}
    scene.add_body(name="block", gravity=False, **of, **pose)
    return scene


def wrench(scene: Scene, t: float = 0.0) -> Array:
    """Force and moment about the centre of mass, inertial axes, from the accelerations."""
    model = scene.compile()
    terms = Evaluator(model).terms(t, model.initial_state)
    return np.asarray(terms["mass"] @ terms["acceleration"])


def yawed(yaw: float) -> dict[str, Any]:
    return {"quaternion": (np.cos(yaw / 2.0), 0.0, 0.0, np.sin(yaw / 2.0))}


@pytest.mark.parametrize("yaw", [0.5, -2.9])
def test_the_load_is_what_the_formula_says(yaw: float) -> None:
    """Which turns with everything, opposes the flow, and is the mirror image from port and starboard."""
    point = np.array([10.0, -4.0, 12.0])
    for direction_deg in (0.0, 37.0, 140.0, -75.0, 180.0):
        scene = block(**yawed(yaw), velocity=(1.5, -0.7, 0.4))
        scene.add_wind(speed=20.0, direction_deg=direction_deg, point=point, **FLOW)
        b = np.radians(direction_deg)
        relative = 20.0 * np.array([np.cos(b), np.sin(b)]) - [1.5, -0.7]
        angle = np.arctan2(relative[1], relative[0]) - yaw
        q = 0.5 * 1.226 * relative @ relative
        along, across = q * 400.0 * 0.8 * np.cos(angle), q * 1500.0 * 0.9 * np.sin(angle)
        c, s = np.cos(yaw), np.sin(yaw)
        force = np.array([c * along - s * across, s * along + c * across, 0.0])
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        moment = np.cross(turn @ (point - [1.0, 2.0, 3.0]), force)
        moment[2] += q * 1500.0 * 100.0 * 0.1 * np.sin(2.0 * angle)
        # Splines through points 5 deg apart: 1e-6 of the coefficient, the double angle 16 times that.
        np.testing.assert_allclose(wrench(scene)[:3], force, atol=2e-6 * q * 1500.0)
        np.testing.assert_allclose(wrench(scene)[3:], moment, atol=2e-5 * q * 1500.0 * 100.0)


def test_a_drifting_body_takes_up_the_current_as_the_closed_form_says() -> None:
    """m dw/dt = - k w^2 for the speed w through the water: w = w0 / (1 + k w0 t / m)."""
    scene = block(velocity=(-1.0, 0.0, 0.0))
    scene.add_current(speed=1.5, direction_deg=0.0, point=(1.0, 2.0, 3.0), **FLOW)
    result = simulate(scene, t_end=200.0, dt_out=5.0, rtol=1e-10)
    k, start = 0.5 * 1025.0 * 400.0 * 0.8, 2.5
    through_water = start / (1.0 + k * start * result.time / MASS)
    np.testing.assert_allclose(result.channels["velocity"][:, 0, 0], 1.5 - through_water, atol=1e-8)
    # In axes that move with the water the load only takes energy away.
    energy = 0.5 * MASS * np.sum((result.channels["velocity"][:, 0] - [1.5, 0.0, 0.0]) ** 2, axis=1)
    assert np.all(np.diff(energy) < 0.0)
    assert np.abs(result.channels["energy_balance"]).max() < 1e-8 * result.channels["absolute_work"][-1]


def test_gusts_follow_their_curve_and_a_jump_restarts_the_integration() -> None:
    scene = block()
    speed = Curve.constant(value=10.0).then(time=5.0, curve=Curve.constant(value=20.0))
    scene.add_wind(speed=speed, direction_deg=0.0, point=(1.0, 2.0, 3.0), **FLOW)
    assert scene.compile().breakpoints == [5.0]
    assert wrench(scene, t=6.0)[0] == pytest.approx(4.0 * wrench(scene, t=1.0)[0], rel=1e-12)
    # V = 10 m/s until 5 s, then 20: both stretches have the closed form of the current above.
    result = simulate(scene, t_end=10.0, dt_out=5.0, rtol=1e-10)
    k, v = 0.5 * 1.226 * 400.0 * 0.8 / MASS, result.channels["velocity"][:, 0, 0]
    after5 = 10.0 - 10.0 / (1.0 + k * 10.0 * 5.0)
    left = 20.0 - after5
    assert v[1] == pytest.approx(after5, abs=1e-9)
    assert v[2] == pytest.approx(20.0 - left / (1.0 + k * left * 5.0), abs=1e-9)


def test_gusts_have_the_variance_of_their_spectrum() -> None:
    curve = gust_curve(mean_speed=20.0, duration=3600.0, seed=3)
    times = np.arange(0.0, 3600.0, 0.5)
    speed = curve.evaluate(times)[:, 0]
    f = np.geomspace(1.0 / 600.0, 0.5, 20001)
    variance = np.trapezoid(npd_spectrum(f, mean_speed=20.0), f)
    assert speed.mean() == pytest.approx(20.0, abs=0.2)
    assert speed.var() == pytest.approx(float(variance), rel=0.15)
    assert npd_spectrum(0.0, mean_speed=10.0) == pytest.approx(320.0)
    low = npd_spectrum(f, mean_speed=10.0)  # one curve of 172 f (z / 10)^(2/3) (U / 10)^(-3/4)
    assert npd_spectrum(f * 2.0**0.75, mean_speed=20.0) == pytest.approx(4.0 * low)
    assert npd_spectrum(f / 4.0, mean_speed=10.0, height=80.0) == pytest.approx(8.0**0.45 * low)
    assert curve.evaluate(np.array([4000.0]))[0, 0] == pytest.approx(speed[-1], abs=2.0)
    other = gust_curve(mean_speed=20.0, duration=3600.0, seed=4).evaluate(times[:100])
    assert np.abs(speed[:100] - other[:, 0]).max() > 1.0


def test_gusts_and_waves_of_one_seed_share_no_random_number(monkeypatch: pytest.MonkeyPatch) -> None:
    """Streams drawn for the gust are none of a sea's: phases of both are uncorrelated, not the same."""
    drawn: dict[int, list[float]] = {}
    uniform = _core.philox_uniform

    def spy(*, stream: int, **at: int) -> float:
        drawn.setdefault(stream, []).append(uniform(stream=stream, **at))
        return drawn[stream][-1]

    monkeypatch.setattr(_core, "philox_uniform", spy)
    gust_curve(mean_speed=12.0, duration=20.0, seed=1)
    assert len(drawn) == 2 and min(drawn) > 3 * 10**6
    waves = realise_waves(jonswap(hs=2.0, tp=8.0), seed=1, direction=0.0)
    wave_phase = np.array(waves.phase) / (2.0 * np.pi)
    for own in drawn.values():
        assert len(own) == len(wave_phase) == 200 and not set(own) & set(wave_phase)
        assert abs(np.corrcoef(own, wave_phase)[0, 1]) < 0.25  # 200 independent pairs: 0.07


def test_damping_that_counts_twice_is_named() -> None:
    for damping, told in (([0.0, 5e3, 0.0, 0.0, 0.0, 0.0], True), ([0.0, 0.0, 0.0, 5e3, 0.0, 0.0], False)):
        scene = block()
        scene.add_vessel(body="block", quadratic_damping=damping)
        with pytest.warns(DoubleCountedDampingWarning, match="twice") if told else nullcontext():
            scene.add_current(speed=1.0, direction_deg=0.0, **FLOW)


def test_bad_values_are_refused() -> None:
    angle = [0.0, 1.0, 2.0, np.pi]
    good = {"angle": angle, "x": [1.0, 0.5, -0.5, -1.0], "y": [0.0, 0.5, 0.5, 0.0], "yaw": [0.0] * 4}
    for change, message in (
        ({"y": [0.1, 0.5, 0.5, 0.0]}, "symmetric"), ({"angle": [0.0, 1.0, 0.9, np.pi]}, "increase"),
        ({"angle": [0.0, 0.1, 0.2, 0.3]}, "90 deg apart"), ({"angle": [0.0, 1.0, 2.0, 7.0]}, "one turn"),
    ):  # fmt: skip
        scene = block()
        with pytest.raises(SceneError, match=message):
            coefficients = FlowCoefficients(**(good | change))
            scene.add_wind(speed=10.0, direction_deg=0.0, **(FLOW | {"coefficients": coefficients}))
            scene.compile()
    scene = block()
    scene.add_wind(speed=1.0, direction_deg=0.0, **FLOW)
    ends = {"bodies": ["ground", "block"], "points": [[0, 0, 9], [0, 0, 0]], "EA": 1e6, "length": 9.0}
    with pytest.raises(SceneError, match="line 'wind': the name is used twice"):
        scene.add_line(name="wind", **ends)
