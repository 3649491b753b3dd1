"""Comparisons with measured sets: as published to a fifth, each with source and picture on the page."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "measurements.md").read_text(encoding="utf-8")
SETS = sorted(path.stem for path in (ROOT / "benchmarks" / "measured").glob("[a-z]*.py"))
pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")


@pytest.fixture
def measurements(modules: Any) -> Any:
    return modules("measurements")


# Those that take more than two seconds.
LONG = ("bergdahl_chain", "moordyn_chain", "kvlcc2_roll_decay", "ntnu_lewis_section")
BY_NIGHT = pytest.mark.slow("a chain of many segments, or many runs")


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=BY_NIGHT if name in LONG else []) for name in SETS]
)
def test_a_set_is_within_a_fifth_of_what_is_published(name: str, measurements: Any) -> None:
    folder = measurements.data_of(name)
    if folder is None:
        pytest.skip(f"measured set absent: {name}; set SEACRANE_SHARED to the folder with measured/{name}")
    rows = list(measurements.module_of(name).rows(folder))
    told = {key[1:] for key in measurements.published() if key[0] == name}
    assert {(row.compared, row.by) for row in rows} == told
    for row in rows:
        assert abs(row.largest) <= measurements.bound_of(name, row), (row.compared, row.by, row.largest)


def test_the_runner_finds_every_set_and_the_page_shows_it(measurements: Any) -> None:
    assert list(measurements.SETS) == SETS
    assert sorted({name for name, *_ in measurements.published()}) == SETS
    for name in SETS:
        source = measurements.module_of(name).SOURCE
        assert re.fullmatch(r"[0-9a-f]{40}", source.commit) and source.commit in PAGE
        assert source.repository in PAGE


def test_a_difference_beyond_its_bound_ends_the_call(measurements: Any, modules: Any) -> None:
    """Differences are signed, and over what the row says."""
    row = modules("measured_row").MeasuredRow
    (name, compared, by), told = next(iter(measurements.published().items()))
    common: dict[str, Any] = {
        "picture": "p", "panel": "p", "compared": compared, "by": by, "x": "x, s", "y": "y", "at": [1.0, 2.0],
        "points": ([1.0, 2.0], [2.0, -4.0]), "line": ([1.0], [2.0]), "measured": [2.0, -4.0],
    }  # fmt: skip
    near, far = (row(**common, of="value", ours=[2.0 * (1.0 + share * told), -4.0]) for share in (1.1, 1.3))
    assert measurements.checked(name, near) is near
    with pytest.raises(SystemExit, match=re.escape(compared)):
        measurements.checked(name, far)
    assert row(**common, of="value", ours=[2.2, -5.0]).differences == pytest.approx([0.1, -0.25])
    of_range = row(**common, of="range", ours=[2.2, -5.0])
    assert of_range.largest == pytest.approx(-1.0 / 6.0) and of_range.where == 2.0
