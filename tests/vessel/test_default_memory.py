"""The memory that a vessel has where none is asked for: by motion, as shipped for the hull of the package."""

from __future__ import annotations

import dataclasses
import warnings
from pathlib import Path

import numpy as np
import pytest
from test_memory_by_motion import fitted

from seacrane import Lift, Scene, cases, simulate
from seacrane.description.file import scene_digest
from seacrane.hydro import HydroDatabase, MemoryModel, fit_memory, shipped_database
from seacrane.hydro.memory import cache as kept
from seacrane.hydro.memory import fit as fitting
from seacrane.hydro.memory.by_motion import fit_by_motion
from seacrane.hydro.memory.fit import LIMIT
from seacrane.hydro.memory.motion_judge import motion_judge
from seacrane.warnings import MemoryFitWarning

SHORT_LIFT = """
format = "seacrane lift"
version = 2

[vessel]
database = "hull_115"
"""


def afloat(database: HydroDatabase, **options: object) -> Scene:
    scene = Scene(name="afloat")
    scene.add_vessel(database, **options)  # type: ignore[call-overload]
    return scene


def hull(**changes: object) -> HydroDatabase:
    return dataclasses.replace(shipped_database(), **({"memory": None, "motion_rao": None} | changes))


def test_a_vessel_has_memory_by_motion() -> None:
    """Whatever its database holds; the cases are the paper's."""
    own = shipped_database()
    assert own.memory is not None and own.memory.motion is None
    scene = afloat(own)
    known = scene.provenance["vessel"]
    assert known.memory == "by-motion"
    assert known.memory_error is not None and 0.0 < known.memory_error <= LIMIT
    assert scene.compile().memory_states == fitted().states < 30
    assert scene_digest(scene) == scene_digest(afloat(own, memory="by-motion"))
    assert cases.vessel().provenance["vessel"].memory == "per-pair"


def test_a_lift_file_has_it_too(tmp_path: Path) -> None:
    path = tmp_path / "ship.toml"
    path.write_text(SHORT_LIFT, encoding="utf-8")
    scene = Lift.load(path).scene()
    assert scene.compile().memory_states == fitted().states
    path.write_text(SHORT_LIFT + 'memory = "per-pair"\n', encoding="utf-8")
    assert Lift.load(path).scene().compile().memory_states == 69


def test_what_was_reached_is_told() -> None:
    scene = afloat(shipped_database())
    scene.add_sea(hs=1.0, tp=8.0, count=20)
    result = simulate(scene, t_end=1.0)
    settings = result.settings
    assert settings["memory"] == "by-motion"
    assert settings["memory_error"] == scene.provenance["vessel"].memory_error


# The model that comes with the package


def test_the_shipped_model_is_a_fresh_fit() -> None:
    """`python tools/ship_memory.py` writes it: run it after the hull's data or the fit changed.

    The fit ends elsewhere within its limit on another processor, whose rounding differs.
    """
    database = shipped_database()
    assert len(list(kept.shipped_folder().iterdir())) == 1
    shipped = fitted()
    fresh = fit_by_motion(database=database, band=shipped.band, known=None, limit=LIMIT)
    assert fresh.motion is not None and shipped.motion is not None
    assert fresh.states == shipped.states
    judged = motion_judge(database, shipped.band).error_of(shipped).worst
    assert judged == pytest.approx(shipped.motion.error.worst, rel=1e-6)
    assert fresh.motion.reached and fresh.motion.error.worst <= LIMIT
    one, other = shipped.transfer(database.omega), fresh.transfer(database.omega)
    assert np.abs(one - other).max(axis=0) == pytest.approx(0.0, abs=1e-2 * np.abs(one).max())


def test_it_is_taken_where_nothing_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of these data and this fit alone."""

    def never(**_: object) -> MemoryModel:
        raise AssertionError("fitted again")

    monkeypatch.setattr(fitting, "fit_by_motion", never)
    monkeypatch.setattr(kept, "_of_process", {})
    assert fit_memory(database=shipped_database()).states == fitted().states
    with pytest.raises(AssertionError, match="fitted again"):
        fit_memory(database=hull(damping=1.01 * shipped_database().damping))
    monkeypatch.setattr(kept, "_of_process", {})
    monkeypatch.setattr(kept, "VERSION", kept.VERSION + 1)
    with pytest.raises(AssertionError, match="fitted again"):
        fit_memory(database=shipped_database())


# What is asked for


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"r2": 0.9}, r"r2 is 0.9, and memory by motion .* give limit, or kind='per-pair'"),
        (
            {"kind": "per-pair", "limit": 0.02},
            r"limit is 0.02, .* 'per-pair' .* give r2, or kind='by-motion'",
        ),
    ],
    ids=str,
)
def test_an_aim_of_another_kind_is_refused(asked: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        fit_memory(database=shipped_database(), **asked)  # type: ignore[arg-type]


def test_the_databases_band_is_that_of_the_fit() -> None:
    narrow = hull(trusted_band=(0.45, 0.9))
    assert fit_memory(database=narrow, limit=0.2).band == (0.45, 0.9)


def test_without_a_band_the_whole_table_is_kept_to_the_limit() -> None:
    """As of a panel code that states none: 0.1 to 3.1 rad/s."""
    model = fit_memory(database=hull(trusted_band=None))
    assert model.band == (0.1, 3.1)
    assert model.motion is not None and model.motion.reached


# Poor data


def thinned(kept_frequencies: np.ndarray) -> HydroDatabase:
    data = shipped_database()
    return hull(
        omega=data.omega[kept_frequencies],
        added_mass=data.added_mass[kept_frequencies],
        damping=data.damping[kept_frequencies],
        force=data.force[:, kept_frequencies],
    )


def test_few_frequencies_are_named() -> None:
    """No other fit takes its place: the number reached is told, with the motion and what stops it."""
    eight = np.searchsorted(shipped_database().omega, np.linspace(0.3, 2.5, 8))
    with pytest.warns(MemoryFitWarning, match=r"errs by 0\.\d+ of \w+ in a sea, .* limit is 0\.01 .*Kramers"):
        scene = afloat(thinned(eight))
    error = scene.provenance["vessel"].memory_error
    assert error is not None and error > LIMIT


def test_a_motion_without_damping_has_no_memory() -> None:
    """Its added mass is constant; what that costs is named."""
    undamped = shipped_database().damping.copy()
    undamped[:, 2, :] = undamped[:, :, 2] = 0.0
    model = fit_memory(database=hull(damping=undamped), limit=0.2)
    assert all(2 not in block.outputs for block in model.blocks)
    assert model.motion is not None
    assert {(2, 2), (0, 2), (2, 4)} <= set(model.motion.left_out)
    nothing = hull(damping=np.zeros_like(undamped))
    with pytest.warns(MemoryFitWarning, match=r"limit is 0\.01"), warnings.catch_warnings():
        assert afloat(nothing).compile().memory_states == 0


# Scenes from before


def test_a_saved_scene_keeps_its_own_memory(tmp_path: Path) -> None:
    for memory in ("per-pair", "by-motion"):
        scene = cases.vessel(memory=memory, hs=0.0)
        scene.save(tmp_path / "scene.json")
        again = Scene.load(tmp_path / "scene.json")
        assert scene_digest(again) == scene_digest(scene)
        one, other = (each.vessels["vessel"] for each in (scene, again))
        for a, b in zip(one.memory, other.memory, strict=True):
            np.testing.assert_array_equal(a.a, b.a)
        np.testing.assert_array_equal(one.added_mass, other.added_mass)
