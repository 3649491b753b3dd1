"""What is run by one method after the other: a scene to a time, or a lift in stages; and what that costs."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.accuracy.quantities import offered_channels
from seacrane.errors import SimulationError
from seacrane.result.result import Result
from seacrane.run.channel_names import missing_names
from seacrane.run.method import Method, Start
from seacrane.run.outputs import DEFAULT_INTERVAL, Outputs
from seacrane.run.run import Run
from seacrane.run.stage import Stage
from seacrane.run.staged_run import StagedRun
from seacrane.scene.scene import Scene


@dataclass(frozen=True, kw_only=True, eq=False)
class Case:
    """One scene, how long it is run, and when errors are taken."""

    scene: Scene
    t_end: float  # s
    dt_out: float = DEFAULT_INTERVAL  # s between outputs, where none are given
    start: Start = None  # default: the assembled start
    stages: tuple[Stage, ...] | None = None  # carried out in place of one run to `t_end`
    first: str | None = None  # the stage to begin with
    compiled: _core.Model | None = None  # to save compiling it again

    @cached_property
    def model(self) -> _core.Model:
        """The compiled scene; one serves all runs."""
        return self.scene.compile() if self.compiled is None else self.compiled

    def begun(self, method: Method | None, outputs: Outputs) -> Run | StagedRun:
        """What remains to be carried out."""
        if self.stages is not None:
            return StagedRun(
                self.scene, self.stages, start=self.start, first=self.first, method=method, outputs=outputs
            )
        return Run(self.scene, self.t_end, method=method, outputs=outputs, start=self.start, model=self.model)


class OutOfTime(Exception):
    """The time granted to a run is over."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Timed:
    """The quickest of equal runs: least wall time and processor time of the loop, s."""

    run: Run | StagedRun
    wall_s: float
    cpu_s: float
    stopped: OutOfTime | SimulationError | None = None

    @property
    def stats(self) -> Mapping[str, Any]:
        """Formulation, simulated time, steps, evaluations and so on."""
        return self.run.stats() if isinstance(self.run, Run) else self.run.result().stats

    def result(self) -> Result:
        """What came of it; what stopped it is raised."""
        if self.stopped is not None:
            raise self.stopped
        return self.run.result()


def timed(
    case: Case,
    method: Method,
    channels: Iterable[str] | None,
    *,
    repeats: int = 1,
    long_s: float = np.inf,
    limit_s: float | None = None,
) -> Timed:
    """Run a case; preparing it does not count.

    Parameters
    ----------
    channels : To record, where the scene has them; None: its default ones.
    repeats : Equal runs; the quickest counts.
    long_s : Wall time from which on one run tells the cost, s.
    limit_s : Processor time granted to each, s, so that what else the machine does decides nothing. Of a lift
        in stages it is looked at between them.
    """
    if channels is not None:
        wanted = list(dict.fromkeys(channels))
        known = set(offered_channels(case.model)) - missing_names(case.scene, wanted).keys()
        channels = [name for name in wanted if name in known]
    outputs = Outputs(dt_out=case.dt_out, channels=channels)
    wall = cpu = np.inf
    for _ in range(repeats):
        run = case.begun(method, outputs)
        clock, begun = time.perf_counter(), time.thread_time()
        stopped = _carried_out(run, limit_s)
        cpu, wall = min(cpu, time.thread_time() - begun), min(wall, time.perf_counter() - clock)
        if stopped is not None or wall > long_s:
            break
    return Timed(run=run, wall_s=wall, cpu_s=cpu, stopped=stopped)


def _carried_out(run: Run | StagedRun, limit_s: float | None) -> OutOfTime | SimulationError | None:
    """Step it to its end; what stopped it before."""
    deadline = np.inf if limit_s is None else time.process_time() + limit_s

    def ask(_: float = 0.0) -> None:
        if time.process_time() > deadline:
            raise OutOfTime(f"granted {limit_s:g} s of processor time")

    try:
        if isinstance(run, Run):
            run.advance(run.t_end, ask)
        else:
            while run.advance():
                ask()
    except (OutOfTime, SimulationError) as stopped:
        return stopped
    if run.interrupted:
        raise KeyboardInterrupt
    return None
