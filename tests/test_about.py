"""What a result holds beside numbers and words: typed, in its files, and read from those of 0.2."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import netCDF4
import pytest

from seacrane import FileFormatError, Result, Scene, simulate
from seacrane.result.about import ABOUT, NAMES, About
from seacrane.result.partial_file import Piece


def limited() -> Scene:
    scene = Scene(name="limited")
    scene.add_body(name="load", mass=2e3, inertia=(1e3, 1e3, 1e3), position=(0, 0, -10))
    scene.add_joint(
        kind="revolute", name="pin", first="ground", second="load", point=(0, 0, 0), axis=(0, 1, 0)
    )
    scene.add_range(joint="pin", minimum=-1.0, maximum=1.0)
    scene.add_limit_state(name="swing", channel="position", names={"body": "load", "axis": "x"}, maximum=2.0)
    return scene


@pytest.fixture(scope="module")
def result() -> Result:
    return simulate(limited(), t_end=0.5)


def as_0_2_wrote_it(about: About) -> dict[str, str]:
    """Each part that is there as a text of its own."""
    told = about.to_attributes()
    rest = json.loads(told.pop(ABOUT))
    return told | {name: json.dumps(part) for name, part in rest.items()}


def with_attributes(path: Path, attributes: dict[str, str]) -> Path:
    """A result's file with these in the place of its own about."""
    with netCDF4.Dataset(path, "a") as file:
        file.delncattr(ABOUT)
        file.setncatts(attributes)
    return path


def test_what_is_structured_is_typed_and_no_part_of_the_stats(result: Result) -> None:
    assert not set(NAMES) & set(result.stats)
    assert {type(value) for value in result.stats.values()} <= {str, int, float}
    assert result.settings["t_end"] == 0.5 and result.stages == ()
    assert result.about.limit_states[0].maximum == 2.0
    assert result.about.bounds[0]["kind"] == "range"


def test_a_script_that_reads_it_from_the_stats_is_told_where_it_is(result: Result) -> None:
    with pytest.raises(KeyError, match=r"'settings' is not in stats; read result.about.settings"):
        result.stats["settings"]
    with pytest.raises(KeyError, match=r"^'no_such_stat'$"):
        result.stats["no_such_stat"]


def test_a_file_keeps_it(result: Result, tmp_path: Path) -> None:
    again = Result.load(result.save(tmp_path / "run.nc"))
    assert again.about.to_attributes() == result.about.to_attributes()
    assert again.about.limit_states == result.about.limit_states


def test_a_file_of_0_2_tells_the_same(result: Result, tmp_path: Path) -> None:
    old = with_attributes(result.save(tmp_path / "run.nc"), as_0_2_wrote_it(result.about))
    again = Result.load(old)
    assert again.about.to_attributes() == result.about.to_attributes()
    assert dict(again.stats) == dict(result.stats)
    assert again.utilisation == result.utilisation


def test_a_run_in_progress_of_0_2_tells_the_same(result: Result) -> None:
    piece = Piece(
        arrays={"time": result.time}, coords={}, stats=dict(result.stats), about=result.about
    )  # fmt: skip
    body = piece.to_bytes()
    end = body.index(b"\n")
    header: dict[str, Any] = json.loads(body[:end])
    del header["stats"][ABOUT]
    header["stats"] |= as_0_2_wrote_it(result.about)
    old = Piece.from_bytes(json.dumps(header).encode() + body[end:])
    assert old.stats == dict(result.stats)
    assert (
        old.about.to_attributes()
        == Piece.from_bytes(body).about.to_attributes()
        == result.about.to_attributes()
    )


DAMAGED = {
    "no JSON": {"bounds": "{"},
    "another kind": {"outline": "[5]"},
    "no stage": {"stages": '[{"title": "lift"}]'},
    "a limit state of numbers": {"limit_states": "[1]"},
    "an about that is none": {ABOUT: "[1]"},
    "an about without end": {ABOUT: "[" * 100_000},
}


@pytest.mark.parametrize("case", DAMAGED)
def test_notes_that_no_run_writes_are_refused_by_name(case: str, result: Result, tmp_path: Path) -> None:
    path = with_attributes(result.save(tmp_path / "run.nc"), DAMAGED[case])
    with pytest.raises(FileFormatError, match=r"run\.nc is not a seacrane result: its notes are none"):
        Result.load(path)
