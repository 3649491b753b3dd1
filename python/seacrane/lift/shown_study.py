"""What the members of a study say so far: tables over seeds, or of the members themselves, and pictures."""

from __future__ import annotations

import itertools
import math
import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.arrays import Array
from seacrane.ensembles.dataset import NOT_RUN
from seacrane.ensembles.ensemble import Ensemble
from seacrane.ensembles.kept import Kept
from seacrane.ensembles.members import Value
from seacrane.ensembles.study_folder import study_in
from seacrane.ensembles.targets import Certainty, known, targets_of
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.lift.lift import Lift, Study
from seacrane.lift.study_run import FILE, MEMBERS
from seacrane.plotting.panel import COLOURS, Line, Panel, Sheet
from seacrane.plotting.table import format_value, table_of
from seacrane.statistics.estimate import Estimate
from seacrane.statistics.seeds import FEWEST, SeedExtremes, seed_extremes

if TYPE_CHECKING:
    import xarray

MOST_ROWS = 60  # that are printed; files hold all
MOST_FAILURES = 3  # that are told
MOST_CURVES = len(COLOURS)
UNITS = {"hs": "m", "tp": "s", "direction_deg": "deg", "gamma": "-", "seed": "-"}


@dataclass(frozen=True, kw_only=True)
class Cell:
    """What is kept under one name, for one combination of parameters."""

    parameters: Mapping[str, Value]  # all but the seed
    values: Array  # (k,) of the seeds, or of the one member; without those that failed or were not run
    failed: int = 0  # seeds, for which intervals would not hold
    sign: float = 1.0  # -1 for smallest values
    extremes: SeedExtremes | None = None  # of the values times the sign, where there are several seeds

    @property
    def mean(self) -> float:
        """Over the seeds."""
        return float(self.values.mean()) if self.values.size else math.nan

    def numbers(self, name: str) -> list[float]:
        """Value, low and high end of "mpm" or "p90"."""
        if self.extremes is None:
            return [math.nan] * 3
        found: Estimate = getattr(self.extremes.maximum, name)
        ends = [math.nan] * 2 if self.failed else sorted([self.sign * found.low, self.sign * found.high])
        return [self.sign * found.value, *ends]

    def row(self, *, over_seeds: bool, extremes: bool) -> list[Any]:
        """Parameters and numbers."""
        scatter = float(self.values.std(ddof=1)) if self.values.size > 1 else math.nan
        numbers = [self.values.size, self.mean, scatter] if over_seeds else [self.mean]
        more = [*self.numbers("mpm"), *self.numbers("p90")] if extremes else []
        return [*self.parameters.values(), *numbers, *more]


@dataclass(frozen=True, kw_only=True)
class Told:
    """A table about what is kept under one name."""

    name: str
    unit: str
    what: str  # a sentence
    over_seeds: bool  # whether cells hold seeds
    exposure: float | None  # of extremes, s; None: of one lift in stages
    cells: tuple[Cell, ...]

    @property
    def extremes(self) -> bool:
        """Whether it is of largest or smallest values over seeds."""
        return any(cell.extremes is not None for cell in self.cells)

    def head(self) -> list[str]:
        """Column names with units."""
        numbers = ["mean", "scatter"] if self.over_seeds else ["value"]
        numbers += ["most probable", "low", "high", "P90", "low", "high"] if self.extremes else []
        seeds = ["seeds"] if self.over_seeds else []
        return [*self.cells[0].parameters, *seeds, *(f"{name} [{self.unit}]" for name in numbers)]

    def rows(self) -> Iterator[list[Any]]:
        """Numbers and texts of every cell."""
        extremes = self.extremes
        return (cell.row(over_seeds=self.over_seeds, extremes=extremes) for cell in self.cells)

    def __str__(self) -> str:
        rows = list(self.rows())
        more, lines = len(rows) - MOST_ROWS, []
        if self.extremes:
            during = "one lift" if self.exposure is None else f"{self.exposure:g} s"
            lines.append(f"Maximum in {during} by Gumbel's distribution, 95 % intervals.")
        if self.over_seeds and any(cell.failed for cell in self.cells):
            lines.append("Of seeds that did not fail; where some did, no interval holds for all.")
        lines += [f"and {more} rows more"] if more > 0 else []
        return str(table_of(self.head(), rows[:MOST_ROWS], title=f"{self.name}: {self.what}", remarks=lines))


@dataclass(frozen=True, kw_only=True)
class ShownStudy:
    """A study as far as it has been run: how many members were, its tables, and how certain `until` is."""

    counts: tuple[str, ...]
    tables: tuple[Told, ...]
    certainty: tuple[Certainty, ...]

    def __str__(self) -> str:
        told = [f"{one}, asked for +-{100.0 * one.asked:.2g} %" for one in self.certainty]
        return "\n\n".join(
            ["\n".join(self.counts), *map(str, self.tables), *(["\n".join(told)] if told else [])]
        )


def shown_study(folder: str | os.PathLike[str]) -> ShownStudy:
    """What is in the folder of a study.

    Raises FileFormatError or SceneError where it is none, or damaged, or no member has been run.
    """
    path = Path(folder)
    study = Lift.load(path / FILE).study if (path / FILE).is_file() else None
    if study is None:
        raise SceneError(f"{path} is no folder of a study; give the DIR of `seacrane study --out DIR`")
    done = Ensemble.load(path / MEMBERS)
    length = study_in(path / MEMBERS)["identity"]["t_end"]
    failure = done.dataset.failure.to_numpy()
    run = failure.size - int((failure == NOT_RUN).sum())
    if not run:
        raise SceneError(f"{path}: no member has been run yet; run `seacrane study` with it")
    axes, there = set(done.members.shape), [name for name in study.keep if name in done.dataset]
    scalar = [name for name in there if set(map(str, _kept(name, done).dims)) == axes]
    counts = [f"{run} of {failure.size} members run, {len(done.failures)} failed"]
    counts += [f"failed: {text}" for text in [*dict.fromkeys(done.failures.values())][:MOST_FAILURES]]
    if series := [name for name in study.keep if name not in scalar]:
        counts.append(f"series, in the members alone: {', '.join(series)}")
    tables = tuple(_told(name, study, done, length) for name in scalar)
    return ShownStudy(counts=tuple(counts), tables=tables, certainty=tuple(_certainty(study, done)))


def _certainty(study: Study, done: Ensemble) -> Iterator[Certainty]:
    """How narrowly the statistics of `until` are known so far."""
    for target in targets_of(study.until, study.keep) if study.until else ():
        if target.variable not in done.dataset:
            continue
        lost = _cells(_failed(done), done)
        statics = iter(()) if target.static is None else _cells(done.dataset[target.static], done)
        for parameters, values in _cells(done.dataset[target.variable], done):
            static = next(statics, ({}, np.zeros(1)))[1]
            failed = next(lost)[1].size
            if values.size or failed:
                yield known(
                    target,
                    values,
                    failed,
                    static=float(static.mean()) if static.size else 0.0,
                    parameters=parameters,
                )


def _failed(done: Ensemble) -> xarray.DataArray:
    """One where a member failed, not a number elsewhere."""
    failure: xarray.DataArray = done.dataset.failure
    told = failure.to_numpy()
    return failure.copy(data=np.where((told == "") | (told == NOT_RUN), np.nan, 1.0))


def _kept(name: str, done: Ensemble) -> xarray.DataArray:
    """Of every member; without dimensions along which there is one name, as of a lift with one hook."""
    variable = done.dataset[name]
    alone = [one for one in variable.dims if variable.sizes[one] == 1 and one not in done.members.shape]
    return variable.squeeze(alone, drop=True)


def _told(name: str, study: Study, done: Ensemble, length: float | None) -> Told:
    """`length` is that of the runs, s; None of lifts in stages, where an extreme is that of one lift."""
    what, variable = study.keep[name], _kept(name, done)
    seeds = "seed" in variable.dims
    sign = {"maximum": 1.0, "minimum": -1.0}.get(what.what) if seeds else None
    span = None if length is None else length - getattr(what, "after", 0.0)
    exposure = span if study.exposure is None else study.exposure
    cells = []
    together = zip(_cells(variable, done), _cells(_failed(done), done), strict=True)
    for (parameters, values), (_, lost) in together:
        found = None
        if sign is not None and values.size >= FEWEST and not np.ptp(values) <= 1e-12 * np.abs(values).max():
            with silently():
                found = seed_extremes(
                    sign * values, duration=span or 1.0, exposure=exposure or 1.0, name=name
                )
        one = Cell(parameters=parameters, values=values, failed=lost.size, extremes=found, sign=sign or 1.0)
        cells.append(one)
    about = str(variable.attrs.get("long_name", what.channel if isinstance(what, Kept) else what))
    at = ", ".join(what.names.values()) if isinstance(what, Kept) else ""
    return Told(
        name=name, unit=str(variable.attrs.get("units", "-")), what=f"{about}{f' ({at})' if at else ''}",
        over_seeds=seeds, exposure=exposure, cells=tuple(cells),
    )  # fmt: skip


def _cells(variable: xarray.DataArray, done: Ensemble) -> Iterator[tuple[dict[str, Value], Array]]:
    """Parameters and values over seeds of every combination."""
    if not done.members.grid:
        for index, value in enumerate(variable.to_numpy()):
            yield done.parameters(index), _finite(np.array([value]))
        return
    axes = {name: values for name, values in done.members.axes.items() if name != "seed"}
    order = [*axes, *(["seed"] if "seed" in variable.dims else [])]
    values = variable.transpose(*order).to_numpy().reshape(math.prod(map(len, axes.values())), -1)
    for combination, row in zip(itertools.product(*axes.values()), values, strict=True):
        yield dict(zip(axes, combination, strict=True)), _finite(row)


def _finite(values: Array) -> Array:
    return values[np.isfinite(values)]


def study_sheets(shown: ShownStudy) -> Iterator[tuple[str, Sheet]]:
    """File names without ending, and the figures: one for each parameter with two values and more."""
    for told in shown.tables:
        for name in told.cells[0].parameters:
            values = {cell.parameters[name] for cell in told.cells}
            if len(values) > 1 and all(isinstance(value, Real) for value in values):
                file = re.sub(r"[^\w.-]", "-", name)
                yield f"{told.name}-over-{file}", _over(told, name)
        (only, *others) = told.cells
        if not others and only.extremes is not None:
            yield f"{told.name}-gumbel", only.extremes.sheet()


def _over(told: Told, name: str) -> Sheet:
    """The table over one parameter; a curve for each combination of the others that differ."""
    others = [key for key in told.cells[0].parameters if key != name]
    others = [key for key in others if len({cell.parameters[key] for cell in told.cells}) > 1]
    curves: dict[str, list[Cell]] = {}
    for cell in told.cells:
        label = ", ".join(f"{key} {format_value(cell.parameters[key])}" for key in others)
        curves.setdefault(label, []).append(cell)
    scattered = len(curves) > 1 and max(map(len, curves.values())) == 1
    if scattered:
        curves = {"": list(told.cells)}
    at = np.unique([float(cell.parameters[name]) for cell in told.cells])
    lines: list[Line] = []
    for colour, (label, cells) in enumerate(list(curves.items())[:MOST_CURVES]):
        values = np.full((3, at.size), np.nan)
        for cell in cells:
            place = int(np.searchsorted(at, float(cell.parameters[name])))
            values[:, place] = cell.numbers("mpm") if told.extremes else [cell.mean, np.nan, np.nan]
        style = "o" if scattered else "-o"
        lines.append(Line(label=label, values=values[0], style=style, colour=colour))
        lines += [
            Line(label="", values=one, style="--", colour=colour) for one in values[1:] if told.extremes
        ]
    left = len(curves) - MOST_CURVES
    number = "most probable maximum, dashed: its 95 % interval" if told.extremes else "mean over seeds"
    return Sheet(
        title=f"{told.name} over {name}",
        caption=f"{told.what}: {number if told.over_seeds else 'each member'}."
        + (f" {left} more curves are in the table." if left > 0 else ""),
        abscissa=at, abscissa_name=name, abscissa_unit=UNITS.get(name, "SI"),
        panels=(Panel(quantity=told.name, unit=told.unit, lines=tuple(lines)),),
    )  # fmt: skip
