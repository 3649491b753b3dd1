"""`add_sea` passes on how loads are evaluated, where, and whether they drift."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from seacrane import Scene, SceneError
from seacrane.hydro import DriftCoefficients, HydroDatabase, shipped_database
from seacrane.run.stats import origin_settings
from seacrane.sea import SeaState, WaveSystem, jonswap


def with_drift() -> HydroDatabase:
    coefficient = np.full((13, 25, 6), [-2e3, 1e3, 0.0, 0.0, 0.0, 1e4])
    drift = DriftCoefficients(
        heading=np.linspace(0.0, np.pi, 13), omega=np.linspace(0.2, 2.6, 25), coefficient=coefficient
    )
    return replace(shipped_database(), drift=drift)


def scene_of(**options: object) -> Scene:
    scene = Scene(name="sea")
    scene.add_vessel(with_drift())
    scene.add_sea(hs=2.0, count=30, **options)  # type: ignore[arg-type]
    return scene


def test_keywords_do_what_the_functions_do() -> None:
    by_keyword, by_hand = scene_of(phase="actual", drift=True), scene_of()
    by_hand.add_drift()
    by_hand.use_actual_position()
    one, other = by_keyword.waves, by_hand.waves
    assert one is not None and other is not None
    assert one.hull().force_by_heading is not None and other.hull().force_by_heading is not None
    assert one.hull().drift_by_heading is not None and other.hull().drift_by_heading is not None
    np.testing.assert_array_equal(one.hull().force_by_heading.values, other.hull().force_by_heading.values)
    np.testing.assert_array_equal(one.hull().drift_by_heading.values, other.hull().drift_by_heading.values)
    assert origin_settings(by_keyword) == origin_settings(by_hand)
    assert origin_settings(by_keyword)["wave_phase"] == "actual"
    by_keyword.compile()


def test_the_fft_takes_uniform_seas_and_refuses_jittered_ones() -> None:
    scene = Scene(name="sea")
    scene.add_vessel(shipped_database())
    density = jonswap(hs=2.0, tp=8.0)
    for placement in ("uniform", "jittered"):
        system = WaveSystem(spectrum=density, direction_deg=135.0, count=50)
        sea = SeaState(systems=[system], placement=placement)
        scene.waves = None
        scene.add_sea(sea=sea, evaluation="fft")
        if placement == "uniform":
            scene.compile()
            continue
        with pytest.raises(SceneError, match="placement='uniform'"):
            scene.compile()


def test_wrong_words_are_refused() -> None:
    with pytest.raises(SceneError, match="phase is 'true'; choose 'mean', 'slow' or 'actual'"):
        scene_of(phase="true")
    with pytest.raises(SceneError, match="drift is 'newman'; give True or False"):
        scene_of(drift="newman")
    with pytest.raises(SceneError, match="choose table, exact, fft"):
        scene_of(evaluation="spline").compile()
