"""Passive memory: its proof checked independently, its fit, its energy, its run, and what it trades."""

from __future__ import annotations

import dataclasses
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import simulate
from seacrane.cases import case1
from seacrane.errors import PassivityError
from seacrane.hydro import (
    HydroDatabase,
    MemoryBlock,
    MemoryModel,
    fit_memory,
    load_database,
    memory_rows,
    passivity_certificate,
    require_passive,
    shipped_database,
)
from seacrane.hydro.data.memory_model import RADIATION
from seacrane.hydro.memory.certificate import certify
from seacrane.hydro.memory.identification import r_squared
from seacrane.hydro.memory.oscillators import GroupData, Oscillators, Problem, fit_oscillators
from seacrane.warnings import InfiniteFrequencyWarning

Array = np.ndarray


@pytest.fixture(scope="module")
def hull() -> MemoryModel:
    return fit_memory(database=shipped_database(), kind="passive")


@pytest.fixture(scope="module")
def supply(shared: Path) -> tuple[HydroDatabase, MemoryModel]:
    database = load_database(shared / "veres" / "supply")
    with pytest.warns(InfiniteFrequencyWarning):
        return database, fit_memory(database=database, kind="passive")


@pytest.fixture(params=["hull", pytest.param("supply", marks=pytest.mark.slow("fits a memory to a file"))])
def ship(request: pytest.FixtureRequest) -> tuple[HydroDatabase, MemoryModel]:
    own = request.getfixturevalue(request.param)
    return own if request.param == "supply" else (shipped_database(), own)


def radiation(model: MemoryModel) -> list[MemoryBlock]:
    return [block for block in model.blocks if block.cause == RADIATION]


def scaled_damping(blocks: list[MemoryBlock], omega: Array) -> Array:
    """Re K (n, m, m) of the motions in use, each scaled by the root of its largest damping."""
    total = np.zeros((len(omega), 6, 6))
    for block in blocks:
        for i, w in enumerate(omega):
            kernel = block.C @ np.linalg.solve(1j * w * np.eye(len(block.A)) - block.A, block.B) + block.D
            total[i][np.ix_(block.outputs, block.inputs)] += kernel.real
    peak = np.sqrt(np.diagonal(total, axis1=1, axis2=2).max(axis=0))
    used = np.flatnonzero(peak > 0.0)
    scaled = total[:, used][:, :, used] / np.outer(peak[used], peak[used])
    return np.asarray(0.5 * (scaled + scaled.swapaxes(1, 2)))


def test_damping_and_energy_prove_that_it_is_passive(ship: tuple[HydroDatabase, MemoryModel]) -> None:
    """Re K(i w) >= margin w^2 / (1 + w^2)^2 from 1e-3 to 1e3 rad/s; A + A^T <= 0 and B = C^T with P = I."""
    _, model = ship
    omega = np.geomspace(1e-3, 1e3, 1500)
    lowest = np.linalg.eigvalsh(scaled_damping(radiation(model), omega))[:, 0]
    certificate = passivity_certificate(model)
    assert certificate.passive and certificate.energy and certificate.crossings == ()
    weighted = lowest * (1.0 + omega**2) ** 2 / omega**2
    # Scaled alike but for the grid on which the largest damping was sought.
    assert weighted.min() == pytest.approx(certificate.margin, rel=0.01)
    assert certificate.margin > 0.02
    assert model.passivity.minimum > 0.0 and model.passivity.in_band > 0.0
    for block in radiation(model):
        assert np.array_equal(block.B, block.C.T) and not np.any(block.D)
        assert np.linalg.eigvalsh(block.A + block.A.T).max() <= 1e-13
        assert block.poles.real.max() < -0.04
        still = block.C @ np.linalg.solve(block.A, block.B)
        assert np.abs(still).max() < 1e-10 * np.abs(block.C @ block.B).max()


@pytest.mark.warns(sometimes=["InfiniteFrequencyWarning"])
def test_every_pair_follows_the_data_with_fewer_states(ship: tuple[HydroDatabase, MemoryModel]) -> None:
    database, model = ship
    inside = (database.omega >= model.band[0] - 1e-9) & (database.omega <= model.band[1] + 1e-9)
    added_mass, damping = model.frequency_response(database.omega)
    entries = [(row.output, row.input) for row in model.rows if row.cause == RADIATION]
    per_pair = fit_memory(database=database, kind="per-pair")
    wanted = {(row.output, row.input) for row in per_pair.rows if row.cause == RADIATION}
    assert set(entries) == wanted
    for j, k in [*entries, *((k, j) for j, k in entries)]:
        assert r_squared(database.added_mass[inside, j, k], added_mass[inside, j, k]) >= 0.99
        assert r_squared(database.damping[inside, j, k], damping[inside, j, k]) >= 0.99
    assert all(row.accepted for row in model.rows)
    states = sum(len(block.A) for block in radiation(model))
    assert 2 * states < 1.2 * sum(len(block.A) for block in radiation(per_pair))
    checks = {row.check: row for row in memory_rows(database, model)}
    assert checks["memory_passivity_everywhere"].verdict == "pass"
    assert checks["vessel_with_memory_growth_per_s"].verdict == "pass"
    longitudinal = [0, 2, 4] if np.any(database.damping[:, 0, 0]) else [2, 4]
    assert [block.inputs.tolist() for block in radiation(model)] == sorted([longitudinal, [1, 3, 5]])


def test_any_oscillators_are_passive() -> None:
    omega = np.geomspace(0.01, 50.0, 60)
    for seed in range(40):
        random = np.random.default_rng(seed)
        masses = 3 + seed % 4
        factor, w = random.normal(size=(masses, masses)), random.uniform(0.3, 3.0, masses)
        dampers = factor @ factor.T + 0.1 * np.eye(masses)
        model = Oscillators(w=w, dampers=dampers, coupling=random.normal(size=(masses, 3)))
        a, b, c = model.state_space()
        of: dict[str, Any] = {"cause": RADIATION, "outputs": np.arange(3), "inputs": np.arange(3)}
        block = MemoryBlock(**of, A=a, B=b, C=c, D=np.zeros((3, 3)), state_scale=np.ones(len(a)))
        assert block.transfer(omega) == pytest.approx(model.transfer(omega), rel=1e-8, abs=1e-9)
        certificate = certify([block])
        assert certificate.passive and certificate.energy and certificate.margin > 0.0


def test_a_model_that_is_not_passive_is_refused(hull: MemoryModel) -> None:
    """The shipped per-pair model is not (docs); gain at infinity and a pole that grows are named."""
    memory = shipped_database().memory
    certificate = passivity_certificate(memory)
    assert not certificate.passive and not certificate.energy and certificate.margin < 0.0
    with pytest.raises(PassivityError, match="not passive"):
        require_passive(memory)
    block = radiation(hull)[0]
    c = block.C.copy()
    c[0] *= 1.2
    grown = block.A + np.eye(len(block.A))
    for changes, reason in (({"C": c}, "towards infinite"), ({"A": grown}, "pole grows")):
        found = certify([dataclasses.replace(block, **changes)])
        assert not found.passive and reason in found.reason


def test_a_narrow_dip_below_zero_is_found(hull: MemoryModel) -> None:
    """One damper too weak: the pencil finds the frequencies where the grid's damping turns negative."""
    block = radiation(hull)[0]
    n = len(block.A) // 2
    dampers = -block.A[n:, n:]
    values, vectors = np.linalg.eigh(dampers)
    omega = np.geomspace(1e-3, 1e3, 3000)
    verdicts = []
    for share in np.linspace(0.5, 6.0, 12):  # of the weakest direction's own damping, taken away
        weaker = block.A.copy()
        weaker[n:, n:] += share * values[0] * np.outer(vectors[:, 0], vectors[:, 0])
        changed = dataclasses.replace(block, A=weaker)
        if changed.poles.real.max() >= 0.0:
            assert "pole grows" in certify([changed]).reason
            continue
        lowest = np.linalg.eigvalsh(scaled_damping([changed], omega))[:, 0]
        weighted = (lowest * (1.0 + omega**2) ** 2 / omega**2).min()
        certificate = certify([changed])
        assert certificate.passive == (weighted > 0.0)
        verdicts.append(certificate.passive)
    assert set(verdicts) == {True, False}


def test_a_known_system_is_recovered_by_a_search_with_the_right_derivatives() -> None:
    """Exact data of three masses behind two motions, with an infinite-frequency added mass."""
    factor = np.array([[0.8, 0.0, 0.0], [0.3, 0.9, 0.0], [-0.2, 0.4, 1.0]])
    coupling = np.array([[1.0, 0.3], [-0.2, 0.9], [0.4, -0.5]])
    dampers = factor @ factor.T + 0.1 * np.eye(3)
    truth = Oscillators(w=np.array([0.7, 1.1, 1.7]), dampers=dampers, coupling=coupling)
    omega = np.linspace(0.1, 3.0, 59)
    kernel = truth.transfer(omega)
    added_mass = np.array([[2.0, 0.3], [0.3, 1.5]]) + kernel.imag / omega[:, None, None]
    tables = {"added_mass": added_mass, "damping": kernel.real, "added_mass_infinite": None}
    data = GroupData(omega=omega, trusted=(omega > 0.29) & (omega < 2.51), **tables)
    model = fit_oscillators(data, fit_oscillators(data, None))
    assert len(model.w) == 3
    assert np.abs(model.transfer(data.omega).real - data.damping).max() < 0.01 * data.damping.max()
    problem = Problem(data, 4)
    at = np.random.default_rng(2).normal(size=4 + 10 + 8) * 0.7
    exact = problem.jacobian(at)
    for i, shift in enumerate(1e-6 * np.eye(len(at))):
        slope = (problem.residual(at + shift) - problem.residual(at - shift)) / 2e-6
        assert exact[:, i] == pytest.approx(slope, rel=1e-5, abs=1e-6 * np.abs(exact).max())


def test_a_weak_pair_is_judged_by_the_motions() -> None:
    """Noise in place of pair 13, at 0.3 % of its diagonals, follows no model and moves nothing."""
    base = shipped_database()
    damping, added_mass = base.damping.copy(), base.added_mass.copy()
    peak = 0.003 * np.sqrt(damping[:, 0, 0].max() * damping[:, 2, 2].max())
    noise = peak * (-1.0) ** (np.arange(len(base.omega)) + 1) * (base.omega / base.omega[-1]) ** 2
    for j, k in ((0, 2), (2, 0)):
        damping[:, j, k], added_mass[:, j, k] = noise, 0.0
    database = dataclasses.replace(base, damping=damping, added_mass=added_mass, memory=None)
    model = fit_memory(database=database, kind="passive", r2=0.98)
    row = next(row for row in model.rows if (row.output, row.input) == (0, 2))
    assert row.r2_damping < 0.9 and row.accepted
    assert all(row.accepted for row in model.rows)


def test_runs_stay_close_to_the_per_pair_model() -> None:
    """Both models state R2 >= 0.99, a misfit of 10 % rms of the memory's share: motions differ by less."""
    given = {"t_end": 60.0, "dt_out": 0.5, "channels": ["vessel_motion"]}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        one, other = (
            simulate(case1(memory=kind), **given)["vessel_motion"] for kind in ("per-pair", "passive")
        )
    difference = np.sqrt(np.mean((other - one) ** 2, axis=0) / np.mean(one**2, axis=0))
    assert np.all(difference < 0.1) and difference.max() > 1e-5
