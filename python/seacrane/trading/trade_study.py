"""trade(): what every setting costs and what error it brings, for the scene at hand."""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane._core import integrators
from seacrane.accuracy.quantities import Quantity, limits_of, quantities_of
from seacrane.description.description import Description
from seacrane.description.file import scene_digest
from seacrane.errors import SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.checked import number_of, positive_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.run.method import DEFAULT_INTEGRATOR, DEFAULT_TOLERANCE, Method
from seacrane.run.outputs import Outputs
from seacrane.run.shorthand import settled
from seacrane.run.stage import Stage
from seacrane.run.start import Start
from seacrane.trading import simpler_scenes
from seacrane.trading.budget import Measure, Spending, with_bar, within_budget
from seacrane.trading.case import Case
from seacrane.trading.diagram import COSTS, Measured, work_precision
from seacrane.trading.ladders import Ladders
from seacrane.trading.lines_on_rungs import LINE_RUNGS
from seacrane.trading.measured_case import CHECKS, channels_of, timed, values_by
from seacrane.trading.methods import LINES, PHYSICS, measured_methods
from seacrane.trading.reference import Reference
from seacrane.trading.row import Row
from seacrane.trading.row_file import RowFile, completed
from seacrane.trading.stage_extremes import of_stages
from seacrane.trading.trade_rows import Bench, frequency_domain, measure, measure_variant, tight_reference
from seacrane.trading.trade_table import as_html, as_text, front, write_csv
from seacrane.version import __version__

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from seacrane.scene.scene import Scene

MEASURED = ("wall_s", "simulated_s", "evaluations", "drift", "energy", "stable")
LINEAR = Method(integrator="none")  # the frequency domain has no integrator
REPEATS = 3  # runs of each setting of the whole grid; the quickest counts
BUDGET = 20.0  # runs of the default setting, beside the reference
REFERENCE = 12.0  # of them, that the reference and its check are told to take
OTHERS = 0.01  # of its motion, that a default quantity may err by which nobody names
BENEATH = 1e-6  # of its motion, an error of which none is looked for
ORDER = next(one.order for one in integrators() if one.name == DEFAULT_INTEGRATOR)
ALIKE = 1.15  # times the least cost, which is no more than that


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
    told_s, took_s : float
        Processor time as told beforehand, and as it was, s.
    not_measured : int
        Settings that might still change the front when the budget ended; 0: none could.
    """

    rows: tuple[Row, ...]
    quantities: Mapping[str, Quantity]
    reference: Reference
    metadata: Mapping[str, Any]
    told_s: float = np.nan
    took_s: float = np.nan
    not_measured: int = 0

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
        """Rows that no other beats in both CPU time and error of the first quantity, cheapest first."""
        return self.front(next(iter(self.quantities)))

    def front(self, quantity: str) -> list[Row]:
        """As `pareto`, for any quantity."""
        limits_of(self.quantities, {quantity: 1.0})
        kept = [row for row, on in zip(self.rows, front(self.rows, quantity), strict=True) if on]
        return sorted(kept, key=lambda row: row.cpu_s)

    def cheapest(self, *, others: float | None = OTHERS, **accuracy: float) -> Method:
        """The method of the cheapest run of the full scene whose largest errors stay within the limits.

        Of settings that cost about the same, one that controls its error is taken before a fixed step, and
        then the most accurate.

        Parameters
        ----------
        others : float or None
            Largest error of every default quantity that is not named, over its motion (0.01); what the
            reference itself does not know is not asked. None: they may err by anything.
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
        limits = {**self._of_others(others), **limits}
        passing = [
            row
            for row in self._of_full_scene()
            if row.stable and all(row.error(name) <= limit for name, limit in limits.items())
        ]
        if not passing:
            raise SceneError(
                f"accuracy: no setting that was measured reaches all of {limits}; give others=None, which "
                "holds the quantities that are named alone, or a larger budget"
            )
        least = min(row.cpu_s for row in passing)
        alike = [row for row in passing if row.cpu_s <= ALIKE * least]
        best = min(alike, key=lambda row: (row.method.dt is not None, self._worst(row, limits)))
        return replace(best.method, formulation=best.formulation)

    def _of_others(self, share: float | None) -> dict[str, float]:
        """The largest errors of the default quantities."""
        if share is None or not self.default_quantities:
            return {}
        share = positive_of("cheapest: others", share)
        motion, known = self.reference.motion, self.reference.uncertainty
        return {name: max(share * motion[name], known[name]) for name in self.quantities}

    def _worst(self, row: Row, limits: Mapping[str, float]) -> float:
        return max(row.error(name) / limit if limit > 0.0 else 0.0 for name, limit in limits.items())

    @property
    def default_quantities(self) -> bool:
        """Whether the quantities are those that the scene has, and nobody named them."""
        return bool(self.metadata["default quantities"])

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

    @property
    def default(self) -> str:
        """What the default setting costs and errs by, and what half of each error costs."""
        rows = [row for row in self._of_full_scene() if row.stable]
        row = next((row for row in rows if row.method.integrator == DEFAULT_INTEGRATOR and row.method.rtol
                    == DEFAULT_TOLERANCE), None)  # fmt: skip
        if row is None:
            return "the default was not measured"
        wrong = ", ".join(f"{name} {row.error(name):.2g} {one.unit}" for name, one in self.quantities.items())
        told = (
            f"the default ({row.method.integrator} {row.method.setting}) takes {_ms(row)} and errs by {wrong}"
        )
        better = [one for one in rows if all(2.0 * one.error(q) <= row.error(q) for q in self.quantities)]
        if not better:
            more = 100.0 * (2.0 ** (1.0 / ORDER) - 1.0)
            return f"{told}; half of each costs about {more:.0f} % more by its order, and was not measured"
        half = min(better, key=lambda one: one.cpu_s)
        return f"{told}; half of each or less: {half.method.integrator} {half.method.setting}, {_ms(half)}"

    @property
    def price(self) -> str:
        """What it cost, what was told beforehand, and whether the budget ended it."""
        told = f"took {self.took_s:.2g} s of CPU; told {self.told_s:.2g} s"
        if self.not_measured:
            return f"{told}. The budget ended before {self.not_measured} settings that may change the front"
        return f"{told}. No setting that was left out is expected to change the front"

    def __str__(self) -> str:
        said = [self.default, self.price]
        if self.metadata.get("stages"):
            said = ["errors are those of the extremes of each stage", *said]
        return as_text(self.rows, self.quantities, self.reference.uncertainty, self.pareto, said)

    def _repr_html_(self) -> str:
        return as_html(self.metadata, list(self.quantities), self.pareto, len(self.rows))

    def plot(self, *, over: str = "cpu_s") -> Figure:
        """Work-precision diagrams: error of each quantity over cost, and what less physics loses.

        A line for each integrator, through those of its settings that none of its own beats; in colour where
        it is on the Pareto front of some quantity.

        Parameters
        ----------
        over : str
            "cpu_s": CPU time per simulated second. "wall_s": wall time, which depends on what else the
            machine does.

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
    stages: Sequence[Stage] = (),
    start: Start = None,
    outputs: Outputs | None = None,
    methods: Iterable[Method] | None = None,
    quantities: Sequence[str] | None = None,
    dt_out: float | None = None,
    budget: float | None = BUDGET,
    progress: bool = True,
    out: str | os.PathLike[str] | None = None,
) -> Trade:
    """Measure what methods cost and what error they bring, for one scene, within a budget.

    A tight reference and its check come first, in two formulations and by two methods. Then formulations,
    integrators and tolerances or steps on the full scene: what is nearest the front of cost and error first,
    and none that cannot change it. Then the scene with one part of its physics
    changed: fluid memory, evaluation of the waves, coupling of crane, payload and vessel; the other rungs of
    elastic lines (rigid, quasi-static, elastic), each at several tolerances. Methods and physics
    are not crossed: their errors add. What a method cannot do is a row that is not stable and says why.
    Other memories are fitted to the vessel's database; without one, only no memory is compared.

    Of a lift in stages, errors are those of the extremes of each stage; what its physics are worth tells
    `required`.

    Parameters
    ----------
    t_end : float
        End time, s.
    stages : sequence of Stage
        Carried out instead, as by `simulate_stages`.
    start : State or "rest", optional
        As of `simulate`.
    outputs : Outputs, optional
        Errors are taken at its times; what is recorded follows from the quantities. `dt_out` (s) is a
        shorthand for it.
    methods : iterable of Method, optional
        What to measure on the full scene, all of them; default: of a grid of every integrator of the core.
    quantities : sequence of str, optional
        "payload_position", "tip_velocity", "roll", "cylinder_force", "hook_load", or any channel. Default:
        those of the named ones that the scene has, else position and velocity of all bodies.
    budget : float or None
        In runs of the default setting, beside the reference; None: the whole grid, each three times.
    progress : bool
        Tell the price beforehand, and show a progress bar.
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
    runs = math.inf if budget is None else positive_of("budget", budget, "runs of the default setting")
    case = Case(
        scene=scene, t_end=number_of("t_end", t_end), dt_out=taken.dt_out, stages=tuple(stages), start=start
    )  # fmt: skip
    measured = quantities_of(scene, case.model, quantities)
    if case.stages:
        measured = {name: of_stages(one) for name, one in measured.items()}
    begun = time.process_time()
    unit, whole = _price(case, measured)
    told = REFERENCE * unit + (0.0 if math.isinf(runs) else runs) * whole
    if progress:
        sys.stderr.write(f"trade: {_told(runs, unit, told)}\n")
    metadata = {
        "scene": scene.name, "seacrane_version": __version__, "t_end": case.t_end, "dt_out": case.dt_out,
        "memory": simpler_scenes.memory_name(scene), "waves": simpler_scenes.waves_name(scene),
        "stages": ", ".join(stage.name for stage in case.stages),
        "default quantities": int(quantities is None),
    }  # fmt: skip
    truth = tight_reference(case, measured)
    metadata |= {"reference": truth.runs[0], "checked_by": "; ".join(truth.runs[1:])}
    metadata |= {f"refused {name}": reason for name, reason in truth.refused.items()}
    file = _row_file(out, {**metadata, "quantities": list(measured)}, scene)
    bench = Bench(case=case, quantities=measured, truth=truth, repeats=REPEATS if budget is None else 1)
    spending = Spending(unit_s=whole, runs=runs)
    if budget is None or methods is not None:
        rows, left = _all(bench, metadata, methods, file, few=budget is not None, progress=progress), 0
    else:
        rows, left = _best(bench, metadata, spending, file, progress=progress)
    if case.stages:
        metadata["t_end"] = max((row.simulated_s for row in rows if row.stable), default=math.nan)
    different = {row.key: row for row in reversed(rows)}  # two levels of a memory fit may give one model
    result = Trade(
        rows=tuple(reversed(different.values())), quantities=measured, reference=truth, metadata=metadata,
        told_s=told, took_s=time.process_time() - begun, not_measured=left,
    )  # fmt: skip
    if out is not None:
        result.save(out)
    return result


def _price(case: Case, quantities: Mapping[str, Quantity]) -> tuple[float, float]:
    """Processor time of one run of the default setting, and with all around it, s; not of the first."""
    for _ in range(2):
        begun = time.process_time()
        done = timed(case, Method(), [*channels_of(quantities), *CHECKS])
        if done.stopped is not None:
            raise done.stopped
        values_by(quantities)(done.result())
        whole = time.process_time() - begun
    return done.cpu_s, whole


def _told(runs: float, unit: float, told: float) -> str:
    """What a trade will cost, in a sentence."""
    one = f"one run takes {unit:.2g} s of CPU"
    if math.isinf(runs):
        return f"{one}, and the whole grid some hundreds of them, each three times"
    return (
        f"{one}, the reference and its check about {REFERENCE:g} of them, and up to {runs:g} are for the "
        f"rest: about {told:.2g} s of CPU"
    )


def _all(
    bench: Bench,
    metadata: Mapping[str, Any],
    methods: Iterable[Method] | None,
    file: RowFile,
    *,
    few: bool,
    progress: bool,
) -> list[Row]:
    """The whole grid, or all methods that are given, and all less physics."""
    tried = measured_methods() if methods is None else methods
    tasks = dict([*_methods(bench, metadata, tried), *_physics(bench, quick=few)])
    return completed(
        tasks, file, lambda keys: ((key, tasks[key](math.inf)) for key in keys), title="trade",
        progress=progress,
    )  # fmt: skip


def _best(
    bench: Bench, metadata: Mapping[str, Any], spending: Spending, file: RowFile, *, progress: bool
) -> tuple[list[Row], int]:
    """Within a budget; and how many settings that may change the front are left."""
    grid = {next(_methods(bench, metadata, [one]))[0]: one for one in measured_methods()}
    motion, known = bench.truth.motion, bench.truth.uncertainty
    floor = {name: max(known[name], BENEATH * motion[name]) for name in known}
    ladders = Ladders(grid.values(), list(bench.quantities), floor)

    def method_row(method: Method) -> Task:
        return next(_methods(bench, metadata, [method]))

    physics = {} if bench.case.stages else dict(_physics(bench, quick=True))
    rows = {key: row for key, row in file.rows.items() if key in grid or key in physics}
    for key, row in rows.items():  # of an earlier call
        spending.spend(row)
        if key in grid:
            ladders.add(grid[key], row)
    missing = {key: measure for key, measure in physics.items() if key not in rows}
    found = within_budget(spending, ladders, method_row, missing)
    for key, row in with_bar(found, spending, progress=progress):
        file.add(key, row)
        rows[key] = row
    order = {key: n for n, key in enumerate([*grid, *physics])}
    return [rows[key] for key in sorted(rows, key=order.__getitem__)], ladders.open


Task = tuple[str, Measure]  # the key of a row, and what measures it


def _methods(bench: Bench, metadata: Mapping[str, Any], methods: Iterable[Method]) -> Iterator[Task]:
    """One row for each method on the full scene."""
    full = {"memory": metadata["memory"], "waves": metadata["waves"], "rung": simpler_scenes.FULL}
    for method in methods:
        row = Row(case=full, method=method)
        yield row.key, partial(_of_method, bench, row)


def _physics(bench: Bench, *, quick: bool) -> Iterator[Task]:
    """One row for each scene with less physics, all by the same method; rungs of lines by several."""
    scene = bench.case.scene
    for variant in simpler_scenes.variants(scene, quick=quick):
        case = {"memory": variant.memory, "waves": variant.waves, "rung": variant.rung}
        if variant.rung == simpler_scenes.LINEAR:
            row = Row(case=case, method=LINEAR)
            yield row.key, partial(_of_linear, bench, row)
            continue
        for method in _of_rung(variant.rung, quick=quick):
            row = Row(case=case, method=method)
            yield row.key, partial(_of_variant, bench, variant, row)


def _of_method(bench: Bench, row: Row, limit_s: float) -> Row:
    return measure(bench, row, limit_s=limit_s)


def _of_linear(bench: Bench, row: Row, limit_s: float) -> Row:
    return frequency_domain(bench, row)


def _of_variant(bench: Bench, variant: simpler_scenes.Variant, row: Row, limit_s: float) -> Row:
    return measure_variant(bench, variant, row)


def _of_rung(rung: str, *, quick: bool) -> Sequence[Method]:
    if rung in LINE_RUNGS:
        return LINES[1::2] if quick else LINES
    return (Method(),) if quick else (PHYSICS,)


def _row_file(out: str | os.PathLike[str] | None, experiment: Mapping[str, Any], scene: Scene) -> RowFile:
    if out is None:
        return RowFile(None, experiment)
    folder = Path(out)
    if not folder.is_dir():
        raise SceneError(f"out {str(folder)!r} is no folder; create it first")
    return RowFile(folder / "trade_rows.jsonl", {**experiment, "described": scene_digest(scene)})


def _ms(row: Row) -> str:
    return f"{1e3 * row.cpu_s:.3g} ms"


def _or_nan(value: float | None) -> float:
    return np.nan if value is None else value
