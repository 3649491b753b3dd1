"""Files that promise more than they hold: giant counts, bombs, nesting; refused before memory is taken."""

from __future__ import annotations

import dataclasses
import json
import os
import random
import struct
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import netCDF4
import numpy as np
import pytest
from fuzz.grow import grown
from fuzz.limits import bounded
from fuzz.netcdf_spec import build
from fuzz.targets import CORPUS, TARGETS, Target, cases, quiet

from seacrane import Lift, Scene
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
from seacrane.hydro.readers.veres_files import read_drift
from seacrane.inputs import hdf5_structure
from seacrane.result import Result

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


@pytest.fixture(params=READ)
def sound(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Path, Callable[[Path], Any]]:
    """A sound NetCDF file of each kind, and its reader."""
    path = tmp_path / TARGETS[request.param].file
    assert build(SEED[request.param].read_bytes(), path)
    return path, READ[request.param][1]


Sound = tuple[Path, Callable[[Path], Any]]


@pytest.mark.parametrize("target", ["/", "inner"])
def test_groups_that_hold_themselves(target: str, sound: Sound) -> None:
    """The NetCDF library would follow them until all memory is taken."""
    path, read = sound
    with h5py.File(path, "a") as file:
        file.create_group("inner")
        file["inner/again"] = file[target]
    refused(lambda: read(path), "inner/again is in the file more than once")


def test_a_file_that_only_holds_itself(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "run.nc", "w", libver="latest") as file:
        file["a"] = file["/"]
    assert (tmp_path / "run.nc").stat().st_size < 400
    refused(lambda: Result.load(tmp_path / "run.nc"), "'?a'? is in the file more than once")


@pytest.mark.parametrize(
    "link", [h5py.SoftLink("/"), h5py.SoftLink("/nowhere"), h5py.ExternalLink("secret.nc", "/")]
)
def test_links_that_lead_elsewhere(link: Any, sound: Sound) -> None:
    path, read = sound
    with h5py.File(path, "a") as file:
        file["elsewhere"] = link
    refused(lambda: read(path), "elsewhere is a link to another place or file")


@pytest.mark.parametrize("storage", ["external", "virtual"])
def test_arrays_stored_in_another_file(storage: str, sound: Sound, tmp_path: Path) -> None:
    """Else a result could carry away what its reader may read."""
    path, read = sound
    (tmp_path / "secret").write_bytes(bytes(24))
    with h5py.File(path, "a") as file:
        if storage == "external":
            file.create_dataset("stolen", (3,), "f8", external=[(str(tmp_path / "secret"), 0, 24)])
        else:
            layout = h5py.VirtualLayout((3,), "f8")
            layout[:] = h5py.VirtualSource(str(tmp_path / "secret"), "a", (3,))
            file.create_virtual_dataset("stolen", layout)
    refused(lambda: read(path), "stolen is stored in another file")


REPEATED = 5000  # times 100 kB


@pytest.mark.parametrize("chunks", [None, (REPEATED,)])
def test_one_text_repeated(chunks: tuple[int, ...] | None, tmp_path: Path) -> None:
    """Texts of 100 kB that are one and the same in a file of some 200 kB, 500 MB in memory."""
    path = tmp_path / "run.nc"
    assert build(SEED["result"].read_bytes(), path)
    with h5py.File(path, "a") as file:
        texts = file.create_dataset("texts", (REPEATED,), h5py.string_dtype(), chunks=chunks)
        texts[0] = "x" * 100_000
    repeat_reference(path)
    assert path.stat().st_size < 500_000
    refused(lambda: Result.load(path), "texts brings its texts and attributes above 128 MiB")


def repeat_reference(path: Path) -> None:
    """The first of the texts' references in the place of all that were stored with it."""
    with h5py.File(path, "r") as file:
        data = file["texts"].id
        offset = data.get_offset() if file["texts"].chunks is None else data.get_chunk_info(0).byte_offset
    content = bytearray(path.read_bytes())
    content[offset : offset + 16 * REPEATED] = content[offset : offset + 16] * REPEATED
    path.write_bytes(content)


def test_texts_repeated_in_attributes(tmp_path: Path) -> None:
    path = tmp_path / "run.nc"
    assert build(SEED["result"].read_bytes(), path)
    with h5py.File(path, "a") as file:
        for i in range(300):
            file.attrs.create(f"note {i}", "é" * 400_000, dtype=h5py.string_dtype())
    assert path.stat().st_size > 128 * 2**20  # really there, and refused all the same
    with pytest.raises(FileFormatError, match="brings its texts and attributes above 128 MiB"):
        Result.load(path)


@pytest.mark.parametrize("size", [0, 2**63, 2**64 - 8])
def test_heaps_that_HDF5_reads_without_end(size: int, sound: Sound) -> None:
    path, read = sound
    content = bytearray(path.read_bytes())
    heap = content.index(hdf5_structure.HEAP)
    content[heap + 16 : heap + 32] = struct.pack("<HHIQ", 0, 0, 0, size)
    path.write_bytes(content)
    refused(lambda: read(path), "has a damaged heap at byte")


def test_heaps_within_heaps(sound: Sound) -> None:
    """Each looked through again would take time by the square of the file."""
    path, read = sound
    with path.open("ab") as file:
        file.write((hdf5_structure.HEAP + struct.pack("<Q", 2**19)) * 2**16)
    refused(lambda: read(path), "heaps")


def test_values_of_variable_length(sound: Sound) -> None:
    path, read = sound
    with h5py.File(path, "a") as file:
        file.create_dataset("ragged", (3,), h5py.vlen_dtype(np.float64))
    refused(lambda: read(path), "ragged has values of variable length that are no texts")


def test_filters_upon_filters(sound: Sound) -> None:
    """Each unfolds a thousandfold."""
    path, read = sound
    made = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    made.set_chunk((100,))
    made.set_deflate(1)
    made.set_deflate(1)
    with h5py.File(path, "a") as file:
        h5py.h5d.create(file.id, b"folded", h5py.h5t.IEEE_F64LE, h5py.h5s.create_simple((100,)), made)
    refused(lambda: read(path), "folded is packed by more than deflate")


def test_chunks_larger_than_their_array(sound: Sound) -> None:
    """HDF5 unfolds a chunk as a whole."""
    path, read = sound
    with h5py.File(path, "a") as file:
        made = {"maxshape": (None,), "chunks": (2**28,), "compression": "gzip"}
        for i in range(3):
            file.create_dataset(f"zeros {i}", (1,), "f8", **made)
    refused(lambda: read(path), "with it the file's arrays take .* above")


def test_more_entries_than_any_database_has(monkeypatch: pytest.MonkeyPatch, sound: Sound) -> None:
    path, read = sound
    monkeypatch.setattr(hdf5_structure, "MOST_ENTRIES", 10)
    refused(lambda: read(path), "holds more than 10 groups, arrays and attributes")


def test_a_sparse_file_is_not_read_through(tmp_path: Path) -> None:
    """All that a file holds is looked at once: one of 100 GB that takes no room on the disk took minutes."""
    assert build(SEED["result"].read_bytes(), tmp_path / "run.nc")
    os.truncate(tmp_path / "run.nc", 100 * 2**30)
    refused(lambda: Result.load(tmp_path / "run.nc"), "has 102400 MiB")


def test_larger_results_can_be_asked_for(tmp_path: Path) -> None:
    assert build(SEED["result"].read_bytes(), tmp_path / "run.nc")
    assert len(Result.load(tmp_path / "run.nc").time) == 3
    refused(lambda: Result.load(tmp_path / "run.nc", largest=1000), "raise it with Result.load")


DEEP = 100_000


@pytest.mark.parametrize(
    ("name", "text", "read"),
    [
        ("scene.json", "[" * DEEP, Scene.load),
        ("scene.json", '{"notes":' * DEEP, Scene.load),
        ("crane.toml", "a = " + "[" * DEEP, load_crane),
        ("crane.toml", "a = " + "{a = " * DEEP, load_crane),
        ("lift.toml", "a = " + "[" * DEEP, Lift.load),
        ("lift.toml", "a = " + "{a = " * DEEP, Lift.load),
        ("lift.toml", "a" + ".a" * DEEP + " = 1", Lift.load),
        ("lift.toml", "[" + "a . " * DEEP + "a]", Lift.load),
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


SET_FILES = ["veres-re7", "veres-re8", "veres-re1", "veres-re2", "veres-hyd", "wamit-1", "wamit-3", "wamit-4",
             "wamit-hst", "wamit-out", "wamit-frc", "wamit-cfg"]  # fmt: skip


@pytest.mark.parametrize("name", [*SET_FILES, "stl", "offsets", "orcaflex", "scene", "crane", "lift"])
def test_files_larger_than_their_kind(name: str, tmp_path: Path) -> None:
    """A sparse file of 64 GiB is refused before any of it is read."""
    if name == "orcaflex":
        pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")
    target = TARGETS[name]
    target.place(tmp_path)
    with (tmp_path / target.file).open("wb") as file:
        file.truncate(2**36)
    refused(lambda: target.read(tmp_path / target.file), r"is larger than \d+ bytes")


@pytest.mark.parametrize("name", ["scene", "crane", "lift", "stl", "veres-re7", "wamit-1"])
def test_devices(name: str, tmp_path: Path) -> None:
    """/dev/zero has no end."""
    target = TARGETS[name]
    target.place(tmp_path)
    (tmp_path / target.file).symlink_to("/dev/zero")
    with pytest.raises((FileFormatError, OSError)):
        target.read(tmp_path / target.file)


def scene_text(**changes: Any) -> str:
    """The seed of scenes with other entries."""
    return json.dumps(json.loads((CORPUS / "scene" / "every-kind").read_bytes()) | changes)


def test_keys_that_occur_twice_among_many(tmp_path: Path) -> None:
    """60,000 keys, of which the last two are one: looked for once, not once for each."""
    keys = ",".join(f'"k{i}":0' for i in [*range(60_000), 59_999])
    (tmp_path / "scene.json").write_text(scene_text(notes={}).replace('"notes": {}', f'"notes": {{{keys}}}'))
    with bounded((tmp_path / "scene.json").stat().st_size):
        refused(lambda: Scene.load(tmp_path / "scene.json"), "key 'k59999' occurs twice")


@pytest.mark.parametrize("entry", ["[]", "{}", "[0]", '{"":0}', "0", '"\u0100"', '"ab"'])
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


def test_memory_of_a_table_in_a_scene_file(tmp_path: Path) -> None:
    tables = json.loads(scene_text())["force_tables"]
    tables[0]["times"], tables[0]["wrenches"] = list(range(30_000)), [[0] * 6] * 30_000
    text = scene_text(force_tables=tables)
    (tmp_path / "scene.json").write_text(text)
    with bounded(len(text)):
        Scene.load(tmp_path / "scene.json")


LARGE = 100_000  # bytes


@pytest.mark.parametrize("name", [name for name, target in TARGETS.items() if not target.unfolds])
def test_cost_of_files_made_large(name: str, tmp_path: Path) -> None:
    """One line, word or run of blanks repeated: no more time and memory per byte than the limits."""
    target = TARGETS[name]
    if target.reader == "orcaflex":
        pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")
    target.place(tmp_path)
    generator = random.Random(name)
    pool = [path.read_bytes() for path in cases(target)]
    with quiet():
        for _ in range(6):
            target.run(grown(generator.choice(pool), LARGE, generator), tmp_path)


def test_many_speeds(tmp_path: Path) -> None:
    """Each is compared with its neighbour, not with all."""
    target = TARGETS["veres-re2"]
    target.place(tmp_path)
    head = (CORPUS / "veres" / "box.re2").read_text().splitlines()[:8]
    count = 20_000
    rows = [line for i in range(count) for line in (f"{i}.0 0.0", "0.5 0.0 0.0 0.0")]
    text = "\n".join([*head, f"{count} 1 1", *rows, ""])
    (tmp_path / "box.re2").write_text(text)
    with bounded(len(text)):
        assert len(read_drift(tmp_path / "box.re2").cases) == count


def test_a_number_of_many_digits_in_a_hydrostatics_file(tmp_path: Path) -> None:
    """Its pattern tried every way to part the digits."""
    target = TARGETS["veres-hyd"]
    target.place(tmp_path)
    text = (CORPUS / "veres" / "box.hyd").read_text().replace("60.000", "6" * 200_000 + "x")
    assert target.run(text.encode(), tmp_path) == "refused"


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
