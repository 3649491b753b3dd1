"""Includes of the core go one way: a folder includes only those below it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from import_graph import arrows_between_rooms, circles

CORE = Path(__file__).parents[2] / "cpp" / "seacrane"
INCLUDE = re.compile(r'^\s*#\s*include\s+"seacrane/(\w+)/', re.MULTILINE)

# What each folder may include beside itself; docs/design.md prints the same table.
BELOW: dict[str, set[str]] = {
    "math": set(),
    "integrate": {"math"},
    "sea": {"math"},
    "strip": {"math", "sea"},
    "elements": {"math", "sea"},
    "hydro": {"math", "sea", "elements"},
    "model": {"math", "elements", "sea", "hydro"},
    "dynamics": {"math", "elements", "sea", "hydro", "model", "integrate"},
    "compile": {"math", "elements", "sea", "hydro", "model", "integrate", "dynamics"},
    "lanes": {"math", "elements", "sea", "hydro", "model", "integrate", "dynamics"},
    "run": {"math", "elements", "sea", "hydro", "model", "integrate", "dynamics", "compile", "lanes"},
}


def test_every_folder_of_the_core_has_its_place() -> None:
    assert {path.name for path in CORE.iterdir() if path.is_dir()} == set(BELOW)


def test_no_folder_stands_above_itself() -> None:
    order = list(BELOW)
    for folder, below in BELOW.items():
        assert all(order.index(other) < order.index(folder) for other in below), folder


@pytest.mark.parametrize("folder", BELOW)
def test_a_folder_includes_only_what_lies_below_it(folder: str) -> None:
    allowed = BELOW[folder] | {folder}
    upward = [
        f"{path.relative_to(CORE)} includes {other}"
        for path in sorted((CORE / folder).rglob("*.[ch]pp"))
        for other in INCLUDE.findall(path.read_text(encoding="utf-8"))
        if other not in allowed
    ]
    assert not upward


def test_no_two_folders_include_each_other_in_a_circle() -> None:
    assert circles(arrows_between_rooms(CORE)) == []
