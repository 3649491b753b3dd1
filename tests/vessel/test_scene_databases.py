"""A scene keeps the database of each vessel, in its file too; nothing asks for it again."""

from __future__ import annotations

import base64
import json
import pickle
import zlib
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import (
    FileFormatError,
    Lift,
    MotionRaos,
    Scene,
    SceneError,
    allowable_hs,
    cases,
    ensemble,
    linear_model,
    motion_rao,
    natural_modes,
    response_statistics,
    shipped_database,
    simulate,
)
from seacrane.accuracy import model_error
from seacrane.description.databases import without_databases
from seacrane.description.file import scene_digest
from seacrane.ensembles import HookLoadControl, LinearControl
from seacrane.ensembles.job import Job
from seacrane.ensembles.study import Study, checked_keep
from seacrane.hydro import DriftCoefficients, HydroDatabase, MemoryModel, VesselHydrodynamics, fit_memory
from seacrane.hydro.data.packed import packed
from seacrane.operability.criterion import Criterion
from seacrane.pictures import plot_rao
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.sea import jonswap

SEA: dict[str, Any] = {"hs": 1.0, "tp": 8.0, "direction_deg": 150.0, "count": 30}
HEAVE = {"heave": "wave_force[heave].max"}


@cache
def rich() -> HydroDatabase:
    """With every part that a database may have."""
    shipped = shipped_database()
    n = shipped.omega.size
    zero = np.zeros((n, 6, 6))
    heading, omega = np.linspace(0.0, np.pi, 13), np.linspace(0.2, 2.6, 9)
    return replace(
        shipped,
        name="rich",
        drift=DriftCoefficients(heading=heading, omega=omega, coefficient=np.full((13, 9, 6), 100.0)),
        additional=(_additional("slack tank", zero),),
        motion_rao=0.1 * shipped.force / 1e6,
        memory=fit_memory(database=shipped, kind="per-pair"),
    )


def _additional(cause: str, zero: Any) -> Any:
    from seacrane.hydro.data.hydro_data import AdditionalMatrices

    return AdditionalMatrices(cause=cause, added_mass=zero, damping=zero, restoring=zero)


def afloat(database: HydroDatabase | None = None, **sea: Any) -> Scene:
    scene = Scene()
    scene.add_vessel(shipped_database() if database is None else database, memory="none")
    scene.add_sea(**SEA | sea)
    return scene


def table() -> MotionRaos:
    values = np.full((5, 4, 6), 0.01 + 0.02j)
    return MotionRaos(
        omega=[0.3, 0.6, 1.0, 2.5], heading=np.linspace(0.0, np.pi, 5), values=values, name="RAOs"
    )


def database_of(scene: Scene, name: str = "vessel") -> HydroDatabase:
    found = scene.vessels[name].database
    assert isinstance(found, HydroDatabase)
    return found


@pytest.mark.slow("fits memories")
def test_a_scene_gives_back_the_database_of_a_vessel() -> None:
    assert database_of(afloat(rich())) is rich()


@pytest.mark.parametrize(
    "make", [shipped_database, pytest.param(rich, marks=pytest.mark.slow("fits memories"))]
)
def test_a_database_comes_back_to_the_bit_from_a_scene_file(
    make: Callable[[], HydroDatabase], tmp_path: Path
) -> None:
    scene = afloat(make())
    scene.save(tmp_path / "scene.json")
    loaded = Scene.load(tmp_path / "scene.json")
    again = database_of(loaded)
    assert loaded == scene
    assert again is not make()
    assert again.digest == make().digest
    assert packed(again) == packed(make())
    assert again.memory is not None and isinstance(again.memory, MemoryModel)
    assert again.memory.states == make().memory.states  # type: ignore[union-attr]
    np.testing.assert_array_equal(again.force, make().force)
    assert again.depth == np.inf


def test_a_file_holds_a_database_once_for_two_vessels(tmp_path: Path) -> None:
    scene = afloat()
    scene.save(tmp_path / "one.json")
    scene.add_vessel(shipped_database(), name="barge", position=(0, 60, 0), memory="none")
    scene.add_sea(vessel="barge")
    scene.save(tmp_path / "two.json")
    (entry,) = json.loads((tmp_path / "two.json").read_text())["databases"]
    assert entry["vessels"] == ["vessel", "barge"]
    assert entry["digest"] == shipped_database().digest
    loaded = Scene.load(tmp_path / "two.json")
    assert loaded.vessels["vessel"].database is loaded.vessels["barge"].database


def test_two_vessels_keep_two_databases(tmp_path: Path) -> None:
    other = replace(shipped_database(), name="other", force=0.5 * shipped_database().force)
    scene = afloat()
    scene.add_vessel(other, name="barge", memory="none")
    scene.add_sea(vessel="barge")
    scene.save(tmp_path / "scene.json")
    loaded = Scene.load(tmp_path / "scene.json")
    assert [one.database.name for one in loaded.vessels.values() if one.database] == ["hull_115", "other"]
    keep = {name: f"wave_force[{name}, heave].max" for name in ("vessel", "barge")}
    made = ensemble(loaded, over={"seed": [1, 2]}, keep=keep, t_end=2.0).dataset
    np.testing.assert_allclose(made.barge.to_numpy(), 0.5 * made.vessel.to_numpy(), rtol=1e-6)


def test_a_given_ship_keeps_what_moves_it(tmp_path: Path) -> None:
    scene = Scene()
    scene.add_given_vessel(table())
    scene.save(tmp_path / "scene.json")
    loaded = Scene.load(tmp_path / "scene.json")
    assert loaded == scene
    for one in (scene, loaded):
        one.add_sea(hs=1.0, tp=10.0, count=20)
    assert loaded.drivers == scene.drivers
    assert isinstance(loaded.vessels["vessel"].database, MotionRaos)


def test_digests_of_scenes_do_not_know_the_database() -> None:
    scene = cases.vessel(memory="none")
    assert scene_digest(scene) == scene_digest(without_databases(scene))
    assert scene != without_databases(scene)


def test_databases_that_say_the_same_have_one_digest() -> None:
    one = shipped_database()
    assert replace(one).digest == one.digest
    assert replace(one, speed=0, trusted_band=list(one.trusted_band or ())).digest == one.digest  # type: ignore[arg-type]
    assert replace(one, force=one.force * (1.0 + 1e-15)).digest != one.digest


def test_a_vessel_is_copied_compared_and_pickled_with_its_database() -> None:
    vessel = afloat().vessels["vessel"]
    again = pickle.loads(pickle.dumps(vessel))
    assert isinstance(again, VesselHydrodynamics)
    assert again == vessel
    assert again.database.digest == shipped_database().digest  # type: ignore[union-attr]
    assert VesselHydrodynamics(**vessel.__getstate__() | {"database": rich()}) != vessel
    assert VesselHydrodynamics(**vessel.__getstate__() | {"database": None}) != vessel


@pytest.mark.slow("fits memories")
def test_a_replaced_vessel_keeps_its_database() -> None:
    scene = afloat(rich())
    scene.replace("vessel", kind="vessel", mooring_damping=(1.0, 2.0, 3.0))
    scene.add_slack_tank(moment=1e6)
    assert database_of(scene) is rich()


def test_the_database_moves_nothing() -> None:
    scene = afloat()
    one, other = (simulate(s, 3.0)["vessel_motion"] for s in (scene, without_databases(scene)))
    np.testing.assert_array_equal(one, other)


# No second one.


def digests(*databases: HydroDatabase) -> str:
    return ".*".join(f"digest {one.digest[:12]}" for one in databases)


def test_another_database_of_a_vessel_is_refused_by_both_digests() -> None:
    scene, other = afloat(), replace(shipped_database(), draught=7.0)
    told = f"vessel 'vessel' is from database 'hull_115' .{digests(shipped_database(), other)}"
    for call in (
        lambda: scene.replace("vessel", kind="vessel", database=other),
        lambda: motion_rao(scene, omega=0.5, direction=0.0, body="vessel", database=other),
        lambda: linear_model(scene, memory="database", database=other),
        lambda: natural_modes(scene, memory="database", database=other),
    ):
        with pytest.raises(SceneError, match=told):
            call()


def test_the_same_database_read_again_is_no_other() -> None:
    scene, same = afloat(), replace(shipped_database())
    given = {"omega": [0.5, 0.7], "direction": 1.0, "body": "vessel"}
    np.testing.assert_array_equal(motion_rao(scene, **given), motion_rao(scene, database=same, **given))


# Nothing asks for one.


@pytest.mark.filterwarnings("ignore:.*damping ratio")  # the fluid memory is left out
def test_linear_answers_take_the_databases_of_the_scene() -> None:
    scene = afloat(rich())
    rao = motion_rao(scene, omega=0.7, direction=np.pi, body="vessel")
    assert np.abs(rao[2]) > 0.01
    assert (
        response_statistics(scene, spectrum=jonswap(hs=1.0, tp=8.0), direction=np.pi, body="vessel").std[2]
        > 0.0
    )
    by_database = linear_model(scene, memory="database")
    assert by_database.memories[0].database is rich()
    assert plot_rao(by_database, body="vessel").axes
    assert len(natural_modes(scene, memory="database").eigenvalues)


def test_drift_and_positions_take_the_database_of_the_scene() -> None:
    scene = afloat(rich())
    scene.add_drift(outside="hold")
    scene.use_actual_position()
    assert scene.waves is not None
    assert scene.waves.hull().drift is not None and scene.waves.hull().force_by_heading is not None
    scene.use_slow_position()
    at_once = afloat(rich(), phase="slow", drift=True).waves
    assert at_once is not None
    np.testing.assert_array_equal(scene.waves.hull().drift, at_once.hull().drift)


def test_controls_and_the_error_of_a_memory_take_the_database_of_a_loaded_scene(tmp_path: Path) -> None:
    cases.case2(hs=0.5, count=20).save(tmp_path / "scene.json")
    scene = Scene.load(tmp_path / "scene.json")
    control = LinearControl(scene, "position[payload, z]", t_end=20.0)
    assert control.extremes([1, 2]).shape == (2,)
    assert HookLoadControl(scene, t_end=20.0).extremes([1]).shape == (1,)
    assert model_error(scene, body="vessel", times=np.linspace(0.0, 20.0, 41)).largest.shape == (6,)


@pytest.mark.filterwarnings("ignore:.*damping ratio")  # the fluid memory is left out
def test_allowable_heights_take_the_database_of_the_scene() -> None:
    criterion = Criterion(channel="position", names={"body": "vessel", "axis": "z"}, maximum=3.0)
    found = allowable_hs(afloat(), criteria=[criterion], tp=[8.0], direction_deg=[180.0], domain="frequency")
    assert float(found.dataset.allowable_hs.max()) > 0.1


def test_a_trade_fits_other_memories_to_the_database_of_the_scene() -> None:
    from seacrane.trading import simpler_scenes

    other = replace(shipped_database(), name="other")
    kinds = {variant.memory.split()[0] for variant in simpler_scenes.variants(afloat(other), quick=False)}
    assert kinds >= {"convolution", "by-motion", "per-pair", "passive"}
    bare = without_databases(afloat(other))
    assert not {"convolution", "passive"} & {
        one.memory.split()[0] for one in simpler_scenes.variants(bare, quick=False)
    }


def test_seeds_in_processes_and_lanes_are_those_of_one_thread(tmp_path: Path) -> None:
    afloat(rich()).save(tmp_path / "scene.json")
    scene = Scene.load(tmp_path / "scene.json")
    given: dict[str, Any] = {"over": {"seed": range(1, 9)}, "keep": HEAVE, "t_end": 3.0}
    alone = ensemble(scene, lanes=1, **given).dataset.heave.to_numpy()
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        apart = ensemble(scene, lanes=1, executor=pool, **given).dataset.heave.to_numpy()
    beside = ensemble(scene, **given).dataset.heave.to_numpy()
    assert len(set(alone)) == 8
    np.testing.assert_array_equal(apart, alone)
    np.testing.assert_allclose(beside, alone, rtol=1e-3)


def test_a_study_carries_a_database_once_to_a_process() -> None:
    def size(scene: Scene) -> int:
        study = Study(source=scene, t_end=1.0, method=Method(), outputs=Outputs(), keep=checked_keep(HEAVE))
        return len(pickle.dumps(Job(study)))

    scene = afloat()
    one, alone = size(scene), size(without_databases(scene))
    scene.add_vessel(shipped_database(), name="barge", memory="none")
    scene.add_sea(vessel="barge")
    database = len(pickle.dumps(shipped_database()))
    assert one - alone < 1.1 * database
    assert size(scene) - size(without_databases(scene)) < 1.1 * database


def test_a_store_goes_on_with_the_scene_from_a_file(tmp_path: Path) -> None:
    scene = afloat()
    scene.save(tmp_path / "scene.json")
    given: dict[str, Any] = {"over": {"seed": [1, 2, 3]}, "keep": HEAVE, "t_end": 2.0}
    first = ensemble(scene, store=tmp_path / "store", **given)
    times = {file: file.stat().st_mtime_ns for file in (tmp_path / "store").rglob("*.nc")}
    again = ensemble(Scene.load(tmp_path / "scene.json"), store=tmp_path / "store", **given)
    assert times and {file: file.stat().st_mtime_ns for file in times} == times
    np.testing.assert_array_equal(first.dataset.heave, again.dataset.heave)


def test_a_lift_and_a_result_hold_the_database_too(tmp_path: Path) -> None:
    lift = Lift({"vessel": {"database": "hull_115", "memory": "none"}, "sea": {"hs_m": 1.0, "count": 20}})
    scene = lift.scene()
    assert database_of(scene) is shipped_database()
    assert motion_rao(scene, omega=0.5, direction=0.0, body="vessel").shape == (6,)
    result = simulate(scene, 1.0)
    result.save(tmp_path / "result.nc")
    again = type(result).load(tmp_path / "result.nc").scene
    assert database_of(again).digest == shipped_database().digest


# Scenes without one.


def test_a_vessel_without_its_database_says_what_to_do() -> None:
    scene = without_databases(afloat())
    assert scene.vessels["vessel"].database is None
    simulate(scene, 1.0)
    told = r"has no database, which .* needs; .* scene\.replace\('vessel', kind='vessel', database=database\)"
    for call in (
        lambda: ensemble(scene, over={"seed": [1]}, keep=HEAVE),
        lambda: motion_rao(scene, omega=0.5, direction=0.0, body="vessel"),
        lambda: scene.use_actual_position(),
        lambda: linear_model(scene, memory="database"),
    ):
        with pytest.raises(SceneError, match=told):
            call()
    other = replace(shipped_database(), name="another")
    with pytest.raises(SceneError, match=r"is from database 'hull_115' of .* and 'another' .digest"):
        scene.replace("vessel", kind="vessel", database=other)
    scene.replace("vessel", kind="vessel", database=shipped_database())
    assert scene == afloat()
    assert ensemble(scene, over={"seed": [2]}, keep=HEAVE, t_end=1.0).dataset.heave.size == 1


def test_a_vessel_of_matrices_takes_a_database_for_its_waves() -> None:
    whole = afloat()
    matrices = whole.vessels["vessel"].__getstate__()
    matrices.pop("name"), matrices.pop("database")
    scene = Scene()
    scene.bodies["vessel"] = whole.bodies["vessel"]
    scene.add_vessel(**matrices)
    with pytest.raises(SceneError, match="vessel 'vessel' has no database, which a sea needs"):
        scene.add_sea(**SEA)
    scene.remove("vessel", kind="vessel")
    scene.add_vessel(shipped_database(), **matrices)
    scene.add_sea(**SEA)
    assert scene.waves is not None and whole.waves is not None
    np.testing.assert_array_equal(scene.waves.hull().transfer, whole.waves.hull().transfer)


@pytest.mark.parametrize("given", ["hull_115", 3])
def test_what_is_no_database_is_named(given: Any) -> None:
    with pytest.raises(SceneError, match=r"vessel 'vessel': database is .*; give a HydroDatabase"):
        afloat().replace("vessel", kind="vessel", database=given)
    with pytest.raises(SceneError, match=r"database is .*; give a HydroDatabase"):
        motion_rao(afloat(), omega=0.5, direction=0.0, body="vessel", database=given)


# Damage.


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


def _other(text: bytes) -> Callable[[dict[str, Any]], None]:
    """Sound in itself, and no database."""
    from hashlib import sha256

    def change(entry: dict[str, Any]) -> None:
        entry["data"] = base64.b64encode(zlib.compress(text)).decode()
        entry["digest"] = sha256(text).hexdigest()

    return change


def _in_head(old: bytes, new: bytes) -> Callable[[dict[str, Any]], None]:
    whole = packed(shipped_database())
    assert old in whole
    return _other(whole.replace(old, new, 1))


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda entry: entry.update(data="?"), r"databases\[0\]\.data: is damaged"),
        (_flipped, r"databases\[0\]\.data: is damaged"),
        (lambda entry: entry.update(digest="0" * 64), "not of its digest"),
        (
            lambda entry: entry.update(vessels=["barge"]),
            r"vessels\[0\] is 'barge'; give a vessel of the scene",
        ),
        (lambda entry: entry.update(more=1), "unknown entry 'more'"),
        (_other(b"nothing"), "no database that this seacrane reads"),
        (_other(b"[]\n"), "no database that this seacrane reads .it holds a tuple"),
        (_other(b'{"$kind": "Passivity"}\n'), "no database that this seacrane reads"),
        (_other(b'{"$kind": "system"}\n'), "no database that this seacrane reads"),
        (_in_head(b'"$array": "<f8"', b'"$array": "<O8"'), "it holds an array of '<O8'"),
        (_in_head(b"[61]", b"[-1]"), "no database that this seacrane reads"),
        (_in_head(b"[61]", b"[99999999999]"), "it ends within an array"),
        (_in_head(b'"length": 115.0', b'"length": "long"'), "its length is a str"),
        (_in_head(b'"length": 115.0', b'"length": -1.0'), "length is -1.0; give a positive"),
        (_in_head(b'"draught"', b'"depth_of"'), "no database that this seacrane reads"),
    ],
)
def test_a_damaged_database_in_a_file_is_refused(
    change: Callable[[dict[str, Any]], None], told: str, tmp_path: Path
) -> None:
    with pytest.raises(FileFormatError, match=told):
        Scene.load(damaged(tmp_path, change))


def test_a_database_that_unfolds_takes_bounded_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("seacrane.description.databases.LARGEST", 10_000)
    afloat().save(tmp_path / "scene.json")
    with pytest.raises(FileFormatError, match="is damaged"):
        Scene.load(tmp_path / "scene.json")
