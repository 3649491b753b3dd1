"""A quick look at any run: whatever it recorded, in our axes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.inputs.frames import AXES_NOTE
from seacrane.inputs.keywords import named
from seacrane.plotting.panel import Panel, Sheet, draw
from seacrane.result import Result
from seacrane.result.history import axes_note, marks_of, panels_of, title_of
from seacrane.result.traces import Trace, beyond_rounding, shown_unit, traces

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
Panels = list[tuple[str, list[Trace]]]


def resultants(result: Result, channel: str) -> list[Trace]:
    """Magnitudes of a channel's vectors, by what they belong to."""
    size = np.linalg.norm(result[channel], axis=-1)
    names = result.coords[result.dims[channel][1]]
    units = {"reaction_force": "N", "reaction_moment": "N m"}
    factor, unit = shown_unit(units[channel], [size])
    return [
        Trace(channel=channel, names=(name,), unit=unit, values=factor * size[:, i])
        for i, name in enumerate(names)
    ]


def payload_bodies(result: Result) -> list[str]:
    """What hangs on a link or wire, as the run noted it."""
    bodies = str(result.stats.get("payload", "")).splitlines()
    return [body for body in bodies if body in result.coords.get("body", ())]


def _vessels(result: Result) -> Panels:
    names = result.coords.get("vessel", ())
    if not names:
        return [("vessel", traces(result, "vessel_motion"))]
    return [(name, traces(result, "vessel_motion", vessel=name)) for name in names]


def _payload(result: Result) -> Panels:
    return [(f"{body} position", traces(result, "position", body=body)) for body in payload_bodies(result)]


def _channel(name: str) -> Callable[[Result], Panels]:
    return lambda result: [(name.replace("_", " "), traces(result, name))]


# Which channel brings which panels; a channel the run has not is left out of the picture.
PANELS: dict[str, Callable[[Result], Panels]] = {
    "vessel_motion": _vessels,
    "wave_elevation": _channel("wave_elevation"),
    "position": _payload,
    "slew_angle": _channel("slew_angle"),
    "stroke": _channel("stroke"),
    "cylinder_force": _channel("cylinder_force"),
    "link_tension": _channel("link_tension"),
    "line_tension": _channel("line_tension"),
    "limit_force": _channel("limit_force"),
    "reaction_force": lambda result: [("joint force", resultants(result, "reaction_force"))],
    "energy_balance": _channel("energy_balance"),
}
OWNERS = {"vessel_motion": "vessel", "position": "body"}  # dimensions that a panel's title names


def overview_sheet(result: Result) -> Sheet:
    """The panels of `plot_overview` with their numbers."""
    panels = _panels(result, beyond_rounding) or _panels(result, list)
    if not panels:
        held = ", ".join(result.channels) or "no channels"
        raise ValueError(f"a result with {held} has nothing to plot")
    return Sheet(
        title=title_of(result),
        caption=f"What was recorded; triangles mark the largest and the smallest value. {AXES_NOTE}",
        abscissa=result.time,
        panels=tuple(panels),
        columns=2 if len(panels) > 3 else 1,
        marks=marks_of(result),
        extremes=True,
    )


def _panels(result: Result, chosen: Callable[[list[Trace]], list[Trace]]) -> list[Panel]:
    return [
        panel
        for name, make in PANELS.items()
        if name in result.channels
        for quantity, found in make(result)
        for panel in panels_of(quantity, chosen(found), skip=int(OWNERS.get(name) in result.dims[name]))
    ]


@named
def plot_overview(result: Result) -> Figure:
    """Draw what a run recorded: motions, waves, payload, crane, forces and energy balance.

    What is zero up to rounding is left out, as the sway of a ship in head seas. Events of limits are marked,
    and the largest and the smallest value of every panel.

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
    return draw(overview_sheet(result), note=axes_note(result, result.channels))
