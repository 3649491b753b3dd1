"""trade(): what every setting costs and what error it brings, for the scene at hand."""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from seacrane.accuracy import simpler_scenes
from seacrane.accuracy.case import Case, timed
from seacrane.accuracy.measured import CHECKS, Reference, measured, tight_reference
from seacrane.accuracy.methods import Ladders, measured_methods
from seacrane.accuracy.quantities import Quantity, channels_of, of_stages, quantities_of
from seacrane.accuracy.row import Row, RowFile
from seacrane.accuracy.trade_answer import Trade
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of
from seacrane.inputs.keywords import named
from seacrane.run.method import Method, Start, settled
from seacrane.run.outputs import Outputs
from seacrane.run.stage import Stage
from seacrane.scene.file import scene_digest
from seacrane.scene.scene import Scene
from seacrane.version import __version__

REPEATS = 3  # runs of each setting of the whole grid; the quickest counts
BUDGET = 20.0  # runs of the default setting, beside the reference
REFERENCE = 12.0  # of them, that the reference and its check are told to take
BENEATH = 1e-6  # of its motion, an error of which none is looked for
LONG = 0.3  # s of wall time from which on one run tells the cost
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
    integrators and tolerances or steps: what is nearest the front of cost and error first, and none that
    cannot change it. What a method cannot do is a row that is not stable and says why. What the physics of
    the scene are worth, `required` measures.

    Of a lift in stages, errors are those of the extremes of each stage.

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
        What to measure, all of them; default: of a grid of every integrator of the core.
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
        "memory": simpler_scenes.memory_name(scene),
        "waves": "none" if scene.waves is None else scene.waves.evaluation,
        "stages": ", ".join(stage.name for stage in stages),
        "default quantities": int(quantities is None),
    }  # fmt: skip
    truth = tight_reference(case, asked)
    metadata |= {"reference": truth.runs[0], "checked_by": "; ".join(truth.runs[1:])}
    metadata |= {f"refused {name}": reason for name, reason in truth.refused.items()}
    folder = None if out is None else Path(out)
    if folder is not None and not folder.is_dir():
        raise SceneError(f"out {str(folder)!r} is no folder; create it first")
    experiment = {**metadata, "quantities": list(asked), "described": scene_digest(scene)}
    file = RowFile(folder and folder / "trade_rows.jsonl", experiment)
    bench = Bench(case=case, quantities=asked, truth=truth, repeats=REPEATS if budget is None else 1)
    spending = Spending(unit_s=whole, runs=runs)
    rows, left = _measured(bench, spending, methods, file, progress=progress)
    if stages:
        metadata["t_end"] = max((row.simulated_s for row in rows if row.stable), default=math.nan)
    result = Trade(
        rows=tuple(rows), quantities=asked, reference=truth, metadata=metadata, told_s=told,
        took_s=time.process_time() - begun, not_measured=left,
    )  # fmt: skip
    if folder is not None:
        result.save(folder)
    return result


def _price(case: Case, quantities: Mapping[str, Quantity]) -> tuple[float, float]:
    """Processor time of one run of the default setting, and with all around it, s; not of the first."""
    for _ in range(2):
        begun = time.process_time()
        done = timed(case, Method(), [*channels_of(quantities), *CHECKS])
        result = done.result()
        for quantity in quantities.values():
            quantity.values(result)
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


@dataclass(kw_only=True)
class Spending:
    """Processor time that is left, s, in runs of the default setting."""

    unit_s: float  # of one such run with all around it
    runs: float  # of them, that may be spent; infinite: any
    spent_s: float = 0.0  # by now

    def spend(self, row: Row, around_s: float = 0.0) -> None:
        """What a row took, with all around its run."""
        self.spent_s += max(row.cpu_s if row.cpu_s > 0.0 else 0.0, around_s)


@dataclass(frozen=True, kw_only=True, eq=False)
class Bench:
    """What every row of a trade is measured with; of equal runs, so many, the quickest counts."""

    case: Case
    quantities: Mapping[str, Quantity]
    truth: Reference
    repeats: int

    def measure(self, method: Method, limit_s: float | None) -> Row:
        """The row of a method, whose run may take so much processor time, s."""
        return measured(
            self.case, method, self.quantities, self.truth, Row(case={}, method=method),
            repeats=self.repeats, long_s=LONG, limit_s=limit_s,
        )  # fmt: skip


def _measured(
    bench: Bench, spending: Spending, methods: Iterable[Method] | None, file: RowFile, *, progress: bool
) -> tuple[list[Row], int]:
    """Rows of methods, and how many settings that may change the front are left."""
    from tqdm import tqdm

    every = methods is not None or math.isinf(spending.runs)
    grid = {one.name: one for one in (measured_methods() if methods is None else methods)}
    motion, known = bench.truth.motion, bench.truth.uncertainty
    floor = {name: max(known[name], BENEATH * motion[name]) for name in known}
    ladders = Ladders(() if every else grid.values(), list(bench.quantities), floor)
    rows: dict[str, Row] = {}

    def add(row: Row, around_s: float = 0.0) -> None:
        rows[row.key] = row
        spending.spend(row, around_s)
        if not every:
            ladders.add(row.method, row)

    for key, row in file.rows.items():
        if key in grid:
            add(row)
    limit_s = None if every else LONGEST * spending.unit_s
    total = len(grid) if every else round(spending.runs)
    order = grid.values() if every else _chosen(spending, ladders)
    with tqdm(total=total, desc="trade", unit="row" if every else "run", disable=not progress) as bar:
        for method in order:
            if method.name not in rows:
                begun, row = time.process_time(), bench.measure(method, limit_s)
                file.add(row.key, row)
                add(row, time.process_time() - begun)
            done = len(rows) if every else round(spending.spent_s / spending.unit_s)
            bar.update(min(done, total) - bar.n)
    return [rows[key] for key in grid if key in rows], ladders.open


def _chosen(spending: Spending, ladders: Ladders) -> Iterator[Method]:
    """The nearest to the front first, until the budget ends or nothing can change the front."""
    while spending.runs * spending.unit_s - spending.spent_s > LEAST * spending.unit_s:
        if (method := ladders.next()) is None:
            return
        yield method
