"""Pictures by one call: what they draw, in which units, and what they refuse."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from matplotlib.text import Text

from seacrane import cases, motion_rao, plot_overview, simulate
from seacrane.inputs.frames import AXES_NOTE
from seacrane.pictures import plot_reactions, plot_scene, plot_track
from seacrane.pictures.plots import rao_sheet, spectrum_sheet
from seacrane.result import Result
from seacrane.result.history import history_sheet
from seacrane.result.traces import traces


@pytest.fixture(scope="module")
def lift() -> Result:
    return simulate(cases.case2(), 20.0)


def test_traces_have_names_and_units_that_people_read(lift: Result) -> None:
    """And a history a panel for each unit; no figure is pyplot's."""
    roll = traces(lift, "vessel_motion", motion="roll")[0]
    assert (roll.unit, roll.names) == ("deg", ("roll",))
    np.testing.assert_allclose(roll.values, np.degrees(lift["vessel_motion"][:, 3]))
    main, knuckle = traces(lift, "cylinder_force")
    assert (main.label, knuckle.label, main.unit) == ("main", "knuckle", "kN")
    np.testing.assert_allclose(main.values, lift["cylinder_force"][:, 0] / 1e3)
    sheet = history_sheet(lift, "vessel_motion", "position", body="payload")
    found = [(panel.quantity, panel.unit, [line.label for line in panel.lines]) for panel in sheet.panels]
    assert found == [
        ("vessel motion", "m", ["surge", "sway", "heave"]),
        ("vessel motion", "deg", ["roll", "pitch", "yaw"]),
        ("position", "m", ["payload x", "payload y", "payload z"]),
    ]
    figure = plot_overview(lift)
    assert [text.get_text() for text in figure.findobj(Text)].count(AXES_NOTE) == 1
    assert not hasattr(figure, "number"), "pyplot does not know it"


def test_a_spectrum_keeps_the_variance_and_finds_the_frequency() -> None:
    run = simulate(cases.vessel(), 400.0)
    result = replace(run, channels={"wave_elevation": np.cos(2 * np.pi * run.time / 8.0)})
    sheet = spectrum_sheet(result, "wave_elevation", after=10.0)
    (panel,), omega = sheet.panels, sheet.abscissa
    (line,) = panel.lines
    late = result["wave_elevation"][result.time >= 10.0]
    assert np.trapezoid(line.values, omega) == pytest.approx(late.var(), rel=0.05)
    assert omega[line.values.argmax()] == pytest.approx(2 * np.pi / 8.0, abs=0.07)
    assert panel.unit == "m2 s/rad"


def test_a_track_goes_from_a_circle_to_a_square_and_reactions_are_sizes(lift: Result) -> None:
    above = plot_track(lift, "payload").axes[0]
    ends = {line.get_marker(): (line.get_xdata()[0], line.get_ydata()[0]) for line in above.lines[1:]}
    place = lift.select("position", body="payload")
    assert ends == {"o": tuple(place[0, :2]), "s": tuple(place[-1, :2])}
    force = plot_reactions(lift, "A").axes[0]
    expected = np.linalg.norm(lift.select("reaction_force", joint="A"), axis=1) / 1e3
    np.testing.assert_allclose(force.lines[0].get_ydata(), expected)
    assert force.get_ylabel() == "reaction force [kN]"


def test_an_rao_is_that_of_the_frequency_domain() -> None:
    scene = cases.vessel(hs=0.0, memory="none")
    omega = np.array([0.5, 0.8])
    sheet = rao_sheet(scene, "vessel", (0.0, 0.0, 0.0), (90.0, 180.0), omega)
    rao = np.abs(motion_rao(scene, omega=omega, direction=np.pi / 2, body="vessel"))
    panels = {panel.quantity: panel for panel in sheet.panels}
    np.testing.assert_allclose(panels["about x"].lines[0].values, np.degrees(rao[:, 3]))
    np.testing.assert_allclose(panels["z"].lines[0].values, rao[:, 2])
    assert panels["z"].lines[1].label == "180 deg" and panels["about x"].unit == "deg/m"


def test_the_scene_is_drawn_from_what_its_run_notes(tmp_path: Any) -> None:
    result = simulate(cases.case2(), t_end=0.2)
    loaded = Result.load(result.save(tmp_path / "case2.nc"))
    first, last = plot_scene(loaded).axes
    hull = np.hstack([line.get_data_3d() for line in first.lines if line.get_color() == "0.45"])
    assert np.ptp(hull[0]) == pytest.approx(115.0, rel=1e-3)
    wire = next(line for line in last.lines if line.get_label() == "link")
    length = np.linalg.norm(np.diff(np.array(wire.get_data_3d()), axis=1))
    assert length == pytest.approx(8.0, abs=1e-6)
