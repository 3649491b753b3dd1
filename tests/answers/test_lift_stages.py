"""Stages and ballast in lift files: the same as by calls, on the command line, and mistakes by their line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from lift_examples import HEAD, ON_DECK, lift_of

from seacrane import Curve, FileFormatError, Lift, Move, Result, Scene, Stage, Until, simulate
from seacrane.cli import main
from seacrane.hydro import shipped_database
from seacrane.scene import Tank
from seacrane.warnings import StartTransientWarning

STAGES = (
    Stage(name="hold", duration=1.05),
    Stage(name="lift off", until=Until.release("on deck"), maximum_duration=60.0,
          commands={"hoist.rate": -0.05}),
    Stage(name="raise", until=Until.length("hoist", maximum=19.6), maximum_duration=60.0,
          commands={"hoist.rate": Move(to=-0.4, over=1.0)}),
    Stage(name="stop", duration=1.0, commands={"hoist.rate": Curve.constant(value=0.0)}),
    Stage(name="let go", duration=0.5, release=["hoist"]),
)  # fmt: skip
CRANE = (
    HEAD
    + """
[crane]
base = "ground"
[[driver]]
joint = "A"; name = "slew"; curve_deg = { kind = "constant", value = 0 }
[[actuator]]
joint = "main_cylinder"; name = "main"
[[stage]]
name = "slew"; duration_s = 5
commands = [{ name = "slew", by_deg = 10, over_s = 4 }, { name = "main.reference", to_m = 0.2, over_s = 4 }]
""".replace("; ", "\n")
)


def test_tables_are_stages(tmp_path: Path) -> None:
    lift = lift_of(ON_DECK, tmp_path)
    assert lift.stages == STAGES
    lift.save(tmp_path / "again.toml")
    assert Lift.load(tmp_path / "again.toml").stages == STAGES
    turned = lift_of(CRANE, tmp_path)
    assert turned.stages[0].commands["slew"] == Move(by=np.radians(10.0), over=4.0)
    turned.scene()


WAIT = '{ length = "hoist", maximum_m = 19.6 }'


def test_a_channel_is_waited_for_in_its_unit(tmp_path: Path) -> None:
    high = '{ channel = "position", minimum_m = 3, names = { body = "load", axis = "z" } }'
    slewed = '{ channel = "slew_angle", maximum_deg = -10 }'
    for old, new, found in (
        (WAIT, high, (Until.channel("position", minimum=3.0, body="load", axis="z"),)),
        (WAIT, '{ tension = "hoist", maximum_N = 0 }', (Until.tension("hoist", maximum=0.0),)),
        (WAIT, slewed, (Until.channel("slew_angle", maximum=np.radians(-10.0)),)),
        ('{ release = "on deck"', '{ contact = "on deck"', (Until.contact("on deck"),)),
    ):  # fmt: skip
        stages = lift_of(ON_DECK.replace(old, new), tmp_path).stages
        assert stages[2 if old == WAIT else 1].until == found


@pytest.mark.warns("ThroughSeatWarning")
def test_a_lift_in_stages_runs_as_by_calls(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lift = lift_of(ON_DECK, tmp_path)
    direct = simulate(lift.scene(), STAGES, outputs=lift.outputs)
    result = lift.simulate()
    assert [span.ended_by for span in result.stages] == [span.ended_by for span in direct.stages]
    np.testing.assert_array_equal(result["position"], direct["position"])
    command = ["run", str(tmp_path / "my_lift.toml"), "--out", str(tmp_path)]
    assert main(command) == 0
    saved = Result.load(tmp_path / "my_lift.nc")
    assert saved.stages == result.stages
    np.testing.assert_array_equal(saved["position"], direct["position"])
    assert main([*command, "--t-end", "3"]) == 1
    assert "--t-end" in capsys.readouterr().err


RATE = "value_m_per_s = -0.05"
MISTAKES = [
    ("duration_s = 1.05\n", "", "line 33: .*'hold'"),
    (RATE, f"{RATE}, to_m_per_s = 1", "line 37: .*'hoist.rate' has to and value"),
    (", over_s = 1", "", "'hoist.rate' has no over_s"),
    (RATE, f"{RATE}, over_s = 3", "has an over_s"),
    (f"{RATE} }}", f'{RATE} }}, {{ name = "hoist.rate", value_m_per_s = 0 }}', "rate'.*twice"),
    ("maximum_m = 19.6", 'maximum_m = 19.6, contact = "deck"', "length and contact"),
    ("maximum_m = 19.6", "maximum_N = 19.6", "maximum_N.*maximum_m"),
    ("[outputs]", "[run]\nt_end_s = 9\n\n[outputs]", "t_end_s"),
    ('length = "hoist"', 'length = "hook"', "line 43: .*'raise'.*'hook'"),
    ("to_m_per_s = -0.4", "to_m = -0.4", "line 43: .*to_m .*to_m_per_s"),
]


def test_a_mistake_is_told_by_its_line(tmp_path: Path) -> None:
    """The last two once the scene is made."""
    for old, new, words in MISTAKES:
        assert old in ON_DECK
        with pytest.raises(FileFormatError, match=words):
            lift_of(ON_DECK.replace(old, new), tmp_path).scene()


def test_a_trade_of_a_file_with_stages(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lift_of(ON_DECK, tmp_path)
    assert main(["trade", str(tmp_path / "my_lift.toml"), "--out", str(tmp_path), "--budget", "2"]) == 0
    assert "Pareto front" in capsys.readouterr().out


TANKS = {"port": (0, 9, 2), "starboard": (0, -9, 2), "fore": (40, 0, 2), "aft": (-40, 0, 2)}
TANK = '    {{ name = "{}", point_m = {}, capacity_kg = 400e3, content_kg = 200e3 }},\n'
BALLAST = (
    HEAD + """
[vessel]
database = "hull_115"; memory = "none"
[body]
name = "cargo"; mass_kg = 50e3; inertia_kg_m2 = [1e5, 1e5, 1e5]; position_m = [10, 4, 8]
[joint]
kind = "weld"; name = "lashing"; first = "vessel"; second = "cargo"; point_m = [0, 0, 0]
[ballast]
heel_deg = -0.5
tanks = [
""".replace("; ", "\n") + "".join(TANK.format(name, list(at)) for name, at in TANKS.items()) + "]\n"
)  # fmt: skip


def test_tanks_are_filled_as_by_calls(tmp_path: Path) -> None:
    scene = Scene()
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_body(name="cargo", mass=50e3, inertia=(1e5, 1e5, 1e5), position=(10, 4, 8))
    scene.add_joint(kind="weld", name="lashing", first="vessel", second="cargo", point=(0, 0, 0))
    tanks = {name: Tank(point=point, capacity=400e3, content=200e3) for name, point in TANKS.items()}
    scene.add_ballast(heel_deg=-0.5, tanks=tanks)
    assert lift_of(BALLAST, tmp_path).scene() == scene
    for text, words in (
        (BALLAST.replace('"starboard"', '"port"'), "line 20: .*'port' twice"),
        (BALLAST + '\n[balance]\nvessel = "vessel"\n', r"\[balance\].*\[ballast\]"),
    ):
        with pytest.raises(FileFormatError, match=words):
            lift_of(text, tmp_path).scene()


@pytest.mark.parametrize(
    ("wait", "ramp", "told"), [(5, 20, True), (20, 20, False), (0, 0, False), (0, 5, True)]
)
def test_what_begins_while_a_given_ship_hardly_moves_is_told(
    wait: int, ramp: int, told: bool, tmp_path: Path, recwarn: pytest.WarningsRecorder
) -> None:
    """An example that lifted off a barge within its ramp told of no hits, and of half the accelerations."""
    text = (
        HEAD
        + f"""
[vessel]
database = "hull_115"
motion = "raos"
ramp_s = {ramp}
duration_s = 60
[sea]
hs_m = 1
tp_s = 8
count = 6
[crane]
held = true
[hoist]
mass_t = 50
size_m = [4, 4, 4]
length_m = 20
EA_N = 6e7
winch = {{}}
"""
    )
    stages = f'[[stage]]\nname = "wait"\nduration_s = {wait}\n' if wait else ""
    stages += '[[stage]]\nname = "lift"\nduration_s = 9\n'
    stages += 'commands = [{ name = "hoist.rate", value_m_per_s = -0.1 }]\n'
    lift_of(text + stages, tmp_path).scene()
    found = [str(one.message) for one in recwarn if one.category is StartTransientWarning]
    assert len(found) == told and all(
        f"grows over {ramp} s, and what the stages do begins after {wait} s" in one for one in found
    )
