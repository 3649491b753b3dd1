"""Figures as data: lines in panels, drawn and tabulated from the same description.

A panel's picture and the file of its numbers come from one object, so they cannot disagree.
"""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.files.atomic import atomic_write

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")  # Okabe and Ito
SHADE = "#EEF3F8"
DOTS_PER_INCH = 130


@dataclass(frozen=True, kw_only=True)
class Line:
    """One curve over the sheet's abscissa: label and values, shape (n,)."""

    label: str
    values: Array
    style: str = "-"
    colour: int = 0


@dataclass(frozen=True, kw_only=True)
class Panel:
    """Curves of one quantity with one unit."""

    quantity: str
    unit: str
    lines: tuple[Line, ...]


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """A figure: panels over one abscissa.

    Attributes
    ----------
    title, caption : str
        Heading of the picture, and the text under it in the report.
    abscissa : ndarray, shape (n,)
        Shared by all lines, in `abscissa_unit`.
    columns : int
        Panels side by side; they fill column by column.
    shaded : (float, float) or None
        Range of the abscissa that is shaded in every panel, as `caption` explains.
    """

    title: str
    caption: str
    abscissa: Array
    panels: tuple[Panel, ...]
    abscissa_name: str = "time"
    abscissa_unit: str = "s"
    columns: int = 1
    shaded: tuple[float, float] | None = None

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
        names = [f"{self.abscissa_name} [{self.abscissa_unit}]"]
        columns = [self.abscissa]
        for panel in self.panels:
            for line in panel.lines:
                label = f", {line.label}" if line.label else ""
                names.append(f"{panel.quantity}{label} [{panel.unit}]")
                columns.append(line.values)
        return names, np.column_stack(columns)


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


def draw(sheet: Sheet) -> Figure:
    """Draw a sheet.

    Returns
    -------
    matplotlib.figure.Figure
        Belongs to no window and no global state; ``savefig`` writes it.
    """
    from matplotlib.figure import Figure

    rows = -(-len(sheet.panels) // sheet.columns)
    figure = Figure(figsize=(max(8.0, 5.6 * sheet.columns), 1.0 + 2.1 * rows), layout="constrained")
    grid = figure.subplots(rows, sheet.columns, sharex=True, squeeze=False)
    cells = list(grid.T.flat)
    labels = [tuple(line.label for line in panel.lines) for panel in sheet.panels]
    shared = len(labels) > 1 and len(set(labels)) == 1
    for cell, panel in zip(cells, sheet.panels, strict=False):
        _draw_panel(cell, panel, sheet.abscissa, legend=not shared)
        if sheet.shaded is not None:
            low, high = np.clip(sheet.shaded, sheet.abscissa[0], sheet.abscissa[-1])
            cell.axvspan(low, high, color=SHADE, linewidth=0.0, zorder=0)
    for cell in cells[len(sheet.panels) :]:
        cell.set_visible(False)
    for column in grid.T:
        lowest = [cell for cell in column if cell.get_visible()][-1:]
        for cell in lowest:
            cell.set_xlabel(f"{sheet.abscissa_name} [{sheet.abscissa_unit}]")
            cell.tick_params(labelbottom=True)
    if shared and any(labels[0]):
        handles, names = cells[0].get_legend_handles_labels()
        columns = min(6, len(names))
        figure.legend(handles, names, loc="outside lower center", ncols=columns, fontsize=9, frameon=False)
    figure.suptitle(plain(sheet.title), fontsize=11)
    return figure


def _draw_panel(cell: Axes, panel: Panel, abscissa: Array, *, legend: bool) -> None:
    for line in panel.lines:
        colour = COLOURS[line.colour % len(COLOURS)]
        label = plain(line.label)
        cell.plot(abscissa, line.values, line.style, color=colour, label=label, linewidth=1.1, markersize=4)
    cell.set_ylabel(plain(f"{panel.quantity} [{panel.unit}]"))
    cell.margins(x=0)
    cell.grid(True, linewidth=0.4, alpha=0.6)
    if legend and len(panel.lines) > 1:  # above the panel: no curve is covered
        place: dict[str, Any] = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "borderaxespad": 0.2}
        cell.legend(ncols=min(6, len(panel.lines)), fontsize=7, frameon=False, **place)


def save_figure(figure: Figure, path: Path) -> Path:
    """Write a figure as PNG, complete under its name or not at all."""
    with atomic_write(path) as draft:
        figure.savefig(draft, format="png", dpi=DOTS_PER_INCH)
    return path


def save_table(names: Sequence[str], rows: Sequence[Sequence[object]], path: Path) -> Path:
    """Write a comma-separated table; numbers keep ten significant digits.

    Parameters
    ----------
    names : sequence of str
        Column names, units in brackets.
    rows : sequence of rows
        Numbers are floats; anything else is written as it prints.
    path : Path
        Target, written atomically.
    """
    with atomic_write(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(names)
        for row in rows:
            writer.writerow([f"{value:.10g}" if isinstance(value, float) else value for value in row])
    return path


def save_sheet(sheet: Sheet, folder: Path, stem: str) -> Picture:
    """Write `stem`.png and `stem`.csv into a folder."""
    names, numbers = sheet.table()
    data = save_table(names, numbers.tolist(), folder / f"{stem}.csv")
    image = save_figure(draw(sheet), folder / f"{stem}.png")
    return Picture(title=sheet.title, caption=sheet.caption, image=image, data=data)
