"""simulate(accuracy=...): one run at the right tolerance, and a cheap one that tells its error.

Errors of two runs of one scene obey the same linearised equations of motion and differ in their local errors
only, so that their ratio hardly depends on the scene (docs/trade.md). The difference of a cheap and a tight
run is the error of the cheap one; times that ratio, it is the error of the tight one, which is returned.

Where loads have stiff states, both would share what the method makes of these. There the error is told by
another method that is as good, and nothing is made of a ratio.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from seacrane.accuracy.expected import (
    STIFF,
    TIGHTEST,
    expected_error,
    method_for,
    probe_of,
    unit_error,
)
from seacrane.accuracy.model_error import model_errors
from seacrane.accuracy.quantities import Quantity, compare, limits_of, quantities_of
from seacrane.analysis.linearise import fastest_mode
from seacrane.description.loads import any_stiff
from seacrane.errors import SceneError
from seacrane.run.advance import finished
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.run.shorthand import settled
from seacrane.run.start import Start, start_state
from seacrane.validity.after_run import Finding, require_finite, tried
from seacrane.validity.left_range import warn_of

if TYPE_CHECKING:
    from seacrane import _core
    from seacrane.result import Result
    from seacrane.run.sampled_controller import SampledController
    from seacrane.scene.scene import Scene

BESIDE = 1.5  # the error of one of two methods that are as good as each other, over their difference
MOST_STEPS = 1e6  # that the fastest mode may ask of an explicit one of them
STABLE = 3.0  # its step times that mode
SAFETY = 5.0  # on the ratio of two errors, which differs between scenes: the estimate held on 198 of 200
CHOSEN = ("integrator", "rtol", "dt", "spectral_radius")
PESSIMISM = 1.5  # further, on the error expected before any run
STEP = 10.0  # to a tighter tolerance, or a looser one to compare with, where errors do not tell how far
COARSE = 0.1  # of the motion: a difference above it is no error that linearised equations describe
ROUNDING = 1e-10  # tolerance below which rounding may set the error, and only runs of like tolerance tell
CUT_SHORT = 0.1  # restarts over steps from which on the tolerance does not set the error of a run
SINGULAR = "a singular position of the mechanism, where constraints depend on each other: keep away from it"
AMPLIFIED = 1e4  # error over the expected one from which the motion itself, not rounding, sets the limit


@dataclass(frozen=True, kw_only=True)
class _Case:
    """What is asked for, and how to run it."""

    scene: Scene
    quantities: Mapping[str, Quantity]
    limits: Mapping[str, float]
    run: Callable[[Scene, Method], Result]
    explicit_steps: float

    def differences(self, one: Result, other: Result) -> dict[str, float]:
        return {name: compare(q.values(one), q.values(other)).largest for name, q in self.quantities.items()}

    def motions(self, result: Result) -> dict[str, float]:
        """Largest distance of each quantity from its start."""
        values = {name: q.values(result) for name, q in self.quantities.items()}
        return {name: compare(v[:1].repeat(len(v), axis=0), v).largest for name, v in values.items()}

    def excess(self, errors: Mapping[str, float]) -> float:
        return max(errors[name] / limit for name, limit in self.limits.items())


@dataclass(frozen=True, kw_only=True)
class _Done:
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


def run_to_accuracy(
    scene: Scene,
    t_end: float,
    accuracy: Mapping[str, Any],
    *,
    method: Method | None,
    outputs: Outputs | None,
    shorthand: Mapping[str, Any],
    start: Start,
    controllers: Sequence[SampledController],
    progress: bool,
) -> Result:
    """The run whose estimated error meets all limits.

    Parameters
    ----------
    t_end : s.
    accuracy : mapping of str to float
        Largest error over the outputs by quantity, in its unit.
    method, outputs, shorthand, start, controllers, progress
        As `simulate`; the integrator and its tolerance are chosen here, and no controllers can be.

    Returns
    -------
    Result
        With `error_estimate_<quantity>`, `accuracy_<quantity>`, and of all runs `accuracy_runs`,
        `accuracy_wall_s` and `accuracy_evaluations` in its stats; without them if it was interrupted.

    Raises SceneError for an accuracy that is no positive number, an unknown quantity, a setting that is
    chosen here, or a limit that cannot be reached.
    """
    refuse_what_is_chosen(method, shorthand, controllers)
    kept, outputs = settled(method, outputs, shorthand)
    case = _case_of(
        scene, t_end, accuracy, outputs=outputs, start=start_state(scene, start), progress=progress
    )
    result = _converged(case, kept)
    asked = outputs.channels
    if asked is None:
        return result
    return replace(result, channels={name: result.channels[name] for name in asked})


def error_of(
    scene: Scene, t_end: float, accuracy: Mapping[str, Any], *, method: Method, outputs: Outputs
) -> tuple[dict[str, float], int, int]:
    """Estimated errors of a run by a method that `run_to_accuracy` chose for another scene.

    Returns
    -------
    errors : dict of str to float
        By quantity of `accuracy`, in its unit.
    run, other : int
        Evaluations of the run, and of the cheap one that tells its error.

    Raises
    ------
    SceneError
        As of `run_to_accuracy`.
    KeyboardInterrupt
        Where Ctrl-C stopped a run.
    """
    case = _case_of(scene, t_end, accuracy, outputs=outputs, start=None, progress=False)
    done = [_run(case, _cheap(case, method)), _run(case, method)]
    if any(one.result.interrupted for one in done):
        raise KeyboardInterrupt
    other, run = (int(one.result.stats["evaluations"]) for one in done)
    return _errors(case, done)[0], run, other


def _cheap(case: _Case, method: Method) -> Method:
    """What tells the error of a method."""
    if method.used_rtol <= ROUNDING:
        return _looser(method)
    return probe_of(method, stiffest=method.integrator == STIFF and case.explicit_steps > MOST_STEPS)


def _case_of(
    scene: Scene,
    t_end: float,
    accuracy: Mapping[str, Any],
    *,
    outputs: Outputs,
    start: _core.State | None,
    progress: bool,
) -> _Case:
    if not isinstance(accuracy, Mapping):
        raise SceneError(f"accuracy is {accuracy!r}; give a mapping such as {{'payload_position': 0.01}}")
    model = scene.compile()
    measured = quantities_of(scene, model, list(accuracy) or None)
    limits = limits_of(measured, accuracy)
    needed = {channel for quantity in measured.values() for channel in quantity.channels}
    asked = outputs.channels
    recorded = outputs if asked is None else replace(outputs, channels=sorted({*asked, *needed}))

    def run(changed: Scene, chosen: Method) -> Result:
        compiled = model if changed is scene else None
        one = Run(changed, t_end, method=chosen, outputs=recorded, start=start, model=compiled)
        return require_finite(finished(one, progress=progress))

    steps = (fastest_mode(model) or 0.0) * t_end / STABLE if any_stiff(scene.loads) else 0.0
    return _Case(scene=scene, quantities=measured, limits=limits, run=run, explicit_steps=steps)


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


def without_what_is_chosen(method: Method) -> Method:
    """The method with the defaults of what an accuracy chooses."""
    usual = Method()
    return replace(method, **{name: getattr(usual, name) for name in CHOSEN})


def _converged(case: _Case, kept: Method) -> Result:
    """Runs until the estimate of the last one meets the limits; `kept` holds what is not chosen here."""
    first = first_method(case.scene, case.quantities, case.limits)
    method = _with_setting(kept, first)
    done = [_run(case, _cheap(case, method))]
    while not done[-1].result.interrupted:
        done.append(_run(case, method))
        if done[-1].result.interrupted:
            break
        errors, known = _errors(case, done)
        if case.excess(errors) <= 1.0:
            return _with_estimate(case, done, errors)
        if method.used_rtol <= TIGHTEST:
            raise SceneError(_unreachable(case, errors))
        method = _tighter(method, case.excess(errors) if known else STEP)
        if method.integrator == STIFF:
            done.append(_run(case, _cheap(case, method)))
        elif method.used_rtol < ROUNDING and done[-1].tolerance > STEP * 1.1 * method.used_rtol:
            done.append(_run(case, _looser(method)))
    return done[-1].result


def _run(case: _Case, method: Method) -> _Done:
    return _Done(method=method, result=case.run(case.scene, method))


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


def first_method(scene: Scene, quantities: Mapping[str, Quantity], limits: Mapping[str, float]) -> Method:
    """What met such limits in measured trades."""
    smallest = min(limit / unit_error(scene, quantities[name]) for name, limit in limits.items())
    return method_for(smallest / (SAFETY * PESSIMISM), stiff=any_stiff(scene.loads))


def _errors(case: _Case, done: Sequence[_Done]) -> tuple[dict[str, float], bool]:
    """Estimated errors of the last run, and whether they tell which setting would do.

    Every looser run has its say: two errors alone may be alike by chance where a motion amplifies them.
    """
    tight = done[-1]
    motions = case.motions(tight.result)
    if tight.method.integrator == STIFF:
        apart = case.differences(tight.result, done[-2].result)
        near = all(d <= COARSE * motions[name] for name, d in apart.items())
        return {name: BESIDE * d for name, d in apart.items()}, near and tight.tolerance > ROUNDING
    looser = [one for one in done[:-1] if one.expected > tight.expected]
    differences = [case.differences(tight.result, one.result) for one in looser]
    ratios = [tight.expected / one.expected for one in looser]
    factors = [SAFETY * ratio / (1.0 - ratio) for ratio in ratios]
    last = differences[-1]
    errors = {name: max(f * d[name] for f, d in zip(factors, differences, strict=True)) for name in last}
    linear = {name: d <= COARSE * motions[name] for name, d in last.items()}
    by_tolerance = not (_cut_short(looser[-1].result) or _cut_short(tight.result))
    errors |= {name: max(errors[name], d) for name, d in last.items() if not (linear[name] and by_tolerance)}
    return errors, all(linear.values()) and by_tolerance and tight.tolerance > ROUNDING


def _cut_short(result: Result) -> bool:
    """Whether hard stops, not the tolerance, set the length of many steps."""
    return int(result.stats["restarts"]) > CUT_SHORT * int(result.stats["steps"])


def _with_estimate(case: _Case, done: Sequence[_Done], errors: Mapping[str, float]) -> Result:
    """The last run, with what differences of tolerance do not tell added to its errors."""
    last = done[-1]
    runs = [one.result for one in done]
    if last.result.stats.get("rank_changed"):
        other = _other_formulation(case, last)
        if other.interrupted:
            return other
        apart = case.differences(last.result, other)
        unexplained = {name: max(apart[name] - error, 0.0) for name, error in errors.items()}
        errors = _added(errors, unexplained, SAFETY)
        runs.append(other)
        if case.excess(errors) > 1.0:
            raise SceneError(_unreachable(case, errors, SINGULAR))
    if _table_may_show(case, last.result):
        exact = case.run(_with_exact_waves(case.scene), last.method)
        if exact.interrupted:
            return exact
        errors = _added(errors, case.differences(last.result, exact), 1.0)
        runs.append(exact)
        if case.excess(errors) > 1.0:
            raise SceneError(_unreachable(case, errors, _bound_of_table(case.scene)))
    stats: dict[str, Any] = {**last.result.stats, "accuracy_runs": len(runs)}
    stats["accuracy_wall_s"] = sum(float(result.stats["wall_s"]) for result in runs)
    stats["accuracy_evaluations"] = sum(int(result.stats["evaluations"]) for result in runs)
    for name, limit in case.limits.items():
        stats |= {f"accuracy_{name}": limit, f"error_estimate_{name}": errors[name]}
    failed: list[Finding] = []
    nothing: dict[str, float] = {}
    by_model = tried(
        "estimating the error of the model",
        lambda: model_errors(case.scene, last.result.time, case.limits), nothing, failed,
    )  # fmt: skip
    warn_of(failed)
    stats |= {f"model_error_{name}": error for name, error in by_model.items()}
    return replace(last.result, stats=stats)


def _added(errors: Mapping[str, float], more: Mapping[str, float], factor: float) -> dict[str, float]:
    return {name: error + factor * more[name] for name, error in errors.items()}


def _other_formulation(case: _Case, done: _Done) -> Result:
    """The same run in the other coordinates: at a singular position both leave combinations of rows out, of
    rows of their own, and what that does to the motion no tolerance changes."""
    other = "redundant" if done.result.stats["formulation"] == "recursive" else "recursive"
    return case.run(case.scene, replace(done.method, formulation=other))


def _table_may_show(case: _Case, result: Result) -> bool:
    """Whether the bound of the wave table, as a part of the motion, exceeds a limit."""
    waves = case.scene.waves
    if waves is None or waves.evaluation != "table" or not waves.has_tables():
        return False
    motions = case.motions(result)
    return any(waves.relative_bound * motions[n] > limit for n, limit in case.limits.items())


def _with_exact_waves(scene: Scene) -> Scene:
    assert scene.waves is not None
    return scene.copy(waves=replace(scene.waves, evaluation="exact"))


def _bound_of_table(scene: Scene) -> str:
    assert scene.waves is not None
    return f"the wave table, whose relative_bound is {scene.waves.relative_bound:g}: tighten it"


def _unreachable(case: _Case, errors: Mapping[str, float], term: str = "") -> str:
    name = max(case.limits, key=lambda quantity: errors[quantity] / case.limits[quantity])
    quantity = case.quantities[name]
    expected = expected_error(method_for(0.0)) * unit_error(case.scene, quantity)
    if not term and errors[name] > AMPLIFIED * expected:
        term = (
            "the motion itself, which amplifies the smallest differences: ask for statistics, or a shorter "
            "run"
        )
    term = term or f"rounding at the tightest tolerance, {TIGHTEST:g}"
    return (
        f"accuracy: {name} of {case.limits[name]:g} {quantity.unit} cannot be reached: the limit is "
        f"{errors[name]:.3g} {quantity.unit}, set by {term}"
    )
