"""Fluid memory chosen by what it does to the motions, its limit, kept models, and the default."""

from __future__ import annotations

import dataclasses
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Lift, Scene, cases, load_database, motion_rao, simulate
from seacrane.arrays import Array
from seacrane.hydro import (
    HydroDatabase,
    MemoryModel,
    fit_memory,
    passivity_certificate,
    retardation_functions,
    shipped_database,
)
from seacrane.hydro.data.packed import packed
from seacrane.hydro.memory import fit as fitting
from seacrane.hydro.memory.by_motion import fit_by_motion
from seacrane.hydro.memory.fit import LIMIT
from seacrane.hydro.memory.motion_judge import motion_judge
from seacrane.hydro.vessel.parameters import growth_rate, time_domain_vessel
from seacrane.scene.file import scene_digest
from seacrane.sea import jonswap
from seacrane.warnings import MemoryFitWarning


@cache
def fitted(limit: float = 0.01) -> MemoryModel:
    """Of the shipped hull."""
    return fit_memory(database=shipped_database(), kind="by-motion", limit=limit)


def test_the_shipped_hull_keeps_the_limit_with_few_states() -> None:
    model, per_pair = fitted(), shipped_database().memory
    assert model.motion.reached and model.motion.error.worst <= 0.01
    assert model.motion.floor < 0.005
    assert model.states <= 32
    assert passivity_certificate(model).passive
    assert growth_rate(time_domain_vessel(shipped_database(), memory=model)) < 1e-9
    judge = motion_judge(shipped_database(), model.band)
    assert judge.error_of(per_pair).worst > 3.0 * model.motion.error.worst
    floor = judge.error_of(retardation_functions(database=shipped_database())).worst
    assert floor == pytest.approx(model.motion.floor, rel=1e-9)
    wide = fitted(0.05)
    assert wide.motion.error.worst <= 0.05
    assert wide.states < model.states


@pytest.mark.parametrize(("tp", "heading"), [(6.0, 2.6), (12.0, np.pi / 2.0)])
def test_the_linear_model_finds_the_same_differences(tp: float, heading: float) -> None:
    """The scene's linear model with the fit against that with the database's matrices, another way to it."""
    database, model = shipped_database(), fitted()
    scene = cases.vessel(hs=0.0, memory="by-motion")
    omega = np.linspace(*model.band, 400)
    density = np.asarray(jonswap(hs=1.0, tp=tp).density(omega))[:, None]

    def rao(heading: float, memory: str) -> Array:
        asked = {"database": database, "omega": omega, "body": "vessel"}
        return motion_rao(scene, direction=heading, memory=memory, **asked)

    def std(rao: Array) -> Array:
        return np.sqrt(np.trapezoid(np.abs(rao) ** 2 * density, omega, axis=0))

    largest = np.max([std(rao(h, "database")) for h in database.heading[::6]], axis=0)
    share = std(rao(heading, "scene") - rao(heading, "database")) / largest
    assert 1e-4 < share.max() < 0.012


def disturbed(pairs: dict[tuple[int, int], float]) -> HydroDatabase:
    """The shipped hull with noise of a share of the diagonals in some pairs."""
    database = shipped_database()
    added, damping = database.added_mass.copy(), database.damping.copy()
    noise = np.random.default_rng(3).normal(size=(len(database.omega), 2))
    for (j, k), share in pairs.items():
        for table, column in ((added, noise[:, 0]), (damping, noise[:, 1])):
            scale = np.sqrt(np.ptp(table[:, j, j]) * np.ptp(table[:, k, k]))
            table[:, j, k] = table[:, k, j] = share * scale * column
    return dataclasses.replace(database, added_mass=added, damping=damping, memory=None)


@pytest.mark.parametrize(
    ("noise", "groups"),
    [
        ({(0, 1): 1e-3, (2, 3): 1e-3, (4, 5): 1e-3}, {(0, 2, 4), (1, 3, 5)}),  # that symmetry forbids
        ({(0, 2): 2e-4, (2, 4): 2e-4}, {(0, 4), (2,), (1, 3, 5)}),  # that no motion feels
    ],
)
def test_noise_is_not_fitted(noise: dict[tuple[int, int], float], groups: set[tuple[int, ...]]) -> None:
    model = fit_memory(database=disturbed(noise), kind="by-motion", limit=0.05)
    assert set(model.motion.left_out) == set(noise)
    assert {tuple(block.outputs) for block in model.blocks} == groups
    assert np.all(model.added_mass[[0, 2, 4]][:, [1, 3, 5]] == 0.0)


def test_runs_and_files_take_it(tmp_path: Path) -> None:
    database = dataclasses.replace(shipped_database(), memory=fitted())
    database.save(tmp_path / "ship.nc")
    again = load_database(tmp_path / "ship.nc").memory
    assert packed(again) == packed(fitted())
    np.testing.assert_array_equal(again.motion.error.seas, fitted().motion.error.seas)
    rows = {row.check: row for row in database.check()}
    assert rows["memory_motion_error"].verdict == "pass"


def never(**_: object) -> MemoryModel:
    raise AssertionError("fitted again")


def test_a_fit_is_found_on_disk_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fit(database: HydroDatabase, limit: float = 0.2) -> MemoryModel:
        monkeypatch.setattr(fitting, "_of_process", {})
        return fit_memory(database=database, kind="by-motion", limit=limit)

    monkeypatch.setenv("SEACRANE_CACHE", str(tmp_path))
    database = shipped_database()
    first = fit(database)
    (file,) = (tmp_path / "memory").iterdir()
    real = fitting.fit_by_motion
    monkeypatch.setattr(fitting, "fit_by_motion", never)
    again = fit(database)
    assert packed(again) == packed(first)
    assert again.motion.error.worst == first.motion.error.worst
    for other in ((dataclasses.replace(database, damping=1.01 * database.damping),), (database, 0.3)):
        with pytest.raises(AssertionError, match="fitted again"):
            fit(*other)
    file.write_bytes(file.read_bytes()[:500])
    monkeypatch.setattr(fitting, "fit_by_motion", real)
    assert packed(fit(database)) == packed(first)


def test_a_fit_per_pair_leaves_noise_out_too() -> None:
    """Of pairs that symmetry forbids, and of pairs a hundred-thousandth of their diagonals."""
    noisy = disturbed({(0, 1): 1e-3, (2, 3): 1e-3, (0, 2): 1e-5, (2, 4): 1e-5})
    pairs = {(row.output, row.input) for row in fit_memory(database=noisy, kind="per-pair", r2=0.9).rows}
    assert pairs == {*((i, i) for i in range(6)), (0, 4), (1, 3), (1, 5), (3, 5)}


def test_about_another_point_the_motions_of_that_point_are_judged() -> None:
    """Moved up and forward: heave there holds pitch; turned over to the other side nothing changes."""
    database = dataclasses.replace(shipped_database(), memory=fitted())
    moved = database.at((30.0, 0.0, 5.0)).memory
    assert moved.motion.error.seas[2] != pytest.approx(fitted().motion.error.seas[2], rel=1e-3)
    assert moved.motion.error.seas[3] == pytest.approx(fitted().motion.error.seas[3], rel=0.05)
    assert moved.motion.error.worst < 0.02
    mirrored = database.mirror().memory
    assert mirrored is not None and mirrored.motion is fitted().motion


def afloat(database: HydroDatabase, **options: object) -> Scene:
    scene = Scene(name="afloat")
    scene.add_vessel(database, **options)
    return scene


def hull(**changes: object) -> HydroDatabase:
    return dataclasses.replace(shipped_database(), **({"memory": None, "motion_rao": None} | changes))


def test_a_vessel_has_memory_by_motion() -> None:
    """Whatever its database holds; the cases are the paper's."""
    own = shipped_database()
    assert own.memory.motion is None
    scene = afloat(own)
    known = scene.provenance["vessel"]
    assert known.memory == "by-motion" and 0.0 < known.memory_error <= LIMIT
    assert scene.compile().memory_states == fitted().states < 30
    assert scene_digest(scene) == scene_digest(afloat(own, memory="by-motion"))
    assert cases.vessel().provenance["vessel"].memory == "per-pair"
    settings = simulate(scene, t_end=1.0).settings
    assert settings["memory"] == "by-motion" and settings["memory_error"] == known.memory_error
    lift: dict[str, Any] = {"vessel": {"database": "hull_115"}}
    assert Lift(lift).scene().compile().memory_states == fitted().states
    lift["vessel"]["memory"] = "per-pair"
    assert Lift(lift).scene().compile().memory_states == 69


def test_the_shipped_model_is_a_fresh_fit() -> None:
    """`python tools/ship_memory.py` writes it: run it after the hull's data or the fit changed.

    The fit ends elsewhere within its limit on another processor, whose rounding differs.
    """
    database, shipped = shipped_database(), fitted()
    assert len(list(fitting.shipped_folder().iterdir())) == 1
    fresh = fit_by_motion(database=database, band=shipped.band, known=None, limit=LIMIT)
    assert fresh.states == shipped.states
    judged = motion_judge(database, shipped.band).error_of(shipped).worst
    assert judged == pytest.approx(shipped.motion.error.worst, rel=1e-6)
    assert fresh.motion.reached and fresh.motion.error.worst <= LIMIT
    one, other = shipped.transfer(database.omega), fresh.transfer(database.omega)
    assert np.abs(one - other).max(axis=0) == pytest.approx(0.0, abs=1e-2 * np.abs(one).max())


def test_the_databases_band_is_that_of_the_fit_and_without_one_the_whole_table() -> None:
    """As of a panel code that states none: 0.1 to 3.1 rad/s."""
    assert fit_memory(database=hull(trusted_band=(0.45, 0.9)), limit=0.2).band == (0.45, 0.9)
    model = fit_memory(database=hull(trusted_band=None))
    assert model.band == (0.1, 3.1)
    assert model.motion.reached


def test_a_motion_without_damping_has_no_memory() -> None:
    """Its added mass is constant; what that costs is named."""
    undamped = shipped_database().damping.copy()
    undamped[:, 2, :] = undamped[:, :, 2] = 0.0
    model = fit_memory(database=hull(damping=undamped), limit=0.2)
    assert all(2 not in block.outputs for block in model.blocks)
    assert {(2, 2), (0, 2), (2, 4)} <= set(model.motion.left_out)
    with pytest.warns(MemoryFitWarning, match=r"0\.01"):
        assert afloat(hull(damping=np.zeros_like(undamped))).compile().memory_states == 0
