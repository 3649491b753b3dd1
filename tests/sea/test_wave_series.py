"""Wave loads from one FFT per channel are those made knot by knot; negligible components are left out."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Run, Scene, _core, cases, simulate
from seacrane.description.compilation import drift_table, kept_components, wave_table, without_negligible
from seacrane.description.waves import ByHeading
from seacrane.hydro import shipped_database
from seacrane.scene import HullLoads, Waves
from seacrane.warnings import RepeatingSeaWarning

Array = NDArray[np.float64]


def uniform(count: int = 80, step: float = 0.02, first: float = 20.0, **changes: Any) -> Waves:
    """Components at (first + i) step, two directions each, with drift."""
    rng = np.random.default_rng(6)
    size = np.array([1e5, 1e5, 1e6, 1e6, 1e7, 1e6])
    transfer = size * (rng.normal(size=(count, 6)) + 1j * rng.normal(size=(count, 6)))
    hull = HullLoads(transfer=transfer, position=(15.0, -30.0), drift=1e4 * rng.normal(size=(count, 6)))
    values: dict[str, Any] = {
        "omega": np.repeat(step * (first + np.arange(count // 2)), 2), "hulls": {"vessel": hull},
        "amplitude": rng.uniform(0.01, 0.1, count), "phase": rng.uniform(0.0, 6.28, count),
        "direction": rng.uniform(0.0, 6.28, count), "evaluation": "fft",
    }  # fmt: skip
    return Waves(**{**values, **changes})


def tables(waves: Waves) -> tuple[Any, Any, Any, Any]:
    """Exact load and its table, drift and its table."""
    sea, hull = waves.components(), waves.hull()
    exact = _core.ExactWaveLoad(sea, transfer=hull.transfer, position=hull.position)
    drift = _core.DriftLoad(sea, coefficient=hull.drift, position=hull.position)
    return exact, wave_table(waves, hull, exact), drift, drift_table(waves, hull, drift)


@pytest.mark.parametrize(("first", "relative_bound"), [(20.0, 1e-5), (20.5, 1e-9)])
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
    scene.add_vessel(shipped_database(), mooring=100.0)
    scene.waves = uniform()
    given = {"t_end": 20.0, "dt_out": 1.0, "rtol": 1e-9}
    first = simulate(scene, **given)
    scene.save(tmp_path / "series.json")
    again = simulate(Scene.load(tmp_path / "series.json"), **given)
    np.testing.assert_array_equal(first["vessel_motion"], again["vessel_motion"])
    for evaluation in ("exact", "table"):
        scene.waves = replace(scene.waves, evaluation=evaluation)
        other = simulate(scene, **given)
        scale = np.abs(first["vessel_motion"]).max(axis=0)
        assert np.all(np.abs(other["vessel_motion"] - first["vessel_motion"]) < 1e-6 * scale)
        for name in ("wave_force", "drift_force"):
            assert np.abs(other[name] - first[name]).max() < 1e-7 * np.abs(first[name]).max()


@pytest.mark.warns("MeanPositionWarning")
def test_a_run_longer_than_its_sea_is_told_so() -> None:
    scene = Scene(name="long")
    scene.add_vessel(shipped_database(), mooring=100.0, memory="none")
    scene.waves = uniform(step=0.2, first=2.0, count=10)
    with pytest.warns(RepeatingSeaWarning, match=r"31\.4159 s, the run takes 40 s"):
        simulate(scene, t_end=40.0, dt_out=10.0)
    simulate(scene, t_end=31.0, dt_out=10.0)


def sea(count: int = 40, *, seed: int = 2) -> Waves:
    """Components whose amplitudes spread over fourteen decades."""
    random = np.random.default_rng(seed)
    transfer = random.normal(size=(count, 6)) + 1j * random.normal(size=(count, 6))
    return Waves(
        omega=np.sort(random.uniform(0.3, 2.0, count)), amplitude=10.0 ** random.uniform(-14.0, 0.0, count),
        phase=random.uniform(0.0, 6.0, count), direction=np.full(count, 0.4),
        hulls={"vessel": HullLoads(transfer=1e5 * transfer)},
    )  # fmt: skip


@pytest.mark.parametrize("negligible", [0.0, 1e-3])
def test_the_bound_holds_in_every_load_at_every_time_and_one_more_would_break_it(negligible: float) -> None:
    waves = replace(sea(), negligible=negligible)
    fewer = without_negligible(waves)
    assert (fewer.omega.size < 40) == (negligible > 0.0)
    full, less = (_core.ExactWaveLoad(w.components(), transfer=w.hull().transfer) for w in (waves, fewer))
    most = np.abs(waves.hull().transfer).T @ waves.amplitude
    times = np.linspace(0.0, 500.0, 400)
    difference = np.abs(full.evaluate(times) - less.evaluate(times)).max(axis=0)
    assert (difference <= (negligible + 1e-13) * most).all()
    kept = kept_components(waves)
    assert waves.amplitude[~kept].sum() <= negligible * waves.amplitude.sum()
    magnitude = waves.amplitude[:, None] * np.abs(np.hstack([waves.hull().transfer, np.ones((40, 1))]))
    share = magnitude / magnitude.sum(axis=0)
    smallest = np.flatnonzero(kept)[np.argmin(share[kept].max(axis=1))]
    assert (share[~kept].sum(axis=0) + share[smallest]).max() > negligible
    assert kept_components(replace(waves, evaluation="fft")).all()


def test_loads_over_the_heading_and_drift_count_too() -> None:
    """A component without load at the mean heading may have one at another, or drift."""
    plain = replace(sea(4), amplitude=np.array([1e-12, 1.0, 1.0, 1e-12]))
    assert list(kept_components(plain)) == [False, True, True, False]
    values = np.zeros((3, 4, 6), dtype=complex)
    values[:, 1:3] = 1.0
    values[1, 0] = 1e12
    headings = np.array([0.0, 0.5, 1.0])
    by_heading = plain.changed(force_by_heading=ByHeading(heading=headings, values=values))
    assert list(kept_components(by_heading)) == [True, True, True, False]
    assert without_negligible(by_heading).hull().force_by_heading.values.shape == (3, 3, 6)
    drift = np.array([[0.0] * 6, [1.0] * 6, [1.0] * 6, [1e24] * 6])
    turning = ByHeading(heading=headings, values=np.tile(drift, (3, 1, 1)))
    slow = by_heading.changed(drift=drift, drift_by_heading=turning)
    assert list(kept_components(slow)) == [True, True, True, True]


def test_runs_without_negligible_components_are_those_of_the_whole_sea() -> None:
    scene = cases.vessel(count=40)
    amplitude = scene.waves.amplitude.copy()
    amplitude[[0, 5, 39]] = (0.0, 1e-12, 1e-11)
    scene.waves = replace(scene.waves, amplitude=amplitude)
    assert list(np.flatnonzero(~kept_components(scene.waves))) == [0, 5, 39]
    motions = []
    for merge in (True, False):
        run = Run(scene, t_end=20.0, dt_out=1.0, rtol=1e-10, model=scene.compile(merge=merge))
        run.advance(20.0)
        motions.append(run.core.channels()["vessel_motion"])
    assert np.abs(motions[0] - motions[1]).max() <= 1e-8 * np.abs(motions[1]).max()
    scene.waves = replace(scene.waves, amplitude=np.zeros(40))  # keeps its channels
    assert np.count_nonzero(kept_components(scene.waves)) == 1
    run = Run(scene, t_end=0.2)
    run.advance(0.2)
    assert (run.core.channels()["wave_force"] == 0.0).all()
