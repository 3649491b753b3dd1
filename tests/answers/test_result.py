"""Results: the schema of DESIGN.md, read-only arrays, files that return bit for bit, refusals."""

from __future__ import annotations

import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from scipy.spatial.transform import Rotation

from seacrane.errors import FileFormatError
from seacrane.result import CHANNELS, Result
from seacrane.result.about import About

BODIES = ["vessel", "tower", "king", "main_barrel", "main_rod", "main_jib", "knuckle_barrel", "knuckle_rod",
          "knuckle_jib", "payload"]  # fmt: skip
JOINTS = ["deck", "A", "B", "C", "D", "E", "F", "G", "main_cylinder", "knuckle_cylinder", "link"]
CYLINDERS = ["main", "knuckle"]
# Centres of mass at the start (x forward, y port, z up; m): a crane of 390 t, its jib pointing aft.
MASSES = np.array([14000e3, 100e3, 115e3, 13e3, 9e3, 77e3, 14e3, 9e3, 53e3, 10e3])
START = np.array(
    [(0, 0, 3), (33, 10, 15), (33, 10, 25), (30, 10, 28), (27, 10, 31), (22, 10, 30), (18, 10, 33),
     (14, 10, 34), (9, 10, 30), (4, 10, 14)], dtype=float,
)  # fmt: skip


def smooth_step(t: np.ndarray) -> np.ndarray:
    """Quintic from 0 to 1 between 0 and 45 s."""
    u = np.clip(t / 45.0, 0, 1)
    return u**3 * (10 - 15 * u + 6 * u**2)


def crane_run(
    *, payload: bool = True, waves: bool = True, memory: bool = True, heel: float = 0.02,
    oscillation: float = 0.0, scene: str = "case2", dt: float = 0.1, t_end: float = 100.0,
) -> dict[str, Any]:  # fmt: skip
    """Arguments for `Result.from_arrays`: a rigid ship in a regular sea whose crane swings out in 45 s.

    Poses, rates and strokes belong to one motion; `oscillation` adds case 3's 5 s movement after 50 s.
    """
    t = np.arange(0, t_end + dt / 2, dt)
    names = BODIES if payload else BODIES[:-1]
    joints = JOINTS if payload else JOINTS[:-1]
    omega, lag = 2 * np.pi / 8, 0.0 if memory else 0.6
    size = 1.0 if memory else 1.3
    swing = smooth_step(t)
    five = oscillation * np.where(t > 50, np.cos(2 * np.pi * t / 5), 0)
    height, phase = np.array([0.1, 0.12, 0.5, 0.02, 0.01, 0.003]), np.array([0.0, 0.4, 0.8, 1.1, -0.3, -1.0])
    motion = height * size * np.cos(omega * t[:, None] - phase - lag)
    motion += np.outer(five, [0.01, 0.3, 0.05, 0.02, 0.0, 0.0])
    motion[:, 3] -= heel * swing
    motion[:, 5] += 0.01 * np.gradient(swing, t) * (heel > 0)
    slew = -np.pi / 2 * swing
    ship = Rotation.from_euler("ZYX", motion[:, [5, 4, 3]])
    crane = ship * Rotation.from_euler("z", slew[:, None])
    pivot = np.array([33.0, 10.0, 0.0])
    position, velocity = np.empty((2, t.size, len(names), 3))
    angular, euler = np.empty((2, t.size, len(names), 3))
    quaternion = np.empty((t.size, len(names), 4))
    for i, name in enumerate(names):
        turning = name not in ("vessel", "tower")
        rotation = crane if turning else ship
        arm = Rotation.from_euler("z", slew[:, None]).apply(START[i] - pivot) + pivot if turning else START[i]
        position[:, i] = motion[:, :3] + ship.apply(arm)
        velocity[:, i] = np.gradient(position[:, i], t, axis=0)
        quaternion[:, i] = np.roll(rotation.as_quat(), 1, axis=1)
        euler[:, i] = rotation.as_euler("XYZ")
        angular[:-1, i] = (rotation[1:] * rotation[:-1].inv()).as_rotvec() / dt
        angular[-1, i] = angular[-2, i]
    stroke = np.outer(2 * swing, [1, 1]) + five[:, None]
    weight = 9.80665 * MASSES[: len(names)]
    reaction = np.zeros((t.size, len(joints), 3))
    reaction[:, :, 2] = weight[1:].sum()
    arrays = {
        "position": position, "velocity": velocity, "angular_velocity": angular, "quaternion": quaternion,
        "euler_xyz": euler, "vessel_motion": motion, "stroke": stroke,
        "stroke_rate": np.gradient(stroke, t, axis=0), "cylinder_force": 2e6 + 1e5 * stroke,
        "slew_angle": slew, "slew_torque": 115e3 * 16 * np.gradient(np.gradient(slew, t), t),
        "reaction_force": reaction, "reaction_moment": 0.1 * np.roll(reaction, 1, axis=2),
        "constraint_error": 1e-12 * (1 + np.abs(np.sin(t))),
        "constraint_rate_error": 1e-12 * (1 + np.abs(np.cos(t))),
        "constraint_error_before_projection": 1e-7 * (1 + np.abs(np.sin(t))),
        "energy_balance": 20 * np.sin(0.1 * t), "absolute_work": 1e7 * t,
    }  # fmt: skip
    if payload:
        arrays["link_tension"] = 10e3 * (9.80665 + 0.1 * np.cos(omega * t))
    stats: dict[str, Any] = {
        "seacrane_version": "0.1.0", "scene": scene, "formulation": "redundant", "integrator": "dopri5",
        "simulated_s": t_end, "wall_s": 0.25 if memory else 0.2,
        "evaluations": 12000, "steps": 2000, "rejected_steps": 3,
        "states": 186 if memory else 140, "degrees_of_freedom": 14 if payload else 9,
        "coordinates": 6 * len(names), "constraints": 46 if payload else 45, "fastest_mode_per_s": 18.0,
        "compiled_coordinates": 6 * len(names), "compiled_constraints": 46 if payload else 45,
    }  # fmt: skip
    if waves:
        arrays["wave_elevation"] = np.cos(omega * t)
        arrays["wave_force"] = np.outer(np.cos(omega * t), [1e5, 2e5, 1e7, 1e7, 1e8, 1e6])
        stats |= {"seed": 7, "realised_hs": 2.0, "wave_components": 200}
    coords = {"body": names, "joint": joints, "cylinder": CYLINDERS}
    about = About(settings={"relative_tolerance": 1e-6, "memory": "per-pair" if memory else "none"})
    return {"time": t, "arrays": arrays, "coords": coords, "stats": stats, "about": about}


def crane_result(**changes: Any) -> Result:
    return Result.from_arrays(**crane_run(**changes))


def vessel_result(*, memory: bool = True, t_end: float = 100.0, dt: float = 0.1) -> Result:
    """The vessel alone in the same sea: no crane, so no stroke, slew, link or reaction."""
    run = crane_run(payload=False, memory=memory, heel=0.0, scene="vessel", t_end=t_end, dt=dt)
    absent = ("stroke", "cylinder", "slew", "reaction")
    arrays = {name: array for name, array in run["arrays"].items() if not name.startswith(absent)}
    for name in ("position", "velocity", "angular_velocity", "quaternion", "euler_xyz"):
        arrays[name] = arrays[name][:, :1].copy()
    counts = {"coordinates": 6, "constraints": 0, "degrees_of_freedom": 6}
    counts |= {f"compiled_{name}": counts[name] for name in ("coordinates", "constraints")}
    return Result.from_arrays(time=run["time"], arrays=arrays, coords={"body": ["vessel"]},
                              stats=run["stats"] | counts, about=run["about"])  # fmt: skip


@pytest.fixture
def run() -> dict[str, Any]:
    return crane_run(t_end=5.0)


def test_a_result_holds_only_what_the_scene_has_and_what_it_holds_is_described() -> None:
    assert set(vessel_result(t_end=2.0).coords) == {"body", "axis", "motion", "wxyz"}
    assert all(one.dims[0] == "time" and one.unit and one.long_name for one in CHANNELS.values())
    calm = Result.from_arrays(**crane_run(waves=False, payload=False, t_end=2.0))
    dataset = calm.to_xarray()
    assert all(dataset[name].attrs["units"] and dataset[name].attrs["long_name"] for name in calm.channels)
    knuckle = dataset["cylinder_force"].sel(cylinder="knuckle")
    np.testing.assert_array_equal(knuckle, calm.select("cylinder_force", cylinder="knuckle"))
    dataset["stroke"][0] = 5.0
    assert calm["stroke"][0, 0] == 0.0, "the dataset is a copy"


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
        assert list(dataset.body.values) == BODIES and list(dataset.motion.values)[3] == "roll"
        assert json.loads(dataset.attrs["settings"])["relative_tolerance"] == 1e-6
        values = {"time": dataset.time.values, **{name: dataset[name].values for name in result.channels}}
    else:
        again = Result.load(path) if backend == "own reader" else pickle.loads(pickle.dumps(result))
        assert again.dims == result.dims and again.coords == result.coords and again.interrupted
        assert dict(again.stats) == dict(result.stats) and again.about == result.about
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
        run = crane_run(t_end=5.0)
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
