"""What an accuracy is asked of, and how to run it: one run, or a lift in stages."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from seacrane.accuracy.expected import SCALE, expected_error, unit_error
from seacrane.accuracy.matching import curve_apart, extremes_apart, matched
from seacrane.accuracy.quantities import Quantity, compare, limits_of, quantities_of
from seacrane.analysis.linearise import fastest_mode
from seacrane.description.loads import any_stiff
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.run.advance import finished
from seacrane.run.run import Run
from seacrane.run.staged_run import StagedRun
from seacrane.run.start import start_state
from seacrane.validity.after_run import require_finite

if TYPE_CHECKING:
    from seacrane.accuracy.matching import Matching
    from seacrane.result import Result
    from seacrane.run.method import Method
    from seacrane.run.outputs import Outputs
    from seacrane.run.stage import Stage
    from seacrane.run.start import Start
    from seacrane.scene.scene import Scene

EVENT_TIMES = "event_times"  # a quantity: the largest shift of an event, s
BESIDE = 1.5  # the error of one of two methods that are as good as each other, over their difference
STABLE = 3.0  # steps of an explicit method times the fastest mode


@dataclass(frozen=True, kw_only=True)
class Difference:
    """Of two runs: by quantity, and what differs in their courses; nothing where they took one."""

    by_name: Mapping[str, float]
    course: str = ""


@dataclass(frozen=True, kw_only=True)
class Case:
    """What is asked for, and how to run it.

    Attributes
    ----------
    limits : By quantity; the times of events have one even where none is asked for, which is infinite.
    run : A scene, as it is or with other waves, by a method.
    explicit_steps : That the fastest mode asks of an explicit method.
    warn : Tells what the last run left of its range, where that was not told as it ended.
    staged : Whether it is a lift in stages, whose curves are compared at equal phase.
    """

    scene: Scene
    quantities: Mapping[str, Quantity]
    limits: Mapping[str, float]
    run: Callable[[Scene, Method], Result]
    explicit_steps: float
    warn: Callable[[], None]
    staged: bool = False

    def difference(self, one: Result, other: Result) -> Difference:
        """Of two runs, the first of which says where outputs are."""
        if not self.staged and EVENT_TIMES not in self.limits:
            named = self.quantities.items()
            return Difference(by_name={n: compare(q.values(one), q.values(other)).largest for n, q in named})
        matching = matched(one, other)
        apart = {
            name: self._apart(quantity, one, other, matching) for name, quantity in self.quantities.items()
        }
        return Difference(by_name=apart | {EVENT_TIMES: matching.shift}, course=matching.course)

    def _apart(self, quantity: Quantity, one: Result, other: Result, matching: Matching) -> float:
        values, others = quantity.values(one), quantity.values(other)
        if quantity.of_numbers is not None or not self.staged:
            return compare(values, others).largest
        if matching.course:
            return extremes_apart(values, others)
        return curve_apart(one.time, values, other.time, others, matching)

    def motions(self, result: Result) -> dict[str, float]:
        """Largest distance of each quantity from its start."""
        found = {name: quantity.motion(result) for name, quantity in self.quantities.items()}
        return found | {EVENT_TIMES: float(result.time[-1] - result.time[0])}

    def excess(self, errors: Mapping[str, float]) -> float:
        """Of the errors over their limits the largest."""
        return max(errors[name] / limit for name, limit in self.limits.items())

    def is_curve(self, name: str) -> bool:
        """Whether a quantity is one; extremes and times are not."""
        return name != EVENT_TIMES and self.quantities[name].of_numbers is None

    def over_difference(self, name: str) -> float:
        """The error of a quantity at most, over its difference from a looser run."""
        return BESIDE if self.staged or not self.is_curve(name) else 1.0

    def unit(self, name: str) -> str:
        """Of a quantity."""
        return "s" if name == EVENT_TIMES else self.quantities[name].unit

    def scale(self, name: str) -> float:
        """Of the errors of a quantity, in its unit."""
        return SCALE["s"] if name == EVENT_TIMES else unit_error(self.scene, self.quantities[name])


@dataclass(frozen=True, kw_only=True)
class Done:
    """A finished run and its method."""

    method: Method
    result: Result

    @property
    def expected(self) -> float:
        """Its expected error over the scale of a quantity."""
        return expected_error(self.method)

    @property
    def tolerance(self) -> float:
        return self.method.used_rtol


def case_of_run(
    scene: Scene, t_end: float, accuracy: Any, *, outputs: Outputs, start: Start, progress: bool
) -> Case:
    """Of one run; SceneError for an accuracy that is none."""
    begin, model = start_state(scene, start), scene.compile()
    measured, limits = _asked(scene, accuracy, model)
    recorded = _recording(outputs, measured)

    def run(changed: Scene, chosen: Method) -> Result:
        compiled = model if changed is scene else None
        one = Run(changed, t_end, method=chosen, outputs=recorded, start=begin, model=compiled)
        return require_finite(finished(one, progress=progress))

    steps = _explicit_steps(scene, model, t_end)
    return Case(
        scene=scene, quantities=measured, limits=limits, run=run, explicit_steps=steps, warn=lambda: None
    )


def case_of_stages(
    scene: Scene, stages: Sequence[Stage], accuracy: Any, *, outputs: Outputs, start: Start, first: str | None
) -> Case:
    """Of a lift in stages; SceneError for an accuracy that is none, or stages that do not fit."""
    measured, limits = _asked(scene, accuracy, None)
    recorded = _recording(outputs, measured)
    given: dict[str, Any] = {"start": start, "first": first, "outputs": recorded}
    lifts = [StagedRun(scene, stages, **given)]  # warns of the description
    model = lifts[0].model

    def run(changed: Scene, chosen: Method) -> Result:
        with silently():
            lifts[:] = [StagedRun(changed, stages, method=chosen, **given)]
            while lifts[0].advance():
                pass
            return require_finite(lifts[0].result())

    longest = sum(one.duration or one.maximum_duration or 0.0 for one in stages)
    return Case(
        scene=scene, quantities=measured, limits={EVENT_TIMES: math.inf, **limits}, run=run,
        explicit_steps=_explicit_steps(scene, model, longest), warn=lambda: lifts[0].warn(), staged=True,
    )  # fmt: skip


def _asked(scene: Scene, accuracy: Any, model: Any) -> tuple[dict[str, Quantity], dict[str, float]]:
    """What is measured, and the limits."""
    if not isinstance(accuracy, Mapping):
        raise SceneError(f"accuracy is {accuracy!r}; give a mapping such as {{'payload_position': 0.01}}")
    names = [name for name in accuracy if name != EVENT_TIMES]
    measured = quantities_of(scene, model, names) if names else {}
    return measured, limits_of([*measured, EVENT_TIMES], accuracy)


def _recording(outputs: Outputs, measured: Mapping[str, Quantity]) -> Outputs:
    """With the channels that errors are told of."""
    needed = {channel for quantity in measured.values() for channel in quantity.channels}
    asked = outputs.channels
    return outputs if asked is None else replace(outputs, channels=sorted({*asked, *needed}))


def _explicit_steps(scene: Scene, model: Any, span: float) -> float:
    return (fastest_mode(model) or 0.0) * span / STABLE if any_stiff(scene.loads) else 0.0
