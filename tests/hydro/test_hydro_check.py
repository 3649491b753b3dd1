"""Self-check: closure on a real ship, relations of exact hydrodynamics, and that damage is noticed."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest

from seacrane.hydro import CheckRow, HydroDatabase, load_database, natural_frequency, shipped_database
from seacrane.hydro.data.relations import damping_from_forces, infinite_added_mass_from_damping

MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")


@pytest.fixture(scope="module")
def supply(shared: Path) -> HydroDatabase:
    """The supply vessel."""
    return load_database(shared / "veres" / "supply")


def rows_of(database: HydroDatabase) -> dict[str, CheckRow]:
    """The self-check by name."""
    return {row.check: row for row in database.check()}


@pytest.mark.warns("InfiniteFrequencyWarning")
def test_the_supply_vessel_closes(supply: HydroDatabase) -> None:
    rows = rows_of(supply)
    for motion in MOTIONS:
        row = rows[f"motion_rao_{motion}"]
        assert row.verdict == "pass"
        assert row.limit == (1e-5 if motion in ("heave", "pitch") else 1e-3)
    assert rows["surge_terms_missing"].value == 1.0
    assert rows["memory_r2_damping_33"].verdict == "pass"  # fitted for the check: the files hold none
    narrow = dataclasses.replace(supply, trusted_band=(0.3, 0.4))
    assert not [name for name in rows_of(narrow) if name.startswith("memory")]


@pytest.mark.warns("InfiniteFrequencyWarning")
@pytest.mark.parametrize("damage", ["no tanks", "no roll damping", "conjugated", "sign of x", "C35 lost"])
@pytest.mark.slow("closes a ship for each kind of damage")
def test_closure_notices_damage(supply: HydroDatabase, damage: str) -> None:
    changes, motions = {
        "no tanks": ({"additional": ()}, {"roll"}),
        "no roll damping": ({"roll_damping": None}, {"roll"}),
        "conjugated": ({"force": supply.force.conj()}, set(MOTIONS)),
        "sign of x": ({"force": supply.force * np.array([-1, -1, 1, -1, -1, 1])}, {"surge", "sway", "pitch"}),
        "C35 lost": ({"restoring": np.diag(np.diag(supply.restoring))}, {"heave", "pitch"}),
    }[damage]
    rows = rows_of(dataclasses.replace(supply, **changes))
    assert all(rows[f"motion_rao_{name}"].verdict == "fail" for name in motions)


def test_natural_periods_of_the_shipped_hull() -> None:
    database = shipped_database()
    for motion, period, error in ((2, 7.2, 0.4), (3, 12.5, 0.7), (4, 6.9, 0.4)):
        assert 2.0 * np.pi / natural_frequency(database, motion) == pytest.approx(period, abs=error)
    assert natural_frequency(database, 0) is None
    flat = np.broadcast_to(database.added_mass[10], database.added_mass.shape)
    constant = dataclasses.replace(database, added_mass=flat, memory=None)
    exact = np.sqrt(database.restoring[2, 2] / (database.mass_matrix[2, 2] + flat[0, 2, 2]))
    assert natural_frequency(constant, 2) == pytest.approx(exact, rel=1e-3)


def test_damping_follows_from_the_wave_forces() -> None:
    """Energy relation; the couplings' signs prove axes, headings and time factor together."""
    database = shipped_database()
    found = damping_from_forces(database)
    inside = (database.omega > 0.3) & (database.omega < 1.3)
    peak = np.sqrt(np.diagonal(database.damping, axis1=1, axis2=2).max(axis=0))
    error = np.abs(found - database.damping)[inside] / np.outer(peak, peak)
    assert error.max() < 0.05
    for j, k in ((0, 4), (1, 3), (1, 5), (2, 4), (3, 5)):
        assert np.abs(database.damping[inside, j, k]).max() > 0.1 * peak[j] * peak[k]
    # It needs deep water and closed headings.
    few = dataclasses.replace(database, heading=database.heading[::9], force=database.force[::9])
    assert damping_from_forces(few) is damping_from_forces(dataclasses.replace(database, depth=50.0)) is None
    assert database.force[:, 0, 2].real == pytest.approx(database.restoring[2, 2], rel=0.06)


def test_kramers_kronig_on_an_exact_pair_and_the_shipped_hull() -> None:
    """K(s) = s / (s^2 + c s + w0^2): A and B in closed form, A_inf = 1."""
    base = shipped_database()
    s, eye = 1j * np.linspace(0.05, 6.0, 240), np.eye(6)
    kernel = s / (s**2 + 0.8 * s + 1.0)
    tables = {
        "added_mass": (1.0 + kernel.imag / s.imag)[:, None, None] * eye,
        "damping": kernel.real[:, None, None] * eye, "force": np.zeros((len(base.heading), 240, 6)),
        "infinite_frequency_added_mass": None,
    }  # fmt: skip
    exact = dataclasses.replace(base, omega=s.imag, trusted_band=(0.3, 3.0), memory=None, **tables)
    assert np.diag(infinite_added_mass_from_damping(exact)) == pytest.approx(1.0, abs=5e-3)
    difference = np.diag(infinite_added_mass_from_damping(base) - base.infinite_frequency_added_mass)
    span = np.ptp(np.diagonal(base.added_mass, axis1=1, axis2=2), axis=0)
    assert np.all(np.abs(difference) < 0.05 * span)


def test_the_shipped_hull_is_symmetric_and_its_mass_is_its_displacement() -> None:
    database = shipped_database()
    mass, stiffness = database.mass_matrix, database.restoring[3, 3]
    assert mass[0, 0] == pytest.approx(14.0e6, rel=1e-12)
    assert stiffness == pytest.approx(database.g * 14.0e6 * 3.0, rel=1e-9)
    for matrix in (database.added_mass, database.damping, database.restoring, mass):
        assert np.array_equal(matrix, matrix.swapaxes(-1, -2))
    parity = np.arange(6) % 2
    assert not np.any(database.added_mass[:, parity[:, None] != parity])
    critical = 2.0 * np.sqrt(stiffness * (mass[3, 3] + database.added_mass[8, 3, 3]))
    assert database.linear_damping[3, 3] == pytest.approx(0.05 * critical, rel=0.01)


def test_damage_to_the_shipped_hull_is_noticed() -> None:
    base = shipped_database()
    failing = {row.check for row in base.check() if row.verdict == "fail"}
    assert failing <= {"memory_passivity_in_band", "memory_passivity_everywhere"}
    skew = base.added_mass.copy()
    skew[:, 2, 4] *= -1.0
    peak = np.diag(np.diagonal(base.damping, axis1=1, axis2=2).max(axis=0))
    for changes, check in (
        ({"damping": base.damping - 0.1 * peak}, "damping_smallest_eigenvalue"),
        ({"added_mass": skew}, "symmetry_added_mass"),
        ({"force": base.force * np.array([1, 1.2, 1, 1, 1, 1])}, "damping_from_forces_sway"),
        ({"infinite_frequency_added_mass": 1.3 * base.infinite_frequency_added_mass}, "kramers_kronig_heave"),
    ):
        row = rows_of(dataclasses.replace(base, **changes))[check]
        assert row.verdict == "fail"
        assert json.loads(json.dumps(row.as_dict()))["verdict"] == "fail"
