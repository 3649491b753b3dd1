"""Pictures of a study: numbers over parameters, and largest values on Gumbel paper."""

from __future__ import annotations

from collections.abc import Iterator
from numbers import Real
from typing import Any

import numpy as np

from seacrane.ensembles.members import Value
from seacrane.lift.shown_study import Cell, ShownStudy, Told
from seacrane.plotting.panel import COLOURS, Line, Panel, Sheet

MOST_CURVES = len(COLOURS)
UNITS = {"hs": "m", "tp": "s", "direction_deg": "deg", "gamma": "-", "seed": "-"}


def study_sheets(shown: ShownStudy) -> Iterator[tuple[str, Sheet]]:
    """File names without ending, and the figures: one for each parameter with two values and more."""
    for told in shown.tables:
        varied = [name for name in told.cells[0].parameters if _varies(told, name)]
        for name in varied:
            yield f"{told.name}-over-{_file_name(name)}", _over(told, name, varied)
        (only, *others) = told.cells
        if not others and only.extremes is not None:
            yield f"{told.name}-gumbel", only.extremes.sheet()


def _file_name(name: str) -> str:
    return "".join(letter if letter.isalnum() or letter in "._-" else "-" for letter in name)


def _told(value: Value) -> str:
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def _varies(told: Told, name: str) -> bool:
    values = [cell.parameters[name] for cell in told.cells]
    return all(isinstance(value, Real) for value in values) and len(set(values)) > 1


def _over(told: Told, name: str, varied: list[str]) -> Sheet:
    """The table over one parameter; a curve for each combination of the others that differ."""
    curves: dict[tuple[Any, ...], list[Cell]] = {}
    for cell in told.cells:
        rest = tuple(value for other, value in cell.parameters.items() if other != name)
        curves.setdefault(rest, []).append(cell)
    scattered = len(curves) > 1 and max(map(len, curves.values())) == 1
    if scattered:
        curves = {(): list(told.cells)}
    at = np.unique([float(cell.parameters[name]) for cell in told.cells])
    others = [other for other in told.cells[0].parameters if other != name]
    lines: list[Line] = []
    for colour, (rest, cells) in enumerate(list(curves.items())[:MOST_CURVES]):
        pairs = zip(others, rest, strict=True) if rest else ()
        label = ", ".join(
            f"{other} {_told(value)}" for other, value in pairs if other in varied or len(curves) > 1
        )
        lines += _lines(told, cells, name, at, label, colour, "o" if scattered else "-o")
    left = len(curves) - MOST_CURVES
    number = "most probable maximum, dashed: its 95 % interval" if told.extremes else "mean over seeds"
    return Sheet(
        title=f"{told.name} over {name}",
        caption=f"{told.what}: {number if told.over_seeds else 'each member'}."
        + (f" {left} more curves are in the table." if left > 0 else ""),
        abscissa=at, abscissa_name=name, abscissa_unit=UNITS.get(name, "SI"),
        panels=(Panel(quantity=told.name, unit=told.unit, lines=tuple(lines)),),
    )  # fmt: skip


def _lines(
    told: Told, cells: list[Cell], name: str, at: Any, label: str, colour: int, style: str
) -> list[Line]:
    values = np.full((3, at.size), np.nan)
    for cell in cells:
        place = int(np.searchsorted(at, float(cell.parameters[name])))
        values[:, place] = cell.numbers("mpm") if told.extremes else [cell.mean, np.nan, np.nan]
    middle = Line(label=label, values=values[0], style=style, colour=colour)
    if not told.extremes:
        return [middle]
    return [middle, *(Line(label="", values=one, style="--", colour=colour) for one in values[1:])]
