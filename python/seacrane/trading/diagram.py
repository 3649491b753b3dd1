"""Work-precision diagrams of a trade."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.experiment.row import Row
from seacrane.plotting.figure import new_figure
from seacrane.plotting.panel import plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMNS = 2
MARKERS = "ovs^Dp*hXP<>d8H"
SHAPES = {"recursive": "-", "redundant": ":"}
COSTS = {
    "wall_s": "wall time per simulated second [s]",
    "cpu_s": "CPU time per simulated second [s]",
}


@dataclass(frozen=True, kw_only=True)
class Measured:
    """What one panel shows.

    Attributes
    ----------
    quantity, unit : str
        Of the errors.
    front : sequence of Row
        Rows that no other beats in both cost and error.
    uncertainty : float
        Of the reference.
    """

    quantity: str
    unit: str
    front: Sequence[Row]
    uncertainty: float


def work_precision(
    rows: Sequence[Row], measured: Sequence[Measured], full_case: Mapping[str, str], title: str, over: str
) -> Figure:
    """One panel per quantity: largest error over cost per simulated second, both logarithmic.

    Lines join the tolerances or steps of one integrator, solid in the recursive and dotted in the redundant
    formulation; crosses with a label change the physics, dashed lines the rung of elastic lines; the grey
    band is the reference's uncertainty.
    """
    down = -(-len(measured) // COLUMNS)
    figure = new_figure(figsize=(15.0, 5.2 * down), layout="constrained")
    panels = figure.subplots(down, COLUMNS, squeeze=False).ravel()
    for panel in panels[len(measured) :]:
        panel.set_axis_off()
    for panel, one in zip(panels, measured, strict=False):
        _draw(panel, rows, one, full_case, over)
    handles = {
        label: handle
        for panel in panels
        for handle, label in zip(*panel.get_legend_handles_labels(), strict=True)
    }
    figure.legend(handles.values(), handles.keys(), loc="outside right upper", fontsize=8)
    figure.suptitle(f"{title}; solid recursive, dotted redundant")
    return figure


def _draw(
    axes: Axes, every: Sequence[Row], measured: Measured, full_case: Mapping[str, str], over: str
) -> None:
    from matplotlib.ticker import LogLocator, NullFormatter

    quantity = measured.quantity
    colours: dict[str, Any] = {}
    groups: dict[tuple[str, str], list[Row]] = {}
    fewer: dict[tuple[str, ...], list[Row]] = {}
    for row in every:
        if not row.stable or not np.isfinite(row.error(quantity)):
            continue
        if row.case == full_case:
            groups.setdefault((row.method.integrator, row.formulation), []).append(row)
        else:
            fewer.setdefault(tuple(map(str, row.case.values())), []).append(row)
    for (integrator, formulation), rows in groups.items():
        number = colours.setdefault(integrator, len(colours))
        axes.loglog(
            [_cost(row, over) for row in rows], [row.error(quantity) for row in rows], SHAPES[formulation],
            color=f"C{number % 10}", marker=MARKERS[number % len(MARKERS)], markersize=4, linewidth=1,
            label=integrator if formulation == "recursive" else None,
            markerfacecolor=None if number < 10 else "white",
        )  # fmt: skip
        if formulation != "recursive" and (integrator, "recursive") not in groups:
            axes.lines[-1].set_label(integrator)
    best = sorted(measured.front, key=lambda row: _cost(row, over))
    axes.step(
        [_cost(row, over) for row in best], [row.error(quantity) for row in best], where="post",
        color="black", linewidth=2.5, alpha=0.35, label="Pareto front",
    )  # fmt: skip
    alone = [rows[0] for rows in fewer.values() if len(rows) == 1]
    _join(axes, [rows for rows in fewer.values() if len(rows) > 1], quantity, full_case, over)
    _mark(axes, alone, quantity, full_case, over)
    axes.axhspan(0.0, measured.uncertainty, color="0.85")
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel(COSTS[over])
    axes.set_ylabel(f"largest error [{measured.unit}]")
    axes.set_title(plain(quantity.replace("_", " ")))
    axes.grid(alpha=0.3)


def _cost(row: Row, over: str) -> float:
    return float(getattr(row, over)) / row.simulated_s


def _join(
    axes: Axes, rungs: Sequence[Sequence[Row]], quantity: str, full: Mapping[str, str], over: str
) -> None:
    """Rungs at several tolerances, each a dashed line."""
    for number, rows in enumerate(rungs):
        axes.loglog(
            [_cost(row, over) for row in rows], [row.error(quantity) for row in rows], "--", color="black",
            marker=MARKERS[number % len(MARKERS)], markersize=5, linewidth=1.5, label=_changed(rows[0], full),
        )  # fmt: skip


def _changed(row: Row, full: Mapping[str, str]) -> str:
    """What a row has that the full scene has not."""
    changed = [name for name in full if row.case[name] != full[name]]
    return ", ".join(f"memory {row.case[n]}" if n == "memory" else str(row.case[n]) for n in changed)


def _mark(axes: Axes, rows: list[Row], quantity: str, full: Mapping[str, str], over: str) -> None:
    """Rungs, each labelled by what differs from the full scene; labels keep a distance from each other."""
    height = -np.inf
    low, high = np.log10(axes.get_ylim())
    for row in sorted(rows, key=lambda row: row.error(quantity)):
        label = _changed(row, full)
        axes.loglog(_cost(row, over), row.error(quantity), "kx", markersize=6)
        height = max(height + 0.028 * (high - low), np.log10(row.error(quantity)))
        place = (1.03 * axes.get_xlim()[1], 10.0**height)
        axes.annotate(
            label, (_cost(row, over), row.error(quantity)), xytext=place, textcoords="data", fontsize=7,
            annotation_clip=False, arrowprops={"arrowstyle": "-", "linewidth": 0.4, "color": "0.6"},
        )  # fmt: skip
