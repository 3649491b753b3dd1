"""Limit states: utilisation by hand, kept by files, results and lifts, refused where they make no sense."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest
from test_lift_report import titles
from test_result import crane_run
from test_summary import LENGTH, MASS, G, pendulum

from seacrane import (
    FileFormatError,
    Lift,
    Result,
    Scene,
    SceneError,
    report,
    simulate,
    simulate_to_file,
    summary,
)
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
    assert (tension.limit, tension.unit, tension.kept) == (25e3, "N", True)
    assert tension.reached == pytest.approx(TOP, rel=1e-4)
    assert swing.utilisation == pytest.approx(LENGTH * np.sin(0.3), rel=1e-4)
    assert swing.kept is False and used.largest == swing.utilisation
    assert swinging.time[swinging.select("position", body="load", axis="x").argmax()] == swing.at


def states_of(low: float | None, high: float | None, values: list[float]) -> float:
    run = crane_run(t_end=1.0)
    tension = np.resize(np.array(values), run["time"].size)
    state = LimitState(name="t", channel="link_tension", maximum=high, minimum=low)
    about = About(limit_states=(state,))
    result = Result.from_arrays(**run | {"arrays": {"link_tension": tension}, "about": about})
    return result.utilisation[0].utilisation


def test_every_kind_of_bound() -> None:
    assert states_of(None, 100.0, [20.0, 80.0]) == pytest.approx(0.8)
    assert states_of(-50.0, None, [-60.0, 80.0]) == pytest.approx(1.2)
    assert states_of(-50.0, 100.0, [-40.0, 90.0]) == pytest.approx(0.9)
    assert states_of(10.0, None, [20.0, 80.0]) == pytest.approx(0.5), "a slack margin"
    assert states_of(10.0, None, [5.0, 80.0]) == pytest.approx(2.0)
    assert states_of(10.0, None, [-1.0, 80.0]) == np.inf, "it has gone slack"
    assert states_of(None, -10.0, [-40.0, -20.0]) == pytest.approx(0.5)
    assert states_of(None, 100.0, [-20.0, -80.0]) == 0.0


def test_one_word_asks_for_a_slack_margin_of_a_tenth() -> None:
    scene = pendulum()
    scene.add_limit_state("slack")
    scene.add_limit_state("slack[rope]", minimum=0.5, name="tighter")
    margin, tighter = simulate(scene, t_end=5.0, dt_out=0.02).utilisation
    assert (margin.limit, margin.channel, margin.kept) == (0.1, "slack_margin", True)
    assert margin.utilisation == pytest.approx(0.1 / np.cos(0.3), rel=1e-3), "least tension: W cos(0.3)"
    assert tighter.utilisation == pytest.approx(0.5 / np.cos(0.3), rel=1e-3)
    assert lift('channel = "slack[hoist]"').limit_states["slack margin hoist"].minimum == 0.1


def test_of_a_name_left_open_the_worst_counts(swinging: Result) -> None:
    scene = pendulum()
    scene.add_limit_state(channel="position", names={"body": "load"}, maximum=1.0, minimum=-10.0)
    (used,) = simulate(scene, t_end=5.0).utilisation
    assert used.curve == "x" and "position load (x)" in str(simulate(scene, t_end=5.0).utilisation)


def test_it_is_in_files_summaries_and_reports(swinging: Result, tmp_path: Path) -> None:
    swinging.save(tmp_path / "swing.nc")
    loaded = Result.load(tmp_path / "swing.nc")
    assert loaded.utilisation == swinging.utilisation
    assert "1.48 exceeded" in str(summary(loaded)) and "exceeded" in summary(loaded)._repr_html_()
    page = report(loaded)
    assert "Summary" in titles(page) and "Utilisation of limit states" in page.html
    assert "Largest utilisation<strong>1.48, swing</strong>" in page.html
    told = simulate_to_file(limited(), tmp_path / "long.nc", t_end=20.0, dt_out=0.02)
    assert told.load().utilisation == swinging.utilisation


def test_a_limit_state_that_no_scene_has_is_refused_by_name() -> None:
    run = crane_run(t_end=1.0)
    about = About(limit_states=(LimitState(name="t", channel="link_tension"),))
    broken = Result.from_arrays(**run | {"about": about})
    with pytest.raises(FileFormatError, match="limit states are none that a run writes"):
        broken.utilisation.largest  # noqa: B018 - the property itself is asked for


def test_scene_files_and_copies_keep_them(tmp_path: Path) -> None:
    scene = limited()
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json") == scene == scene.copy()
    assert Scene.load(tmp_path / "scene.json").limit_states["swing"] == LimitState(
        name="swing", channel="position", maximum=1.0, minimum=-2.0, names={"body": "load", "axis": "x"}
    )
    scene.remove("swing")
    assert list(scene.limit_states) == ["link tension"]


def test_a_channel_that_is_not_usual_is_recorded_and_one_left_out_is_told() -> None:
    scene = pendulum()
    scene.add_limit_state(channel="acceleration", names={"body": "load"}, maximum=50.0)
    assert "acceleration" in simulate(scene, t_end=0.2)
    partial = simulate(scene, t_end=0.2, channels=["position"])
    assert partial.utilisation[0].kept is None and "not recorded" in str(partial.utilisation)
    assert np.isnan(partial.utilisation.largest)
    with pytest.raises(KeyError, match="no limit state 'x'; the scene has 'acceleration load'"):
        partial.utilisation["x"]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"channel": "link_tension"}, "has neither maximum nor minimum"),
        ({"channel": "link_tension", "maximum": 0.0}, "maximum is 0; a utilisation is over a finite value"),
        ({"channel": "link_tension", "maximum": np.nan}, "maximum is nan"),
        (
            {"channel": "link_tension", "maximum": 1.0, "minimum": 2.0},
            "minimum is 2 and maximum 1; minimum must",
        ),
        ({"channel": "link_tension", "maximum": "1"}, "maximum is '1'; give a number"),
        ({"channel": "position", "maximum": 1.0, "names": "load"}, "names is 'load'; give names"),
    ],
)
def test_what_states_no_limit_is_refused(given: dict[str, object], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        pendulum().add_limit_state(**given)  # type: ignore[arg-type]
    scene = limited()
    with pytest.raises(SceneError, match="the name is used twice"):
        scene.add_limit_state(channel="position", name="swing", maximum=1.0)


def lift(text: str) -> Scene:
    return Lift(tomllib.loads(f'[scene]\nname = "one"\n[[limit_state]]\n{text}')).scene()


def test_a_lift_gives_limits_with_their_unit() -> None:
    scene = lift('channel = "vessel_motion"\nnames = { motion = "roll" }\nmaximum_deg = 5\nminimum_deg = -5')
    (state,) = scene.limit_states.values()
    assert (state.maximum, state.minimum) == pytest.approx((np.radians(5.0), np.radians(-5.0)))
    with pytest.raises(
        FileFormatError, match="maximum_m: channel 'vessel_motion' is in rad; give maximum_rad or maximum_deg"
    ):
        lift('channel = "vessel_motion"\nnames = { motion = "roll" }\nmaximum_m = 5')
    with pytest.raises(FileFormatError, match="maximum_deg: channel 'link_tension' is in N; give maximum_N"):
        lift('channel = "link_tension"\nmaximum_deg = 5')
    with pytest.raises(
        FileFormatError, match=r"maximum_m: channel 'vessel_motion' is in .*name one of its curves"
    ):
        lift('channel = "vessel_motion"\nmaximum_m = 5')


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"channel": "tensoin"}, "channel 'tensoin' does not exist; did you mean 'tension'"),
        ({"channel": "stroke"}, "limit state 'stroke': channel 'stroke' is unknown to this scene"),
        ({"channel": "position", "names": {"body": "lode"}}, "there is no body 'lode'; choose from load"),
        (
            {"channel": "position", "names": {"hook": "hook"}},
            "has no dimension 'hook'; its dimensions are body, axis",
        ),
    ],
)
def test_what_the_scene_does_not_have_is_refused_before_the_run(given: dict[str, object], words: str) -> None:
    scene = pendulum()
    with pytest.raises(SceneError, match=words):
        scene.add_limit_state(maximum=1.0, **given)  # type: ignore[arg-type]
        simulate(scene, t_end=1.0)
