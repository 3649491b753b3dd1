"""A quick look at any run: whatever it recorded, in our axes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.plotting.panel import COLOURS, Line, Panel, Sheet, draw
from seacrane.result import AXES, MOTIONS, Result

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]


def _lines(names: Sequence[str], values: Array) -> tuple[Line, ...]:
    styles = ("-", "--", ":")
    return tuple(
        Line(label=name, values=values[:, i], colour=i, style=styles[i // len(COLOURS) % len(styles)])
        for i, name in enumerate(names)
    )


def _by_name(result: Result, channel: str, dim: str, values: Array) -> tuple[Line, ...]:
    """One line, or with several of a kind one for each."""
    if dim in result.dims[channel]:
        return _lines(result.coords[dim], values)
    return (Line(label="", values=values),)


def _single(quantity: str, unit: str, values: Array) -> Panel:
    return Panel(quantity=quantity, unit=unit, lines=(Line(label="", values=values),))


def _by_vessel(result: Result, channel: str) -> dict[str, Array]:
    """The values of every vessel, by its name; of the only one as "vessel"."""
    names = result.coords.get("vessel", ())
    return {name: result[channel][:, i] for i, name in enumerate(names)} or {"vessel": result[channel]}


def _vessels(result: Result) -> list[Panel]:
    return [
        panel
        for name, motion in _by_vessel(result, "vessel_motion").items()
        for panel in (
            Panel(quantity=name, unit="m", lines=_lines(MOTIONS[:3], motion[:, :3])),
            Panel(quantity=name, unit="deg", lines=_lines(MOTIONS[3:], np.rad2deg(motion[:, 3:]))),
        )
    ]


def _elevation(result: Result) -> list[Panel]:
    at = _by_vessel(result, "wave_elevation")
    lines = tuple(
        Line(label=name if len(at) > 1 else "", values=values, colour=i)
        for i, (name, values) in enumerate(at.items())
    )
    return [Panel(quantity="wave elevation", unit="m", lines=lines)]


def _payload(result: Result) -> list[Panel]:
    """What hangs on a link or wire, as the run noted it."""
    bodies = str(result.stats.get("payload", "")).splitlines()
    return [
        Panel(quantity=f"{body} position", unit="m", lines=_lines(AXES, result.select("position", body=body)))
        for body in bodies
        if body in result.coords["body"]
    ]


def _strokes(result: Result) -> list[Panel]:
    lines = _lines(result.coords["cylinder"], result["stroke"])
    return [Panel(quantity="stroke", unit="m", lines=lines)]


def _cylinder_forces(result: Result) -> list[Panel]:
    lines = _lines(result.coords["cylinder"], result["cylinder_force"] / 1e3)
    return [Panel(quantity="cylinder force", unit="kN", lines=lines)]


def _slew_angles(result: Result) -> list[Panel]:
    lines = _by_name(result, "slew_angle", "slew", np.rad2deg(result["slew_angle"]))
    return [Panel(quantity="slew angle", unit="deg", lines=lines)]


def _link_tensions(result: Result) -> list[Panel]:
    lines = _by_name(result, "link_tension", "hook", result["link_tension"] / 1e3)
    return [Panel(quantity="link tension", unit="kN", lines=lines)]


def _joint_forces(result: Result) -> list[Panel]:
    size = np.linalg.norm(result["reaction_force"], axis=2) / 1e3
    return [Panel(quantity="joint force", unit="kN", lines=_lines(result.coords["joint"], size))]


# Which channel brings which panels; a channel the run has not is left out of the picture.
PANELS: dict[str, Callable[[Result], list[Panel]]] = {
    "vessel_motion": _vessels,
    "wave_elevation": _elevation,
    "position": _payload,
    "slew_angle": _slew_angles,
    "stroke": _strokes,
    "cylinder_force": _cylinder_forces,
    "link_tension": _link_tensions,
    "reaction_force": _joint_forces,
    "energy_balance": lambda r: [_single("energy balance", "J", r["energy_balance"])],
}


def overview_sheet(result: Result) -> Sheet:
    """The panels of `plot_overview` with their numbers."""
    panels = [panel for name, make in PANELS.items() if name in result.channels for panel in make(result)]
    if not panels:
        raise ValueError(f"a result with {', '.join(result.channels) or 'no channels'} has nothing to plot")
    return Sheet(
        title=f"{result.stats['scene']}{' (interrupted)' if result.interrupted else ''}",
        caption="Overview of the recorded channels; x forward, y to port, z up.",
        abscissa=result.time,
        panels=tuple(panels),
        columns=2 if len(panels) > 3 else 1,
    )


def plot_overview(result: Result) -> Figure:
    """Draw what a run recorded: motions, waves, crane, forces and energy balance.

    Parameters
    ----------
    result : Result
        Any run.

    Returns
    -------
    matplotlib.figure.Figure
        ``figure.savefig(path)`` writes it; a notebook shows it. Our axes: x forward, y to port, z up.

    Raises
    ------
    ValueError
        If the run recorded nothing that is plotted.
    """
    return draw(overview_sheet(result))
