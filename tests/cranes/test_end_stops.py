"""End stops, seats that are lifted off, soft stops and friction: against closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from event_scenes import GRAVITY, INERTIA, MASS, lift, pushed
from named import on_joint

from seacrane import Result, Run, Scene, SimulationError, cases, simulate


def test_stop_holds_while_it_is_pushed_and_lets_go_when_the_load_turns() -> None:
    result = simulate(pushed(), t_end=2.0, dt_out=0.01, rtol=1e-10)
    # from rest: x = (F0 / m w^2) (cos(w t) - 1); it stays until the load turns at w t = pi / 2
    reach = np.arccos(1.0 - 0.5 * MASS * 4.0 / 30.0) / 2.0
    assert [(e.name, e.kind) for e in result.events[:1]] == [("rail.minimum", "contact")]
    assert result.events[0].time == pytest.approx(reach, abs=1e-9)
    assert result.events[1].time == pytest.approx(np.pi / 4.0, abs=1e-9)
    held = (result.time > reach) & (result.time < np.pi / 4.0)
    np.testing.assert_allclose(result["coordinate"][held, 0], -0.5, atol=1e-12)
    np.testing.assert_allclose(
        result["limit_force"][held, 0], 30.0 * np.cos(2.0 * result.time[held]), rtol=1e-9
    )
    assert np.abs(result["energy_balance"]).max() < 1e-8
    # and from there x = -0.5 + (F0 / m w^2) (1 - sin) ... integrated twice from rest at pi / 4
    free = (result.time > np.pi / 4.0) & (result.time < 1.3)
    s = result.time[free] - np.pi / 4.0
    moved = 30.0 / MASS / 4.0 * (2.0 * s - np.sin(2.0 * s))
    np.testing.assert_allclose(result["coordinate"][free, 0], -0.5 + moved, atol=1e-8)


@pytest.mark.parametrize("merge", [True, False])
def test_load_leaves_the_deck_when_the_hoist_carries_its_weight(merge: bool) -> None:
    rate, stiffness = 0.2, 2.0e3
    scene = lift(rate, stiffness)
    run = Run(
        scene, t_end=1.0, dt_out=0.01, rtol=1e-10, model=scene.compile(merge=merge), formulation="redundant"
    )
    run.advance(1.0)
    result = run.result()
    off = MASS * GRAVITY / (stiffness * rate)
    assert [(e.name, e.kind) for e in result.events] == [("deck", "release")]
    assert result.events[0].time == pytest.approx(off, abs=1e-9)
    s = np.maximum(result.time - off, 0.0)
    omega = np.sqrt(stiffness / MASS)
    expected = rate * (s - np.sin(omega * s) / omega)
    np.testing.assert_allclose(result.select("position", body="load", axis="z"), expected, atol=1e-8)
    pressed = np.maximum(MASS * GRAVITY - stiffness * rate * result.time, 0.0)
    np.testing.assert_allclose(result["limit_force"][:, 0], pressed, atol=1e-6)


def test_several_limits_reached_at_once_share_one_impact() -> None:
    scene = Scene(name="plate")
    scene.add_body(name="plate", mass=MASS, inertia=INERTIA, position=(0.0, 0.0, 1.0))
    feet = {"a": (1.0, 0.0, 1.0), "b": (-0.5, 0.8, 1.0), "c": (-0.5, -0.8, 1.0)}
    for name, point in feet.items():
        scene.add_joint(kind="free", name=name, first="ground", second="plate", point=point)
        scene.add_stop(joint=name, coordinate="z", minimum=-1.0)
    result = simulate(scene, t_end=1.0, dt_out=0.05, rtol=1e-9)
    assert {e.name for e in result.events} == set(feet)
    assert all(e.kind == "contact" for e in result.events)
    np.testing.assert_allclose([e.time for e in result.events], np.sqrt(2.0 / GRAVITY), atol=1e-8)
    np.testing.assert_allclose(result["limit_force"][-1], [MASS * GRAVITY / 3.0] * 3, rtol=1e-9)
    assert sum(e.energy_lost for e in result.events) == pytest.approx(MASS * GRAVITY, rel=1e-8)


def test_friction_slows_a_slide_by_its_closed_form() -> None:
    load, speed, start = 6.0, 0.05, 1.5
    scene = on_joint("slide", mass=MASS, gravity=0.0, velocity=(start, 0.0, 0.0))
    scene.add_friction(joint="rail", load=load, speed=speed)
    result = simulate(scene, t_end=1.2, dt_out=0.05, rtol=1e-10)
    # sinh(v / s) falls like exp(-F t / (m s))
    v = speed * np.arcsinh(np.sinh(start / speed) * np.exp(-load * result.time / (MASS * speed)))
    np.testing.assert_allclose(result.select("velocity", body="slide", axis="x"), v, atol=1e-7)
    assert np.abs(result["energy_balance"]).max() < 1e-7


def test_soft_stop_returns_what_is_not_damped() -> None:
    stiffness, start = 5.0e3, 1.2

    def slide(damping: float) -> Result:
        scene = on_joint("slide", mass=MASS, gravity=0.0, velocity=(start, 0.0, 0.0))
        scene.add_stop(joint="rail", maximum=0.6, stiffness=stiffness, damping=damping)
        return simulate(scene, t_end=1.5, dt_out=0.01, rtol=1e-10, formulation="redundant")

    free = slide(0.0)
    x = free.select("position", body="slide", axis="x")
    half = np.pi * np.sqrt(MASS / stiffness)  # a half period of the spring
    back = 0.6 - start * (free.time - 0.5 - half)
    away = free.time > 0.5 + half
    np.testing.assert_allclose(x[away], back[away], atol=1e-7)
    damped = slide(0.05)
    returned = -damped.select("velocity", body="slide", axis="x")[-1]
    # Hunt and Crossley's estimate for small damping: e = 1 - 2/3 damping v
    assert returned / start == pytest.approx(1.0 - 2.0 / 3.0 * 0.05 * start, abs=0.003)
    assert np.abs(damped["energy_balance"]).max() < 1e-8


def test_cylinder_of_a_crane_afloat_runs_onto_its_stop(formulation: str) -> None:
    """The boom stops, its payload flies on, the wire snatches and lifts the boom off again; then it rests."""
    scene = cases.case2()
    scene.add_stop(joint="main_cylinder", minimum=-1.0, maximum=0.05)
    scene.add_line(joint="link", rung="rigid")
    result = simulate(scene, t_end=8.0, dt_out=0.25, rtol=1e-8, formulation=formulation)
    assert [(e.name, e.kind) for e in result.events[:4]] == [
        ("main_cylinder.maximum", "contact"), ("link", "release"),
        ("main_cylinder.maximum", "release"), ("link", "contact"),
    ]  # fmt: skip
    assert result.events[0].time == pytest.approx(6.6251759, abs=1e-6)
    held = result.time > result.events[-1].time
    np.testing.assert_allclose(result.select("stroke", cylinder="main")[held], 0.05, atol=1e-10)
    assert np.all(result["limit_force"][held][:, 1:] > 0.0)  # of the stop at its maximum, and of the wire
    assert np.abs(result["energy_balance"]).max() < 1e-8 * result["absolute_work"][-1]
    assert result["constraint_error"].max() < 1e-9


@pytest.mark.parametrize(("coordinate", "method"), [("yaw", {}), ("roll", {"integrator": "rk4", "dt": 0.7})])
def test_a_stop_on_roll_or_yaw_is_not_carried_through_a_pitch_of_90_deg(
    coordinate: str, method: dict[str, Any]
) -> None:
    """Not even by a step that leaps over it. Roll and yaw jump by 180 deg there, which is no impact."""
    scene = Scene(name="tumbler", gravity=0.0)
    scene.add_body(name="body", mass=MASS, inertia=INERTIA, angular_velocity=(0.0, 1.0, 0.0))
    scene.add_joint(kind="free", name="air", first="ground", second="body")
    scene.add_stop(joint="air", coordinate=coordinate, minimum=-3.0, maximum=3.0, restitution=1.0)
    words = rf"limit '.*' on joint 'air': pitch is near 90 deg .* where {coordinate} is"
    with pytest.raises(SimulationError, match=words) as error:
        simulate(scene, t_end=5.0, **method)
    result = error.value.result
    assert result is not None and result.events == () and result.time[-1] < 1.6
