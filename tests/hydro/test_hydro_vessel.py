"""vessel_parameters: what the time domain gets, and taking parts out."""

from __future__ import annotations

import dataclasses
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


def test_the_mass_matrix_gives_the_kinetic_energy_and_is_split_and_rebuilt(supply: HydroDatabase) -> None:
    v, omega = np.array([0.3, -0.2, 0.5]), np.array([0.02, 0.05, -0.03])
    matrix = rigid_mass_matrix(CRANE.mass, CRANE.position, CRANE.inertia)
    twist = np.concatenate([v, omega])
    centre_velocity = v + np.cross(omega, CRANE.position)
    energy = 0.5 * CRANE.mass * centre_velocity @ centre_velocity + 0.5 * omega @ CRANE.inertia @ omega
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
    for changes, message in (
        ({"mass": 2e7}, "take out less"), ({"mass": 1e3, "inertia": np.eye(3) * 1e12}, "inertia about"),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=message):
            vessel_parameters(base, take_out=[dataclasses.replace(CRANE, **changes)])


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
