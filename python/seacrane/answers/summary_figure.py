"""The curves of a summary over time, as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

from seacrane.answers.reported_curves import Curve, reported_curves
from seacrane.errors import SceneError
from seacrane.inputs.frames import AXES_NOTE
from seacrane.plotting.panel import Line, Panel, Sheet, draw
from seacrane.result import Result
from seacrane.result.history import marks_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def plot_summary(result: Result) -> Figure:
    """Draw what `summary` tells in numbers, a panel for each kind and unit, with events and extremes marked.

    Raises
    ------
    SceneError
        If the run recorded nothing that a summary holds.
    """
    return draw(summary_sheet(result))


def summary_sheet(result: Result) -> Sheet:
    """The panels of `plot_summary` with their numbers."""
    groups: dict[tuple[str, str], list[Curve]] = {}
    for one in reported_curves(result):
        groups.setdefault((one.kind, one.unit), []).append(one)
    if not groups:
        raise SceneError(
            f"a result with {', '.join(result.channels) or 'no channels'} has no load and no motion to "
            "draw; record link_tension, cylinder_force, position or vessel_motion"
        )
    panels = [
        Panel(
            quantity=kind, unit=unit,
            lines=tuple(Line(label=one.label, values=one.values, colour=i) for i, one in enumerate(group)),
        )
        for (kind, unit), group in groups.items()
    ]  # fmt: skip
    return Sheet(
        title=f"{result.stats['scene']}{' (interrupted)' if result.interrupted else ''}",
        caption=f"Triangles mark the largest and the smallest value. {AXES_NOTE}",
        abscissa=result.time, panels=tuple(panels), columns=2 if len(panels) > 3 else 1,
        marks=marks_of(result), extremes=True,
    )  # fmt: skip
