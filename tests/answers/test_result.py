"""Results: the schema of DESIGN.md, read-only arrays, files that return bit for bit, refusals."""

from __future__ import annotations

import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

from seacrane import cases, simulate
from seacrane.errors import FileFormatError
from seacrane.result import CHANNELS, Result


def crane_run(t_end: float = 5.0) -> dict[str, Any]:
    """Arguments of `Result.from_arrays` that make the run of case 2 again, in arrays that may be changed."""
    result = simulate(cases.case2(), t_end)
    arrays = {name: np.array(values) for name, values in result.channels.items()}
    return {"time": np.array(result.time), "arrays": arrays, "coords": dict(result.coords),
            "stats": dict(result.stats), "about": result.about}  # fmt: skip


@pytest.fixture
def run() -> dict[str, Any]:
    return crane_run()


def test_a_result_holds_only_what_the_scene_has_and_what_it_holds_is_described() -> None:
    assert set(simulate(cases.vessel(), 2.0).coords) == {"body", "axis", "motion", "wxyz"}
    assert all(one.dims[0] == "time" and one.unit and one.long_name for one in CHANNELS.values())
    calm = simulate(cases.case1(hs=0.0), 2.0)
    dataset = calm.to_xarray()
    assert all(dataset[name].attrs["units"] and dataset[name].attrs["long_name"] for name in calm.channels)
    knuckle = dataset["cylinder_force"].sel(cylinder="knuckle")
    np.testing.assert_array_equal(knuckle, calm.select("cylinder_force", cylinder="knuckle"))
    dataset["stroke"][0] = 5.0
    assert abs(calm["stroke"][0, 0]) < 1e-9, "the dataset is a copy"


def test_arrays_and_mappings_cannot_be_changed(run: dict[str, Any]) -> None:
    result = Result.from_arrays(**run)
    for array in (result.time, *result.channels.values()):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
    with pytest.raises(TypeError):
        result.channels["stroke"] = result.time  # type: ignore[index]


def test_select_picks_by_name(run: dict[str, Any]) -> None:
    result = Result.from_arrays(**run)
    height = result.select("position", body="payload", axis="z")
    np.testing.assert_array_equal(height, run["arrays"]["position"][:, 9, 2])
    assert not height.flags.writeable
    with pytest.raises(ValueError, match=r"no body 'payloat'.*choose from vessel"):
        result.select("position", body="payloat")
    with pytest.raises(ValueError, match="not 'joint'"):
        result.select("position", joint="A")


@pytest.mark.parametrize("backend", ["own reader", "xarray", "pickle"])
def test_a_saved_file_returns_bit_for_bit(run: dict[str, Any], tmp_path: Path, backend: str) -> None:
    run["stats"] |= {"seed": 2**64 - 1, "repeat_period_s": np.inf}
    run["arrays"]["slew_torque"][-1] = np.nan  # what stopped an interrupted run
    result = Result.from_arrays(**run, interrupted=True)
    path = result.save(tmp_path / "case2.nc")
    if backend == "xarray":
        with xarray.open_dataset(path, engine="netcdf4", decode_times=False) as file:
            dataset = file.load()
        assert (
            tuple(dataset.body.values) == result.coords["body"] and list(dataset.motion.values)[3] == "roll"
        )
        assert json.loads(dataset.attrs["settings"])["rtol"] == 1e-6
        values = {"time": dataset.time.values, **{name: dataset[name].values for name in result.channels}}
    else:
        again = Result.load(path) if backend == "own reader" else pickle.loads(pickle.dumps(result))
        assert again.dims == result.dims and again.coords == result.coords and again.interrupted
        assert dict(again.stats) == dict(result.stats)
        assert again.about.to_attributes() == result.about.to_attributes()
        assert {k: type(v) for k, v in again.stats.items()} == {k: type(v) for k, v in result.stats.items()}
        assert not again["position"].flags.writeable and not again.time.flags.writeable
        values = {"time": again.time, **again.channels}
    np.testing.assert_array_equal(values.pop("time"), result.time)
    assert set(values) == set(result.channels)
    for name, array in values.items():
        assert array.dtype == np.float64
        np.testing.assert_array_equal(array, result[name], err_msg=name)


BAD_INPUT = [
    (lambda r: r["arrays"].update(heave=r["time"]), "'heave'"),
    (lambda r: r["arrays"].update(stroke=r["arrays"]["stroke"].T), r"'stroke'.*\(2, 51\)"),
    (lambda r: r["arrays"]["stroke"].__setitem__((3, 1), np.nan), "'stroke'.*output 3"),
    (lambda r: r["time"].__setitem__(2, 0.0), "increasing"),
    (lambda r: r["coords"].update(body=["vessel"] * 2), "more than once: vessel"),
    (lambda r: r["stats"].pop("steps"), "steps"), (lambda r: r["stats"].update(bounds="[]"), "'bounds'"),
]  # fmt: skip


def test_arrays_that_contradict_each_other_are_refused() -> None:
    for change, message in BAD_INPUT:
        run = crane_run()
        change(run)
        with pytest.raises(ValueError, match=message):
            Result.from_arrays(**run)


def test_a_file_that_is_no_result_is_named(run: dict[str, Any], tmp_path: Path) -> None:
    whole = Result.from_arrays(**run).save(tmp_path / "whole.nc").read_bytes()
    for content in (b"time,heave\n", *(whole[: int(share * len(whole))] for share in (0.1, 0.5, 0.9))):
        (tmp_path / "cut.nc").write_bytes(content)
        with pytest.raises(FileFormatError, match=r"cut\.nc"):
            Result.load(tmp_path / "cut.nc")
    xarray.Dataset({"temperature": ("time", [1.0, 2.0])}).to_netcdf(tmp_path / "other.nc")
    with pytest.raises(FileFormatError, match=r"other\.nc.*'time'"):
        Result.load(tmp_path / "other.nc")
