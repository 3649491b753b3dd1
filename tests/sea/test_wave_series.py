"""Wave loads from one FFT per channel: the same table as the one made knot by knot."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Scene, SceneError, _core, simulate
from seacrane.description.compilation import compiled_waves
from seacrane.description.wave_grid import grid_of
from seacrane.hydro import shipped_database
from seacrane.scene import HullLoads, Waves
from seacrane.warnings import MeanPositionWarning, RepeatingSeaWarning

Array = NDArray[np.float64]


def uniform(count: int = 80, step: float = 0.02, first: float = 20.0, **changes: Any) -> Waves:
    """Components at (first + i) step, two directions each, with drift."""
    rng = np.random.default_rng(6)
    omega = np.repeat(step * (first + np.arange(count // 2)), 2)
    size = np.array([1e5, 1e5, 1e6, 1e6, 1e7, 1e6])
    values: dict[str, Any] = {
        "omega": omega,
        "amplitude": rng.uniform(0.01, 0.1, count),
        "phase": rng.uniform(0.0, 6.28, count),
        "direction": rng.uniform(0.0, 6.28, count),
        "hulls": {
            "vessel": HullLoads(
                transfer=size * (rng.normal(size=(count, 6)) + 1j * rng.normal(size=(count, 6))),
                position=(15.0, -30.0),
                drift=1e4 * rng.normal(size=(count, 6)),
            )
        },
        "evaluation": "fft",
    }
    return Waves(**{**values, **changes})


def tables(waves: Waves) -> tuple[Any, Any, Any, Any]:
    """Exact load and its table, drift and its table."""
    from seacrane.description.compilation import drift_table, wave_table

    sea, hull = waves.components(), waves.hull()
    exact = _core.ExactWaveLoad(sea, transfer=hull.transfer, position=hull.position)
    drift = _core.DriftLoad(sea, coefficient=hull.drift, position=hull.position)
    return exact, wave_table(waves, hull, exact), drift, drift_table(waves, hull, drift)


@pytest.mark.parametrize("first", [20.0, 20.5])
@pytest.mark.parametrize("relative_bound", [1e-5, 1e-9])
def test_the_series_is_the_sum_within_the_bound(first: float, relative_bound: float) -> None:
    """Also between bins' middles (first = 20.5), where the sea repeats after two turns of the step."""
    waves = uniform(first=first, relative_bound=relative_bound)
    exact, table, drift, slow = tables(waves)
    period = 2.0 * np.pi / 0.02 * (1.0 if first == 20.0 else 2.0)
    times = np.random.default_rng(2).uniform(-period, 3.0 * period, 5000)
    rounding = 1e-11
    error = np.abs(table.evaluate(times) - exact.evaluate(times)).max(axis=0)
    assert np.all(error <= table.error_bound + rounding * exact.magnitude())
    assert np.all(table.error_bound <= relative_bound * exact.magnitude() * (1.0 + 1e-9))
    assert table.stored_knots * table.step == pytest.approx(period, rel=1e-12)
    difference = np.abs(slow.evaluate(times) - drift.evaluate(times)).max(axis=0)
    size = np.array(waves.amplitude) @ np.abs(np.asarray(waves.hull().drift)) * np.sum(waves.amplitude)
    assert np.all(difference <= slow.error_bound + rounding * size)


@pytest.mark.warns("MeanPositionWarning")
def test_a_run_from_the_series_is_the_run_from_the_sum(tmp_path: Path) -> None:
    scene = Scene(name="series")
    scene.add_vessel(shipped_database(), mooring_period=100.0)
    scene.waves = uniform()
    first = simulate(scene, t_end=20.0, dt_out=1.0, rtol=1e-9)
    scene.save(tmp_path / "series.json")
    again = simulate(Scene.load(tmp_path / "series.json"), t_end=20.0, dt_out=1.0, rtol=1e-9)
    np.testing.assert_array_equal(first.channels["vessel_motion"], again.channels["vessel_motion"])
    for evaluation in ("exact", "table"):
        scene.waves = replace(scene.waves, evaluation=evaluation)
        other = simulate(scene, t_end=20.0, dt_out=1.0, rtol=1e-9)
        scale = np.abs(first.channels["vessel_motion"]).max(axis=0)
        error = np.abs(other.channels["vessel_motion"] - first.channels["vessel_motion"])
        assert np.all(error < 1e-6 * scale)
        for name in ("wave_force", "drift_force"):
            size = np.abs(first.channels[name]).max()
            assert np.abs(other.channels[name] - first.channels[name]).max() < 1e-7 * size


def test_the_grid_is_found_or_refused() -> None:
    step, number = grid_of(np.array([0.3, 0.5, 0.6]))
    assert step == pytest.approx(0.1, rel=1e-12)
    np.testing.assert_array_equal(number, [3, 5, 6])
    step, number = grid_of(np.array([0.25, 0.35, 0.45, 0.45]))
    assert step == pytest.approx(0.05, rel=1e-12)
    np.testing.assert_array_equal(number, [5, 7, 9, 9])
    assert grid_of(np.array([0.7]))[0] == pytest.approx(0.7)
    for omega in ([0.3, 0.5, 0.6 + 1e-6], [0.3, 0.3 + 1e-7, 1.0]):
        with pytest.raises(ValueError, match="realise the sea with placement='uniform'"):
            grid_of(np.array(omega))
    even = uniform()
    omega = even.omega.copy()
    omega[3] *= 1.0001
    jittered = replace(even, omega=omega)
    with pytest.raises(SceneError, match="frequencies that are multiples of one step"):
        compiled_waves(jittered)
    with pytest.raises(SceneError, match="evaluation is 'spline'; choose table, exact, fft"):
        compiled_waves(uniform(evaluation="spline"))


def test_knots_of_another_load_are_refused() -> None:
    waves = uniform(relative_bound=1e-3)
    exact, table, _, _ = tables(waves)
    count = table.stored_knots
    period = count * table.step
    times = np.arange(count) * table.step
    knots = np.stack(
        [np.column_stack([exact.evaluate(times, derivative=k), np.zeros(count)]) for k in range(3)], axis=1
    )
    with pytest.raises(ValueError, match="knot 0, channel 6: distance from the sum"):
        _core.WaveTable(exact, relative_bound=1e-3, period=period, knots=knots)
    with pytest.raises(ValueError, match=r"number of knots is \d+; give at least"):
        _core.WaveTable(exact, relative_bound=1e-3, period=period, knots=knots[:10])
    with pytest.raises(ValueError, match=r"knots need the shape \(knots, 3, 7\)"):
        _core.WaveTable(exact, relative_bound=1e-3, period=period, knots=knots[:, 0])
    with pytest.raises(ValueError, match="period is 0"):
        _core.WaveTable(exact, relative_bound=1e-3, knots=knots)


@pytest.mark.warns("MeanPositionWarning")
def test_a_run_longer_than_its_sea_is_told_so() -> None:
    scene = Scene(name="long")
    scene.add_vessel(shipped_database(), mooring_period=100.0, memory="none")
    scene.waves = uniform(step=0.2, first=2.0, count=10)
    with pytest.warns(RepeatingSeaWarning, match=r"repeat after 31\.4159 s, the run takes 40 s"):
        simulate(scene, t_end=40.0, dt_out=10.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", MeanPositionWarning)  # it drifts
        simulate(scene, t_end=31.0, dt_out=10.0)
