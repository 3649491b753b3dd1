"""Joint memory of two hulls: passive over all motions, near the data, each hull's own without coupling."""

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
from seacrane.hydro.group.parts import joined_memory
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


def test_bodies_in_another_order_take_the_memory_along(group: HydroGroup, model: MemoryModel) -> None:
    moved = replace(group, memory=model).ordered(["two", "one"])
    place = np.r_[6:12, 0:6]
    square = np.ix_(range(len(group.omega)), place, place)
    assert moved.memory.transfer(group.omega) == pytest.approx(model.transfer(group.omega)[square], rel=1e-12)
    assert np.array_equal(moved.memory.added_mass, model.added_mass[np.ix_(place, place)])
    assert passivity_certificate(moved.memory).passive


def test_hulls_that_do_not_couple_have_memories_of_their_own() -> None:
    """In one fit, and as single ones side by side: states and order as they are."""
    apart = group_in(known_water(0.0))
    model = fit_memory(database=apart, limit=LIMIT)
    assert all(len({motion // 6 for motion in block.inputs}) == 1 for block in model.blocks)
    single = [fit_memory(database=apart[name], limit=LIMIT, band=(0.15, 2.2)) for name in apart]
    joint = joined_memory(single)
    assert joint.states == sum(one.states for one in single)
    for i, one in enumerate(single):
        at = slice(6 * i, 6 * i + 6)
        assert np.array_equal(joint.transfer(apart.omega)[:, at, at], one.transfer(apart.omega))
    for both in (model, joint):
        assert not np.any(both.transfer(apart.omega)[:, :6, 6:])
        assert passivity_certificate(both).passive


def test_a_memory_of_another_size_is_refused(group: HydroGroup) -> None:
    with pytest.raises(ValueError, match="its memory has 6 motions, the group 12"):
        replace(group, memory=fit_memory(database=group["one"], limit=LIMIT))
    with pytest.raises(ValueError, match="'per-pair' is of one hull"):
        fit_memory(database=group, kind="per-pair")
