"""HydroDatabase.plot: what the figures show is what the database, its fits and closed forms hold."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane.hydro import HydroDatabase, load_database, motion_response, shipped_database
from seacrane.hydro.data.relations import retardation_from_damping
from seacrane.hydro.database.figures import SHEETS, added_mass_sheet, force_sheet, retardation_sheet

NAMES = ["added_mass", "damping", "retardation", "wave_force", "motion"]


def test_figures_are_labelled_and_chosen_by_name(shared: Path) -> None:
    database = shipped_database()
    figures = database.plot()
    assert list(figures) == NAMES == list(SHEETS)
    for name, figure in figures.items():
        assert "hull_115" in figure.get_suptitle() and figure.legends
        for axes in figure.axes:
            assert axes.get_ylabel().endswith("]") and len(axes.lines) >= 2
            shaded = [patch.get_x() for patch in axes.patches]
            assert shaded == ([] if name == "retardation" else [0.3])
    tanker = load_database(shared / "wamit")  # without memory
    assert list(tanker.plot(["damping", "motion"])) == ["damping", "motion"]
    with pytest.raises(ValueError, match=r"'drift'.*added_mass, damping"):
        tanker.plot("drift")
    heave = next(axes for axes in tanker.plot("motion")["motion"].axes if "|heave|" in axes.get_ylabel())
    lines = {line.get_label(): np.asarray(line.get_ydata()) for line in heave.lines}
    at = int(np.argmin(np.abs(tanker.heading - np.pi)))
    assert lines["180 deg"] == pytest.approx(np.abs(motion_response(tanker)[at, :, 2]))
    assert lines["180 deg, file"] == pytest.approx(np.abs(tanker.motion_rao[at, :, 2]))


def panel_of(sheet: Any, quantity: str) -> dict[str, np.ndarray]:
    panel = next(panel for panel in sheet.panels if panel.quantity == quantity)
    return {line.label: line.values for line in panel.lines}


def test_fits_and_limits_are_those_of_the_memory() -> None:
    database = shipped_database()
    memory = database.memory
    lines = panel_of(added_mass_sheet(database, memory), "A35")
    assert np.array_equal(lines["database"], database.added_mass[:, 2, 4])
    assert lines["memory model"] == pytest.approx(memory.frequency_response(database.omega)[0][:, 2, 4])
    assert np.all(lines["model, infinite frequency"] == memory.added_mass[2, 4])
    data, model = panel_of(retardation_sheet(database, memory), "K33").values()
    assert np.sqrt(np.mean((data - model) ** 2) / np.mean(data**2)) < 0.06  # the fit's misfit of K, docs


def test_phases_are_drawn_where_they_mean_something() -> None:
    database = shipped_database()
    lines = panel_of(force_sheet(database), "sway force phase")
    assert np.all(np.isnan(lines["180 deg"]))  # no sway in head sea
    outside = (database.omega < 0.3 - 1e-9) | (database.omega > 2.5 + 1e-9)
    at = int(np.argmin(np.abs(database.heading - np.pi / 2)))
    expected = np.degrees(np.angle(database.force[at, :, 1]))
    assert lines["90 deg"] == pytest.approx(np.where(outside, np.nan, expected), nan_ok=True)


def sampled(step: float) -> tuple[HydroDatabase, np.ndarray, np.ndarray]:
    """Heave damping of ``K(t) = e^-at (cos ct - a / c sin ct)``, sampled; times; K itself."""
    a, c, scale = 0.4, 1.1, 1e6
    base = shipped_database()
    omega = np.arange(step, 40.0 + step / 2, step)
    damping = np.zeros((len(omega), 6, 6))
    damping[:, 2, 2] = scale * (1j * omega / ((1j * omega + a) ** 2 + c**2)).real
    force = np.ones((len(base.heading), len(omega), 6))
    tables = {"omega": omega, "added_mass": 0.0 * damping, "damping": damping, "force": force}
    time = np.array([0.0, 0.3, 1.0, 2.5, 6.0, 12.0])
    exact = scale * np.exp(-a * time) * (np.cos(c * time) - a / c * np.sin(c * time))
    return dataclasses.replace(base, **tables, trusted_band=None, memory=None), time, exact


def test_retardation_of_a_closed_form_converges() -> None:
    """Straight lines between frequencies: second order, until the tail (here w^-2, not w^-3) decides."""
    errors = []
    for step in (0.2, 0.1, 0.05):
        database, time, exact = sampled(step)
        found = retardation_from_damping(database, time)[:, 2, 2]
        errors.append(np.abs(found - exact)[2:].max())
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
