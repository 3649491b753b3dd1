"""Modes of a scene at states of a run: those that make it slow, and those that its method or valves feed."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane._core import integrator as integrator_of
from seacrane.analysis.linearise import LARGEST, jacobian
from seacrane.description.description import Description
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.description.loads import any_stiff, lines_of, whole_of
from seacrane.one_thread import one_thread
from seacrane.validity.after_run import Finding
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
Array = NDArray[np.float64]
OPEN = 1e-3  # of the spool's travel, to both sides of the overlap
UNDAMPED = 1e-3  # of critical damping, negative: less is not told
SLOWEST = 0.1  # rad/s: slower modes are those of drifting vessels
HALVINGS = 8  # of the gain, until it is steady
MARGIN = 0.5  # of that gain, which is told
RESTLESS = 0.5  # m/s2: what would set out faster is not at rest


Mode = tuple[complex, str]  # an eigenvalue (1/s), and the body that it moves most


class Modes:
    """Found when they are first asked for.

    Parameters
    ----------
    model : Model
    bodies : sequence of str
        Their names, in the order of the model.
    states : sequence of State
        At least one.
    """

    def __init__(self, model: _core.Model, bodies: Sequence[str], states: Sequence[_core.State]) -> None:
        self.model, self._bodies, self._states = model, list(bodies), list(states)

    @cached_property
    def fastest(self) -> tuple[float, str, float]:
        """The fastest of all states: |eigenvalue| (1/s), zero where it is not finite; body; time, s."""
        return max(self._fastest(state) for state in self._states)

    @cached_property
    def oscillations(self) -> list[Mode]:
        """Those with little damping, at rest in the pose of each state; imaginary parts are positive."""
        return [mode for state in self._states for mode in self._oscillations(state)]

    @property
    def _speeds(self) -> slice:
        first = (6 if self.model.euler_angles else 7) * len(self._bodies)
        return slice(first, first + 6 * len(self._bodies))

    def _sizes(self, vectors: NDArray[np.complex128]) -> NDArray[np.float64]:
        """Speeds of bodies in modes, over their scales."""
        scale = np.array(self.model.scale)
        return np.asarray((np.abs(vectors) / scale[np.isfinite(scale), None])[self._speeds])

    @one_thread
    def _fastest(self, state: _core.State) -> tuple[float, str, float]:
        matrix = jacobian(self.model, state=np.array(state.values), time=state.time)
        if not np.all(np.isfinite(matrix)):
            return 0.0, "", state.time
        eigenvalues, vectors = np.linalg.eig(matrix)
        worst = int(np.abs(eigenvalues).argmax())
        twists = self._sizes(vectors[:, worst : worst + 1])[:, 0]
        body = self._bodies[int(twists.argmax()) // 6] if self._bodies else ""
        return float(np.abs(eigenvalues[worst])), body, state.time

    @one_thread
    def _oscillations(self, state: _core.State) -> list[Mode]:
        values = np.array(state.values)
        values[self._speeds] = 0.0
        matrix = jacobian(self.model, state=values, time=state.time)
        if not self._bodies or not np.all(np.isfinite(matrix)):
            return []
        modes, shapes = np.linalg.eig(matrix)
        little = (modes.imag > 0.0) & (np.abs(modes.real) < MOST_DAMPING * np.abs(modes))
        sizes = self._sizes(shapes[:, little])
        moved = [self._bodies[int(column.argmax()) // 6] for column in sizes.T]
        return list(zip(modes[little].tolist(), moved, strict=True))


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
    """The mode that sets the steps of a slow run, looked for only where there are many steps.

    Parameters
    ----------
    loads : Of the scene, by name.
    stats, settings : Of the run: `Result.stats`, `Result.settings`.
    near : Share of the limits from which on it is told.
    """
    integrator, steps = str(stats["integrator"]), int(stats["steps"])
    method = integrator_of(integrator)
    adjusts = method.setting == "rtol" and not method.uses_jacobian
    states = modes.model.states
    if not adjusts or steps < fewest_steps(states) or states > LARGEST:
        return []
    step = float(stats["simulated_s"]) / steps
    mode, body, at = modes.fastest
    longer = "'rosenbrock' or 'cvode-bdf'"
    if any_stiff(loads) and integrator != "dopri5-stiff":
        longer = f"'dopri5-stiff', {longer}"
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
        whole_of(name, line)
        for name, line in lines_of(loads).items()
        if line.rung == "elastic" and body in line.bodies and mode * line.settling > SETTLES
    }
    names = [repr(name) for name in sorted(fast)]
    if not names:
        return ""
    return (
        f". If it is the stretch of line {' or '.join(names)} and the line stays taut, give it "
        "rung='quasi-static': with an explicit method it then costs what a soft line does. For motion of "
        f"omega rad/s the tension errs by less than (omega / {mode:.4g})^2 of what omega makes of it"
    )


@dataclass(frozen=True, kw_only=True)
class _Fed:
    """What steps make of an oscillation's amplitude: rate (1/s), and whether longer steps feed it."""

    mode: complex
    body: str
    rate: float
    rings: bool

    def __str__(self) -> str:
        damping = abs(max(-self.mode.real / abs(self.mode), 0.0))
        return f"a mode of {self.mode.imag:.4g} rad/s with {damping:.2g} of critical damping"


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
    has come there: it rings.

    Parameters
    ----------
    modes : At rest in the poses of the states; the mode counts that grows most.
    stats, settings : Of the run: `Result.stats`, `Result.settings`.
    undamped : collection of str
        Bodies whose damping the linear model lacks, whose modes are not judged.
    near : Share of the limits, and of what damps the modes, from which on it is told.
    """
    integrator, steps = str(stats["integrator"]), int(stats["steps"])
    polynomial = _core.stability_polynomial(integrator)
    states = modes.model.states
    if not polynomial or steps < fewest_steps(states, FEWEST_STEPS) or states > LARGEST:
        return []
    duration = float(stats["simulated_s"])
    step, tolerance = duration / steps, float(settings["rtol"])
    judged = [_judged(*mode, polynomial, step, near, undamped) for mode in modes.oscillations]
    adapts = _core.integrator(integrator).setting == "rtol"
    fix = FIX.format(setting="rtol" if adapts else "dt")
    most = math.log(tolerance / ROUNDING) / duration if adapts else math.inf
    worst = max((one for one in judged if one.rate <= most), key=lambda one: one.rate, default=None)
    if worst is not None and worst.rate * duration >= near * LEAST_GROWTH:
        factor = math.exp(min(worst.rate * HOUR, 99.0))
        text = (
            f"run: {integrator} makes an oscillation of body {worst.body!r} grow by a factor of "
            f"{factor:.3g} an hour: {worst}, which its steps of {step:.3g} s on average outweigh. {fix}"
        )
        return [(GrowingModeWarning, text)]
    ringing = next((one for one in judged if one.rings), None)
    if ringing is not None and adapts and tolerance >= LOOSE:
        text = (
            f"run: {integrator} at rtol {tolerance:g} keeps an oscillation of body "
            f"{ringing.body!r} ringing: {ringing}, which grows with steps a little "
            f"longer than those of {step:.3g} s on average, until it comes to the tolerance. {fix}"
        )
        return [(GrowingModeWarning, text)]
    return []


def _judged(
    mode: complex, body: str, polynomial: Sequence[float], step: float, near: float, undamped: Collection[str]
) -> _Fed:
    """What steps of a method with this stability polynomial make of one."""
    own, judged = near * min(mode.real, 0.0), body not in undamped
    fed = added(polynomial, mode, step)
    longer = added(polynomial, mode, LONGER * step) if judged and fed > 0.0 else -math.inf
    return _Fed(
        mode=mode, body=body, rate=fed + own if judged else -math.inf,
        rings=longer + own > 0.0 and abs(mode) * step > LEAST_SEEN,
    )  # fmt: skip


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
    matrix = _mean_jacobian(model, start, [*spools.values()], cylinders)
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


def _mean_jacobian(
    model: _core.Model, start: _core.State, places: list[int], cylinders: dict[str, _core.HydraulicCylinder]
) -> Array:
    """The mean Jacobian of both sides of the valves' middle."""
    found = []
    for side in (-1.0, 1.0):
        values = _stopped(model, start)
        for place, one in zip(places, cylinders.values(), strict=True):
            values[place] = side * (one.overlap + OPEN)
        found.append(jacobian(model, state=values, time=start.time))
    return np.asarray(0.5 * (found[0] + found[1]))


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
