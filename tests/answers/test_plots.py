"""Pictures by one call: what they draw, in which units, and what they refuse."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text
from test_result import crane_result, crane_run, vessel_result

from seacrane import Scene, SceneError, cases, plot_overview, simulate
from seacrane.inputs.frames import AXES_NOTE
from seacrane.pictures import plot_rao, plot_reactions, plot_scene, plot_spectrum, plot_track
from seacrane.pictures.overview import overview_sheet
from seacrane.pictures.plots import draw_track, rao_sheet, spectrum_sheet
from seacrane.plotting.panel import draw
from seacrane.result import Event, Result
from seacrane.result.history import history_sheet
from seacrane.result.traces import traces


@pytest.fixture(scope="module")
def lift() -> Result:
    return crane_result(t_end=20.0)


def test_traces_have_names_and_units_that_people_read(lift: Result) -> None:
    roll = traces(lift, "vessel_motion", motion="roll")[0]
    assert (roll.unit, roll.names) == ("deg", ("roll",))
    np.testing.assert_allclose(roll.values, np.degrees(lift["vessel_motion"][:, 3]))
    main, knuckle = traces(lift, "cylinder_force")
    assert (main.label, knuckle.label, main.unit) == ("main", "knuckle", "kN")
    np.testing.assert_allclose(main.values, lift["cylinder_force"][:, 0] / 1e3)
    assert {one.unit for one in traces(lift, "vessel_motion")} == {"m", "deg"}


def test_a_history_has_a_panel_for_each_unit(lift: Result) -> None:
    sheet = history_sheet(lift, "vessel_motion", "position", body="payload")
    found = [(panel.quantity, panel.unit, [line.label for line in panel.lines]) for panel in sheet.panels]
    assert found == [
        ("vessel motion", "m", ["surge", "sway", "heave"]),
        ("vessel motion", "deg", ["roll", "pitch", "yaw"]),
        ("position", "m", ["payload x", "payload y", "payload z"]),
    ]
    assert [cell.get_ylabel() for cell in lift.plot("link_tension").axes] == ["link tension [kN]"]


def test_extremes_and_events_are_marked() -> None:
    run = crane_run(t_end=20.0)
    at = 7.3
    run["arrays"]["link_tension"][73] = 3e5
    events = [Event(time=at, name="link", kind="contact"), Event(time=9.0, name="link", kind="release")]
    figure = Result.from_arrays(**run, events=events).plot("link_tension")
    (cell,) = figure.axes
    peaks = [line for line in cell.lines if line.get_marker() == "^"]
    (peak,) = peaks
    assert (float(peak.get_xdata()[0]), float(peak.get_ydata()[0])) == pytest.approx((at, 300.0))
    dashed = [float(line.get_xdata()[0]) for line in cell.lines if line.get_linestyle() == "--"]
    assert dashed == [at, 9.0]
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == [
        "contact: taut, or pressed (1)",
        "release: slack, or off (1)",
    ]


def test_what_rounding_alone_draws_is_left_out() -> None:
    run = crane_run(t_end=20.0)
    noise = 1e-15 * np.sin(np.arange(run["time"].size))
    for motion in (1, 3, 5):
        run["arrays"]["vessel_motion"][:, motion] = noise
    run["arrays"]["energy_balance"] = 1e-9 * noise
    sheet = overview_sheet(Result.from_arrays(**run))
    drawn = [line.label for panel in sheet.panels if panel.quantity == "vessel" for line in panel.lines]
    assert drawn == ["surge", "heave", "pitch"]
    (cell,) = [axes for axes in draw(sheet).axes if axes.get_ylabel() == "vessel [deg]"]
    assert [text.get_text() for text in cell.get_legend().get_texts()] == ["pitch"], "the one left is named"
    assert "energy balance" not in [panel.quantity for panel in sheet.panels]


def test_a_figure_of_directions_says_the_axes_once(lift: Result) -> None:
    for figure in (plot_overview(lift), lift.plot("vessel_motion", "position"), plot_track(lift)):
        assert words_of(figure).count(AXES_NOTE) == 1
    for figure in (lift.plot("link_tension"), plot_reactions(lift), draw_track(lift)):
        assert AXES_NOTE not in words_of(figure), "no direction, or on a page that says it itself"


def words_of(figure: Figure) -> list[str]:
    return [text.get_text() for text in figure.findobj(Text)]


def test_a_long_label_takes_two_lines(lift: Result) -> None:
    (panel,) = plot_spectrum(lift, "wave_elevation").axes
    assert panel.get_ylabel() == "S, wave elevation\n[m2 s/rad]"


def test_every_picture_is_a_figure_of_matplotlib(lift: Result) -> None:
    """One call each, and no window."""
    for figure in (
        plot_overview(lift), lift.plot("stroke"), plot_spectrum(lift, "wave_elevation"),
        plot_track(lift), plot_reactions(lift),
    ):  # fmt: skip
        assert isinstance(figure, Figure)
        assert not hasattr(figure, "number"), "pyplot does not know it"


def test_a_constant_looks_constant() -> None:
    run = crane_run(t_end=5.0)
    run["arrays"]["link_tension"] = 9e4 * (1 + 1e-13 * np.sin(np.arange(run["time"].size)))
    (cell,) = Result.from_arrays(**run).plot("link_tension").axes
    low, high = cell.get_ylim()
    assert low < 85.0 and high > 95.0


def test_a_spectrum_keeps_the_variance_and_finds_the_frequency() -> None:
    result = vessel_result(t_end=400.0)
    (panel,) = spectrum_sheet(result, "wave_elevation", after=10.0).panels
    omega = spectrum_sheet(result, "wave_elevation", after=10.0).abscissa
    (line,) = panel.lines
    late = result["wave_elevation"][result.time >= 10.0]
    assert np.trapezoid(line.values, omega) == pytest.approx(late.var(), rel=0.05)
    assert omega[line.values.argmax()] == pytest.approx(2 * np.pi / 8.0, abs=0.07)
    assert panel.unit == "m2 s/rad"
    assert plot_spectrum(result, "wave_elevation").axes


def test_a_track_goes_from_a_circle_to_a_square(lift: Result) -> None:
    figure = plot_track(lift, "payload")
    above = figure.axes[0]
    ends = {line.get_marker(): (line.get_xdata()[0], line.get_ydata()[0]) for line in above.lines[1:]}
    place = lift.select("position", body="payload")
    assert ends == {"o": tuple(place[0, :2]), "s": tuple(place[-1, :2])}
    assert (above.get_xlabel(), above.get_ylabel()) == ("x [m]", "y [m]")


def test_reactions_are_sizes(lift: Result) -> None:
    force, moment = plot_reactions(lift, "A").axes
    expected = np.linalg.norm(lift.select("reaction_force", joint="A"), axis=1) / 1e3
    np.testing.assert_allclose(force.lines[0].get_ydata(), expected)
    assert force.get_ylabel() == "reaction force [kN]" and "reaction moment" in moment.get_ylabel()


def test_an_rao_is_that_of_the_frequency_domain() -> None:
    from seacrane import motion_rao

    scene = cases.vessel(hs=0.0, memory="none")
    omega = np.array([0.5, 0.8])
    sheet = rao_sheet(scene, "vessel", (0.0, 0.0, 0.0), (90.0, 180.0), omega)
    rao = np.abs(motion_rao(scene, omega=omega, direction=np.pi / 2, body="vessel"))
    panels = {panel.quantity: panel for panel in sheet.panels}
    np.testing.assert_allclose(panels["about x"].lines[0].values, np.degrees(rao[:, 3]))
    np.testing.assert_allclose(panels["z"].lines[0].values, rao[:, 2])
    assert panels["z"].lines[1].label == "180 deg" and panels["about x"].unit == "deg/m"
    assert len(plot_rao(scene, body="vessel", omega=omega).axes) == 6


def test_the_scene_is_drawn_from_what_its_run_notes(tmp_path: Any) -> None:
    result = simulate(cases.case2(), t_end=0.2)
    loaded = Result.load(result.save(tmp_path / "case2.nc"))
    first, last = plot_scene(loaded).axes
    labels = {line.get_label() for line in first.lines}
    assert {"vessel", "main_jib", "payload", "link"} <= labels
    hull = np.hstack([line.get_data_3d() for line in first.lines if line.get_color() == "0.45"])
    assert np.ptp(hull[0]) == pytest.approx(115.0, rel=1e-3)
    wire = next(line for line in last.lines if line.get_label() == "link")
    length = np.linalg.norm(np.diff(np.array(wire.get_data_3d()), axis=1))
    assert length == pytest.approx(8.0, abs=1e-6)
    with pytest.raises(ValueError, match="holds no poses or no outline to draw"):
        plot_scene(crane_result(t_end=1.0))


REFUSED = {
    "no channel": (lambda r: r.plot(), "channels: none is named; this result holds position"),
    "an unknown channel": (lambda r: r.plot("lift"), "channel 'lift' is not in this result"),
    "an unknown name": (lambda r: r.plot("position", body="pay"), "no body 'pay' in this result"),
    "a dimension of none": (lambda r: r.plot("stroke", body="king"), "has this dimension"),
    "an unknown body": (lambda r: plot_track(r, "pay"), "body 'pay' is not in this result; it holds vessel"),
    "an unknown joint": (lambda r: plot_reactions(r, "Z"), "joint 'Z' is not in this result; it holds deck"),
    "a late start": (lambda r: plot_spectrum(r, "stroke", after=19.0), "after is 19 s: a spectrum takes 64"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_drawn_is_told(case: str, lift: Result) -> None:
    call, message = REFUSED[case]
    with pytest.raises(SceneError, match=message.replace("(", r"\(")):
        call(lift)


def test_names_do_not_become_formulas(lift: Result) -> None:
    run = crane_run(t_end=2.0)
    run["stats"]["scene"] = "$x^$"
    figure = draw(history_sheet(Result.from_arrays(**run), "stroke"))
    assert figure.get_suptitle() == r"\$x^\$"


def test_a_legend_of_hundreds_is_left_out() -> None:
    scene = Scene(name="many", gravity=0.0)
    for i in range(40):
        scene.add_body(name=f"body {i}", mass=1.0, inertia=np.eye(3), position=(i, 0.0, 0.0))
    result = simulate(scene, t_end=0.1)
    history = result.plot("position")
    assert not any(cell.get_legend() for cell in history.axes)
    assert not any(figure.legends for figure in (history, plot_track(result), plot_scene(result)))
