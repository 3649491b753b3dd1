"""Runs of one stage, to its end: found between two outputs, then located in time."""

from __future__ import annotations

from collections.abc import Callable, Collection, Generator, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from seacrane import _core
from seacrane.errors import SimulationError
from seacrane.inputs.caller import silently
from seacrane.run.advance import drive
from seacrane.run.interrupts import Interrupts
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.run.sampled_controller import Calls
from seacrane.run.stage import Condition, Contact, Level, Stage
from seacrane.scene.scene import Scene

LOOK = 50  # outputs between two looks at the conditions
LOCATED = 1e-9  # s
CONTACT_WAITS = (1e-9, 1e-8, 1e-7, 1e-6, 1e-5)  # s, after a limit's event that another step sees elsewhere
MOMENT = 1e-5  # s, in which what a stage begins at the bound of is seen to leave it


@dataclass
class Course:
    """The runs of one stage."""

    scene: Scene
    model: _core.Model
    method: Method
    outputs: Outputs  # the channels of conditions among them
    first: float  # s, from which outputs are counted
    peaks: Collection[str] | None
    interrupts: Interrupts
    calls: Calls
    began: Callable[[Run], None]  # told of each run that begins
    done: Callable[[Run], None]  # and of each that is part of the result
    first_run: Run | None = None

    def run(self, start: _core.State, t_end: float, capacity: int | None = None) -> Run:
        """A run of the stage, not advanced yet; what its description warns of is told once."""
        if self.first_run is not None:
            with silently():
                return self.first_run.from_there(start, t_end, capacity)
        self.first_run = Run(
            self.scene, t_end, method=self.method, outputs=self.outputs, start=start,
            outputs_from=self.first, model=self.model, capacity=capacity, peaks=self.peaks,
        )  # fmt: skip
        return self.first_run

    def taken(self, start: _core.State, t_end: float) -> Run:
        """A run advanced to its end, and part of the result."""
        run = self.run(start, t_end)
        self.began(run)
        drive(run, self.calls, self.interrupts)
        self.done(run)
        return run

    def tried(self, start: _core.State, t_end: float) -> Run:
        """A run advanced to its end, and no part of the result; KeyboardInterrupt by Ctrl-C."""
        run = self.run(start, t_end)
        drive(run, self.calls, self.interrupts)
        if run.interrupted:
            raise KeyboardInterrupt
        return run


def to_its_end(course: Course, stage: Stage, start: _core.State) -> Generator[Run, None, str]:
    """Run a stage from a state; returns what ended it, "" for an interruption.

    Its runs are told before they are stepped: whoever asks may step them beside others, as far as that goes.

    Raises SimulationError for a stage whose conditions are not met within its `maximum_duration`.
    """
    timed, longest = stage.duration is not None, stage.duration or stage.maximum_duration
    assert longest is not None
    end, state = start.time + longest, start
    course.calls.begin(start.time, replayed=not timed)
    left = _left(course, start, end, stage.conditions)
    if isinstance(left, str):
        return left
    while True:
        outputs = np.floor((state.time - course.first) / course.outputs.dt_out + 1e-6) + LOOK
        stop = end if timed else min(float(course.first + course.outputs.dt_out * outputs), end)
        run = course.run(state, stop)
        course.began(run)
        yield run
        look = partial(_hits, run, stage.conditions, {one: start.time + MOMENT for one in left})
        # No controller is called beyond the end of its stage.
        drive(run, course.calls, course.interrupts, halt=look if course.calls.controllers else None)
        found = look()
        if found and not run.interrupted:
            try:
                return _located(course, state, min(found, key=lambda hit: hit.by), found)
            except KeyboardInterrupt:
                return ""
        course.done(run)
        if run.interrupted:
            return ""
        if timed:
            return "duration"
        if stop >= end:
            raise SimulationError(
                f"{stage.title}: is not over after its maximum_duration of {longest:g} s, "
                f"at t = {end:.6g} s: it waits for {_waits_for(stage, run)}. "
                "Command what leads there, correct the condition, or allow longer"
            )
        state = run.state
        course.calls.begin(state.time, replayed=True)


def _left(
    course: Course, start: _core.State, end: float, conditions: tuple[Condition, ...]
) -> set[Condition] | str:
    """Conditions at whose bound a stage begins, and which it leaves at once; or which one is met already.

    A stage that ended as a contact touched begins where that gap is zero to its last digits. What counts is
    where it goes from there.
    """
    if not conditions:
        return set()
    run = course.run(start, end, capacity=1)
    there = [one for one in conditions if excess_now(run, one) >= 0.0]
    if not there:
        return set()
    try:
        later = course.tried(start, min(start.time + MOMENT, end))
    except KeyboardInterrupt:
        return ""
    met = next((one for one in there if excess_now(later, one) >= 0.0), None)
    return set(there) if met is None else f"{met.text} from its start on"


def excess_now(run: Run, condition: Condition) -> float:
    """By how much a condition is met at the present instant; of a limit 1 where it is, else -1."""
    if isinstance(condition, Contact):
        held = {name.removesuffix(".minimum").removesuffix(".maximum") for name in run.state.closed or ()}
        holds = condition.limit in held or condition.limit in (run.state.closed or ())
        return 1.0 if holds == condition.holds else -1.0
    now = run.named(run.core.snapshot())
    return float(condition.excess(condition.series(run, now))[0])


@dataclass(frozen=True)
class _Hit:
    """A condition that is not met yet at one time, and met by another, s."""

    condition: Condition
    after: float
    by: float


def _hits(run: Run, conditions: tuple[Condition, ...], since: Mapping[Condition, float]) -> list[_Hit]:
    """Conditions met by now, in the outputs, at events or at this instant; some from a time on, s."""
    start = float(run.start.time)
    found = (_found(run, one, max(start, since.get(one, start))) for one in conditions)
    return [hit for hit in found if hit is not None]


def _found(run: Run, condition: Condition, start: float) -> _Hit | None:
    """Where a run first met a condition: between two of its outputs, after the last, or at an event."""
    if isinstance(condition, Contact):
        kind = "contact" if condition.holds else "release"
        names = (condition.limit, f"{condition.limit}.minimum", f"{condition.limit}.maximum")
        times = [event.time for event in run.events() if event.kind == kind and event.name in names]
        return _Hit(condition, times[0], times[0]) if times else None
    arrays = run.core.channels()
    time = arrays["time"]
    met = np.flatnonzero(condition.excess(condition.series(run, run.named(arrays))) >= 0.0)
    met = met[time[met] > start]
    if met.size:
        at = int(met[0])
        return _Hit(condition, float(max(start, time[at - 1] if at else start)), float(time[at]))
    now = float(run.core.time)
    if now <= start or excess_now(run, condition) < 0.0:
        return None
    return _Hit(condition, float(max([start, *time[time < now]])), now)


def _located(course: Course, state: _core.State, first: _Hit, hits: list[_Hit]) -> str:
    """Run to the instant at which the first of the conditions is met."""
    near = [hit for hit in hits if hit.after <= first.by]
    levels = [hit for hit in near if isinstance(hit.condition, Level)]
    after = min((hit.after for hit in levels), default=state.time)
    lead = state if after <= state.time + MOMENT else course.tried(state, after).state
    times = [(_crossing(course, lead, hit), hit) for hit in levels]
    times += [(hit.by, hit) for hit in near if isinstance(hit.condition, Contact)]
    time, hit = min(times, key=lambda one: one[0])
    if isinstance(hit.condition, Contact):  # to just after its event: another last step may see it later
        waits = (
            one for one in CONTACT_WAITS if excess_now(course.tried(state, time + one), hit.condition) >= 0.0
        )
        course.taken(state, time + next(waits, CONTACT_WAITS[-1]))
        return hit.condition.text
    if lead is not state:
        lead = course.taken(state, after).state
    course.taken(lead, time)
    return hit.condition.text


def _crossing(course: Course, lead: _core.State, hit: _Hit) -> float:
    """The time at which a channel is at its bound, by Brent's method on runs from a state before it."""
    from scipy.optimize import brentq

    def excess(time: float) -> float:
        return excess_now(
            course.tried(lead, time) if time > lead.time else course.run(lead, time), hit.condition
        )

    if excess(hit.by) <= 0.0:  # an output that touched it
        return hit.by
    if excess(hit.after) >= 0.0:
        return hit.after
    return float(brentq(excess, hit.after, hit.by, xtol=LOCATED, rtol=8.9e-16))


def _waits_for(stage: Stage, run: Run) -> str:
    """The conditions of a stage, and how they stand."""
    said, measured = [], run.named(run.core.snapshot())
    for condition in stage.conditions:
        now = "not yet"
        if isinstance(condition, Level):
            now = f"it is {float(condition.series(run, measured)[0]):.6g}"
        said.append(f"{condition.text} ({now})")
    return " or ".join(said)
