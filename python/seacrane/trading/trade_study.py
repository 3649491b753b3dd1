"""trade(): what every setting costs and what error it brings, for the scene at hand."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.accuracy.quantities import Quantity, limits_of, quantities_of
from seacrane.description.description import Description
from seacrane.description.file import scene_digest
from seacrane.errors import SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.checked import number_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.shorthand import settled
from seacrane.trading import simpler_scenes
from seacrane.trading.case import Case
from seacrane.trading.diagram import COSTS, Measured, work_precision
from seacrane.trading.lines_on_rungs import LINE_RUNGS
from seacrane.trading.methods import LINES, PHYSICS, measured_methods
from seacrane.trading.reference import Reference
from seacrane.trading.row import Row
from seacrane.trading.row_file import RowFile, completed
from seacrane.trading.trade_rows import Bench, frequency_domain, measure, measure_variant, tight_reference
from seacrane.trading.trade_table import as_html, as_text, front, write_csv
from seacrane.version import __version__

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from seacrane.scene.scene import Scene

MEASURED = ("wall_s", "simulated_s", "evaluations", "drift", "energy", "stable")
LINEAR = Method(integrator="none")  # the frequency domain has no integrator
REPEATS = 3  # runs of each setting; the quickest counts


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trade:
    """Measured cost and error of the settings of one scene. Made by `trade`.

    Attributes
    ----------
    rows : tuple of Row
        Numerical settings on the full scene first, then the scene with less physics.
    quantities : mapping of str to Quantity
        What errors are measured in; the first one decides on `pareto`.
    reference : Reference
        The tight runs and, per quantity, how far they differ: no error below that can be told.
    metadata : mapping
        Scene, version, times, machine independent.
    """

    rows: tuple[Row, ...]
    quantities: Mapping[str, Quantity]
    reference: Reference
    metadata: Mapping[str, Any]

    @property
    def table(self) -> xarray.Dataset:
        """All rows as a dataset over `row` and `quantity`; `error` is the largest over time."""
        import xarray

        names = list(self.quantities)
        columns: dict[str, list[Any]] = {
            "formulation": [row.formulation for row in self.rows],
            "integrator": [row.method.integrator for row in self.rows],
            "setting": [row.method.setting for row in self.rows],
            "rtol": [_or_nan(row.method.rtol) for row in self.rows],
            "dt": [_or_nan(row.method.dt) for row in self.rows],
            **{name: [row.case[name] for row in self.rows] for name in self.full_case},
            **{name: [getattr(row, name) for row in self.rows] for name in MEASURED},
            "reason": [row.message for row in self.rows],
        }
        data: dict[str, Any] = {name: ("row", np.array(values)) for name, values in columns.items()}
        for name, part in (("error", "largest"), ("rms_error", "rms"), ("std_error", "std")):
            values = [
                [getattr(row.errors[q], part) if q in row.errors else np.nan for q in names]
                for row in self.rows
            ]
            data[name] = (
                ("row", "quantity"),
                np.array(values, dtype=float).reshape(len(self.rows), len(names)),
            )
        data["wall_per_simulated_s"] = ("row", data["wall_s"][1] / data["simulated_s"][1])
        data["pareto"] = ("row", np.array(front(self.rows, names[0])))
        data["uncertainty"] = ("quantity", np.array([self.reference.uncertainty[name] for name in names]))
        data["unit"] = ("quantity", [self.quantities[name].unit for name in names])
        return xarray.Dataset(data, {"quantity": names}, dict(self.metadata))

    @property
    def pareto(self) -> list[Row]:
        """Rows that no other beats in both wall time and error of the first quantity, cheapest first."""
        return self.front(next(iter(self.quantities)))

    def front(self, quantity: str) -> list[Row]:
        """As `pareto`, for any quantity."""
        limits_of(self.quantities, {quantity: 1.0})
        kept = [row for row, on in zip(self.rows, front(self.rows, quantity), strict=True) if on]
        return sorted(kept, key=lambda row: row.wall_s)

    def cheapest(self, **accuracy: float) -> Method:
        """The method of the cheapest run of the full scene whose largest errors stay within the limits.

        Parameters
        ----------
        **accuracy : float
            Largest error by quantity, in its unit, such as ``payload_position=0.01``.

        Returns
        -------
        Method
            For ``simulate(scene, method=...)``.

        Raises
        ------
        SceneError
            If no setting meets them: it names the smallest error reached and what sets it.
        """
        limits = limits_of(self.quantities, accuracy)
        for name, limit in limits.items():
            self._check_reach(name, limit)
        passing = [
            row
            for row in self._of_full_scene()
            if row.stable and all(row.error(name) <= limit for name, limit in limits.items())
        ]
        if not passing:
            raise SceneError(f"accuracy: each of {limits} is reached by some setting, but none reaches all")
        best = min(passing, key=lambda row: row.wall_s)
        return replace(best.method, formulation=best.formulation)

    def _check_reach(self, name: str, limit: float) -> None:
        unit, known = self.quantities[name].unit, self.reference.uncertainty[name]
        if limit < known:
            raise SceneError(
                f"accuracy: {name} of {limit:g} {unit} cannot be reached: the limit is {known:.3g} {unit}, "
                "set by rounding: by that much the tight reference runs differ among themselves"
            )
        rows = [row for row in self._of_full_scene() if row.stable]
        best = min(rows, key=lambda row: row.error(name), default=None)
        if best is None or best.error(name) > limit:
            least = "none" if best is None else f"{best.error(name):.3g} {unit}"
            by = (
                ""
                if best is None
                else f" ({best.formulation}, {best.method.integrator}, {best.method.setting})"
            )
            raise SceneError(
                f"accuracy: {name} of {limit:g} {unit} is beyond this grid: its smallest error is "
                f"{least}{by}, set by the local error of the time integration; simulate(accuracy=...) tries "
                "finer tolerances"
            )

    def _of_full_scene(self) -> list[Row]:
        return [row for row in self.rows if dict(row.case) == self.full_case]

    @property
    def full_case(self) -> dict[str, str]:
        """What rows of the full scene have as their `case`: memory, waves, rung."""
        return {
            "memory": self.metadata["memory"],
            "waves": self.metadata["waves"],
            "rung": simpler_scenes.FULL,
        }

    def __repr__(self) -> str:
        stable = sum(row.stable for row in self.rows)
        return (
            f"<Trade of {self.metadata['scene']!r}, {self.metadata['t_end']:g} s: {len(self.rows)} rows, "
            f"{stable} of them stable, errors in {', '.join(self.quantities)}>"
        )

    def __str__(self) -> str:
        return as_text(self.rows, self.quantities, self.reference.uncertainty, self.pareto)

    def _repr_html_(self) -> str:
        return as_html(self.metadata, list(self.quantities), self.pareto, len(self.rows))

    def plot(self, *, over: str = "wall_s") -> Figure:
        """Work-precision diagrams: error of each quantity over cost, and what less physics loses.

        A line for each integrator, through those of its settings that none of its own beats; in colour where
        it is on the Pareto front of some quantity.

        Parameters
        ----------
        over : str
            "wall_s": wall time per simulated second. "cpu_s": CPU time, which depends less on what else the
            machine does; rows that took none that was measured, as the frequency domain, are left out.

        Raises
        ------
        SceneError
            If `over` is neither.
        """
        if over not in COSTS:
            raise SceneError(f"plot: over is {shown(over)}; give {' or '.join(COSTS)}")
        rows = [row for row in self.rows if getattr(row, over) > 0]
        measured = [
            Measured(
                quantity=name,
                unit=quantity.unit,
                uncertainty=self.reference.uncertainty[name],
            )
            for name, quantity in self.quantities.items()
        ]
        about = self.metadata
        title = f"{about['scene']}: {about['t_end']:g} s, errors at outputs every {about['dt_out']:g} s"
        return work_precision(rows, measured, self.full_case, title, over)

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Write trade.csv and trade.png into a folder."""
        on_front = front(self.rows, next(iter(self.quantities)))
        write_csv(Path(folder) / "trade.csv", self.rows, list(self.quantities), on_front)
        with atomic_write(Path(folder) / "trade.png") as draft:
            self.plot().savefig(draft, format="png", dpi=110)


@named
def trade(
    scene: Scene,
    t_end: float = 100.0,
    *,
    outputs: Outputs | None = None,
    methods: Iterable[Method] | None = None,
    quantities: Sequence[str] | None = None,
    dt_out: float | None = None,
    quick: bool = False,
    progress: bool = True,
    out: str | os.PathLike[str] | None = None,
) -> Trade:
    """Measure what every method costs and what error it brings, for one scene.

    A tight reference comes first: two formulations, two methods. Then every formulation, integrator and
    tolerance or step on the full scene; then, at a tight tolerance, the scene with one part of its physics
    changed: fluid memory, evaluation of the waves, coupling of crane, payload and vessel; the other rungs of
    elastic lines (rigid, quasi-static, elastic), each at several tolerances. Methods and physics
    are not crossed: their errors add. What a method cannot do is a row that is not stable and says why.
    Other memories are fitted to the vessel's database; without one, only no memory is compared.

    Parameters
    ----------
    t_end : float
        End time, s.
    outputs : Outputs, optional
        Errors are taken at its times; what is recorded follows from the quantities. `dt_out` (s) is a
        shorthand for it.
    methods : iterable of Method, optional
        What to measure on the full scene; default: a grid of every integrator of the core.
    quantities : sequence of str, optional
        "payload_position", "tip_velocity", "roll", "cylinder_force", "hook_load", or any channel. Default:
        those of the named ones that the scene has, else position and velocity of all bodies.
    quick : bool
        A coarse grid of few integrators.
    progress : bool
        Show a progress bar.
    out : path, optional
        Existing folder: rows are kept in its trade_rows.jsonl as they are measured, and a later call for the
        same scene continues from there; trade.csv and trade.png are written at the end.

    Raises
    ------
    SceneError
        For an unknown quantity, or a scene of which no two tight runs work.
    """
    _, taken = settled(None, outputs, {} if dt_out is None else {"dt_out": dt_out})
    if not isinstance(scene, Description):
        raise SceneError(f"trade: scene is {shown(scene)}; give a Scene, such as seacrane.cases.case2()")
    case = Case(scene=scene, t_end=number_of("t_end", t_end), dt_out=taken.dt_out)
    measured = quantities_of(scene, case.model, quantities)
    metadata = {
        "scene": scene.name, "seacrane_version": __version__, "t_end": case.t_end, "dt_out": case.dt_out,
        "memory": simpler_scenes.memory_name(scene), "waves": simpler_scenes.waves_name(scene),
        "quick": int(quick),
    }  # fmt: skip
    truth = tight_reference(case, measured)
    metadata |= {"reference": truth.runs[0], "checked_by": "; ".join(truth.runs[1:])}
    metadata |= {f"refused {name}": reason for name, reason in truth.refused.items()}
    file = _row_file(out, {**metadata, "quantities": list(measured)}, scene)
    bench = Bench(case=case, quantities=measured, truth=truth, repeats=1 if quick else REPEATS)
    tried = measured_methods(quick=quick) if methods is None else methods
    tasks = dict([*_methods(bench, metadata, tried), *_physics(bench, quick=quick)])
    rows = completed(
        tasks, file, lambda keys: ((key, tasks[key]()) for key in keys), title="trade", progress=progress
    )
    different = {row.key: row for row in reversed(rows)}  # two levels of a memory fit may give one model
    result = Trade(
        rows=tuple(reversed(different.values())), quantities=measured, reference=truth, metadata=metadata
    )
    if out is not None:
        result.save(out)
    return result


Task = tuple[str, Callable[[], Row]]  # the key of a row, and what measures it


def _methods(bench: Bench, metadata: Mapping[str, Any], methods: Iterable[Method]) -> Iterator[Task]:
    """One row for each method on the full scene."""
    full = {"memory": metadata["memory"], "waves": metadata["waves"], "rung": simpler_scenes.FULL}
    for method in methods:
        row = Row(case=full, method=method)
        yield row.key, partial(measure, bench, row)


def _physics(bench: Bench, *, quick: bool) -> Iterator[Task]:
    """One row for each scene with less physics, all by the same method; rungs of lines by several."""
    scene = bench.case.scene
    for variant in simpler_scenes.variants(scene, quick=quick):
        case = {"memory": variant.memory, "waves": variant.waves, "rung": variant.rung}
        if variant.rung == simpler_scenes.LINEAR:
            row = Row(case=case, method=LINEAR)
            yield row.key, partial(frequency_domain, bench, row)
            continue
        for method in _of_rung(variant.rung, quick=quick):
            row = Row(case=case, method=method)
            yield row.key, partial(measure_variant, bench, variant, row)


def _of_rung(rung: str, *, quick: bool) -> Sequence[Method]:
    if rung in LINE_RUNGS:
        return LINES[1::2] if quick else LINES
    return (PHYSICS,)


def _row_file(out: str | os.PathLike[str] | None, experiment: Mapping[str, Any], scene: Scene) -> RowFile:
    if out is None:
        return RowFile(None, experiment)
    folder = Path(out)
    if not folder.is_dir():
        raise SceneError(f"out {str(folder)!r} is no folder; create it first")
    return RowFile(folder / "trade_rows.jsonl", {**experiment, "described": scene_digest(scene)})


def _or_nan(value: float | None) -> float:
    return np.nan if value is None else value
