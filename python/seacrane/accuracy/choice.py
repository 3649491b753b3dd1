"""simulate(accuracy=...): one run at the right tolerance, and a cheap one that tells its error.

Errors of two runs of one scene obey the same linearised equations of motion and differ in their local errors
only, so that their ratio hardly depends on the scene (docs/trade.md). The difference of a cheap and a tight
run is the error of the cheap one; times that ratio, it is the error of the tight one, which is returned.

Where loads have stiff states, both would share what the method makes of these. There the error is told by
another method that is as good, and nothing is made of a ratio.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from seacrane.accuracy.asked import BESIDE, Asked, asked
from seacrane.accuracy.case import Case
from seacrane.accuracy.expected import MARGIN, STIFF, TIGHTEST, expected_error, method_for, probe_of
from seacrane.accuracy.model_error import model_errors
from seacrane.analysis.after_run import Finding, tried, warn_of
from seacrane.description.loads import any_stiff
from seacrane.errors import SceneError, SimulationError
from seacrane.inputs.caller import warn_caller
from seacrane.run.method import Method, settled
from seacrane.warnings import AnotherCourseWarning

if TYPE_CHECKING:
    from seacrane.description.waves import Waves
    from seacrane.result import Result
    from seacrane.run.outputs import Outputs
    from seacrane.run.sampled_controller import SampledController

MOST_STEPS = 1e6  # that the fastest mode may ask of an explicit one of them
OF_STAGES = 3.0  # times the margin, of lifts whose stages end where a condition is met, inside a step
CHOSEN = ("integrator", "rtol", "dt", "spectral_radius")
PESSIMISM = 1.5  # further, on the error expected before any run
STEP = 10.0  # to a tighter tolerance, or a looser one to compare with, where errors do not tell how far
COARSE = 0.1  # of the motion: a difference above it is no error that linearised equations describe
ROUNDING = 1e-10  # tolerance below which rounding may set the error, and only runs of like tolerance tell
MOST_COURSES = 3  # runs, from which on another course is taken for what the lift does
OTHER_COURSE = "another course"
CUT_SHORT = 0.1  # restarts over steps from which on the tolerance does not set the error of a run
SINGULAR = "a singular position of the mechanism, where constraints depend on each other: keep away from it"
AMPLIFIED = 1e4  # error over the expected one from which the motion itself, not rounding, sets the limit


@dataclass(frozen=True, kw_only=True)
class Done:
    """A finished run and its method."""

    method: Method
    result: Result

    @property
    def expected(self) -> float:
        """Its expected error over the scale of a quantity."""
        return expected_error(self.method)


def run_to_accuracy(
    case: Case,
    accuracy: Any,
    *,
    method: Method | None,
    outputs: Outputs | None,
    shorthand: Mapping[str, Any],
    controllers: Sequence[SampledController] = (),
    progress: bool = False,
) -> Result:
    """The run of a case whose estimated error meets all limits.

    As of `simulate`; the integrator and its tolerance are chosen here, and no controllers can be. Unless it
    was interrupted its stats have `error_estimate_<quantity>`, `accuracy_<quantity>`, and of all runs
    `accuracy_runs`, `accuracy_wall_s` and `accuracy_evaluations`.

    Raises SceneError for an accuracy that is no positive number, an unknown quantity, a setting that is
    chosen here, or a limit that cannot be reached.
    """
    refuse_what_is_chosen(method, shorthand, controllers)
    kept, outputs = settled(method, outputs, shorthand)
    wanted = asked(case, accuracy, outputs, progress=progress)
    result = _converged(wanted, kept)
    wanted.warn()
    if outputs.channels is None:
        return result
    named = {name: result.channels[name] for name in outputs.channels if name in result.channels}
    return replace(result, channels=named)


def error_of(case: Asked, method: Method) -> tuple[dict[str, float], int, int]:
    """Estimated errors of a run by a method that `run_to_accuracy` chose for another scene, by quantity.

    Then evaluations of the run, and of the cheap one that tells it. Raises SceneError as `run_to_accuracy`.
    """
    done = [_beside(case, method), _run(case, method)]
    if any(one.result.interrupted for one in done):
        raise KeyboardInterrupt
    other, run = (int(one.result.stats["evaluations"]) for one in done)
    return _estimate(case, done).errors, run, other


def refuse_what_is_chosen(
    method: Method | None, shorthand: Mapping[str, Any], controllers: Sequence[SampledController]
) -> None:
    """SceneError for an integrator, a tolerance or a step beside an accuracy, and for controllers."""
    given = {word: shorthand[word] for word in CHOSEN if shorthand.get(word) is not None}
    if method is not None:
        chosen = {name: getattr(method, name) for name in CHOSEN}
        given |= {name: value for name, value in chosen.items() if value != getattr(Method(), name)}
    if given:
        named = ", ".join(f"{name}={value!r}" for name, value in given.items())
        raise SceneError(
            f"accuracy chooses integrator, rtol and dt itself, and {named} is given too: leave one out"
        )
    if controllers:
        raise SceneError(
            "accuracy runs the scene more than once, which a sampled controller may not allow: leave out "
            "controllers or accuracy"
        )


def _converged(case: Asked, kept: Method) -> Result:
    """Runs until the estimate of the last one meets the limits; `kept` holds what is not chosen here."""
    smallest = min(limit / case.scale(name) for name, limit in case.limits.items())
    met = method_for(smallest / (MARGIN * PESSIMISM), stiff=any_stiff(case.scene.loads))  # in measured trades
    method = _with_setting(kept, met)
    done = [_beside(case, method)]
    while not done[-1].result.interrupted:
        done.append(_run(case, method))
        if done[-1].result.interrupted:
            break
        told = _estimate(case, done)
        settled_course = not told.course or len(done) > MOST_COURSES
        if case.excess(told.errors) <= 1.0 and settled_course:
            return _with_estimate(case, done, told)
        if method.used_rtol <= TIGHTEST:
            raise SceneError(
                _unreachable(case, told.errors, told.course and f"{OTHER_COURSE}: {told.course}")
            )
        method = _tighter(method, case.excess(told.errors) if told.known else STEP)
        if method.integrator == STIFF:
            done.append(_beside(case, method))
        elif method.used_rtol < ROUNDING and done[-1].method.used_rtol > STEP * 1.1 * method.used_rtol:
            done.append(_run(case, _looser(method)))
    return done[-1].result


def _run(case: Asked, method: Method) -> Done:
    return Done(method=method, result=case.run(method))


def _beside(case: Asked, method: Method) -> Done:
    """The run that tells the error of a method; of a lift that it does not carry out one that is nearer."""
    if method.used_rtol <= ROUNDING:
        return _run(case, _looser(method))
    try:
        stiffest = method.integrator == STIFF and case.explicit_steps > MOST_STEPS
        return _run(case, probe_of(method, stiffest=stiffest))
    except (SceneError, SimulationError):
        if not case.staged:
            raise
        return _run(case, _looser(method))


def _with_setting(method: Method, chosen: Method) -> Method:
    return replace(method, integrator=chosen.integrator, rtol=chosen.rtol)


def _looser(method: Method) -> Method:
    return replace(method, rtol=STEP * method.used_rtol)


def _tighter(method: Method, factor: float) -> Method:
    """A method whose error is smaller by that factor at least."""
    error = expected_error(method)
    found = _with_setting(method, method_for(error / factor, stiff=method.integrator == STIFF))
    if expected_error(found) > 0.6 * error:
        found = replace(method, rtol=method.used_rtol / math.sqrt(STEP))
    return replace(found, rtol=max(found.used_rtol, TIGHTEST))


@dataclass(frozen=True, kw_only=True)
class _Estimate:
    """Errors of the last run; whether they tell which setting would do; how courses differ, if they do."""

    errors: dict[str, float]
    known: bool
    course: str


def _estimate(case: Asked, done: Sequence[Done]) -> _Estimate:
    """Estimated errors of the last run.

    Every looser run has its say: two errors alone may be alike by chance where a motion amplifies them. But
    where one took the same course, those that took another have none. Extremes, and times of events, are
    found inside steps, where errors obey another order: of these the whole difference counts.
    """
    tight = done[-1]
    motions = case.motions(tight.result)
    if tight.method.integrator == STIFF:
        apart = case.difference(tight.result, done[-2].result)
        linear_all = all(d <= COARSE * motions[name] for name, d in apart.by_name.items())
        return _Estimate(
            errors={name: BESIDE * d for name, d in apart.by_name.items()},
            known=linear_all and not apart.course and tight.method.used_rtol > ROUNDING, course=apart.course,
        )  # fmt: skip
    looser = [one for one in done[:-1] if one.expected > tight.expected]
    pairs = [(one, case.difference(tight.result, one.result)) for one in looser]
    pairs = [(one, apart) for one, apart in pairs if not apart.course] or pairs
    ratios = [tight.expected / one.expected for one, _ in pairs]
    margin = OF_STAGES * MARGIN if case.staged else MARGIN
    factors = [margin * ratio / (1.0 - ratio) for ratio in ratios]
    near, last = pairs[-1]
    errors = {
        name: max(f * apart.by_name[name] for f, (_, apart) in zip(factors, pairs, strict=True))
        for name in last.by_name
    }
    linear = {
        name: not last.course and case.is_curve(name) and d <= COARSE * motions[name]
        for name, d in last.by_name.items()
    }
    by_tolerance = not (_cut_short(near.result) or _cut_short(tight.result))
    whole = {name: d for name, d in last.by_name.items() if not (linear[name] and by_tolerance)}
    for name, d in whole.items():  # of curves as much as it, of others as of two methods that are as good
        over = 1.0 if case.is_curve(name) and not case.staged else BESIDE
        errors[name] = max(errors[name], over * d)
    known = all(linear.values()) and by_tolerance and tight.method.used_rtol > ROUNDING
    return _Estimate(errors=errors, known=known, course=last.course)


def _cut_short(result: Result) -> bool:
    """Whether hard stops, not the tolerance, set the length of many steps."""
    return int(result.stats["restarts"]) > CUT_SHORT * int(result.stats["steps"])


def _with_estimate(case: Asked, done: Sequence[Done], told: _Estimate) -> Result:
    """The last run, with what differences of tolerance do not tell added to its errors."""
    last, errors = done[-1], told.errors
    runs = [one.result for one in done]
    if last.result.stats.get("rank_changed"):
        # The same run in the other coordinates: at a singular position both leave combinations of rows out,
        # of rows of their own, and what that does to the motion no tolerance changes.
        form = "redundant" if last.result.stats["formulation"] == "recursive" else "recursive"
        other = case.run(replace(last.method, formulation=form))
        if other.interrupted:
            return other
        apart = case.difference(last.result, other).by_name
        unexplained = {name: max(apart[name] - error, 0.0) for name, error in errors.items()}
        errors = _added(errors, unexplained, MARGIN)
        runs.append(other)
        if case.excess(errors) > 1.0:
            raise SceneError(_unreachable(case, errors, SINGULAR))
    waves = case.scene.waves
    if waves is not None and _table_may_show(case, waves, last.result):
        exact = case.run(last.method, case.scene.copy(waves=replace(waves, evaluation="exact")))
        if exact.interrupted:
            return exact
        errors = _added(errors, case.difference(last.result, exact).by_name, 1.0)
        runs.append(exact)
        if case.excess(errors) > 1.0:
            bound = f"the wave table, whose relative_bound is {waves.relative_bound:g}: tighten it"
            raise SceneError(_unreachable(case, errors, bound))
    stats: dict[str, Any] = {**last.result.stats, "accuracy_runs": len(runs)}
    stats["accuracy_wall_s"] = sum(float(result.stats["wall_s"]) for result in runs)
    stats["accuracy_evaluations"] = sum(int(result.stats["evaluations"]) for result in runs)
    for name, limit in case.limits.items():
        stats |= {f"accuracy_{name}": limit} if math.isfinite(limit) else {}
        stats[f"error_estimate_{name}"] = errors[name]
    if told.course:
        stats["accuracy_course"] = (
            f"{OTHER_COURSE}: {told.course}; errors of curves are those of their extremes"
        )
        warn_caller(f"accuracy: a tighter run takes {stats['accuracy_course']}", AnotherCourseWarning)
    return replace(last.result, stats=stats | _by_model(case, last.result))


def _by_model(case: Asked, result: Result) -> dict[str, float]:
    """What the fit of the memory leaves, of a run whose scene stays what it is."""
    if case.staged:
        return {}
    failed: list[Finding] = []
    nothing: dict[str, float] = {}
    found = tried(
        "estimating the error of the model",
        lambda: model_errors(case.scene, result.time, case.limits), nothing, failed,
    )  # fmt: skip
    warn_of(failed)
    return {f"model_error_{name}": error for name, error in found.items()}


def _added(errors: Mapping[str, float], more: Mapping[str, float], factor: float) -> dict[str, float]:
    return {name: error + factor * more[name] for name, error in errors.items()}


def _table_may_show(case: Asked, waves: Waves, result: Result) -> bool:
    """Whether the bound of the wave table, as a part of the motion, exceeds a limit."""
    if waves.evaluation != "table" or not waves.has_tables():
        return False
    motions = case.motions(result)
    return any(waves.relative_bound * motions[n] > limit for n, limit in case.limits.items())


def _unreachable(case: Asked, errors: Mapping[str, float], term: str) -> str:
    name = max(case.limits, key=lambda quantity: errors[quantity] / case.limits[quantity])
    expected, unit = expected_error(method_for(0.0)) * case.scale(name), case.quantities[name].unit
    if not term and errors[name] > AMPLIFIED * expected:
        term = (
            "the motion itself, which amplifies the smallest differences: ask for statistics, or a shorter "
            "run"
        )
    term = term or f"rounding at the tightest tolerance, {TIGHTEST:g}"
    return (
        f"accuracy: {name} of {case.limits[name]:g} {unit} cannot be reached: the limit is "
        f"{errors[name]:.3g} {unit}, set by {term}"
    )
