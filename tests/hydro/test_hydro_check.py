"""Self-check: closure on a real ship, relations of exact hydrodynamics, and that damage is noticed."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane.hydro import CheckRow, HydroDatabase, load_database, natural_frequency, shipped_database
from seacrane.hydro.data.relations import damping_from_forces, infinite_added_mass_from_damping


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
    for motion in ("surge", "sway", "heave", "roll", "pitch", "yaw"):
        row = rows[f"motion_rao_{motion}"]
        assert row.verdict == "pass"
        assert row.limit == (1e-5 if motion in ("heave", "pitch") else 1e-3)
    assert rows["surge_terms_missing"].value == 1.0
    assert rows["memory_r2_damping_33"].verdict == "pass"  # fitted for the check: the files hold none


def test_few_frequencies_are_checked_without_a_memory(supply: HydroDatabase) -> None:
    narrow = dataclasses.replace(supply, trusted_band=(0.3, 0.4))
    assert not [name for name in rows_of(narrow) if name.startswith("memory")]


@pytest.mark.warns("InfiniteFrequencyWarning")
@pytest.mark.parametrize(
    ("damage", "motions"),
    [
        ({"additional": ()}, {"roll"}),
        ({"roll_damping": None}, {"roll"}),
        ({"force": "conjugate"}, {"surge", "sway", "heave", "roll", "pitch", "yaw"}),
        ({"heading": "file"}, {"surge", "sway", "pitch"}),
        ({"restoring": "no coupling"}, {"heave", "pitch"}),
    ],
    ids=["no tanks", "no roll damping", "conjugated forces", "sign of x", "C35 lost"],
)
@pytest.mark.slow("closes a ship for each kind of damage")
def test_closure_notices_damage(supply: HydroDatabase, damage: dict[str, Any], motions: set[str]) -> None:
    changes = dict(damage)
    if changes.get("force") == "conjugate":
        changes["force"] = supply.force.conj()
    if changes.get("heading") == "file":
        changes = {"force": supply.force * np.array([-1, -1, 1, -1, -1, 1])}
    if changes.get("restoring") == "no coupling":
        changes["restoring"] = np.diag(np.diag(supply.restoring))
    rows = rows_of(dataclasses.replace(supply, **changes))
    failing = {
        name
        for name in ("surge", "sway", "heave", "roll", "pitch", "yaw")
        if rows[f"motion_rao_{name}"].verdict == "fail"
    }
    assert motions <= failing


def test_the_shipped_hull_passes_everything_but_joint_passivity() -> None:
    failing = {row.check for row in shipped_database().check() if row.verdict == "fail"}
    assert failing <= {"memory_passivity_in_band", "memory_passivity_everywhere"}


def test_natural_periods_of_the_shipped_hull() -> None:
    database = shipped_database()
    periods = {}
    for motion, name in ((2, "heave"), (3, "roll"), (4, "pitch")):
        omega = natural_frequency(database, motion)
        assert omega is not None
        periods[name] = 2.0 * np.pi / omega
    assert periods["heave"] == pytest.approx(7.2, abs=0.4)
    assert periods["roll"] == pytest.approx(12.5, abs=0.7)
    assert periods["pitch"] == pytest.approx(6.9, abs=0.4)
    assert natural_frequency(database, 0) is None


def test_natural_frequency_of_constant_added_mass_is_exact() -> None:
    database = shipped_database()
    flat = np.broadcast_to(database.added_mass[10], database.added_mass.shape)
    constant = dataclasses.replace(database, added_mass=flat, memory=None)
    inertia = database.mass_matrix[2, 2] + database.added_mass[10, 2, 2]
    assert natural_frequency(constant, 2) == pytest.approx(
        np.sqrt(database.restoring[2, 2] / inertia), rel=1e-3
    )


def test_damping_follows_from_the_wave_forces() -> None:
    """Energy relation; the couplings' signs prove axes, headings and time factor together."""
    database = shipped_database()
    found = damping_from_forces(database)
    assert found is not None
    inside = (database.omega > 0.3) & (database.omega < 1.3)
    peak = np.sqrt(np.diagonal(database.damping, axis1=1, axis2=2).max(axis=0))
    error = np.abs(found - database.damping)[inside] / np.outer(peak, peak)
    assert error.max() < 0.05
    for j, k in ((0, 4), (1, 3), (1, 5), (2, 4), (3, 5)):
        assert np.abs(database.damping[inside, j, k]).max() > 0.1 * peak[j] * peak[k]


def test_damping_from_forces_needs_deep_water_and_closed_headings() -> None:
    database = shipped_database()
    assert damping_from_forces(dataclasses.replace(database, depth=50.0)) is None
    few = dataclasses.replace(database, heading=database.heading[::9], force=database.force[::9])
    assert damping_from_forces(few) is None


def test_kramers_kronig_on_an_exact_pair() -> None:
    """K(s) = s / (s^2 + c s + w0^2): A and B in closed form, A_inf = 1."""
    base = shipped_database()
    s = 1j * np.linspace(0.05, 6.0, 240)
    kernel = s / (s**2 + 0.8 * s + 1.0)
    eye = np.eye(6)
    database = dataclasses.replace(
        base,
        omega=s.imag,
        added_mass=(1.0 + kernel.imag / s.imag)[:, None, None] * eye,
        damping=kernel.real[:, None, None] * eye,
        force=np.zeros((len(base.heading), 240, 6)),
        infinite_frequency_added_mass=None,
        trusted_band=(0.3, 3.0),
        memory=None,
    )
    assert np.diag(infinite_added_mass_from_damping(database)) == pytest.approx(1.0, abs=5e-3)


def test_kramers_kronig_of_the_shipped_hull() -> None:
    database = shipped_database()
    estimate = infinite_added_mass_from_damping(database)
    assert database.infinite_frequency_added_mass is not None
    span = np.ptp(np.diagonal(database.added_mass, axis1=1, axis2=2), axis=0)
    difference = np.diag(estimate - database.infinite_frequency_added_mass)
    assert np.all(np.abs(difference) < 0.05 * span)


def test_forces_in_long_waves_are_hydrostatic() -> None:
    database = shipped_database()
    assert database.force[:, 0, 2].real == pytest.approx(database.restoring[2, 2], rel=0.06)


def test_the_shipped_hull_is_symmetric_and_its_mass_is_its_displacement() -> None:
    database = shipped_database()
    assert database.mass_matrix[0, 0] == pytest.approx(14.0e6, rel=1e-12)
    assert database.restoring[3, 3] == pytest.approx(
        database.rho * database.g * 14.0e6 / database.rho * 3.0, rel=1e-9
    )
    for matrix in (
        database.added_mass,
        database.damping,
        database.restoring[None],
        database.mass_matrix[None],
    ):
        assert np.array_equal(matrix, matrix.swapaxes(1, 2))
    parity = np.arange(6) % 2
    assert not np.any(database.added_mass[:, parity[:, None] != parity])
    critical = 2.0 * np.sqrt(
        database.restoring[3, 3] * (database.mass_matrix[3, 3] + database.added_mass[8, 3, 3])
    )
    assert database.linear_damping[3, 3] == pytest.approx(0.05 * critical, rel=0.01)


@pytest.mark.parametrize(
    ("damage", "check"),
    [
        ("negative damping", "damping_smallest_eigenvalue"),
        ("skew added mass", "symmetry_added_mass"),
        ("sway forces a fifth too large", "damping_from_forces_sway"),
        ("wrong infinity", "kramers_kronig_heave"),
    ],
)
def test_damage_to_the_shipped_hull_is_noticed(damage: str, check: str) -> None:
    base = shipped_database()
    changes: dict[str, Any] = {}
    if damage == "negative damping":
        changes["damping"] = base.damping - 0.1 * np.diag(
            np.diagonal(base.damping, axis1=1, axis2=2).max(axis=0)
        )
    elif damage == "skew added mass":
        skew = base.added_mass.copy()
        skew[:, 2, 4] *= -1.0
        changes["added_mass"] = skew
    elif damage == "sway forces a fifth too large":
        changes["force"] = base.force * np.array([1, 1.2, 1, 1, 1, 1])
    else:
        assert base.infinite_frequency_added_mass is not None
        changes["infinite_frequency_added_mass"] = 1.3 * base.infinite_frequency_added_mass
    assert rows_of(dataclasses.replace(base, **changes))[check].verdict == "fail"


def test_rows_are_plain_json() -> None:
    import json

    rows = [row.as_dict() for row in shipped_database().check()]
    text = json.dumps(rows)
    assert set(json.loads(text)[0]) == {"check", "value", "limit", "verdict"}
    assert {row["verdict"] for row in rows} <= {"pass", "fail", "info"}
