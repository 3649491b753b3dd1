"""Heat maps: one figure per axis, methods by values, colour the error, letters for what did not complete."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING

import numpy as np

from seacrane.accuracy import row as rows
from seacrane.accuracy.row import Row
from seacrane.inputs.atomic import atomic_write
from stability_atlas.axes import AXES
from stability_atlas.points import relative_error, relative_uncertainty
from stability_atlas.step_limit import StepLimit, step_limit_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LETTERS = {rows.REFUSED: "R", rows.STOPPED: "S", rows.SLOW: "T", rows.NOT_FINITE: "N", rows.UNNAMED: "U",
           rows.HUNG: "H", rows.CRASHED: "X"}  # fmt: skip
MEANING = {"R": "refused at the start", "S": "stopped by name", "T": "out of time", "N": "not finite",
           "U": "unnamed exception", "H": "hung", "X": "crashed", "c": "completed, no reference"}  # fmt: skip
COLOURS = {rows.REFUSED: "#bfbfbf", rows.STOPPED: "#8c8c8c", rows.SLOW: "#d9d9d9", rows.NOT_FINITE: "magenta",
           rows.UNNAMED: "magenta", rows.HUNG: "magenta", rows.CRASHED: "magenta"}  # fmt: skip
TITLE_WIDTH = 44  # characters
LEAST, MOST = 1e-9, 1.0  # errors beyond have the colours of these


def save_heat_maps(folder: Path, measured: Sequence[Row], limits: Sequence[StepLimit]) -> None:
    """Write extremes_<axis>.png for every axis that has rows, and extremes_step.png."""
    figures = {
        name: heat_map(name, [row for row in measured if row.case["axis"] == name])
        for name in dict.fromkeys(str(row.case["axis"]) for row in measured)
    }
    if limits:
        figures["step"] = step_limit_figure(list(limits))
    for name, figure in figures.items():
        with atomic_write(folder / f"extremes_{name}.png") as draft:
            figure.savefig(draft, format="png", dpi=80)


def heat_map(axis: str, measured: Sequence[Row]) -> Figure:
    """Error over the motion of every method (down) at every value (across) of one axis.

    Values that only the default setting ran are left out where others have more.
    """
    from matplotlib.colors import LogNorm
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    runs = Counter(float(row.case["value"]) for row in measured)
    kept = [value for value, count in runs.items() if count > 1 or max(runs.values()) == 1]
    measured = [row for row in measured if row.case["value"] in kept]
    methods = list(dict.fromkeys(row.method.name for row in measured))
    values = sorted(kept)
    figure = Figure(figsize=(4.2 + 0.75 * len(values), 1.9 + 0.19 * len(methods)), layout="constrained")
    axes = figure.subplots()
    error = np.full((len(methods), len(values)), np.nan)
    seen: set[str] = set()
    for row in measured:
        i, j = methods.index(row.method.name), values.index(float(row.case["value"]))
        found = relative_error(row)
        letter = LETTERS.get(row.verdict, "" if np.isfinite(found) else "c")
        if letter:
            colour = COLOURS.get(row.verdict, "white")
            axes.add_patch(_cell(j, i, colour))
            axes.text(j, i, letter, ha="center", va="center", fontsize=7)
            seen.add(letter)
        else:
            error[i, j] = max(found, 1e-300)
    image = axes.imshow(
        np.ma.masked_invalid(error), norm=LogNorm(LEAST, MOST), cmap="viridis_r", aspect="auto"
    )
    figure.colorbar(image, ax=axes, label="largest error / largest motion [-]", extend="both", fraction=0.05)
    axes.set_xticks(range(len(values)), [f"{value:g}" for value in values], rotation=45, ha="right")
    axes.set_yticks(range(len(methods)), methods, fontsize=7)
    axes.set_xlabel(AXES[axis].label)
    axes.set_title(fill(AXES[axis].title, TITLE_WIDTH), fontsize=10)
    axes.set_xlim(-0.5, len(values) - 0.5)
    axes.set_ylim(len(methods) - 0.5, -0.5)
    known = np.array([relative_uncertainty(row) for row in measured])
    known = known[np.isfinite(known)]
    note = f"reference known within {known.max():.1g} of the motion" if known.size else "no second reference"
    if seen:
        figure.legend(
            handles=[Patch(facecolor="none", label=f"{mark}  {MEANING[mark]}") for mark in sorted(seen)],
            loc="outside lower center", ncols=2, fontsize=7, title=note, title_fontsize=7,
        )  # fmt: skip
    else:
        figure.supxlabel(note, fontsize=7)
    return figure


def _cell(column: int, line: int, colour: str):  # type: ignore[no-untyped-def]
    from matplotlib.patches import Rectangle

    return Rectangle((column - 0.5, line - 0.5), 1.0, 1.0, facecolor=colour, edgecolor="none")
