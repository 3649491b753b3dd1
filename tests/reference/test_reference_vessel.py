"""Vessel loads: linear theory, energy, frames, memory against convolution."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from . import ten_body
from .convolution import kernel_of_damping, kernel_of_model, memory_force
from .kinematics import Motion
from .linear_vessel import LinearVessel, motion_amplitude, rigid_mass
from .rotation import Array, matrix_from_quaternion, rotation_exponential, yaw_matrix, yaw_pitch_roll
from .simulate import simulate
from .system import System
from .vessel import MemoryModel


def alone(**changes: Any) -> dict[str, Any]:
    """The vessel of the ten-body scene by itself, with changed hydrodynamic fields."""
    hull, vessel = ten_body.vessel_records()
    hull = {**hull, "position": [0.5, 0.0, 1.0]}  # off the reference point, so that every coupling acts
    return {"bodies": [hull], "vessel": {**vessel, **changes}}


def displaced(records: dict[str, Any], eta: Array) -> dict[str, Any]:
    """The scene with the vessel moved by surge, sway, heave, roll, pitch, yaw from rest."""
    hull = records["bodies"][0]
    roll, pitch, yaw = eta[3:]
    cx, sx, cy, sy = math.cos(roll / 2), math.sin(roll / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    cz, sz = math.cos(yaw / 2), math.sin(yaw / 2)
    quaternion = [
        cx * cy * cz + sx * sy * sz,
        sx * cy * cz - cx * sy * sz,
        cx * sy * cz + sx * cy * sz,
        cx * cy * sz - sx * sy * cz,
    ]
    center = matrix_from_quaternion(quaternion) @ np.asarray(hull["position"]) + eta[:3]
    vessel = {**records["vessel"], "reference_point": eta[:3].tolist(), "rest_position": [0.0, 0.0, 0.0]}
    moved = {**hull, "quaternion": quaternion, "position": center.tolist()}
    return {**records, "bodies": [moved], "vessel": vessel}


def test_start_pose_is_read_back_as_motion() -> None:
    eta = np.array([1.0, -2.0, 0.5, 0.3, -0.2, 0.7])
    system = System.from_records(displaced(alone(), eta))
    assert system.vessel is not None
    read = system.vessel.displacement(system.vectors.evaluate(system.start))
    np.testing.assert_allclose(read, eta, atol=1e-12)


@pytest.mark.parametrize("motion", range(6))
def test_small_free_decay_equals_the_linear_solution(motion: int) -> None:
    records = alone(waves=None, quadratic_roll_damping=0.0)
    eta = np.zeros(6)
    eta[motion] = 1e-4
    times = np.linspace(0.0, 40.0, 41)
    expected, _ = LinearVessel.from_records(records).simulate(times, eta, np.zeros(6))
    out = simulate(System.from_records(displaced(records, eta)), 40.0, times, rtol=1e-9, atol=1e-14)
    np.testing.assert_allclose(out["vessel_motion"], expected, atol=1e-8)


def test_small_regular_wave_gives_the_frequency_response() -> None:
    omega = np.array([0.8])
    force = 1e-3 * np.array([[4e5j, 2e6, 6e6 + 1e6j, 4e6j, 1.5e8, 5e7j]])
    waves = {"omega": omega.tolist(), "force_real": force.real.tolist(), "force_imag": force.imag.tolist()}
    records = alone(waves=waves, quadratic_roll_damping=0.0)
    linear = LinearVessel.from_records(records)
    times = np.linspace(0.0, 60.0, 121)
    expected, _ = linear.simulate(times, np.zeros(6), np.zeros(6), omega, force)
    out = simulate(System.from_records(records), 60.0, times, rtol=1e-9, atol=1e-14)
    np.testing.assert_allclose(out["vessel_motion"], expected, atol=1e-3 * np.max(np.abs(expected)))
    added, damping = linear.added_mass_and_damping(omega)
    direct = motion_amplitude(omega, linear.mass, added, damping, linear.restoring, force)
    np.testing.assert_allclose(linear.response(omega, force), direct, rtol=1e-12)


def test_linear_solution_is_its_own_differential_equation() -> None:
    linear = LinearVessel.from_records(alone())
    assert np.max(linear.eigenvalues().real) < 0.0
    omega, force = np.array([0.9]), np.array([[1e5, 0, 1e6, 2e6j, 0, 1e7]])
    h = 1e-3
    times = 7.0 + h * np.arange(-1, 2)
    eta, rate = linear.simulate(times, np.full(6, 0.01), np.zeros(6), omega, force)
    np.testing.assert_allclose((eta[2] - eta[0]) / (2 * h), rate[1], atol=1e-6 * np.max(np.abs(rate)))
    late, _ = linear.simulate([6000.0], np.full(6, 0.01), np.zeros(6), omega, force)
    steady = (linear.response(omega, force)[0] * np.exp(1j * omega[0] * 6000.0)).real
    np.testing.assert_allclose(late[0], steady, atol=1e-6 * np.max(np.abs(steady)))


def test_rigid_mass_matches_the_kinetic_energy_of_a_moving_body() -> None:
    inertia, center = np.diag([1.0, 2.0, 3.0]), np.array([0.4, -0.3, 0.7])
    v, w = np.array([0.2, 0.5, -0.1]), np.array([0.3, -0.6, 0.4])
    twist = np.concatenate([v, w])
    speed = v + np.cross(w, center)
    energy = 0.5 * 2.5 * speed @ speed + 0.5 * w @ inertia @ w
    assert 0.5 * twist @ rigid_mass(2.5, inertia, center) @ twist == pytest.approx(energy, rel=1e-14)


def test_large_undamped_motion_conserves_energy() -> None:
    """Restoring, station keeping and added mass are conservative at 20 degrees of roll and yaw too."""
    _, vessel = ten_body.vessel_records()
    still = {"stiffness": vessel["station_keeping"]["stiffness"], "damping": [0.0] * 3}
    records = alone(waves=None, memory=None, damping=None, quadratic_roll_damping=0.0, station_keeping=still)
    records = displaced(records, np.array([3.0, -2.0, 1.0, 0.35, 0.15, 0.35]))
    records["bodies"][0]["angular_velocity"] = [0.05, 0.02, 0.05]
    out = simulate(System.from_records(records), 30.0, np.linspace(0.0, 30.0, 31), rtol=1e-10)
    assert np.ptp(out["vessel_motion"][:, 3]) > 0.5
    np.testing.assert_allclose(out["energy"], out["energy"][0], rtol=1e-10)
    assert np.all(out["absolute_work"] == 0.0)


def test_restoring_is_the_gradient_of_its_energy() -> None:
    records = displaced(alone(waves=None, damping=None), np.array([0.5, 1.0, 0.4, 0.3, -0.25, 0.6]))
    system = System.from_records(records)
    vessel = system.vessel
    assert vessel is not None

    def at(step: float, axis: int) -> Motion:
        motion = system.start.copy()
        twist = np.zeros(6)
        twist[axis] = step
        motion.r[0] += twist[:3]
        motion.rotation[0] = rotation_exponential(twist[3:]) @ motion.rotation[0]
        return motion

    def loads(motion: Motion) -> Any:
        return vessel.loads(0.0, system.vectors.evaluate(motion), np.zeros(system.memory_states))

    wrench = loads(system.start).wrench
    for axis in range(6):
        slope = (loads(at(1e-5, axis)).energy - loads(at(-1e-5, axis)).energy) / 2e-5
        assert wrench[axis] == pytest.approx(-slope, rel=1e-6, abs=1e-6 * np.max(np.abs(wrench)))


def test_response_turns_with_the_vessel() -> None:
    """Without station keeping, a yawed start gives the same motion seen from the yawed frame."""
    base = alone(station_keeping=None)
    times, yaw = np.linspace(0.0, 20.0, 11), 0.9
    straight = simulate(System.from_records(base), 20.0, times, rtol=1e-9)
    turned = simulate(
        System.from_records(displaced(base, np.array([0, 0, 0, 0, 0, yaw]))), 20.0, times, rtol=1e-9
    )
    np.testing.assert_allclose(
        turned["position"][:, 0], straight["position"][:, 0] @ yaw_matrix(yaw).T, atol=1e-7
    )
    angles = turned["vessel_motion"][:, 3:] - np.array([0.0, 0.0, yaw])
    np.testing.assert_allclose(angles, straight["vessel_motion"][:, 3:], atol=1e-8)
    assert np.max(np.abs(straight["vessel_motion"][:, 2])) > 0.01


def test_added_mass_alone_conserves_the_momentum_that_it_should() -> None:
    """Heave of a level body: m + A33 moves as one mass, its momentum grows by the impulse."""
    added = np.zeros((6, 6))
    added[2, 2] = 14e6
    records = alone(
        added_mass=added.tolist(), waves=None, memory=None, damping=None, restoring=None, station_keeping=None
    )
    records["point_forces"] = [{"body": "vessel", "point": [0.5, 0.0, 1.0], "force": [0.0, 0.0, 2.8e6]}]
    records["vessel"]["reference_point"] = [0.5, 0.0, 0.0]
    out = simulate(System.from_records(records), 10.0, [10.0], rtol=1e-10)
    np.testing.assert_allclose(out["velocity"][0, 0], [0.0, 0.0, 1.0], atol=1e-10)


def test_quadratic_roll_damping_removes_the_energy_it_dissipates() -> None:
    rate, damping, inertia = 0.2, 5e9, 1e9
    hull = {"name": "vessel", "mass": 1e6, "inertia": np.diag([inertia] * 3).tolist(), "position": [0, 0, 0]}
    body = {**hull, "quaternion": [1, 0, 0, 0], "angular_velocity": [rate, 0, 0]}
    records = {"bodies": [body], "vessel": {"body": "vessel", "quadratic_roll_damping": damping}}
    times = np.linspace(0.0, 5.0, 11)
    out = simulate(System.from_records(records), 5.0, times, rtol=1e-11)
    expected = rate / (1.0 + damping / inertia * rate * times)
    np.testing.assert_allclose(out["angular_velocity"][:, 0, 0], expected, rtol=1e-9)
    np.testing.assert_allclose(out["energy_balance"], 0.0, atol=1e-8 * out["energy"][0])


def test_memory_states_equal_the_convolution() -> None:
    records = alone()
    step = 0.05
    times = step * np.arange(401)
    system = System.from_records(records)
    out = simulate(system, 20.0, times, rtol=1e-10)
    u = np.empty((len(times), 6))
    for k, q in enumerate(out["quaternion"][:, 0]):
        rotation = matrix_from_quaternion(q)
        turn = yaw_matrix(yaw_pitch_roll(rotation)[2])
        w = out["angular_velocity"][k, 0]
        v = out["velocity"][k, 0] - np.cross(w, rotation @ np.array([0.5, 0.0, 1.0]))
        u[k] = np.concatenate([turn.T @ v, turn.T @ w])
    assert system.vessel is not None
    direct = memory_force(u, kernel_of_model(system.vessel.memory, times), step)
    scale = np.max(np.abs(out["memory_force"]), axis=0) + 1.0
    reached = slice(6, None)  # the first samples have no room for the end corrections
    np.testing.assert_allclose((direct / scale)[reached], (out["memory_force"] / scale)[reached], atol=2e-6)


def test_convolution_is_fourth_order() -> None:
    errors = []
    for count in (50, 100):
        step = 10.0 / count
        t = step * np.arange(count + 1)
        kernel, u = np.zeros((count + 1, 6, 6)), np.zeros((count + 1, 6))
        kernel[:, 2, 2], u[:, 2] = np.exp(-0.5 * t), np.sin(t)
        exact = (0.5 * np.sin(t) - np.cos(t) + np.exp(-0.5 * t)) / 1.25
        errors.append(np.max(np.abs(memory_force(u, kernel, step)[10:, 2] - exact[10:])))
    assert errors[0] / errors[1] > 12.0


def test_kernel_and_damping_are_a_transform_pair() -> None:
    memory = MemoryModel.from_record(ten_body.memory_record())
    omega = np.linspace(0.0, 60.0, 6001)
    damping = np.array([memory.transfer(w).real for w in omega])
    times = np.array([0.3, 1.0, 2.5, 6.0])
    exact = kernel_of_model(memory, times)
    error = kernel_of_damping(times, omega, damping) - exact
    assert np.max(np.abs(error)) < 2e-3 * np.max(np.abs(kernel_of_model(memory, [0.0])))
    assert np.all(np.diagonal(damping, axis1=1, axis2=2) >= -1e-6 * np.max(damping))


def test_kernel_of_linear_damping_is_exact_on_a_coarse_grid() -> None:
    """B = w up to 1 rad/s in a single interval: K = 2/pi (sin t / t + (cos t - 1) / t^2)."""
    damping = np.zeros((2, 6, 6))
    damping[1, 2, 2] = 1.0
    times = np.array([1e-6, 0.02, 0.7, 3.0, 40.0])
    exact = 2.0 / np.pi * (np.sin(times) / times - 0.5 * np.sinc(0.5 * times / np.pi) ** 2)
    np.testing.assert_allclose(kernel_of_damping(times, [0.0, 1.0], damping)[:, 2, 2], exact, rtol=1e-9)


def test_a_block_of_several_motions_is_placed_where_it_belongs() -> None:
    rng = np.random.default_rng(2)
    a, b, c = -np.eye(3), rng.normal(size=(3, 2)), rng.normal(size=(2, 3))
    block = {"inputs": [1, 3], "outputs": [3, 5], "A": a.tolist(), "B": b.tolist(), "C": c.tolist()}
    k = MemoryModel.from_record({"blocks": [block, block]}).transfer(0.7)
    expected = np.zeros((6, 6), dtype=complex)
    expected[np.ix_([3, 5], [1, 3])] = 2.0 * c @ np.linalg.solve(0.7j * np.eye(3) - a, b)
    np.testing.assert_allclose(k, expected, atol=1e-14)


def test_restoring_outside_heave_roll_pitch_is_refused() -> None:
    with pytest.raises(ValueError, match="heave, roll and pitch"):
        System.from_records(alone(restoring=np.eye(6).tolist()))
