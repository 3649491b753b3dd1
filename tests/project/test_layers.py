"""Rooms of the package and folders of the core lie on floors: imports go down, in no circle."""

from __future__ import annotations

import re
from collections import defaultdict
from pathlib import Path

import pytest
from import_graph import Import, arrows_between_rooms, circles, imports, modules, room

ROOT = Path(__file__).resolve().parents[2]
PACKAGE, CORE = ROOT / "python" / "seacrane", ROOT / "cpp" / "seacrane"
# Rooms from the ground up: each may import from those before it.
FLOORS = """
    errors warnings version one_thread arrays | lazy | inputs | plotting | sea.records | sea | hydro.data
    | hydro.memory | hydro.vessel | hydro.database | hydro.group | hydro.readers | hydro.hull | hydro.parts
    | hydro | description | crane | analysis | scene | result | statistics | run | accuracy | simulation
    | ensembles | operability | pictures | answers | lift | cases | cli | __main__
"""
ROOMS = {name: floor for floor, names in enumerate(FLOORS.split("|")) for name in names.split()}
HIDDEN = ("cli", "inputs.netcdf_limits")  # commands, and h5py once a file is opened: --help is quick
# Folders of the core from the ground up, and what each may not include of those before it.
FOLDERS = ("math", "integrate", "sea", "strip", "elements", "hydro", "model", "dynamics", "compile", "lanes",
           "run")  # fmt: skip
NOT_BELOW = {
    "sea": {"integrate"}, "strip": {"integrate"}, "elements": {"integrate", "strip"},
    "hydro": {"integrate", "strip"}, "model": {"integrate", "strip"}, "dynamics": {"strip"},
    "compile": {"strip"}, "lanes": {"strip", "compile"}, "run": {"strip"},
}  # fmt: skip


@pytest.fixture(scope="module")
def arrows() -> list[Import]:
    return imports(PACKAGE)


def test_every_room_has_a_floor_and_imports_go_down(arrows: list[Import]) -> None:
    files = modules(PACKAGE)
    assert {room(module, files) for module in files if module} == set(ROOMS)
    wrong = []
    for arrow in arrows:
        above, below = (room(module, files) for module in (arrow.source, arrow.target))
        if above != below and ROOMS[below] >= ROOMS[above]:
            wrong.append(f"{arrow.source} imports {arrow.target}")
    assert not wrong


def test_the_table_of_rooms_in_the_design_is_the_order_of_imports(arrows: list[Import]) -> None:
    text = (ROOT / "docs" / "design.md").read_text(encoding="utf-8")
    table = text.split("| rooms, from the top |", 1)[1].split("\n\n", 1)[0].splitlines()[2:]
    row = {name: at for at, line in enumerate(table) for name in re.findall(r"`(\w+)`", line.split("|")[1])}
    assert set(row) == {name.split(".")[0] for name in ROOMS} - {"lazy", "__main__"}
    for arrow in arrows:
        above = row.get(arrow.source.split(".")[0], 0)
        assert above <= row.get(arrow.target.split(".")[0], above), f"{arrow.source} imports {arrow.target}"


def test_no_circle_of_modules(arrows: list[Import]) -> None:
    """Imports for types alone, and those within a room, count too."""
    graph: dict[str, set[str]] = defaultdict(set)
    for arrow in arrows:
        graph[arrow.source].add(arrow.target)
    assert circles(graph) == []
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"a", "d"}, "d": set(), "e": {"d"}}) == [["a", "b", "c"]]


def test_no_import_of_the_package_is_hidden_in_a_function(arrows: list[Import]) -> None:
    hidden = {f"{arrow.source}." for arrow in arrows if arrow.hidden}
    assert [one for one in hidden if not one.startswith(tuple(f"{place}." for place in HIDDEN))] == []


def test_the_core_names_modules_that_are_there() -> None:
    texts = [path.read_text() for path in (ROOT / "cpp" / "bindings").glob("*.cpp")]
    named = {name for text in texts for name in re.findall(r'import\("seacrane\.([\w.]+)"\)', text)}
    assert named and named <= set(modules(PACKAGE))


def test_a_folder_of_the_core_includes_only_what_lies_below_it() -> None:
    found = arrows_between_rooms(CORE)
    assert {path.name for path in CORE.iterdir() if path.is_dir()} == set(FOLDERS)
    assert circles(found) == []
    for at, folder in enumerate(FOLDERS):
        rooms = [name for name in found if f"{name}/".startswith(f"{folder}/")]
        included = {one.partition("/")[0] for name in rooms for one in found[name]}
        assert included <= set(FOLDERS[: at + 1]) - NOT_BELOW.get(folder, set()), folder
