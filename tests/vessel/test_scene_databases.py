"""A scene keeps the database of each vessel, in its file too; nothing asks for it again."""

from __future__ import annotations

import base64
import json
import pickle
import zlib
from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ensemble_studies import drifting_hull

from seacrane import (
    FileFormatError,
    Scene,
    SceneError,
    cases,
    ensemble,
    linear_model,
    motion_rao,
    shipped_database,
    simulate,
)
from seacrane.description.databases import without_databases
from seacrane.hydro import HydroDatabase, VesselHydrodynamics, fit_memory
from seacrane.hydro.data.hydro_data import AdditionalMatrices
from seacrane.hydro.data.packed import packed
from seacrane.scene.file import scene_digest

DRIFTING = drifting_hull()
SEA: dict[str, Any] = {"hs": 1.0, "tp": 8.0, "direction_deg": 150.0, "count": 30}
HEAVE = {"heave": "wave_force[heave].max"}


@cache
def rich() -> HydroDatabase:
    """With every part that a database may have."""
    shipped, zero = shipped_database(), np.zeros((shipped_database().omega.size, 6, 6))
    tank = AdditionalMatrices(cause="slack tank", added_mass=zero, damping=zero, restoring=zero)
    return replace(
        DRIFTING, name="rich", motion_rao=0.1 * shipped.force / 1e6, additional=(tank,),
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


def test_a_vessel_without_its_database_and_one_of_another_are_told() -> None:
    other = replace(shipped_database(), name="other", draught=7.0)
    scene, bare = afloat(), without_databases(afloat())
    simulate(bare, 1.0)
    asked = {"omega": 0.5, "direction": 0.0, "body": "vessel"}
    given = {"memory": "database", "database": other}
    louder = replace(shipped_database(), force=1.1 * shipped_database().force)
    loud = without_databases(scene)
    loud.replace("vessel", kind="vessel", database=louder)
    both = f"is from database 'hull_115' .*{shipped_database().digest[:12]}.*{other.digest[:12]}"
    for call, told in (
        (lambda: ensemble(bare, over={"seed": [1]}, keep=HEAVE), "has no database"),
        (lambda: motion_rao(bare, **asked), "has no database"),
        (partial(bare.add_sea, phase="actual"), "has no database"),
        (lambda: ensemble(loud, over={"seed": [1]}, keep=HEAVE), "the waves load vessel 'vessel' otherwise"),
        (lambda: bare.replace("vessel", kind="vessel", database=other), "'hull_115'.*'other'"),
        (lambda: scene.replace("vessel", kind="vessel", database=other), both),
        (lambda: motion_rao(scene, database=other, **asked), both),
        (lambda: linear_model(scene, **given), both),
    ):
        with pytest.raises(SceneError, match=told):
            call()
    bare.replace("vessel", kind="vessel", database=shipped_database())
    assert bare == scene


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (b"", b"", "is damaged"), (b'"$array": "<f8"', b'"$array": "<O8"', "'<O8'"),
        (b"[61]", b"[-1]", "no database"), (b"[61]", b"[99999999999]", "ends within an array"),
        (b'"length": 115.0', b'"length": "long"', "length is a str"),
    ],
)  # fmt: skip
def test_a_damaged_database_in_a_file_is_refused(old: bytes, new: bytes, told: str, tmp_path: Path) -> None:
    """A bit that flipped, and what is sound in itself and no database."""
    afloat().save(tmp_path / "scene.json")
    scene = json.loads((tmp_path / "scene.json").read_text())
    entry, data = scene["databases"][0], packed(shipped_database()).replace(old, new, 1)
    folded = bytearray(zlib.compress(data) if old else base64.b64decode(entry["data"]))
    if not old:
        folded[len(folded) // 2] ^= 1
    entry |= {"data": base64.b64encode(folded).decode(), "digest": sha256(data).hexdigest()}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    with pytest.raises(FileFormatError, match=told):
        Scene.load(tmp_path / "scene.json")


def test_unfolding_takes_bounded_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("seacrane.description.databases.LARGEST", 10_000)
    afloat().save(tmp_path / "scene.json")
    with pytest.raises(FileFormatError, match="is damaged"):
        Scene.load(tmp_path / "scene.json")
