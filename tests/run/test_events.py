"""Wires that go slack and balls that bounce: events against closed forms and SciPy, by every integrator."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from event_scenes import (
    FIRST_SPEED,
    GRAVITY,
    HEIGHT,
    INERTIA,
    LENGTH,
    MASS,
    Array,
    ball,
    pendulum,
    scipy_pendulum,
)

from seacrane import Run, Scene, SceneError, State, cases, integrator_names, simulate
from seacrane._core import Body
from seacrane.errors import ChatteringError


def bounces(restitution: float, count: int) -> tuple[Array, Array]:
    """Times of a ball's bounces and the energy lost in each."""
    fall, speed = np.sqrt(2.0 * HEIGHT / GRAVITY), np.sqrt(2.0 * GRAVITY * HEIGHT)
    k = np.arange(count)
    times = fall + np.concatenate([[0.0], np.cumsum(2.0 * restitution ** (k[1:]) * speed / GRAVITY)])
    return times, 0.5 * MASS * (speed * restitution**k) ** 2 * (1.0 - restitution**2)


def test_ball_bounces_at_the_times_and_with_the_energies_of_the_closed_form() -> None:
    result = simulate(ball(), t_end=2.0, dt_out=0.05, rtol=1e-8)
    times, lost = bounces(0.5, 5)
    events = result.events[:5]
    assert [e.kind for e in events] == ["rebound"] * 5
    assert {e.name for e in events} == {"floor"}
    np.testing.assert_allclose([e.time for e in events], times, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose([e.energy_lost for e in events], lost, rtol=1e-8)
    speed = np.sqrt(2.0 * GRAVITY * HEIGHT)
    np.testing.assert_allclose([e.speed for e in events], speed * 0.5 ** np.arange(5), rtol=1e-8)
    np.testing.assert_allclose(
        [e.impulse for e in events], 1.5 * MASS * speed * 0.5 ** np.arange(5), rtol=1e-8
    )


def test_energy_lost_in_impacts_is_booked_and_the_balance_stays_closed() -> None:
    result = simulate(ball(), t_end=3.0, dt_out=0.01, rtol=1e-8)
    assert np.abs(result["energy_balance"]).max() < 1e-9 * MASS * GRAVITY * HEIGHT
    total = sum(e.energy_lost for e in result.events)
    assert result["impact_loss"][-1] == pytest.approx(total, rel=1e-12)
    assert result.stats["impact_energy_lost_J"] == pytest.approx(total, rel=1e-12)
    # at rest in the end: all that it had has gone
    assert total == pytest.approx(MASS * GRAVITY * HEIGHT, rel=1e-6)
    assert result.events[-1].kind == "contact"
    assert result["limit_force"][-1, 0] == pytest.approx(MASS * GRAVITY, rel=1e-9)
    assert abs(result.select("position", body="ball", axis="z")[-1]) < 1e-9


def test_no_energy_is_lost_with_restitution_one() -> None:
    result = simulate(ball(restitution=1.0), t_end=20.0, dt_out=0.5, rtol=1e-9)
    times = np.array([e.time for e in result.events])
    period = 2.0 * np.sqrt(2.0 * HEIGHT / GRAVITY)
    np.testing.assert_allclose(times, period * (np.arange(times.size) + 0.5), rtol=0.0, atol=1e-7)
    assert times.size == int(20.0 / period + 0.5)
    assert abs(sum(e.energy_lost for e in result.events)) < 1e-9


def test_chattering_ends_in_an_error_that_names_limit_joint_and_time() -> None:
    restitution = 0.95
    end = np.sqrt(2.0 * HEIGHT / GRAVITY) * (1.0 + restitution) / (1.0 - restitution)
    with pytest.raises(
        ChatteringError, match=r"limit 'floor' on joint 'air': chatters, .* at t = ([\d.]+) s"
    ) as e:
        simulate(ball(restitution=restitution, sticking_speed=0.0), t_end=40.0, dt_out=1.0, rtol=1e-6)
    assert f"t = {end:.4f}" in str(e.value)
    # what it did until then is there, and the state is not beyond the floor
    partial = e.value.result
    assert partial is not None
    assert partial.state is not None
    assert partial.events[0].kind == "rebound"
    assert partial.state.time == pytest.approx(end, abs=1e-3)
    assert abs(partial.state.values[2]) < 1e-6
    # with the default it comes to rest
    result = simulate(ball(restitution=restitution), t_end=40.0, dt_out=1.0, rtol=1e-6)
    assert result.events[-1].kind == "contact"
    assert result.events[-1].time == pytest.approx(end, abs=0.01)


def slack_angle() -> float:
    """From the bottom: where the tension m (v^2 / L + g cos) is zero."""
    return float(np.arccos((2.0 * GRAVITY * LENGTH - FIRST_SPEED**2) / (3.0 * GRAVITY * LENGTH)))


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_pendulum_goes_slack_at_the_closed_form_angle_and_follows_scipy(formulation: str) -> None:
    result = simulate(pendulum(), t_end=4.0, dt_out=0.02, rtol=1e-10, formulation=formulation)
    expected, events = scipy_pendulum(result.time, 0.0)
    kinds = [e.kind for e in result.events]
    assert kinds[:3] == ["release", "contact", "release"] or kinds[:2] == ["release", "contact"]
    np.testing.assert_allclose([e.time for e in result.events], events, rtol=0.0, atol=2e-8)
    first = np.argmax(result.time > events[0])
    reached = result.select("position", body="ball")[first - 1]
    assert abs(np.arctan2(reached[0], -reached[2])) < slack_angle()
    np.testing.assert_allclose(
        result.select("position", body="ball")[:, [0, 2]], expected, rtol=0.0, atol=1e-7
    )
    tension = result.select("tension", link="wire")
    slack = (result.time > events[0]) & (result.time < events[1])
    assert np.all(tension[slack] == 0.0)
    assert np.all(tension[result.time < events[0]] > 0.0)
    assert np.abs(result["energy_balance"]).max() < 1e-6


def test_slack_begins_at_the_closed_form_angle() -> None:
    run = Run(pendulum(), t_end=2.0, rtol=1e-11)
    run.advance(2.0)
    event = run.result().events[0]
    # energy integral of the pendulum up to that angle, by quadrature
    from scipy.integrate import quad

    time, _ = quad(
        lambda a: LENGTH / np.sqrt(FIRST_SPEED**2 - 2.0 * GRAVITY * LENGTH * (1.0 - np.cos(a))),
        0.0, slack_angle(), epsabs=1e-12,
    )  # fmt: skip
    assert event.kind == "release"
    assert event.time == pytest.approx(time, abs=1e-9)


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
    load = scene.bodies["payload"]
    scene.bodies["payload"] = Body(
        name=load.name, mass=load.mass, inertia=load.inertia, center_of_mass=load.center_of_mass,
        position=load.position, quaternion=load.quaternion, velocity=(0.0, 0.0, 1.0),
    )  # fmt: skip
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
    scene.add_body(
        name="a", mass=2.0, inertia=(0.5, 0.7, 0.9), position=(0.0, 0.0, 0.0), velocity=(-1.0, 0.2, 0.0)
    )
    scene.add_body(
        name="b", mass=5.0, inertia=(1.5, 1.1, 0.6), position=(1.0, 0.0, 0.0), velocity=(2.0, 0.0, 0.5)
    )
    scene.add_joint(
        kind="distance", name="wire", first="a", second="b", point=(0.0, 0.1, 0.2),
        second_point=(1.0, -0.2, 0.0), length=3.0,
    )  # fmt: skip
    scene.add_line(joint="wire", rung="rigid", restitution=restitution)
    return scene


@pytest.mark.parametrize("restitution", [0.0, 0.6, 1.0])
def test_momentum_is_kept_through_an_impact(restitution: float) -> None:
    result = simulate(thrown(restitution), t_end=1.5, dt_out=0.01, rtol=1e-10)
    assert result.events[0].kind == ("rebound" if restitution else "contact")
    mass, inertia = np.array([2.0, 5.0]), np.array([[0.5, 0.7, 0.9], [1.5, 1.1, 0.6]])
    momentum = np.einsum("b,tba->ta", mass, result["velocity"])
    np.testing.assert_allclose(momentum, np.broadcast_to(momentum[0], momentum.shape), atol=1e-9)
    from scipy.spatial.transform import Rotation

    spin = np.empty_like(momentum)
    for i in range(result.time.size):
        spin[i] = np.einsum("b,bi->i", mass, np.cross(result["position"][i], result["velocity"][i]))
        for b in range(2):
            r = Rotation.from_quat(np.roll(result["quaternion"][i, b], -1)).as_matrix()
            spin[i] += r @ (inertia[b] * (r.T @ result["angular_velocity"][i, b]))
    np.testing.assert_allclose(spin, np.broadcast_to(spin[0], spin.shape), atol=1e-8)
    assert np.abs(result["energy_balance"]).max() < 1e-7
    if restitution == 1.0:
        assert abs(result.events[0].energy_lost) < 1e-9
    else:
        assert result.events[0].energy_lost > 0.0


def test_what_starts_pulled_at_is_let_go_at_once() -> None:
    """A wire described stretched above its hook: its tension would be negative."""
    scene = Scene(name="above")
    scene.add_body(name="ball", mass=MASS, inertia=INERTIA, position=(0.0, 0.0, LENGTH))
    scene.add_joint(
        kind="distance", name="wire", first="ground", second="ball", point=(0.0, 0.0, 0.0),
        second_point=(0.0, 0.0, LENGTH),
    )  # fmt: skip
    scene.add_line(joint="wire", rung="rigid")
    result = simulate(scene, t_end=0.5, dt_out=0.1, rtol=1e-9)
    assert (result.events[0].time, result.events[0].kind) == (0.0, "release")
    fallen = LENGTH - 0.5 * GRAVITY * result.time**2
    np.testing.assert_allclose(result.select("position", body="ball", axis="z"), fallen, atol=1e-9)


def test_wire_that_stays_taut_changes_nothing_in_a_lift() -> None:
    plain = cases.case2()
    limited = plain.copy()
    limited.add_line(joint="link", rung="rigid")
    before = simulate(plain, t_end=5.0, dt_out=0.5, rtol=1e-8)
    after = simulate(limited, t_end=5.0, dt_out=0.5, rtol=1e-8)
    assert after.events == ()
    assert after.stats["formulation"] == before.stats["formulation"]
    np.testing.assert_allclose(after["position"], before["position"], atol=1e-6)
    np.testing.assert_allclose(after["link_tension"], before["link_tension"], rtol=1e-5)


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
@pytest.mark.parametrize(("integrator", "setting"), [("dopri5", {"rtol": 1e-7}), ("rk4", {"dt": 0.01})])
def test_a_run_goes_on_bit_for_bit_with_the_limits_that_hold(
    formulation: str, integrator: str, setting: dict[str, float]
) -> None:
    """Stopped taut, slack, and taut again: what follows are the same events and the same states."""
    settings: dict[str, Any] = {"integrator": integrator, "formulation": formulation, "t_end": 4.0, **setting}
    whole = Run(pendulum(restitution=0.2), **settings)
    for stop, closed in ((0.3, ["wire"]), (1.2, []), (2.3, ["wire"])):
        whole.advance(stop)
        state = whole.core.state
        assert state.closed == closed
        copied = State(
            time=state.time, values=state.values, inputs=state.inputs, steps=state.steps, closed=state.closed
        )
        rest = Run(pendulum(restitution=0.2), start=copied, **settings)
        rest.advance(2.8)
        straight = Run(pendulum(restitution=0.2), **settings)
        for t in (t for t in (0.3, 1.2, 2.3) if t <= stop):
            straight.advance(t)
        straight.advance(2.8)
        np.testing.assert_array_equal(rest.core.state.values, straight.core.state.values)
        assert rest.core.events() == [e for e in straight.core.events() if e[0] > stop]


def test_a_state_with_limits_of_another_scene_is_refused() -> None:
    run = Run(pendulum(), t_end=1.0)
    state = run.core.state
    alien = State(time=0.0, values=state.values, inputs=state.inputs, closed=["chain"])
    with pytest.raises(SceneError, match="limit 'chain' holds, which this scene does not have"):
        Run(pendulum(), t_end=1.0, start=alien)
    run.advance(0.9)
    slack = run.core.state
    wrong = State(time=0.9, values=slack.values, inputs=slack.inputs, closed=["wire"])
    with pytest.raises(SceneError, match=r"limit 'wire' is to hold, but open by 0\.\d+ m"):
        Run(pendulum(), t_end=1.0, start=wrong)


@pytest.mark.warns(sometimes=["EnergyErrorWarning"])
@pytest.mark.parametrize("restitution", [0.3, 0.9])
@pytest.mark.parametrize("make", [ball, pendulum])
def test_rebounds_shorter_than_a_step_neither_sink_into_a_limit_nor_end_the_run(
    make: Any, restitution: float
) -> None:
    """They end in a contact; by a method of order 1 the overlap falls like the step squared."""
    overlaps = []
    for step in (0.02, 0.005):
        scene = make(restitution=restitution)
        result = simulate(scene, t_end=8.0, dt_out=0.002, integrator="semi-implicit-euler", dt=step)
        at = result.select("position", body="ball")
        gap = at[:, 2] if make is ball else LENGTH - np.linalg.norm(at, axis=1)
        overlaps.append(-gap.min())
        again = simulate(scene, t_end=8.1, start=result.state, integrator="semi-implicit-euler", dt=step)
        assert again.time[-1] == pytest.approx(8.1)
    assert overlaps[0] < 1e-3
    assert overlaps[1] < 6e-5
