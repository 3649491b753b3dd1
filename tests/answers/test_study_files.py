"""Study files: read with line numbers, run, killed, resumed, refused and shown."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import FileFormatError, Kept, Lift, SceneError, ensemble
from seacrane.cli.command_line import main
from seacrane.ensembles import Ensemble
from seacrane.lift.schema import schema_path
from seacrane.lift.shown_study import shown_study
from seacrane.lift.study_file import StudyFile
from seacrane.lift.study_run import MEMBERS, run_study
from seacrane.lift.study_schema import study_schema, study_schema_text

LIFT = """format = "seacrane lift"; version = 2

[vessel]
database = "hull_115"; memory = "none"

[sea]
seed = 7; hs_m = 1.5; tp_s = 8; count = 20
""".replace("; ", "\n")
STUDY = """format = "seacrane study"; version = 2; lift = "ship.toml"

[over]
seed = { first = 1, count = 40 }; hs = [1, 2.0]

[[keep]]
name = "heave"; channel = "position"; what = "maximum"; names = { body = "vessel", axis = "z" }
after_s = 2

[[keep]]
name = "deepest"; channel = "position"; what = "minimum"; names = { body = "vessel", axis = "z" }
after_s = 2

[until]
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
    text += "[statistics]\nexposure_s = 60\n"
    study.write_text(text)
    assert main(command(study, "one")) == 0
    assert "heave-gumbel.png" in capsys.readouterr().out
    over = text[text.index("[over]") : text.index("[[keep]]")]
    design = "[design]\ncount = 6\nranges = { hs = [1, 2], bodies.vessel.mass = [1e7, 1.1e7] }\n\n"
    study.write_text(text.replace(over, design).replace("[until]\nheave.mpm = 0.9\n", ""))
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
    tables = (
        LIFT.split("version = 2\n")[1].replace("[vessel]", "[lift.vessel]").replace("[sea]", "[lift.sea]")
    )
    study.write_text(STUDY.replace('lift = "ship.toml"\n', "") + tables)
    again = run_study(study, ran)
    assert again.dataset.identical(Ensemble.load(ran / MEMBERS).dataset)


BAD = [
    ("version = 2", "version = 3", "heave.toml line 2: version is 3"), ('lift = "ship.toml"', "", "lift"),
    ("[over]", "[ovr]", "line 5: ovr .*nearest: over"), ("hs =", "hss =", "line 7: .*'hss'; nearest: 'hs'"),
    ("hs = [1, 2.0]", "hs = [1, 1]", "line 5: over: hs has 1 twice"),
    ("[1, 2.0]", "{ first = 1, last = 2, count = 1000000000 }", "40000000000 members"),
    ("count = 40", "count = 10", "line 23: until: seed"),
    ('what = "maximum"', 'what = "biggest"', "line 12: what .*'biggest'"),
    ('name = "deepest"', 'name = "heave"', "line 17: .*'heave'"),
    ('name = "deepest"', 'name = "member"', "keep: .*'member'"),
    ("heave.mpm = 0.25", "heave.p95 = 0.25", "line 24: until: heave.p95"),
    ("heave.mpm = 0.25", "heeve.mpm = 0.25", "line 24: until: .*'heeve'"),
    ("t_end_s", "t_end", "line 27: t_end .*nearest: t_end_s"),
    ("[over]", "[design]\ncount = 3\n[over]", "either"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "message"), BAD)
def test_bad_input_is_named_with_its_line(old: str, new: str, message: str, study: Path) -> None:
    assert old in STUDY
    study.write_text(STUDY.replace(old, new, 1))
    with pytest.raises((FileFormatError, SceneError), match=message):
        run_study(study, study.parent / "out")
    assert not (study.parent / "out").exists()


def test_members_and_bounds_are_read_without_the_lift(study: Path) -> None:
    (study.parent / "ship.toml").write_text(LIFT.replace("hs_m", "hs"))
    with pytest.raises(FileFormatError, match=r"ship\.toml line 10: hs "):
        run_study(study, study.parent / "out")
    read = StudyFile.load(study)
    assert (len(read.members), read.until) == (80, {"heave.mpm": 0.25})
    assert np.array_equal(list(read.over["seed"]), np.arange(1, 41))


def test_the_schema_is_current_and_knows_the_study() -> None:
    assert schema_path("study").read_text(encoding="utf-8") == study_schema_text()
    jsonschema = pytest.importorskip("jsonschema", reason="needs the package 'jsonschema'")
    jsonschema.Draft7Validator.check_schema(study_schema())
    check = jsonschema.Draft7Validator(json.loads(study_schema_text()))
    assert not list(check.iter_errors(tomllib.loads(STUDY)))
    for old, new in (("[over]", "[ovr]"), ("after_s", "after"), ("0.25", "2")):
        assert list(check.iter_errors(tomllib.loads(STUDY.replace(old, new, 1)))), old
