"""Writes sound files of our own formats into the corpus, once one has changed: python tools/fuzzing/seeds.py.

Other programs' files, and damaged ones, stay as they were committed.
"""

from __future__ import annotations

import dataclasses
import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

sys.path.extend(map(str, (Path(__file__).resolve().parents[2] / "tests").glob("*/")))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

from aqwa_writer import ah1, listing, run_of, run_of_group
from fuzz.netcdf_spec import spec_of
from fuzz.targets import CORPUS
from lift_examples import EVERY_TABLE
from test_elements import every_load
from test_scene_file import every_kind

from seacrane import Result, Scene, cases, shipped_database, simulate
from seacrane.crane.load_crane import SHIPPED
from seacrane.hydro import HydroDatabase, motion_response, two_barges
from seacrane.hydro.data.hydro_data import DriftCoefficients
from seacrane.scene.file import described


def put(target: str, name: str, content: bytes | str) -> None:
    (CORPUS / target).mkdir(parents=True, exist_ok=True)
    (CORPUS / target / name).write_bytes(content if isinstance(content, bytes) else content.encode())


def small_hull() -> HydroDatabase:
    """Two frequencies and three headings of the shipped hull, in three digits."""
    hull = shipped_database().select(omega=[20, 40], heading=[0, 9, 18])
    rounded = np.vectorize(lambda value: float(f"{value:.3g}"))
    short = {name: rounded(getattr(hull, name)) for name in ("added_mass", "damping")}
    less = {"force": hull.force.round(0), "g": 9.80665, "memory": None, "trusted_band": None}
    hull = dataclasses.replace(hull, **short, **less)
    return dataclasses.replace(hull, motion_rao=motion_response(hull))


def scene_seeds() -> None:
    data = json.loads(json.dumps(described(every_kind())))
    put("scene", "every-kind", json.dumps(data))
    zero, headings = np.zeros((2, 3, 6)).tolist(), [0.0, 3.0]
    data["waves"]["hulls"]["hull"] |= {
        "force_by_heading": {"heading": headings, "values": {"real": zero, "imaginary": zero}},
        "drift": zero[0], "drift_by_heading": {"heading": headings, "values": zero},
    }  # fmt: skip
    put("scene", "hull-of-all-headings", json.dumps(data))
    data["vessels"][0]["memory"] = {"step": 0.1, "kernel": np.zeros((3, 6, 6)).tolist()}
    data["waves"]["current"] = {"depth": [0.0, 20.0], "speed": [1.0, 0.5], "direction_deg": [30.0, 40.0]}
    put("scene", "convolution-and-current", json.dumps(data))
    put("scene", "every-load", json.dumps(described(every_load())))


def database_seeds(folder: Path) -> None:
    hull, memory = small_hull(), shipped_database().memory
    assert memory is not None
    memory = dataclasses.replace(memory, blocks=memory.blocks[:1], rows=memory.rows[:2])
    drift = DriftCoefficients(heading=hull.heading, omega=hull.omega, coefficient=np.ones((3, 2, 6)))
    full = dataclasses.replace(hull, drift=drift, memory=memory, trusted_band=(0.5, 1.0))
    for name, database in (("plain", hull), ("full", full)):
        put_spec("database", name, database, folder)


def aqwa_seeds() -> None:
    """One structure in both files, and a pair."""
    one = run_of(small_hull(), (0.0, 0.0, 1.0))
    put("aqwa", "hull", ah1(one))
    put("aqwa-listing", "hull", listing(one))
    pair = two_barges(lid_damping=None)
    few = {"omega": pair.omega[40:42], "added_mass": pair.added_mass[40:42], "damping": pair.damping[40:42]}
    less = {"heading": pair.heading[:2], "force": pair.force[:2, 40:42], "depth": 500.0}
    put("aqwa", "pair", ah1(run_of_group(dataclasses.replace(pair, **few, **less))))


def put_spec(target: str, name: str, saved: Any, folder: Path) -> None:
    saved.save(folder / "seed.nc")
    put(target, name, spec_of(folder / "seed.nc"))


def pendulum() -> Result:
    """Few channels, outputs and events: a case of it is written ten times as fast as one of a crane."""
    scene = Scene(name="pendulum")
    scene.add_body(name="bob", mass=1.0, inertia=np.eye(3), position=(0.0, 0.0, 0.0))
    scene.add_joint(name="slide", kind="prismatic", first="ground", second="bob")
    scene.add_stop(joint="slide", minimum=-1.0)
    full = simulate(scene, t_end=1.0, dt_out=0.5)
    channels = {name: full[name] for name in ("position", "energy_balance")}
    coords = {dim: full.coords[dim] for dim in ("body", "axis")}
    return dataclasses.replace(full, channels=channels, extremes={}, coords=coords)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        database_seeds(Path(name))
        put_spec("result", "run", simulate(cases.case1(), t_end=1.0, dt_out=0.5), Path(name))
        put_spec("result", "small", pendulum(), Path(name))
    scene_seeds()
    aqwa_seeds()
    put("crane", "shipped", (SHIPPED / "knuckle_boom_250t.toml").read_bytes())
    put("lift", "every-table", EVERY_TABLE)
    examples = Path(__file__).resolve().parents[2] / "examples" / "lifts"
    put("lift", "answers", (examples / "answers.toml").read_bytes())
    put("lift", "case3", (SHIPPED.parent / "lifts" / "case3.toml").read_bytes())


if __name__ == "__main__":
    main()
