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
from seacrane import Scene, SceneError, SeaState, Stage, WaveSystem, simulate, simulate_stages
from seacrane.hydro import load_database, shipped_database
from seacrane.sea import jonswap
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
def test_a_report_lists_the_warnings_of_the_description(tmp_path) -> None:
    result = quietly(lambda: simulate(told_twice(), t_end=1.0))
    result.save(tmp_path / "run.nc")
    for one in (result, seacrane.Result.load(tmp_path / "run.nc")):
        assert all(word in str(one.stats["described"]) for word in WORDS)
        assert all(word in seacrane.report(one).html for word in WORDS)


def test_what_a_run_warns_of_at_its_start_is_listed_too() -> None:
    scene = Scene(name="slow winch")
    scene.add_body(name="load", mass=2e4, inertia=[3e4] * 3, position=(0, 0, -15))
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=5e7,
                   tension_at_start=2e4 * scene.gravity)  # fmt: skip
    scene.add_winch(line="wire", lag=200.0)
    result = quietly(lambda: simulate(scene, t_end=0.1))
    assert "lag reaches 200 s" in str(result.stats["described"])


def test_a_copy_and_stages_keep_what_was_told() -> None:
    scene = quietly(told_twice)
    stages = [Stage(name="one", duration=0.5), Stage(name="two", duration=0.5)]
    for result in (
        quietly(lambda: simulate(scene.copy(name="copy"), t_end=0.5)),
        quietly(lambda: simulate_stages(scene, stages)),
    ):
        assert all(str(result.stats["described"]).count(word) == 1 for word in WORDS)


def test_a_scene_without_warnings_tells_none() -> None:
    scene = Scene(name="quiet")
    scene.add_body(name="load", mass=2e4, inertia=[3e4] * 3, gravity=False)
    assert "described" not in simulate(scene, t_end=0.1).stats


SYSTEMS = [WaveSystem(spectrum=jonswap(hs=1.0, tp=8.0), direction_deg=180.0, count=30_000)] * 2


@pytest.mark.parametrize(
    ("sea", "words"),
    [
        ({"hs": 2.0, "tp": 8.0}, "there is no vessel 'vessel', the scene has none; call add_vessel first"),
        ({"sea": SeaState(systems=SYSTEMS[:1])}, "there is no vessel 'vessel'"),
    ],
)
def test_a_sea_in_an_empty_scene(sea: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        Scene(name="empty").add_sea(**sea)


@pytest.mark.parametrize(
    ("sea", "words"),
    [
        ({"count": 0}, "count is 0; give a whole number from 1"),
        ({"count": 2.5}, "count is 2.5; give a whole number from 1"),
        ({"count": True}, "count is True; give a whole number"),
        ({"count": "many"}, "count is 'many'; give a whole number"),
        ({"count": 1_000_000}, "count is 1,000,000, components .* give at most 50,000"),
        ({"sea": SeaState(systems=SYSTEMS)}, "count is 60,000, components"),
        ({"hs": -1.0}, "hs is -1"),
        ({"hs": None}, "hs is None; give the significant wave height in m"),
        ({"hs": np.array([1.2])}, r"hs is a ndarray of shape \(1,\); give a number"),
        ({"tp": np.array([1.2, 7.0])}, r"tp is a ndarray of shape \(2,\); give a number"),
        ({"tp": 0.0}, "tp is 0"),
        ({"gamma": 99.0}, "gamma is 99"),
        ({"seed": -1}, "seed is -1"),
        ({"spreading": -2.0}, "-2"),
        ({"direction_deg": float("nan")}, "direction_deg is nan"),
    ],
)
def test_a_sea_that_cannot_be_is_a_scene_error(sea: dict[str, Any], words: str) -> None:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), memory="none")
    with pytest.raises(SceneError, match=words):
        scene.add_sea(**({} if "sea" in sea else {"hs": 1.0}) | sea)
    assert scene.waves is None


@pytest.mark.warns(sometimes=["WavesWithoutLoadWarning"])
@pytest.mark.parametrize("tp", [8000.0, 0.008])
def test_a_peak_period_in_another_unit_is_told(tp: float) -> None:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), memory="none")
    with pytest.warns(UnitWarning, match="sea: tp is"):
        quiet = {"hs": 1e-6, "count": 5}
        scene.add_sea(tp=tp, **quiet)


@pytest.mark.parametrize("noise", [5e-3, 2e-3])
def test_noise_of_millimetres_is_told(noise: float) -> None:
    with pytest.warns(NoisyMotionWarning, match=r"heave is shaken by .* at periods below 1.5 s"):
        record(1.5, noise=noise)


@pytest.mark.parametrize("noise", [0.0, 2e-4])
def test_a_record_that_was_filtered_is_not(noise: float) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        record(1.5, noise=noise)


def test_a_time_in_milliseconds_is_noise() -> None:
    """A minute that lasts 60 ms."""
    with pytest.warns(NoisyMotionWarning):
        seacrane.MotionHistory(time=record(1.5).time / 1e3, motion=record(1.5).motion)


def test_a_ship_that_drifts_is_no_noise() -> None:
    time = np.linspace(0.0, 600.0, 6001)
    motion = np.zeros((6001, 6))
    motion[:, 0], motion[:, 3] = 0.5 * time, 0.1 * np.sin(0.5 * time)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        seacrane.MotionHistory(time=time, motion=motion)


@pytest.mark.parametrize(
    ("turned", "guess"),
    [
        (np.conj, "complex conjugate"),
        (lambda values: np.abs(values) * np.exp(1j * np.degrees(np.angle(values))), "phases in degrees"),
        (lambda values: -values, "an axis is another one"),
    ],
)
def test_phases_that_no_hull_has_are_told(turned: Callable[[Any], Any], guess: str) -> None:
    with pytest.warns(RaoPhaseWarning, match=guess):
        raos(turned)


def test_a_database_with_loads_of_the_other_sign_is_told() -> None:
    scene, database = Scene(name="ship"), shipped_database()
    lagging = replace(database, force=np.conj(database.force))
    scene.add_vessel(lagging, memory="none")
    with pytest.warns(RaoPhaseWarning, match=r"by its wave loads, .*complex conjugate"):
        scene.add_sea(hs=1.0, tp=8.0, count=5)


@pytest.mark.parametrize("name", ["wamit/tanker.out", "wamit_fpso/fpso.out", "veres/supply/input.hyd"])
def test_databases_of_real_ships_follow_long_waves(name: str, shared: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        warnings.simplefilter("error", RaoPhaseWarning)
        load_database(shared / name)
