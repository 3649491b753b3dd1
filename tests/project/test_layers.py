"""The package's rooms lie on floors: imports go down, in no circle, and in plain sight."""

from __future__ import annotations

import re
from collections import defaultdict
from pathlib import Path

import pytest
from import_graph import Import, circles, imports, modules, room

# Rooms from the ground up: each may import from those on lines above its own.
FLOORS = """
    errors warnings version one_thread
    lazy
    inputs
    plotting sea
    hydro.data
    hydro.memory
    hydro.vessel
    hydro.database
    hydro.group
    hydro.readers
    hydro.hull
    hydro
    description
    series water
    validity
    crane
    analysis
    scene
    result
    statistics
    run
    accuracy
    simulation
    ensembles
    operability
    pictures
    answers
    trading
    needs
    lift
    cases
    cli
    __main__
"""
HIDDEN = {
    "cli": "a command imports what it needs, so that --help is quick",
    "inputs.netcdf_limits": "h5py is loaded once a file is opened",
}


@pytest.fixture(scope="module")
def package(repository: Path) -> Path:
    return repository / "python" / "seacrane"


@pytest.fixture(scope="module")
def arrows(package: Path) -> list[Import]:
    return imports(package)


def test_every_room_has_a_floor(package: Path) -> None:
    files = modules(package)
    rooms = {room(module, files) for module in files if module}
    assert rooms == set(FLOORS.split())


def test_imports_go_down(package: Path, arrows: list[Import]) -> None:
    files = modules(package)
    floor = {name: at for at, line in enumerate(FLOORS.strip().splitlines()) for name in line.split()}
    wrong = []
    for arrow in arrows:
        above, below = (room(module, files) for module in (arrow.source, arrow.target))
        if above != below and floor.get(below, 99) >= floor.get(above, -1):
            wrong.append(f"{arrow.source} imports {arrow.target}")
    assert not wrong


def test_the_table_of_rooms_in_the_design_is_the_order_of_imports(
    repository: Path, arrows: list[Import]
) -> None:
    text = (repository / "docs" / "design.md").read_text(encoding="utf-8")
    table = text.split("| rooms, from the top |", 1)[1].split("\n\n", 1)[0].splitlines()[2:]
    row = {name: at for at, line in enumerate(table) for name in re.findall(r"`(\w+)`", line.split("|")[1])}
    outer = {line.split(".")[0] for line in FLOORS.split()} - {"lazy", "__main__"}
    assert set(row) == outer
    up = [
        f"{arrow.source} imports {arrow.target}"
        for arrow in arrows
        if (above := row.get(arrow.source.split(".")[0], 0)) > row.get(arrow.target.split(".")[0], above)
    ]
    assert not up


def test_no_circle_of_modules(arrows: list[Import]) -> None:
    """Imports for types alone, and those within a room, count too."""
    graph: dict[str, set[str]] = defaultdict(set)
    for arrow in arrows:
        graph[arrow.source].add(arrow.target)
    assert circles(graph) == []


def test_no_import_of_the_package_is_hidden_in_a_function(arrows: list[Import]) -> None:
    hidden = [arrow for arrow in arrows if arrow.hidden]
    used = {place for arrow in hidden for place in HIDDEN if f"{arrow.source}.".startswith(f"{place}.")}
    others = [
        f"{arrow.source} imports {arrow.target}"
        for arrow in hidden
        if not any(f"{arrow.source}.".startswith(f"{place}.") for place in HIDDEN)
    ]
    assert not others
    assert used == set(HIDDEN), "an exception that nothing needs"


def test_the_core_names_modules_that_are_there(repository: Path, package: Path) -> None:
    sources = (repository / "cpp" / "bindings").glob("*.cpp")
    named = {
        name for path in sources for name in re.findall(r'import\("seacrane\.([\w.]+)"\)', path.read_text())
    }
    assert named
    assert named <= set(modules(package))


def test_circles_are_found() -> None:
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"a", "d"}, "d": set(), "e": {"d"}}) == [["a", "b", "c"]]
    assert circles({"a": {"b", "c"}, "b": {"d"}, "c": {"d"}}) == []
