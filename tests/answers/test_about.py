"""What a result holds beside numbers and words: typed, and in its files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import netCDF4
import pytest

from seacrane import FileFormatError, Result, Scene, simulate
from seacrane.result.about import NAMES
from seacrane.result.partial_file import Piece


def limited() -> Scene:
    scene = Scene(name="limited")
    scene.add_body(name="load", mass=2e3, inertia=(1e3, 1e3, 1e3), position=(0, 0, -10))
    scene.add_joint(
        kind="revolute", name="pin", first="ground", second="load", point=(0, 0, 0), axis=(0, 1, 0)
    )
    scene.add_channel(joint="pin", minimum=-1.0, maximum=1.0)
    scene.add_limit_state(name="swing", channel="position", names={"body": "load", "axis": "x"}, maximum=2.0)
    return scene


@pytest.fixture(scope="module")
def result() -> Result:
    return simulate(limited(), t_end=0.5)


def with_attributes(path: Path, attributes: dict[str, Any]) -> Path:
    """A result's file with these attributes; None: without one of that name."""
    with netCDF4.Dataset(path, "a") as file:
        for name, value in attributes.items():
            file.delncattr(name)
            if value is not None:
                file.setncattr(name, value)
    return path


def test_what_is_structured_is_typed_kept_and_no_part_of_the_stats(result: Result, tmp_path: Path) -> None:
    assert not set(NAMES) & set(result.stats)
    assert result.settings["t_end"] == 0.5 and result.stages == ()
    assert result.about.limit_states[0].maximum == 2.0
    assert result.about.bounds[0]["kind"] == "range"
    again = Result.load(result.save(tmp_path / "run.nc"))
    assert again.about.to_attributes() == result.about.to_attributes()


def test_a_file_of_another_version_is_refused_with_both(result: Result, tmp_path: Path) -> None:
    """As is a run in progress."""
    piece = Piece(arrays={"time": result.time}, coords={}, stats=dict(result.stats), about=result.about)
    head, rest = piece.to_bytes().split(b"\n", 1)
    assert Piece.from_bytes(head + b"\n" + rest, "run").about.to_attributes() == result.about.to_attributes()
    for version, words in (("0.3", r"'0\.3'.*'0\.4'"), (None, "no version")):
        path = with_attributes(result.save(tmp_path / "run.nc"), {"file_version": version})
        with pytest.raises(FileFormatError, match=rf"run\.nc: .*{words}"):
            Result.load(path)
        header = json.loads(head)
        header["stats"]["file_version"] = version
        with pytest.raises(FileFormatError, match=f"run: .*{words}"):
            Piece.from_bytes(json.dumps(header).encode() + b"\n" + rest, "run")
