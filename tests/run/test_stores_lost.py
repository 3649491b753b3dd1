"""Stores of which something is lost, damaged, foreign or left by killed processes: told and made good."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ensemble_studies import KEEP, SWING, lowest, pendulum
from killed_stores import KINDS, STORMS

from seacrane import FileFormatError, SceneError, ensemble
from seacrane.ensembles import Ensemble
from seacrane.inputs.atomic import atomic_write, draft_of
from seacrane.warnings import LostMembersWarning

GIVEN = {"source": pendulum, "over": {"start": [1.0, 2.0, 3.0]}, **SWING}
GIVEN |= {"keep": {"lowest": lowest, "track": KEEP["track"]}}


@pytest.fixture(scope="module")
def whole() -> Ensemble:
    return ensemble(**GIVEN)


@pytest.fixture(scope="module")
def stores(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("stores")
    ensemble(**GIVEN, store=folder / "a")
    return folder


@pytest.fixture
def store(stores: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(stores / "a", tmp_path / "a"))


PACK = "pack_0000001.nc"


def torn(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-3])


def other(path: Path) -> None:
    path.write_bytes(path.with_name("pack_0000002.nc").read_bytes())


@pytest.mark.parametrize(
    ("harm", "told"),
    [(torn, r"members 1 to 1 .*pack_0000001\.nc: is no pack"), (other, "holds other members")],
)
def test_what_is_lost_is_told_and_run_again(store: Path, harm: Any, told: str, whole: Ensemble) -> None:
    harm(store / PACK)
    with contextlib.suppress(FileFormatError):
        lowest = Ensemble.load(store).dataset.lowest.to_numpy()
        assert np.isnan(lowest).tolist() == [False, True, False]
    with pytest.warns(LostMembersWarning, match=told):
        again = ensemble(**GIVEN, store=store)
    assert again.dataset.identical(whole.dataset)
    assert again.failures == {}
    assert Ensemble.load(store).dataset.identical(whole.dataset)
    (store / PACK).unlink()
    os.mkfifo(store / PACK)  # which to open would take for ever
    with pytest.raises(FileFormatError, match=r"pack_0000001\.nc: is no pack"):
        Ensemble.load(store)
    (store / PACK).rename(store / "pack_9999999.nc")
    with pytest.raises(FileFormatError, match="9999999"):
        Ensemble.load(store)


def test_a_study_that_is_none_is_refused(store: Path) -> None:
    study = next(store.rglob("study.json"))
    many = {"grid": True, "axes": {a: [*range(2000)] for a in "abcd"}}
    texts = [
        b"[" * 100_000, b"\xff\xfe", [], {"format": "x"}, {}, {"grid": True, "axes": {"a": [[1]]}},
        {"axes": {"a": [1], "b": [1, 2]}}, many, {"axes": {"seed": [1]}, "seeds_in_pack": 2},
    ]  # fmt: skip
    for text in texts:
        if isinstance(text, dict):
            text = {"format": "seacrane-ensemble"} | text
        study.write_bytes(text if isinstance(text, bytes) else json.dumps(text).encode())
        with pytest.raises(FileFormatError, match="study"):
            Ensemble.load(store)
        with pytest.raises((FileFormatError, SceneError), match="study"):
            ensemble(**GIVEN, store=store)


def test_a_store_of_another_version_is_refused_with_both(store: Path) -> None:
    path = next(store.rglob("study.json"))
    path.write_text(json.dumps(json.loads(path.read_text()) | {"version": "0.3"}))
    for call in (Ensemble.load, lambda store: ensemble(**GIVEN, store=store)):
        with pytest.raises(FileFormatError, match=r"is of file version '0.3', and .* version '0\.4'"):
            call(store)


def test_a_store_that_was_killed_as_it_was_made_goes_on(tmp_path: Path, whole: Ensemble) -> None:
    store = tmp_path / "a"
    store.mkdir()
    left = draft_of(store / "study.json")
    left.write_text('{"ver')
    assert ensemble(**GIVEN, store=store).dataset.identical(whole.dataset)
    assert not left.exists()


def test_drafts_are_removed_once_their_process_is_gone(tmp_path: Path) -> None:
    script = "import os, sys; from seacrane.inputs.atomic import draft_of; from pathlib import Path\n"
    script += "draft_of(Path(sys.argv[1])).write_text('half'); os._exit(9)"
    target = tmp_path / "run.nc"
    for _ in range(2):
        subprocess.run([sys.executable, "-c", script, str(target)], check=False)
    of_another_machine = ".run.nc.000000-7fffffff-9d166c1e.tmp"
    names = (".run.nc.9d166c1e.tmp", ".run.nc.tmp", "run.nc.tmp", ".other.nc.tmp", of_another_machine)
    stay = [draft_of(target), *(tmp_path / name for name in names)]
    for path in stay:
        path.write_text("half")
    assert len(list(tmp_path.iterdir())) == 8
    with atomic_write(target) as draft:
        draft.write_text("whole")
    assert {*tmp_path.iterdir()} == {target, *stay}


@pytest.mark.slow("many kills")
@pytest.mark.parametrize("kind", KINDS)
def test_kills_at_hundreds_of_file_operations_are_made_good(kind: str) -> None:
    command = [sys.executable, "killed_stores.py", kind, "150"]
    scenes = Path(__file__).parents[1] / "scenes"
    done = subprocess.run(command, cwd=scenes, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr[-3000:]}"


@pytest.mark.filterwarnings("ignore::seacrane.warnings.FewSeedsWarning")
def test_lost_members_of_a_store_that_grows_are_run_again(tmp_path: Path) -> None:
    store = tmp_path / "s"
    plain = ensemble(**STORMS)
    ensemble(**STORMS, store=store)
    torn(store / "pack_0000002.nc")
    with pytest.warns(LostMembersWarning, match="are lost or damaged, and are run again"):
        again = ensemble(**STORMS, store=store)
    assert again.dataset.identical(plain.dataset)
    assert again.certainty == plain.certainty
