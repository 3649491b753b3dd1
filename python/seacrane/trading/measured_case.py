"""Run a case with a method, within a time, and tell what it cost, how it ended and how wrong it is."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.accuracy.quantities import Quantity, compare
from seacrane.errors import SimulationError
from seacrane.inputs.frames import rotation_matrix
from seacrane.result.result import Result
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.run.staged_run import StagedRun
from seacrane.scene.scene import Scene
from seacrane.trading.case import Case
from seacrane.trading.reference import Reference, distance_from_start
from seacrane.trading.row import COMPLETED, NOT_FINITE, REFUSED, SLOW, STOPPED, UNKNOWN, Row

Array = NDArray[np.float64]
Values = Callable[[Result], Mapping[str, Array]]
CHECKS = ("constraint_error", "constraint_error_before_projection", "energy_balance", "absolute_work",
          "quaternion", "velocity", "angular_velocity")  # fmt: skip


class OutOfTime(Exception):
    """The time granted to a run is over."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Timed:
    """The quickest of equal runs: least wall time and processor time of the loop, s."""

    run: Run
    wall_s: float
    cpu_s: float
    stopped: OutOfTime | SimulationError | None = None

    @property
    def simulated_s(self) -> float:
        """How far it came, s."""
        return self.run.core.time - self.run.start.time

    @property
    def counted(self) -> Mapping[str, Any]:
        """Steps, evaluations and so on."""
        return self.run.core.statistics()

    @property
    def formulation(self) -> str:
        """The one that was stepped."""
        return self.run.formulation

    def channels(self) -> Mapping[str, Array]:
        """What was recorded, by name."""
        return self.run.core.channels()

    def result(self) -> Result:
        """What came of it."""
        return self.run.result()


@dataclass(frozen=True, kw_only=True, eq=False)
class TimedStages:
    """The quickest of equal lifts in stages, likewise."""

    staged: StagedRun
    wall_s: float
    cpu_s: float
    stopped: OutOfTime | SimulationError | None = None

    @property
    def simulated_s(self) -> float:
        """How far it came, s."""
        return float(self.result().time[-1])

    @property
    def counted(self) -> Mapping[str, Any]:
        """Steps, evaluations and so on."""
        return self.result().stats

    @property
    def formulation(self) -> str:
        """The one that was stepped."""
        return str(self.result().stats["formulation"])

    def channels(self) -> Mapping[str, Array]:
        """What was recorded, by name."""
        return self.result().channels

    def result(self) -> Result:
        """What came of it."""
        return self.staged.result()


def timed(
    case: Case,
    method: Method,
    channels: Iterable[str] | None,
    *,
    repeats: int = 1,
    long_s: float = np.inf,
    limit_s: float | None = None,
) -> Timed | TimedStages:
    """Run a case; preparing it does not count.

    Parameters
    ----------
    channels : To record, where the scene has them; None: its default ones.
    repeats : Equal runs; the quickest counts.
    long_s : Wall time from which on one run tells the cost, s.
    limit_s : Processor time granted to each, s, so that what else the machine does decides nothing.
    """
    outputs = case.outputs(channels) if channels is not None else replace(case.outputs(()), channels=None)
    if case.stages:
        return _timed_stages(case, method, outputs, repeats=repeats, long_s=long_s, limit_s=limit_s)
    wall = cpu = np.inf
    for _ in range(repeats):
        run = Run(case.scene, case.t_end, method=method, outputs=outputs, start=case.start, model=case.model)
        begun = time.thread_time()
        stopped = _advance(run, limit_s)
        cpu = min(cpu, time.thread_time() - begun)
        wall = min(wall, float(run.core.statistics()["wall_s"]))
        if stopped is not None or wall > long_s:
            break
    return Timed(run=run, wall_s=wall, cpu_s=cpu, stopped=stopped)


def _timed_stages(
    case: Case, method: Method, outputs: Outputs, *, repeats: int, long_s: float, limit_s: float | None
) -> TimedStages:
    """As `timed`, of a lift in stages; the time granted is looked at between them."""
    wall = cpu = np.inf
    for _ in range(repeats):
        staged = StagedRun(case.scene, case.stages, start=case.start, method=method, outputs=outputs)
        clock, begun = time.perf_counter(), time.thread_time()
        stopped = _carry_out(staged, begun, limit_s)
        cpu, wall = min(cpu, time.thread_time() - begun), min(wall, time.perf_counter() - clock)
        if stopped is not None or wall > long_s:
            break
    return TimedStages(staged=staged, wall_s=wall, cpu_s=cpu, stopped=stopped)


def _carry_out(staged: StagedRun, begun: float, limit_s: float | None) -> OutOfTime | SimulationError | None:
    try:
        while staged.advance():
            if limit_s is not None and time.thread_time() - begun > limit_s:
                return OutOfTime(f"granted {limit_s:g} s of processor time")
    except SimulationError as stopped:
        return stopped
    if staged.interrupted:
        raise KeyboardInterrupt
    return None


def _advance(run: Run, limit_s: float | None) -> OutOfTime | SimulationError | None:
    """Step a run to its end; what stopped it before."""
    deadline = np.inf if limit_s is None else time.process_time() + limit_s

    def ask(_: float) -> None:
        if time.process_time() > deadline:
            raise OutOfTime(f"granted {limit_s:g} s of processor time")

    try:
        if not run.advance(run.t_end, ask):
            raise KeyboardInterrupt
    except (OutOfTime, SimulationError) as stopped:
        return stopped
    return None


def measured(
    case: Case,
    method: Method,
    quantities: Mapping[str, Quantity],
    truth: Reference,
    row: Row,
    *,
    values: Values | None = None,
    repeats: int = 1,
    long_s: float = np.inf,
    limit_s: float | None = None,
) -> Row:
    """The row filled in; what stops or refuses the run is its verdict.

    Parameters
    ----------
    case, method, repeats, long_s, limit_s
        As `timed`.
    quantities : mapping of str to Quantity
        What errors are measured in.
    row : Row
        What is known before.
    values : callable, optional
        Values of quantities from a result; default: what the quantities make of it, where they can.
    """
    row = replace(row, uncertainty=truth.uncertainty, motion=truth.motion)
    channels = [*channels_of(quantities), *CHECKS]
    try:
        done = timed(case, method, channels, repeats=repeats, long_s=long_s, limit_s=limit_s)
        row = _with_cost(row, done)
        if done.stopped is not None:
            return row.ended(SLOW if isinstance(done.stopped, OutOfTime) else STOPPED, done.stopped)
        for name, array in done.channels().items():
            if name in channels and not np.isfinite(array).all():
                return row.ended(NOT_FINITE, f"{name} is not finite")
        result = done.result()
        found = (values or values_by(quantities))(result)
    except SimulationError as stopped:  # at the start
        return row.ended(STOPPED, stopped)
    except ValueError as refusal:  # a SceneError, or that of a function of arrays
        return row.ended(REFUSED, refusal)
    return _with_errors(_with_checks(row, case.scene, result), found, truth, quantities)


def channels_of(quantities: Mapping[str, Quantity]) -> list[str]:
    """What the quantities are made of."""
    return list(dict.fromkeys(channel for quantity in quantities.values() for channel in quantity.channels))


def values_by(quantities: Mapping[str, Quantity]) -> Values:
    """Values of the quantities that a result has; one with less physics may lack some."""

    def values(result: Result) -> dict[str, Array]:
        found = {}
        for name, quantity in quantities.items():
            try:
                found[name] = quantity.values(result)
            except (KeyError, ValueError):
                continue
        return found

    return values


def _with_cost(row: Row, done: Timed | TimedStages) -> Row:
    counted = done.counted
    return replace(
        row,
        stepped=done.formulation,
        steps=int(counted["steps"]),
        rejected_steps=int(counted["rejected_steps"]),
        evaluations=int(counted["evaluations"]),
        dense_solves=int(counted["dense_solves"]),
        simulated_s=done.simulated_s,
        wall_s=done.wall_s,
        cpu_s=done.cpu_s,
    )


def _with_checks(row: Row, scene: Scene, result: Result) -> Row:
    def largest(channel: str) -> float:
        return float(result.channels[channel].max()) if channel in result.channels else UNKNOWN

    return replace(
        row,
        drift=largest("constraint_error_before_projection"),
        left=largest("constraint_error"),
        energy=energy_error(scene, result),
    )


def _with_errors(
    row: Row, values: Mapping[str, Array], truth: Reference, quantities: Mapping[str, Quantity]
) -> Row:
    errors = {name: compare(truth.values[name], v) for name, v in values.items() if name in truth.values}
    own = {name: distance_from_start(v) for name, v in values.items() if name not in truth.motion}
    left_out = [name for name in quantities if name not in errors and name in truth.values]
    message = f"has no {', '.join(left_out)}" if left_out else ""
    return replace(row, errors=errors, motion={**truth.motion, **own}).ended(COMPLETED, message)


def energy_error(scene: Scene, result: Result) -> float:
    """Largest balance over the absolute work by the end, or the largest kinetic energy; NaN without them."""
    if not {"energy_balance", "absolute_work"} <= result.channels.keys():
        return UNKNOWN
    bodies = scene.bodies.values()
    mass = np.array([body.mass for body in bodies])
    inertia = np.array([body.inertia for body in bodies])
    velocity, rotation = result["velocity"], rotation_matrix(result["quaternion"])
    spin = np.einsum("nkji,nkj->nki", rotation, result["angular_velocity"])
    kinetic = 0.5 * (
        np.einsum("k,nki,nki->n", mass, velocity, velocity) + np.einsum("kij,nki,nkj->n", inertia, spin, spin)
    )
    size = max(float(result["absolute_work"][-1]), float(kinetic.max()))
    return float(np.abs(result["energy_balance"]).max()) / size if size > 0.0 else UNKNOWN
