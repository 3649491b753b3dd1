"""Files that promise more than they hold: giant counts, bombs, nesting; refused before memory is taken."""

from __future__ import annotations

import dataclasses
import json
import struct
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from fuzz.netcdf_spec import build
from fuzz.targets import CORPUS, TARGETS, Target

from seacrane.crane.data_file import load as load_crane
from seacrane.errors import FileFormatError
from seacrane.hydro import (
    HydroDatabase,
    read_capytaine,
    read_offset_table,
    read_orcaflex,
    read_stl,
    read_veres,
)
from seacrane.result import Result
from seacrane.scene_file import load_scene

LITTLE = 64 * 2**20  # bytes: what refusing a small file may take


def refused(action: Callable[[], Any], match: str) -> None:
    """Refused by name, and with little memory."""
    tracemalloc.start()
    try:
        with pytest.raises(FileFormatError, match=match):
            action()
        assert tracemalloc.get_traced_memory()[1] < LITTLE
    finally:
        tracemalloc.stop()


def place(target: Target, folder: Path) -> Path:
    """The sound set of files; gives the path of the one that the target is about."""
    target.place(folder)
    path = folder / target.file
    path.write_bytes((CORPUS / target.name.split("-")[0] / target.file).read_bytes())
    return path


@pytest.mark.parametrize(
    "counts", ["1 1 1000000000 6", "1 1000000000 1 6", "1000000000 1 1 6", "1 1 1e300 6"]
)
@pytest.mark.parametrize("kind", ["re7", "re8", "re1"])
def test_veres_counts(kind: str, counts: str, tmp_path: Path) -> None:
    path = place(TARGETS[f"veres-{kind}"], tmp_path)
    text = path.read_text()
    assert "1 2 2 6" in text
    path.write_text(text.replace("1 2 2 6", counts))
    refused(lambda: read_veres(path), "more lines follow from the counts")


def test_stl_count(tmp_path: Path) -> None:
    path = tmp_path / "hull.stl"
    path.write_bytes(b"box".ljust(80) + struct.pack("<I", 2**32 - 1) + bytes(500))
    refused(lambda: read_stl(path), "announces 4294967295 triangles")


READ: dict[str, tuple[str, Callable[[Path], Any]]] = {
    "database": ("omega", HydroDatabase.load),
    "capytaine": ("omega", read_capytaine),
    "mafredo": ("omega", lambda path: read_orcaflex(path, mass_matrix=np.eye(6), restoring=np.eye(6))),
    "result": ("time", Result.load),
}


SEED = {
    kind: CORPUS / kind / name
    for kind, name in (("database", "plain"), ("capytaine", "ship"), ("mafredo", "ship"), ("result", "run"))
}


def bomb(path: Path, name: str) -> None:
    """8 GiB of zeros along that dimension in a file of some kilobytes."""
    with netCDF4.Dataset(path, "a") as file:
        group = file.createGroup("attic") if name in file.variables else file
        group.createDimension("many", 2**30)
        group.createVariable("zeros", "f8", ("many",), zlib=True, chunksizes=(2**20,))[:8] = 0.0


@pytest.mark.parametrize("kind", READ)
def test_decompression_bomb(kind: str, tmp_path: Path) -> None:
    """A compressed array of 8 GiB is refused by its declared size, whatever it is called."""
    target = TARGETS[kind]
    path = tmp_path / target.file
    assert build(SEED[kind].read_bytes(), path)
    bomb(path, READ[kind][0])
    assert path.stat().st_size < 2**20
    refused(
        lambda: READ[kind][1](path),
        r"shape \(1073741824,\); with it the file's arrays take 8192.* MiB, above",
    )


@pytest.mark.parametrize("kind", READ)
def test_giant_dimension(kind: str, tmp_path: Path) -> None:
    """The dimension that all arrays share, declared 1e9 long and left unwritten."""
    target = TARGETS[kind]
    spec = json.loads(SEED[kind].read_bytes())
    group = spec if kind != "mafredo" else spec["groups"]["mass"]
    group["dims"][READ[kind][0]] = 10**9
    for variable in group["vars"].values():
        if READ[kind][0] in variable["dims"]:
            variable["data"] = None
            variable["zlib"] = True
    assert build(json.dumps(spec).encode(), tmp_path / target.file)
    refused(lambda: READ[kind][1](tmp_path / target.file), "MiB, above")


def test_larger_results_can_be_asked_for(tmp_path: Path) -> None:
    assert build(SEED["result"].read_bytes(), tmp_path / "run.nc")
    assert len(Result.load(tmp_path / "run.nc").time) == 3
    refused(lambda: Result.load(tmp_path / "run.nc", largest=1000), "raise it with Result.load")


DEEP = 100_000


@pytest.mark.parametrize(
    ("name", "text", "read"),
    [
        ("scene.json", "[" * DEEP, load_scene),
        ("scene.json", '{"notes":' * DEEP, load_scene),
        ("crane.toml", "a = " + "[" * DEEP, load_crane),
        ("crane.toml", "a = " + "{a = " * DEEP, load_crane),
        ("ship.yml", "[" * DEEP, read_orcaflex),
        ("ship.yml", "- " * DEEP, read_orcaflex),
        ("ship.yml", "a: &a [x]\nb: &b [*a, *a, *a]\nc: [*b, *b, *b]\n", read_orcaflex),
        ("ship.yml", "!!python/object/apply:os.system ['true']\n", read_orcaflex),
    ],
)
def test_nesting_and_tags(name: str, text: str, read: Callable[[Path], Any], tmp_path: Path) -> None:
    """Brackets without end, aliases that multiply, and tags that would build objects."""
    (tmp_path / name).write_text(text)
    refused(lambda: read(tmp_path / name), name)


def test_deep_groups(tmp_path: Path) -> None:
    with netCDF4.Dataset(tmp_path / "hull.nc", "w") as file:
        file.format = "seacrane hydrodynamic database"
        file.format_version = 1
        file.createGroup("/".join(["g"] * 30))
    refused(lambda: HydroDatabase.load(tmp_path / "hull.nc"), "groups are nested more than 8 deep")


@pytest.mark.parametrize(
    ("line", "text", "message"),
    [
        ("total_mass", "1" + "0" * 5000, "not valid TOML"),
        ("total_mass", "0x" + "f" * 5000, "write a finite number"),
        ("total_mass", "1e300", "write a finite number"),
        ("total_mass", "5e-324", "at least"),
        ("name", '"' + "x" * 5000 + '"', "1 to 200 characters"),
    ],
)
def test_crane_values(line: str, text: str, message: str, tmp_path: Path) -> None:
    """Whole numbers of thousands of digits; messages stay short."""
    lines = (CORPUS / "crane" / "shipped").read_text().splitlines()
    changed = [f"{line} = {text}" if old.startswith(f"{line} ") else old for old in lines]
    assert changed != lines
    (tmp_path / "crane.toml").write_text("\n".join(changed))
    with pytest.raises(FileFormatError, match=message) as caught:
        load_crane(tmp_path / "crane.toml")
    assert len(str(caught.value)) < 600


def test_files_too_large_to_be_what_they_claim(tmp_path: Path) -> None:
    (tmp_path / "crane.toml").write_bytes(b"#" * (2**20 + 1))
    with pytest.raises(FileFormatError, match="larger than 1048576 bytes"):
        load_crane(tmp_path / "crane.toml")


@pytest.mark.parametrize("rows", ["1e200,1,1\n", "0,1e300,0\n", "0,1,0\n1,1e10,0\n"])
def test_offsets_out_of_range(rows: str, tmp_path: Path) -> None:
    """Coordinates whose squares overflow."""
    (tmp_path / "hull.txt").write_text("-10,1,1\n-10,0,-1\n" + rows)
    refused(lambda: read_offset_table(tmp_path / "hull.txt"), "1e\\+09")


def test_memory_that_is_not_a_number(tmp_path: Path) -> None:
    from seacrane.hydro import shipped_database

    database = shipped_database()
    assert database.memory is not None
    broken = dataclasses.replace(database.memory, r2=float("nan"))
    dataclasses.replace(database, memory=broken).save(tmp_path / "hull.nc")
    refused(lambda: HydroDatabase.load(tmp_path / "hull.nc"), "r2 is not a number")
