"""simulate(accuracy=...): one run at the right tolerance, and a cheap one that tells its error.

Errors of two runs of one scene obey the same linearised equations of motion and differ in their local errors
only, so that their ratio hardly depends on the scene (docs/trade.md). The difference of a cheap and a tight
run is the error of the cheap one; times that ratio, it is the error of the tight one, which is returned.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from seacrane.errors import SceneError
from seacrane.run.simulation import Run, finished
from seacrane.trading.expected import TIGHTEST, Method, probe_of, setting_for, unit_error
from seacrane.trading.quantities import Quantity, compare, limits_of, quantities_of

if TYPE_CHECKING:
    from seacrane.result import Result
    from seacrane.scene.scene import Scene

SAFETY = 5.0  # on the ratio of two errors, which differs between scenes: the estimate held on 198 of 200
PESSIMISM = 1.5  # further, on the error expected before any run
STEP = 10.0  # to a tighter tolerance, or a looser one to compare with, where errors do not tell how far
COARSE = 0.1  # of the motion: a difference above it is no error that linearised equations describe
ROUNDING = 1e-10  # tolerance below which rounding may set the error, and only runs of like tolerance tell
CUT_SHORT = 0.1  # restarts over steps from which on the tolerance does not set the error of a loose run
SINGULAR = "a singular position of the mechanism, where constraints depend on each other: keep away from it"
AMPLIFIED = 1e4  # error over the expected one from which the motion itself, not rounding, sets the limit


@dataclass(frozen=True, kw_only=True)
class _Case:
    """What is asked for, and how to run it."""

    scene: Scene
    quantities: Mapping[str, Quantity]
    limits: Mapping[str, float]
    run: Callable[..., Result]  # scene, setting, and a formulation other than the one asked for

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
    """A finished run and its setting."""

    setting: Method
    result: Result


def simulate_to_accuracy(
    scene: Scene,
    accuracy: Mapping[str, Any],
    *,
    channels: Sequence[str] | None,
    progress: bool,
    **settings: Any,
) -> Result:
    """The run whose estimated error meets all limits.

    Parameters
    ----------
    scene : Scene
    accuracy : mapping of str to float
        Largest error over the outputs by quantity, in its unit.
    channels, progress, **settings
        As `simulate`.

    Returns
    -------
    Result
        With `error_estimate_<quantity>`, `accuracy_<quantity>`, and of all runs `accuracy_runs`,
        `accuracy_wall_s` and `accuracy_evaluations` in its stats; without them if it was interrupted.

    Raises
    ------
    SceneError
        For an accuracy that is no positive number, an unknown quantity, or a limit that cannot be reached.
    """
    if not isinstance(accuracy, Mapping):
        raise SceneError(f"accuracy is {accuracy!r}; give a mapping such as {{'payload_position': 0.01}}")
    model = scene.compile()
    measured = quantities_of(scene, model, list(accuracy) or None)
    limits = limits_of(measured, accuracy)
    needed = {channel for quantity in measured.values() for channel in quantity.channels}
    wanted = None if channels is None else sorted({*channels, *needed})

    def run(changed: Scene, setting: Method, other_formulation: str | None = None) -> Result:
        chosen = settings if other_formulation is None else {**settings, "formulation": other_formulation}
        settled = Run(
            changed, model=model if changed is scene else None, channels=wanted,
            integrator=setting.name, rtol=setting.tolerance, **chosen,
        )  # fmt: skip
        return finished(settled, progress=progress)

    result = _converged(_Case(scene=scene, quantities=measured, limits=limits, run=run))
    if channels is None:
        return result
    return replace(result, channels={name: result.channels[name] for name in channels})


def _converged(case: _Case) -> Result:
    """Runs until the estimate of the last one meets the limits."""
    setting = first_setting(case.scene, case.quantities, case.limits)
    done = [_run(case, probe_of(setting) if setting.tolerance > ROUNDING else _looser(setting))]
    while not done[-1].result.interrupted:
        done.append(_run(case, setting))
        if done[-1].result.interrupted:
            break
        errors, known = _errors(case, done)
        if case.excess(errors) <= 1.0:
            return _with_estimate(case, done, errors)
        if setting.tolerance <= TIGHTEST:
            raise SceneError(_unreachable(case, errors))
        setting = _tighter(setting, case.excess(errors) if known else STEP)
        if setting.tolerance < ROUNDING and done[-1].setting.tolerance > STEP * 1.1 * setting.tolerance:
            done.append(_run(case, _looser(setting)))
    return done[-1].result


def _run(case: _Case, setting: Method) -> _Done:
    return _Done(setting=setting, result=case.run(case.scene, setting))


def _looser(setting: Method) -> Method:
    return replace(setting, tolerance=STEP * setting.tolerance)


def _tighter(setting: Method, factor: float) -> Method:
    """A setting whose error is smaller by that factor at least."""
    found = setting_for(setting.error / factor)
    if found.error > 0.6 * setting.error:
        found = replace(setting, tolerance=setting.tolerance / math.sqrt(STEP))
    return replace(found, tolerance=max(found.tolerance, TIGHTEST))


def first_setting(scene: Scene, quantities: Mapping[str, Quantity], limits: Mapping[str, float]) -> Method:
    """What met such limits in measured trades."""
    smallest = min(limit / unit_error(scene, quantities[name]) for name, limit in limits.items())
    return setting_for(smallest / (SAFETY * PESSIMISM))


def _errors(case: _Case, done: Sequence[_Done]) -> tuple[dict[str, float], bool]:
    """Estimated errors of the last run, and whether they tell which setting would do.

    Every looser run has its say: two errors alone may be alike by chance where a motion amplifies them.
    """
    tight = done[-1]
    motions = case.motions(tight.result)
    looser = [one for one in done[:-1] if one.setting.error > tight.setting.error]
    differences = [case.differences(tight.result, one.result) for one in looser]
    ratios = [tight.setting.error / one.setting.error for one in looser]
    factors = [SAFETY * ratio / (1.0 - ratio) for ratio in ratios]
    last = differences[-1]
    errors = {name: max(f * d[name] for f, d in zip(factors, differences, strict=True)) for name in last}
    linear = {name: d <= COARSE * motions[name] for name, d in last.items()}
    by_tolerance = not _cut_short(looser[-1].result)
    errors |= {name: max(errors[name], d) for name, d in last.items() if not (linear[name] and by_tolerance)}
    return errors, all(linear.values()) and by_tolerance and tight.setting.tolerance > ROUNDING


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
        exact = case.run(_with_exact_waves(case.scene), last.setting)
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
    return replace(last.result, stats=stats)


def _added(errors: Mapping[str, float], more: Mapping[str, float], factor: float) -> dict[str, float]:
    return {name: error + factor * more[name] for name, error in errors.items()}


def _other_formulation(case: _Case, done: _Done) -> Result:
    """The same run in the other coordinates: at a singular position both leave combinations of rows out, of
    rows of their own, and what that does to the motion no tolerance changes."""
    other = "redundant" if done.result.stats["formulation"] == "recursive" else "recursive"
    return case.run(case.scene, done.setting, other)


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
    expected = setting_for(0.0).error * unit_error(case.scene, quantity)
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
