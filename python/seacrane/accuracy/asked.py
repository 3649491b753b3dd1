"""What an accuracy is asked of, and how far two runs are apart: stages by matched events, at equal phase."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.accuracy.case import Case
from seacrane.accuracy.expected import unit_error
from seacrane.accuracy.quantities import Quantity, channels_of, compare, limits_of, quantities_of
from seacrane.analysis.after_run import require_finite
from seacrane.analysis.linearise import fastest_mode
from seacrane.arrays import Array
from seacrane.description.loads import any_stiff
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.run.advance import finished
from seacrane.run.method import start_state
from seacrane.run.run import Run
from seacrane.run.staged_run import StagedRun

if TYPE_CHECKING:
    from seacrane.result import Result
    from seacrane.run.method import Method
    from seacrane.run.outputs import Outputs
    from seacrane.scene.scene import Scene

EVENT_TIMES = "event_times"  # a quantity: the largest shift of an event, s
BESIDE = 1.5  # the error of one of two methods that are as good as each other, over their difference
STABLE = 3.0  # steps of an explicit method times the fastest mode
OF_EVENTS = Quantity(
    name=EVENT_TIMES, unit="s", channels=(), of_numbers=lambda result: float(np.ptp(result.time)),
    values=lambda result: np.array([event.time for event in result.events]).reshape(1, -1, 1),
)  # fmt: skip
Key = tuple[str, str]  # a kind of event and its name
BY_FRICTION = ("slip", "stick")  # of a load that stands: rounding says how often, and no course hangs on it
APART = 1e-9  # s: marks nearer than that are one


@dataclass(frozen=True, kw_only=True)
class Difference:
    """Of two runs: by quantity, and what differs in their courses; nothing where they took one."""

    by_name: Mapping[str, float]
    course: str = ""


@dataclass(frozen=True, kw_only=True)
class Asked:
    """What is asked for, and how to run it.

    Attributes
    ----------
    case : A scene run to a time, or a lift in stages, whose curves are compared at equal phase.
    outputs : What is recorded, with the channels that errors are told of.
    limits : By quantity; the times of events have one even where none is asked for, which is infinite.
    explicit_steps : That the fastest mode asks of an explicit method.
    """

    case: Case
    outputs: Outputs
    quantities: Mapping[str, Quantity]
    limits: Mapping[str, float]
    explicit_steps: float
    progress: bool = False
    _lifts: list[StagedRun] = field(default_factory=list, init=False)

    @property
    def scene(self) -> Scene:
        return self.case.scene

    @property
    def staged(self) -> bool:
        return self.case.stages is not None

    def run(self, method: Method, scene: Scene | None = None) -> Result:
        """By a method; of the scene as it is or with other waves."""
        case = self.case if scene is None else replace(self.case, scene=scene, compiled=None)
        if not self.staged:
            one = case.begun(method, self.outputs)
            assert isinstance(one, Run)
            return require_finite(finished(one, progress=self.progress))
        with silently():
            lift = case.begun(method, self.outputs)
            assert isinstance(lift, StagedRun)
            self._lifts[:] = [lift]
            while lift.advance():
                pass
            return require_finite(lift.result())

    def warn(self) -> None:
        """Tell what the last lift in stages left of its range; a run tells it as it ends."""
        for lift in self._lifts:
            lift.warn()

    def difference(self, one: Result, other: Result) -> Difference:
        """Of two runs, the first of which says where outputs are."""
        if not self.staged and EVENT_TIMES not in self.limits:
            named = self.quantities.items()
            return Difference(by_name={n: compare(q.values(one), q.values(other)).largest for n, q in named})
        matching, apart = matched(one, other), {}
        for name, quantity in self.quantities.items():
            values, others = quantity.values(one), quantity.values(other)
            if name == EVENT_TIMES:
                apart[name] = matching.shift
            elif quantity.of_numbers is not None or not self.staged:
                apart[name] = compare(values, others).largest
            elif matching.course:
                apart[name] = extremes_apart(values, others)
            else:
                apart[name] = curve_apart(one.time, values, other.time, others, matching)
        return Difference(by_name=apart, course=matching.course)

    def motions(self, result: Result) -> dict[str, float]:
        """Largest distance of each quantity from its start."""
        return {name: quantity.motion(result) for name, quantity in self.quantities.items()}

    def excess(self, errors: Mapping[str, float]) -> float:
        """Of the errors over their limits the largest."""
        return max(errors[name] / limit for name, limit in self.limits.items())

    def is_curve(self, name: str) -> bool:
        """Whether a quantity is one; extremes and times are not."""
        return self.quantities[name].of_numbers is None

    def scale(self, name: str) -> float:
        """Of the errors of a quantity, in its unit."""
        return unit_error(self.scene, self.quantities[name])


def asked(case: Case, accuracy: Any, outputs: Outputs, *, progress: bool = False) -> Asked:
    """What is asked of a case; SceneError for an accuracy that is none, or stages that do not fit."""
    if not isinstance(accuracy, Mapping):
        raise SceneError(f"accuracy is {accuracy!r}; give a mapping such as {{'payload_position': 0.01}}")
    stages = case.stages
    if stages is None:
        case = replace(case, start=start_state(case.scene, case.start), compiled=case.model)
    names = [name for name in accuracy if name != EVENT_TIMES]
    known = case.model if stages is None else None
    measured = quantities_of(case.scene, known, names) if names else {}
    limits = limits_of([*measured, EVENT_TIMES], accuracy)
    if outputs.channels is not None:
        outputs = replace(outputs, channels=sorted({*outputs.channels, *channels_of(measured)}))
    if stages is None:
        model, span = case.model, case.t_end
    else:
        model = case.begun(None, outputs).model  # warns of the description
        span = sum(one.duration or one.maximum_duration or 0.0 for one in stages)
        limits = {EVENT_TIMES: math.inf, **limits}
    if EVENT_TIMES in limits:
        measured[EVENT_TIMES] = OF_EVENTS
    steps = (fastest_mode(model) or 0.0) * span / STABLE if any_stiff(case.scene.loads) else 0.0
    return Asked(
        case=case, outputs=outputs, quantities=measured, limits=limits, explicit_steps=steps,
        progress=progress,
    )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Matching:
    """Times of stages' ends and of events that are in both of two runs, ascending in either, s."""

    one: Array
    other: Array
    course: str  # what one run has more often than the other; nothing where both took one course
    shift: float  # largest distance in time of what is matched, s


def matched(one: Result, other: Result) -> Matching:
    """Each event with that of the same kind, name and place in the row of these."""
    left, right = _by_key(one), _by_key(other)
    pairs = list(zip(_bounds(one), _bounds(other), strict=False))
    course = ""
    for key in sorted({*left, *right}):
        mine, its = left.get(key, []), right.get(key, [])
        if len(mine) == len(its):
            pairs += zip(mine, its, strict=True)
        elif not course:
            course = f"{key[0]} of {key[1]!r} {len(mine)} times in one run, {len(its)} in another"
    pairs.sort()
    shift = max(abs(a - b) for a, b in pairs)
    kept = pairs[:1]
    for a, b in pairs[1:]:
        if a > kept[-1][0] + APART and b > kept[-1][1] + APART:
            kept.append((a, b))
    a, b = np.array(kept).T
    return Matching(one=a, other=b, course=course, shift=float(shift))


def curve_apart(
    time: Array, values: Array, other_time: Array, other_values: Array, matching: Matching
) -> float:
    """Largest distance of a curve (n, items, parts) from another's.

    At every output the other is taken at that time, and at that phase between two matched events; the nearer
    one counts. So what a shift in time alone makes of a jump is no distance.
    """
    segment = _segments(matching.one, time)
    own, its = np.diff(matching.one)[segment], np.diff(matching.other)[segment]
    phase = matching.other[segment] + (time - matching.one[segment]) * its / own
    there = _inside(other_time, other_values, matching.other, phase, segment)
    then = _inside(other_time, other_values, matching.other, time, _segments(matching.other, time))
    distance = np.fmin(_distance(values, there), _distance(values, then))
    return float(np.nanmax(distance, initial=0.0))


def extremes_apart(values: Array, other_values: Array) -> float:
    """Largest distance of the extremes of any component."""
    found = [
        np.abs(reach(values, axis=0, initial=first) - reach(other_values, axis=0, initial=first))
        for reach, first in ((np.fmax.reduce, -np.inf), (np.fmin.reduce, np.inf))
    ]
    return float(np.nanmax([part[np.isfinite(part)].max(initial=0.0) for part in found]))


def _by_key(result: Result) -> dict[Key, list[float]]:
    """Times of the events that make a course; an event that ends a stage may be seen in the next one."""
    found: dict[Key, list[float]] = defaultdict(list)
    for event in result.events:
        if event.kind not in ("stage", *BY_FRICTION):
            found[event.kind, event.name].append(event.time)
    return found


def _bounds(result: Result) -> list[float]:
    """Times at which stages begin, and the last output."""
    begins = [span.start for span in result.stages] or [float(result.time[0])]
    return [*begins, float(result.time[-1])]


def _segments(marks: Array, time: Array) -> NDArray[np.int64]:
    """Between which two marks times are: after the first of them, up to the second."""
    return np.clip(np.searchsorted(marks, time, side="left") - 1, 0, len(marks) - 2)


def _distance(values: Array, other: Array) -> Array:
    """Of the nearest (n, items, parts), over parts: what neither has is no distance."""
    absent = np.isnan(values) & np.isnan(other)
    return np.asarray(np.linalg.norm(np.where(absent, 0.0, values - other), axis=-1))


def _inside(time: Array, values: Array, marks: Array, wanted: Array, segment: NDArray[np.int64]) -> Array:
    """A curve at times, each from outputs between the same two marks alone; NaN where there are none."""
    found = np.full((len(wanted), *values.shape[1:]), np.nan)
    own = _segments(marks, time)
    for place in np.unique(segment):
        asked, here = np.flatnonzero(segment == place), np.flatnonzero(own == place)
        here = here[np.diff(time[here], prepend=-np.inf) > APART]
        if here.size:
            found[asked] = _interpolated(time[here], values[here], wanted[asked])
    return found


def _interpolated(time: Array, values: Array, wanted: Array) -> Array:
    """By cubics with the slopes of parabolas, beyond the ends by straight lines up to one output away."""
    if time.size == 1:
        return np.where((np.abs(wanted - time) <= APART)[:, None, None], values, np.nan)
    slopes = np.gradient(values, time, axis=0)
    at = np.clip(np.searchsorted(time, wanted, side="right") - 1, 0, time.size - 2)
    step = (time[at + 1] - time[at])[:, None, None]
    x = (wanted - time[at])[:, None, None] / step
    inner, beyond = np.clip(x, 0.0, 1.0), x - np.clip(x, 0.0, 1.0)
    h = inner * inner * (3.0 - 2.0 * inner)
    found = (
        (1.0 - h) * values[at]
        + h * values[at + 1]
        + step * inner * (1.0 - inner) * ((1.0 - inner) * slopes[at] - inner * slopes[at + 1])
    )
    found = found + step * beyond * np.where(beyond > 0.0, slopes[at + 1], slopes[at])
    return np.where(np.abs(beyond) <= 1.0, found, np.nan)
