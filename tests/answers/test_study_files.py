"""The [study] of lift files: read with line numbers, run, killed, resumed, refused and shown."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from seacrane import FileFormatError, Kept, Lift, Method, SceneError, ensemble
from seacrane.cli.command_line import main
from seacrane.ensembles import Ensemble
from seacrane.lift.shown_study import shown_study
from seacrane.lift.study_run import MEMBERS, run_study

LIFT = """format = "seacrane lift"; version = 2

[vessel]
database = "hull_115"; memory = "none"

[sea]
seed = 7; hs_m = 1.5; tp_s = 8; count = 20
""".replace("; ", "\n")
STUDY = """format = "seacrane lift"; version = 2

[study]
lift = "ship.toml"

[study.over]
seed = { first = 1, count = 40 }; hs = [1, 2.0]

[[study.keep]]
name = "heave"; channel = "position"; what = "maximum"; names = { body = "vessel", axis = "z" }
after_s = 2

[[study.keep]]
name = "deepest"; channel = "position"; what = "minimum"; names = { body = "vessel", axis = "z" }
after_s = 2

[study.until]
heave.mpm = 0.25

[run]
t_end_s = 8

[method]
rtol = 1e-2
""".replace("; ", "\n")


@pytest.fixture
def study(tmp_path: Path) -> Path:
    (tmp_path / "ship.toml").write_text(LIFT)
    (tmp_path / "heave.toml").write_text(STUDY)
    return tmp_path / "heave.toml"


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the study, run once."""
    folder = tmp_path_factory.mktemp("ran")
    (folder / "ship.toml").write_text(LIFT)
    (folder / "heave.toml").write_text(STUDY)
    run_study(folder / "heave.toml", folder / "out")
    return folder / "out"


def command(study: Path, out: str | Path = "out", *options: str) -> list[str]:
    return ["study", str(study), "--out", str(study.parent / out), *options]


def test_it_is_the_ensemble_of_the_same_words(ran: Path) -> None:
    """And its tables hold what the members say."""
    there = Ensemble.load(ran / MEMBERS)
    place: dict[str, Any] = {"channel": "position", "names": {"body": "vessel", "axis": "z"}, "after": 2.0}
    lift = Lift.load(ran.parent / "ship.toml")
    same = ensemble(
        lift.scene(), over={"seed": range(1, 41), "hs": [1, 2.0]},
        keep={"heave": Kept(what="maximum", **place), "deepest": Kept(what="minimum", **place)},
        until={"heave.mpm": 0.25}, t_end=8.0, rtol=1e-2,
    )  # fmt: skip
    assert there.dataset.identical(same.dataset)
    shown = shown_study(ran)
    assert shown.certainty == same.certainty
    heave, deepest = shown.tables
    for cell in heave.cells:
        values = there.dataset.heave.sel(cell.parameters).dropna("seed").to_numpy()
        assert cell.values.tolist() == values.tolist()
        value, low, high = cell.numbers("mpm")
        assert low < value < high < values.max() + 1.0
    value, low, high = deepest.cells[0].numbers("p90")
    assert low < value < high and value < deepest.cells[0].mean


def test_show_prints_tables_and_draws(ran: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["show", str(ran), "--out", str(tmp_path)]) == 0
    assert "0 failed" in capsys.readouterr().out
    assert {"heave.csv", "heave-over-hs.png"} < {path.name for path in tmp_path.iterdir()}
    _, first, *_ = (tmp_path / "heave.csv").read_text().splitlines()
    assert float(first.split(",")[2]) == pytest.approx(shown_study(ran).tables[0].cells[0].mean)


def test_a_design_and_one_cell_are_drawn(study: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = STUDY.replace("hs = [1, 2.0]\n", "").replace("heave.mpm = 0.25", "heave.mpm = 0.9")
    text = text.replace("[study]\n", "[study]\nexposure_s = 60\n")
    study.write_text(text)
    assert main(command(study, "one")) == 0
    assert "heave-gumbel.png" in capsys.readouterr().out
    over = text[text.index("[study.over]") : text.index("[[study.keep]]")]
    design = "[study.design]\ncount = 6\nranges = { hs = [1, 2], bodies.vessel.mass = [1e7, 1.1e7] }\n\n"
    study.write_text(text.replace(over, design).replace("[study.until]\nheave.mpm = 0.9\n", ""))
    assert main(command(study, "design")) == 0
    assert "heave-over-bodies.vessel.mass.png" in capsys.readouterr().out


def started(study: Path, packs: int, *options: str) -> subprocess.Popen[bytes]:
    """The study in a process of its own that has written so many packs."""
    child = subprocess.Popen(
        [sys.executable, "-m", "seacrane", *command(study, "out", *options)],
        stderr=subprocess.PIPE, stdout=subprocess.PIPE,
    )  # fmt: skip
    until = time.monotonic() + 60.0
    while len(list((study.parent / "out" / MEMBERS).glob("pack_*.nc"))) < packs and time.monotonic() < until:
        time.sleep(0.01)
    return child


@pytest.mark.parametrize(
    "workers", [[], pytest.param(["--workers", "2"], marks=pytest.mark.slow("several processes"))]
)
def test_ctrl_c_keeps_what_came_back_and_the_same_command_goes_on(
    workers: list[str], study: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    study.write_text(STUDY.replace("count = 40", "count = 20000").replace("0.25", "0.004"))
    out = study.parent / "out"
    child = started(study, 3, *workers)
    child.send_signal(signal.SIGINT)
    _, told = child.communicate(timeout=60)
    assert child.returncode == 130 and b"interrupted" in told, told
    kept = {path: path.stat().st_mtime_ns for path in (out / MEMBERS).glob("pack_*.nc")}
    assert len(kept) >= 3
    assert main(["show", str(out)]) == 0
    assert "members run, 0 failed" in capsys.readouterr().out
    study.write_text(STUDY)
    assert main(command(study)) == 0
    assert all(path.stat().st_mtime_ns == at for path, at in kept.items())


def test_a_killed_study_goes_on_to_the_same(study: Path, ran: Path) -> None:
    child = started(study, 2)
    child.kill()
    child.communicate()
    run_study(study, study.parent / "out")
    again = Ensemble.load(study.parent / "out" / MEMBERS).dataset
    assert again.identical(Ensemble.load(ran / MEMBERS).dataset)


def test_the_folder_of_another_study(study: Path, ran: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = (ran / "study.toml").read_bytes()
    study.write_text(STUDY.replace("t_end_s = 8", "t_end_s = 9"))
    assert main(command(study, ran)) == 1
    assert "t_end" in capsys.readouterr().err
    assert (ran / "study.toml").read_bytes() == before
    (other := study.parent / "other").mkdir()
    (other / "letter.txt").touch()
    for place, words in ((other, "something else"), (study, "is a file")):
        with pytest.raises(SceneError, match=words):
            run_study(study, place)


def test_a_lift_inside_the_file(study: Path, ran: Path) -> None:
    """And the folder of a study holds such a file."""
    study.write_text(STUDY.replace('lift = "ship.toml"\n', "") + LIFT.split("version = 2\n")[1])
    assert Lift.load(study) == Lift.load(ran / "study.toml")
    for file in (study, ran / "study.toml"):
        again = run_study(file, ran)
        assert again.dataset.identical(Ensemble.load(ran / MEMBERS).dataset)


BAD = [
    ('"ship.toml"', '"sheep.toml"', "heave.toml line 5: lift is .*sheep"),
    ('"ship.toml"', '"heave.toml"', "line 5: lift is heave.toml, a study"),
    ("[study.over]", "[study.ovr]", "line 7: ovr .*nearest: over"),
    ("hs =", "hss =", "line 9: .*'hss'; nearest: 'hs'"), ("hs = [1, 2.0]", "hs = 3", "line 9: hs .* list"),
    ("hs = [1, 2.0]", "hs = [1, 1]", "line 7: .*over: hs has 1 twice"),
    ("[1, 2.0]", "{ first = 1, last = 2, count = 1000000000 }", "40000000000 members"),
    ("count = 40", "count = 10", "line 25: .*until: seed"),
    ("count = 40", "count = 0", "line 8: count .* 0;"),
    ("first = 1,", "first = 1.5,", "line 8: first is 1.5"),
    ('what = "maximum"', 'what = "biggest"', "line 14: what .*'biggest'"),
    ('name = "deepest"', 'name = "heave"', "line 18: .*'heave'"),
    ('name = "deepest"', 'name = "member"', "keep: .*'member'"),
    ("heave.mpm = 0.25", "heave.p95 = 0.25", "line 26: .*until: heave.p95"),
    ("heave.mpm = 0.25", "heeve.mpm = 0.25", "line 26: .*until: .*'heeve'"),
    ("t_end_s", "t_end", "line 29: t_end .*nearest: t_end_s"),
    ("t_end_s = 8", "accuracy.rol = 1e-3", "line 31: .*rtol=0.01 is given too"),
    ("[study.over]", "[study.design]\ncount = 3\nranges.hs = [1, 2]\n[study.over]", "line 4: .*either"),
    (STUDY[STUDY.index("[study.over]") : STUDY.index("[[study.keep]]")], "", "line 4: .*either"),
    (STUDY[STUDY.index("[study]") : STUDY.index("[run]")], "", "has no .study"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "message"), BAD)
def test_bad_input_is_named_with_its_line(old: str, new: str, message: str, study: Path) -> None:
    assert old in STUDY
    study.write_text(STUDY.replace(old, new, 1))
    with pytest.raises((FileFormatError, SceneError), match=message):
        run_study(study, study.parent / "out")
    assert not (study.parent / "out").exists()


def test_tables_of_the_study_stand_before_those_of_its_lift(study: Path) -> None:
    """A mistake in the lift is told by its own line; an accuracy chooses what the lift says of the method."""
    ship = study.parent / "ship.toml"
    ship.write_text(LIFT + '[run]\nstart = "rest"\nt_end_s = 99\n[method]\nintegrator = "rk4"\ndt_s = 0.1\n')
    lift = Lift.load(study)
    assert (lift.start, lift.t_end, lift.method) == ("rest", 8.0, Method(rtol=1e-2))
    study.write_text(STUDY.replace("[method]\nrtol = 1e-2", "accuracy.rol = 1e-3"))
    assert Lift.load(study).method == Method()
    with pytest.raises(FileFormatError, match=r"^heave\.toml line 31: .*'rol'"):
        Lift.load(study).scene()
    ship.write_text(LIFT.replace("hs_m", "hs"))
    with pytest.raises(FileFormatError, match=r"^ship\.toml line 10: hs "):
        Lift.load(study)
    ship.write_text(LIFT.replace("count = 20", "count = 0"))
    with pytest.raises(FileFormatError, match=r"^ship\.toml line 12: .*count"):
        Lift.load(study).scene()
