"""Figures as data: lines in panels, drawn and tabulated from the same description.

A panel's picture and the file of its numbers come from one object, so they cannot disagree.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.arrays import Array
from seacrane.inputs.atomic import atomic_write

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")  # Okabe and Ito
SHADE = "#EEF3F8"
NOTE_COLOUR = "0.35"
MARK_COLOURS = ("0.25", "#D55E00", "#0072B2", "#009E73", "#CC79A7")  # of what is marked along the abscissa
ROUNDING = 1e-9  # of its size by which a constant may vary
MOST_MARKS = 200  # of one kind that are drawn: more would hide the curves
MOST_NAMED = 24  # lines that a legend lists: a longer one would hide the figure
LONGEST_LABEL = 25  # letters that fit beside a panel in one line
FEW_LINES = 3  # up to which a panel has room for its extremes in words
DOTS_PER_INCH = 130


def new_figure(**given: Any) -> Figure:
    """A figure of no window and no global state, which a notebook shows as the last expression of a cell.

    Notebooks know how to show figures once pyplot has been loaded; this one tells it by itself.
    """
    from matplotlib.figure import Figure

    figure = Figure(**given)
    figure._repr_png_ = partial(png_of, figure, bbox_inches="tight")  # type: ignore[attr-defined]
    return figure


def png_of(figure: Figure, **given: Any) -> bytes:
    """The image of a figure."""
    target = BytesIO()
    figure.savefig(target, format="png", **given)
    return target.getvalue()


@dataclass(frozen=True, kw_only=True)
class Line:
    """One curve over the sheet's abscissa: label and values, shape (n,).

    `bounds`: its least and largest values since the place before, where they are known.
    """

    label: str
    values: Array
    bounds: tuple[Array, Array] | None = None
    style: str = "-"
    colour: int = 0


@dataclass(frozen=True, kw_only=True)
class Panel:
    """Curves of one quantity with one unit."""

    quantity: str
    unit: str
    lines: tuple[Line, ...]

    def extremes(self) -> tuple[tuple[int, int, float], tuple[int, int, float]] | None:
        """Line, index and value of the smallest and of the largest; None where nothing is finite."""
        if not np.isfinite([line.values for line in self.lines]).any():
            return None
        found = []
        for i, where in enumerate((np.nanargmin, np.nanargmax)):
            ends = np.array([one.values if one.bounds is None else one.bounds[i] for one in self.lines])
            line, at = np.unravel_index(int(where(ends)), ends.shape)
            found.append((int(line), int(at), float(ends[line, at])))
        return found[0], found[1]


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """A figure: panels over one abscissa.

    Attributes
    ----------
    title, caption : Heading of the picture, and the text under it in the report.
    abscissa : ndarray, shape (n,), shared by all lines, in `abscissa_unit`.
    columns : Panels side by side; they fill column by column.
    shaded, shaded_name : Range of the abscissa that is shaded in every panel, and its name in the legend.
    marks : Places on the abscissa that dashed lines mark, by what is there.
    extremes : Whether the largest and the smallest value of every panel are marked.
    logarithmic : Whether values are drawn on a logarithmic axis.
    """

    title: str
    caption: str
    abscissa: Array
    panels: tuple[Panel, ...]
    abscissa_name: str = "time"
    abscissa_unit: str = "s"
    columns: int = 1
    shaded: tuple[float, float] | None = None
    shaded_name: str = ""
    marks: Mapping[str, Array] = field(default_factory=dict)
    extremes: bool = False
    logarithmic: bool = False

    def __post_init__(self) -> None:
        for panel in self.panels:
            for line in panel.lines:
                if line.values.shape != self.abscissa.shape:
                    raise ValueError(
                        f"line {line.label!r} of panel {panel.quantity!r} has {line.values.size} values over "
                        f"{self.abscissa.size} of {self.abscissa_name}; give the runs the same output times"
                    )

    def table(self) -> tuple[list[str], Array]:
        """Column names with units, and the numbers of every line, shape (n, 1 + lines)."""
        every = [(panel, line) for panel in self.panels for line in panel.lines]
        names = [
            f"{one.quantity}{f', {line.label}' if line.label else ''} [{one.unit}]" for one, line in every
        ]
        columns = [self.abscissa, *(line.values for _, line in every)]
        return [f"{self.abscissa_name} [{self.abscissa_unit}]", *names], np.column_stack(columns)


@dataclass(frozen=True, kw_only=True)
class Picture:
    """A figure on disk: its image, the numbers behind it, and what the report prints with it."""

    title: str
    caption: str
    image: Path
    data: Path | None = None


def plain(text: str) -> str:
    """A user's text as it is: `$` would begin a formula, and a label that begins with `_` would be hidden."""
    escaped = text.replace("$", r"\$")
    return f" {escaped}" if escaped.startswith("_") else escaped


def draw(sheet: Sheet, *, note: str = "") -> Figure:
    """Draw a sheet as a figure.

    It belongs to no window and no global state; ``savefig`` writes it. `note`: words below the panels, for a
    figure that stands alone.
    """
    rows = -(-len(sheet.panels) // sheet.columns)
    figure = new_figure(figsize=(max(8.0, 5.6 * sheet.columns), 1.0 + 2.1 * rows), layout="constrained")
    grid = figure.subplots(rows, sheet.columns, sharex=True, squeeze=False)
    cells = list(grid.T.flat)
    labels = [tuple(line.label for line in panel.lines) for panel in sheet.panels]
    shared = len(labels) > 1 and len(set(labels)) == 1
    for cell, panel in zip(cells, sheet.panels, strict=False):
        _draw_panel(cell, panel, sheet.abscissa, legend=not shared)
        if sheet.logarithmic:
            cell.set_yscale("log")
        if sheet.extremes:
            _mark_extremes(cell, panel, sheet)
        if sheet.shaded is not None:
            low, high = np.clip(sheet.shaded, sheet.abscissa[0], sheet.abscissa[-1])
            shade = cell.axvspan(low, high, color=SHADE, linewidth=0.0, zorder=0)
        for number, places in enumerate(sheet.marks.values()):
            for place in places[:MOST_MARKS]:
                cell.axvline(place, **_mark(number), zorder=1)
    for cell in cells[len(sheet.panels) :]:
        cell.set_visible(False)
    for column in grid.T:
        for cell in [cell for cell in column if cell.get_visible()][-1:]:
            cell.set_xlabel(f"{sheet.abscissa_name} [{sheet.abscissa_unit}]")
            cell.tick_params(labelbottom=True)
    handles = _shared_handles(cells[0], sheet.marks, every=shared and any(labels[0]))
    if sheet.shaded is not None and sheet.shaded_name:
        shade.set_label(sheet.shaded_name)
        handles = [*handles, shade]
    if handles:
        columns = min(6, len(handles))
        figure.legend(handles=handles, loc="outside lower center", ncols=columns, fontsize=9, frameon=False)
    figure.suptitle(plain(sheet.title), fontsize=11)
    write_note(figure, note)
    return figure


def write_note(figure: Figure, note: str) -> None:
    """Small words at the foot of a figure, above its legend where it has one; none, nothing."""
    for legend in figure.legends[:1] if note else ():
        legend.set_title(note)
        legend.get_title().set(fontsize=7, color=NOTE_COLOUR)
    if note and not figure.legends:
        figure.supxlabel(note, x=0.01, ha="left", fontsize=7, color=NOTE_COLOUR)


def _draw_panel(cell: Axes, panel: Panel, abscissa: Array, *, legend: bool) -> None:
    for line in panel.lines:
        colour = COLOURS[line.colour % len(COLOURS)]
        label = plain(line.label)
        cell.plot(abscissa, line.values, line.style, color=colour, label=label, linewidth=1.1, markersize=4)
    words = f"{panel.quantity} [{panel.unit}]"
    cell.set_ylabel(plain(words if len(words) <= LONGEST_LABEL else f"{panel.quantity}\n[{panel.unit}]"))
    cell.margins(x=0)
    _hide_rounding(cell, panel)
    cell.grid(True, linewidth=0.4, alpha=0.6)
    named = any(line.label for line in panel.lines)
    if legend and named and len(panel.lines) <= MOST_NAMED:  # above the panel: no curve is covered
        place: dict[str, Any] = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "borderaxespad": 0.2}
        cell.legend(ncols=min(6, len(panel.lines)), fontsize=7, frameon=False, **place)


def _hide_rounding(cell: Axes, panel: Panel) -> None:
    """Curves that are constant up to rounding look so."""
    values = np.array([line.values for line in panel.lines])
    finite = values[np.isfinite(values)]
    if finite.size and np.ptp(finite) <= ROUNDING * np.abs(finite).max():
        middle, room = float(finite.mean()), 0.1 * float(np.abs(finite).max()) or 1.0
        cell.set_ylim(middle - room, middle + room)


def _mark_extremes(cell: Axes, panel: Panel, sheet: Sheet) -> None:
    """Triangles at the largest and the smallest value; in words where the head of the panel has room."""
    found = panel.extremes()
    if found is None:
        return
    words: list[str] = []
    for word, marker, (number, at, value) in zip(("min", "max"), ("v", "^"), found, strict=True):
        line, place = panel.lines[number], sheet.abscissa[at]
        colour = COLOURS[line.colour % len(COLOURS)]
        cell.plot(place, value, marker, color=colour, markersize=5, clip_on=False, zorder=4)
        words.insert(0, f"{word} {value:.4g} at {place:.4g} {sheet.abscissa_unit}")
    if len(panel.lines) <= FEW_LINES:
        cell.annotate(
            ", ".join(words), xy=(0.0, 1.0), xycoords="axes fraction", xytext=(0, 3),
            textcoords="offset points", fontsize=6.5,
        )  # fmt: skip


def _shared_handles(cell: Axes, marks: Mapping[str, Array], *, every: bool) -> list[Any]:
    """What the figure's own legend explains: lines that all panels have, and marks."""
    from matplotlib.lines import Line2D

    handles: list[Any] = cell.get_legend_handles_labels()[0] if every else []
    handles = handles if len(handles) <= MOST_NAMED else []
    for number, (name, places) in enumerate(marks.items()):
        handles.append(Line2D([], [], **_mark(number), label=f"{plain(name)} ({len(places)})"))
    return handles


def _mark(number: int) -> dict[str, Any]:
    colour = MARK_COLOURS[number % len(MARK_COLOURS)]
    return {"color": colour, "linewidth": 0.8, "linestyle": (0, (4, 3))}


def save_figure(figure: Figure, path: Path) -> Path:
    """Write a figure as PNG, complete under its name or not at all."""
    with atomic_write(path) as draft:
        figure.savefig(draft, format="png", dpi=DOTS_PER_INCH)
    return path


def save_table(names: Sequence[str], rows: Sequence[Sequence[object]], path: Path) -> Path:
    """Write a comma-separated table, complete or not at all; `names` have units in brackets.

    Floats keep ten significant digits, no number is an empty cell, anything else is written as it prints.
    """

    def written(value: object) -> object:
        return ("" if np.isnan(value) else f"{value:.10g}") if isinstance(value, float) else value

    with atomic_write(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(names)
        writer.writerows([written(value) for value in row] for row in rows)
    return path


def save_sheet(sheet: Sheet, folder: Path, stem: str) -> Picture:
    """Write `stem`.png and `stem`.csv into a folder."""
    names, numbers = sheet.table()
    data = save_table(names, numbers.tolist(), folder / f"{stem}.csv")
    image = save_figure(draw(sheet), folder / f"{stem}.png")
    return Picture(title=sheet.title, caption=sheet.caption, image=image, data=data)
