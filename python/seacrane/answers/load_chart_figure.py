"""The allowable load over the radius, a curve for each slew angle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from seacrane.answers.load_chart import ANGLES, LoadChart
from seacrane.errors import SceneError
from seacrane.plotting.panel import Line, Panel, Sheet, draw

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def plot_load_chart(chart: LoadChart) -> Figure:
    """Draw the allowable load over the radius, a curve for each slew angle, and the crane's own table.

    Returns
    -------
    matplotlib.figure.Figure
        Where nothing limits the load, or no load is allowed at all, curves are left out.

    Raises
    ------
    SceneError
        For what is no chart, or one without a finite load.
    """
    if not isinstance(chart, LoadChart):
        raise SceneError(f"chart is a {type(chart).__name__}; give what load_chart() returns")
    return draw(load_chart_sheet(chart))


def _told(name: str, low: float, high: float) -> str:
    """A limit in the units in which it is read; a mass or a force has no factor that a word would need."""
    if name.split(" ")[0] in ANGLES:
        return f"{name} {np.degrees(low):g} to {np.degrees(high):g} deg"
    return f"{name} {low:g} to {high:g}"


def load_chart_sheet(chart: LoadChart) -> Sheet:
    """The panel of `plot_load_chart` with its numbers."""
    order = np.argsort(chart.radii)
    loads = np.where(np.isfinite(chart.allowable), chart.allowable / 1e3, np.nan)[:, order]
    if not np.isfinite(loads).any():
        raise SceneError(f"load chart of {chart.scene!r}: no pose has a finite allowable load to draw")
    lines = [
        Line(label=f"slew {np.degrees(slew):.4g} deg", values=row, colour=i, style="-o")
        for i, (slew, row) in enumerate(zip(chart.slews, loads, strict=True))
    ]
    if chart.capacity is not None:
        lines.append(
            Line(label="table of the crane", values=chart.capacity[order] / 1e3, colour=6, style="--")
        )
    limits = ", ".join(_told(name, *bounds) for name, bounds in chart.limits.items())
    return Sheet(
        title=f"{chart.scene}: allowable load at rest",
        caption=f"Limits: {limits or 'the table of the crane'}. No dynamic factor.",
        abscissa=chart.radii[order], abscissa_name="radius", abscissa_unit="m",
        panels=(Panel(quantity="allowable load", unit="t", lines=tuple(lines)),),
    )  # fmt: skip
