"""Work-precision diagrams of a trade."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from seacrane.accuracy.row import Row, front
from seacrane.plotting.figure import new_figure
from seacrane.plotting.panel import plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MARKERS = "ovs^Dp*hXP"
OTHER = "0.72"  # the grey of methods that some other beats everywhere
HEIGHT, WIDTHS = 4.0, (7.5, 6.0)  # inches: of a row; of methods, of less physics
ROOM = 3.0  # times the largest cost: room for names on the right
COSTS = {
    "wall_s": "wall time per simulated second [ms]",
    "cpu_s": "CPU time per simulated second [ms]",
}
Label = Mapping[str, str]


@dataclass(frozen=True, kw_only=True)
class Measured:
    """What one row of panels shows.

    Attributes
    ----------
    quantity, unit : Of the errors.
    uncertainty : Of the reference.
    """

    quantity: str
    unit: str
    uncertainty: float


def work_precision(
    rows: Sequence[Row], measured: Sequence[Measured], full_case: Label, title: str, over: str
) -> Figure:
    """A row of panels for each quantity: largest error over cost of each method, and of less physics.

    On the left one line for each integrator on the full scene, through those of its settings, in either
    formulation, that none of its own beats in both cost and error. Integrators on the Pareto front of some
    quantity have a colour, all others are grey with their name beside them. Dashed lines are rungs of elastic
    lines, the grey band is the reference's uncertainty. On the right are the errors of a scene with other
    physics, each with its cost.
    """
    full, joined, alone = _sorted_out(rows, full_case)
    fronts = {one.quantity: _own_front(full, one.quantity, over) for one in measured}
    best = dict.fromkeys(row.method.integrator for rows in fronts.values() for row in rows)
    looks = {name: (f"C{n % 10}", MARKERS[n % len(MARKERS)]) for n, name in enumerate(best)}
    columns = 2 if alone else 1
    figure = new_figure(figsize=(sum(WIDTHS[:columns]), HEIGHT * len(measured) + 1.0), layout="constrained")
    panels = figure.subplots(len(measured), columns, squeeze=False, width_ratios=WIDTHS[:columns])
    for axes, one in zip(panels, measured, strict=True):
        _draw_methods(axes[0], full, one, looks, over)
        _draw_rungs(axes[0], joined, one.quantity, over)
        _draw_front(axes[0], fronts[one.quantity], one, over)
        if alone:
            _draw_physics(axes[1], alone, one, over)
    handles = {
        label: handle
        for axes in panels[:, 0]
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
        if handle.get_color() != OTHER
    }
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=6, fontsize=8)
    figure.suptitle(title)
    return figure


def _sorted_out(
    rows: Sequence[Row], full_case: Label
) -> tuple[list[Row], dict[str, list[Row]], dict[str, Row]]:
    """Rows of the full scene; those of other physics by what they change: several settings, or one."""
    changed: dict[str, list[Row]] = {}
    for row in rows:
        if row.stable:
            changed.setdefault(_changed(row, full_case), []).append(row)
    full = changed.pop("", [])
    joined = {label: rows for label, rows in changed.items() if len(rows) > 1}
    return full, joined, {label: rows[0] for label, rows in changed.items() if len(rows) == 1}


def _changed(row: Row, full: Label) -> str:
    """What a row has that the full scene has not."""
    changed = [name for name in full if row.case[name] != full[name]]
    return ", ".join(f"{n} {row.case[n]}" if n in ("memory", "waves") else str(row.case[n]) for n in changed)


def _own_front(rows: Sequence[Row], quantity: str, over: str) -> list[Row]:
    """The rows that none of them beats, the cheapest first."""
    on = front(rows, quantity, cost=over)
    return sorted((row for row, kept in zip(rows, on, strict=True) if kept), key=lambda row: _cost(row, over))


def _points(rows: Sequence[Row], quantity: str, over: str) -> tuple[list[float], list[float]]:
    return [_cost(row, over) for row in rows], [row.error(quantity) for row in rows]


def _cost(row: Row, over: str) -> float:
    return 1e3 * float(getattr(row, over)) / row.simulated_s


def _draw_methods(
    axes: Axes, rows: Sequence[Row], measured: Measured, looks: Mapping[str, tuple[str, str]], over: str
) -> None:
    names = dict.fromkeys(row.method.integrator for row in rows)
    for name in sorted(names, key=lambda name: name in looks):
        own = [row for row in rows if row.method.integrator == name]
        points = _points(_own_front(own, measured.quantity, over), measured.quantity, over)
        if not points[0]:
            continue
        colour, marker = looks.get(name, (OTHER, "."))
        axes.loglog(*points, "-", color=colour, marker=marker, markersize=4, linewidth=1.2, label=name)
        if name not in looks:
            axes.annotate(
                name, (points[0][-1], points[1][-1]), xytext=(4, 0), textcoords="offset points",
                fontsize=7, color="0.35", va="center",
            )  # fmt: skip
    axes.set_xlabel(COSTS[over])
    axes.set_ylabel(f"largest error [{measured.unit}]")
    axes.set_title(plain(measured.quantity.replace("_", " ")) + ": methods", fontsize=10)
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_xlim(right=ROOM * axes.get_xlim()[1])
    axes.grid(alpha=0.3)


def _draw_rungs(axes: Axes, rungs: Mapping[str, Sequence[Row]], quantity: str, over: str) -> None:
    """Rungs at several tolerances, each a dashed line."""
    for number, (label, rows) in enumerate(rungs.items()):
        axes.loglog(
            *_points(rows, quantity, over), "--", color="black", marker=MARKERS[number % len(MARKERS)],
            markersize=5, linewidth=1.5, label=label,
        )  # fmt: skip


def _draw_front(axes: Axes, best: Sequence[Row], measured: Measured, over: str) -> None:
    axes.step(
        *_points(best, measured.quantity, over), where="post", color="black", linewidth=5.0, alpha=0.15,
        label="Pareto front", solid_capstyle="butt",
    )  # fmt: skip
    axes.axhspan(0.0, measured.uncertainty, color="0.9")


def _draw_physics(axes: Axes, rows: Mapping[str, Row], measured: Measured, over: str) -> None:
    """Less physics, one line of text for each, the largest error on top."""
    known = {label: row for label, row in rows.items() if row.error(measured.quantity) > 0.0}
    order = sorted(known, key=lambda label: known[label].error(measured.quantity))
    axes.semilogx([known[label].error(measured.quantity) for label in order], range(len(order)), "kx")
    axes.set_yticks(range(len(order)), [_with_cost(label, known[label], over) for label in order], fontsize=7)
    axes.set_xlabel(f"largest error [{measured.unit}]")
    axes.set_title("less physics; in brackets the cost [ms]", fontsize=10)
    axes.grid(alpha=0.3)


def _with_cost(label: str, row: Row, over: str) -> str:
    return plain(f"{label} ({_cost(row, over):.2g})")
