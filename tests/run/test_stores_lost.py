"""Stores of which something is lost, damaged, foreign or left by killed processes: told and made good."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ensemble_studies import KEEP, SWING, lowest, pendulum
from killed_stores import KINDS, STORMS
from test_study_files import LIFT, STUDY

from seacrane import FileFormatError, SceneError, ensemble
from seacrane.ensembles import Ensemble
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.drafts import draft_of
from seacrane.lift.study_run import run_study
from seacrane.warnings import LostMembersWarning

GIVEN: dict[str, Any] = {
    "source": pendulum,
    "over": {"start": [1.0, 2.0, 3.0]},
    "keep": {"lowest": lowest, "track": KEEP["track"]},
    **SWING,
}


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


def torn(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-3])


def piped(path: Path) -> None:
    path.unlink()
    os.mkfifo(path)


def brackets(path: Path) -> None:
    path.write_bytes(b"[" * 100_000)


PACK = "pack_0000001.nc"
LOST: dict[str, tuple[str, Callable[[Path], None], str]] = {
    "a torn pack": (PACK, torn, r"members 1 to 1 .*pack_0000001\.nc: is no pack"),
    "a pack of nothing": (PACK, lambda path: path.write_bytes(b""), "is no pack"),
    "a pack of other members": (
        PACK, lambda path: path.write_bytes(path.with_name("pack_0000002.nc").read_bytes()),
        "holds other members",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("place", "harm", "told"), LOST.values(), ids=[*LOST])
def test_what_is_lost_is_told_and_run_again(
    store: Path, place: str, harm: Callable[[Path], None], told: str, whole: Ensemble
) -> None:
    harm(store / place)
    with contextlib.suppress(FileFormatError):
        lowest = Ensemble.load(store).dataset.lowest.to_numpy()
        assert np.isnan(lowest).tolist() == [False, True, False]
    with pytest.warns(LostMembersWarning, match=told):
        again = ensemble(**GIVEN, store=store)
    assert again.dataset.identical(whole.dataset)
    assert again.failures == {}
    assert Ensemble.load(store).dataset.identical(whole.dataset)


@pytest.mark.parametrize("harm", [torn, piped, brackets])
def test_a_damaged_pack_is_refused_by_name(store: Path, harm: Callable[[Path], None]) -> None:
    """A pipe in its place, which to open would take for ever."""
    harm(store / PACK)
    with pytest.raises(FileFormatError, match=r"pack_0000001\.nc: is no pack"):
        Ensemble.load(store)


STUDIES = {
    "brackets": b"[" * 100_000,
    "pairs of brackets": b"[" + b"[]," * 2_000_000 + b"[]]",
    "no text": b"\xff\xfe",
    "a list": b"[]",
    "another format": b'{"format": "x"}',
    "no parameters": b'{"format": "seacrane-ensemble"}',
    "parameters that are none": b'{"format": "seacrane-ensemble", "grid": true, "axes": {"a": 3}}',
    "values that are none": b'{"format": "seacrane-ensemble", "grid": true, "axes": {"a": [[1]]}}',
    "unlike lists": b'{"format": "seacrane-ensemble", "axes": {"a": [1], "b": [1, 2]}}',
    "a reserved name": b'{"format": "seacrane-ensemble", "axes": {"failure": [1]}}',
    "few seeds": b'{"format": "seacrane-ensemble", "axes": {"seed": [1]}, "seeds_in_pack": 2}',
    "no pack": json.dumps(
        {"format": "seacrane-ensemble", "axes": {"seed": [*range(20)]}, "seeds_in_pack": "many"}
    ).encode(),
    "too many members": json.dumps(
        {"format": "seacrane-ensemble", "grid": True, "axes": {a: [*range(2000)] for a in "abcd"}}
    ).encode(),
}


@pytest.mark.parametrize("text", STUDIES.values(), ids=[*STUDIES])
def test_a_study_that_is_none_is_refused(store: Path, text: bytes) -> None:
    (next(store.rglob("study.json"))).write_bytes(text)
    with pytest.raises(FileFormatError, match="study"):
        Ensemble.load(store)
    with pytest.raises((FileFormatError, SceneError), match="study"):
        ensemble(**GIVEN, store=store)


def test_a_study_that_is_a_pipe_is_refused(store: Path) -> None:
    piped(next(store.rglob("study.json")))
    with pytest.raises(FileFormatError, match=r"has no study\.json"):
        Ensemble.load(store)
    with pytest.raises(FileFormatError, match=r"has no study\.json"):
        ensemble(**GIVEN, store=store)


def test_a_pack_of_a_giant_number_is_refused(store: Path) -> None:
    pack = next(store.rglob("pack_0000001.*"))
    pack.rename(pack.with_name(f"pack_9999999{pack.suffix}"))
    with pytest.raises(FileFormatError, match="9999999, more than there may be members"):
        Ensemble.load(store)


def test_a_store_of_another_version_is_refused_with_both(store: Path) -> None:
    path = next(store.rglob("study.json"))
    data = json.loads(path.read_text())
    for version, told in (("0.3", "is of file version '0.3'"), (None, "names no version of files")):
        path.write_text(json.dumps(data | {"version": version}))
        for call in (lambda: Ensemble.load(store), lambda: ensemble(**GIVEN, store=store)):
            with pytest.raises(FileFormatError, match=rf"study\.json: {told}, and .* version '0\.4'; make"):
                call()


def test_a_store_that_was_killed_as_it_was_made_goes_on(tmp_path: Path, whole: Ensemble) -> None:
    store = tmp_path / "a"
    store.mkdir()
    left = draft_of(store / "study.json")
    left.write_text('{"ver')
    assert ensemble(**GIVEN, store=store).dataset.identical(whole.dataset)
    assert not left.exists()


def test_a_study_that_was_killed_as_it_was_made_goes_on(tmp_path: Path) -> None:
    (tmp_path / "ship.toml").write_text(LIFT)
    (tmp_path / "study.toml").write_text(
        STUDY.partition("[until]")[0].replace("40", "1") + "[run]\nt_end_s = 3\n"
    )
    left = draft_of(tmp_path / "out" / "study.toml")
    left.parent.mkdir()
    left.write_text("format")
    assert len(run_study(tmp_path / "study.toml", tmp_path / "out").members) == 2
    assert (tmp_path / "out" / "study.toml").exists()


def test_drafts_are_removed_once_their_process_is_gone(tmp_path: Path) -> None:
    script = "import os, sys; from seacrane.inputs.drafts import draft_of; from pathlib import Path\n"
    script += "draft_of(Path(sys.argv[1])).write_text('half'); os._exit(9)"
    target = tmp_path / "run.nc"
    for _ in range(2):
        subprocess.run([sys.executable, "-c", script, str(target)], check=False)
    mine = draft_of(target)
    mine.write_text("half")
    others = [
        tmp_path / name for name in (".run.nc.9d166c1e.tmp", ".run.nc.tmp", "run.nc.tmp", ".other.nc.tmp")
    ]
    elsewhere = tmp_path / ".run.nc.000000-7fffffff-9d166c1e.tmp"  # of another machine
    for path in (*others, elsewhere):
        path.write_text("half")
    assert len(list(tmp_path.iterdir())) == 8
    with atomic_write(target) as draft:
        draft.write_text("whole")
    assert {*tmp_path.iterdir()} == {target, mine, *others, elsewhere}


def attempts(count: int, *kinds: str) -> None:
    done = subprocess.run(
        [sys.executable, "killed_stores.py", *kinds, "--attempts", str(count)],
        cwd=Path(__file__).parents[1] / "scenes", capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr[-3000:]}"


@pytest.mark.slow("many kills")
@pytest.mark.parametrize("kind", KINDS)
def test_a_kill_at_any_file_operation_is_made_good(kind: str) -> None:
    attempts(6, kind)


@pytest.mark.slow("hundreds of kills")
@pytest.mark.parametrize("kind", KINDS)
def test_kills_at_hundreds_of_file_operations_are_made_good(kind: str) -> None:
    attempts(150, kind)


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


def test_a_name_of_a_zarr_group_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"a\.zarr.*is a folder of NetCDF files; .*to_zarr"):
        ensemble(**GIVEN, store=tmp_path / "a.zarr")
