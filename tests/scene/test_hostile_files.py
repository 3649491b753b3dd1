"""Files that promise more than they hold are refused before memory is taken: counts, bombs, nesting."""

from __future__ import annotations

import json
import os
import tracemalloc
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import h5py
import netCDF4
import numpy as np
import pytest
from fuzz.limits import bounded
from fuzz.netcdf_spec import build
from fuzz.targets import CORPUS, TARGETS
from test_fuzz import placed

from seacrane import Lift, Result, Scene
from seacrane.crane import load_crane
from seacrane.errors import FileFormatError
from seacrane.hydro import (
    HydroDatabase,
    read_capytaine,
    read_offset_table,
    read_orcaflex,
    read_veres,
)

LITTLE = 64 * 2**20  # bytes: what refusing a small file may take
DEEP = 100_000


def refused(action: Callable[[], Any], match: str) -> None:
    """Refused by name, and with little memory."""
    tracemalloc.start()
    try:
        with pytest.raises(FileFormatError, match=match):
            action()
        assert tracemalloc.get_traced_memory()[1] < LITTLE
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("kind", ["re7", "re8", "re1"])
def test_veres_counts(kind: str, tmp_path: Path) -> None:
    path = tmp_path / placed(f"veres-{kind}", tmp_path).file
    text = (CORPUS / "veres" / path.name).read_text()
    assert "1 2 2 6" in text
    for counts in ("1 1 1000000000 6", "1 1000000000 1 6", "1000000000 1 1 6", "1 1 1e300 6"):
        path.write_text(text.replace("1 2 2 6", counts))
        refused(lambda: read_veres(path), "more lines follow from the counts")


READ: dict[str, tuple[str, str, Callable[[Path], Any]]] = {
    "database": ("plain", "omega", HydroDatabase.load),
    "capytaine": ("ship", "omega", read_capytaine),
    "mafredo": ("ship", "omega", partial(read_orcaflex, mass_matrix=np.eye(6), restoring=np.eye(6))),
    "result": ("run", "time", Result.load),
}


@pytest.mark.parametrize("kind", READ)
def test_giant_arrays(kind: str, tmp_path: Path) -> None:
    """8 GiB of zeros in some kilobytes are refused by their declared size, whatever their name; so is the
    dimension that all arrays share, declared 1e9 long and left unwritten."""
    seed, name, read = READ[kind]
    content, path = (CORPUS / kind / seed).read_bytes(), tmp_path / TARGETS[kind].file
    assert build(content, path)
    with netCDF4.Dataset(path, "a") as file:
        group = file.createGroup("attic") if name in file.variables else file
        group.createDimension("many", 2**30)
        group.createVariable("zeros", "f8", ("many",), zlib=True, chunksizes=(2**20,))[:8] = 0.0
    assert path.stat().st_size < 2**20
    told = r"shape \(1073741824,\); with it the file's arrays take .* MiB, above"
    refused(lambda: read(path), told)

    spec = json.loads(content)
    group = spec if kind != "mafredo" else spec["groups"]["mass"]
    group["dims"][name] = 10**9
    for variable in group["vars"].values():
        if name in variable["dims"]:
            variable |= {"data": None, "zlib": True}
    assert build(json.dumps(spec).encode(), path)
    refused(lambda: read(path), "MiB, above")


DAMAGED = {  # as bytes, and what is told
    "large": "with it the file's arrays take 16384 MiB", "many-dimensions": "run.nc is not",
    "damaged-heap": "damaged heap at byte", "endless-heap": "damaged heap at byte",
    "endless-heap-2": "damaged heap at byte",
}  # fmt: skip


@pytest.mark.parametrize("name", DAMAGED)
def test_damaged_results(name: str, tmp_path: Path) -> None:
    (tmp_path / "run.nc").write_bytes((CORPUS / "result-bytes" / name).read_bytes())
    refused(lambda: Result.load(tmp_path / "run.nc"), DAMAGED[name])


def test_a_truncated_result(tmp_path: Path) -> None:
    path = tmp_path / "run.nc"
    assert build((CORPUS / "result" / "run").read_bytes(), path)
    content = path.read_bytes()
    for kept in (0, 100, len(content) // 2, len(content) - 1):
        path.write_bytes(content[:kept])
        refused(lambda: Result.load(path), "run.nc")


def large_chunks(path: Path) -> None:
    """HDF5 unfolds a chunk as a whole."""
    with h5py.File(path, "a") as file:
        made = {"maxshape": (None,), "chunks": (2**28,), "compression": "gzip"}
        for i in range(3):
            file.create_dataset(f"zeros {i}", (1,), "f8", **made)


def a_sparse_file(path: Path) -> None:
    """One of 100 GB that takes no room on the disk, which is not looked through."""
    os.truncate(path, 100 * 2**30)


def linked(link: Callable[[h5py.File], Any]) -> Callable[[Path], Any]:
    """A group that leads back to one above: netCDF-C would descend for ever."""

    def change(path: Path) -> None:
        with h5py.File(path, "a") as file:
            attic = file.create_group("attic")
            attic["back"] = link(file)

    return change


CHANGED: dict[Callable[[Path], Any], str] = {
    linked(lambda file: file["attic"]): "group attic stands in more than one place",
    linked(lambda file: file["/"]): "group / stands in more than one place",
    linked(lambda file: h5py.SoftLink("/")): "group attic has a link back",
    linked(lambda file: h5py.ExternalLink("run.nc", "/")): "group attic has a link back",
    large_chunks: "with it the file's arrays take .* above",
    a_sparse_file: "has 102400 MiB",
}


@pytest.mark.parametrize("change", CHANGED)
def test_results_that_promise_more_than_they_hold(change: Callable[[Path], Any], tmp_path: Path) -> None:
    assert build((CORPUS / "result" / "run").read_bytes(), tmp_path / "run.nc")
    change(tmp_path / "run.nc")
    refused(lambda: Result.load(tmp_path / "run.nc"), CHANGED[change])


def test_limits_of_results(tmp_path: Path) -> None:
    path = tmp_path / "run.nc"
    assert build((CORPUS / "result" / "run").read_bytes(), path)
    assert len(Result.load(path).time) == 3
    refused(lambda: Result.load(path, largest=1000), "raise it with Result.load")


@pytest.mark.parametrize(
    ("name", "text", "read"),
    [
        ("scene.json", "[" * DEEP, Scene.load), ("scene.json", '{"notes":' * DEEP, Scene.load),
        ("crane.toml", "a = " + "[" * DEEP, load_crane), ("crane.toml", "a = " + "{a = " * DEEP, load_crane),
        ("lift.toml", "a = " + "[" * DEEP, Lift.load), ("lift.toml", "a = " + "{a = " * DEEP, Lift.load),
        ("lift.toml", "a" + ".a" * DEEP + " = 1", Lift.load),
        ("lift.toml", "[" + "a . " * DEEP + "a]", Lift.load),
        ("ship.yml", "[" * DEEP, read_orcaflex), ("ship.yml", "- " * DEEP, read_orcaflex),
        ("ship.yml", "a: &a [x]\nb: &b [*a, *a, *a]\nc: [*b, *b, *b]\n", read_orcaflex),
        ("ship.yml", "!!python/object/apply:os.system ['true']\n", read_orcaflex),
    ],
)  # fmt: skip
def test_nesting_and_tags(name: str, text: str, read: Callable[[Path], Any], tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    refused(lambda: read(tmp_path / name), name)


def test_offsets_whose_squares_overflow(tmp_path: Path) -> None:
    (tmp_path / "hull.txt").write_text("-10,1,1\n-10,0,-1\n1e200,1,1\n")
    refused(lambda: read_offset_table(tmp_path / "hull.txt"), r"1e\+09")


SET_FILES = ["veres-re7", "veres-re8", "veres-re1", "veres-re2", "veres-hyd", "wamit-1", "wamit-3", "wamit-4",
             "wamit-hst", "wamit-out", "wamit-frc", "wamit-cfg"]  # fmt: skip


@pytest.mark.parametrize("name", [*SET_FILES, "stl", "offsets", "orcaflex", "scene", "crane", "lift"])
def test_files_larger_than_their_kind(name: str, tmp_path: Path) -> None:
    """A sparse file of 64 GiB is refused before any of it is read; so is /dev/zero, which has no end."""
    target = placed(name, tmp_path)
    path = tmp_path / target.file
    with path.open("wb") as file:
        file.truncate(2**36)
    refused(lambda: target.read(path), r"is larger than \d+ bytes")
    if name in ("scene", "crane", "lift", "stl", "veres-re7", "wamit-1"):  # the first that is read
        path.unlink()
        path.symlink_to("/dev/zero")
        with pytest.raises((FileFormatError, OSError)):
            target.read(path)


def scene_text(**changes: Any) -> str:
    return json.dumps(json.loads((CORPUS / "scene" / "every-kind").read_bytes()) | changes)


@pytest.mark.parametrize("entry", ["{}", '{"":0}', "0", '"\u0100"'])
def test_memory_of_a_scene_file(entry: str, tmp_path: Path) -> None:
    """Entries of the notes, however small, are read within the bound, or refused before they are parsed."""
    many = ",".join([entry] * 100_000)
    text = scene_text(notes={"x": []}).replace('"x": []', f'"x": [{many}]')
    (tmp_path / "scene.json").write_text(text, encoding="utf-8")
    with bounded(len(text.encode())):
        try:
            assert len(Scene.load(tmp_path / "scene.json").notes["x"]) == 100_000
        except FileFormatError as error:
            assert "would take" in str(error)
            assert entry != "0"
