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
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.accuracy import simpler_scenes
from seacrane.accuracy.case import Case, timed
from seacrane.accuracy.measured import CHECKS, Reference, measured, tight_reference, values_by, with_errors
from seacrane.accuracy.methods import LINES, PHYSICS, Ladders, measured_methods
from seacrane.accuracy.quantities import Quantity, channels_of, of_stages, quantities_of
from seacrane.accuracy.row import REFUSED, Row, RowFile
from seacrane.accuracy.trade_answer import Trade
from seacrane.analysis.drag_in_sea import drag_in_components
from seacrane.analysis.frequency_domain import response_summed
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.description.crane_parts import hooks, payloads
from seacrane.errors import SceneError, SeacraneError
from seacrane.inputs.checked import number_of, positive_of
from seacrane.inputs.frames import heading_of, rotation_matrix
from seacrane.inputs.keywords import named
from seacrane.result.result import Result
from seacrane.run.method import Method, Start, settled
from seacrane.run.outputs import Outputs
from seacrane.run.stage import Stage
from seacrane.scene.file import scene_digest
from seacrane.scene.scene import Scene
from seacrane.validity.after_run import require_finite
from seacrane.version import __version__

REPEATS = 3  # runs of each setting of the whole grid; the quickest counts
BUDGET = 20.0  # runs of the default setting, beside the reference
REFERENCE = 12.0  # of them, that the reference and its check are told to take
BENEATH = 1e-6  # of its motion, an error of which none is looked for
METHODS = 0.6  # of the budget, before physics is left out
LONG = 0.3  # s of wall time from which on one run tells the cost
LINEAR = Method(integrator="none")  # the frequency domain has no integrator
Array = NDArray[np.float64]
Task = tuple[Row, simpler_scenes.Build | None]  # to be filled in, and what makes its scene with less physics
LEAST = 0.5  # runs, that any row may take
LONGEST = 3.0  # runs, that no row of a method may take more than


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
        scene=scene, t_end=number_of("t_end", t_end), dt_out=taken.dt_out, stages=tuple(stages) or None,
        start=start,
    )  # fmt: skip
    asked = quantities_of(scene, case.model, quantities)
    if stages:
        asked = {name: of_stages(one) for name, one in asked.items()}
    begun = time.process_time()
    unit, whole = _price(case, asked)
    told = REFERENCE * unit + (0.0 if math.isinf(runs) else runs) * whole
    if progress:
        sys.stderr.write(f"trade: {_told(runs, unit, told)}\n")
    metadata = {
        "scene": scene.name, "seacrane_version": __version__, "t_end": case.t_end, "dt_out": case.dt_out,
        "memory": simpler_scenes.memory_name(scene), "waves": simpler_scenes.waves_name(scene),
        "stages": ", ".join(stage.name for stage in stages),
        "default quantities": int(quantities is None),
    }  # fmt: skip
    truth = tight_reference(case, asked)
    metadata |= {"reference": truth.runs[0], "checked_by": "; ".join(truth.runs[1:])}
    metadata |= {f"refused {name}": reason for name, reason in truth.refused.items()}
    file = _row_file(out, {**metadata, "quantities": list(asked)}, scene)
    bench = Bench(case=case, quantities=asked, truth=truth, repeats=REPEATS if budget is None else 1)
    spending = Spending(unit_s=whole, runs=runs)
    rows, left = _measured(bench, spending, methods, file, progress=progress)
    if stages:
        metadata["t_end"] = max((row.simulated_s for row in rows if row.stable), default=math.nan)
    different = {row.key: row for row in reversed(rows)}  # two levels of a memory fit may give one model
    result = Trade(
        rows=tuple(reversed(different.values())), quantities=asked, reference=truth, metadata=metadata,
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


def _row_file(out: str | os.PathLike[str] | None, experiment: Mapping[str, Any], scene: Scene) -> RowFile:
    folder = None if out is None else Path(out)
    if folder is not None and not folder.is_dir():
        raise SceneError(f"out {str(folder)!r} is no folder; create it first")
    path = folder and folder / "trade_rows.jsonl"
    return RowFile(path, {**experiment, "described": scene_digest(scene)})


@dataclass(kw_only=True)
class Spending:
    """Processor time that is left, s, in runs of the default setting.

    Attributes
    ----------
    unit_s : Of one such run with all around it, s.
    runs : Of them that may be spent; infinite: any.
    spent_s : By now, s.
    """

    unit_s: float
    runs: float
    spent_s: float = 0.0

    def has_room(self, share: float = 1.0) -> bool:
        """Whether a share of the budget has room for another row."""
        return share * self.runs * self.unit_s - self.spent_s > LEAST * self.unit_s

    def spend(self, row: Row, around_s: float = 0.0) -> None:
        """What a row took, with all around its run."""
        self.spent_s += max(row.cpu_s if row.cpu_s > 0.0 else 0.0, around_s)


def _measured(
    bench: Bench, spending: Spending, methods: Iterable[Method] | None, file: RowFile, *, progress: bool
) -> tuple[list[Row], int]:
    """Rows of methods, then of less physics; and how many settings that may change the front are left.

    The whole grid without a budget, and all methods that are given. What the file holds is not measured
    again.
    """
    from tqdm import tqdm

    few, every = math.isfinite(spending.runs), methods is not None or math.isinf(spending.runs)
    tried = measured_methods() if methods is None else methods
    full = simpler_scenes.full_case(bench.case.scene)
    wanted: list[Task] = [(Row(case=full, method=one), None) for one in tried]
    grid = {row.key: row.method for row, _ in wanted}
    less = () if bench.case.stages else physics(bench, quick=few)
    tasks = {task[0].key: task for task in (*wanted, *less)}
    rows: dict[str, Row] = {}
    ladders = Ladders(() if every else grid.values(), list(bench.quantities), _floor(bench))

    def add(key: str, row: Row, around_s: float = 0.0) -> None:
        rows[key] = row
        spending.spend(row, around_s)
        if key in grid and not every:
            ladders.add(grid[key], row)

    for key, row in file.rows.items():
        if key in tasks:
            add(key, row)
    limit_s = None if every else LONGEST * spending.unit_s
    total = len(tasks) if every else round(spending.runs)
    order = iter(tasks) if every else _chosen(spending, ladders, tasks, grid)
    with tqdm(total=total, desc="trade", unit="row" if every else "run", disable=not progress) as bar:
        for key in order:
            if key not in rows:
                begun, (row, build) = time.process_time(), tasks[key]
                row = measure(bench, row, build, limit_s)
                file.add(key, row)
                add(key, row, time.process_time() - begun)
            done = len(rows) if every else round(spending.spent_s / spending.unit_s)
            bar.update(min(done, total) - bar.n)
    return [rows[key] for key in tasks if key in rows], ladders.open


def _floor(bench: Bench) -> dict[str, float]:
    """Errors by quantity below which none is looked for."""
    motion, known = bench.truth.motion, bench.truth.uncertainty
    return {name: max(known[name], BENEATH * motion[name]) for name in known}


def _chosen(
    spending: Spending, ladders: Ladders, tasks: Iterable[str], grid: Mapping[str, Method]
) -> Iterator[str]:
    """Keys of rows, the nearest to the front first, until the budget ends or nothing can change the front."""
    keys = {method: key for key, method in grid.items()}
    for share, less in ((METHODS, [key for key in tasks if key not in grid]), (1.0, [])):
        while spending.has_room(share) and (method := ladders.next()) is not None:
            yield keys[method]
        yield from (key for key in less if spending.has_room())


@dataclass(frozen=True, kw_only=True, eq=False)
class Bench:
    """What every row of a trade is measured with.

    Attributes
    ----------
    case : The full scene.
    quantities : mapping of str to Quantity
    repeats : Equal runs; the quickest counts.
    """

    case: Case
    quantities: Mapping[str, Quantity]
    truth: Reference
    repeats: int


def physics(bench: Bench, *, quick: bool) -> Iterator[Task]:
    """Each scene with less physics, all by the same method; rungs of lines by several."""
    for case, build in simpler_scenes.variants(bench.case.scene, quick=quick):
        for method in _of_rung(case["rung"], quick=quick):
            yield Row(case=case, method=method), build


def _of_rung(rung: str, *, quick: bool) -> Sequence[Method]:
    if rung == simpler_scenes.LINEAR:
        return (LINEAR,)
    if rung in simpler_scenes.LINE_RUNGS:
        return LINES[1::2] if quick else LINES
    return (Method(),) if quick else (PHYSICS,)


def measure(
    bench: Bench, row: Row, build: simpler_scenes.Build | None = None, limit_s: float | None = None
) -> Row:
    """The row filled in; a fitted memory is named by its states.

    Parameters
    ----------
    build : callable, optional
        Makes a scene with less physics; default: the full one.
    limit_s : Processor time that a run of the full scene may take, s.
    """
    case, before, values = bench.case, (0.0, 0.0), None
    try:
        if build is not None:
            limit_s, case = None, replace(case, scene=build())
            memory = simpler_scenes.full_memory_name(case.scene, str(row.case["memory"]))
            row = replace(row, case={**row.case, "memory": memory})
        if row.case["rung"] == simpler_scenes.LINEAR:
            return _frequency_domain(bench, row)
        if row.case["rung"] == simpler_scenes.WEIGHT:
            values = partial(_values_of_weight, bench.quantities, bench.case.scene)
        elif row.case["rung"] == simpler_scenes.PRESCRIBED:
            case, before = _prescribed(bench, case, row.method)
    except (SeacraneError, ValueError) as error:
        return row.ended(REFUSED, error)
    done = measured(
        case, row.method, bench.quantities, bench.truth, row, values=values,
        repeats=bench.repeats, long_s=LONG, limit_s=limit_s,
    )  # fmt: skip
    return replace(done, wall_s=done.wall_s + before[0], cpu_s=done.cpu_s + before[1])


def _prescribed(bench: Bench, case: Case, method: Method) -> tuple[Case, tuple[float, float]]:
    """The case with the vessel's motion of a locked crane prescribed; wall and CPU time of finding it, s."""
    alone = replace(case, scene=simpler_scenes.locked(case.scene))
    done = timed(alone, method, ["vessel_motion"], repeats=bench.repeats, long_s=LONG)
    result = require_finite(done.result())
    driven = simpler_scenes.with_prescribed_vessel(case.scene, result.time, result["vessel_motion"])
    return replace(case, scene=driven), (done.wall_s, done.cpu_s)


def _values_of_weight(
    quantities: Mapping[str, Quantity], scene: Scene, result: Result
) -> Mapping[str, Array]:
    """Tension is the weight; each payload hangs plumb under its tip."""
    links = [scene.joints[link] for link in hooks(scene).values()]
    found = [_under_the_tip(scene, result, link) for link in links]
    out = {name: np.stack([one[name] for one in found], axis=1) for name in found[0]}
    if [link.second for link in links] != list(payloads(scene).values()):
        del out["payload_position"]
    return {**values_by(quantities)(result), **out}


def _under_the_tip(scene: Scene, result: Result, link: _core.Joint) -> dict[str, Array]:
    """What `_values_of_weight` returns for one payload, each of shape (n, parts)."""
    payload, body = scene.bodies[link.second], scene.bodies[link.first]
    turn = rotation_matrix(result.select("quaternion", body=link.first))
    lever = np.asarray(link.first_frame.point) - np.asarray(body.center_of_mass)
    tip = result.select("position", body=link.first) + turn @ lever
    below = link.length + float(link.second_frame.point[2] - payload.center_of_mass[2])
    return {
        "hook_load": np.full((len(tip), 1), payload.mass * scene.gravity),
        "payload_position": tip - np.array([0.0, 0.0, below]),
    }


def _frequency_domain(bench: Bench, row: Row) -> Row:
    """The row of the linear model about the described pose, in its steady state under the same waves."""
    begun, ticks = time.perf_counter(), time.thread_time()
    values = _linear_values(bench.case, bench.truth.values)
    done = replace(
        row, stepped="linear", wall_s=time.perf_counter() - begun, cpu_s=time.thread_time() - ticks,
        simulated_s=bench.case.t_end, uncertainty=bench.truth.uncertainty,
    )  # fmt: skip
    return with_errors(done, values, bench.truth, bench.quantities)


def _linear_values(case: Case, truth: Mapping[str, Array]) -> dict[str, Array]:
    scene = case.scene
    hulls = {} if scene.waves is None else scene.waves.hulls
    linear = linear_model(scene, vessel=next(iter(hulls), None))
    if scene.waves is not None:
        linear = drag_in_components(linear, scene.waves)
    times: Array = case.dt_out * np.arange(len(next(iter(truth.values()))), dtype=float)
    values: dict[str, Array] = {}
    if "roll" in truth:
        rolls = [_roll(linear, vessel.body, times) for vessel in scene.vessels.values()]
        values["roll"] = np.stack(rolls, axis=1)[:, :, None]
    if "payload_position" in truth:
        start = truth["payload_position"][0]
        bodies = payloads(scene).values()
        moved = [response_summed(linear, body=body).at(times)[:, :3] for body in bodies]
        values["payload_position"] = start + np.stack(moved, axis=1)
    return values


def _roll(linear: LinearModel, body: str, times: Array) -> Array:
    """The roll of a vessel about its own axis, rad."""
    heading = heading_of(linear.scene.bodies[body].quaternion)
    rotation = response_summed(linear, body=body).at(times)[:, 3:]
    return np.asarray(np.cos(heading) * rotation[:, 0] + np.sin(heading) * rotation[:, 1])
