"""Parts of a study: run in any order, killed and gone on with, they are one run to the bit; or refused."""

from __future__ import annotations

import contextlib
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ensemble_studies import HEAVE_STUDY

from seacrane import SceneError, ensemble
from seacrane.cases import vessel
from seacrane.cli.command_line import main
from seacrane.ensembles import Ensemble, merge_parts
from seacrane.ensembles.parts import part_of
from seacrane.lift.study_run import MEMBERS
from seacrane.run.lanes import INSTRUCTIONS, module_of
from seacrane.warnings import FewSeedsWarning

SHEET = """format = "seacrane lift"
version = 2
[vessel]
database = "hull_115"
memory = "none"
[crane]
slew_deg = -90
s1_m = 1
s2_m = 2
[hoist]
mass_kg = 50e3
size_m = [6, 4, 4]
length_m = 20
EA_N = 2e8
winch = { maximum_rate_m_per_s = 1 }
[sea]
hs_m = 1
tp_s = 8
direction_deg = 180
count = 20
[[stage]]
name = "hang"
duration_s = 4
[[stage]]
name = "up"
duration_s = 4
commands = [{ name = "hoist.rate", value_m_per_s = -0.3 }]
[sheet]
tp_s = [8, 11]
direction_deg = [90, 180]
hs_m = [1, 3]
seeds = 25
until = 0.25
[[sheet.phase]]
name = "up"
hours = 0.5
passage = true
[[sheet.criterion]]
channel = "hook_load"
maximum_N = 570e3
[run]
start = "rest"
[method]
rtol = 1e-2
"""
KILLED = """
import os, signal, sys
from seacrane.cli.command_line import main
from seacrane.ensembles.store import Folder
write = Folder.__setitem__
def killed(self, pack, outcomes):
    if len(list(self)):
        os.kill(os.getpid(), signal.SIGKILL)
    write(self, pack, outcomes)
Folder.__setitem__ = killed
main(sys.argv[1:])
"""
LANES = [1, *(lanes for lanes in INSTRUCTIONS if module_of(lanes) is not None)]


def same_bits(one: Ensemble, other: Ensemble) -> bool:
    arrays = [
        np.array_equal(one.dataset[name].to_numpy().view("u8"), other.dataset[name].to_numpy().view("u8"))
        for name in one.dataset
        if one.dataset[name].dtype == float
    ]
    return bool(arrays) and all(arrays) and one.dataset.identical(other.dataset)


GROWING = HEAVE_STUDY.replace("first = 1, count = 20", "first = 1, count = 100").replace(
    '"z" } }]', '"z" }, what = "maximum" }]\nuntil = { heave.mpm = 0.9 }'
)


@pytest.mark.parametrize(
    ("command", "text"),
    [
        ("study", HEAVE_STUDY),
        pytest.param("study", GROWING, marks=pytest.mark.slow("many packs")),
        ("sheet", SHEET),
    ],
    ids=["study", "until", "sheet"],
)
def test_parts_in_any_order_one_of_them_killed_are_one_run(
    command: str, text: str, tmp_path: Path, capsys: Any
) -> None:
    (file := tmp_path / "lift.toml").write_text(text)
    assert main([command, str(file), "--out", str(tmp_path / "whole")]) == 0
    given = [[command, str(file), "--part", f"{n}/3", "--out", str(tmp_path / f"p{n}")] for n in (3, 1, 2)]
    folders = [words[-1] for words in given]
    for words in given[:2]:
        assert main(words) == 0
    child = subprocess.run([sys.executable, "-c", KILLED, *given[2]], capture_output=True, check=False)
    assert child.returncode == -signal.SIGKILL
    merge = ["merge", *folders, "--out", str(tmp_path / "merged")]
    assert main(merge) == 1
    assert "part 2/3" in (told := capsys.readouterr().err) and "is not complete" in told
    assert main(given[2]) == 0
    assert main(merge) == 0
    inside = MEMBERS if command == "study" else "runs/lift/passages"
    whole, merged = (Ensemble.load(tmp_path / name / inside) for name in ("whole", "merged"))
    assert same_bits(whole, merged) and not merged.failures
    run = [
        one.dataset.failure.to_numpy() == ""
        for one in (merged, *(Ensemble.load(Path(one) / inside) for one in folders))
    ]
    assert sum(map(np.sum, run[1:])) == run[0].sum() and all(map(np.any, run))
    if command == "sheet":
        assert 0 < run[0].sum() < run[0].size, "cells stopped at different seeds"
        for name in ("sheet.csv", "sheet.html"):
            assert (tmp_path / "whole" / name).read_bytes() == (tmp_path / "merged" / name).read_bytes()
    files = {one: one.stat().st_mtime_ns for one in (tmp_path / "merged" / inside).glob("pack_*.nc")}
    assert main([command, str(file), "--out", str(tmp_path / "merged")]) == 0  # with nothing left
    assert files == {one: one.stat().st_mtime_ns for one in (tmp_path / "merged" / inside).glob("pack_*.nc")}


@pytest.fixture(scope="module")
def study() -> dict[str, Any]:
    return {
        "source": vessel(memory="none", hs=1.0), "over": {"hs": [1.0, 2.0], "seed": range(1, 10)},
        "keep": {"heave": "position[vessel, z].max"}, "t_end": 2.0,
    }  # fmt: skip


@pytest.mark.parametrize("lanes", LANES)
def test_the_same_members_are_side_by_side(lanes: int, study: dict[str, Any], tmp_path: Path) -> None:
    """18 members: the last group of lanes is not full, nor is the last pack."""
    whole = ensemble(**study, lanes=lanes, pack=lanes)
    for number in (2, 1):
        ensemble(**study, lanes=lanes, pack=lanes, part=(number, 2), store=tmp_path / f"{number}")
    assert same_bits(whole, merge_parts([tmp_path / "1", tmp_path / "2"], tmp_path / "merged"))


@pytest.fixture(scope="module")
def parts(study: dict[str, Any], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("parts")
    for number, of in ((1, 3), (2, 3), (3, 3), (2, 2)):
        ensemble(**study, lanes=1, pack=2, part=f"{number}/{of}", store=folder / f"{number} of {of}")
    ensemble(**study | {"t_end": 1.0}, lanes=1, pack=2, part=(3, 3), store=folder / "shorter")
    ensemble(**study, lanes=1, pack=2, store=folder / "whole")
    other = shutil.copytree(folder / "3 of 3", folder / "elsewhere") / "study.json"
    other.write_text(other.read_text().replace(", core ", ", core of another build "))
    shutil.copytree(folder / "3 of 3", folder / "hole")
    next((folder / "hole").glob("pack_*.nc")).unlink()
    torn = next(shutil.copytree(folder / "3 of 3", folder / "torn").glob("pack_*.nc"))
    torn.write_bytes(torn.read_bytes()[:100])
    return folder


@pytest.mark.parametrize(
    ("third", "message"),
    [
        ("", "1 of 3 parts are missing: 3/3"),
        ("2 of 3", "part 2/3 is there twice"),
        ("2 of 2", "is part 2/2; parts overlap"),
        ("shorter", "another study .*: t_end differ"),
        ("elsewhere", "another engine .*core of another build"),
        ("hole", "part 3/3 .* is not complete, 1 of its 3 packs"),
        ("torn", "is no pack of an ensemble, or damaged"),
        ("whole", "is no part of an ensemble"),
        ("nothing", "is no ensemble"),
    ],
)
def test_a_merge_refuses(third: str, message: str, parts: Path, tmp_path: Path) -> None:
    given = [parts / name for name in ("1 of 3", "2 of 3", third) if name]
    with pytest.raises(Exception, match=message):
        merge_parts(given, tmp_path / "merged")
    assert not (tmp_path / "merged").exists()


def test_another_part_has_a_folder_of_its_own(parts: Path, study: dict[str, Any]) -> None:
    for part in (None, (2, 3)):
        with pytest.raises(SceneError, match=r"part differ|part, engine differ"):
            ensemble(**study, lanes=1, pack=2, part=part, store=parts / "1 of 3")


@pytest.mark.parametrize("given", [(0, 3), (4, 3), "3", "3/4/5", "-1/3", (1, 2, 3), (1.0, 3), 3, (True, 3)])
def test_a_part_that_there_is_not(given: Any) -> None:
    with pytest.raises(SceneError, match=r"part is .*; give one"):
        part_of(given)


def test_a_study_that_cannot_be_parted(study: dict[str, Any]) -> None:
    with pytest.raises(SceneError, match=r"9 packs of members.* at most 9 parts"):
        ensemble(**study, lanes=1, pack=2, part=(1, 10))
    growing = study | {"over": {"seed": range(1, 41)}, "until": {"heave.mpm": 0.1}}
    with pytest.raises(SceneError, match=r"1 cells.* at most 1 parts"):
        ensemble(**growing, part=(1, 2))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"known": {', '"gone": {', "part 2/2 .* is not complete, not all of its cells"),
        ('"heave.mpm": 0.99', '"heave.mpm": 0.5', "grown until .*0.5.* and .*0.99"),
        ('"packs": 1', '"packs": 2', "holds other members than part 2/2"),
    ],
)
def test_a_merge_of_what_grew_refuses(old: str, new: str, message: str, grown: Path, tmp_path: Path) -> None:
    other = shutil.copytree(grown / "2", tmp_path / "2") / "study.json"
    text = other.read_text()
    assert old in text
    other.write_text(text.replace(old, new))
    with pytest.raises(Exception, match=message):
        merge_parts([grown / "1", other.parent], tmp_path / "merged")
    assert not (tmp_path / "merged").exists()


@pytest.fixture(scope="module")
def grown(study: dict[str, Any], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("grown")
    growing = study | {"over": {"seed": range(1, 21), "hs": [1.0, 2.0]}, "until": {"heave.mpm": 0.99}}
    for number in (1, 2):
        with contextlib.suppress(FewSeedsWarning):
            ensemble(**growing, pack=20, part=(number, 2), store=folder / f"{number}")
    return folder
