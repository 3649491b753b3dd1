"""Fluid memory chosen by what it does to the motions, its limit, and the models kept from before."""

from __future__ import annotations

import dataclasses
import warnings
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import cases, load_database, motion_rao, simulate
from seacrane.hydro import (
    HydroDatabase,
    MemoryModel,
    fit_memory,
    passivity_certificate,
    retardation_functions,
    shipped_database,
    vessel_parameters,
)
from seacrane.hydro.data.packed import packed
from seacrane.hydro.memory import cache as kept
from seacrane.hydro.memory import fit as fitting
from seacrane.hydro.memory.motion_judge import motion_judge
from seacrane.hydro.memory.oscillator_motions import MotionData, MotionProblem
from seacrane.hydro.memory.oscillators import GroupData, first_guess
from seacrane.hydro.vessel.memory_stability import largest_growth_rate
from seacrane.sea import jonswap
from seacrane.warnings import MemoryFitWarning

Array = NDArray[np.float64]


@cache
def fitted(limit: float = 0.01) -> MemoryModel:
    """Of the shipped hull."""
    return fit_memory(database=shipped_database(), kind="by-motion", limit=limit)


def tanker(shared: Path) -> HydroDatabase:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return load_database(shared / "wamit")


def test_the_shipped_hull_keeps_the_limit_with_few_states() -> None:
    model = fitted()
    assert model.motion is not None
    assert model.motion.reached
    assert model.motion.error.worst <= 0.01
    assert model.motion.floor < 0.005
    assert model.states <= 32
    assert passivity_certificate(model).passive
    assert largest_growth_rate(shipped_database(), model) < 1e-9
    per_pair = shipped_database().memory
    assert per_pair is not None
    judge = motion_judge(shipped_database(), model.band)
    assert judge.error_of(per_pair).worst > 3.0 * model.motion.error.worst
    floor = judge.error_of(retardation_functions(database=shipped_database())).worst
    assert floor == pytest.approx(model.motion.floor, rel=1e-9)


@pytest.mark.parametrize(("tp", "heading"), [(6.0, 2.6), (9.0, 0.7), (12.0, np.pi / 2.0), (17.0, np.pi)])
def test_the_linear_model_finds_the_same_differences(tp: float, heading: float) -> None:
    """The scene's linear model with the fit against that with the database's matrices, another way to it."""
    database, model = shipped_database(), fitted()
    scene = cases.vessel(hs=0.0, memory="by-motion")
    omega = np.linspace(*model.band, 400)
    options = {"database": database, "omega": omega, "body": "vessel"}
    asked = options | {"direction": heading}
    own, data = (motion_rao(scene, memory=kind, **asked) for kind in ("scene", "database"))
    largest = np.max(
        [
            _std(motion_rao(scene, direction=h, memory="database", **options), omega, tp)
            for h in database.heading[::6]
        ],
        axis=0,
    )
    share = _std(own - data, omega, tp) / largest
    assert share.max() < 0.012
    assert share.max() > 1e-4


def _std(rao: Array, omega: Array, tp: float) -> Array:
    density = np.asarray(jonswap(hs=1.0, tp=tp).density(omega))
    return np.sqrt(np.trapezoid(np.abs(rao) ** 2 * density[:, None], omega, axis=0))


def test_a_wider_limit_takes_fewer_states() -> None:
    wide = fitted(0.05)
    assert wide.motion is not None
    assert wide.motion.error.worst <= 0.05
    assert wide.states < fitted().states


def test_the_tanker_keeps_the_limit(shared: Path) -> None:
    """The fits of its pairs err by 6 % of heave."""
    model = fit_memory(database=tanker(shared), kind="by-motion")
    assert model.motion is not None
    assert model.motion.reached
    assert model.states <= 32


@pytest.mark.slow("fits")
def test_what_stops_a_fit_is_named(shared: Path) -> None:
    """The supply ship's tanks break the Kramers-Kronig relation: a convolution is 4 % off."""
    database = load_database(shared / "veres" / "supply")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = fit_memory(database=database, kind="by-motion")
    assert model.motion is not None
    assert not model.motion.reached
    assert model.motion.error.worst < model.motion.floor < 0.06
    with pytest.warns(
        MemoryFitWarning, match=r"errs by 0\.0\d+ of roll in a sea, at best, and its limit is 0.01 .*Kramers"
    ):
        vessel_parameters(database, memory=model)


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


def test_noise_in_pairs_that_symmetry_forbids_is_not_fitted() -> None:
    noisy = disturbed({(0, 1): 1e-3, (2, 3): 1e-3, (4, 5): 1e-3})
    model = fit_memory(database=noisy, kind="by-motion", limit=0.05)
    assert model.motion is not None
    assert set(model.motion.left_out) == {(0, 1), (2, 3), (4, 5)}
    assert model.states == fitted(0.05).states
    assert np.all(model.added_mass[[0, 2, 4]][:, [1, 3, 5]] == 0.0)


def test_noise_that_no_motion_feels_is_not_fitted() -> None:
    """As of a hull alike fore and aft: no model couples heave with surge and pitch."""
    noisy = disturbed({(0, 2): 2e-4, (2, 4): 2e-4})
    model = fit_memory(database=noisy, kind="by-motion", limit=0.05)
    assert model.motion is not None
    assert set(model.motion.left_out) == {(0, 2), (2, 4)}
    groups = {tuple(block.outputs) for block in model.blocks}
    assert groups == {(0, 4), (2,), (1, 3, 5)}


def test_the_search_has_the_exact_derivative() -> None:
    database = shipped_database()
    judge = motion_judge(database, (0.3, 2.5))
    omega, group = database.omega[4:50:3], [0, 2, 4]
    square = np.ix_(range(len(omega)), group, group)
    a, b = (table(omega)[square] for table in (judge.table.added_mass, judge.table.damping))
    scale = np.sqrt(b.max(axis=0).diagonal())
    product = np.outer(scale, scale)
    data = GroupData(
        omega=omega,
        added_mass=a / product,
        damping=b / product,
        trusted=omega > 0.0,
        added_mass_infinite=None,
    )
    pairs = np.triu_indices(3)
    problem = MotionProblem(MotionData(group=data, lever=judge.lever(omega, group) * product[pairs]), 3)
    at = problem.pack(first_guess(data))
    slope = problem.slope(at)
    for i in range(len(at)):
        step = np.zeros_like(at)
        step[i] = 1e-6
        found = (problem.misfit(at + step) - problem.misfit(at - step)) / 2e-6
        np.testing.assert_allclose(slope[:, i], found, atol=1e-6 * np.abs(slope).max())


def test_a_misfit_moves_the_motions_as_the_lever_says() -> None:
    """To first order: the sum of squares of the weighted motions is that over motions, headings and seas."""
    database = shipped_database()
    judge = motion_judge(database, (0.3, 2.5))
    w, group = judge.omega, [0, 2, 4]
    pairs = [(group[j], group[k]) for j, k in zip(*np.triu_indices(3), strict=True)]
    misfit = np.zeros((len(w), 6, 6), dtype=complex)
    small = np.zeros((len(w), 6))
    for n, (j, k) in enumerate(pairs):
        small[:, n] = 1e-6 * np.sqrt(judge.damping[:, j, j] * judge.damping[:, k, k])
        misfit[:, j, k] = misfit[:, k, j] = 1j * w * small[:, n]
    by_lever = np.sum(np.abs(np.einsum("nqp,np->nq", judge.lever(w, group), small)) ** 2)
    moved = np.linalg.solve(judge.solved.impedance + misfit, judge.solved.force[..., None])[..., 0]
    apart = np.abs(moved - judge.motion)[:, :, group] ** 2
    direct = np.sum(np.einsum("sn,mni->smi", judge.weights, apart) / judge.variance[:, None, group])
    assert by_lever == pytest.approx(direct, rel=1e-4)


def test_runs_and_files_take_it(tmp_path: Path) -> None:
    scene = cases.vessel(memory="by-motion")
    run = simulate(scene, t_end=5.0, channels=["vessel_motion", "energy_balance"])
    assert np.all(np.isfinite(run["vessel_motion"]))
    database = dataclasses.replace(shipped_database(), memory=fitted())
    database.save(tmp_path / "ship.nc")
    again = load_database(tmp_path / "ship.nc").memory
    assert again is not None and again.motion is not None and fitted().motion is not None
    np.testing.assert_array_equal(again.motion.error.seas, fitted().motion.error.seas)
    np.testing.assert_array_equal(again.motion.error.peaks, fitted().motion.error.peaks)
    assert again.motion.left_out == fitted().motion.left_out
    assert again.motion.limit == 0.01
    rows = {row.check: row for row in database.check()}
    assert rows["memory_motion_error"].verdict == "pass"


@pytest.mark.parametrize("limit", [0.0, 1.0, -0.1, float("nan")])
def test_limits_out_of_range_are_refused(limit: float) -> None:
    with pytest.raises(ValueError, match=r"limit is .*; give a number between 0 and 1"):
        fit_memory(database=shipped_database(), kind="by-motion", limit=limit)


# Models kept from before


def same(first: MemoryModel, second: MemoryModel) -> bool:
    return packed(first) == packed(second)


def test_a_fit_is_found_on_disk_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SEACRANE_CACHE", str(tmp_path))
    monkeypatch.setattr(kept, "_of_process", {})
    database = shipped_database()
    first = fit_memory(database=database, kind="by-motion", limit=0.2)
    files = list((tmp_path / "memory").iterdir())
    assert [file.suffix for file in files] == [".memory"]
    monkeypatch.setattr(kept, "_of_process", {})
    real = fitting.fit_by_motion

    def never(**_: object) -> MemoryModel:
        raise AssertionError("fitted again")

    monkeypatch.setattr(fitting, "fit_by_motion", never)
    again = fit_memory(database=database, kind="by-motion", limit=0.2)
    assert same(first, again)
    assert again.motion is not None and first.motion is not None
    assert again.motion.error.worst == first.motion.error.worst
    changed = dataclasses.replace(database, damping=1.01 * database.damping)
    for other in ({"database": changed, "limit": 0.2}, {"database": database, "limit": 0.3}):
        with pytest.raises(AssertionError, match="fitted again"):
            fit_memory(kind="by-motion", **other)
    files[0].write_bytes(files[0].read_bytes()[:500])
    monkeypatch.setattr(kept, "_of_process", {})
    monkeypatch.setattr(fitting, "fit_by_motion", real)
    assert same(first, fit_memory(database=database, kind="by-motion", limit=0.2))


def test_nothing_is_written_where_it_is_switched_off(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(kept, "_of_process", {})
    fit_memory(database=shipped_database(), kind="by-motion", limit=0.2)
    assert not list(tmp_path.iterdir())
    monkeypatch.delenv("SEACRANE_CACHE")
    assert kept.cache_folder() == tmp_path / "seacrane" / "memory"


def test_a_fit_per_pair_leaves_noise_out_too() -> None:
    """Of pairs that symmetry forbids, and of pairs a hundred-thousandth of their diagonals."""
    noisy = disturbed({(0, 1): 1e-3, (2, 3): 1e-3, (0, 2): 1e-5, (2, 4): 1e-5})
    pairs = {(row.output, row.input) for row in fit_memory(database=noisy, kind="per-pair", r2=0.9).rows}
    assert pairs == {*((i, i) for i in range(6)), (0, 4), (1, 3), (1, 5), (3, 5)}


def test_about_another_point_the_motions_of_that_point_are_judged() -> None:
    """Moved up and forward: heave there holds pitch; turned over to the other side nothing changes."""
    database = dataclasses.replace(shipped_database(), memory=fitted())
    moved = database.at((30.0, 0.0, 5.0)).memory
    assert moved is not None and moved.motion is not None and fitted().motion is not None
    assert moved.motion.error.seas[2] != pytest.approx(fitted().motion.error.seas[2], rel=1e-3)
    assert moved.motion.error.seas[3] == pytest.approx(fitted().motion.error.seas[3], rel=0.05)
    assert moved.motion.error.worst < 0.02
    mirrored = database.mirror().memory
    assert mirrored is not None and mirrored.motion is fitted().motion
