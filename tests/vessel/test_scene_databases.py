"""A scene keeps the database of each vessel, in its file too; nothing asks for it again."""

from __future__ import annotations

import base64
import json
import pickle
import zlib
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import (
    FileFormatError,
    Lift,
    Scene,
    SceneError,
    cases,
    ensemble,
    linear_model,
    motion_rao,
    natural_modes,
    response_statistics,
    shipped_database,
    simulate,
)
from seacrane.description.databases import without_databases
from seacrane.description.file import scene_digest
from seacrane.hydro import DriftCoefficients, HydroDatabase, VesselHydrodynamics, fit_memory
from seacrane.hydro.data.hydro_data import AdditionalMatrices
from seacrane.hydro.data.packed import packed
from seacrane.sea import jonswap

SEA: dict[str, Any] = {"hs": 1.0, "tp": 8.0, "direction_deg": 150.0, "count": 30}
HEAVE = {"heave": "wave_force[heave].max"}


@cache
def drifting() -> HydroDatabase:
    heading, omega = np.linspace(0.0, np.pi, 13), np.linspace(0.2, 2.6, 9)
    drift = DriftCoefficients(heading=heading, omega=omega, coefficient=np.full((13, 9, 6), 100.0))
    return replace(shipped_database(), name="drifting", drift=drift)


@cache
def rich() -> HydroDatabase:
    """With every part that a database may have."""
    shipped, zero = shipped_database(), np.zeros((shipped_database().omega.size, 6, 6))
    tank = AdditionalMatrices(cause="slack tank", added_mass=zero, damping=zero, restoring=zero)
    return replace(
        drifting(), name="rich", motion_rao=0.1 * shipped.force / 1e6, additional=(tank,),
        memory=fit_memory(database=shipped, kind="per-pair"),
    )  # fmt: skip


def afloat(database: HydroDatabase | None = None, **sea: Any) -> Scene:
    scene = Scene()
    scene.add_vessel(shipped_database() if database is None else database, memory="none")
    scene.add_sea(**SEA | sea)
    return scene


@pytest.mark.parametrize(
    "make", [shipped_database, pytest.param(rich, marks=pytest.mark.slow("fits memories"))]
)
def test_a_database_comes_back_to_the_bit(make: Callable[[], HydroDatabase], tmp_path: Path) -> None:
    scene = afloat(make())
    assert scene.vessels["vessel"].database is make()
    scene.save(tmp_path / "scene.json")
    loaded = Scene.load(tmp_path / "scene.json")
    again = loaded.vessels["vessel"].database
    assert loaded == scene
    assert again is not make()
    assert again.digest == make().digest
    assert packed(again) == packed(make())
    assert again.memory.states == make().memory.states
    np.testing.assert_array_equal(again.force, make().force)
    scene.replace("vessel", kind="vessel", mooring_damping=(1.0, 2.0, 3.0))
    scene.add_slack_tank(moment=1e6)
    assert scene.vessels["vessel"].database is make()


def test_a_file_holds_a_database_once_for_two_vessels(tmp_path: Path) -> None:
    scene, shipped = afloat(), shipped_database()
    scene.add_vessel(shipped, name="barge", position=(0, 60, 0), memory="none")
    other = replace(shipped, name="other", force=0.5 * shipped.force)
    scene.add_vessel(other, name="tug", memory="none")
    for name in ("barge", "tug"):
        scene.add_sea(vessel=name)
    scene.save(tmp_path / "scene.json")
    first, second = json.loads((tmp_path / "scene.json").read_text())["databases"]
    assert first["vessels"] == ["vessel", "barge"] and second["vessels"] == ["tug"]
    assert first["digest"] == shipped.digest
    loaded = Scene.load(tmp_path / "scene.json")
    assert loaded.vessels["vessel"].database is loaded.vessels["barge"].database
    keep = {name: f"wave_force[{name}, heave].max" for name in ("vessel", "tug")}
    made = ensemble(loaded, over={"seed": [1, 2]}, keep=keep, t_end=2.0).dataset
    np.testing.assert_allclose(made.tug.to_numpy(), 0.5 * made.vessel.to_numpy(), rtol=1e-6)


def test_digests_vessels_and_copies_know_their_database() -> None:
    scene = cases.vessel(memory="none")
    assert scene_digest(scene) == scene_digest(without_databases(scene))
    assert scene != without_databases(scene)
    one = shipped_database()
    assert replace(one, speed=0, trusted_band=list(one.trusted_band)).digest == one.digest
    assert replace(one, force=one.force * (1.0 + 1e-15)).digest != one.digest
    vessel = afloat().vessels["vessel"]
    again = pickle.loads(pickle.dumps(vessel))
    assert again == vessel and again.database.digest == one.digest
    assert VesselHydrodynamics(**vessel.__getstate__() | {"database": None}) != vessel


# No second one.


@pytest.mark.filterwarnings("ignore:.*damping ratio")  # the fluid memory is left out
def test_answers_take_the_database_of_the_scene() -> None:
    scene, asked = afloat(drifting()), {"omega": 0.7, "direction": np.pi, "body": "vessel"}
    rao = motion_rao(scene, **asked)
    assert np.abs(rao[2]) > 0.01
    np.testing.assert_array_equal(rao, motion_rao(scene, database=replace(drifting()), **asked))
    sea = {"spectrum": jonswap(hs=1.0, tp=8.0), "direction": np.pi, "body": "vessel"}
    assert response_statistics(scene, **sea).std[2] > 0.0
    assert linear_model(scene, memory="database").memories[0].database is drifting()
    assert len(natural_modes(scene, memory="database").eigenvalues)
    scene.add_drift(outside="hold")
    scene.use_actual_position()
    assert scene.waves.hull().drift is not None and scene.waves.hull().force_by_heading is not None
    scene.use_slow_position()
    at_once = afloat(drifting(), phase="slow", drift=True).waves
    np.testing.assert_array_equal(scene.waves.hull().drift, at_once.hull().drift)


def test_a_lift_and_a_result_hold_the_database_too(tmp_path: Path) -> None:
    lift = Lift({"vessel": {"database": "hull_115", "memory": "none"}, "sea": {"hs_m": 1.0, "count": 20}})
    scene = lift.scene()
    assert scene.vessels["vessel"].database is shipped_database()
    result = simulate(scene, 1.0)
    result.save(tmp_path / "result.nc")
    again = type(result).load(tmp_path / "result.nc").scene
    assert again.vessels["vessel"].database.digest == shipped_database().digest


def test_a_vessel_without_its_database_and_one_of_another_are_told() -> None:
    other = replace(shipped_database(), name="other", draught=7.0)
    scene, bare = afloat(), without_databases(afloat())
    simulate(bare, 1.0)
    asked = {"omega": 0.5, "direction": 0.0, "body": "vessel"}
    needs = r"has no database.*scene\.replace\('vessel', kind='vessel', database=database\)"
    both = f"is from database 'hull_115' .*{shipped_database().digest[:12]}.*{other.digest[:12]}"
    for call, told in (
        (lambda: ensemble(bare, over={"seed": [1]}, keep=HEAVE), needs),
        (lambda: motion_rao(bare, **asked), needs),
        (bare.use_actual_position, needs),
        (lambda: linear_model(bare, memory="database"), needs),
        (lambda: bare.replace("vessel", kind="vessel", database=other), "'hull_115'.*'other'"),
        (lambda: scene.replace("vessel", kind="vessel", database=other), both),
        (lambda: motion_rao(scene, database=other, **asked), both),
        (lambda: linear_model(scene, memory="database", database=other), both),
        (lambda: natural_modes(scene, memory="database", database=other), both),
        (lambda: scene.replace("vessel", kind="vessel", database="hull_115"), "give a HydroDatabase"),
        (lambda: motion_rao(scene, database=3, **asked), "give a HydroDatabase"),
    ):
        with pytest.raises(SceneError, match=told):
            call()
    bare.replace("vessel", kind="vessel", database=shipped_database())
    assert bare == scene
    assert ensemble(bare, over={"seed": [2]}, keep=HEAVE, t_end=1.0).dataset.heave.size == 1


def test_a_vessel_of_matrices_takes_a_database_for_its_waves() -> None:
    whole, scene = afloat(), Scene()
    matrices = whole.vessels["vessel"].__getstate__()
    given = matrices.pop("database")
    scene.bodies["vessel"] = whole.bodies["vessel"]
    scene.add_vessel(given, **{name: value for name, value in matrices.items() if name != "name"})
    scene.add_sea(**SEA)
    np.testing.assert_array_equal(scene.waves.hull().transfer, whole.waves.hull().transfer)


def damaged(tmp_path: Path, change: Callable[[dict[str, Any]], None]) -> Path:
    afloat().save(tmp_path / "scene.json")
    data = json.loads((tmp_path / "scene.json").read_text())
    change(data["databases"][0])
    (tmp_path / "scene.json").write_text(json.dumps(data))
    return tmp_path / "scene.json"


def _flipped(entry: dict[str, Any]) -> None:
    data = bytearray(base64.b64decode(entry["data"]))
    data[len(data) // 2] ^= 1
    entry["data"] = base64.b64encode(data).decode()


def _bytes(data: bytes) -> Callable[[dict[str, Any]], None]:
    """Sound in itself, and no database."""

    def change(entry: dict[str, Any]) -> None:
        entry["data"] = base64.b64encode(zlib.compress(data)).decode()
        entry["digest"] = sha256(data).hexdigest()

    return change


def _head(old: bytes, new: bytes) -> Callable[[dict[str, Any]], None]:
    assert old in packed(shipped_database())
    return _bytes(packed(shipped_database()).replace(old, new, 1))


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (_flipped, r"databases\[0\]\.data: is damaged"),
        (lambda entry: entry.update(digest="0" * 64), "digest"),
        (lambda entry: entry.update(vessels=["barge"]), r"vessels\[0\] is 'barge'"),
        (lambda entry: entry.update(more=1), "unknown entry 'more'"), (_bytes(b"nothing"), "no database"),
        (_bytes(b"[]\n"), "no database.*tuple"), (_bytes(b'{"$kind": "system"}\n'), "no database"),
        (_head(b'"$array": "<f8"', b'"$array": "<O8"'), "'<O8'"), (_head(b"[61]", b"[-1]"), "no database"),
        (_head(b"[61]", b"[99999999999]"), "ends within an array"),
        (_head(b'"length": 115.0', b'"length": "long"'), "length is a str"),
        (_head(b'"draught"', b'"depth_of"'), "no database"),
    ],
)  # fmt: skip
def test_a_damaged_database_in_a_file_is_refused(change: Any, told: str, tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=told):
        Scene.load(damaged(tmp_path, change))


def test_unfolding_takes_bounded_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("seacrane.description.databases.LARGEST", 10_000)
    afloat().save(tmp_path / "scene.json")
    with pytest.raises(FileFormatError, match="is damaged"):
        Scene.load(tmp_path / "scene.json")
