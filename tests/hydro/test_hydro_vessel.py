"""vessel_parameters: what the time domain gets, and taking parts out."""

from __future__ import annotations

import dataclasses
import warnings
from pathlib import Path

import numpy as np
import pytest

from seacrane.hydro import (
    HydroDatabase,
    RigidPart,
    fit_memory,
    load_database,
    motion_response,
    natural_frequency,
    rigid_mass_matrix,
    shipped_database,
    vessel_parameters,
)
from seacrane.warnings import InfiniteFrequencyWarning, MemoryFitWarning, RollDampingWarning

CRANE = RigidPart(mass=390e3, position=np.array([-33.0, 10.0, 18.0]), inertia=np.diag([2.0e7, 3.0e7, 2.5e7]))


@pytest.fixture(scope="module")
def supply(shared: Path) -> HydroDatabase:
    """The supply vessel with its memory."""
    database = load_database(shared / "veres" / "supply")
    with pytest.warns(InfiniteFrequencyWarning):
        return dataclasses.replace(database, memory=fit_memory(database=database, kind="per-pair"))


def test_the_shipped_vessel() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        vessel = vessel_parameters(shipped_database())
    assert vessel.mass == pytest.approx(14.0e6)
    assert vessel.center_of_mass[:2] == pytest.approx([0.0, 0.0], abs=1e-9)
    gyration = np.sqrt(np.diag(vessel.inertia) / vessel.mass)
    assert gyration == pytest.approx([0.36 * 25.0, 0.25 * 115.0, 0.25 * 115.0])
    assert np.array_equal(vessel.restoring, shipped_database().restoring)
    assert vessel.memory is shipped_database().memory


def test_mass_matrix_is_split_and_rebuilt(supply: HydroDatabase) -> None:
    for database in (shipped_database(), supply):
        vessel = vessel_parameters(database)
        rebuilt = rigid_mass_matrix(vessel.mass, vessel.center_of_mass, vessel.inertia)
        assert rebuilt == pytest.approx(database.mass_matrix, rel=1e-9, abs=1.0)


def test_rigid_mass_matrix_gives_the_kinetic_energy() -> None:
    v, omega = np.array([0.3, -0.2, 0.5]), np.array([0.02, 0.05, -0.03])
    matrix = rigid_mass_matrix(CRANE.mass, CRANE.position, CRANE.inertia)
    twist = np.concatenate([v, omega])
    centre_velocity = v + np.cross(omega, CRANE.position)
    energy = 0.5 * CRANE.mass * centre_velocity @ centre_velocity + 0.5 * omega @ CRANE.inertia @ omega
    assert 0.5 * twist @ matrix @ twist == pytest.approx(energy)


def test_taking_out_a_part_undoes_adding_it() -> None:
    base = shipped_database()
    weight = CRANE.mass * base.g
    restoring = base.restoring.copy()
    restoring[3, 3] -= weight * CRANE.position[2]
    restoring[4, 4] -= weight * CRANE.position[2]
    restoring[3, 5] += weight * CRANE.position[0]
    restoring[4, 5] += weight * CRANE.position[1]
    mass_matrix = base.mass_matrix + rigid_mass_matrix(CRANE.mass, CRANE.position, CRANE.inertia)
    loaded = dataclasses.replace(base, mass_matrix=mass_matrix, restoring=restoring)
    vessel, bare = vessel_parameters(loaded, take_out=[CRANE]), vessel_parameters(base)
    assert vessel.mass == pytest.approx(bare.mass)
    assert vessel.center_of_mass == pytest.approx(bare.center_of_mass, abs=1e-9)
    assert vessel.inertia == pytest.approx(bare.inertia, rel=1e-9, abs=1e-3)
    assert vessel.restoring == pytest.approx(bare.restoring, rel=1e-9, abs=1e-3)


def test_weight_restoring_is_the_moment_of_a_weight_that_moves_with_the_ship() -> None:
    """Moment of gravity about the reference point after small angles, by finite rotation."""
    base = shipped_database()
    vessel, bare = vessel_parameters(base, take_out=[CRANE]), vessel_parameters(base)
    taken = bare.restoring - vessel.restoring
    angle = 1e-4
    weight = np.array([0.0, 0.0, -CRANE.mass * base.g])
    for axis in (3, 4):
        turn = np.zeros(3)
        turn[axis - 3] = angle
        moved = CRANE.position + np.cross(turn, CRANE.position)
        moment = np.cross(moved, weight) - np.cross(CRANE.position, weight)
        assert -moment[axis - 3] / angle == pytest.approx(taken[axis, axis], rel=1e-6)


def test_taking_out_too_much_is_refused() -> None:
    with pytest.raises(ValueError, match="take out less"):
        vessel_parameters(shipped_database(), take_out=[dataclasses.replace(CRANE, mass=2e7)])
    with pytest.raises(ValueError, match="inertia about the centre of mass"):
        vessel_parameters(
            shipped_database(), take_out=[dataclasses.replace(CRANE, mass=1e3, inertia=np.eye(3) * 1e12)]
        )


def test_roll_damping_of_the_supply_vessel(supply: HydroDatabase) -> None:
    vessel = vessel_parameters(supply)
    assert supply.roll_damping is not None
    resonance = natural_frequency(supply, 3)
    assert resonance is not None
    linear = np.interp(resonance, supply.omega, supply.roll_damping.linear)
    assert vessel.linear_damping[3, 3] == pytest.approx(linear)
    assert vessel.quadratic_damping[3] > 0.0
    assert np.count_nonzero(vessel.linear_damping) == 1
    assert vessel.restoring[3, 3] < supply.restoring[3, 3]


def test_time_domain_matrices_return_the_motions(supply: HydroDatabase) -> None:
    """M, A_inf, B, C and the memory together are the frequency-domain equation with the fitted A and B."""
    for database in (shipped_database(), supply):
        vessel = vessel_parameters(database)
        w = database.omega[:, None, None]
        kernel = sum(
            vessel.memory.transfer(database.omega, cause=cause)
            for cause in {b.cause for b in vessel.memory.blocks}
        )
        damping = database.linear_damping.copy()
        if database.roll_damping is not None:
            kernel = kernel + np.einsum(
                "n,ij->nij", database.roll_damping.linear, np.diag([0, 0, 0, 1, 0, 0])
            )
        inertia = database.mass_matrix + vessel.added_mass
        dynamic = -(w**2) * inertia + 1j * w * (damping + kernel) + vessel.restoring
        added_mass, b = vessel.memory.frequency_response(database.omega)
        more_mass, more_b = vessel.memory.additional_response(database.omega)
        no_linearised = database
        if database.roll_damping is not None:
            quiet = dataclasses.replace(
                database.roll_damping, linearised=0.0 * database.roll_damping.linearised
            )
            no_linearised = dataclasses.replace(database, roll_damping=quiet)
        reference = motion_response(no_linearised, added_mass=added_mass + more_mass, damping=b + more_b)
        solved = np.linalg.solve(dynamic, database.force[..., None])[..., 0]
        assert np.abs(solved - reference).max() < 1e-9 * np.abs(reference).max()


def test_missing_roll_damping_is_named() -> None:
    bare = dataclasses.replace(shipped_database(), linear_damping=np.zeros((6, 6)))
    with pytest.warns(RollDampingWarning, match="no roll damping beside radiation"):
        vessel_parameters(bare)


def test_a_poor_fit_is_named() -> None:
    base = shipped_database()
    assert base.memory is not None
    poor = dataclasses.replace(base.memory.rows[0], accepted=False, r2_damping=0.8)
    memory = dataclasses.replace(base.memory, rows=(poor, *base.memory.rows[1:]))
    with pytest.warns(MemoryFitWarning, match=r"memory 11 \(radiation\) .* damping with 0\.800"):
        vessel_parameters(base, memory=memory)
