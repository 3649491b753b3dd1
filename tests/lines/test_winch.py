"""Winches: the drum's inertia, its motor's bounds, its brake, and a tension that is held, by closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, STIFFNESS, G, add_led, busy, hung, swinging
from multibody_runs import ramp, record
from numpy.testing import assert_allclose

from seacrane import Curve, Move, Run, Scene, SceneError, Stage, State, equilibrium, simulate
from seacrane.warnings import WinchLimitWarning

RADIUS, DRUM = 0.5, 5e3  # m; kg, inertia over radius^2
INERTIA = DRUM * RADIUS**2
CAPACITY = 1.5 * MASS * G  # N


def on_drum(**given: Any) -> Scene:
    """The load of `hung` on a drum with inertia; `given` has what the winch takes, and what `hung` does."""
    of_load = {key: given.pop(key) for key in ("length", "damping", "stretch", "velocity") if key in given}
    scene = hung(**of_load)
    scene.add_winch(line="hoist", **{"drum_inertia": INERTIA, "drum_radius": RADIUS, "lag": 0.2} | given)
    return scene


def steady(force: float) -> tuple[float, float]:
    """Tension and l0'' of a load and drum that accelerate alike, with a force at the rope that holds them.

    DRUM l0'' = T - force and MASS (1 + e) l0'' = MASS g - T with the constant strain e = T / EA.
    """
    tension = MASS * G
    for _ in range(50):
        strain = tension / (STIFFNESS * 10.0)
        tension = (G + (1.0 + strain) * force / DRUM) / (1.0 / MASS + (1.0 + strain) / DRUM)
    return tension, (tension - force) / DRUM


def running(scene: Scene, **states: float) -> State:
    """The scene's start with states of its winch."""
    start = Run(scene, t_end=1.0).core.state
    return start.with_load_states({f"hoist.{name}": value for name, value in states.items()})


def test_a_load_falls_with_its_drum() -> None:
    """a = g m / (m + J / r^2), with the strain of the rope."""
    tension, fall = steady(0.0)
    scene = on_drum(stretch=tension / STIFFNESS, maximum_tension=0.0)
    result = simulate(scene, 2.0, dt_out=0.1, rtol=1e-9)
    assert_allclose(result["line_tension"][:, 0], tension, rtol=1e-7)
    assert_allclose(result["line_pay_out_rate"][:, 0], fall * result.time, atol=1e-6)
    assert_allclose(result["line_unstretched_length"][:, 0], 10.0 + 0.5 * fall * result.time**2, atol=1e-6)
    assert not result.events and not np.any(result["drum_motor_torque"])


def test_a_brake_closed_in_1_ms_makes_the_peak_of_its_closed_form() -> None:
    """m g + v sqrt(k m), k being that of the rope and the brake's give in series."""
    capacity, speed, give = 2e6, 1.0, 1e-3
    shut = Curve.quintic(start_time=0.1, end_time=0.101, start=0.0, end=1.0)
    scene = on_drum(length=2000.0, velocity=(0, 0, -speed), rate=speed, drum_inertia=25.0, brake=shut,
                    brake_capacity=capacity, brake_give=give)  # fmt: skip
    run = Run(scene, t_end=0.5, dt_out=5e-4, rtol=1e-7, start=running(scene, rate=speed))
    run.advance(0.5)
    out = run.core.channels()
    k = 1.0 / (1.0 / STIFFNESS + give / capacity)
    assert np.max(out["line_tension"]) == pytest.approx(MASS * G + speed * np.sqrt(k * MASS), rel=2e-3)
    assert not np.any(out["drum_motor_torque"][out["time"] > 0.1015])


@pytest.mark.warns("WinchLimitWarning")
def test_a_brake_slips_at_its_capacity_and_holds_without_creep() -> None:
    """(m + J / r^2) a = capacity - m g while it slips; then the drum stands still."""
    tension, change = steady(CAPACITY)
    strain, speed = tension / (STIFFNESS * 10.0), 1.0
    scene = on_drum(stretch=10.0 * strain, velocity=(0, 0, -speed * (1.0 + strain)), damping=0.1, brake=1.0,
                    brake_capacity=CAPACITY)  # fmt: skip
    result = simulate(scene, 8.0, dt_out=0.01, rtol=1e-9, start=running(scene, rate=speed, brake=1e-3))
    stops = speed / -change
    slips = result.time < stops - 1e-3
    assert_allclose(result["line_pay_out_rate"][slips, 0], speed + change * result.time[slips], atol=1e-6)
    assert_allclose(result["drum_brake_torque"][slips, 0], CAPACITY * RADIUS, rtol=1e-12)
    (met,) = result.events
    assert (met.name, met.kind, met.time) == ("hoist.brake_capacity", "limit", 0.0)
    held = result["line_unstretched_length"][result.time > stops + 4.0, 0]
    assert np.ptp(held) < 1e-5
    assert held[-1] == pytest.approx(10.0 + 0.5 * speed * stops, abs=1.1e-3)


def test_a_brake_holds_a_load_by_its_give() -> None:
    """The rest state is wound by m g / capacity of the give, and nothing creeps from there."""
    scene = on_drum(damping=0.1, brake=1.0, brake_capacity=CAPACITY)
    rest = equilibrium(scene)
    assert rest.load_states["hoist.brake"] == pytest.approx(1e-3 / 1.5, rel=1e-6)
    result = simulate(scene, 20.0, start=rest, dt_out=5.0, rtol=1e-8)
    assert np.ptp(result["line_unstretched_length"]) < 1e-9 and not result.events


@pytest.mark.warns("WinchLimitWarning")
def test_the_motor_hauls_in_within_its_bounds() -> None:
    """By (F - m g) / (m + J / r^2) at first, at P / (m g) in the end; the drum's lag plays no part."""
    most, power = 1.2 * MASS * G, 0.5 * MASS * G
    scene = on_drum(length=100.0, damping=0.3, rate=-2.0, maximum_tension=most, maximum_power=power, lag=0.01)
    result = simulate(scene, 12.0, dt_out=0.02, rtol=1e-8)
    rate, time = result["line_pay_out_rate"][:, 0], result.time
    torque, early = result["drum_motor_torque"][:, 0], time < 0.2
    assert_allclose(torque[1:][early[1:]], -most * RADIUS, rtol=1e-12)
    fall = rate[np.searchsorted(time, 0.2)] / 0.2
    assert fall == pytest.approx((MASS * G - most) / (MASS + DRUM), rel=0.1)
    assert rate[-1] == pytest.approx(-power / (MASS * G), rel=2e-3)
    assert np.max(result["drum_motor_power"]) <= power * (1.0 + 1e-9)
    assert [one.name for one in result.events][:2] == ["hoist.maximum_tension", "hoist.maximum_power"]


@pytest.mark.warns("LiftedStartWarning")
def test_within_its_bounds_a_drum_follows_as_a_winch_without_one() -> None:
    heavy, light = swinging(), swinging(drum_inertia=900.0, drum_radius=0.4)
    one, two = (record(scene, 3.0, rtol=1e-10) for scene in (heavy, light))
    assert_allclose(one["position"], two["position"], atol=1e-8)
    assert_allclose(one["line_tension"], two["line_tension"], atol=0.1)


def test_bounds_of_rate_and_acceleration_are_located_and_told() -> None:
    """The instants at which a command's jump meets them, leaves one and meets the other."""
    scene = hung(damping=0.02)
    jump = Curve.constant(value=0.0).then(time=1.0, curve=ramp(0.5, 0.6 - 0.5))
    scene.add_winch(line="hoist", rate=jump, maximum_rate=0.8, maximum_acceleration=0.9, lag=0.4)
    with pytest.warns(WinchLimitWarning, match="beyond its maximum_rate"):
        events = simulate(scene, 4.0, dt_out=0.05, rtol=1e-8).events
    told = [(event.name, event.time) for event in events]
    assert [name for name, _ in told] == ["hoist.maximum_acceleration", "hoist.maximum_rate"]
    assert_allclose([time for _, time in told], [1.0, 1.4], atol=1e-6)


def pulled(velocity: float, **winch: Any) -> Scene:
    """A winch on the ground that holds 20 kN on a body that is led away; EA / l0 is 100 kN/m."""
    scene = Scene(name="pulled", gravity=0.0)
    add_led(scene, "end", ramp(velocity), place=(2000.2, 0, 0), axis=(1, 0, 0))
    scene.add_line(name="tugger", bodies=["ground", "end"], points=np.zeros((2, 3)), EA=2e8, length=2000.0,
                   damping_ratio=0.0)  # fmt: skip
    scene.add_winch(line="tugger", **{"tension": 20e3, "tension_gain": 2e-5} | winch)
    return scene


def test_a_held_tension_follows_a_moving_point_as_a_loop_of_first_order() -> None:
    """T = set + band + v / gain + ... exp(-k gain t), k = EA / l0."""
    band, gain, speed = 3e3, 2e-5, 0.2
    result = simulate(pulled(speed, dead_band=band), 4.0, dt_out=0.02, rtol=1e-9)
    tension, time = result["line_tension"][:, 0], result.time
    assert_allclose(tension[time < 0.14], 20e3 + 1e5 * speed * time[time < 0.14], rtol=1e-3)
    inside = band / (1e5 * speed)  # s until the dead band ends
    after = time > inside
    rise = speed / gain * (1.0 - np.exp(-1e5 * gain * (time - inside)))
    assert_allclose(tension[after], (20e3 + band + rise)[after], rtol=1e-3)
    assert_allclose(result["line_pay_out_rate"][~after, 0], 0.0)


def test_a_slack_line_is_recovered() -> None:
    """At the bound of its rate while it is slack, and up to the dead band in the end."""
    scene = pulled(0.0, dead_band=2e3, maximum_rate=0.25, lag=0.05)
    scene.replace("tugger", length=2000.6)
    result = simulate(scene, 8.0, dt_out=0.05, rtol=1e-8)
    rate = result["line_pay_out_rate"][:, 0]
    assert_allclose(rate[(result.time > 1.0) & (result["line_tension"][:, 0] == 0.0)], -0.25, atol=1e-6)
    assert result["line_tension"][-1, 0] == pytest.approx(18e3, rel=1e-3)


@pytest.mark.warns("LiftedStartWarning")
def test_errors_fall_with_the_tolerance_past_every_kink() -> None:
    """Bounds, dead band and brake are located: nothing is left of the steps that met them."""
    ends = [record(busy(), 5.0, rtol=rtol, dt_out=5.0)["position"][-1] for rtol in (1e-11, 1e-9, 1e-7, 1e-5)]
    exact, *others = ends
    for end, bound in zip(others, (1e-7, 1e-5, 1e-3), strict=True):
        assert np.max(np.abs(end - exact)) < bound
    run = Run(busy(), t_end=5.0)
    run.advance(5.0)
    bounds = ("maximum_tension", "maximum_power", "maximum_rate", "brake_capacity")
    assert {event.name for event in run.events()} == {f"hoist.{bound}" for bound in bounds}


@pytest.mark.parametrize(
    ("way", "end", "told"), [(-1.0, "minimum", "hauled in"), (1.0, "maximum", "paid out")]
)
def test_a_drum_that_winds_to_an_end_is_stopped(formulation: str, way: float, end: str, told: str) -> None:
    last = 8.0 + 0.5 * way
    scene = on_drum(length=8.0, damping=0.1, rate=0.5 * way, **{f"{end}_length": last})
    with pytest.warns(WinchLimitWarning, match=f"has {told} to {end}_length"):
        result = simulate(scene, 4.0, dt_out=0.05, rtol=1e-8, formulation=formulation)
    (met,) = result.events
    wound = 0.5 * (met.time - 0.2 * (1.0 - np.exp(-met.time / 0.2)))
    assert met.name == f"hoist.{end}_length" and wound == pytest.approx(0.5, abs=1e-6)
    assert_allclose(result["line_unstretched_length"][result.time > met.time], last, atol=1e-6)
    left = 0.5 * way * np.exp(-(result.time - met.time) / 0.2)
    assert_allclose(result["load_state"][result.time > met.time, 1], left[result.time > met.time], atol=2e-3)
    assert np.max(np.abs(result["energy_balance"])) < 1e-6 * result["absolute_work"][-1]


def test_stages_command_the_brake_and_the_tension() -> None:
    scene = on_drum(damping=0.1, brake_capacity=CAPACITY)
    stages = [Stage(name="hold", duration=1.0),
              Stage(name="park", duration=6.0, commands={"hoist.brake": Move(to=1.0, over=0.2)})]  # fmt: skip
    parked = simulate(scene, stages, dt_out=0.5, rtol=1e-08)
    assert_allclose(parked["drum_motor_torque"][[0, -1], 0], [-MASS * G * RADIUS, 0.0], rtol=1e-9)
    assert parked["drum_brake_torque"][-1, 0] == pytest.approx(MASS * G * RADIUS, rel=1e-4)
    stages = [Stage(name="slack off", duration=9.0, commands={"tugger.tension": 12e3})]
    let_go = simulate(pulled(0.0, dead_band=1000.0), stages, dt_out=0.5, rtol=1e-08)
    assert let_go["line_tension"][-1, 0] == pytest.approx(13e3, rel=1e-4)


@pytest.mark.parametrize(
    ("given", "message"),
    [({"tension": 1e4}, "without a tension_gain"), ({"tension_gain": 1e-5}, "dead_band 0 N: a slack line"),
     ({"maximum_tension": 1e5}, "maximum_tension needs a drum"), ({"brake": 1.0}, "brake needs a drum"),
     ({"drum_inertia": 1e3, "drum_radius": 0.5}, "needs a lag"),
     ({"drum_inertia": 1e3, "winch": False}, "holds a tension or has a drum, and no winch")],
)  # fmt: skip
def test_winches_that_cannot_be_are_told(given: dict[str, Any], message: str) -> None:
    scene = hung()
    scene.add_winch(line="hoist")
    scene.replace("hoist", **given)
    with pytest.raises(SceneError, match=f"line 'hoist': .*{message}"):
        scene.compile()
