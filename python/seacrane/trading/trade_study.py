"""trade(): what every setting costs and what error it brings, for the scene at hand."""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seacrane.accuracy.quantities import Quantity, quantities_of
from seacrane.description.file import scene_digest
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of
from seacrane.inputs.keywords import named
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.shorthand import settled
from seacrane.run.stage import Stage
from seacrane.run.start import Start
from seacrane.trading import simpler_scenes
from seacrane.trading.budget import Measure, Spending, with_bar, within_budget
from seacrane.trading.case import Case
from seacrane.trading.ladders import Ladders
from seacrane.trading.lines_on_rungs import LINE_RUNGS
from seacrane.trading.measured_case import CHECKS, channels_of, timed, values_by
from seacrane.trading.methods import LINES, PHYSICS, measured_methods
from seacrane.trading.row import Row
from seacrane.trading.row_file import RowFile, completed
from seacrane.trading.stage_extremes import of_stages
from seacrane.trading.trade_answer import Trade
from seacrane.trading.trade_rows import Bench, frequency_domain, measure, measure_variant, tight_reference
from seacrane.version import __version__

if TYPE_CHECKING:
    from seacrane.scene.scene import Scene

LINEAR = Method(integrator="none")  # the frequency domain has no integrator
REPEATS = 3  # runs of each setting of the whole grid; the quickest counts
BUDGET = 20.0  # runs of the default setting, beside the reference
REFERENCE = 12.0  # of them, that the reference and its check are told to take
BENEATH = 1e-6  # of its motion, an error of which none is looked for


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
        Carried out instead, as by `simulate`.
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
