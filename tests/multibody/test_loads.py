"""Loads against closed-form motions: gravity, springs, point forces, tables, C functions, controllers."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
import pytest
from multibody_runs import Array, quaternion_about, record
from named import on_joint

from seacrane import SampledController, Scene, simulate

MASS, INERTIA = 2.0, (0.3, 0.4, 0.5)


def ball(*, gravity: float = 0.0, **start: object) -> Scene:
    scene = Scene(gravity=gravity)
    scene.add_body(name="ball", mass=MASS, inertia=INERTIA, **start)
    return scene


def test_gravity_throws_a_parabola_of_the_center_of_mass() -> None:
    velocity, spin, offset = np.array([1.0, 2.0, 8.0]), np.array([0.0, 3.0, 0.0]), np.array([0.0, 0.0, 0.4])
    scene = ball(gravity=9.81, velocity=velocity, angular_velocity=spin, center_of_mass=offset)
    scene.add_body(name="weightless", mass=MASS, inertia=INERTIA, velocity=velocity, gravity=False)
    out = record(scene, 1.5)
    t = out["time"][:, None]
    start = velocity + np.cross(spin, offset)
    fall = offset + start * t - 0.5 * np.array([0.0, 0.0, 9.81]) * t**2
    np.testing.assert_allclose(out["position"][:, 0], fall, atol=1e-7)
    np.testing.assert_allclose(out["velocity"][:, 1], np.broadcast_to(velocity, (31, 3)), atol=1e-12)


def damped(t: Array, stiffness: float, damping: float) -> tuple[Array, Array]:
    """Free motion of the ball on a spring and damper, from a place of 1 m and from a speed of 1 m/s."""
    decay = damping / (2.0 * MASS)
    omega = np.sqrt(stiffness / MASS - decay**2)
    swing = np.exp(-decay * t)
    across = swing * np.sin(omega * t) / omega
    return swing * np.cos(omega * t) + decay * across, across


@pytest.mark.parametrize("damping", [0.0, 6.0])
def test_linear_spring_and_damper(damping: float) -> None:
    stiffness, natural, start = 50.0, 1.0, 1.4
    scene = ball(position=(start, 0.0, 0.0))
    scene.add_spring(
        name="spring", first="ground", second="ball", stiffness=stiffness, damping=damping,
        natural_length=natural,
    )  # fmt: skip
    out = record(scene, 3.0, rtol=1e-9)
    x = natural + (start - natural) * damped(out["time"], stiffness, damping)[0]
    np.testing.assert_allclose(out["position"][:, 0, 0], x, atol=1e-7)
    lost = 0.5 * stiffness * (start - natural) ** 2
    assert np.max(np.abs(out["energy_balance"])) < 1e-7 * lost
    assert (out["absolute_work"][-1] > 0.5 * lost) == (damping > 0.0)


def test_tabulated_spring() -> None:
    """Tension 0 below 1 m, 40 (l - 1) to 1.5 m, then 20 N: slack, soft and yielding pieces."""
    table = {"lengths": [1.0, 1.5], "forces": [0.0, 20.0]}
    scene = ball(position=(2.0, 0.0, 0.0))
    scene.add_spring(name="rope", first="ground", second="ball", **table)
    out = record(scene, 2.0, rtol=1e-9, dt_out=0.01)
    t, x = out["time"], out["position"][:, 0, 0]
    # Constant pull of 20 N from 2 m to 1.5 m, then a harmonic stretch, then free flight.
    acceleration = 20.0 / MASS
    first = np.sqrt(2.0 * 0.5 / acceleration)
    np.testing.assert_allclose(x[t < first], 2.0 - 0.5 * acceleration * t[t < first] ** 2, atol=1e-7)
    speed, omega = acceleration * first, np.sqrt(40.0 / MASS)
    # 1 + 0.5 cos(w s) - v / w sin(w s) meets 1 at tan(w s) = 0.5 w / v.
    second = first + np.arctan2(0.5 * omega, speed) / omega
    middle = (t > first) & (t < second)
    s = t[middle] - first
    np.testing.assert_allclose(
        x[middle], 1.0 + 0.5 * np.cos(omega * s) - speed / omega * np.sin(omega * s), atol=1e-6
    )
    final = np.sqrt(speed**2 + 20.0 * 0.5 / MASS)  # its energy: 20 N over 0.5 m, then half of that
    late = (t > second) & (t < second + 1.9 / final)  # until the rope is taut on the other side
    np.testing.assert_allclose(out["velocity"][late, 0, 0], -final, atol=1e-6)
    assert np.max(np.abs(out["energy_balance"])) < 1e-6


def test_spring_pulls_both_bodies_at_their_points() -> None:
    scene = ball(position=(1.0, 0.0, 0.0))
    scene.add_body(name="other", mass=3.0, inertia=INERTIA, position=(-1.0, 0.5, 0.0))
    scene.add_spring(
        name="spring", first="ball", second="other", first_point=(0, 0, 0.2), second_point=(0, 0.1, 0),
        stiffness=80.0, damping=1.0, natural_length=1.0,
    )  # fmt: skip
    out = record(scene, 1.0)
    momentum = MASS * out["velocity"][:, 0] + 3.0 * out["velocity"][:, 1]
    assert np.max(np.abs(momentum)) < 1e-10
    stretch = np.array([-2.0, 0.6, -0.2])  # from point to point
    pull = 80.0 * (np.linalg.norm(stretch) - 1.0) * stretch / np.linalg.norm(stretch)
    np.testing.assert_allclose(out["acceleration"][0, 0], pull / MASS, rtol=1e-12)
    turning = np.cross([(0.0, 0.0, 0.2), (0.0, 0.1, 0.0)], [pull, -pull]) / INERTIA
    np.testing.assert_allclose(out["angular_acceleration"][0], turning, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("body_axes", [False, True])
def test_point_force_in_inertial_or_body_axes(body_axes: bool) -> None:
    scene, force = ball(quaternion=quaternion_about((0, 0, 1), 0.5 * np.pi)), np.array([3.0, 0.0, 1.0])
    scene.add_force("ball", name="push", force=force, point=(0.2, 0, 0), body_axes=body_axes)
    out = record(scene, 0.1)
    # Body x lies along inertial y and body y along -x.
    inertial = np.array([0.0, 3.0, 1.0]) if body_axes else force
    moment, world = np.cross([0.0, 0.2, 0.0], inertial), np.array([INERTIA[1], INERTIA[0], INERTIA[2]])
    np.testing.assert_allclose(out["acceleration"][0, 0], inertial / MASS, atol=1e-12)
    np.testing.assert_allclose(out["angular_acceleration"][0, 0], moment / world, atol=1e-12)


def test_force_table_is_linear_between_its_times_and_held_outside() -> None:
    scene = ball()
    loads = [[2.0, 0, 0, 0, 0, 0], [4.0, 0, 0, 0, 0, 0.5]]
    scene.add_force("ball", name="gust", times=[1.0, 2.0], force=loads)
    out = record(scene, 3.0, maximum_step=0.05, dt_out=0.5)
    np.testing.assert_allclose(out["acceleration"][:, 0, 0] * MASS, [2, 2, 2, 3, 4, 4, 4], atol=1e-12)
    # The impulse: 2 N over 1 s, 3 N s on the slope, 4 N over 1 s. Steps end anywhere around the two kinks,
    # each costs at most (slope 2 N/s) h^2 / 2 / m with h = 0.05 s.
    np.testing.assert_allclose(out["velocity"][-1, 0, 0], 9.0 / MASS, atol=2.5e-3 / MASS)
    np.testing.assert_allclose(out["angular_velocity"][-1, 0, 2], (0.25 + 0.5) / INERTIA[2], atol=2e-3)


def test_c_function_pointer_sees_the_state_and_its_parameters() -> None:
    seen: list[list[float]] = []

    @ctypes.CFUNCTYPE(None, ctypes.c_double, *[ctypes.POINTER(ctypes.c_double)] * 3)
    def pull(t: float, state: Any, parameters: Any, wrench: Any) -> None:
        seen.append([state[i] for i in range(13)])
        for i in range(3):  # a spring to the origin and a drag, and a moment about z that grows
            wrench[i] = -parameters[0] * state[i] - parameters[1] * state[7 + i]
        wrench[5] = 0.1 * t

    scene = ball(position=(0.5, 0.0, 0.0), velocity=(0.0, 1.0, 0.0), quaternion=(0.6, 0.8, 0.0, 0.0))
    scene.add_force("ball", name="pull", force=pull, parameters=[32.0, 2.0])
    out = record(scene, 2.0, rtol=1e-9)
    np.testing.assert_allclose(seen[0], [0.5, 0, 0, 0.6, 0.8, 0, 0, 0, 1, 0, 0, 0, 0], atol=1e-12)
    t = out["time"]
    free, pushed = damped(t, 32.0, 2.0)
    np.testing.assert_allclose(out["position"][:, 0, 0], 0.5 * free, atol=1e-7)
    np.testing.assert_allclose(out["position"][:, 0, 1], pushed, atol=1e-7)
    assert np.max(np.abs(out["energy_balance"])) < 1e-6


def cart(**actuator: float) -> Scene:
    scene = on_joint("cart", mass=MASS, gravity=0.0)
    scene.add_actuator(joint="rail", name="motor", **actuator)
    return scene


def test_actuator_is_a_spring_and_damper_to_its_reference() -> None:
    out = record(cart(stiffness=50.0, damping=4.0, reference=0.3, feed_forward=5.0), 3.0, rtol=1e-9)
    rest = 0.3 + 5.0 / 50.0
    x = rest - rest * damped(out["time"], 50.0, 4.0)[0]
    np.testing.assert_allclose(out["coordinate"][:, 0], x, atol=1e-7)
    force = 5.0 + 50.0 * (0.3 - out["coordinate"][:, 0]) - 4.0 * out["coordinate_rate"][:, 0]
    np.testing.assert_allclose(out["actuator_force"][:, 0], force, atol=1e-10)


def test_sampled_controller_at_20_hz_equals_its_difference_equation() -> None:
    period, gain, damp = 0.05, 30.0, 8.0
    calls: list[tuple[float, float]] = []

    def control(time: float, measured: object) -> dict[str, float]:
        x, v = measured["coordinate"][0], measured["coordinate_rate"][0]
        calls.append((time, x))
        return {"motor.force": gain * (1.0 - x) - damp * v}

    result = simulate(
        cart(), t_end=2.0, dt_out=period, controllers=[SampledController(period=period, function=control)]
    )
    np.testing.assert_allclose([time for time, _ in calls], period * np.arange(40), atol=1e-12)
    x, v, expected = 0.0, 0.0, []
    for _ in range(41):
        expected.append(x)
        force = gain * (1.0 - x) - damp * v  # held until the next sample
        x, v = x + v * period + 0.5 * force / MASS * period**2, v + force / MASS * period
    np.testing.assert_allclose(result.channels["coordinate"][:, 0], expected, atol=1e-10)
    np.testing.assert_allclose([x for _, x in calls], expected[:40], atol=1e-10)
    assert abs(expected[-1] - 1.0) < 0.1
