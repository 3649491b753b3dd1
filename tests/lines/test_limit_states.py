"""Limit states: utilisation by hand, kept by files, results and lifts, refused where they make no sense."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_result import crane_run
from test_summary import LENGTH, MASS, G, pendulum

from seacrane import Lift, Result, Scene, SceneError, simulate, summary
from seacrane.result import About
from seacrane.scene import LimitState

TOP = MASS * G * (3.0 - 2.0 * np.cos(0.3))  # N, of a pendulum let go at 0.3 rad


def limited() -> Scene:
    scene = pendulum()
    scene.add_limit_state(channel="link_tension", maximum=2.5e4, minimum=1.5e4)
    scene.add_limit_state(
        name="swing", channel="position", names={"body": "load", "axis": "x"}, maximum=1.0, minimum=-2
    )
    return scene


@pytest.fixture(scope="module")
def swinging() -> Result:
    return simulate(limited(), t_end=20.0, dt_out=0.02)


def test_utilisation_by_hand(swinging: Result) -> None:
    used = swinging.utilisation
    tension, swing = used["link tension"], used["swing"]
    assert tension.utilisation == pytest.approx(max(TOP / 2.5e4, 1.5e4 / (MASS * G * np.cos(0.3))), rel=1e-4)
    assert (tension.limit, tension.kept) == (25e3, True)
    assert tension.reached == pytest.approx(TOP, rel=1e-4)
    assert swing.utilisation == pytest.approx(LENGTH * np.sin(0.3), rel=1e-4)
    assert swing.kept is False and used.largest == swing.utilisation
    assert swinging.time[swinging.select("position", body="load", axis="x").argmax()] == swing.at


@pytest.mark.parametrize(
    ("low", "high", "values", "used"),
    [(None, 100.0, [20.0, 80.0], 0.8), (-50.0, None, [-60.0, 80.0], 1.2), (-50.0, 100.0, [-40.0, 90.0], 0.9),
     (10.0, None, [5.0, 80.0], 2.0), (10.0, None, [-1.0, 80.0], np.inf), (None, -10.0, [-40.0, -20.0], 0.5),
     (None, 100.0, [-20.0, -80.0], 0.0)],
)  # fmt: skip
def test_every_kind_of_bound(low: float | None, high: float | None, values: Any, used: float) -> None:
    run = crane_run(t_end=1.0)
    tension = np.resize(np.array(values), run["time"].size)
    about = About(limit_states=(LimitState(name="t", channel="link_tension", maximum=high, minimum=low),))
    result = Result.from_arrays(**run | {"arrays": {"link_tension": tension}, "about": about})
    assert result.utilisation[0].utilisation == pytest.approx(used)


def test_one_word_asks_for_a_slack_margin_of_a_tenth() -> None:
    scene = pendulum()
    scene.add_limit_state("slack")
    scene.add_limit_state("slack[rope]", minimum=0.5, name="tighter")
    margin, tighter = simulate(scene, t_end=5.0, dt_out=0.02).utilisation
    assert (margin.limit, margin.channel, margin.kept) == (0.1, "slack_margin", True)
    assert margin.utilisation == pytest.approx(0.1 / np.cos(0.3), rel=1e-3), "least tension: W cos(0.3)"
    assert tighter.utilisation == pytest.approx(0.5 / np.cos(0.3), rel=1e-3)
    assert lift('channel = "slack[hoist]"').limit_states["slack margin hoist"].minimum == 0.1


def lift(text: str) -> Scene:
    return Lift(tomllib.loads(f'[scene]\nname = "one"\n[[limit_state]]\n{text}')).scene()


def test_files_keep_them_and_the_worst_of_a_name_left_open_counts(swinging: Result, tmp_path: Path) -> None:
    loaded = Result.load(swinging.save(tmp_path / "swing.nc"))
    assert loaded.utilisation == swinging.utilisation
    assert "1.48 exceeded" in str(summary(loaded))
    told = simulate(limited(), to=tmp_path / "long.nc", t_end=20.0, dt_out=0.02)
    assert told.load().utilisation == swinging.utilisation
    limited().save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json").limit_states == limited().copy().limit_states
    scene = pendulum()
    scene.add_limit_state(channel="position", names={"body": "load"}, maximum=1.0, minimum=-10.0)
    (used,) = simulate(scene, t_end=5.0).utilisation
    assert used.curve == "x"


def test_a_channel_that_is_not_usual_is_recorded_and_one_left_out_is_told() -> None:
    scene = pendulum()
    scene.add_limit_state(channel="acceleration", names={"body": "load"}, maximum=50.0)
    assert "acceleration" in simulate(scene, t_end=0.2)
    partial = simulate(scene, t_end=0.2, channels=["position"])
    assert partial.utilisation[0].kept is None and np.isnan(partial.utilisation.largest)


@pytest.mark.parametrize(
    ("given", "words"),
    [({"channel": "link_tension"}, "neither maximum nor minimum"),
     ({"channel": "link_tension", "maximum": 1.0, "minimum": 2.0}, "minimum is 2 and maximum 1"),
     ({"channel": "stroke", "maximum": 1.0}, "limit state 'stroke': channel 'stroke'"),
     ({"channel": "position", "maximum": 1.0, "names": {"body": "lode"}}, "no body 'lode'")],
)  # fmt: skip
def test_what_states_no_limit_is_refused_before_the_run(given: dict[str, Any], words: str) -> None:
    scene = limited()
    with pytest.raises(SceneError, match=words):
        scene.add_limit_state(**given)
        simulate(scene, t_end=1.0)
