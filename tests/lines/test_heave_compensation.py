"""Active heave compensation against closed forms: filter, lag, drive, bounds, winch, cylinder."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from heave_scenes import MASS, ROPE, STIFFNESS, TIP, G, amplitude_of, compensated, heaving, hung, transfer
from multibody_runs import record
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from seacrane import Curve, Result, Run, SampledController, Scene, SceneError, State, linear_model, simulate
from seacrane.analysis import Evaluator
from seacrane.crane import KnuckleBoomCrane

OMEGA = 0.7


@pytest.mark.parametrize("lag", [0.0, 0.1, 0.2, 0.4, 0.6])
@pytest.mark.parametrize("settings", [{}, {"lag_order": 2, "actuator_frequency": 1.2, "gain": 0.95}])
def test_the_residual_is_one_minus_h(lag: float, settings: dict[str, Any]) -> None:
    """In the time domain, once the filter's start has died out."""
    settings = settings | {"lag": lag, "high_pass": 0.1}
    scene = heaving(omega=OMEGA)
    scene.add_heave_compensation(name="ahc", body="ship", point=(0, 3, TIP), **settings)
    out = record(scene, 45.0, dt_out=0.1, rtol=1e-9)
    left = out["position"][:, 0, 2] - out["heave_stroke"][:, 0]
    found = amplitude_of(out["time"], left, OMEGA, 25.0)
    expected = -1j * (1.0 - transfer(OMEGA, **settings))
    assert found == pytest.approx(expected, abs=2e-6)
    assert_allclose(out["heave_stroke"], out["heave_reference"], atol=1e-7)


@pytest.mark.parametrize(("falls", "winch_lag", "lag"), [(1, 0.0, 0.0), (2, 0.15, 0.3)])
def test_a_winch_leaves_the_load_the_residual(falls: int, winch_lag: float, lag: float) -> None:
    """The load hangs on n falls, whose rope the ratio multiplies; the wire's own stretch is below 1 %."""
    scene = compensated(falls=falls, winch_lag=winch_lag, lag=lag, high_pass=0.08, heave={"omega": OMEGA})
    assert scene.loads["ahc"].ratio == pytest.approx(falls, rel=1e-12)
    out = record(scene, 40.0, dt_out=0.1, rtol=1e-7)
    found = amplitude_of(out["time"], out["position"][:, 1, 2], OMEGA, 20.0)
    left = 1.0 - transfer(OMEGA, high_pass=0.08, lag=lag, winch_lag=winch_lag)
    assert found == pytest.approx(-1j * left, abs=3e-3)
    assert abs(out["energy_balance"][-1]) < 1e-5 * out["absolute_work"][-1]


def test_a_quasi_static_line_follows_too() -> None:
    """Its stretch needs a smooth length, which the winch's lag gives."""
    scene = hung(lag=0.1, rung="quasi-static", omega=OMEGA, amplitude=0.1)
    settings: dict[str, Any] = {"lag": 0.2, "high_pass": 0.08}
    scene.add_heave_compensation(name="ahc", body="ship", point=(0, 0, TIP), winch="hoist", **settings)
    out = record(scene, 30.0, dt_out=0.1, rtol=1e-8)
    found = amplitude_of(out["time"], out["position"][:, 1, 2], OMEGA, 18.0)
    assert found == pytest.approx(-0.1j * (1.0 - transfer(OMEGA, winch_lag=0.1, **settings)), abs=1e-4)
    assert np.max(np.abs(out["energy_balance"])) < 1e-6 * out["absolute_work"][-1]


def coupled(**settings: Any) -> Scene:
    """A ship on springs, which the load pulls back; compensated by the winch."""
    scene = hung()
    del scene.drivers["wave"]
    stiffness = 2e6
    scene.add_actuator(joint="sea", name="springs", stiffness=stiffness, damping=2e5)
    scene.actuators["springs"] = type(scene.actuators["springs"])(
        name="springs", joint="sea", coordinate="displacement", stiffness=stiffness, damping=2e5,
        feed_forward=(1e6 + MASS) * 9.80665,
    )  # fmt: skip
    scene.add_heave_compensation(name="ahc", body="ship", point=(0, 0, TIP), winch="hoist", **settings)
    return scene


def test_the_linear_model_of_a_coupled_scene_has_the_closed_form() -> None:
    """Load over ship is G (1 - H) with G the hanging load's; the ship feels the tension.

    A metre of rope that is paid out takes 1 + strain metres of the stretched wire.
    """
    settings: dict[str, Any] = {"lag": 0.3, "high_pass": 0.03, "actuator_frequency": 1.0}
    scene = coupled(**settings)
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
    settings = {"lag": 0.2, "maximum_rate": 0.5, "maximum_stroke": 0.6, "settling": 0.3}
    scene = compensated(**settings, heave={"omega": OMEGA, "amplitude": 1.0})
    result = simulate(scene, 20.0, dt_out=0.05, rtol=1e-9)
    rate, stroke = result["heave_stroke_rate"][:, 0], result["heave_stroke"][:, 0]
    assert np.max(np.abs(rate)) <= 0.5 + 1e-9
    assert np.max(np.abs(stroke)) < 0.6

    def equations(t: float, x: Any) -> list[float]:
        behind = (x[0] - x[1]) / 0.2
        wanted = behind + (x[1] - x[2]) / 0.3
        high, low = min(0.5, (0.6 - x[2]) / 0.3), max(-0.5, (-0.6 - x[2]) / 0.3)
        return [OMEGA * np.cos(OMEGA * t), behind, float(np.clip(wanted, low, high))]

    fine = np.linspace(0.0, 20.0, 8001)
    x = solve_ivp(
        equations, (0.0, 20.0), [0.0, 0.0, 0.0], t_eval=fine, rtol=1e-9, atol=1e-10, max_step=5e-3
    ).y
    assert_allclose(stroke, x[2][::20], atol=2e-6)
    wanted = (x[0] - x[1]) / 0.2 + (x[1] - x[2]) / 0.3
    left = (0.6 - np.sign(wanted) * x[2]) / 0.3
    at = np.where(np.abs(wanted) > np.minimum(left, 0.5), np.where(left < 0.5, 2, 1), 0)
    entered = np.flatnonzero((np.diff(at) != 0) & (at[1:] != 0)) + 1
    told = [event for event in result.events if event.kind == "limit"]
    assert [event.name for event in told] == ["ahc.stroke" if at[i] == 2 else "ahc.rate" for i in entered]
    assert len(told) >= 10
    assert_allclose([event.time for event in told], fine[entered], atol=3e-3)
    # Where the rate's bound is first reached: wanted = 0.5 on the exact lag.
    first = told[0]
    assert first.name == "ahc.rate"
    p = OMEGA * 0.2
    rate_there = (
        OMEGA
        / (1.0 + p**2)
        * (np.cos(OMEGA * first.time) + p * np.sin(OMEGA * first.time) - np.exp(-first.time / 0.2))
    )
    assert rate_there == pytest.approx(0.5, abs=1e-5)
    assert result.stats["events"] == len(result.events)


def test_bounds_are_in_files_and_in_a_continued_run(tmp_path: Path) -> None:
    scene = compensated(lag=0.2, maximum_rate=0.3, heave={"omega": OMEGA})
    whole = simulate(scene, 8.0, dt_out=0.1)
    whole.save(tmp_path / "run.nc")
    assert Result.load(tmp_path / "run.nc").events == whole.events
    half = simulate(scene, 4.0, dt_out=0.1)
    rest = simulate(scene, 8.0, dt_out=0.1, start=half.state)
    assert [e.name for e in (*half.events, *rest.events)] == [e.name for e in whole.events]


@pytest.mark.warns(sometimes=["UnitWarning"])
@pytest.mark.parametrize("settings", [{"lag": 1e-3}, {"maximum_stroke": 1e-6, "lag": 0.1}])
def test_extremes(settings: dict[str, Any]) -> None:
    scene = compensated(**settings, heave={"omega": OMEGA})
    result = simulate(scene, 5.0, dt_out=0.05, rtol=1e-6)
    stroke = result["heave_stroke"][:, 0]
    heave = result["position"][:, 0, 2]
    if "maximum_stroke" in settings:
        assert 0.0 < np.max(stroke) <= 1e-6
        assert any(event.name == "ahc.stroke" for event in result.events)
    else:
        assert_allclose(stroke, heave, atol=1.1e-3 * OMEGA)


def moving_crane() -> Scene:
    """A boom that a compensator luffs, on a ship that heaves and rolls; another moves the load's winch."""
    scene = Scene(name="crane")
    scene.add_body(name="ship", mass=5e5, inertia=(5e7, 5e7, 5e7), velocity=(0.0, 0.0, 0.3))
    scene.add_joint(kind="free", name="sea", first="ground", second="ship", point=(0, 0, 0))
    for motion, k, held in (("x", 4e5, 0.0), ("y", 4e5, 0.0), ("z", 4e5, 9.80665 * 5.4e5),
                            ("roll", 4e7, 0.0), ("pitch", 4e8, 8e6), ("yaw", 4e7, 0.0)):  # fmt: skip
        scene.add_actuator(
            joint="sea", coordinate=motion, name=f"sea {motion}", stiffness=k, damping=0.05 * k,
            feed_forward=held,
        )  # fmt: skip
    scene.add_body(
        name="boom", mass=2e4, inertia=(1e4, 7e5, 7e5), position=(10.0, 0.0, 12.0), velocity=(0.0, 0.0, 0.3)
    )
    scene.add_joint(
        kind="revolute", name="pin", first="ship", second="boom", point=(0, 0, 12.0), axis=(0, 1, 0)
    )
    scene.add_actuator(joint="pin", name="luff", stiffness=4e8, damping=8e7, feed_forward=-6e6)
    scene.add_body(name="load", mass=2e4, inertia=(1e4, 1e4, 1e4), position=(20.0, 0.0, -8.0))
    scene.add_line(
        name="hoist", bodies=["boom", "load"], points=[(10.0, 0.0, 0.0), (0, 0, 0)], EA=2e8,
        length=20.0,
    )  # fmt: skip
    scene.add_winch(line="hoist", lag=0.1)
    scene.add_heave_compensation(
        name="by winch", body="boom", point=(10, 0, 0), winch="hoist", lag=0.2, high_pass=0.05, gain=0.4,
        maximum_rate=0.15,
    )  # fmt: skip
    scene.add_heave_compensation(
        name="by luffing", body="ship", point=(20.0, 0.0, 12.0), actuator="luff", ratio=0.05, gain=0.5,
        lag=0.1, lag_order=2, high_pass=0.05, actuator_frequency=1.0, maximum_stroke=0.2,
    )  # fmt: skip
    return scene


def test_both_formulations_and_merged_bodies_agree_and_energy_closes() -> None:
    runs = [record(moving_crane(), 4.0, rtol=1e-8, formulation=f) for f in ("redundant", "recursive")]
    whole = Run(moving_crane(), t_end=4.0, dt_out=0.05, rtol=1e-8, model=moving_crane().compile(merge=False))
    whole.advance(4.0)
    runs.append(dict(whole.core.channels()))
    for other in runs[1:]:
        assert_allclose(other["position"], runs[0]["position"], atol=1e-5)
        assert_allclose(other["load_state"], runs[0]["load_state"], atol=1e-5)
    for out in runs[:2]:
        assert np.max(np.abs(out["energy_balance"])) < 1e-6 * out["absolute_work"][-1]


@pytest.mark.parametrize("settings", [{"rtol": 1e-6}, {"integrator": "rk4", "dt": 5e-3},
                                      {"integrator": "rosenbrock", "rtol": 1e-4}])  # fmt: skip
def test_a_run_goes_on_bit_for_bit(settings: dict[str, Any], tmp_path: Path) -> None:
    whole = Run(moving_crane(), t_end=1.5, dt_out=0.1, **settings)
    whole.advance(0.73)
    whole.core.state.save(tmp_path / "half.state")
    whole.advance(1.5)
    start = State.load(tmp_path / "half.state", scene=moving_crane())
    rest = Run(moving_crane(), t_end=1.5, dt_out=0.1, start=start, **settings)
    rest.advance(1.5)
    assert np.array_equal(rest.core.state.values, whole.core.state.values)


def test_the_exact_jacobian_is_that_of_differences() -> None:
    scene = moving_crane()
    model = scene.compile(merge=False)
    run = Run(scene, t_end=0.9, dt_out=0.1, rtol=1e-8, model=model)
    run.advance(0.9)
    y = np.array(run.core.state.values)
    at = Evaluator(model)
    exact = np.asarray(at.jacobian(0.9, y))
    states = [place for _, _, place, *_ in model.load_states]
    assert len(states) == 11
    for j in [*states, 2, 9, 16, model.twist_index(0) + 2, model.twist_index(1) + 4]:
        step = np.zeros_like(y)
        step[j] = 1e-5
        near, far = ((at.derivative(0.9, y + k * step) - at.derivative(0.9, y - k * step)) / (2e-5 * k)
                     for k in (1.0, 2.0))  # fmt: skip
        expected = (4.0 * near - far) / 3.0
        assert_allclose(exact[:, j], expected, atol=1e-6 * np.max(np.abs(exact)), rtol=1e-6)


def cylinder(lag: float = 0.0, *, gains: tuple[float, float] = (4e5, 4e4), **settings: Any) -> Scene:
    """A ship with a slide at its tip, whose position an actuator controls; the load sits on the slide."""
    scene = heaving(omega=OMEGA)
    scene.add_body(name="slide", mass=MASS, inertia=(1e3, 1e3, 1e3), position=(0, 0, TIP))
    scene.add_joint(
        kind="prismatic", name="cylinder", first="ship", second="slide", point=(0, 0, TIP), axis=(0, 0, 1)
    )
    stiffness, damping = gains
    scene.add_actuator(joint="cylinder", stiffness=stiffness, damping=damping, feed_forward=MASS * 9.80665)
    if settings is not None and settings.get("ratio") != 0.0:
        scene.add_heave_compensation(
            name="ahc", body="ship", point=(0, 0, TIP), actuator="cylinder", lag=lag, **settings
        )
    return scene


def test_a_cylinder_leaves_the_load_the_residual() -> None:
    """The loop of stiffness and damping follows its reference by (k + c p) / (m p^2 + c p + k)."""
    settings: dict[str, Any] = {"lag": 0.2, "high_pass": 0.08}
    gains = (4e4, 8e3)  # a loop as soft as to be seen
    scene = cylinder(gains=gains, ratio=-1.0, **settings)
    out = record(scene, 40.0, dt_out=0.1, rtol=1e-8)
    found = amplitude_of(out["time"], out["position"][:, 1, 2], OMEGA, 20.0)
    p, (k, c) = 1j * OMEGA, gains
    loop = k + c * p
    # m x'' = (k + c p)(z - H z - x)
    expected = -1j * loop * (1.0 - transfer(OMEGA, **settings)) / (MASS * p**2 + loop)
    assert found == pytest.approx(expected, abs=1e-5)


def test_the_ratio_of_a_cylinder_is_that_of_the_tip() -> None:
    """Against the tip's height over the stroke, from the crane's geometry."""
    pose, step = {"slew": -1.0, "s1": 1.0, "s2": 1.5}, 1e-5
    geometry = KnuckleBoomCrane.load().geometry
    high, low = (geometry.tip(**pose | {"s2": 1.5 + sign * step}) for sign in (1.0, -1.0))
    scene = Scene(name="on land")
    scene.add_crane(base="ground", **pose)
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        scene.add_actuator(joint=joint)
    scene.add_heave_compensation(name="ahc", body="boom", actuator="knuckle_cylinder")
    assert scene.loads["ahc"].ratio == pytest.approx(-2.0 * step / (high - low)[2], rel=1e-6)
    with pytest.raises(SceneError, match=r"'A' does not move the load along the direction in the described"):
        scene.add_heave_compensation(name="slew", body="boom", actuator="A")


def python_controller(lag: float, period: float) -> SampledController:
    """The same compensation by the speeds that are measured now: stroke and rate of the cylinder."""
    kept = {"lagged": 0.0}

    def control(time: float, measured: Any) -> dict[str, float]:
        heave = float(measured["position"][0, 2])
        rate = (heave - kept["lagged"]) / lag
        held = kept["lagged"]
        kept["lagged"] += rate * period * (1.0 - 0.5 * period / lag)
        del time
        return {"cylinder.reference": -held, "cylinder.reference_rate": -rate}

    return SampledController(period=period, function=control)


def test_a_python_controller_takes_the_place_of_the_compiled_one() -> None:
    """Within what sampling loses, which is of the first order in the period."""
    compiled = simulate(cylinder(0.3, high_pass=0.0, ratio=-1.0), 6.0, dt_out=0.1, rtol=1e-8)
    errors = []
    for period in (0.04, 0.02, 0.01):
        by_hand = simulate(
            cylinder(0.3, ratio=0.0), 6.0, dt_out=0.1, rtol=1e-8, controllers=[python_controller(0.3, period)]
        )
        errors.append(np.max(np.abs(by_hand["position"][:, 1, 2] - compiled["position"][:, 1, 2])))
    assert errors[2] < 0.01
    assert 1.5 < errors[0] / errors[1] < 3.0
    assert 1.5 < errors[1] / errors[2] < 3.0


def test_the_rate_of_a_reference_that_is_set_moves_with_it() -> None:
    """With the rate given, damping does not hold against a reference in steps: the lag of c / k is gone."""
    speed, period = 0.2, 0.01

    def ramp(with_rate: bool) -> SampledController:
        def control(time: float, measured: Any) -> dict[str, float]:
            del measured
            out = {"cylinder.reference": speed * (time + 0.5 * period)}
            return out | {"cylinder.reference_rate": speed} if with_rate else out

        return SampledController(period=period, function=control)

    late = {}
    for with_rate in (False, True):
        scene = cylinder(ratio=0.0, gains=(4e5, 2e5))
        scene.drivers.clear()
        scene.add_driver(joint="sea", curve=Curve.constant(value=0.0))
        out = simulate(scene, 6.0, dt_out=0.1, rtol=1e-8, controllers=[ramp(with_rate)])
        late[with_rate] = speed * 6.0 - (out["position"][-1, 1, 2] - TIP)
    assert late[False] == pytest.approx(speed * 2e5 / 4e5, rel=1e-2)
    assert abs(late[True]) < 2e-3


def test_files_hold_compensation(tmp_path: Path) -> None:
    scene = compensated(lag=0.2, maximum_rate=1.0)
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json") == scene


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"winch": "rope"}, r"there is no winch 'rope'; add the line and its winch first"),
        ({"winch": None, "actuator": "boom"}, r"there is no actuator 'boom'; add it first"),
        ({"winch": "rope", "ratio": 1.0}, r"there is no winch 'rope'; add it first"),
        ({"actuator": "boom"}, r"moves winch 'hoist' and actuator 'boom'"),
        ({"direction": (1, 0, 0)}, r"'hoist' does not move the load along the direction"),
        ({"direction": (0, 0, 0), "ratio": 1.0}, r"direction is zero"),
        ({"lag": -0.1}, r"lag is -0.1 s; it must not be negative"),
        ({"lag_order": 3}, r"lag_order is 3; choose 1 or 2"),
        ({"maximum_rate": 0.0}, r"maximum_rate is 0 m/s; it must be positive"),
        ({"maximum_stroke": -1.0}, r"maximum_stroke is -1 m; it must be positive"),
        ({"settling": 0.0}, r"settling is 0 s; it must be positive"),
        ({"high_pass": -1.0}, r"high_pass is -1"),
        ({"ratio": 0.0}, r"ratio is 0; it must not be zero"),
        ({"body": "boat"}, r"there is no body 'boat'"),
    ],
)
def test_compensators_that_cannot_be_are_told(given: dict[str, Any], message: str) -> None:
    scene = hung()
    with pytest.raises(SceneError, match=f"heave compensator 'ahc': .*{message}"):
        settings = {"name": "ahc", "body": "ship", "point": (0, 0, TIP), "winch": "hoist"} | given
        scene.add_heave_compensation(**settings)
        scene.compile()


def test_a_winch_follows_one_only() -> None:
    scene = compensated()
    scene.add_heave_compensation(name="second", body="ship", winch="hoist")
    with pytest.raises(SceneError, match=r"'second': winch 'hoist' follows 'ahc' already"):
        scene.compile()
