"""Wires that go slack and balls that bounce: events against closed forms and SciPy, by every integrator."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from event_scenes import FIRST_SPEED, GRAVITY, HEIGHT, INERTIA, LENGTH, MASS, ball, pendulum, scipy_pendulum
from multibody_runs import momentum
from scipy.integrate import quad

from seacrane import Run, Scene, SceneError, State, cases, integrator_names, simulate
from seacrane.errors import ChatteringError


def test_ball_bounces_at_the_times_and_with_the_energies_of_the_closed_form() -> None:
    """What is lost is booked, the balance stays closed, and all has gone when it lies."""
    result = simulate(ball(), t_end=3.0, dt_out=0.01, rtol=1e-8)
    events, speed = result.events[:5], np.sqrt(2.0 * GRAVITY * HEIGHT) * 0.5 ** np.arange(5)
    times = (speed[0] + np.concatenate([[0.0], np.cumsum(2.0 * speed[1:])])) / GRAVITY
    assert {(e.kind, e.name) for e in events} == {("rebound", "floor")}
    np.testing.assert_allclose([e.time for e in events], times, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose([e.energy_lost for e in events], 0.375 * MASS * speed**2, rtol=1e-8)
    np.testing.assert_allclose([e.speed for e in events], speed, rtol=1e-8)
    np.testing.assert_allclose([e.impulse for e in events], 1.5 * MASS * speed, rtol=1e-8)
    assert np.abs(result["energy_balance"]).max() < 1e-9 * MASS * GRAVITY * HEIGHT
    total = sum(e.energy_lost for e in result.events)
    assert result["impact_loss"][-1] == pytest.approx(total, rel=1e-12)
    assert result.stats["impact_energy_lost_J"] == pytest.approx(total, rel=1e-12)
    assert total == pytest.approx(MASS * GRAVITY * HEIGHT, rel=1e-6)
    assert result.events[-1].kind == "contact"
    assert result["limit_force"][-1, 0] == pytest.approx(MASS * GRAVITY, rel=1e-9)
    assert abs(result.select("position", body="ball", axis="z")[-1]) < 1e-9


def test_chattering_ends_in_an_error_that_names_limit_joint_and_time() -> None:
    restitution = 0.95
    end = np.sqrt(2.0 * HEIGHT / GRAVITY) * (1.0 + restitution) / (1.0 - restitution)
    how = {"t_end": 40.0, "dt_out": 1.0, "rtol": 1e-6}
    with pytest.raises(ChatteringError, match=r"'floor' on joint 'air': chatters, .* at t = ([\d.]+) s") as e:
        simulate(ball(restitution=restitution, sticking_speed=0.0), **how)
    assert f"t = {end:.4f}" in str(e.value)
    partial = e.value.result  # what it did until then is there, and the state is not beyond the floor
    assert partial is not None and partial.state is not None
    assert partial.events[0].kind == "rebound"
    assert partial.state.time == pytest.approx(end, abs=1e-3)
    assert abs(partial.state.values[2]) < 1e-6
    result = simulate(ball(restitution=restitution), **how)  # with the default it comes to rest
    assert result.events[-1].kind == "contact"
    assert result.events[-1].time == pytest.approx(end, abs=0.01)


def slack_angle() -> float:
    """From the bottom: where the tension m (v^2 / L + g cos) is zero."""
    return float(np.arccos((2.0 * GRAVITY * LENGTH - FIRST_SPEED**2) / (3.0 * GRAVITY * LENGTH)))


def test_pendulum_goes_slack_at_the_closed_form_angle_and_follows_scipy(formulation: str) -> None:
    """The first release by the energy integral up to the angle, the rest by SciPy."""
    result = simulate(pendulum(), t_end=4.0, dt_out=0.02, rtol=1e-10, formulation=formulation)
    expected, events = scipy_pendulum(result.time, 0.0)
    assert [e.kind for e in result.events][:2] == ["release", "contact"]
    np.testing.assert_allclose([e.time for e in result.events], events, rtol=0.0, atol=2e-8)
    time, _ = quad(
        lambda a: LENGTH / np.sqrt(FIRST_SPEED**2 - 2.0 * GRAVITY * LENGTH * (1.0 - np.cos(a))),
        0.0, slack_angle(), epsabs=1e-12,
    )  # fmt: skip
    assert result.events[0].time == pytest.approx(time, abs=3e-9)
    np.testing.assert_allclose(
        result.select("position", body="ball")[:, [0, 2]], expected, rtol=0.0, atol=1e-7
    )
    tension = result.select("tension", link="wire")
    slack = (result.time > events[0]) & (result.time < events[1])
    assert np.all(tension[slack] == 0.0)
    assert np.all(tension[result.time < events[0]] > 0.0)
    assert np.abs(result["energy_balance"]).max() < 1e-6


def test_wire_that_rebounds_follows_scipy() -> None:
    result = simulate(pendulum(restitution=0.4), t_end=2.37, dt_out=0.02, rtol=1e-10)
    expected, events = scipy_pendulum(result.time, 0.4)
    assert [e.kind for e in result.events] == ["release"] + ["rebound"] * (len(events) - 1)
    assert len(events) > 2
    np.testing.assert_allclose([e.time for e in result.events], events, rtol=0.0, atol=2e-8)
    np.testing.assert_allclose(
        result.select("position", body="ball")[:, [0, 2]], expected, rtol=0.0, atol=1e-7
    )


@pytest.mark.parametrize("integrator", integrator_names())
def test_every_integrator_finds_the_same_events(integrator: str) -> None:
    """The parabola and the circle, with steps or tolerances that leave 1e-3."""
    step = 2e-5 if integrator == "semi-implicit-euler" else 2e-3
    result = simulate(pendulum(), t_end=2.2, dt_out=0.1, rtol=1e-7, dt=step, integrator=integrator)
    _, events = scipy_pendulum(result.time, 0.0)
    assert [e.kind for e in result.events][:2] == ["release", "contact"]
    np.testing.assert_allclose([e.time for e in result.events[:2]], events[:2], rtol=0.0, atol=5e-4)


def snatched() -> Scene:
    """The lift of case 2 with a payload that is thrown up and falls into its wire."""
    scene = cases.case2()
    scene.add_line(joint="link", rung="rigid")
    scene.replace("payload", kind="body", velocity=(0.0, 0.0, 1.0))
    return scene


@pytest.mark.parametrize("integrator", ["dopri5", "rk4"])
def test_wire_of_a_crane_afloat_snatches_alike(integrator: str) -> None:
    reference = simulate(snatched(), t_end=1.0, dt_out=0.1, integrator="dop853", rtol=1e-9)
    result = simulate(snatched(), t_end=1.0, dt_out=0.1, integrator=integrator, dt=0.01, rtol=1e-6)
    assert [e.kind for e in reference.events] == ["contact"]
    assert result.events[0].time == pytest.approx(reference.events[0].time, abs=1e-6)
    assert result.events[0].energy_lost == pytest.approx(reference.events[0].energy_lost, rel=1e-5)
    np.testing.assert_allclose(result["position"][-1], reference["position"][-1], atol=1e-5)
    assert np.abs(reference["energy_balance"]).max() < 1e-8 * reference["absolute_work"][-1]
    assert reference["impact_loss"][-1] == pytest.approx(reference.events[0].energy_lost, rel=1e-12)


def test_a_slack_wire_does_not_depend_on_the_step() -> None:
    ends, times = [], []
    for step in (0.04, 0.02, 0.01):
        result = simulate(pendulum(), t_end=2.2, dt_out=0.1, integrator="rk4", dt=step)
        ends.append(result.select("position", body="ball")[-1])
        times.append([e.time for e in result.events[:2]])
    reference = simulate(pendulum(), t_end=2.2, dt_out=0.1, rtol=1e-11)
    errors = [np.linalg.norm(end - reference.select("position", body="ball")[-1]) for end in ends]
    assert errors[0] < 2e-4
    # order 4 survives two events
    assert errors[0] / errors[1] > 8.0
    assert errors[1] / errors[2] > 8.0


def thrown(restitution: float) -> Scene:
    """Two bodies in space on a slack wire, held off their centres, flying apart."""
    scene = Scene(name="thrown", gravity=0.0)
    scene.add_body("a", mass=2.0, inertia=(0.5, 0.7, 0.9), position=(0, 0, 0), velocity=(-1.0, 0.2, 0))
    scene.add_body("b", mass=5.0, inertia=(1.5, 1.1, 0.6), position=(1, 0, 0), velocity=(2.0, 0, 0.5))
    ends = {"first": "a", "second": "b", "point": (0, 0.1, 0.2), "second_point": (1.0, -0.2, 0)}
    scene.add_joint(kind="distance", name="wire", length=3.0, **ends)
    scene.add_line(joint="wire", rung="rigid", restitution=restitution)
    return scene


@pytest.mark.parametrize("restitution", [0.0, 0.6, 1.0])
def test_momentum_is_kept_through_an_impact(restitution: float) -> None:
    scene = thrown(restitution)
    result = simulate(scene, t_end=1.5, dt_out=0.01, rtol=1e-10)
    assert result.events[0].kind == ("rebound" if restitution else "contact")
    linear, angular = momentum(scene, dict(result))
    np.testing.assert_allclose(linear, np.broadcast_to(linear[0], linear.shape), atol=1e-9)
    np.testing.assert_allclose(angular, np.broadcast_to(angular[0], angular.shape), atol=1e-8)
    assert np.abs(result["energy_balance"]).max() < 1e-7
    lost = result.events[0].energy_lost
    assert abs(lost) < 1e-9 if restitution == 1.0 else lost > 0.0


def test_what_starts_pulled_at_is_let_go_at_once() -> None:
    """A wire described stretched above its hook: its tension would be negative."""
    scene = Scene(name="above")
    above = (0.0, 0.0, LENGTH)
    scene.add_body(name="ball", mass=MASS, inertia=INERTIA, position=above)
    ends = {"first": "ground", "second": "ball", "point": (0, 0, 0), "second_point": above}
    scene.add_joint("wire", kind="distance", **ends)
    scene.add_line(joint="wire", rung="rigid")
    result = simulate(scene, t_end=0.5, dt_out=0.1, rtol=1e-9)
    assert (result.events[0].time, result.events[0].kind) == (0.0, "release")
    fallen = LENGTH - 0.5 * GRAVITY * result.time**2
    np.testing.assert_allclose(result.select("position", body="ball", axis="z"), fallen, atol=1e-9)


def test_a_state_with_limits_of_another_scene_is_refused() -> None:
    run = Run(pendulum(), t_end=1.0)
    start = run.core.state
    run.advance(0.9)
    slack = run.core.state.values
    for values, closed, words in (
        (start.values, "chain", "'chain' holds"),
        (slack, "wire", r"'wire'.* open by 0\.\d+ m"),
    ):
        wrong = State(time=0.0, values=values, inputs=start.inputs, closed=[closed])
        with pytest.raises(SceneError, match=words):
            Run(pendulum(), t_end=1.0, start=wrong)


@pytest.mark.warns(sometimes=["EnergyErrorWarning"])
@pytest.mark.parametrize("restitution", [0.3, 0.9])
@pytest.mark.parametrize("make", [ball, pendulum])
def test_rebounds_shorter_than_a_step_do_not_sink_into_a_limit(make: Any, restitution: float) -> None:
    """Nor end the run, but in a contact; by a method of order 1 the overlap falls like the step squared."""
    scene = make(restitution=restitution)
    for step, most in ((0.02, 1e-3), (0.005, 6e-5)):
        result = simulate(scene, t_end=8.0, dt_out=0.002, integrator="semi-implicit-euler", dt=step)
        at = result.select("position", body="ball")
        gap = at[:, 2] if make is ball else LENGTH - np.linalg.norm(at, axis=1)
        assert -gap.min() < most
        again = simulate(scene, t_end=8.1, start=result.state, integrator="semi-implicit-euler", dt=step)
        assert again.time[-1] == pytest.approx(8.1)
