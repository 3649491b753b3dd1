"""Newman's slow drift against its double sum, closed forms and the spectrum of the force."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Scene, SceneError, _core, simulate
from seacrane.arrays import Array
from seacrane.hydro import DriftCoefficients, HydroDatabase, shipped_database

TIMES = np.array([0.0, 3.3, 47.0, 600.0])


@cache
def drifting(*, headings: int = 13, lowest: float = 0.2, highest: float = 2.6) -> HydroDatabase:
    """The shipped hull with the drift coefficients of `ship`."""
    omega, heading = np.linspace(lowest, highest, 25), np.linspace(0.0, np.pi, headings)
    table = np.array([[ship(w, b) for w in omega] for b in heading])
    drift = DriftCoefficients(heading=heading, omega=omega, coefficient=table)
    return replace(shipped_database(), name="drifting", drift=drift)


def ship(w: float, b: float) -> list[float]:
    """Even in heading for surge, odd for sway and yaw, as port-starboard symmetry has it."""
    return [2e3 * w**2 * np.cos(b), 9e3 * w**3 * np.sin(b), 0.0, 0.0, 0.0, 4e4 * w * np.sin(2.0 * b)]


def sea(count: int = 50, seed: int = 8) -> tuple[_core.WaveComponents, Array]:
    rng = np.random.default_rng(seed)
    waves = _core.WaveComponents(
        omega=np.sort(rng.uniform(0.4, 1.6, count)), amplitude=rng.uniform(0.02, 0.3, count),
        phase=rng.uniform(0.0, 6.28, count), direction=rng.uniform(0.0, 6.28, count),
    )  # fmt: skip
    return waves, rng.normal(size=(count, 6)) * 1e4


def double_sum(waves: _core.WaveComponents, coefficient: Array, t: float, x: float, y: float) -> Array:
    """Newman's approximation from its definition."""
    a, k, b = np.array(waves.amplitude), np.array(waves.wavenumber), np.array(waves.direction)
    theta = np.array(waves.omega) * t + waves.phase - k * (x * np.cos(b) + y * np.sin(b))
    pairs = np.outer(a, a) * np.cos(theta[:, None] - theta)
    return np.einsum("ik,ikj->j", pairs, 0.5 * (coefficient[:, None] + coefficient[None]))


def test_two_sums_equal_the_double_sum() -> None:
    waves, coefficient = sea()
    load = _core.DriftLoad(waves, coefficient=coefficient, position=(20.0, -3.0))
    scale = np.sum(waves.amplitude) * np.array(waves.amplitude) @ np.abs(coefficient)
    for t in TIMES:
        error = np.abs(load.evaluate(t) - double_sum(waves, coefficient, t, 20.0, -3.0))
        assert np.all(error < 1e-12 * scale)
    h = 1e-3
    before, here, after = (load.evaluate(50.0 + d) for d in (-h, 0.0, h))
    assert np.all(np.abs((after - before) / (2.0 * h) - load.evaluate(50.0, derivative=1)) < 1e-6 * scale)
    second = (after - 2.0 * here + before) / h**2
    assert np.all(np.abs(second - load.evaluate(50.0, derivative=2)) < 1e-5 * scale)


def test_two_waves_beat_in_closed_form_and_at_no_other_frequency() -> None:
    w, a, e = np.array([0.7, 0.82]), np.array([1.2, 0.5]), np.array([0.4, 2.2])
    d = np.array([[3e4, -1e4, 0.0, 0.0, 0.0, 5e5], [4e4, 2e4, 0.0, 0.0, 0.0, -1e5]])
    load = _core.DriftLoad(_core.WaveComponents(omega=w, amplitude=a, phase=e), coefficient=d)
    times = np.linspace(0.0, 200.0, 4001)
    steady = a**2 @ d
    beat = np.cos((w[1] - w[0]) * times + e[1] - e[0])
    expected = steady + a[0] * a[1] * (d[0] + d[1]) * beat[:, None]
    np.testing.assert_allclose(load.evaluate(times), expected, atol=1e-9 * 5e5)
    table = _core.DriftTable(load)
    assert table.step > 5.0  # the beat is slow, and so is its table
    assert np.all(np.abs(table.evaluate(times) - expected) <= table.error_bound + 1e-9 * 5e5)


def test_the_table_stays_within_its_bound() -> None:
    waves, coefficient = sea()
    load = _core.DriftLoad(waves, coefficient=coefficient)
    times = np.random.default_rng(1).uniform(-300.0, 900.0, 20000)
    for relative in (1e-4, 1e-9):
        table = _core.DriftTable(load, relative_bound=relative)
        error = np.abs(table.evaluate(times) - load.evaluate(times)).max(axis=0)
        assert np.all(error <= table.error_bound * (1.0 + 1e-9) + 1e-12 * np.abs(coefficient).sum())
        assert np.all(error > 1e-4 * table.error_bound)


def moored(database: HydroDatabase | None = None, **sea_options: Any) -> Scene:
    scene = Scene(name="moored")
    scene.add_vessel(drifting() if database is None else database, mooring=100.0)
    scene.add_sea(**{"hs": 4.0, "tp": 9.0, "count": 40, **sea_options})
    return scene


def test_coefficients_are_interpolated_in_frequency_and_heading_and_mirrored() -> None:
    for direction_deg in (135.0, 225.0, -10.0):
        scene = moored(direction_deg=direction_deg, drift=True)
        expected = np.array([ship(w, np.radians(direction_deg)) for w in scene.waves.omega])
        scale = np.abs(expected).max(axis=0) + 1e-9
        # Cubic in frequency exactly; a sine over 15 deg to 4e-4 by splines.
        assert np.all(np.abs(scene.waves.hull().drift - expected) < 2e-3 * scale)


@pytest.mark.warns("MeanHeadingWarning")
def test_a_moored_vessel_is_pushed_by_the_mean_drift_and_its_energy_balances(tmp_path: Path) -> None:
    scene = moored(drift=True)
    result = simulate(scene, t_end=100.0, dt_out=0.5, rtol=1e-8)
    assert np.abs(result["energy_balance"]).max() < 1e-6 * result["absolute_work"][-1]
    waves, drift = scene.waves, scene.waves.hull().drift
    load = _core.DriftLoad(waves.components(), coefficient=drift)
    scale = np.array(waves.amplitude) @ np.abs(drift) * np.sum(waves.amplitude)
    assert np.all(np.abs(result["drift_force"] - load.evaluate(result.time)) <= 2e-9 * scale)
    calm = simulate(moored(), t_end=100.0, dt_out=0.5, rtol=1e-8)
    assert (result["vessel_motion"] - calm["vessel_motion"])[-1, 0] < 0.0  # waves from ahead push aft
    scene.save(tmp_path / "drift.json")
    again = simulate(Scene.load(tmp_path / "drift.json"), t_end=5.0, dt_out=0.5, rtol=1e-8)
    np.testing.assert_array_equal(again["drift_force"], result["drift_force"][:11])


def test_drift_at_the_actual_position() -> None:
    scene = moored(drift=True, phase="actual")
    waves, hull, yaw = scene.waves, scene.waves.hull(), 0.35
    load = _core.PositionedWaveLoad(
        waves.components(), headings=hull.force_by_heading.heading, transfer=hull.force_by_heading.values,
        drift_headings=hull.drift_by_heading.heading, drift=hull.drift_by_heading.values,
    )  # fmt: skip
    turned = moored(direction_deg=135.0 - np.degrees(yaw), drift=True)
    drift = turned.waves.hull().drift
    scale = np.array(waves.amplitude) @ np.abs(drift) * np.sum(waves.amplitude) + 1e-6
    for t in TIMES:
        expected = double_sum(waves.components(), drift, t, 40.0, 9.0)
        assert np.all(np.abs(load.evaluate(t, x=40.0, y=9.0, yaw=yaw)[1] - expected) < 1e-11 * scale)
    result = simulate(scene, t_end=3.0, dt_out=1.0)
    motion = result["vessel_motion"][-1]
    at_end = load.evaluate(3.0, x=motion[0], y=motion[1], yaw=motion[5])[1]
    np.testing.assert_allclose(result["drift_force"][-1], at_end, rtol=1e-9, atol=1e-3)


def test_what_is_missing_is_named() -> None:
    few = drifting(headings=3)
    for database, direction, message in (
        (shipped_database(), 135.0, "no drift coefficients"), (few, 100.0, "gaps above 45 deg"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=message):
            moored(database, direction_deg=direction, drift=True)
    moored(few, direction_deg=90.0, drift=True)  # a stored heading needs none


def test_beyond_the_coefficients_those_of_the_nearest_count() -> None:
    scene = moored(drifting(lowest=0.6, highest=0.9), drift=True)
    omega, drift = scene.waves.omega, scene.waves.hull().drift
    below, above = drift[omega < 0.6], drift[omega > 0.9]
    assert len(below) > 1 < len(above)
    assert np.ptp(below, axis=0) == pytest.approx(0.0, abs=1e-9) and np.abs(below[0] - above[0]).max() > 1.0
