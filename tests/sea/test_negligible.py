"""Negligible components of a sea are left out within their bound, in every load on every vessel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from seacrane import Run, _core, cases
from seacrane.description.compilation import kept_components, without_negligible
from seacrane.description.waves import ByHeading
from seacrane.scene import HullLoads, Waves


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
