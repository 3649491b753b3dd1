"""Memory: identification, passivity checked independently, and what the time domain gets of a database."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane.errors import PassivityError
from seacrane.hydro import (
    HydroDatabase,
    MemoryBlock,
    MemoryModel,
    fit_memory,
    load_database,
    memory_rows,
    motion_response,
    natural_frequency,
    passivity_certificate,
    require_passive,
    rigid_mass_matrix,
    shipped_database,
    vessel_parameters,
)
from seacrane.hydro.data.memory_model import RADIATION
from seacrane.hydro.memory.certificate import certify, realise
from seacrane.hydro.memory.identification import IdentificationData, fit_lowest_order, fit_order, r_squared
from seacrane.hydro.memory.oscillators import MotionData, MotionProblem, Oscillators, fit_to_motions
from seacrane.warnings import InfiniteFrequencyWarning, MemoryFitWarning, RollDampingWarning

OMEGA = np.linspace(0.1, 3.0, 59)
NUMERATOR = np.array([3.0, 1.5, 0.8, 0.0])
DENOMINATOR = np.polymul([1.0, 0.6, 0.7], [1.0, 1.1, 1.9])


def known_system(**changes: Any) -> IdentificationData:
    """Data of an exact order-4 retardation function with A_inf = 5."""
    kernel = np.polyval(NUMERATOR, 1j * OMEGA) / np.polyval(DENOMINATOR, 1j * OMEGA)
    trusted = (OMEGA > 0.29) & (OMEGA < 2.51)
    values: dict[str, Any] = {"omega": OMEGA, "trusted": trusted, "added_mass_infinite": None}
    values |= {"added_mass": 5.0 + kernel.imag / OMEGA, "damping": kernel.real}
    return IdentificationData(**(values | changes))


@pytest.fixture(scope="module")
def supply(shared: Path) -> HydroDatabase:
    database = load_database(shared / "veres" / "supply")
    with pytest.warns(InfiniteFrequencyWarning):
        return dataclasses.replace(database, memory=fit_memory(database=database, kind="per-pair"))


def test_a_known_system_is_recovered_and_the_lowest_sufficient_order_taken() -> None:
    for known in (None, 5.0):
        fit, _ = fit_order(known_system(added_mass_infinite=known), order=4, starts=[])
        assert fit.denominator == pytest.approx(DENOMINATOR, rel=1e-4)
        assert fit.numerator == pytest.approx(NUMERATOR, rel=1e-3, abs=1e-3)
        assert fit.added_mass_infinite == pytest.approx(5.0, rel=1e-4)
        assert fit.worst > 1.0 - 1e-8
    data = known_system()
    fit = fit_lowest_order(data, orders=range(2, 7), error=lambda fit: -fit.worst, limit=-0.999)
    below, _ = fit_order(data, order=len(fit.denominator) - 2, starts=[])
    assert fit.worst >= 0.999 > below.worst
    values = np.array([1.0, 2.0, 4.0])
    assert r_squared(values, np.full(3, values.mean())) == pytest.approx(0.0)
    assert r_squared(np.ones(3), np.ones(3)) == r_squared(values, values) == 1.0


def test_realisation_keeps_the_transfer_function_and_scales_the_states() -> None:
    block = realise(NUMERATOR * 1e8, DENOMINATOR, output=3, input=1, cause=RADIATION)
    reference = 1e8 * np.polyval(NUMERATOR, 1j * OMEGA) / np.polyval(DENOMINATOR, 1j * OMEGA)
    assert np.abs(block.transfer(OMEGA)[:, 0, 0] - reference).max() < 1e-9 * np.abs(reference).max()
    assert np.sort_complex(block.poles) == pytest.approx(np.sort_complex(np.roots(DENOMINATOR)))
    assert np.linalg.norm(block.C) == pytest.approx(1.0)
    assert (block.outputs.tolist(), block.inputs.tolist()) == ([3], [1])
    omega = np.geomspace(0.01, 100.0, 3000)  # the largest harmonic amplitude
    resolvent = 1j * omega[:, None, None] * np.eye(4) - block.A
    states = np.abs(np.linalg.solve(resolvent, np.broadcast_to(block.B.astype(complex), (3000, 4, 1))))
    assert block.state_scale == pytest.approx(0.1 * states.max(axis=0)[:, 0], rel=1e-2)  # of 0.1 m/s
    turning = realise(NUMERATOR * 1e8, DENOMINATOR, output=3, input=3, cause=RADIATION)
    assert turning.state_scale == pytest.approx(0.1 * block.state_scale)
    with pytest.raises(ValueError, match="unstable pole"):
        realise(np.array([1.0, 0.0]), np.array([1.0, -0.2, 1.0]), output=0, input=0, cause=RADIATION)


@pytest.mark.warns(sometimes=["InfiniteFrequencyWarning"])
@pytest.mark.parametrize("which", ["shipped", "supply"])
def test_every_entry_follows_the_data(which: str, request: pytest.FixtureRequest) -> None:
    database = shipped_database() if which == "shipped" else request.getfixturevalue("supply")
    model = database.memory
    inside = (database.omega >= model.band[0] - 1e-9) & (database.omega <= model.band[1] + 1e-9)
    added_mass, damping = model.frequency_response(database.omega)
    entries = [(row.output, row.input) for row in model.rows if row.cause == RADIATION]
    assert len(entries) == (12 if which == "shipped" else 9)
    for j, k in [*entries, *((k, j) for j, k in entries)]:
        assert r_squared(database.added_mass[inside, j, k], added_mass[inside, j, k]) >= 0.99
        assert r_squared(database.damping[inside, j, k], damping[inside, j, k]) >= 0.99
    forgotten = np.ones((6, 6), dtype=bool)
    for j, k in entries:
        forgotten[j, k] = forgotten[k, j] = False
    assert not np.any(np.abs(database.damping)[:, forgotten] > 1e-6 * np.abs(database.damping).max())
    for block in model.blocks:
        assert block.poles.real.max() < -0.02
        if block.cause == RADIATION:
            still = np.linalg.solve(block.A, block.B)
            assert abs((block.C @ still)[0, 0]) < 1e-6 * np.abs(block.transfer(database.omega)).max()
    rows = {row.check: row for row in memory_rows(database, model)}
    assert rows["memory_r2_damping_33"].verdict == rows["vessel_with_memory_growth_per_s"].verdict == "pass"


def test_roll_tanks_have_a_static_stiffness_and_a_model_of_their_own(supply: HydroDatabase) -> None:
    """Beside 13 entries of order 3 to 4 of radiation, as the paper's 46 states."""
    model = supply.memory
    radiation = [block for block in model.blocks if block.cause == RADIATION]
    assert len(radiation) == 13 and sum(len(block.A) for block in radiation) <= 50
    (extra,) = supply.additional
    added_mass, damping = model.additional_response(supply.omega)
    inside = (supply.omega >= 0.3) & (supply.omega <= 2.6)
    assert r_squared(extra.added_mass[inside, 3, 3], added_mass[inside, 3, 3]) > 0.99
    assert r_squared(extra.damping[inside, 3, 3], damping[inside, 3, 3]) > 0.99
    lowest = -(supply.omega[0] ** 2) * extra.added_mass[0, 3, 3]
    assert model.additional_stiffness[3, 3] == pytest.approx(lowest, rel=0.15)


def test_known_infinite_added_mass_is_used_when_asked() -> None:
    database = shipped_database()
    known = database.infinite_frequency_added_mass
    span = np.ptp(np.diagonal(database.added_mass, axis1=1, axis2=2), axis=0)
    assert np.all(np.abs(np.diag(database.memory.added_mass - known)) < 0.04 * span)  # estimated
    given: dict[str, Any] = {"database": database, "infinite_frequency": "known"}
    per_pair, joint = fit_memory(kind="per-pair", r2=0.97, **given), fit_memory(limit=0.05, **given)
    assert np.diag(per_pair.added_mass) == pytest.approx(np.diag(known))
    assert joint.added_mass == pytest.approx(0.5 * (known + known.T))
    assert passivity_certificate(joint).passive and joint.motion is not None and joint.motion.reached


def test_refit_gives_the_shipped_model_and_its_passivity() -> None:
    database = shipped_database()
    shipped, again = database.memory, fit_memory(database=database, kind="per-pair")
    old, new = ([(row.output, row.input, row.order) for row in model.rows] for model in (shipped, again))
    assert old == new
    old, new = shipped.transfer(database.omega), again.transfer(database.omega)
    assert np.abs(old - new).max() < 1e-3 * np.abs(old).max()
    peak = np.sqrt(np.diagonal(database.damping, axis1=1, axis2=2).max(axis=0))
    damping = shipped.frequency_response(np.geomspace(1e-3, 1e3, 1500))[1] / np.outer(peak, peak)
    lowest = np.linalg.eigvalsh(0.5 * (damping + damping.swapaxes(1, 2)))[:, 0]
    assert lowest.min() == pytest.approx(shipped.passivity.minimum, abs=1e-3)
    assert shipped.passivity.minimum > -0.05


def test_the_mass_matrix_gives_the_kinetic_energy_and_is_split_and_rebuilt(supply: HydroDatabase) -> None:
    v, omega = np.array([0.3, -0.2, 0.5]), np.array([0.02, 0.05, -0.03])
    mass, position, inertia = 390e3, np.array([-33.0, 10.0, 18.0]), np.diag([2.0e7, 3.0e7, 2.5e7])
    matrix = rigid_mass_matrix(mass, position, inertia)
    twist = np.concatenate([v, omega])
    centre_velocity = v + np.cross(omega, position)
    energy = 0.5 * mass * centre_velocity @ centre_velocity + 0.5 * omega @ inertia @ omega
    assert 0.5 * twist @ matrix @ twist == pytest.approx(energy)
    for database in (shipped_database(), supply):
        vessel = vessel_parameters(database)
        rebuilt = rigid_mass_matrix(vessel.mass, vessel.center_of_mass, vessel.inertia)
        assert rebuilt == pytest.approx(database.mass_matrix, rel=1e-9, abs=1.0)
    base = shipped_database()
    vessel = vessel_parameters(base)
    assert vessel.mass == pytest.approx(14.0e6)
    assert vessel.center_of_mass[:2] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert np.sqrt(np.diag(vessel.inertia) / vessel.mass) == pytest.approx([9.0, 28.75, 28.75])
    assert np.array_equal(vessel.restoring, base.restoring) and vessel.memory is base.memory


def test_roll_damping_of_the_supply_vessel(supply: HydroDatabase) -> None:
    vessel = vessel_parameters(supply)
    resonance = natural_frequency(supply, 3)
    linear = np.interp(resonance, supply.omega, supply.roll_damping.linear)
    assert vessel.linear_damping[3, 3] == pytest.approx(linear)
    assert vessel.quadratic_damping[3] > 0.0
    assert np.count_nonzero(vessel.linear_damping) == 1
    assert vessel.restoring[3, 3] < supply.restoring[3, 3]


def test_time_domain_matrices_return_the_motions(supply: HydroDatabase) -> None:
    """M, A_inf, B, C and the memory together are the frequency-domain equation with the fitted A and B."""
    for database in (shipped_database(), supply):
        vessel, omega = vessel_parameters(database), database.omega
        w, memory, quiet, roll = omega[:, None, None], vessel.memory, database, database.roll_damping
        damping = database.linear_damping + np.zeros((len(omega), 6, 6))
        damping = damping + sum(
            memory.transfer(omega, cause=cause) for cause in {b.cause for b in memory.blocks}
        )
        if roll is not None:
            damping[:, 3, 3] += roll.linear
            still = dataclasses.replace(roll, linearised=0.0 * roll.linearised)
            quiet = dataclasses.replace(database, roll_damping=still)
        dynamic = -(w**2) * (database.mass_matrix + vessel.added_mass) + 1j * w * damping + vessel.restoring
        own, more = memory.frequency_response(omega), memory.additional_response(omega)
        reference = motion_response(quiet, added_mass=own[0] + more[0], damping=own[1] + more[1])
        solved = np.linalg.solve(dynamic, database.force[..., None])[..., 0]
        assert np.abs(solved - reference).max() < 1e-9 * np.abs(reference).max()


def test_a_poor_fit_and_missing_roll_damping_are_named() -> None:
    base = shipped_database()
    poor = dataclasses.replace(base.memory.rows[0], accepted=False, r2_damping=0.8)
    memory = dataclasses.replace(base.memory, rows=(poor, *base.memory.rows[1:]))
    with pytest.warns(MemoryFitWarning, match=r"memory 11 \(radiation\) .* damping with 0\.800"):
        vessel_parameters(base, memory=memory)
    with pytest.warns(RollDampingWarning, match="no roll damping"):
        vessel_parameters(dataclasses.replace(base, linear_damping=np.zeros((6, 6))))


Array = np.ndarray


@pytest.fixture(scope="module")
def hull() -> MemoryModel:
    return fit_memory(database=shipped_database())


@pytest.fixture(scope="module")
def both(supply: HydroDatabase) -> tuple[HydroDatabase, MemoryModel]:
    with pytest.warns(InfiniteFrequencyWarning):
        return supply, fit_memory(database=supply)


@pytest.fixture(params=["hull", pytest.param("both", marks=pytest.mark.slow("fits a memory to a file"))])
def ship(request: pytest.FixtureRequest) -> tuple[HydroDatabase, MemoryModel]:
    own = request.getfixturevalue(request.param)
    return own if request.param == "both" else (shipped_database(), own)


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
    assert certificate.margin > 0.004
    assert model.passivity.minimum > 0.0 and model.passivity.in_band > 0.0
    for block in radiation(model):
        assert np.array_equal(block.B, block.C.T) and not np.any(block.D)
        assert np.linalg.eigvalsh(block.A + block.A.T).max() <= 1e-13
        assert block.poles.real.max() < -0.04
        still = block.C @ np.linalg.solve(block.A, block.B)
        assert np.abs(still).max() < 1e-10 * np.abs(block.C @ block.B).max()


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


def test_known_oscillators_are_recovered_by_a_search_with_the_right_derivatives() -> None:
    """Exact data of three masses behind two motions, with an infinite-frequency added mass."""
    factor = np.array([[0.8, 0.0, 0.0], [0.3, 0.9, 0.0], [-0.2, 0.4, 1.0]])
    coupling = np.array([[1.0, 0.3], [-0.2, 0.9], [0.4, -0.5]])
    dampers = factor @ factor.T + 0.1 * np.eye(3)
    truth = Oscillators(w=np.array([0.7, 1.1, 1.7]), dampers=dampers, coupling=coupling)
    omega = np.linspace(0.1, 3.0, 59)
    kernel = truth.transfer(omega)
    added_mass = np.array([[2.0, 0.3], [0.3, 1.5]]) + kernel.imag / omega[:, None, None]
    tables = {"added_mass": added_mass, "damping": kernel.real, "added_mass_infinite": None}
    lever = np.exp(1j * np.arange(3)) * np.eye(3) / (0.3 + omega[:, None, None])
    data = MotionData(omega=omega, trusted=(omega > 0.29) & (omega < 2.51), lever=lever, **tables)
    model = fit_to_motions(data, fit_to_motions(data, None))
    assert len(model.w) == 3
    assert np.abs(model.transfer(omega).real - kernel.real).max() < 0.01 * kernel.real.max()
    problem = MotionProblem(data, 4)
    at = np.random.default_rng(2).normal(size=4 + 10 + 8) * 0.7
    exact = problem.slope(at)
    for i, shift in enumerate(1e-6 * np.eye(len(at))):
        slope = (problem.misfit(at + shift) - problem.misfit(at - shift)) / 2e-6
        assert exact[:, i] == pytest.approx(slope, rel=1e-5, abs=1e-6 * np.abs(exact).max())
