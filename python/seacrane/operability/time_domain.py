"""Allowable Hs by runs of several seeds at each of a few Hs, in the cells that ask for it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.after_run import require_finite
from seacrane.arrays import Array
from seacrane.description.databases import without_databases
from seacrane.ensembles.dataset import Outcome
from seacrane.ensembles.ensemble import Ensemble, ensemble
from seacrane.ensembles.growing import Judge
from seacrane.ensembles.job import Clock, stepped
from seacrane.ensembles.other_sea import with_sea
from seacrane.ensembles.parts import Part
from seacrane.ensembles.price import Priced
from seacrane.ensembles.study import Start
from seacrane.errors import SeacraneError
from seacrane.operability.asked import Asked, Still
from seacrane.operability.criterion import Criterion, RecordNumbers, reached, record_numbers, seeds_level
from seacrane.operability.linear_channels import LinearSeas
from seacrane.run.run import Run
from seacrane.scene.scene import Scene


@dataclass(frozen=True, kw_only=True)
class ByTime:
    """Allowable Hs of one criterion in one cell, m, by its estimate and the ends of its 95 % interval.

    `allowable` is infinite where no Hs of the grid reaches the criterion, and NaN where it is not known,
    because runs failed at the lowest Hs. `unknown` is the Hs, m, at which runs failed before it was reached,
    or NaN; `failed` counts the runs that failed up to the Hs that was reached; `again` is the lowest Hs, m,
    above the allowable one at which the criterion is kept again, or NaN.
    """

    allowable: float
    low: float
    high: float
    unknown: float = float("nan")
    failed: int = 0
    again: float = float("nan")


def storms_in(
    asked: Asked, still: Still, judge: Judge, start: Start, *, executor: Executor | None,
    store: str | os.PathLike[str] | None, progress: bool, part: Part | None, priced: Priced | None,
) -> Ensemble:  # fmt: skip
    """Runs of the seeds that the judge asks for, at each Hs, in the cells that it wants."""
    over = {"seed": asked.seeds, "tp": asked.tp, "direction_deg": asked.direction_deg, "hs": asked.hs}
    after = still.state.time + asked.start_up
    keep = {
        kept_as(i): RecordNumbers(channel=one.channel, names=one.names, after=after, stage=one.stage)
        for i, one in enumerate(asked.criteria)
    }
    return ensemble(
        still.scene, over=over, keep=keep, stages=asked.stages,
        t_end=None if asked.duration is None else after + asked.duration, method=asked.method,
        outputs=asked.outputs, start=start, executor=executor, store=store, progress=progress,
        accuracy=asked.accuracy, until=judge, part=None if part is None else str(part), priced=priced,
    )  # fmt: skip


def kept_as(criterion: int) -> str:
    """Name under which the numbers of a criterion are kept."""
    return f"criterion_{criterion}"


def numbers_of(outcomes: Sequence[Outcome], asked: Asked) -> Array:
    """`record_numbers` of the runs of a cell, (criteria, Hs, seeds, 4); NaN where one failed."""
    heights = len(asked.hs)
    ordered = sorted(outcomes, key=lambda one: one.index)  # seeds slowest, Hs fastest
    lost = np.full(4, np.nan)
    every = [
        [one.kept[name].values if name in one.kept else lost for one in ordered]
        for name in map(kept_as, range(len(asked.criteria)))
    ]
    return np.array(every).reshape(len(every), -1, heights, 4).swapaxes(1, 2)


def allowable_of(asked: Asked, still: Still, numbers: Array) -> list[ByTime]:
    """By criterion, of a cell's (criteria, Hs, seeds, 4)."""
    each = zip(asked.criteria, numbers, still.rest.tolist(), strict=True)
    return [
        _crossing(asked, criterion, reached(criterion, kept, rest), criterion.allowance(rest))
        for criterion, kept, rest in each
    ]


def _crossing(asked: Asked, criterion: Criterion, values: Array, allowance: float) -> ByTime:
    levels = [seeds_level(criterion, row, asked.duration) for row in values]
    by = {
        name: first_crossing(asked.hs, [getattr(level, of) for level in levels], allowance)
        for name, of in (("allowable", "value"), ("low", "high"), ("high", "low"))
    }
    until = int(np.searchsorted(asked.hs, by["allowable"])) + 1
    each = [(height, level.value) for height, level in zip(asked.hs, levels, strict=True)]
    kept = (height for height, value in each if height > by["allowable"] and value < allowance)
    return ByTime(
        **by, unknown=first_unknown(asked.hs, [value for _, value in each], allowance),
        failed=int(np.isnan(values[:until]).sum()), again=next(kept, float("nan")),
    )  # fmt: skip


def first_crossing(hs: Sequence[float], levels: Sequence[float], allowance: float) -> float:
    """Lowest Hs (m) at which levels over Hs reach the allowance, linear in between, from zero at Hs 0.

    Infinite where none does. Below a level that is not known the last one before it counts, and NaN where
    there is none.
    """
    if allowance <= 0.0:
        return 0.0
    below, before = 0.0, 0.0
    for height, level in zip(hs, levels, strict=True):
        if not np.isfinite(level):
            return below if below > 0.0 else float("nan")
        if level >= allowance:
            return below + (height - below) * (allowance - before) / (level - before)
        below, before = height, level
    return float("inf")


def first_unknown(hs: Sequence[float], levels: Sequence[float], allowance: float) -> float:
    """Lowest Hs (m) whose level is not known, where none below it reaches the allowance; else NaN."""
    if allowance <= 0.0:
        return float("nan")
    beyond = ((height, level) for height, level in zip(hs, levels, strict=True) if not level < allowance)
    height, level = next(beyond, (float("nan"), 0.0))
    return float("nan") if np.isfinite(level) else height


def differences(
    asked: Asked, still: Still, linear: LinearSeas, seas: Iterable[Mapping[str, Any]],
    executor: Executor | None,
) -> Iterator[Array | str]:  # fmt: skip
    """For each sea and criterion what a run reached beyond the linear model, over the allowance, (m,).

    A text where the run failed: why.
    """
    assert asked.duration is not None
    start, dt_out = still.state.time, asked.outputs.dt_out
    steps = np.arange(round(asked.duration / dt_out) + 1, dtype=float)
    scenes, starts, told = [], [], []
    for sea in seas:
        one = with_sea(still.scene, sea)
        assert one.waves is not None
        state, values = linear.in_waves(one.waves, start, start + steps * dt_out)
        scenes.append(without_databases(one))
        starts.append(state)
        told.append([record_numbers(column) for column in values.T])
    work = partial(_numbers, t_end=start + asked.duration, asked=asked)
    runs = map(work, scenes, starts) if executor is None else executor.map(work, scenes, starts)
    for found, numbers in zip(runs, told, strict=True):
        if isinstance(found, str):
            yield found
            continue
        each = zip(asked.criteria, found, numbers, linear.channels.rest.tolist(), strict=True)
        yield np.array(
            [
                abs(float(reached(one, run, rest) - reached(one, model, rest))) / one.allowance(rest)
                for one, run, model, rest in each
            ]
        )


def _numbers(scene: Scene, start: _core.State, *, t_end: float, asked: Asked) -> Array | str:
    """`record_numbers` of each criterion's channel of a run, (m, 4), or why it failed."""
    try:
        how: Any = {"method": asked.method, "outputs": asked.outputs, "peaks": ()}  # curves are all it reads
        with Clock() as clock:
            run = stepped(Run(scene, t_end, start=start, **how), clock)
        clock.take()
        result = require_finite(run.result())
        return np.array([record_numbers(result.curve(one.channel, **one.names)) for one in asked.criteria])
    except (SeacraneError, ArithmeticError, ValueError) as error:
        return f"{type(error).__name__}: {error}"
