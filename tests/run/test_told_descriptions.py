"""What describing a scene warns of, in results and reports; seas, records and tables that cannot be."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mistaken_units import raos, record

import seacrane
from seacrane import Scene, Stage, simulate, simulate_stages
from seacrane.hydro import load_database, shipped_database
from seacrane.warnings import NoisyMotionWarning, RaoPhaseWarning, UnitWarning


def told_twice() -> Scene:
    """A ship whose heading and sea both look like radians; both warnings come before anything runs."""
    scene = Scene(name="told twice")
    scene.add_vessel(shipped_database(), heading_deg=np.pi / 4)
    scene.add_sea(hs=1.0, tp=8.0, count=20, direction_deg=np.pi * 3 / 4)
    return scene


def quietly(make: Callable[[], Any]) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return make()


WORDS = ("heading_deg is 0.785398 deg", "direction_deg is 2.35619 deg")


@pytest.mark.slow("a whole lift")
def test_a_report_lists_the_warnings_of_the_description(tmp_path: Path) -> None:
    result = quietly(lambda: simulate(told_twice(), t_end=1.0))
    loaded = seacrane.Result.load(result.save(tmp_path / "run.nc"))
    assert all(word in seacrane.report(loaded).html for word in WORDS)


def test_what_was_told_before_the_start_is_listed_once() -> None:
    scene = quietly(told_twice)
    stages = [Stage(name="one", duration=0.5), Stage(name="two", duration=0.5)]
    for result in (
        quietly(lambda: simulate(scene.copy(name="copy"), t_end=0.5)),
        quietly(lambda: simulate_stages(scene, stages)),
    ):
        assert all(str(result.stats["described"]).count(word) == 1 for word in WORDS)


@pytest.mark.warns(sometimes=["WavesWithoutLoadWarning"])
@pytest.mark.parametrize("tp", [8000.0, 0.008])
def test_a_peak_period_in_another_unit_is_told(tp: float) -> None:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), memory="none")
    with pytest.warns(UnitWarning, match="sea: tp is"):
        scene.add_sea(tp=tp, hs=1e-6, count=5)


def test_noise_of_millimetres_is_told() -> None:
    """Also a minute that lasts 60 ms; not a record that was filtered, nor a ship that drifts."""
    for noise in (5e-3, 2e-3):
        with pytest.warns(NoisyMotionWarning, match="heave is shaken"):
            record(1.5, noise=noise)
    one, time = record(1.5), np.linspace(0.0, 600.0, 6001)
    with pytest.warns(NoisyMotionWarning):
        seacrane.MotionHistory(time=one.time / 1e3, motion=one.motion)
    record(1.5, noise=2e-4)
    motion = np.zeros((6001, 6))
    motion[:, 0], motion[:, 3] = 0.5 * time, 0.1 * np.sin(0.5 * time)
    seacrane.MotionHistory(time=time, motion=motion)


def test_phases_that_no_hull_has_are_told() -> None:
    def in_degrees(values: Any) -> Any:
        return np.abs(values) * np.exp(1j * np.degrees(np.angle(values)))

    for turned, guess in ((np.conj, "conjugate"), (in_degrees, "degrees"), (np.negative, "axis")):
        with pytest.warns(RaoPhaseWarning, match=guess):
            raos(turned)
    scene, database = Scene(name="ship"), shipped_database()
    scene.add_vessel(replace(database, force=np.conj(database.force)), memory="none")
    with pytest.warns(RaoPhaseWarning, match=r"by its wave loads, .*conjugate"):
        scene.add_sea(hs=1.0, tp=8.0, count=5)


@pytest.mark.parametrize("name", ["wamit/tanker.out", "wamit_fpso/fpso.out", "veres/supply/input.hyd"])
def test_databases_of_real_ships_follow_long_waves(name: str, shared: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        warnings.simplefilter("error", RaoPhaseWarning)
        load_database(shared / name)
