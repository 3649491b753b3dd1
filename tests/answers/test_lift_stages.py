"""Stages and ballast in lift files: the same as by calls, on the command line, and mistakes by their line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from lift_examples import HEAD, ON_DECK

from seacrane import Curve, FileFormatError, Lift, Move, Result, Scene, Stage, Until, simulate_stages
from seacrane.cli import main
from seacrane.hydro import shipped_database
from seacrane.scene import Tank

STAGES = (
    Stage(name="hold", duration=1.05),
    Stage(
        name="lift off",
        until=Until.release("on deck"),
        maximum_duration=60.0,
        commands={"hoist.rate": -0.05},
    ),
    Stage(
        name="raise", until=Until.length("hoist", maximum=19.6), maximum_duration=60.0,
        commands={"hoist.rate": Move(to=-0.4, over=1.0)},
    ),
    Stage(name="stop", duration=1.0, commands={"hoist.rate": Curve.constant(value=0.0)}),
    Stage(name="let go", duration=0.5, release=["hoist"]),
)  # fmt: skip
CRANE = (
    HEAD
    + """
[crane]
base = "ground"

[[driver]]
joint = "A"
name = "slew"
curve_deg = { kind = "constant", value = 0 }

[[actuator]]
joint = "main_cylinder"
name = "main"

[[stage]]
name = "slew"
duration_s = 5
commands = [{ name = "slew", by_deg = 10, over_s = 4 }, { name = "main.reference", to_m = 0.2, over_s = 4 }]
"""
)


def lift_of(text: str, folder: Path) -> Lift:
    (folder / "my_lift.toml").write_text(text, encoding="utf-8")
    return Lift.load(folder / "my_lift.toml")


def test_tables_are_stages(tmp_path: Path) -> None:
    lift = lift_of(ON_DECK, tmp_path)
    assert lift.stages == STAGES
    lift.save(tmp_path / "again.toml")
    assert Lift.load(tmp_path / "again.toml").stages == STAGES
    turned = lift_of(CRANE, tmp_path)
    assert turned.stages[0].commands["slew"] == Move(by=np.radians(10.0), over=4.0)
    turned.scene()


def test_a_channel_is_waited_for_in_its_unit(tmp_path: Path) -> None:
    waits = (
        '{ channel = "position", minimum_m = 3, names = { body = "load", axis = "z" } }, '
        '{ tension = "hoist", maximum_N = 0 }'
    )
    text = ON_DECK.replace('{ length = "hoist", maximum_m = 19.6 }', waits)
    stage = lift_of(text, tmp_path).stages[2]
    high = Until.channel("position", minimum=3.0, body="load", axis="z")
    assert stage.until == (high, Until.tension("hoist", maximum=0.0))
    slewed = '{ channel = "slew_angle", maximum_deg = -10 }'
    stage = lift_of(ON_DECK.replace('{ length = "hoist", maximum_m = 19.6 }', slewed), tmp_path).stages[2]
    assert stage.until == (Until.channel("slew_angle", maximum=np.radians(-10.0)),)
    stage = lift_of(ON_DECK.replace("{ release =", "{ contact ="), tmp_path).stages[1]
    assert stage.until == (Until.contact("on deck"),)


@pytest.mark.warns("ThroughSeatWarning")
def test_a_lift_in_stages_runs_as_by_calls(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lift = lift_of(ON_DECK, tmp_path)
    direct = simulate_stages(lift.scene(), STAGES, outputs=lift.outputs)
    result = lift.simulate()
    assert [span.ended_by for span in result.stages] == [span.ended_by for span in direct.stages]
    np.testing.assert_array_equal(result["position"], direct["position"])
    assert main(["run", str(tmp_path / "my_lift.toml"), "--out", str(tmp_path)]) == 0
    told = capsys.readouterr().out
    assert "hoist" in told and "'on deck' lets go" in told
    saved = Result.load(tmp_path / "my_lift.nc")
    assert saved.stages == result.stages
    np.testing.assert_array_equal(saved["position"], direct["position"])


MISTAKES = {
    "no end": ("duration_s = 1.05\n", "", "line 33: [[stage]] 1: stage 'hold': nothing ends it"),
    "two ways": (
        '{ name = "hoist.rate", value_m_per_s = -0.05 }',
        '{ name = "hoist.rate", value_m_per_s = -0.05, to_m_per_s = 1 }',
        "line 37: [[stage]] 2: commands: 'hoist.rate' has to and value; give one of to, by, value, curve",
    ),
    "no time": (", over_s = 1", "", "'hoist.rate' has no over_s; give over_s, the time that the move takes"),
    "a time too many": (
        "value_m_per_s = -0.05",
        "value_m_per_s = -0.05, over_s = 3",
        "'hoist.rate' has an over_s; leave over_s out beside value",
    ),
    "twice": (
        "value_m_per_s = -0.05 }",
        'value_m_per_s = -0.05 }, { name = "hoist.rate", value_m_per_s = 0 }',
        "commands: 'hoist.rate' is given twice",
    ),
    "two waits": (
        "maximum_m = 19.6",
        'maximum_m = 19.6, contact = "deck"',
        "until: has length and contact; give one",
    ),
    "no wait": ('{ release = "on deck" }', "{ }", "until: has nothing to wait for; give one of"),
    "names of a line": (
        "maximum_m = 19.6",
        'maximum_m = 19.6, names = { line = "hoist" }',
        "names goes with channel",
    ),
    "a bound of a limit": (
        'release = "on deck"',
        'release = "on deck", minimum_m = 1',
        "minimum stands beside release",
    ),
    "a unit": (
        "maximum_m = 19.6",
        "maximum_N = 19.6",
        "maximum_N: channel 'line_unstretched_length' is in m; give maximum_m",
    ),
    "an end of the run": ("[outputs]", "[run]\nt_end_s = 9\n\n[outputs]", "t_end_s stands beside [[stage]]"),
}
REFUSED = {
    "an unknown line": (
        'length = "hoist"',
        'length = "hook"',
        "line 43: stage 'raise': waits for line 'hook'",
    ),
    "a command's unit": (
        "to_m_per_s = -0.4",
        "to_m = -0.4",
        "line 43: [[stage]] 3: to_m is given of 'hoist.rate', which is in m/s; give to_m_per_s",
    ),
    "a release": (
        'release = ["hoist"]',
        'release = ["sling"]',
        "stage 'let go' releases: the scene has no 'sling'",
    ),
}


@pytest.mark.parametrize("case", MISTAKES)
def test_a_mistake_is_told_by_its_line(case: str, tmp_path: Path) -> None:
    old, new, message = MISTAKES[case]
    assert old in ON_DECK
    with pytest.raises(FileFormatError) as told:
        lift_of(ON_DECK.replace(old, new), tmp_path)
    assert message in str(told.value)


@pytest.mark.parametrize("case", REFUSED)
def test_what_does_not_fit_the_scene_is_told_by_its_line(case: str, tmp_path: Path) -> None:
    old, new, message = REFUSED[case]
    assert old in ON_DECK
    lift = lift_of(ON_DECK.replace(old, new), tmp_path)
    with pytest.raises(FileFormatError) as told:
        lift.scene()
    assert message in str(told.value)


def test_options_that_stages_have_no_use_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lift_of(ON_DECK, tmp_path)
    assert main(["run", str(tmp_path / "my_lift.toml"), "--out", str(tmp_path), "--t-end", "3"]) == 1
    assert "--t-end does not go with a lift in stages" in capsys.readouterr().err


def test_a_trade_of_a_file_with_stages_prints_front_and_needs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lift_of(ON_DECK, tmp_path)
    assert main(["trade", str(tmp_path / "my_lift.toml"), "--out", str(tmp_path), "--budget", "2"]) == 0
    told = capsys.readouterr()
    assert "Pareto front" in told.out and "requires: a run takes" in told.out
    assert "trade: one run takes" in told.err and "required: takes about" in told.err


BALLAST = (
    HEAD
    + """
[vessel]
database = "hull_115"
memory = "none"

[[body]]
name = "cargo"
mass_kg = 50e3
inertia_kg_m2 = [1e5, 1e5, 1e5]
position_m = [10, 4, 8]

[[joint]]
kind = "weld"
name = "lashing"
first = "vessel"
second = "cargo"
point_m = [0, 0, 0]

[ballast]
heel_deg = -0.5
tanks = [
    { name = "port", point_m = [0, 9, 2], capacity_kg = 400e3, content_kg = 200e3 },
    { name = "starboard", point_m = [0, -9, 2], capacity_kg = 400e3, content_kg = 200e3 },
    { name = "fore", point_m = [40, 0, 2], capacity_kg = 400e3, content_kg = 200e3 },
    { name = "aft", point_m = [-40, 0, 2], capacity_kg = 400e3, content_kg = 200e3 },
]
"""
)


def test_tanks_are_filled_as_by_calls(tmp_path: Path) -> None:
    scene = Scene()
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_body(name="cargo", mass=50e3, inertia=(1e5, 1e5, 1e5), position=(10, 4, 8))
    scene.add_joint(kind="weld", name="lashing", first="vessel", second="cargo", point=(0, 0, 0))
    places = {"port": (0, 9, 2), "starboard": (0, -9, 2), "fore": (40, 0, 2), "aft": (-40, 0, 2)}
    tanks = {name: Tank(point=point, capacity=400e3, content=200e3) for name, point in places.items()}
    scene.add_ballast(heel_deg=-0.5, tanks=tanks)
    assert lift_of(BALLAST, tmp_path).scene() == scene


def test_ballast_that_cannot_be_is_told_by_its_line(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"line 23: .*tanks has 'port' twice"):
        lift_of(BALLAST.replace('"starboard"', '"port"'), tmp_path).scene()
    with pytest.raises(FileFormatError, match=r"\[ballast\].*capacity is -1.0 kg"):
        lift_of(BALLAST.replace("capacity_kg = 400e3", "capacity_kg = -1"), tmp_path).scene()
    with pytest.raises(FileFormatError, match=r"\[balance\] stands beside \[ballast\]"):
        lift_of(BALLAST + '\n[balance]\nvessel = "vessel"\n', tmp_path).scene()
