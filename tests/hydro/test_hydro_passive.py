"""Passive memory: its proof checked independently, its fit, its energy, its run, and what it trades."""

from __future__ import annotations

import dataclasses
import json
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.linalg import eig, expm, solve_continuous_lyapunov

from seacrane import Scene, simulate
from seacrane.cases import case1, vessel
from seacrane.cli import main
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
    vessel_parameters,
)
from seacrane.hydro.data.memory_model import RADIATION
from seacrane.hydro.memory import passive
from seacrane.hydro.memory.certificate import certify
from seacrane.hydro.memory.identification import r_squared
from seacrane.hydro.memory.oscillators import GroupData, Oscillators, Problem, first_guess, fit_oscillators
from seacrane.hydro.memory.passive import motion_groups
from seacrane.warnings import InfiniteFrequencyWarning, MemoryFitWarning

Array = NDArray[np.float64]


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
    if request.param == "hull":
        return shipped_database(), request.getfixturevalue("hull")
    database, model = request.getfixturevalue("supply")
    return database, model


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


def with_dampers(block: MemoryBlock, change: Array) -> MemoryBlock:
    """The block with ``change`` added to its masses' damping matrix."""
    a, n = block.A.copy(), len(block.A) // 2
    a[n:, n:] -= change
    return dataclasses.replace(block, A=a)


def test_the_damping_is_positive_far_beyond_the_band(ship: tuple[HydroDatabase, MemoryModel]) -> None:
    """Re K(i w) >= margin w^2 / (1 + w^2)^2 at every frequency from 1e-3 to 1e3 rad/s."""
    _, model = ship
    omega = np.geomspace(1e-3, 1e3, 1500)
    lowest = np.linalg.eigvalsh(scaled_damping(radiation(model), omega))[:, 0]
    certificate = passivity_certificate(model)
    assert certificate.passive and certificate.energy and certificate.crossings == ()
    weighted = lowest * (1.0 + omega**2) ** 2 / omega**2
    assert weighted.min() > 0.0
    # Scaled alike but for the grid on which the largest damping was sought.
    assert weighted.min() == pytest.approx(certificate.margin, rel=0.01)
    assert certificate.margin > 0.02
    assert model.passivity.minimum > 0.0 and model.passivity.in_band > 0.0


def test_the_energy_is_a_certificate(ship: tuple[HydroDatabase, MemoryModel]) -> None:
    """P > 0, A^T P + P A <= 0 and P B = C^T with P = I, and no pole on the axis."""
    _, model = ship
    for block in radiation(model):
        assert np.array_equal(block.B, block.C.T) and not np.any(block.D)
        assert np.linalg.eigvalsh(block.A + block.A.T).max() <= 1e-13
        assert block.poles.real.max() < -0.04
        still = block.C @ np.linalg.solve(block.A, block.B)
        assert np.abs(still).max() < 1e-10 * np.abs(block.C @ block.B).max()


def test_the_hamiltonian_has_no_imaginary_eigenvalue(ship: tuple[HydroDatabase, MemoryModel]) -> None:
    """``K + K^~`` loses rank where ``[[A, 0, B], [0, -A^T, -C^T], [C, B^T, 0]] - s diag(I, I, 0)`` does.

    Solved here as a generalised problem with nothing divided out: beside the zeros at 0 and infinity, left
    out by their size, no eigenvalue is near the axis.
    """
    _, model = ship
    for block in radiation(model):
        k, m = len(block.A), len(block.inputs)
        peak = np.linalg.norm(block.C, axis=1)
        b, c = block.B / peak, block.C / peak[:, None]
        left = np.zeros((2 * k + m, 2 * k + m))
        left[:k, :k], left[:k, 2 * k :] = block.A, b
        left[k : 2 * k, k : 2 * k], left[k : 2 * k, 2 * k :] = -block.A.T, -c.T
        left[2 * k :, :k], left[2 * k :, k : 2 * k] = c, b.T
        right = np.diag(np.concatenate([np.ones(2 * k), np.zeros(m)]))
        values = eig(left, right, right=False)
        values = values[np.isfinite(values)]
        middle = values[(np.abs(values) > 1e-2) & (np.abs(values) < 1e2)]
        assert len(middle) >= 2 * k - 4 * m
        assert np.min(np.abs(middle.real) / np.abs(middle)) > 1e-3


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


def test_groups_come_from_the_data(ship: tuple[HydroDatabase, MemoryModel]) -> None:
    database, model = ship
    longitudinal = [0, 2, 4] if np.any(database.damping[:, 0, 0]) else [2, 4]
    assert [block.inputs.tolist() for block in radiation(model)] == sorted([longitudinal, [1, 3, 5]])
    assert motion_groups([(0, 0), (5, 5), (0, 2), (2, 4), (1, 3)]) == [[0, 2, 4], [1, 3], [5]]
    assert motion_groups([(0, 1), (2, 3), (1, 2)]) == [[0, 1, 2, 3]]


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), steps=st.integers(5, 80), hold=st.floats(0.05, 5.0))
def test_memory_never_gives_energy(hull: MemoryModel, seed: int, steps: int, hold: float) -> None:
    """Work of any piecewise constant velocity on the memory from rest is at least the energy it holds."""
    random = np.random.default_rng(seed)
    for block in radiation(hull):
        k, m = len(block.A), len(block.inputs)
        # d/dt (x, u, int mu dt): x' = A x + B u, mu = C x, exactly over one hold.
        chain = np.zeros((k + 2 * m, k + 2 * m))
        chain[:k, :k], chain[:k, k : k + m], chain[k + m :, :k] = block.A, block.B, block.C
        step = expm(chain * hold)
        x, work = np.zeros(k), 0.0
        size = random.choice([1e-3, 1.0]) / np.linalg.norm(block.C, axis=1)
        for _ in range(steps):
            velocity = random.normal(size=m) * size
            after = step @ np.concatenate([x, velocity, np.zeros(m)])
            work += float(velocity @ after[k + m :])
            x = after[:k]
            assert work >= 0.5 * float(x @ x) * (1.0 - 1e-9)


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), masses=st.integers(3, 6))
def test_any_oscillators_are_passive(seed: int, masses: int) -> None:
    random = np.random.default_rng(seed)
    factor = random.normal(size=(masses, masses))
    model = Oscillators(
        w=random.uniform(0.3, 3.0, masses),
        dampers=factor @ factor.T + 0.1 * np.eye(masses),
        coupling=random.normal(size=(masses, 3)),
    )
    a, b, c = model.state_space()
    block = block_of(a, b, c)
    omega = np.geomspace(0.01, 50.0, 60)
    assert block.transfer(omega) == pytest.approx(model.transfer(omega), rel=1e-8, abs=1e-9)
    certificate = certify([block])
    assert certificate.passive and certificate.energy and certificate.margin > 0.0


def block_of(a: Array, b: Array, c: Array) -> MemoryBlock:
    """Radiation block of the first motions."""
    m = b.shape[1]
    return MemoryBlock(
        cause=RADIATION,
        outputs=np.arange(m),
        inputs=np.arange(m),
        A=a,
        B=b,
        C=c,
        D=np.zeros((m, m)),
        state_scale=np.ones(len(a)),
    )


def test_a_model_that_is_not_passive_is_refused(hull: MemoryModel) -> None:
    """The shipped per-pair model is not (docs): the exception says so and where."""
    database = shipped_database()
    assert database.memory is not None
    certificate = passivity_certificate(database.memory)
    assert not certificate.passive and not certificate.energy and certificate.margin < 0.0
    with pytest.raises(PassivityError, match="not passive: its damping is not positive"):
        require_passive(database.memory)
    assert require_passive(hull).passive


def test_a_narrow_dip_below_zero_is_found(hull: MemoryModel) -> None:
    """One damper too weak: the pencil finds the frequencies where the grid's damping turns negative."""
    block = radiation(hull)[0]
    n = len(block.A) // 2
    dampers = -block.A[n:, n:]
    values, vectors = np.linalg.eigh(dampers)
    omega = np.geomspace(1e-3, 1e3, 3000)
    verdicts = []
    for share in np.linspace(0.5, 6.0, 12):  # of the weakest direction's own damping, taken away
        changed = with_dampers(block, -share * values[0] * np.outer(vectors[:, 0], vectors[:, 0]))
        if changed.poles.real.max() >= 0.0:
            assert "pole grows" in certify([changed]).reason
            continue
        lowest = np.linalg.eigvalsh(scaled_damping([changed], omega))[:, 0]
        weighted = (lowest * (1.0 + omega**2) ** 2 / omega**2).min()
        certificate = certify([changed])
        assert certificate.passive == (weighted > 0.0)
        verdicts.append(certificate.passive)
    assert set(verdicts) == {True, False}


def test_verdict_does_not_depend_on_the_coordinates(hull: MemoryModel) -> None:
    block = radiation(hull)[1]
    turn = np.random.default_rng(4).normal(size=block.A.shape)
    back = np.linalg.inv(turn)
    turned = dataclasses.replace(block, A=turn @ block.A @ back, B=turn @ block.B, C=block.C @ back)
    first, second = certify([block]), certify([turned])
    assert second.passive and not second.energy
    assert second.margin == pytest.approx(first.margin, rel=1e-4)
    # A Lyapunov matrix of the turned model exists: the old identity, seen from the new coordinates.
    p = back.T @ back
    assert np.linalg.eigvalsh(turned.A.T @ p + p @ turned.A).max() < 1e-9 * np.abs(p).max()
    assert np.all(np.linalg.eigvalsh(solve_continuous_lyapunov(turned.A.T, -np.eye(len(p)))) > 0.0)


@pytest.mark.parametrize(("where", "reason"), [("infinite", "towards infinite"), ("growth", "pole grows")])
def test_other_ways_to_fail_are_named(hull: MemoryModel, where: str, reason: str) -> None:
    block = radiation(hull)[0]
    if where == "infinite":
        c = block.C.copy()
        c[0] *= 1.2
        broken = dataclasses.replace(block, C=c)
    else:
        broken = dataclasses.replace(block, A=block.A + 1.0 * np.eye(len(block.A)))
    certificate = certify([broken])
    assert not certificate.passive
    assert reason in certificate.reason


def test_causes_without_blocks_are_named(hull: MemoryModel) -> None:
    with pytest.raises(ValueError, match="no block of cause 'tanks'; it has: radiation"):
        passivity_certificate(hull, cause="tanks")
    with pytest.raises(
        ValueError, match="kind 'elephant' is unknown; choose by-motion or per-pair or passive"
    ):
        fit_memory(database=shipped_database(), kind="elephant")


def test_the_search_has_the_right_derivatives() -> None:
    data = known_data()
    problem = Problem(data, 4)
    random = np.random.default_rng(2)
    at = random.normal(size=4 + 10 + 8) * 0.7
    exact = problem.jacobian(at)
    for i in range(len(at)):
        shift = 1e-6 * np.eye(len(at))[i]
        slope = (problem.residual(at + shift) - problem.residual(at - shift)) / 2e-6
        assert exact[:, i] == pytest.approx(slope, rel=1e-5, abs=1e-6 * np.abs(exact).max())


def known_data() -> GroupData:
    """Exact data of three masses behind two motions, with an infinite-frequency added mass."""
    factor = np.array([[0.8, 0.0, 0.0], [0.3, 0.9, 0.0], [-0.2, 0.4, 1.0]])
    truth = Oscillators(
        w=np.array([0.7, 1.1, 1.7]),
        dampers=factor @ factor.T + 0.1 * np.eye(3),
        coupling=np.array([[1.0, 0.3], [-0.2, 0.9], [0.4, -0.5]]),
    )
    omega = np.linspace(0.1, 3.0, 59)
    kernel = truth.transfer(omega)
    infinite = np.array([[2.0, 0.3], [0.3, 1.5]])
    return GroupData(
        omega=omega,
        added_mass=infinite + kernel.imag / omega[:, None, None],
        damping=kernel.real,
        trusted=(omega > 0.29) & (omega < 2.51),
        added_mass_infinite=None,
    )


def test_a_known_system_is_recovered() -> None:
    data = known_data()
    model = fit_oscillators(data, fit_oscillators(data, None))
    assert len(model.w) == 3
    assert np.abs(model.transfer(data.omega).real - data.damping).max() < 0.01 * data.damping.max()
    assert len(first_guess(data).w) == 2


def test_known_infinite_added_mass_is_kept() -> None:
    database = shipped_database()
    model = fit_memory(database=database, kind="passive", r2=0.97, infinite_frequency="known")
    assert database.infinite_frequency_added_mass is not None
    known = database.infinite_frequency_added_mass
    assert model.added_mass == pytest.approx(0.5 * (known + known.T))
    assert passivity_certificate(model).passive
    assert all(row.accepted for row in model.rows)


def test_a_weak_pair_is_judged_by_the_motions() -> None:
    """Noise in place of pair 13, at 0.3 % of its diagonals, follows no model and moves nothing."""
    base = shipped_database()
    damping, added_mass = base.damping.copy(), base.added_mass.copy()
    peak = 0.003 * np.sqrt(damping[:, 0, 0].max() * damping[:, 2, 2].max())
    noise = peak * np.where(np.arange(len(base.omega)) % 2, 1.0, -1.0) * base.omega**2 / base.omega[-1] ** 2
    for j, k in ((0, 2), (2, 0)):
        damping[:, j, k], added_mass[:, j, k] = noise, 0.0
    database = dataclasses.replace(base, damping=damping, added_mass=added_mass, memory=None)
    model = fit_memory(database=database, kind="passive", r2=0.98)
    row = next(row for row in model.rows if (row.output, row.input) == (0, 2))
    assert row.r2_damping < 0.9 and row.accepted
    assert all(row.accepted for row in model.rows)


@pytest.mark.warns("DampingWarning")
def test_data_that_cannot_be_passive_warn_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pair 35 made larger than its diagonals allow: still a passive model, and a warning with numbers."""
    monkeypatch.setattr(passive, "MOST_MASSES", 1)
    base = shipped_database()
    damping, added_mass = base.damping.copy(), base.added_mass.copy()
    for j, k in ((2, 4), (4, 2)):
        damping[:, j, k] *= 12.0
        added_mass[:, j, k] *= 12.0
    database = dataclasses.replace(base, damping=damping, added_mass=added_mass, memory=None)
    model = fit_memory(database=database, kind="passive", r2=0.9)
    assert passivity_certificate(model).passive
    assert not all(row.accepted for row in model.rows)
    with pytest.warns(MemoryFitWarning, match=r"memory \d\d \(radiation\) follows added mass with R2 = "):
        vessel_parameters(database, memory=model)


def test_saved_and_loaded_without_loss(hull: MemoryModel, tmp_path: Path) -> None:
    database = dataclasses.replace(shipped_database(), memory=hull)
    database.save(tmp_path / "ship.nc")
    loaded = load_database(tmp_path / "ship.nc").memory
    assert loaded is not None
    assert passivity_certificate(loaded) == passivity_certificate(hull)
    assert loaded.rows == hull.rows
    scene, again = Scene(name="one"), Scene(name="two")
    own = dataclasses.replace(database, memory=loaded)
    scene.add_vessel(own, memory="passive")
    again.add_vessel(own, memory="per-pair")
    assert scene.compile().memory_states == hull.states
    assert again.compile().memory_states == fit_memory(database=own, kind="per-pair").states


@pytest.mark.parametrize("case", [vessel, case1], ids=["vessel", "case1"])
def test_runs_stay_close_to_the_per_pair_model(case: object) -> None:
    """Both models state R2 >= 0.99, a misfit of 10 % rms of the memory's share: motions differ by less."""
    motions = []
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for memory in ("per-pair", "passive"):
            scene = case(memory=memory)  # type: ignore[operator]
            result = simulate(scene, t_end=60.0, dt_out=0.5, channels=["vessel_motion"])
            motions.append(np.asarray(result["vessel_motion"]))
    difference = np.sqrt(np.mean((motions[1] - motions[0]) ** 2, axis=0) / np.mean(motions[0] ** 2, axis=0))
    assert np.all(difference < 0.1)
    assert difference.max() > 1e-5


def test_the_command_line_takes_it(tmp_path: Path) -> None:
    arguments = ["run", "vessel", "--memory", "passive", "--t-end", "2", "--out", str(tmp_path)]
    assert main(arguments) == 0
    import xarray

    with xarray.open_dataset(tmp_path / "vessel.nc") as data:
        assert json.loads(data.attrs["settings"])["memory"] == "passive"
        assert data.attrs["states"] < vessel().compile().states
