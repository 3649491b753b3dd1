"""simulate(accuracy=...): tolerances tightened until two runs agree within the stated error.

A rule from measured trades (docs/trade.md) gives the first tolerance. The difference of two runs is
about the error of the looser one; the tighter one, which is returned, has less.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from seacrane.channel_names import LINK
from seacrane.errors import SceneError
from seacrane.simulation import Run, finished
from seacrane.trading.quantities import Quantity, compare, limits_of, quantities_of

if TYPE_CHECKING:
    from seacrane.result import Result
    from seacrane.scene import Scene

LOW_ORDER, HIGH_ORDER = "tsit5", "dop853"
TIGHT = 1e-7  # tolerance below which the method of order 8 is the cheaper one
LOOSEST, TIGHTEST = 1e-2, 1e-12
STEP = 10.0  # between the tolerances of the two runs that are compared
MARGIN = 0.5  # of the limit, aimed at when a tolerance turns out too loose
SHRINK = 0.3  # error of the tighter run over the difference: 0.1 by the tolerances, and a margin
COARSE = 2e-3  # tolerance from which on stability sets the steps: errors do not follow the tolerance there
ERROR_PER_TOLERANCE = {"m": 0.1, "m/s": 0.1, "rad": 3e-4, "rad/s": 3e-4}
FORCE_PER_TOLERANCE = 0.05  # over the weight that the force carries
AMPLIFIED = 1e3  # error over tolerance from which the motion itself, not the method, sets the limit

Runner = Callable[[str, float], "Result"]


def simulate_to_accuracy(
    scene: Scene,
    accuracy: Mapping[str, Any],
    *,
    channels: Sequence[str] | None,
    progress: bool,
    **settings: Any,
) -> Result:
    """The loosest run whose estimated error meets all limits.

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

    def run(method: str, tolerance: float) -> Result:
        settled = Run(scene, model=model, channels=wanted, integrator=method, rtol=tolerance, **settings)
        return finished(settled, progress=progress)

    result = _converged(scene, run, measured, limits)
    if channels is None:
        return result
    return replace(result, channels={name: result.channels[name] for name in channels})


def _converged(
    scene: Scene, run: Runner, measured: Mapping[str, Quantity], limits: Mapping[str, float]
) -> Result:
    """Tightens until two runs agree within the limits."""
    tolerance = min(max(first_tolerance(scene, measured, limits), STEP * TIGHTEST), LOOSEST)
    method = _method(tolerance)
    done = [run(method, tolerance)]
    while not done[-1].interrupted:
        looser = done[-1]
        done.append(run(method, tolerance / STEP))
        if done[-1].interrupted:
            break
        shrink = 1.0 if tolerance > COARSE else SHRINK
        errors = {name: shrink * _difference(q, done[-1], looser) for name, q in measured.items()}
        excess = max(errors[name] / limit for name, limit in limits.items())
        if excess <= 1.0:
            return _with_estimate(done, limits, errors)
        if tolerance <= STEP * TIGHTEST:
            raise SceneError(_unreachable(scene, measured, limits, errors))
        held, needed = tolerance / STEP, tolerance * MARGIN / excess
        tolerance = max(min(held, needed), STEP * TIGHTEST)
        if tolerance != held or _method(tolerance) != method:  # methods differ in error at one tolerance
            method = _method(tolerance)
            done.append(run(method, tolerance))
    return done[-1]


def _method(tolerance: float) -> str:
    return HIGH_ORDER if tolerance < TIGHT else LOW_ORDER


def first_tolerance(scene: Scene, quantities: Mapping[str, Quantity], limits: Mapping[str, float]) -> float:
    """Of the looser of the first two runs: what met such limits in measured trades."""
    tolerance = min(limit / _scale(scene, quantities[name]) for name, limit in limits.items())
    return tolerance if tolerance < COARSE else max(COARSE, tolerance / STEP)


def _scale(scene: Scene, quantity: Quantity) -> float:
    """Expected error over the tolerance."""
    if quantity.unit in ERROR_PER_TOLERANCE:
        return ERROR_PER_TOLERANCE[quantity.unit]
    if quantity.name == "hook_tension":
        mass = scene.bodies[scene.joints[LINK].second].mass
    else:
        floating = {vessel.body for vessel in scene.vessels.values()}
        mass = sum(body.mass for body in scene.bodies.values() if body.name not in floating)
    return max(FORCE_PER_TOLERANCE * mass * abs(scene.gravity), 1.0)


def _difference(quantity: Quantity, one: Result, other: Result) -> float:
    return compare(quantity.values(one), quantity.values(other)).largest


def _with_estimate(
    done: Sequence[Result], limits: Mapping[str, float], errors: Mapping[str, float]
) -> Result:
    stats: dict[str, Any] = {**done[-1].stats, "accuracy_runs": len(done)}
    stats["accuracy_wall_s"] = sum(float(result.stats["wall_s"]) for result in done)
    stats["accuracy_evaluations"] = sum(int(result.stats["evaluations"]) for result in done)
    for name, limit in limits.items():
        stats |= {f"accuracy_{name}": limit, f"error_estimate_{name}": errors[name]}
    return replace(done[-1], stats=stats)


def _unreachable(
    scene: Scene, quantities: Mapping[str, Quantity], limits: Mapping[str, float], errors: Mapping[str, float]
) -> str:
    name = max(limits, key=lambda quantity: errors[quantity] / limits[quantity])
    unit = quantities[name].unit
    amplified = errors[name] > AMPLIFIED * TIGHTEST * _scale(scene, quantities[name])
    term = (
        "the motion itself, which amplifies the smallest differences: ask for statistics, or a shorter run"
        if amplified
        else f"rounding at the tightest tolerance, {TIGHTEST:g}"
    )
    return (
        f"accuracy: {name} of {limits[name]:g} {unit} cannot be reached: the limit is {errors[name]:.3g} "
        f"{unit}, set by {term}"
    )
