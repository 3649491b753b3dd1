"""Allowable Hs by runs of several seeds at each of a few Hs, in the cells that ask for it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.databases import without_databases
from seacrane.ensembles.ensemble import Ensemble, ensemble
from seacrane.ensembles.job import stepped
from seacrane.ensembles.other_sea import with_sea
from seacrane.ensembles.stage_values import Stages
from seacrane.ensembles.study import Start
from seacrane.errors import SeacraneError
from seacrane.operability.criterion import Criterion, RecordNumbers, reached, record_numbers, seeds_level
from seacrane.operability.linear_channels import LinearSeas
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.scene.scene import Scene
from seacrane.validity.after_run import require_finite

Array = NDArray[np.float64]
Cell = tuple[float, float]  # peak period, s, and direction, degrees


@dataclass(frozen=True, kw_only=True)
class ByTime:
    """Allowable Hs of one criterion in one cell, m, by its estimate and the ends of its 95 % interval.

    `allowable` is infinite where no Hs of the grid reaches the criterion, and NaN where it is not known,
    because runs failed at the lowest Hs. `unknown` is the Hs, m, at which runs failed before it was reached,
    or NaN; `failed` counts the runs that failed up to the Hs that was reached.
    """

    allowable: float
    low: float
    high: float
    unknown: float = float("nan")
    failed: int = 0


@dataclass(frozen=True, kw_only=True)
class Storms:
    """What is run for a cell.

    Attributes
    ----------
    scene : Its references held, with its sea.
    begin : Time of the state at rest, s.
    start : State or SteadyStart
        Where runs begin.
    start_up : Left out, s.
    duration : Evaluated, s; None of lifts in stages, each of which is one.
    hs : m, ascending.
    rest : Value of each at rest.
    method, outputs
        Of the runs.
    stages
        Of lifts in stages, as of `ensemble`.
    """

    scene: Scene
    begin: float
    start: Start
    start_up: float
    duration: float | None
    hs: tuple[float, ...]
    seeds: tuple[int, ...]
    criteria: tuple[Criterion, ...]
    rest: Array
    method: Method
    outputs: Outputs
    stages: Stages = ()
    accuracy: Mapping[str, float] | None = None

    def run(
        self,
        cells: Sequence[Cell],
        *,
        executor: Executor | None,
        store: str | os.PathLike[str] | None,
        progress: bool,
    ) -> Ensemble:
        """All storms of the cells, seeds fastest."""
        over: list[Mapping[str, Any]] = [
            {"tp": tp, "direction_deg": direction, "hs": hs, "seed": seed}
            for tp, direction in cells
            for hs in self.hs
            for seed in self.seeds
        ]
        after = self.begin + self.start_up
        keep = {
            f"criterion_{i}": RecordNumbers(
                channel=one.channel, names=one.names, after=after, stage=one.stage
            )
            for i, one in enumerate(self.criteria)
        }
        return ensemble(
            self.scene, over=over, keep=keep, stages=self.stages,
            t_end=None if self.duration is None else after + self.duration, method=self.method,
            outputs=self.outputs, start=self.start, executor=executor,
            store=store, progress=progress, accuracy=self.accuracy,
        )  # fmt: skip

    def allowable(self, storms: Ensemble, cells: Sequence[Cell]) -> list[list[ByTime]]:
        """By cell and criterion."""
        shape = (len(cells), len(self.hs), len(self.seeds))
        found: list[list[ByTime]] = [[] for _ in cells]
        for i, (criterion, rest) in enumerate(zip(self.criteria, self.rest, strict=True)):
            name = f"criterion_{i}"
            numbers = storms.dataset[name].to_numpy() if name in storms.dataset else np.full((1, 4), np.nan)
            numbers = np.broadcast_to(numbers, (int(np.prod(shape)), 4)).reshape(*shape, 4)
            for place, of_cell in enumerate(reached(criterion, numbers, float(rest))):
                found[place].append(self._crossing(criterion, of_cell, criterion.allowance(float(rest))))
        return found

    def _crossing(self, criterion: Criterion, values: Array, allowance: float) -> ByTime:
        levels = [seeds_level(criterion, row, self.duration) for row in values]
        by = {
            name: first_crossing(self.hs, [getattr(level, of) for level in levels], allowance)
            for name, of in (("allowable", "value"), ("low", "high"), ("high", "low"))
        }
        until = int(np.searchsorted(self.hs, by["allowable"])) + 1
        return ByTime(
            **by,
            unknown=first_unknown(self.hs, [level.value for level in levels], allowance),
            failed=int(np.isnan(values[:until]).sum()),
        )


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
    scene: Scene,
    linear: LinearSeas,
    criteria: Sequence[Criterion],
    seas: Iterable[Mapping[str, Any]],
    *,
    start: float,
    duration: float,
    method: Method,
    outputs: Outputs,
    executor: Executor | None,
) -> Iterator[Array | str]:
    """For each sea and criterion what a run reached beyond the linear model, over the allowance, (m,).

    A text where the run failed: why.

    Parameters
    ----------
    scene : Its references held.
    seas : By their words.
    start, duration : s.
    method, outputs
        Of the runs.
    """
    steps = np.arange(round(duration / outputs.dt_out) + 1, dtype=float)
    scenes, starts, told = [], [], []
    for sea in seas:
        one = with_sea(scene, sea)
        assert one.waves is not None
        state, values = linear.in_waves(one.waves, start, start + steps * outputs.dt_out)
        scenes.append(without_databases(one))
        starts.append(state)
        told.append([record_numbers(column) for column in values.T])
    run = partial(_numbers, t_end=start + duration, criteria=criteria, method=method, outputs=outputs)
    runs = map(run, scenes, starts) if executor is None else executor.map(run, scenes, starts)
    for found, numbers in zip(runs, told, strict=True):
        if isinstance(found, str):
            yield found
            continue
        each = zip(criteria, found, numbers, linear.channels.rest.tolist(), strict=True)
        yield np.array([_apart(*one) for one in each])


def _apart(criterion: Criterion, run: Array, linear: Array, rest: float) -> float:
    apart = reached(criterion, run, rest) - reached(criterion, linear, rest)
    return abs(float(apart)) / criterion.allowance(rest)


def _numbers(
    scene: Scene,
    start: _core.State,
    *,
    t_end: float,
    criteria: Sequence[Criterion],
    method: Method,
    outputs: Outputs,
) -> Array | str:
    """`record_numbers` of each criterion's channel of a run, (m, 4), or why it failed."""
    try:
        run = stepped(Run(scene, t_end, start=start, method=method, outputs=outputs))
        result = require_finite(run.result())
        return np.array([record_numbers(result.curve(one.channel, **one.names)) for one in criteria])
    except (SeacraneError, ArithmeticError, ValueError) as error:
        return f"{type(error).__name__}: {error}"
