"""Self-check, exact relations, the trusted band of files that do not tell their panels, figures."""

from __future__ import annotations

import dataclasses
import logging
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

from seacrane.hydro import (
    CheckRow,
    HydroDatabase,
    load_database,
    motion_response,
    natural_frequency,
    read_capytaine,
    shipped_database,
)
from seacrane.hydro.data.data_warnings import warn_of_data
from seacrane.hydro.data.relations import (
    damping_from_forces,
    infinite_added_mass_from_damping,
    retardation_from_damping,
)
from seacrane.hydro.database.figures import radiation_sheet, retardation_sheet
from seacrane.hydro.readers.as_read import first_rough_value
from seacrane.warnings import DampingWarning, RoughDataWarning

MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")


def rows_of(database: HydroDatabase) -> dict[str, CheckRow]:
    return {row.check: row for row in database.check()}


@pytest.mark.warns("InfiniteFrequencyWarning")
def test_the_supply_vessel_closes(shared: Path) -> None:
    supply = load_database(shared / "veres" / "supply")
    rows = rows_of(supply)
    for motion in MOTIONS:
        row = rows[f"motion_rao_{motion}"]
        assert row.verdict == "pass"
        assert row.limit == (1e-5 if motion in ("heave", "pitch") else 1e-3)
    assert rows["surge_terms_missing"].value == 1.0
    assert rows["memory_r2_damping_33"].verdict == "pass"  # fitted for the check: the files hold none
    narrow = dataclasses.replace(supply, trusted_band=(0.3, 0.4))
    assert not [name for name in rows_of(narrow) if name.startswith("memory")]


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
        assert rows_of(dataclasses.replace(base, **changes))[check].verdict == "fail"


def rough_from(database: HydroDatabase) -> float | None:
    """Frequency of the first jump, rad/s."""
    found = first_rough_value(database)
    return None if found is None else float(database.omega[found[0]])


def scales(database: HydroDatabase) -> tuple[np.ndarray, np.ndarray]:
    """What A and B of each pair vary by, (6, 6)."""
    a = np.ptp(np.diagonal(database.added_mass, axis1=1, axis2=2), axis=0)
    b = np.diagonal(database.damping, axis1=1, axis2=2).max(axis=0)
    return np.sqrt(np.outer(a, a)), np.sqrt(np.outer(b, b))


def test_noise_is_found_where_it_begins_and_nothing_in_sound_data(shared: Path) -> None:
    """The shipped hull has a lid; thinned to steps of 0.3 rad/s its curves are coarse, and still no noise."""
    base = shipped_database()
    for sound in (*(base.select(every=n) for n in (1, 2, 4, 6)), load_database(shared / "veres" / "supply")):
        assert rough_from(sound) is None
    noise = np.random.default_rng(3).normal(size=(2, len(base.omega), 6, 6))
    noise = (noise + noise.swapaxes(2, 3)) / np.sqrt(2.0)
    for above in (1.3, 1.6, 2.0, 2.4):
        for level in (0.01, 0.03):
            part = level * noise * (base.omega >= above - 1e-9)[:, None, None]
            of_a, of_b = (one * scale for one, scale in zip(part, scales(base), strict=True))
            noisy = {"added_mass": base.added_mass + of_a, "damping": base.damping + of_b}
            found = rough_from(dataclasses.replace(base, **noisy, memory=None))
            assert found is not None and abs(found - above) < 2.5 * 0.05


def test_a_spike_of_an_irregular_frequency_is_found_and_named() -> None:
    base = shipped_database()
    at = int(np.searchsorted(base.omega, 1.8))
    for j, k, name in ((2, 2, "A33"), (4, 4, "B55"), (1, 3, "B24")):
        matrix = "damping" if name.startswith("B") else "added_mass"
        table = getattr(base, matrix).copy()
        for pair in {(j, k), (k, j)}:
            table[at, *pair] += 0.03 * scales(base)[name.startswith("B")][pair]
        found = first_rough_value(dataclasses.replace(base, memory=None, **{matrix: table}))
        assert found is not None and at - 2 <= found[0] <= at and found[1] == name
    damping = base.damping.copy()  # a peak of one step in long waves, as of a moonpool, is kept
    damping[int(np.searchsorted(base.omega, 0.8)), 2, 2] *= 1.5
    assert rough_from(dataclasses.replace(base, damping=damping, memory=None)) is None


@pytest.mark.warns(sometimes=["AsymmetryWarning"])
def test_the_first_irregular_frequency_of_a_barge_ends_its_band(tmp_path: Path) -> None:
    """Panels of a box 60 x 20 x 4 m without a lid fail at the eigenfrequencies of the water inside it.

    omega^2 = g k coth(k T), k = pi sqrt(1 / L^2 + 1 / B^2) [Faltinsen 1990, Sea Loads, section 4].
    """
    capytaine = pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    mesh = capytaine.mesh_parallelepiped(size=(60.0, 20.0, 8.0), resolution=(16, 6, 4)).immersed_part()
    dofs = capytaine.rigid_body_dofs(rotation_center=(0.0, 0.0, 0.0))
    body = capytaine.FloatingBody(mesh=mesh, dofs=dofs, name="barge", center_of_mass=(0.0, 0.0, 2.0))
    body.inertia_matrix = body.compute_rigid_body_inertia()
    body.hydrostatic_stiffness = body.compute_hydrostatic_stiffness()
    coords: dict[str, Any] = {"omega": np.arange(0.8, 2.21, 0.05), "radiating_dof": list(body.dofs)}
    coords |= {"wave_direction": np.radians([0.0, 45.0, 90.0, 135.0, 180.0]), "water_depth": [np.inf]}
    barge = capytaine.BEMSolver().fill_dataset(xarray.Dataset(coords=coords), body, progress_bar=False)
    capytaine.export_dataset(str(tmp_path / "barge.nc"), barge)
    with pytest.warns(RoughDataWarning):
        found = read_capytaine(tmp_path / "barge.nc")
    k = np.pi * np.hypot(1.0 / 60.0, 1.0 / 20.0)
    irregular = np.sqrt(9.81 * k / np.tanh(k * 4.0))
    assert irregular - 4 * 0.05 < found.trusted_band[1] < irregular
    with pytest.warns(DampingWarning):
        warn_of_data(dataclasses.replace(found, trusted_band=None))
    warn_of_data(found)


def test_figures_show_the_motions_that_are_computed(shared: Path) -> None:
    tanker = load_database(shared / "wamit")  # without memory
    assert list(tanker.plot(["damping", "motion"])) == ["damping", "motion"]
    heave = next(axes for axes in tanker.plot("motion")["motion"].axes if "|heave|" in axes.get_ylabel())
    lines = {line.get_label(): np.asarray(line.get_ydata()) for line in heave.lines}
    at = int(np.argmin(np.abs(tanker.heading - np.pi)))
    assert lines["180 deg"] == pytest.approx(np.abs(motion_response(tanker)[at, :, 2]))
    assert lines["180 deg, file"] == pytest.approx(np.abs(tanker.motion_rao[at, :, 2]))


def test_retardation_of_a_closed_form_converges() -> None:
    """Heave damping of ``K(t) = e^-at (cos ct - a / c sin ct)``, sampled.

    Straight lines between frequencies: second order, until the tail (here w^-2, not w^-3) decides.
    """
    a, c, scale, errors = 0.4, 1.1, 1e6, []
    base, time = shipped_database(), np.array([1.0, 2.5, 6.0, 12.0])
    exact = scale * np.exp(-a * time) * (np.cos(c * time) - a / c * np.sin(c * time))
    for step in (0.2, 0.1, 0.05):
        omega = np.arange(step, 40.0 + step / 2, step)
        damping = np.zeros((len(omega), 6, 6))
        damping[:, 2, 2] = scale * (1j * omega / ((1j * omega + a) ** 2 + c**2)).real
        force = np.ones((len(base.heading), len(omega), 6))
        tables = {"omega": omega, "added_mass": 0.0 * damping, "damping": damping, "force": force}
        database = dataclasses.replace(base, **tables, trusted_band=None, memory=None)
        errors.append(np.abs(retardation_from_damping(database, time)[:, 2, 2] - exact).max())
    assert errors[2] < 2e-3 * 1e6
    assert np.log2(errors[0] / errors[1]) > 1.7


def test_retardation_of_the_memory_is_its_impulse_response() -> None:
    """exp(A t) against the inverse transform of the model's own damping, on a fine and long grid."""
    memory = shipped_database().memory
    omega = np.linspace(0.0, 400.0, 80001)
    time = np.array([0.5, 3.0, 8.0])
    damping = memory.frequency_response(np.maximum(omega, 1e-9))[1]
    for j, k in ((2, 2), (1, 3), (2, 4)):
        waves = np.cos(np.outer(time, omega)) * damping[:, j, k]
        expected = 2.0 / np.pi * np.trapezoid(waves, omega, axis=1)
        found = memory.impulse_response(time)[:, j, k]
        assert found == pytest.approx(expected, abs=1e-3 * np.abs(memory.impulse_response([0.0])[0, j, k]))


def test_fits_in_the_figures_are_those_of_the_memory() -> None:
    database = shipped_database()
    memory = database.memory
    drawn = [radiation_sheet(database, 0), retardation_sheet(database)]
    a35, k33 = (
        {line.label: line.values for panel in sheet.panels if panel.quantity == name for line in panel.lines}
        for sheet, name in zip(drawn, ("A35", "K33"), strict=True)
    )
    assert np.array_equal(a35["database"], database.added_mass[:, 2, 4])
    assert a35["memory model"] == pytest.approx(memory.frequency_response(database.omega)[0][:, 2, 4])
    assert np.all(a35["model, infinite frequency"] == memory.added_mass[2, 4])
    data, model = k33.values()
    assert np.sqrt(np.mean((data - model) ** 2) / np.mean(data**2)) < 0.06
