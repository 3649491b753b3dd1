"""Kinks of curves, loads and bounds: offered with their size, stopped at, begun on their new side."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kink_scenes import CART as MASS
from kink_scenes import ELEMENTS, cart, random_curve
from named import on_wire

from seacrane import Curve, Result, Run, Scene, State, integrator_names, simulate

SCALE = 0.1  # m and m/s, of the tolerances
JUMPS = (0.5, -0.8, 1.2)  # of value, rate and acceleration


def bent(*jumps: float, time: float = 2.0) -> Curve:
    """Zero, then a parabola that jumps in value, rate and acceleration."""
    value, rate, acceleration = jumps
    return Curve.constant(value=0.0).then(
        time=time,
        curve=Curve.pieces(starts=[time], coefficients=[[value, rate, 0.5 * acceleration, 0.0, 0.0, 0.0]]),
    )


def worst(result: Result, reference: Result) -> float:
    return float(np.linalg.norm(result["position"] - reference["position"], axis=-1).max())


# What is added, the times of its kinks and, over the scale of tolerances, the jumps there of the state and of
# its first three derivatives, loads over the mass.
V, R, A = JUMPS
CUBIC = Curve.pieces(starts=[1.0], coefficients=[[0.0, 0.0, 0.5 * 0.7, -0.3 / 6.0, 0.0, 0.0]])
RAMPS = np.array([[f, 0.0, 0.0, 0.0, 0.0, 0.0] for f in (0.0, 1.0, 1.0, 3.0)])
OFFERED: list[tuple[str, dict[str, Any], list[float], list[list[float]]]] = [
    ("actuator", {"joint": "rail", "feed_forward": bent(*JUMPS)}, [2.0],
     [[0.0, V / MASS, R / MASS, A / MASS]]),
    ("actuator", {"joint": "rail", "stiffness": 3.0, "damping": 0.5, "reference": bent(*JUMPS)}, [2.0],
     [[0.0, (3.0 * V + 0.5 * R) / MASS, (3.0 * R + 0.5 * A) / MASS, 3.0 * A / MASS]]),
    ("driver", {"joint": "rail", "curve": CUBIC}, [1.0], [[0.0, 0.7, 0.3, 0.0]]),
    ("driver", {"joint": "rail", "curve": bent(0.0, 0.2, 0.0)}, [2.0], [[0.2, 0.0, 0.0, 0.0]]),
    ("force", {"name": "push", "body": "cart", "times": [1.0, 2.0, 4.0, 5.0], "force": RAMPS},
     [1.0, 2.0, 4.0, 5.0], [[0.0, 0.0, slope / MASS, 0.0] for slope in (1.0, 1.0, 2.0, 2.0)]),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "arguments", "times", "jumps"), OFFERED)
def test_elements_offer_their_kinks_with_their_size(
    kind: str, arguments: dict[str, Any], times: list[float], jumps: list[list[float]]
) -> None:
    scene = cart()
    getattr(scene, f"add_{kind}")(**arguments)
    found = scene.compile().kinks
    assert [time for time, _ in found] == times
    np.testing.assert_allclose([sizes for _, sizes in found], np.abs(jumps) / SCALE, rtol=1e-12, atol=1e-15)


def test_kinks_of_the_wind_are_those_of_its_speed_squared() -> None:
    scene = ELEMENTS["wind"](Curve.constant(value=10.0).then(time=3.0, curve=Curve.constant(value=20.0)))
    slower = ELEMENTS["wind"](Curve.constant(value=10.0).then(time=3.0, curve=Curve.constant(value=15.0)))
    (_, jump), (_, less) = scene.compile().kinks[0], slower.compile().kinks[0]
    assert jump[1] / less[1] == pytest.approx((400.0 - 100.0 + 10.0) / (225.0 - 100.0 + 5.0))


@pytest.mark.parametrize("element", ELEMENTS)
def test_every_element_that_takes_a_curve_offers_its_kinks(element: str) -> None:
    assert 2.0 in ELEMENTS[element](bent(0.0, 0.8, 0.3)).compile().breakpoints
    assert not ELEMENTS[element](Curve.constant(value=0.0)).compile().breakpoints


@pytest.mark.parametrize("integrator", ["rk4", "dopri5", "cvode-bdf", "generalized-alpha"])
def test_a_run_restarts_at_a_kink_that_matters_and_not_at_one_that_does_not(integrator: str) -> None:
    extra = []
    for size in (0.0, 1e-9, 5.0):
        scene = cart()
        scene.add_actuator(
            name="drive", joint="rail", stiffness=8.0, damping=1.0,
            feed_forward=Curve.harmonic(amplitude=3.0, omega=1.3),
        )  # fmt: skip
        scene.add_actuator(name="kick", joint="rail", feed_forward=bent(0.0, size, 0.0, time=2.03))
        extra.append(simulate(scene, t_end=6.0, integrator=integrator, dt=0.05).stats["restarts"])
    assert extra == [extra[0], extra[0], extra[0] + 1]


@pytest.mark.parametrize("integrator", ["rk4", "rk-low-storage"])
def test_a_fixed_step_keeps_its_order_over_a_kink(integrator: str) -> None:
    """x'' = F / m with F bent at 2.03 s, between two steps: closed form; without the stop the order is 2."""
    scene = cart()
    scene.add_actuator(
        name="drive", joint="rail", stiffness=8.0, reference=0.0, feed_forward=bent(0.0, 5.0, 0.0, time=2.03)
    )
    errors = []
    for dt in (0.1, 0.05):
        result = simulate(scene, t_end=4.0, dt_out=0.1, integrator=integrator, dt=dt)
        w, since = np.sqrt(8.0 / MASS), np.maximum(result.time - 2.03, 0.0)
        exact = 5.0 / 8.0 * (since - np.sin(w * since) / w)
        errors.append(np.abs(result["position"][:, 0, 0] - exact).max())
    assert np.log2(errors[0] / errors[1]) > 3.5, errors


def recorded(samples: int) -> Scene:
    """A cart on a spring, pushed by a record of something smooth."""
    scene = cart()
    scene.add_actuator(name="hold", joint="rail", stiffness=2.0, damping=0.4)
    times, loads = np.linspace(0.0, 100.0, samples), np.zeros((samples, 6))
    loads[:, 0] = 3.0 * np.sin(1.1 * times) + 2.0 * np.sin(0.37 * times + 1.0)
    scene.add_force("cart", name="record", times=times, force=loads)
    return scene


def test_a_record_of_ten_thousand_samples_is_not_ten_thousand_restarts() -> None:
    scene = recorded(10_001)
    truth = simulate(scene, t_end=100.0, integrator="dopri5", rtol=1e-6, maximum_step=0.01)
    for rtol in (1e-2, 1e-4, 1e-6):
        for integrator in ("dopri5", "verner76", "cvode-bdf"):
            result = simulate(scene, t_end=100.0, rtol=rtol, integrator=integrator)
            assert result.stats["restarts"] < 100, (integrator, rtol, result.stats["restarts"])
            assert integrator == "cvode-bdf" or worst(result, truth) < 10.0 * rtol, (integrator, rtol)
    tight = simulate(scene, t_end=100.0, rtol=1e-9)
    assert tight.stats["restarts"] > 9_000  # steps of more than a sample would not meet the tolerance
    assert simulate(recorded(101), t_end=100.0).stats["restarts"] >= 98  # each sample of a coarse record


@pytest.mark.warns("UnitWarning")
@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), element=st.sampled_from(sorted(ELEMENTS)))
def test_random_curves_with_kinks_keep_an_accuracy_through_every_element(seed: int, element: str) -> None:
    """Within three times the limit, always; how often within it: `test_trade_accuracy.py`, on 200 scenes."""
    rng = np.random.default_rng(seed)
    scene = ELEMENTS[element](random_curve(rng, continuous=element == "driver"))
    span: dict[str, Any] = {"t_end": 20.0, "dt_out": 0.25}
    reference = simulate(scene, integrator="dop853", rtol=1e-11, maximum_step=0.05, **span)
    motion = float(np.abs(reference["position"] - reference["position"][0]).max())
    limit = max(motion, 0.01) * 10.0 ** rng.uniform(-6.0, -2.0)
    result = simulate(scene, accuracy={"position": limit}, **span)
    assert worst(result, reference) <= 3.0 * limit, (seed, element, limit)


def bouncing(damping: float = 0.8) -> Scene:
    scene = cart(speed=1.0)
    scene.add_stop(joint="rail", minimum=-1.0, maximum=1.0, stiffness=400.0, damping=damping)
    return scene


def corners() -> Scene:
    """A cart between corners of a table of tension."""
    scene = cart(speed=2.0)
    scene.add_spring(
        name="table", first="ground", second="cart", first_point=(-5.0, 0.0, 0.0),
        lengths=[3.0, 4.5, 5.2, 6.0, 9.0], forces=[-60.0, -20.0, 0.0, 5.0, 90.0],
    )  # fmt: skip
    return scene


@pytest.mark.parametrize("make", [bouncing, corners])
def test_a_fixed_step_keeps_its_order_over_kinks_in_the_state(make: Callable[[], Scene]) -> None:
    """Where a soft stop is touched and left, and at the corners of a table; without them the order is 2."""
    scene = make()
    reference = simulate(scene, t_end=6.0, integrator="dop853", rtol=1e-12)
    errors = [worst(simulate(scene, t_end=6.0, integrator="rk4", dt=dt), reference) for dt in (0.01, 0.0025)]
    assert np.log2(errors[0] / errors[1]) / 2.0 > 3.5, errors


@pytest.mark.parametrize("integrator", integrator_names())
def test_every_integrator_passes_kinks_in_the_state(integrator: str) -> None:
    scene = bouncing(0.5)
    reference = simulate(scene, t_end=4.0, integrator="dop853", rtol=1e-12)
    result = simulate(scene, t_end=4.0, integrator=integrator, dt=1e-3, rtol=1e-7)
    order_one = integrator == "semi-implicit-euler"
    assert worst(result, reference) < (2e-2 if order_one else 1e-4)


def test_a_located_kink_costs_a_step_taken_again_and_no_derivative_twice() -> None:
    """Those at its start and at its end are known; beside stages, the start of the run takes two."""
    stats = simulate(bouncing(), t_end=6.0, integrator="dopri5", formulation="recursive").stats
    assert stats["restarts"] >= 4
    assert stats["evaluations"] == 6 * (stats["steps"] + stats["rejected_steps"]) + 2


STEPPING = {"semi-implicit-euler": 1e-3, "rk4": 0.02, "rk-low-storage": 0.02}
# Those that lose much by a restart go across by their step control; Newton of generalized-alpha finds no step
# across a jump.
ACROSS = ("cvode-bdf", "ida", "generalized-alpha")


def hoisted(*, rate: Curve | float = -0.5, lag: float = 0.0, **ends: float) -> Scene:
    """A load of 10 t whose winch winds to an end."""
    scene = on_wire(mass=1e4, EA=1e7, damping_ratio=0.0)
    scene.add_winch(line="hoist", rate=rate, lag=lag, **(ends or {"minimum_length": 9.5}))
    return scene


@pytest.mark.parametrize("name", [name for name in integrator_names() if name not in ACROSS])
@pytest.mark.filterwarnings("ignore")
def test_a_winch_stops_at_an_end_by_every_method(name: str) -> None:
    for rtol, lag, end in ((0.1, 0.2, "minimum"), (1e-6, 0.0, "minimum"), (1e-6, 0.2, "maximum")):
        settings = {"dt": STEPPING[name]} if name in STEPPING else {"rtol": rtol}
        last, rate = (9.5, -0.5) if end == "minimum" else (10.5, 0.5)
        scene = hoisted(rate=rate, lag=lag, **{f"{end}_length": last})
        out = simulate(scene, 4.0, dt_out=0.1, integrator=name, **settings)
        assert abs(float(out["line_unstretched_length"][-1, 0]) - last) < 1e-6


@pytest.mark.parametrize("name", ["dopri5", "dop853", "rosenbrock"])
@pytest.mark.parametrize("until", [-0.5, -1e-5, 0.0, 1e-7])
def test_a_run_goes_on_bit_for_bit_about_a_located_bound(name: str, until: float, tmp_path: Path) -> None:
    when = (10.0 / (1.0 + 1e4 * 9.80665 / 1e7) - 9.5) / 0.5
    until += when
    settings: dict[str, Any] = {"dt_out": 0.1, "integrator": name, "rtol": 1e-4}
    whole = Run(hoisted(), t_end=3.0, **settings)
    whole.advance(until)
    whole.core.state.save(tmp_path / "there.state")
    whole.advance(3.0)
    rest = Run(hoisted(), t_end=3.0, start=State.load(tmp_path / "there.state", scene=hoisted()), **settings)
    rest.advance(3.0)
    assert np.array_equal(rest.core.state.values, whole.core.state.values)
    met = [event.time for event in whole.events()]
    assert met == pytest.approx([when], rel=1e-3)
    assert sorted({*met} - {event.time for event in rest.events()}) == [t for t in met if t <= until]
