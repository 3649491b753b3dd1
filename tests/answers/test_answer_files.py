"""Tables of answers in a lift file: what the calls give, what is said first, and what is refused."""

from __future__ import annotations

import inspect
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pytest
from lift_examples import HEAD

import seacrane.answers
from seacrane import FileFormatError, Lift, Result, Scene, SceneError
from seacrane.answers import (
    Cargo,
    Draught,
    FatigueCurve,
    code_factors,
    deck_cargo,
    fatigue,
    simplified_method,
)
from seacrane.cli.command_line import main
from seacrane.lift.answer_keys import ANSWERS
from seacrane.lift.answers_run import RUN, run_answers
from seacrane.run.outputs import Outputs
from seacrane.simulation import simulate
from seacrane.warnings import MassUnitWarning

BOUNCING = (
    HEAD
    + """
[scene]; name = "bouncing"; gravity_m_per_s2 = 9.80665

[[body]]; name = "load"; mass_t = 20; inertia_kg_m2 = [1e4, 1e4, 1e4]; position_m = [0, 0, -10.2]

[[point]]; name = "box"; body = "load"; point_m = [0, 0, 0.5]

[[channel]]; name = "lead"; expression = "box.x - 0 m"

[[line]]; name = "wire"; first = "ground"; second = "load"; first_point_m = [0, 0, 0]
second_point_m = [0, 0, 0]; EA_kN = 5000; length_m = 10; damping_ratio = 0; rung = "elastic"

[run]; t_end_s = 10

[outputs]; dt_out_s = 0.05; channels = ["position"]

[fatigue]; after_s = 1
curves = [{ channels = ["line_tension[wire]"], constant = 100, slope = 2, scale_kN = 1000, source = "mine" }]

[[code_factors]]; hs_m = 2; mass_t = 20; stiffness_N_per_m = 5e5

[[code_factors]]; hs_m = 2; mass_t = 20; stiffness_kN_per_m = 500; deck = "fixed"
simulated = { "dynamic factor" = "slack_margin[wire].max", offlead = "own[lead].max" }

[simplified_method]; mass_t = 20; hs_m = 1; tz_s = 6; lowering_speed_m_per_min = 15
draughts = [{ name = "half under", volume_m3 = 4, drag_area_m2 = 9 }, { name = "under", added_mass_t = 5 }]
simulated."half under" = "slack_margin[wire].min"

[deck_cargo]; deck = "load"
cargo = [{ point = "box", mass_t = 3, fastenings_m = [[1, 1, -1], [1, -1, -1], [-1, 0, -1]] }]
"""
).replace("; ", "\n")


def lift_in(folder: Path, *changes: tuple[str, str]) -> Path:
    text = BOUNCING
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "my_lift.toml").write_text(text, encoding="utf-8")
    return folder / "my_lift.toml"


def test_a_file_gives_what_the_calls_give(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A weight on a spring: 1 + a / x of its weight, where the code has 1 off a fixed deck."""
    path, out = lift_in(tmp_path), tmp_path / "out"
    found = run_answers(path, out)
    lift = Lift.load(path)
    lift.save(tmp_path / "again.toml")
    assert Lift.load(tmp_path / "again.toml") == lift
    channels = ("line_tension", "slack_margin", "point_acceleration", "quaternion")
    result = simulate(lift.scene(), 10.0, outputs=Outputs(dt_out=0.05, channels=channels))
    factor, margin = result.reached("slack_margin")[1].max(), result.reached("slack_margin")[0].min()
    assert factor == pytest.approx(1.0 + (2e4 * 9.80665 / 5e5 - 0.2) / (2e4 * 9.80665 / 5e5), rel=1e-3)
    curve = FatigueCurve(constant=100.0, slope=2.0, scale=1e6, source="mine")
    corners = [(1.0, 1.0, -1.0), (1.0, -1.0, -1.0), (-1.0, 0.0, -1.0)]
    draughts = [
        Draught(name="half under", volume=4.0, drag_area=9.0), Draught(name="under", added_mass=5e3)
    ]  # fmt: skip
    beside = {"hs": 2.0, "mass": 2e4, "stiffness": 5e5}
    by_calls = {
        "Code factors 2": code_factors(
            **beside, deck="fixed", simulated={"dynamic factor": factor, "offlead": 0.0}
        ),
        "Simplified method": simplified_method(
            mass=2e4, draughts=draughts, hs=1.0, tz=6.0, lowering_speed=0.25, simulated={"half under": margin}
        ),
        "Fatigue": fatigue(result, curves={"line_tension[wire]": curve}, after=1.0),
        "Code factors": code_factors(**beside),
        "Deck cargo": deck_cargo(
            result, cargo=[Cargo(point="box", mass=3e3, fastenings=corners)], deck="load"
        ),
    }
    assert {name: str(one) for name, one in found.items()} == {
        name: str(one) for name, one in by_calls.items()
    }
    assert [*found][:2] == [*by_calls][:2], "what a simulation exceeds is said first"
    page = (out / "answers.html").read_text()
    first = page.index("SIMULATED ABOVE THE CODE: dynamic factor.")
    assert first < page.index("Fatigue by") and 'class="bad"' in page
    files = {
        "fatigue",
        "code_factors",
        "code_factors_2",
        "simplified_method",
        "deck_cargo",
        "deck_cargo_fastening",
    }
    assert {one.stem for one in out.glob("*.csv")} == files
    table = pandas.read_csv(out / "code_factors_2.csv", index_col=0)
    assert table["exceeded"].dropna().to_dict() == {"dynamic factor": "yes", "offlead": "no"}
    held = pandas.read_csv(out / "deck_cargo_fastening.csv")
    assert held["fastening"].tolist() == ["box 1", "box 2", "box 3"]
    assert main(["answers", str(path), "--out", str(out)]) == 0
    assert capsys.readouterr().out.startswith("SIMULATED ABOVE THE CODE: dynamic factor.")


def test_neither_a_stop_nor_an_answer_that_is_refused_loses_the_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path, out = lift_in(tmp_path, ('deck = "load"', 'after_s = 20\ndeck = "load"')), tmp_path / "out"

    def stopped(scene: Scene, t_end: float, **how: Any) -> Any:
        return replace(simulate(scene, 0.5 * t_end, **how), interrupted=True)

    with monkeypatch.context() as patched:
        patched.setattr("seacrane.lift.answers_run.simulate", stopped)
        assert main(["answers", str(path), "--out", str(out)]) == 130
    assert "the same command goes on" in capsys.readouterr().err
    assert Result.load(out / RUN).time[-1] == 5.0
    assert main(["answers", str(path), "--out", str(out)]) == 1
    assert "[deck_cargo]: deck_cargo: after is 20.0 s, past the last output" in capsys.readouterr().err
    run_answers(lift_in(tmp_path), tmp_path / "whole")
    here, whole = (pandas.read_csv(one / "fatigue.csv", index_col=0) for one in (out, tmp_path / "whole"))
    pandas.testing.assert_frame_equal(here, whole, rtol=1e-6)
    assert "SIMULATED ABOVE" in (out / "answers.html").read_text()
    run_answers(lift_in(tmp_path, ("t_end_s = 10", "t_end_s = 5")), out)  # another run replaces it
    assert Result.load(out / RUN).time[-1] == 5.0


def test_the_tables_of_the_page_stand_beside_the_lift_that_it_names(tmp_path: Path) -> None:
    top = Path(__file__).parents[2]
    page, lift = (top / "docs/answers.md").read_text(), (top / "examples/lifts/answers.toml").read_text()
    tables = page[page.index("## Answers of a lift file") :].split("```")[1].removeprefix("toml")
    (tmp_path / "lift.toml").write_text(lift[: lift.index("[fatigue]")] + tables, encoding="utf-8")
    found = Lift.load(tmp_path / "lift.toml")
    assert [one.call.make.__name__ for one in found.answers] == [*ANSWERS]
    for one in found.answers:
        one.require(found.scene())


AGAIN = '{ channels = ["line_tension[wire]"], constant = 1, slope = 3 }'
SEA = "[vessel]\ndatabase = 'hull_115'\nmotion = 'raos'\n[sea]\ntp_s = 6\ndirection_deg = 0\n"
SIMULATED = '"slack_margin[wire].max"'


@pytest.mark.filterwarnings("ignore::seacrane.warnings.NotFiniteWarning")
@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("scale_kN = 1000", "scale_m = 1", r"scale_m is unknown|scale_m in .* is in m, and scale"),
        ("scale_kN = 1000", "scale_m3 = 1", "scale of line_tension.wire. is in N or m2 or 1; give scale_N"),
        ('"line_tension[wire]"', '"own[lead]"', "scale_kN is given, and the scale of own.lead. is in 1"),
        ("curves = [", f"curves = [{AGAIN}, ", "there twice"),
        ('["line_tension[wire]"]', '["line_tension[wier]"]', "no line 'wier'; did you mean 'wire'"),
        (SIMULATED, '"slack_margin[wire]"', "a curve; give a number of it"),
        (SIMULATED, '"line_tension[wire].max"', "line_tension is in N, and 'dynamic factor' in 1"),
        (SIMULATED, '"slack_margin[rope].max"', "no weighed 'rope'"),
        (SIMULATED, '"own[lead].max"', "own is in m, and 'dynamic factor' in 1"),
        (SIMULATED, '"slack_margin[wire].std"', "a maximum of the run, and not its standard_dev"),
        ('"slack_margin[wire].min"', SIMULATED, "'half under' is a minimum of the run, .*; give .min"),
        ("[run]", f"{SEA}hs_m = 3\n[run]", "hs is 2 m, and the run beside it is in a sea of 3 m"),
        ("[run]", f"{SEA}hs_m = 2\n[run]", "simplified.*hs is 1 m, and the run beside it is in a sea of 2 m"),
        ('{ "dynamic factor"', '{ "psi"', "no row 'psi'"),
        ('"box.x - 0 m"', '"0 m / (box.x / 1 m)"', "own is no number at some outputs"),
        ('deck = "fixed"', 'deck = "quay"', "nearest|known are"),
        ("stiffness_N_per_m = 5e5", "falls = 2", "give stiffness_N_per_m"),
        ("volume_m3 = 4,", "volume_m3 = 40,", "'half under': the load floats"),
        ('{ name = "under"', '{ name = "half under"', "'half under' is there twice"),
        ("[-1, 0, -1]]", "[1, 0, -1]]", "let it move"),
        ('point = "box"', 'point = "bow"', "no point 'bow'"),
        ("[deck_cargo]", '[re_hit_probability]\ncontact = "feet"\nmargin_m = 1\nseeds = 0\n[deck_cargo]',
         "seeds.*from 1"),
        ("[deck_cargo]", '[re_hit_probability]\ncontact = "feet"\nmargin_m = 1\nseeds = 9\n[deck_cargo]',
         "no contact 'feet'|contact_least_gap"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named_with_its_line(old: str, new: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=rf"my_lift.toml line \d+.*({message})"):
        run_answers(lift_in(tmp_path, (old, new)), tmp_path / "out")


def test_a_table_is_empty_or_missing(tmp_path: Path) -> None:
    cut = BOUNCING[BOUNCING.index("[fatigue]") :]
    with pytest.raises(SceneError, match="asks for no answer; add one of fatigue"):
        run_answers(lift_in(tmp_path, (cut, "")), tmp_path / "out")
    for word in ("curves", "cargo", "draughts"):
        (name,) = (name for name, one in ANSWERS.items() if word in one.rows)
        given = (
            {"mass_kg": 1, "hs_m": 1, "tz_s": 1, "lowering_speed_m_per_s": 1} if word == "draughts" else {}
        )
        with pytest.raises(FileFormatError, match=f"{word} is empty"):
            Lift({name: given | {word: []}})


@pytest.mark.parametrize("name", ANSWERS)
def test_an_answer_is_a_public_call_and_every_keyword_a_key(name: str) -> None:
    call = ANSWERS[name]
    assert call.make is getattr(seacrane.answers, name)
    words = set(inspect.signature(call.keep or call.make).parameters) - {"result"}
    assert words <= {key.name for key in call.keys}


@pytest.mark.filterwarnings("ignore::seacrane.warnings.SeacraneWarning")
def test_runs_over_seeds_that_all_fail_say_why(tmp_path: Path) -> None:
    text = (
        HEAD
        + """
[vessel]; database = "hull_115"; memory = "none"
[sea]; hs_m = 1; tp_s = 8; count = 6
[crane]; base = "ground"; foot_m = [0, 0, 20]; held = true
[hoist]; mass_t = 50; size_m = [6, 4, 4]; on = "ground"; height_m = 0; feet = {}; EA_N = 6e7
[run]; t_end_s = 0.1
[re_hit_probability]; contact = "load on ground"; margin_m = 0.1; seeds = 1; hs_m = [0]
""".replace("; ", "\n")
    )
    (tmp_path / "my_lift.toml").write_text(text, encoding="utf-8")
    with pytest.raises(FileFormatError, match=r"\[re_hit_probability\]: every run has failed: .*hs"):
        run_answers(tmp_path / "my_lift.toml", tmp_path / "out")


def test_a_stiffness_that_is_left_out_is_that_of_the_hook_off_its_deck(tmp_path: Path) -> None:
    """n^2 EA / l of four falls, not what the deck adds while the load stands on it."""
    text = (
        HEAD
        + """
[crane]; base = "ground"; foot_m = [0, 0, 20]; held = true
[hoist]; mass_t = 50; size_m = [6, 4, 4]; on = "ground"; height_m = 0; feet = {}; falls = 4; EA_N = 6e7
[code_factors]; hs_m = 2; mass_t = 50; falls = 4
""".replace("; ", "\n")
    )
    (tmp_path / "my_lift.toml").write_text(text, encoding="utf-8")
    scene = Lift.load(tmp_path / "my_lift.toml").scene()
    stiffness = 4.0 * 6e7 / (scene.place_of("tip")[2] - 4.0)
    row = run_answers(tmp_path / "my_lift.toml", tmp_path)["Code factors"]["dynamic factor"]  # type: ignore[index]
    slipped = tmp_path / "slipped.toml"
    slipped.write_text(text.replace("hs_m = 2\nmass_t", "hs_m = 2\nmass_kg"), encoding="utf-8")
    with pytest.warns(MassUnitWarning, match="mass is 50 kg, and the hook of the lift carries 5e.04 kg"):
        run_answers(slipped, tmp_path)
    by_hand = code_factors(hs=2.0, mass=5e4, stiffness=stiffness, falls=4)["dynamic factor"]
    assert row.value == pytest.approx(by_hand.value, rel=0.01)
    assert np.isnan(row.simulated)
