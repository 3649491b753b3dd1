"""Joint memory of two hulls, passive and near the data; a damping lid put into results without one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from seacrane.hydro import (
    GroupBody,
    HydroGroup,
    MemoryModel,
    fit_memory,
    motion_response,
    passivity_certificate,
)
from seacrane.hydro.memory.by_motion import _Coupled, _lost, _without
from seacrane.hydro.memory.coupled import CoupledProblem, _Point
from seacrane.hydro.memory.motion_judge import motion_judge
from seacrane.hydro.memory.oscillators import Oscillators

HEAVE, SWAY = 2, 1
MOVING = [SWAY, HEAVE, 6 + SWAY, 6 + HEAVE]
INERTIA, LIMIT = 1.0e6, 0.02


def known_water(coupling: float) -> Oscillators:
    """Waves of two hulls as damped oscillators, each with a share of the other hull's motions."""
    own = np.array([[0.5, 0.9, 0, 0], [0.8, -0.4, 0, 0], [0, 0, 0.6, 0.8], [0, 0, 0.7, -0.5]])
    other = np.array([[0, 0, 0.5, -0.6], [0, 0, -0.4, 0.3], [-0.6, 0.4, 0, 0], [0.3, 0.5, 0, 0]])
    return Oscillators(
        w=np.array([0.55, 0.95, 0.65, 1.05]),
        dampers=np.diag([0.45, 0.6, 0.5, 0.65]),
        coupling=np.sqrt(0.3 * INERTIA) * (own + coupling * other),
    )


def group_in(water: Oscillators) -> HydroGroup:
    """Two bodies whose sway and heave radiate as the known water says; resonant at 0.7 and 0.8 rad/s."""
    omega = np.linspace(0.15, 2.2, 32)
    at = np.ix_(range(len(omega)), MOVING, MOVING)
    kernel = water.transfer(omega)
    added_mass, damping = np.zeros((2, len(omega), 12, 12))
    infinite = np.zeros((12, 12))
    infinite[MOVING, MOVING] = 0.4 * INERTIA
    added_mass[at] = kernel.imag / omega[:, None, None]
    damping[at] = kernel.real
    force = np.zeros((2, len(omega), 12), dtype=complex)
    shape = np.array([[1j, 1.0, 0.6j, 0.8], [0.5j, 1.0, 1j, 1.0]])
    force[:, :, MOVING] = 1e5 * np.exp(-omega)[None, :, None] * shape[:, None]
    bodies = []
    for name, place, resonance in (("one", 0.0, 0.7), ("two", 30.0, 0.8)):
        restoring, rate = np.zeros((2, 6, 6))
        restoring[HEAVE, HEAVE] = 2.0 * INERTIA * resonance**2
        rate[HEAVE, HEAVE] = 0.1 * INERTIA
        body = GroupBody(
            name=name, position=np.array([0.0, place, 0.0]), mass_matrix=INERTIA * np.eye(6),
            restoring=restoring, linear_damping=rate, length=40.0, breadth=15.0, draught=4.0,
        )  # fmt: skip
        bodies.append(body)
    return HydroGroup(
        name="known", bodies=tuple(bodies), omega=omega, heading=np.array([0.5, 1.2]), force=force,
        added_mass=added_mass + infinite, damping=damping, infinite_frequency_added_mass=infinite,
        source="known oscillators",
    )  # fmt: skip


@pytest.fixture(scope="module")
def group() -> HydroGroup:
    return group_in(known_water(0.6))


@pytest.fixture(scope="module")
def model(group: HydroGroup) -> MemoryModel:
    return fit_memory(database=group, limit=LIMIT)


def test_it_is_passive_over_all_motions_and_couples_the_hulls(group: HydroGroup, model: MemoryModel) -> None:
    """Within the limit that the model states, as motions solved with it at the data's frequencies are."""
    certificate = passivity_certificate(model)
    assert certificate.passive and certificate.energy
    assert model.motions == 12 and model.passivity.minimum > -1e-12
    assert model.motion is not None and model.motion.reached and model.motion.error.seas.shape == (12,)
    added_mass, damping = model.frequency_response(group.omega)
    solved = motion_response(group, added_mass=added_mass, damping=damping)[:, :, MOVING]
    given, inside = group.motion_rao[:, :, MOVING], group.omega < 1.5
    error = np.abs(solved - given)[:, inside].max(axis=(0, 1)) / np.abs(given).max(axis=(0, 1))
    assert error.max() < 5.0 * LIMIT
    for table, fitted in ((group.added_mass, added_mass), (group.damping, damping)):
        coupled = table[:, HEAVE, 6 + HEAVE]
        assert np.abs(fitted[:, HEAVE, 6 + HEAVE] - coupled).max() < 0.1 * np.ptp(coupled)
        assert fitted[:, HEAVE, 6 + HEAVE] == pytest.approx(fitted[:, 6 + HEAVE, HEAVE], rel=1e-9)
    assert model.added_mass[HEAVE, HEAVE] == pytest.approx(0.4 * INERTIA, rel=0.1)


@pytest.mark.parametrize("known", [False, True])
def test_the_normal_equations_are_those_of_differences(group: HydroGroup, known: bool) -> None:
    """Gradient and matrix of Gauss and Newton, by what steps in each parameter do to the misfit."""
    band, infinite = (0.3, 1.8), group.infinite_frequency_added_mass if known else None
    felt = _Coupled(motion_judge(group, band), group.omega, band, infinite, MOVING).felt
    felt.emphasise(np.array([1.0, 2.0, 0.5, 1.0]))
    water = known_water(0.3)
    problem = CoupledProblem(felt, 4)
    start = problem.pack(replace(water, coupling=water.coupling / np.sqrt(INERTIA)))
    start[4:] += 0.1 * np.random.default_rng(1).normal(size=len(start) - 4)
    matrix, gradient = _Point(problem, start).normal_equations()
    step = 1e-5 * np.eye(len(start))
    ends = [(_Point(problem, start + one), _Point(problem, start - one)) for one in step]
    by_cost = np.array([(a.cost - b.cost) / 4e-5 for a, b in ends])
    assert np.abs(gradient - by_cost).max() < 1e-6 * np.abs(by_cost).max()
    misfits = [(a.misfit - b.misfit) / 2e-5 for a, b in ends]
    square = np.array([[np.vdot(one, felt(other)).real for other in misfits] for one in misfits])
    sizes = problem.sizes(start)[1]
    assert np.abs(square + sizes.T @ sizes - matrix).max() < 1e-6 * np.abs(matrix).max()


def test_what_a_pair_is_felt_by_is_that_of_all_motions_solved_anew(group: HydroGroup) -> None:
    judge = motion_judge(group, (0.3, 1.8))
    pair = (SWAY, 6 + HEAVE)
    quick, whole = judge.error_of_pair(*pair, _lost(judge, pair)), judge.error(_without(judge, [pair]))
    assert quick.seas == pytest.approx(whole.seas, rel=1e-9, abs=1e-13)
    assert quick.peaks == pytest.approx(whole.peaks, rel=1e-9, abs=1e-13) and whole.worst > 1e-3


def test_a_bar_shows_masses_and_error(
    group: HydroGroup, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("SEACRANE_CACHE", "off")
    assert fit_memory(database=group, limit=0.3, progress=True).motion is not None
    assert "fluid memory" in (shown := capsys.readouterr().err) and "masses" in shown


def test_bodies_in_another_order_take_the_memory_along(group: HydroGroup, model: MemoryModel) -> None:
    moved = replace(group, memory=model).ordered(["two", "one"])
    place = np.r_[6:12, 0:6]
    square = np.ix_(range(len(group.omega)), place, place)
    assert moved.memory.transfer(group.omega) == pytest.approx(model.transfer(group.omega)[square], rel=1e-12)
    assert np.array_equal(moved.memory.added_mass, model.added_mass[np.ix_(place, place)])
    assert passivity_certificate(moved.memory).passive


def test_hulls_that_do_not_couple_have_memories_of_their_own() -> None:
    apart = group_in(known_water(0.0))
    model = fit_memory(database=apart, limit=LIMIT)
    assert all(len({motion // 6 for motion in block.inputs}) == 1 for block in model.blocks)
    assert not np.any(model.transfer(apart.omega)[:, :6, 6:])
    assert passivity_certificate(model).passive


LIGHT = 0.02  # damping of the gap's water, 1/s


def with_gap(rate: float) -> HydroGroup:
    """Two hulls whose gap is an oscillator at its piston frequency, moved by both and by the waves."""
    water, omega = known_water(0.3), np.linspace(0.15, 2.2, 200)
    base = group_in(water)
    bodies = (base.bodies[0], replace(base.bodies[1], position=np.array([0.0, 19.0, 0.0])))
    place = replace(base, bodies=bodies).gaps()[0].piston
    row = np.sqrt(0.05 * INERTIA) * np.array([[0.6, 1.0, -0.5, 0.8]])
    gap = Oscillators(w=np.array([place]), dampers=np.array([[rate]]), coupling=row)
    kernel = water.transfer(omega) + gap.transfer(omega)
    added_mass, damping = np.zeros((2, len(omega), 12, 12))
    at = np.ix_(range(len(omega)), MOVING, MOVING)
    added_mass[at] = kernel.imag / omega[:, None, None]
    damping[at] = kernel.real
    pole = 1.0 / (place**2 - omega**2 + 1j * omega * rate)
    force = np.zeros((2, len(omega), 12), dtype=complex)
    force[:, :, MOVING] = 1e5 * np.exp(-omega)[None, :, None] + 2e2 * pole[None, :, None] * row
    tables = {"added_mass": added_mass + base.infinite_frequency_added_mass, "damping": damping}
    return replace(base, bodies=bodies, omega=omega, force=force, **tables)


def test_it_is_the_gap_with_that_damping() -> None:
    """Matrices, forces and motions are those of the oscillator whose damping grows by damping times w0."""
    bare = with_gap(LIGHT)
    peaks = [bare.damping[:, HEAVE, HEAVE].max()]
    for damping in (0.01, 0.03):
        truth, found = with_gap(LIGHT + damping * bare.gaps()[0].piston), bare.with_lid_damping(damping)
        assert found.lid_damping == damping
        for name in ("added_mass", "damping", "force", "motion_rao"):
            mine, its, before = (getattr(each, name) for each in (found, truth, bare))
            assert np.abs(mine - its).max() < 0.02 * np.abs(its - before).max(), name
        peaks.append(found.damping[:, HEAVE, HEAVE].max())
    assert peaks[0] > 1.3 * peaks[1] > 1.5 * peaks[2]
    assert np.linalg.eigvalsh(found.damping[:, MOVING][:, :, MOVING])[:, 0].min() > -1e-3 * peaks[0]
