"""Motions in waves by the linear model against the vessel's matrices and runs in the time domain."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from linear_scenes import crane_with_payload, reference_vessel, rod
from numpy.typing import NDArray

from seacrane import (
    Scene,
    SceneError,
    State,
    cases,
    equilibrium,
    linear_model,
    motion_rao,
    natural_modes,
    response_statistics,
    simulate,
)
from seacrane.analysis import LinearModel, response_summed
from seacrane.analysis.rest_state import held
from seacrane.hydro import shipped_database
from seacrane.sea import jonswap
from seacrane.statistics import gaussian_maximum

Array = NDArray[np.float64]
OMEGA = np.array([0.35, 0.45, 0.6, 0.8, 1.0, 1.3, 1.8])
TIP = (10.0, -4.0, 12.0)


@pytest.fixture(scope="module")
def lift() -> LinearModel:
    """Case 2 in a low sea, linearised at its start."""
    return linear_model(cases.case2(hs=0.05, count=60))


def moved_by(rao: Array, lever: Any) -> Array:
    out = np.array(rao)
    out[..., :3] += np.cross(rao[..., 3:], lever)
    return out


@pytest.mark.parametrize("heading_deg", [135.0, 40.0, -100.0])
def test_vessel_alone_moves_as_its_matrices_say(heading_deg: float) -> None:
    """Every motion, and a point on deck, to 1e-6 of A, B, C and F solved directly."""
    database, scene = shipped_database(), cases.vessel(hs=0.0)
    heading = np.radians(heading_deg)
    force = database.force_at(OMEGA, heading)
    expected = reference_vessel(scene).response(OMEGA, force)
    linear = linear_model(scene)
    for point in ((0.0, 0.0, 0.0), TIP):
        rao = motion_rao(linear, omega=OMEGA, direction=heading, body="vessel", point=point)
        np.testing.assert_array_less(np.abs(rao / moved_by(expected, point) - 1.0), 1e-6)


def test_heading_is_seen_from_a_turned_vessel() -> None:
    """A vessel at a yaw of 40 deg moves, in its own axes, as one without yaw."""
    yaw = np.radians(40.0)
    straight = cases.vessel(hs=0.0)
    turned = straight.copy()
    body = turned.bodies.pop("vessel")
    turned.add_body(
        name="vessel", mass=body.mass, inertia=body.inertia, center_of_mass=body.center_of_mass,
        quaternion=(np.cos(yaw / 2.0), 0.0, 0.0, np.sin(yaw / 2.0)),
    )  # fmt: skip
    raos = [motion_rao(s, omega=OMEGA, direction=2.0, body="vessel") for s in (straight, turned)]
    turn = np.array([[np.cos(yaw), -np.sin(yaw), 0.0], [np.sin(yaw), np.cos(yaw), 0.0], [0.0, 0.0, 1.0]])
    expected = raos[0] @ np.kron(np.eye(2), turn).T
    np.testing.assert_allclose(raos[1], expected, atol=1e-6 * np.max(np.abs(expected)))


def relative_difference(found: Array, expected: Array) -> Array:
    """Standard deviation of the difference over that of the expected, by column."""
    return np.asarray(np.std(found - expected, axis=0) / np.std(expected, axis=0))


@pytest.mark.parametrize(
    "options",
    [{}, {"kinematics": "paper"}, {"memory": "passive"}, {"memory": "none", "hs": 0.002}],
    ids=["per-pair", "paper", "passive", "no memory"],
)
def test_vessel_in_a_low_sea_follows_the_summed_response(options: dict[str, Any]) -> None:
    """Without memory heave is undamped and large: lower waves keep it linear."""
    scene = cases.vessel(**{"hs": 0.05, **options})
    linear = linear_model(scene)
    summed = response_summed(linear, body="vessel")
    start = linear.full_state(summed.state_at(0.0))
    result = simulate(scene, t_end=100.0, dt_out=0.5, start=start, channels=["vessel_motion"])
    np.testing.assert_array_less(relative_difference(result["vessel_motion"], summed.at(result.time)), 0.01)


def low_sea_differences(hs: float) -> tuple[Array, Array]:
    """Time against frequency domain: vessel's six motions and payload's position, 60 s of case 2 held.

    The run starts in the steady state of the linear model, so there is no transient in either.
    """
    linear = linear_model(cases.case2(hs=hs, count=60))
    scene = held(linear.scene)
    scene.waves = linear.scene.waves
    vessel, payload = (response_summed(linear, body=body) for body in ("vessel", "payload"))
    start = linear.full_state(vessel.state_at(0.0))
    channels = ["vessel_motion", "position"]
    result = simulate(scene, t_end=60.0, dt_out=0.5, rtol=1e-9, start=start, channels=channels)
    position = result["position"][:, list(scene.bodies).index("payload")]
    return (
        relative_difference(result["vessel_motion"], vessel.at(result.time)),
        relative_difference(position, payload.at(result.time)[:, :3]),
    )


def test_crane_and_payload_in_low_seas_follow_the_summed_response() -> None:
    """Within 1 % in Hs 0.02 m and, but for roll, 0.05 m; what differs is of second order in the waves.

    Roll is small in waves, and the payload's swing (0.15 m at Hs 0.05 m) acts on it with its square; the
    payload rises with the square of its swing, too.
    """
    vessel, payload = low_sea_differences(0.05)
    assert np.all(vessel[[0, 1, 2, 4, 5]] < 0.01)
    assert np.all(payload[:2] < 0.01)
    lower_vessel, lower_payload = low_sea_differences(0.02)
    assert np.all(lower_vessel < 0.01)
    assert np.all(lower_payload[:2] < 0.001)
    assert vessel[3] / lower_vessel[3] == pytest.approx(2.5, rel=0.02)
    assert payload[2] / lower_payload[2] == pytest.approx(2.5, rel=0.02)


@pytest.mark.warns("MeanPositionWarning")
def test_phase_and_place_of_the_waves() -> None:
    """A vessel whose waves have their phase elsewhere: the summed response shifts as the exact load does."""
    scene = cases.vessel(hs=0.05, count=20)
    assert scene.waves is not None
    scene.waves = replace(scene.waves.changed(position=(30.0, -20.0)), evaluation="exact")
    linear = linear_model(scene)
    summed = response_summed(linear, body="vessel")
    start = linear.full_state(summed.state_at(0.0))
    result = simulate(scene, t_end=40.0, dt_out=0.5, start=start, channels=["vessel_motion"])
    np.testing.assert_array_less(relative_difference(result["vessel_motion"], summed.at(result.time)), 0.01)


def test_statistics_are_those_of_the_components() -> None:
    """Quadrature against the sum over many fine components, heave and roll of the vessel's deck."""
    heading = np.radians(135.0)
    scene = cases.vessel(hs=0.0)
    linear = linear_model(scene)
    scene.add_sea(hs=2.0, tp=8.0, direction_deg=135.0, count=4000)
    summed = response_summed(linear, body="vessel", point=TIP, waves=scene.waves)
    statistics = response_statistics(
        linear, spectrum=jonswap(hs=2.0, tp=8.0), direction=heading, body="vessel", point=TIP
    )
    np.testing.assert_allclose(statistics.std[2:5], summed.std[2:5], rtol=0.01)
    assert 0.98 < statistics.wave_energy_share <= 1.0 + 1e-9
    np.testing.assert_allclose(statistics.significant_double_amplitude, 4.0 * statistics.std)
    np.testing.assert_allclose(statistics.significant_amplitude, 2.0 * statistics.std)


def test_most_probable_largest_value_in_simulated_storms() -> None:
    """The largest heave of 400 Gaussian records of half an hour with the response spectrum."""
    statistics = response_statistics(
        cases.vessel(hs=0.0), spectrum=jonswap(hs=2.0, tp=8.0), direction=np.pi,
        body="vessel", duration=1800.0,
    )  # fmt: skip
    cycles = 1800.0 / statistics.mean_period[2]
    expected = statistics.std[2] * np.sqrt(2.0 * np.log(cycles))
    assert statistics.most_probable_largest[2] == pytest.approx(expected)
    m1 = np.trapezoid(statistics.omega * statistics.spectrum[:, 2], statistics.omega)
    m0, m2 = statistics.moments[2, :2]
    assert statistics.bandwidth[2] == pytest.approx(np.sqrt(1.0 - m1**2 / (m0 * m2)), rel=1e-3)
    clumped = gaussian_maximum(
        std=statistics.std[2], rate=1.0 / statistics.mean_period[2], exposure=1800.0,
        bandwidth=statistics.bandwidth[2],
    )  # fmt: skip
    assert statistics.most_probable_clumped[2] == pytest.approx(clumped.mpm.value, rel=1e-9)
    assert 0.9 * expected < statistics.most_probable_clumped[2] < expected
    rng = np.random.default_rng(3)
    omega = np.arange(1, 800) * 2.0 * np.pi / 1800.0
    density = np.interp(omega, statistics.omega, statistics.spectrum[:, 2], left=0.0, right=0.0)
    size = np.sqrt(density * (omega[1] - omega[0]))
    phases = rng.normal(size=(400, 2, len(omega)))
    spectrum = np.zeros((400, 2049), dtype=complex)
    spectrum[:, 1:800] = 4096 / 2.0 * size * (phases[:, 0] + 1j * phases[:, 1])
    largest = np.fft.irfft(spectrum, axis=1).max(axis=1)
    # Gumbel: mean = mode + 0.5772 std / sqrt(2 ln N).
    mean = expected + 0.5772 * statistics.std[2] / np.sqrt(2.0 * np.log(cycles))
    assert largest.mean() == pytest.approx(mean, rel=0.03)


def test_undamped_resonance_is_named() -> None:
    """A payload hung on the ground beside the vessel swings without any damping."""
    scene = cases.vessel(hs=0.0)
    scene.add_body(name="pendulum", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 60.0, 0.0))
    scene.add_joint(kind="spherical", name="hook", first="ground", second="pendulum", point=(0.0, 60.0, 9.0))
    with pytest.warns(UserWarning, match=r"mode 'pendulum .*no finite value"):
        response_statistics(scene, spectrum=jonswap(hs=2.0, tp=8.0), direction=0.0, body="vessel")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        natural_modes(scene)


def test_what_cannot_be_linearised_says_why(lift: LinearModel) -> None:
    scene = Scene(name="fall")
    scene.add_body(name="stone", mass=1.0, inertia=(1.0, 1.0, 1.0))
    with pytest.raises(SceneError, match=r"no rest state found; body 'stone' still accelerates by -9\.81"):
        equilibrium(scene)
    swinging = Scene(name="swing")
    rod(swinging, "rod", "ground", 0.0, angle=0.4)
    state = State(time=0.0, values=swinging.compile().initial_state, inputs=np.zeros(0))
    with pytest.raises(SceneError, match=r"body 'rod': accelerates by .* seacrane\.equilibrium first"):
        linear_model(swinging, state=state)
    with pytest.raises(SceneError, match=r"values, scene .* finite ones"):
        linear_model(lift.scene, state=state)
    with pytest.raises(SceneError, match="body 'hook' does not exist"):
        motion_rao(lift, omega=0.5, direction=0.0, body="hook")
    with pytest.raises(SceneError, match="has no vessel"):
        motion_rao(crane_with_payload(), omega=0.5, direction=0.0, body="payload")
    with pytest.raises(ValueError, match="outside"):
        motion_rao(lift, omega=50.0, direction=0.0, body="vessel")
    with pytest.raises(SceneError, match="has no waves"):
        response_summed(cases.vessel(hs=0.0), body="vessel")
    with pytest.raises(SceneError, match="duration is -1"):
        response_statistics(
            lift,
            spectrum=jonswap(hs=1.0, tp=8.0),
            direction=0.0,
            body="vessel",
            duration=-1.0,
        )
