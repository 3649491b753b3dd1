"""Rest states and natural modes against closed forms, the vessel's matrices and free decay in runs."""

from __future__ import annotations

import numpy as np
import pytest
from linear_scenes import crane_with_payload, rod

from seacrane import Scene, SceneError, cases, equilibrium, linear_model, natural_modes, simulate

G = 9.80665


def test_pendulum() -> None:
    """omega^2 = m g l / I and 2 zeta omega I = damping, I = 4 kg m2 about the hinge."""
    scene = Scene()
    rod(scene, "rod", "ground", 0.0, damping=0.8)
    modes = natural_modes(scene)
    omega = np.sqrt(3.0 * G / 4.0)
    assert len(modes.eigenvalues) == 1
    assert modes.natural_period[0] == pytest.approx(2.0 * np.pi / omega, rel=1e-8)
    assert modes.damping_ratio[0] == pytest.approx(0.8 / (2.0 * omega * 4.0), rel=1e-7)
    assert modes.damped_period[0] > modes.natural_period[0]
    # At the centre of mass, 1 m below the hinge: turning by 1 rad about y shifts it by 1 m along -x.
    np.testing.assert_allclose(np.abs(modes.shapes[0, 0]), [1, 0, 0, 0, 1, 0], atol=1e-8)
    assert modes.mechanical_share[0] == pytest.approx(1.0)


def test_two_rods_in_a_row() -> None:
    """Lagrange: [[16, 6], [6, 4]] (kg m2) and m g l diag(3, 1) for the absolute angles."""
    scene = Scene()
    rod(scene, "upper", "ground", 0.0)
    rod(scene, "lower", "upper", -2.0)
    modes = natural_modes(scene)
    inertia, stiffness = np.array([[16.0, 6.0], [6.0, 4.0]]), 3.0 * G * np.diag([3.0, 1.0])
    squares, shapes = np.linalg.eig(np.linalg.solve(inertia, stiffness))
    order = np.argsort(squares)
    np.testing.assert_allclose(modes.eigenvalues.imag, np.sqrt(squares[order]), rtol=1e-7)
    np.testing.assert_allclose(modes.eigenvalues.real, 0.0, atol=1e-6)
    for mode, i in enumerate(order):
        turned = modes.shapes[mode, :, 4]
        assert turned[1] / turned[0] == pytest.approx(shapes[1, i] / shapes[0, i], rel=1e-6)
    np.testing.assert_allclose(modes.energy_share.sum(axis=(1, 2)), 1.0)


def test_equilibrium_of_a_pendulum_held_aside() -> None:
    """m g l sin(angle) = moment, from a start 0.4 rad away; and the frequency there, omega^2 cos(angle)."""
    scene = Scene()
    rod(scene, "rod", "ground", 0.0, angle=0.4)
    scene.add_actuator(joint="rod.hinge", feed_forward=0.6 * 3.0 * G)
    rest = equilibrium(scene)
    angle = 2.0 * np.arcsin(rest.values[5])
    assert np.sin(angle) == pytest.approx(0.6, abs=1e-9)
    period = natural_modes(scene, state=rest).natural_period[0]
    assert period == pytest.approx(2.0 * np.pi / np.sqrt(3.0 * G / 4.0 * 0.8), rel=1e-7)


@pytest.mark.parametrize("label", ["payload sway", "stiffest"])
def test_free_decay_of_crane_and_payload(label: str) -> None:
    scene = crane_with_payload()
    linear = linear_model(scene)
    modes = natural_modes(linear)
    mode = int(np.argmax(np.abs(modes.eigenvalues))) if label == "stiffest" else modes.find(label)
    value = modes.eigenvalues[mode]
    size = 1e-4
    start = linear.full_state(size * modes.state_vectors[mode].real)
    t_end = 2.5 * 2.0 * np.pi / value.imag
    result = simulate(scene, t_end=t_end, dt_out=t_end / 50.0, rtol=1e-10, start=start, channels=["position"])
    rest = simulate(scene, t_end=0.0, start=linear.state, channels=["position"])["position"][0]
    decay = np.exp(value * result.time)[:, None, None]
    expected = size * (decay * modes.shapes[mode][:, :3]).real
    found = result["position"] - rest
    assert np.max(np.abs(expected)) > 1e-5
    np.testing.assert_allclose(found, expected, atol=0.01 * np.max(np.abs(expected)))


def test_later_poses_are_reached_along_the_references() -> None:
    scene = cases.case1(hs=0.0)
    rest = equilibrium(scene, time=50.0)
    run = simulate(scene, t_end=400.0, dt_out=400.0, channels=["vessel_motion", "slew_angle"])
    at_rest = simulate(scene, t_end=50.0, start=rest, dt_out=1.0, channels=["vessel_motion", "slew_angle"])
    np.testing.assert_allclose(at_rest["vessel_motion"][0, 3], run["vessel_motion"][-1, 3], rtol=0.01)
    assert abs(at_rest["vessel_motion"][0, 3]) > np.radians(2.0)
    np.testing.assert_allclose(at_rest["slew_angle"][0], run["slew_angle"][-1], rtol=1e-3)


def test_orientation_state_does_not_matter() -> None:
    scene = crane_with_payload()
    angles = scene.copy(orientation="euler_xyz")
    np.testing.assert_allclose(natural_modes(angles).eigenvalues, natural_modes(scene).eigenvalues, rtol=1e-6)
    with pytest.raises(SceneError, match="euler_xyz"):
        linear_model(angles, state=equilibrium(scene))
