"""Runs of one stage, to its end: found between two outputs, then located in time."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
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
    """The runs of one stage.

    Attributes
    ----------
    scene, model, method, outputs
        What is stepped, how, and what is recorded, the channels of conditions among it.
    first : Time from which outputs are counted, s.
    calls : Of controllers.
    began, done : callables
        Told of each run that begins, and of each that is part of the result.
    """

    scene: Scene
    model: _core.Model
    method: Method
    outputs: Outputs
    first: float
    interrupts: Interrupts
    calls: Calls
    began: Callable[[Run], None]
    done: Callable[[Run], None]
    first_run: Run | None = None

    def run(self, start: _core.State, t_end: float, capacity: int | None = None) -> Run:
        """A run of the stage, not advanced yet; what its description warns of is told once."""
        if self.first_run is not None:
            with silently():
                return self.first_run.from_there(start, t_end, capacity)
        self.first_run = Run(
            self.scene, t_end, method=self.method, outputs=self.outputs, start=start,
            outputs_from=self.first, model=self.model, capacity=capacity,
        )  # fmt: skip
        return self.first_run

    def taken(self, start: _core.State, t_end: float) -> Run:
        """A run advanced to its end, and part of the result."""
        run = self.run(start, t_end)
        self.began(run)
        drive(run, self.calls, self.interrupts)
        self.done(run)
        return run

    def stand(self, start: _core.State) -> None:
        """The state itself as part of the result."""
        run = self.run(start, start.time)
        self.began(run)
        self.done(run)

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
    if stage.duration is not None:
        course.calls.begin(start.time, replayed=False)
        run = course.run(start, start.time + stage.duration)
        course.began(run)
        yield run
        drive(run, course.calls, course.interrupts)
        course.done(run)
        return "" if run.interrupted else "duration"
    assert stage.maximum_duration is not None
    end, state = start.time + stage.maximum_duration, start
    course.calls.begin(start.time, replayed=True)
    left = _left(course, start, end, stage.conditions)
    if isinstance(left, str):
        return left
    while True:
        stop = min(_next_look(course, state.time), end)
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
        if stop >= end:
            raise SimulationError(
                f"{stage.title}: is not over after its maximum_duration of {stage.maximum_duration:g} s, "
                f"at t = {end:.6g} s: it waits for {_waits_for(stage, run)}. "
                "Command what leads there, correct the condition, or allow longer"
            )
        state = run.state
        course.calls.begin(state.time, replayed=True)


def _next_look(course: Course, now: float) -> float:
    """The output that is so many outputs away, s."""
    dt = course.outputs.dt_out
    return float(course.first + dt * (np.floor((now - course.first) / dt + 1e-6) + LOOK))


def _left(
    course: Course, start: _core.State, end: float, conditions: tuple[Condition, ...]
) -> set[Condition] | str:
    """Conditions at whose bound a stage begins, and which it leaves at once; or which one is met already.

    A stage that ended as a contact touched begins where that gap is zero to its last digits. What counts is
    where it goes from there.
    """
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
    asked = [(one, max(start, since.get(one, start))) for one in conditions]
    found = (_found(run, *one) or _found_now(run, *one) for one in asked)
    return [hit for hit in found if hit is not None]


def _found_now(run: Run, condition: Condition, start: float) -> _Hit | None:
    """A condition that is met between the last output and now."""
    now = float(run.core.time)
    if isinstance(condition, Contact) or now <= start or excess_now(run, condition) < 0.0:
        return None
    times = run.core.channels()["time"]
    return _Hit(condition, float(max([start, *times[times < now]])), now)


def _found(run: Run, condition: Condition, start: float) -> _Hit | None:
    """Where a run first met a condition: between two of its outputs, or at an event."""
    if isinstance(condition, Contact):
        kind = "contact" if condition.holds else "release"
        names = (condition.limit, f"{condition.limit}.minimum", f"{condition.limit}.maximum")
        times = [event.time for event in run.events() if event.kind == kind and event.name in names]
        return _Hit(condition, times[0], times[0]) if times else None
    arrays = run.core.channels()
    time = arrays["time"]
    met = np.flatnonzero(condition.excess(condition.series(run, run.named(arrays))) >= 0.0)
    met = met[time[met] > start]
    if not met.size:
        return None
    at = int(met[0])
    return _Hit(condition, float(max(start, time[at - 1] if at else start)), float(time[at]))


def _located(course: Course, state: _core.State, first: _Hit, hits: list[_Hit]) -> str:
    """Run to the instant at which the first of the conditions is met."""
    near = [hit for hit in hits if hit.after <= first.by]
    levels = [hit for hit in near if isinstance(hit.condition, Level)]
    after = min((hit.after for hit in levels), default=state.time)
    lead = state if after <= state.time + MOMENT else course.tried(state, after).state
    times = [(_crossing(course, lead, hit), hit) for hit in levels]
    times += [(hit.by, hit) for hit in near if isinstance(hit.condition, Contact)]
    time, hit = min(times, key=lambda one: one[0])
    if isinstance(hit.condition, Contact):
        return _at_contact(course, state, time, hit.condition)
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


def _at_contact(course: Course, state: _core.State, time: float, condition: Contact) -> str:
    """Run to just after an event of a limit: another last step may see it a little later."""
    wait = CONTACT_WAITS[-1]
    for one in CONTACT_WAITS:
        if excess_now(course.tried(state, time + one), condition) >= 0.0:
            wait = one
            break
    course.taken(state, time + wait)
    return condition.text


def _waits_for(stage: Stage, run: Run) -> str:
    """The conditions of a stage, and how they stand."""
    said = []
    for condition in stage.conditions:
        now = "not yet"
        if isinstance(condition, Level):
            measured = run.named(run.core.snapshot())
            now = f"it is {float(condition.series(run, measured)[0]):.6g}"
        said.append(f"{condition.text} ({now})")
    return " or ".join(said)
