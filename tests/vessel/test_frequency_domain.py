"""Motions in waves by the linear model: with fitted memory, a database's own matrices, and a convolution."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from linear_scenes import reference_vessel, rod
from test_vessel import complex_amplitude, regular_wave

from seacrane import (
    Scene,
    SceneError,
    State,
    cases,
    equilibrium,
    linear_model,
    load_database,
    motion_rao,
    natural_modes,
    response_statistics,
    simulate,
)
from seacrane.analysis import response_summed
from seacrane.analysis.rest_state import held
from seacrane.arrays import Array
from seacrane.hydro import motion_response, retardation_functions, shipped_database, vessel_parameters
from seacrane.sea import jonswap
from seacrane.statistics import gaussian_maximum

OMEGA = np.array([0.35, 0.45, 0.6, 0.8, 1.0, 1.3, 1.8])
TIP = (10.0, -4.0, 12.0)


@pytest.mark.parametrize("heading_deg", [135.0, -100.0])
def test_vessel_alone_moves_as_its_matrices_say(heading_deg: float) -> None:
    """Every motion, and a point on deck, to 1e-6 of A, B, C and F solved directly."""
    database, scene = shipped_database(), cases.vessel(hs=0.0)
    heading = np.radians(heading_deg)
    force = database.force_at(OMEGA, heading)
    expected = reference_vessel(scene).response(OMEGA, force)
    linear = linear_model(scene)
    for point in ((0.0, 0.0, 0.0), TIP):
        rao = motion_rao(linear, omega=OMEGA, direction=heading, body="vessel", point=point)
        there = np.hstack([expected[:, :3] + np.cross(expected[:, 3:], point), expected[:, 3:]])
        np.testing.assert_array_less(np.abs(rao / there - 1.0), 1e-6)


def relative_difference(found: Array, expected: Array) -> Array:
    """Standard deviation of the difference over that of the expected, by column."""
    return np.asarray(np.std(found - expected, axis=0) / np.std(expected, axis=0))


@pytest.mark.parametrize(
    "options",
    [{}, {"kinematics": "paper"}, {"memory": "by-motion"}, {"memory": "none", "hs": 0.002}],
    ids=["per-pair", "paper", "by motion", "no memory"],
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


def test_statistics_are_those_of_the_components() -> None:
    """Quadrature against the sum over many fine components, heave and roll of the vessel's deck."""
    scene = cases.vessel(hs=0.0)
    linear = linear_model(scene)
    scene.add_sea(hs=2.0, tp=8.0, direction_deg=135.0, count=4000)
    summed = response_summed(linear, body="vessel", point=TIP, waves=scene.waves)
    found = response_statistics(
        linear, spectrum=jonswap(hs=2.0, tp=8.0), direction=np.radians(135.0), body="vessel", point=TIP,
        duration=1800.0,
    )  # fmt: skip
    np.testing.assert_allclose(found.std[2:5], summed.std[2:5], rtol=0.01)
    assert 0.98 < found.wave_energy_share <= 1.0 + 1e-9
    np.testing.assert_allclose(found.significant_double_amplitude, 4.0 * found.std)
    np.testing.assert_allclose(found.significant_amplitude, 2.0 * found.std)
    m0, m1, m2 = (np.trapezoid(found.omega**n * found.spectrum[:, 2], found.omega) for n in (0, 1, 2))
    period = found.mean_period[2]
    assert period == pytest.approx(2.0 * np.pi * np.sqrt(m0 / m2), rel=1e-6)
    assert found.bandwidth[2] == pytest.approx(np.sqrt(1.0 - m1**2 / (m0 * m2)), rel=1e-3)
    expected = found.std[2] * np.sqrt(2.0 * np.log(1800.0 / period))
    assert found.most_probable_largest[2] == pytest.approx(expected)
    clumped = gaussian_maximum(
        std=found.std[2], rate=1.0 / period, exposure=1800.0, bandwidth=found.bandwidth[2]
    )
    assert found.most_probable_clumped[2] == pytest.approx(clumped.mpm.value, rel=1e-9)
    assert 0.9 * expected < found.most_probable_clumped[2] < expected


def test_what_cannot_be_linearised_says_why() -> None:
    falling, swinging, still = Scene(name="fall"), Scene(name="swing"), cases.vessel(hs=0.0)
    falling.add_body(name="stone", mass=1.0, inertia=(1.0, 1.0, 1.0))
    rod(swinging, "rod", "ground", 0.0, angle=0.4)
    state = State(time=0.0, values=swinging.compile().initial_state, inputs=np.zeros(0))
    given = {"memory": "database", "database": shipped_database()}
    linear = linear_model(still, **given)
    for call, message in (
        (lambda: equilibrium(falling), r"'stone' still accelerates by -9\.81"),
        (lambda: linear_model(swinging, state=state), "'rod': accelerates.*seacrane.equilibrium"),
        (lambda: linear_model(still, state=state), "values, scene .* finite ones"),
        (lambda: motion_rao(linear, omega=50.0, direction=0.0, body="vessel"), "outside"),
        (lambda: linear.full_state(np.zeros(len(linear.a))), "past is not in x"),
    ):
        with pytest.raises((SceneError, ValueError), match=message):
            call()
    hung = cases.vessel(hs=0.0)
    hung.add_body(name="pendulum", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 60.0, 0.0))
    hung.add_joint(kind="spherical", name="hook", first="ground", second="pendulum", point=(0.0, 60.0, 9.0))
    with pytest.warns(UserWarning, match="'pendulum .*no finite value"):  # an undamped resonance
        response_statistics(hung, spectrum=jonswap(hs=2.0, tp=8.0), direction=0.0, body="vessel")


@pytest.mark.parametrize("ship", ["hull_115", "veres/supply", "wamit"])
def test_the_vessel_alone_moves_as_the_databases_matrices_say(ship: str, shared: Path) -> None:
    """The shipped hull; the supply ship's roll tanks, with the roll damping of the time domain; the tanker's
    mass matrix beyond that of a rigid body."""
    shipped = ship == "hull_115"
    with warnings.catch_warnings(action="ignore"):
        database = same = shipped_database() if shipped else load_database(shared / ship)
        scene = cases.vessel(database=database, hs=0.0, mooring=None, memory="convolution")
        if database.additional:
            functions = retardation_functions(database=database)
            linear = vessel_parameters(database, memory=functions).linear_damping
            same = replace(database, roll_damping=None, linear_damping=linear)
    late, motions = database.omega > 0.3, slice(None) if shipped else slice(2, 5)
    asked = {"database": database, "omega": database.omega, "body": "vessel", "memory": "database"}
    for heading in (7, 18) if shipped else (7,):
        found = motion_rao(scene, direction=database.heading[heading], **asked)[late]
        expected = motion_response(same)[heading][late]
        limit = (1e-5 if shipped else 1e-3) * np.abs(expected).max(axis=0) + 1e-12
        np.testing.assert_array_less(np.abs(found - expected).max(axis=0)[motions], limit[motions])


def test_a_run_by_convolution_is_the_linear_model_by_convolution() -> None:
    """In a regular wave, springs included; the database's own matrices are as near as the kernel is."""
    database, omega = shipped_database(), 0.9
    scene = cases.vessel(hs=0.0, mooring=60.0, memory="convolution")
    calm = scene.copy()
    scene.waves = regular_wave(database, omega=omega, heading_deg=120.0, amplitude=1e-4, phase=0.0)
    period = 2.0 * np.pi / omega
    run = simulate(scene, t_end=500.0, dt_out=period / 16.0, rtol=1e-9, channels=["vessel_motion"])
    found = complex_amplitude(run, omega, start=500.0 - 6.0 * period) / 1e-4
    options = {"database": database, "omega": omega, "direction": np.radians(120.0), "body": "vessel"}
    by_kernel = motion_rao(calm, **options)
    by_data = motion_rao(calm, memory="database", **options)
    np.testing.assert_allclose(found, by_kernel, rtol=2e-3)
    np.testing.assert_allclose(by_kernel, by_data, rtol=5e-3)
    assert np.abs(by_kernel / by_data - 1.0).max() > 1e-5


def test_modes_have_the_matrices_of_their_own_frequency() -> None:
    """lambda^2 (M + A(w)) + lambda B(w) + C is singular at w = Im lambda."""
    database = shipped_database()
    scene = cases.vessel(hs=0.0, mooring=None)
    modes = natural_modes(scene, memory="database", database=database)
    assert {modes.label(i) for i in range(len(modes.eigenvalues))} == {
        "vessel heave", "vessel roll", "vessel pitch",
    }  # fmt: skip
    memory = linear_model(scene, memory="database", database=database).memories[0]
    element, body = scene.vessels["vessel"], scene.bodies["vessel"]
    inner = np.array(element.added_mass) + database.mass_matrix
    assert body.mass == pytest.approx(database.mass_matrix[0, 0])
    for value in modes.eigenvalues:
        added, damping, stiffness = (x[0] for x in memory.matrices(np.array([value.imag])))
        matrix = (
            value**2 * (inner + added) + value * (damping + np.array(element.linear_damping)) + stiffness
            + np.array(element.restoring)
        )  # fmt: skip
        size = np.sqrt(np.abs(np.diag(inner)) * abs(value) ** 2)
        singular = np.linalg.svd(matrix / np.outer(size, size))[1]
        assert singular[-1] < 1e-6 * singular[0]
