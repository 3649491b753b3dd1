"""Active heave compensation against closed forms: filter, lag, drive, bounds, winch, cylinder."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from heave_scenes import MASS, ROPE, STIFFNESS, TIP, G, amplitude_of, compensated, heaving, hung, transfer
from multibody_runs import record
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from seacrane import SampledController, Scene, SceneError, linear_model, simulate
from seacrane.crane import load_crane
from seacrane.scene import Drive

OMEGA = 0.7


@pytest.mark.parametrize(
    "settings", [{"lag": 0.3}, {"lag": 0.3, "lag_order": 2, "drive": Drive(frequency=1.2), "gain": 0.95}]
)
def test_the_residual_is_one_minus_h(settings: dict[str, Any]) -> None:
    """In the time domain, once the filter's start has died out."""
    settings = settings | {"high_pass": 0.1}
    scene = heaving(omega=OMEGA)
    scene.add_heave_compensation(name="ahc", body="ship", point=(0, 3, TIP), **settings)
    out = record(scene, 45.0, dt_out=0.1, rtol=1e-9)
    left = out["position"][:, 0, 2] - out["heave_stroke"][:, 0]
    found = amplitude_of(out["time"], left, OMEGA, 25.0)
    expected = -1j * (1.0 - transfer(OMEGA, **settings))
    assert found == pytest.approx(expected, abs=2e-6)
    assert_allclose(out["heave_stroke"], out["heave_reference"], atol=1e-7)


@pytest.mark.parametrize(
    ("falls", "winch_lag", "lag", "rung", "heave", "within"),
    [(2, 0.15, 0.3, "elastic", 1.0, 3e-3), (1, 0.1, 0.2, "quasi-static", 0.1, 1e-4)],
)
def test_a_winch_leaves_the_load_the_residual(
    falls: int, winch_lag: float, lag: float, rung: str, heave: float, within: float
) -> None:
    """The load hangs on n falls, whose rope the ratio multiplies; the wire's own stretch is below 1 %."""
    scene = hung(falls, winch_lag, rung, omega=OMEGA, amplitude=heave)
    told = {"high_pass": 0.08, "lag": lag}
    scene.add_heave_compensation(name="ahc", body="ship", point=(0, 0, TIP), winch="hoist", **told)
    assert scene.loads["ahc"].ratio == pytest.approx(falls, rel=1e-12)
    out = record(scene, 40.0, dt_out=0.1, rtol=1e-7)
    found = amplitude_of(out["time"], out["position"][:, 1, 2], OMEGA, 20.0)
    left = 1.0 - transfer(OMEGA, winch_lag=winch_lag, **told)
    assert found == pytest.approx(-1j * heave * left, abs=within)
    assert np.max(np.abs(out["energy_balance"])) < 1e-5 * out["absolute_work"][-1]


def test_the_linear_model_of_a_coupled_scene_has_the_closed_form() -> None:
    """Load over ship is G (1 - H) with G the hanging load's; the ship feels the tension.

    A metre of rope that is paid out takes 1 + strain metres of the stretched wire.
    """
    settings: dict[str, Any] = {"lag": 0.3, "high_pass": 0.03, "drive": Drive(frequency=1.0)}
    scene = hung()
    scene.remove("wave")
    weight = (1e6 + MASS) * G
    scene.add_actuator(joint="sea", name="springs", stiffness=2e6, damping=2e5, feed_forward=weight)
    scene.add_heave_compensation(name="ahc", body="ship", point=(0, 0, TIP), winch="hoist", **settings)
    model = linear_model(scene)
    ship, load = model.output(body="ship")[2], model.output(body="load")[2]
    push = np.zeros(len(model.a))
    n = model.degrees_of_freedom
    push[n : 2 * n] = np.linalg.solve(model.basis.T @ model.mass @ model.basis, model.basis[2])
    k = STIFFNESS / ROPE
    c = 2.0 * 0.05 * np.sqrt(k * MASS)
    for omega in (0.3, 0.7, 1.5, 4.0, 12.0):
        p = 1j * omega
        x = np.linalg.solve(p * np.eye(len(model.a)) - model.a, push)
        h = transfer(omega, **settings) * (1.0 + MASS * G / STIFFNESS)
        of_load = (k + c * p) / (MASS * p**2 + k + c * p) * (1.0 - h)
        assert (load @ x) / (ship @ x) == pytest.approx(of_load, rel=1e-5)
        pulled = MASS * p**2 * of_load
        of_ship = 1.0 / (1e6 * p**2 + 2e5 * p + 2e6 + pulled)
        assert ship @ x == pytest.approx(of_ship, rel=1e-4)


def test_bounds_on_rate_and_stroke_are_kept_located_and_told() -> None:
    """Against SciPy on the compensator's own equations."""
    scene = compensated(lag=0.2, drive=Drive(maximum_rate=0.5, maximum_stroke=0.6, settling=0.3))
    result = simulate(scene, 20.0, dt_out=0.05, rtol=1e-9)
    rate, stroke = result["heave_stroke_rate"][:, 0], result["heave_stroke"][:, 0]
    assert np.max(np.abs(rate)) <= 0.5 + 1e-9
    assert np.max(np.abs(stroke)) < 0.6

    def equations(t: float, x: Any) -> list[float]:
        behind = (x[0] - x[1]) / 0.2
        wanted = behind + (x[1] - x[2]) / 0.3
        high, low = min(0.5, (0.6 - x[2]) / 0.3), max(-0.5, (-0.6 - x[2]) / 0.3)
        return [OMEGA * np.cos(OMEGA * t), behind, float(np.clip(wanted, low, high))]

    fine, how = np.linspace(0.0, 20.0, 8001), {"rtol": 1e-9, "atol": 1e-10, "max_step": 5e-3}
    x = solve_ivp(equations, (0.0, 20.0), [0.0, 0.0, 0.0], t_eval=fine, **how).y
    assert_allclose(stroke, x[2][::20], atol=2e-6)
    wanted = (x[0] - x[1]) / 0.2 + (x[1] - x[2]) / 0.3
    left = (0.6 - np.sign(wanted) * x[2]) / 0.3
    at = np.where(np.abs(wanted) > np.minimum(left, 0.5), np.where(left < 0.5, 2, 1), 0)
    entered = np.flatnonzero((np.diff(at) != 0) & (at[1:] != 0)) + 1
    told = [event for event in result.events if event.kind == "limit"]
    assert [event.name for event in told] == ["ahc.stroke" if at[i] == 2 else "ahc.rate" for i in entered]
    assert len(told) >= 10
    assert_allclose([event.time for event in told], fine[entered], atol=3e-3)


def cylinder(k: float, c: float, **settings: Any) -> Scene:
    """A ship with a slide at its tip, whose position an actuator controls; the load sits on the slide."""
    scene, top = heaving(omega=OMEGA), (0, 0, TIP)
    scene.add_body(name="slide", mass=MASS, inertia=(1e3, 1e3, 1e3), position=top)
    scene.add_joint(
        kind="prismatic", name="cylinder", first="ship", second="slide", point=top, axis=(0, 0, 1)
    )
    scene.add_actuator(joint="cylinder", stiffness=k, damping=c, feed_forward=MASS * G)
    if settings:
        scene.add_heave_compensation(
            "ahc", body="ship", point=top, actuator="cylinder", ratio=-1.0, **settings
        )
    return scene


def test_a_cylinder_leaves_the_load_the_residual() -> None:
    """The loop of stiffness and damping follows its reference by (k + c p) / (m p^2 + c p + k)."""
    settings: dict[str, Any] = {"lag": 0.2, "high_pass": 0.08}
    k, c = 4e4, 8e3  # a loop as soft as to be seen
    out = record(cylinder(k, c, **settings), 40.0, dt_out=0.1, rtol=1e-8)
    found = amplitude_of(out["time"], out["position"][:, 1, 2], OMEGA, 20.0)
    p = 1j * OMEGA
    loop = k + c * p  # m x'' = (k + c p)(z - H z - x)
    expected = -1j * loop * (1.0 - transfer(OMEGA, **settings)) / (MASS * p**2 + loop)
    assert found == pytest.approx(expected, abs=1e-5)


def test_a_controller_in_python_takes_the_place_of_the_compiled_one() -> None:
    """Within what sampling loses, which is of the first order in the period."""
    lag, errors, how = 0.3, [], {"dt_out": 0.1, "rtol": 1e-8}
    compiled = simulate(cylinder(4e5, 4e4, lag=lag, high_pass=0.0), 6.0, **how)
    for period in (0.02, 0.01):
        lagged = [0.0]

        def control(_: float, measured: Any, period: float = period, lagged: list[float] = lagged) -> Any:
            held = lagged[0]
            rate = (float(measured["position"][0, 2]) - held) / lag
            lagged[0] += rate * period * (1.0 - 0.5 * period / lag)
            return {"cylinder.reference": -held, "cylinder.reference_rate": -rate}

        ticks = [SampledController(period=period, function=control)]
        by_hand = simulate(cylinder(4e5, 4e4), 6.0, controllers=ticks, **how)
        errors.append(np.max(np.abs(by_hand["position"][:, 1, 2] - compiled["position"][:, 1, 2])))
    assert errors[1] < 0.01 and 1.5 < errors[0] / errors[1] < 3.0


def test_the_ratio_of_a_cylinder_is_that_of_the_tip() -> None:
    """Against the tip's height over the stroke, from the crane's geometry."""
    pose, step = {"slew": -1.0, "s1": 1.0, "s2": 1.5}, 1e-5
    crane = load_crane()
    high, low = (crane.tip(**pose | {"s2": 1.5 + sign * step}) for sign in (1.0, -1.0))
    scene = Scene(name="on land")
    scene.add_crane(base="ground", **pose)
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        scene.add_actuator(joint=joint)
    scene.add_heave_compensation(name="ahc", body="boom", actuator="knuckle_cylinder")
    assert scene.loads["ahc"].ratio == pytest.approx(-2.0 * step / (high - low)[2], rel=1e-6)
    with pytest.raises(SceneError, match=r"'A' does not move the load along the direction in the described"):
        scene.add_heave_compensation(name="slew", body="boom", actuator="A")


@pytest.mark.parametrize(
    ("given", "message"),
    [({"winch": None, "actuator": "boom"}, "no actuator 'boom'"),
     ({"actuator": "boom"}, "moves winch 'hoist' and actuator 'boom'"),
     ({"direction": (1, 0, 0)}, "'hoist' does not move the load"),
     ({"direction": (0, 0, 0), "ratio": 1.0}, "direction is zero"),
     ({"name": "second"}, "winch 'hoist' follows 'ahc' already")],
)  # fmt: skip
def test_compensators_that_cannot_be_are_told(given: dict[str, Any], message: str) -> None:
    scene = compensated() if "name" in given else hung()
    settings = {"name": "ahc", "body": "ship", "point": (0, 0, TIP), "winch": "hoist"} | given
    with pytest.raises(SceneError, match=f"'{settings['name']}': .*{message}"):
        scene.add_heave_compensation(**settings)
        scene.compile()
