"""HydroDatabase.plot: what the figures show is what the database, its fits and closed forms hold."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from seacrane.hydro import HydroDatabase, load_database, motion_response, shipped_database
from seacrane.hydro.data.relations import retardation_from_damping
from seacrane.hydro.database.figures import SHEETS, added_mass_sheet, force_sheet, retardation_sheet

NAMES = ["added_mass", "damping", "retardation", "wave_force", "motion"]


@pytest.fixture(scope="module")
def tanker(shared: Path) -> HydroDatabase:
    """The WAMIT tanker, without memory."""
    return load_database(shared / "wamit")


def test_all_figures_have_labelled_axes_and_legends() -> None:
    figures = shipped_database().plot()
    assert list(figures) == NAMES == list(SHEETS)
    for name, figure in figures.items():
        assert "hull_115" in figure.get_suptitle()
        assert figure.legends, name
        for axes in figure.axes:
            assert axes.get_ylabel().endswith("]") and len(axes.lines) >= 2
            shaded = [patch.get_x() for patch in axes.patches]
            assert shaded == ([] if name == "retardation" else [0.3])
        assert figure.axes[-1].get_xlabel() in ("omega [rad/s]", "time [s]")


def test_chosen_figures(tanker: HydroDatabase) -> None:
    assert list(tanker.plot("motion")) == ["motion"]
    assert list(tanker.plot(["damping", "added_mass"])) == ["damping", "added_mass"]
    (axes, *_) = tanker.plot("added_mass")["added_mass"].axes
    assert [line.get_label() for line in axes.lines] == ["database", "database, infinite frequency"]
    assert axes.lines[1].get_ydata() == pytest.approx(
        np.full(len(tanker.omega), tanker.infinite_frequency_added_mass[0, 0])  # type: ignore[index]
    )
    with pytest.raises(ValueError, match="there is no figure 'drift'; choose among added_mass, damping"):
        tanker.plot("drift")


def test_solved_motions_beside_those_of_the_file(tanker: HydroDatabase) -> None:
    figure = tanker.plot("motion")["motion"]
    assert tanker.motion_rao is not None
    heave = next(axes for axes in figure.axes if axes.get_ylabel().startswith("|heave|"))
    lines = {line.get_label(): np.asarray(line.get_ydata()) for line in heave.lines}
    at = int(np.argmin(np.abs(tanker.heading - np.pi)))
    assert lines["180 deg"] == pytest.approx(np.abs(motion_response(tanker)[at, :, 2]))
    assert lines["180 deg, file"] == pytest.approx(np.abs(tanker.motion_rao[at, :, 2]))


def test_fits_and_limits_are_those_of_the_memory() -> None:
    database = shipped_database()
    memory = database.memory
    assert memory is not None
    sheet = added_mass_sheet(database, memory)
    panel = next(panel for panel in sheet.panels if panel.quantity == "A35")
    lines = {line.label: line.values for line in panel.lines}
    assert np.array_equal(lines["database"], database.added_mass[:, 2, 4])
    assert lines["memory model"] == pytest.approx(memory.frequency_response(database.omega)[0][:, 2, 4])
    assert np.all(lines["model, infinite frequency"] == memory.added_mass[2, 4])


def test_phases_are_drawn_where_they_mean_something() -> None:
    database = shipped_database()
    sheet = force_sheet(database)
    panel = next(panel for panel in sheet.panels if panel.quantity == "sway force phase")
    lines = {line.label: line.values for line in panel.lines}
    assert np.all(np.isnan(lines["180 deg"]))  # no sway in head sea
    outside = (database.omega < 0.3 - 1e-9) | (database.omega > 2.5 + 1e-9)
    beam = lines["90 deg"]
    assert np.all(np.isnan(beam[outside])) and np.all(np.isfinite(beam[~outside]))
    at = int(np.argmin(np.abs(database.heading - np.pi / 2)))
    expected = np.degrees(np.angle(database.force[at, :, 1]))[~outside]
    assert beam[~outside] == pytest.approx(expected)


def sampled(step: float) -> tuple[HydroDatabase, np.ndarray, np.ndarray]:
    """Heave damping of ``K(t) = e^-at (cos ct - a / c sin ct)``, sampled; times; K itself."""
    a, c, scale = 0.4, 1.1, 1e6
    base = shipped_database()
    omega = np.arange(step, 40.0 + step / 2, step)
    s = 1j * omega
    damping = np.zeros((len(omega), 6, 6))
    damping[:, 2, 2] = scale * (s / ((s + a) ** 2 + c**2)).real
    database = dataclasses.replace(
        base,
        omega=omega,
        added_mass=np.zeros_like(damping),
        damping=damping,
        force=np.ones((len(base.heading), len(omega), 6)),
        trusted_band=None,
        memory=None,
    )
    time = np.array([0.0, 0.3, 1.0, 2.5, 6.0, 12.0])
    return database, time, scale * np.exp(-a * time) * (np.cos(c * time) - a / c * np.sin(c * time))


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
    assert memory is not None
    omega = np.linspace(0.0, 400.0, 80001)
    time = np.array([0.5, 3.0, 8.0])
    damping = memory.frequency_response(np.maximum(omega, 1e-9))[1]
    for j, k in ((2, 2), (1, 3), (2, 4)):
        waves = np.cos(np.outer(time, omega)) * damping[:, j, k]
        expected = 2.0 / np.pi * np.trapezoid(waves, omega, axis=1)
        found = memory.impulse_response(time)[:, j, k]
        assert found == pytest.approx(expected, abs=1e-3 * np.abs(memory.impulse_response([0.0])[0, j, k]))


def test_fit_and_damping_give_the_same_retardation() -> None:
    database = shipped_database()
    sheet = retardation_sheet(database, database.memory)
    heave = next(panel for panel in sheet.panels if panel.quantity == "K33")
    data, model = (line.values for line in heave.lines)
    assert np.sqrt(np.mean((data - model) ** 2) / np.mean(data**2)) < 0.06  # the fit's misfit of K, docs
