"""A quick look at any run: whatever it recorded, in our axes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.figures.panel import COLOURS, Line, Panel, Sheet, draw
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


def _single(quantity: str, unit: str, values: Array) -> Panel:
    return Panel(quantity=quantity, unit=unit, lines=(Line(label="", values=values),))


def _vessel(result: Result) -> list[Panel]:
    motion = result["vessel_motion"]
    return [
        Panel(quantity="vessel", unit="m", lines=_lines(MOTIONS[:3], motion[:, :3])),
        Panel(quantity="vessel", unit="deg", lines=_lines(MOTIONS[3:], np.rad2deg(motion[:, 3:]))),
    ]


def _last_body(result: Result) -> list[Panel]:
    body = result.coords["body"][-1]
    return [
        Panel(quantity=f"{body} position", unit="m", lines=_lines(AXES, result.select("position", body=body)))
    ]


def _strokes(result: Result) -> list[Panel]:
    lines = _lines(result.coords["cylinder"], result["stroke"])
    return [Panel(quantity="stroke", unit="m", lines=lines)]


def _cylinder_forces(result: Result) -> list[Panel]:
    lines = _lines(result.coords["cylinder"], result["cylinder_force"] / 1e3)
    return [Panel(quantity="cylinder force", unit="kN", lines=lines)]


def _joint_forces(result: Result) -> list[Panel]:
    size = np.linalg.norm(result["reaction_force"], axis=2) / 1e3
    return [Panel(quantity="joint force", unit="kN", lines=_lines(result.coords["joint"], size))]


# Which channel brings which panels; a channel the run has not is left out of the picture.
PANELS: dict[str, Callable[[Result], list[Panel]]] = {
    "vessel_motion": _vessel,
    "wave_elevation": lambda r: [_single("wave elevation", "m", r["wave_elevation"])],
    "position": _last_body,
    "slew_angle": lambda r: [_single("slew angle", "deg", np.rad2deg(r["slew_angle"]))],
    "stroke": _strokes,
    "cylinder_force": _cylinder_forces,
    "link_tension": lambda r: [_single("link tension", "kN", r["link_tension"] / 1e3)],
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
