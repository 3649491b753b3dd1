"""Modes of a scene at states of a run: those that make it slow, and those that its method or valves feed."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from seacrane import _core
from seacrane._core import integrator as integrator_of
from seacrane.analysis.after_run import Finding
from seacrane.analysis.linearise import LARGEST, jacobian
from seacrane.arrays import Array
from seacrane.description.description import Description
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.description.loads import any_stiff, lines_of, whole_of
from seacrane.one_thread import one_thread
from seacrane.warnings import GrowingModeWarning, StiffWarning, UnsteadyOilWarning

MOST_DAMPING = 0.05  # ratio: what is damped more, waves and drives keep in bounds
MANY_STEPS = 10_000  # fewer are no matter
STATES_SQUARED_PER_STEP = 5.0  # so many steps cost ten times the eigenvalues of so many states
NEAR_THE_LIMIT = 1.0  # |eigenvalue| times step; explicit methods stay stable up to 2 to 6
SETTLES = 3.0  # |eigenvalue| times settling time: a quasi-static stretch is slower than the mode
UNSEEN = 20.0  # |eigenvalue| times output interval: three periods between two outputs
HOUR = 3600.0  # s
FEWEST_STEPS = 2000  # fewer are no matter
LEAST_GROWTH = math.log(3.0)  # of the amplitude over the run
LOOSE = 1e-3  # rtol from which on step control lets a mode ring as much as matters
LEAST_SEEN = 0.1  # frequency times step: below, growth is rounding
ROUNDING = 1e-16  # of a scale: the least amplitude from which a mode grows
TINY = 1e-300  # in place of a factor of zero
LONGER = 1.15  # steps that step control tries now and then, over their mean
FIX = (
    "energy_balance hardly shows it, standard deviations do. Give a smaller {setting}, take another "
    "integrator ('verner65' or 'dop853' damp up to longer steps), or give the mode damping"
)
OPEN = 1e-3  # of the spool's travel, to both sides of the overlap
UNDAMPED = 1e-3  # of critical damping, negative: less is not told
SLOWEST = 0.1  # rad/s: slower modes are those of drifting vessels
HALVINGS = 8  # of the gain, until it is steady
MARGIN = 0.5  # of that gain, which is told
RESTLESS = 0.5  # m/s2: what would set out faster is not at rest


Mode = tuple[complex, str]  # an eigenvalue (1/s), and the body that it moves most


class Modes:
    """Found when they are first asked for, at one state or more; bodies in the order of the model."""

    def __init__(self, model: _core.Model, bodies: Sequence[str], states: Sequence[_core.State]) -> None:
        self.model, self._bodies, self._states = model, list(bodies), list(states)
        first = (6 if model.euler_angles else 7) * len(self._bodies)
        self._speeds = slice(first, first + 6 * len(self._bodies))

    @cached_property
    def fastest(self) -> tuple[float, str, float]:
        """The fastest of all states: |eigenvalue| (1/s), zero where it is not finite; body; time, s."""
        found = []
        for state in self._states:
            modes = self._at(np.array(state.values), state.time)
            worst, body = max(modes, key=lambda mode: abs(mode[0]), default=(0j, ""))
            found.append((abs(worst), body, state.time))
        return max(found)

    @cached_property
    def oscillations(self) -> list[Mode]:
        """Those with little damping, at rest in the pose of each state; imaginary parts are positive."""
        found: list[Mode] = []
        for state in self._states if self._bodies else ():
            values = np.array(state.values)
            values[self._speeds] = 0.0
            found += self._at(values, state.time)
        return [one for one in found if one[0].imag > 0.0 and abs(one[0].real) < MOST_DAMPING * abs(one[0])]

    @one_thread
    def _at(self, values: Array, time: float) -> list[Mode]:
        """All modes of a state; none where its rates are not finite."""
        matrix = jacobian(self.model, state=values, time=time)
        if not np.all(np.isfinite(matrix)):
            return []
        modes, shapes = np.linalg.eig(matrix)
        scale = np.array(self.model.scale)
        speeds = (np.abs(shapes) / scale[np.isfinite(scale), None])[self._speeds]
        moved = [self._bodies[int(column.argmax()) // 6] if self._bodies else "" for column in speeds.T]
        return list(zip(modes.tolist(), moved, strict=True))


def fewest_steps(states: int, least: int = MANY_STEPS) -> int:
    """The steps of a run that is worth the eigenvalues of so many states."""
    return max(least, int(states**2 / STATES_SQUARED_PER_STEP))


def stiffness(
    loads: Mapping[str, Any],
    modes: Modes,
    stats: Mapping[str, Any],
    settings: Mapping[str, Any],
    *,
    near: float = 1.0,
) -> list[Finding]:
    """The mode that sets the steps of a slow run, told from a share of the limits (`near`) on.

    It is looked for only where there are many steps. `stats`, `settings`: as of its result.
    """
    integrator, steps = str(stats["integrator"]), int(stats["steps"])
    method = integrator_of(integrator)
    adjusts = method.setting == "rtol" and not method.uses_jacobian
    states = modes.model.states
    if not adjusts or steps < fewest_steps(states) or states > LARGEST:
        return []
    step = float(stats["simulated_s"]) / steps
    mode, body, at = modes.fastest
    longer = "'rosenbrock'"
    if any_stiff(loads) and integrator != "dopri5-stiff":
        longer = f"'dopri5-stiff' or {longer}"
    shown = mode * float(settings["dt_out"]) < near * UNSEEN
    if mode * step < near * NEAR_THE_LIMIT or shown:
        return []
    return [
        (
            StiffWarning,
            f"run: {integrator} took {steps} steps of {step:.2g} s on average, about the longest with which "
            f"it is stable: the fastest mode, {mode:.4g} per s at t = {at:.6g} s, moves body {body!r} most, "
            "far faster than the outputs show. Soften the gain, spring or stop that holds that body, or take "
            f"integrator={longer}, whose steps it does not limit" + _taut_lines(loads, body, mode),
        )
    ]


def _taut_lines(loads: Mapping[str, Any], body: str, mode: float) -> str:
    """The rung that takes the mode, where it may be that of an elastic line on the body."""
    fast = {
        repr(whole_of(name, line))
        for name, line in lines_of(loads).items()
        if line.rung == "elastic" and body in line.bodies and mode * line.settling > SETTLES
    }
    if not fast:
        return ""
    return (
        f". If it is the stretch of line {' or '.join(sorted(fast))} and the line stays taut, give it "
        "rung='quasi-static': with an explicit method it then costs what a soft line does. For motion of "
        f"omega rad/s the tension errs by less than (omega / {mode:.4g})^2 of what omega makes of it"
    )


def growing(
    modes: Modes,
    stats: Mapping[str, Any],
    settings: Mapping[str, Any],
    *,
    undamped: Collection[str] = (),
    near: float = 1.0,
) -> list[Finding]:
    """The mode that a method feeds, looked for only where there are many steps.

    A step h of y' = lambda y multiplies y by R(h lambda). Where log|R| exceeds the decay of the mode, its
    amplitude grows by that much in each step, though the solution's does not; step control ends that only
    where the amplitude has come to its tolerance. What would have grown from rounding beyond the tolerance
    has come there: it rings. Modes of bodies whose damping the linear model lacks (`undamped`) are not
    judged; `near` as of `stiffness`, and of what damps the modes.
    """
    integrator, steps = str(stats["integrator"]), int(stats["steps"])
    polynomial = _core.stability_polynomial(integrator)
    states = modes.model.states
    if not polynomial or steps < fewest_steps(states, FEWEST_STEPS) or states > LARGEST:
        return []
    duration = float(stats["simulated_s"])
    step, tolerance = duration / steps, float(settings["rtol"])
    fed = [
        (added(polynomial, mode, step), near * min(mode.real, 0.0), mode, body)
        for mode, body in modes.oscillations
        if body not in undamped
    ]
    adapts = _core.integrator(integrator).setting == "rtol"
    fix = FIX.format(setting="rtol" if adapts else "dt")
    most = math.log(tolerance / ROUNDING) / duration if adapts else math.inf
    rates = [(more + own, mode, body) for more, own, mode, body in fed if more + own <= most]
    rate, mode, body = max(rates, key=lambda one: one[0], default=(-math.inf, 0j, ""))
    if rate * duration >= near * LEAST_GROWTH:
        factor = math.exp(min(rate * HOUR, 99.0))
        text = (
            f"run: {integrator} makes an oscillation of body {body!r} grow by a factor of {factor:.3g} an "
            f"hour: {_shown(mode)}, which its steps of {step:.3g} s on average outweigh. {fix}"
        )
        return [(GrowingModeWarning, text)]
    for more, own, mode, body in fed if adapts and tolerance >= LOOSE else ():
        seen = more > 0.0 and abs(mode) * step > LEAST_SEEN
        if seen and added(polynomial, mode, LONGER * step) + own > 0.0:
            text = (
                f"run: {integrator} at rtol {tolerance:g} keeps an oscillation of body "
                f"{body!r} ringing: {_shown(mode)}, which grows with steps a little "
                f"longer than those of {step:.3g} s on average, until it comes to the tolerance. {fix}"
            )
            return [(GrowingModeWarning, text)]
    return []


def _shown(mode: complex) -> str:
    damping = abs(max(-mode.real / abs(mode), 0.0))
    return f"a mode of {mode.imag:.4g} rad/s with {damping:.2g} of critical damping"


def added(polynomial: Sequence[float], mode: complex, step: float) -> float:
    """Rate (1/s) by which steps change an amplitude beyond what the mode does by itself."""
    z, factor = step * mode, 0j
    for coefficient in reversed(polynomial):
        factor = factor * z + coefficient
    return (math.log(abs(factor) or TINY) - z.real) / step


@one_thread
def unsteady_oil(scene: Description, model: _core.Model, states: Sequence[_core.State]) -> list[Finding]:
    """Cylinders whose valve feeds a mode, at rest in the pose of the first state whose loads are in balance.

    Away from rest a linear model tells of the motion that is under way, and not of what it comes to; where no
    state is at rest nothing is told. A valve has two slopes, one on each side of its middle; their mean
    counts, at the edge of the overlap. A spool without lag is left out, as are modes that grow by less
    than `UNDAMPED`.
    """
    cylinders = {
        name: one
        for name, one in hydraulic_cylinders(scene).items()
        if one.gain > 0.0 and one.spool_lag > 0.0 and one.rated_flow > 0.0
    }
    if not cylinders or model.states > LARGEST:
        return []
    places = {name: place for name, _, place, *_ in model.load_states}
    spools = {name: places[f"{name}.spool"] for name in cylinders}
    start = next((one for one in states if _unrest(scene, model, one) < RESTLESS), None)
    if start is None:
        return []
    found = []
    for side in (-1.0, 1.0):
        values = _stopped(model, start)
        for name, place in spools.items():
            values[place] = side * (cylinders[name].overlap + OPEN)
        found.append(jacobian(model, state=values, time=start.time))
    matrix = np.asarray(0.5 * (found[0] + found[1]))
    if not np.all(np.isfinite(matrix)):
        return []
    stated = np.flatnonzero(np.isfinite(np.array(model.scale)))  # rows of the Jacobian
    rows = {name: int(np.searchsorted(stated, place)) for name, place in spools.items()}
    return [
        (UnsteadyOilWarning, text)
        for name, one in cylinders.items()
        for text in _told(name, one, matrix, rows)
    ]


def _stopped(model: _core.Model, state: _core.State) -> Array:
    """Its values without speeds and what follows from them."""
    values = np.array(state.values)
    values[model.twist_index(0) : min(place for _, _, place, *_ in model.load_states)] = 0.0
    return values


def _unrest(scene: Description, model: _core.Model, state: _core.State) -> float:
    """The largest acceleration, m/s2, with which what cylinders join would set out from its pose."""
    joined = {end for one in hydraulic_cylinders(scene).values() for end in (one.first, one.second)}
    terms = _core.Evaluator(model).terms(state.time, _stopped(model, state))
    accelerations = np.abs(terms["acceleration"]).reshape(-1, 6)[:, :3].max(axis=1)
    return float(max(a for body, a in zip(model.bodies, accelerations, strict=True) if body in joined))


def _told(name: str, one: _core.HydraulicCylinder, matrix: Array, rows: dict[str, int]) -> Iterator[str]:
    """What is told of a cylinder that is not steady, the others with a gain of zero."""

    def modes(share: float) -> Array:
        out = np.array(matrix)
        for other, row in rows.items():
            lag = out[row, row]
            out[row] *= share if other == name else 0.0
            out[row, row] = lag
        return np.asarray(np.linalg.eigvals(out))

    shut = modes(0.0)
    worst = _fed(modes(1.0), shut)
    if worst is None:
        return
    steady = 1.0
    for _ in range(HALVINGS):
        steady *= 0.5
        if _fed(modes(steady), shut) is None:
            break
    damping = 100.0 * worst.real / abs(worst)
    yield (
        f"hydraulic cylinder {name!r}: with its gain of {one.gain:g} 1/m a mode of {worst.imag:.3g} rad/s "
        f"grows by {damping:.2g} % of critical damping, until its valve is open all the way. Give a lower "
        f"gain, such as {MARGIN * steady * one.gain:.2g} 1/m, and let rate_gain lead, or more "
        "viscous_friction"
    )


def _fed(modes: Array, shut: Array) -> complex | None:
    """The mode that grows most, and more than its like with a shut valve; None if none does."""
    likes = shut[np.argmin(np.abs(modes[:, None] - shut), axis=1)]
    least = UNDAMPED * np.abs(modes)
    growing = modes[(modes.imag > SLOWEST) & (modes.real > least) & ((modes - likes).real > least)]
    return complex(growing[int(np.argmax(growing.real))]) if growing.size else None
