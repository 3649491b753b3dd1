"""The rung that a line with rung "auto" takes in a run: quasi-static where its bound holds."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial.polynomial import polyder, polyval

from seacrane import _core
from seacrane._core import Integrator
from seacrane.analysis.after_run import Finding
from seacrane.analysis.line_dynamics import LineDynamics, line_dynamics
from seacrane.analysis.linearise import LARGEST
from seacrane.arrays import Array
from seacrane.description.compilation import compiled
from seacrane.description.description import Description, all_loads
from seacrane.description.loads import lines_of, on_winch
from seacrane.description.once import once
from seacrane.description.rungs import ELASTIC, QUASI_STATIC, automatic, with_rungs
from seacrane.description.wet_parts import immersed_parts, starts_wet
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.scene.scene import Scene
from seacrane.warnings import LineRungWarning, QuasiStaticLineWarning

NODES, WEIGHTS = np.polynomial.legendre.leggauss(4)  # exact for the squares of cubics
LEAST = 1e-9  # of the largest weight of a frequency
Jump = tuple[Array, Array]
LARGEST_ERROR = 0.005  # of what a source makes of the tension
LARGEST_TOLD = 0.05  # likewise, of a line that is given as quasi-static: beyond, a warning
SWING = 0.2  # rad, of a load whose swing is judged
OF_TENSION = 0.75 * SWING**2  # of the mean: amplitude of the tension of such a swing, at twice its frequency
LARGEST_RINGING = 0.005  # of the tension at the start, from a kink
LARGEST_AT_START = 0.02  # likewise, from the start: a sea begins at once, and that decays
MOST_KINKS = 5000
JUST, SLOPE = 1e-9, 1e-5  # s: before and after a kink, and over which slopes are taken there
COMPILED = "a model that is compiled already, as by accuracy and in stages, has elastic lines"
UNSMOOTH = "its winch has no lag, and so may jump"


@dataclass(frozen=True, kw_only=True)
class LineRung:
    """What a line with rung "auto" is in a run: elastic or quasi-static."""

    name: str
    reason: str


def line_rungs(
    scene: Scene,
    known: Integrator,
    *,
    end: float,
    start: _core.State | None,
    controlled: bool,
) -> dict[str, LineRung]:
    """The rungs of a run to an end (s), by line; none where no line has rung "auto".

    `controlled`: inputs are set during the run. Without a start it begins at the assembled one.
    """
    lines = automatic(scene)
    if not lines:
        return {}
    if start is not None and start.time > 0.0:
        reason = f"as in the state it goes on from, at {start.time:g} s"
        held = {name for name in lines if f"{name}.strain_rate" in start.load_states}
        return {
            name: LineRung(name=QUASI_STATIC if name in held else ELASTIC, reason=reason) for name in lines
        }
    reason = _why_elastic(scene, known, controlled=controlled)
    if reason:
        return all_elastic(lines, reason)
    return dict(_chosen_from_described(scene, end)) if start is None else _chosen(scene, end, start)


def _chosen(scene: Scene, end: float, start: _core.State | None) -> dict[str, LineRung]:
    lines = automatic(scene)
    found = _by_their_own(scene, lines, end, start)
    settled = [name for name, rung in found.items() if rung.name == QUASI_STATIC]
    try:
        compiled(with_rungs(scene, dict.fromkeys(settled, QUASI_STATIC)), merge=True)
    except SceneError as error:
        return all_elastic(lines, f"the core says of quasi-static: {error}")
    return found


@once
def _chosen_from_described(scene: Scene, end: float) -> Mapping[str, LineRung]:
    return _chosen(scene, end, None)


def all_elastic(names: Mapping[str, object], reason: str) -> dict[str, LineRung]:
    """The elastic rung for all of them, for one reason."""
    return {name: LineRung(name=ELASTIC, reason=reason) for name in names}


def _why_elastic(scene: Scene, known: Integrator, *, controlled: bool) -> str:
    """What keeps every line elastic; empty: nothing."""
    if known.residual_form:
        return f"integrator {known.name!r} has no accelerations for lines"
    if controlled:
        return "inputs are set during the run, and their jumps may make it ring"
    if scene.orientation != "quaternion":
        return f"the orientation is {scene.orientation!r}"
    for load in all_loads(scene):
        if type(load).OWN_PACE:  # it strikes, or nobody knows its frequency
            return f"{type(load).__name__} {load.name!r} may shake a line faster than anything known"
    for name, part in immersed_parts(scene).items():
        if starts_wet(scene, part)[0] < 0.0:
            return f"immersed part {name!r} is not under water, and slam is faster than anything known"
    return ""


def _by_their_own(
    scene: Scene, lines: Mapping[str, _core.Line], end: float, start: _core.State | None
) -> dict[str, LineRung]:
    """Each by its own bound."""
    model = compiled(scene, merge=False)
    if model.states > LARGEST:
        return all_elastic(lines, f"the scene has {model.states} states, more than {LARGEST}")
    values = np.array(model.initial_state if start is None else start.values)
    begin = 0.0 if start is None else start.time
    if values.size != len(model.initial_state):
        return all_elastic(lines, "the state that the run starts from holds other states")
    kinks = [time for time in model.breakpoints if begin < time < end]
    if len(kinks) > MOST_KINKS:
        return all_elastic(lines, f"curves have {len(kinks)} kinks, each of which may shake it")
    accelerations = _core.Evaluator(model).accelerations
    jumps = [_jump(lambda t: np.asarray(accelerations(t, values)), time) for time in kinks]
    sources = list(excitations(scene, start=begin, end=end))
    now, every = line_dynamics(scene, model, values, begin), lines_of(scene.loads)
    out = {}
    for name, line in lines.items():
        wound = on_winch(every, line)
        smooth = wound is None or wound.lag > 0.0
        reason = _ringing(line, wound, now[name], kinks, jumps) if smooth else UNSMOOTH
        if not reason:
            error, worst = _worst_error(line, now, sources)
            text = (
                f"its tension would err by {100.0 * error:.2g} % of {worst}, its own frequency being "
                f"{now[name].omega:.4g} rad/s"
            )
            if error <= LARGEST_ERROR:
                out[name] = LineRung(name=QUASI_STATIC, reason=text)
                continue
            reason = f"{text}: more than {100.0 * LARGEST_ERROR:g} %"
        out[name] = LineRung(name=ELASTIC, reason=reason)
    return _beside_elastic(scene, out, now)


def _beside_elastic(
    scene: Scene, rungs: dict[str, LineRung], now: Mapping[str, LineDynamics]
) -> dict[str, LineRung]:
    """Elastic too where the ringing of an elastic line that moves what a line moves errs by too much."""
    out = dict(rungs)
    lines = lines_of(scene.loads)
    chosen = {name: line.rung for name, line in lines.items()} | {name: one.name for name, one in out.items()}
    ringing = [name for name in lines if chosen[name] == ELASTIC]
    while ringing:
        other = ringing.pop()
        for name in [name for name, rung in out.items() if rung.name == QUASI_STATIC]:
            fast, own = np.array([now[other].fastest]), now[name]
            error = _error(lines[name].settling, own, fast, np.ones(1))
            if other in own.coupled and error > LARGEST_ERROR:
                reason = (
                    f"its tension would err by {100.0 * error:.2g} % of what line {other!r} makes of it, "
                    f"which is elastic and may ring, with up to {now[other].fastest:.4g} rad/s"
                )
                out[name] = LineRung(name=ELASTIC, reason=reason)
                ringing.append(name)
    return out


def _jump(of: Callable[[float], Array], time: float) -> tuple[Array, Array]:
    """How much a function of time jumps at a kink, and its slope."""
    near, far = ([of(time + side * apart) for side in (-1.0, 1.0)] for apart in (JUST, JUST + SLOPE))
    slopes = [(near[0] - far[0]) / SLOPE, (far[1] - near[1]) / SLOPE]
    return near[1] - near[0], slopes[1] - slopes[0]


def _ringing(
    line: _core.Line, wound: _core.Line | None, now: LineDynamics, kinks: list[float], jumps: list[Jump]
) -> str:
    """Why the line's own mode is not quiet; empty: it is."""
    if now.tension <= 0.0:
        return "it starts slack"
    limit = LARGEST_RINGING * now.tension
    if now.ringing > LARGEST_AT_START * now.tension:
        return (
            f"its tension of {now.tension:.4g} N would ring from the start, by {now.ringing:.3g} N; start it "
            "from rest (equilibrium)"
        )
    for time, (step, slope) in zip(kinks, jumps, strict=True):
        driven, faster = (abs(float(part)) for part in _jump(lambda t: _driven(line, wound, t), time))
        shaken = now.shaken(step) + now.shaken(slope) / now.omega
        shaken += now.mass * (driven + faster / now.omega)
        if shaken > limit:
            return f"a jump at t = {time:.6g} s would make its tension ring, by {shaken:.3g} N"
    return ""


def _driven(line: _core.Line, wound: _core.Line | None, time: float) -> Array:
    """Second derivative of its unstretched length, but for what lags behind, m/s2."""
    if wound is None:
        return np.asarray(line.length.evaluate([time])[0, 2])
    bound, fastest = wound.maximum_rate, wound.maximum_acceleration
    command = np.clip(wound.rate.evaluate([time])[0, 0], -bound, bound)
    return np.asarray(line.share * np.clip(command / wound.lag, -2.0 * fastest, 2.0 * fastest))


def _worst_error(
    line: _core.Line, now: Mapping[str, LineDynamics], sources: list[tuple[str, Array, Array]]
) -> tuple[float, str]:
    """The error of a line's tension, of what it is told of: what the sea or a curve makes of the tension, or
    the tension itself in a swing."""
    own = now[line.name]
    swing = np.array([2.0 * max(now[name].swing for name in own.coupled)])  # of the tension of what swings
    errors = {
        f"what {name} makes of it": _error(line.settling, own, omega, weight)
        for name, omega, weight in sources
    }
    swung = OF_TENSION * _error(line.settling, own, swing, np.ones(1))
    errors[f"itself when its load swings by {SWING:g} rad"] = swung
    worst = max(errors, key=lambda name: errors[name])
    return errors[worst], worst


def _error(settling: float, own: LineDynamics, omega: Array, weight: Array) -> float:
    """Root mean square of the tension's error over that of the tension that the frequencies make."""
    x = omega / own.omega
    stiff = 1.0 + 1j * own.loss * x
    made = weight * np.abs(stiff / (stiff - x**2)) ** 2 if np.all(stiff != x**2) else weight
    errors = tension_error(omega, settling=settling, own=own.omega, loss=own.loss)
    return float(np.sqrt((made * errors**2).sum() / made.sum()))


def tension_error(omega: Array, *, settling: float, own: float, loss: float = 0.0) -> Array:
    """Error of the tension of a quasi-static stretch, of what motion of a frequency makes of it.

    (omega / own)^2 times the error of the strain, and more near the line's own frequency (rad/s). `loss`: of
    its damping at that frequency, c own over the stiffness. See docs/stiff-lines.md.
    """
    p, x = 1j * settling * np.asarray(omega, dtype=float), np.asarray(omega, dtype=float) / own
    settled = p**2 * (2.0 + p) / (1.0 + p)  # T / (EA e) - 1
    elastic = 1.0 + 1j * loss * x
    follows = elastic + settled
    return np.asarray(np.abs(settled * x**2 / (elastic * (follows - x**2))))


def struck(
    scene: Scene, settled: Sequence[str], events: Iterable[tuple[float, str]], start: float
) -> list[Finding]:
    """Whether water struck what hangs on a line that "auto" settled, as it had not as the run began."""
    parts = {f"{name}.touch": name for name in immersed_parts(scene)} if settled else {}
    for time, name in events:
        if name in parts and time > start:
            lines = ", ".join(map(repr, settled))
            text = (
                f"immersed part {parts[name]!r}: met water at t = {time:.6g} s, and slam is fast; 'auto' "
                f"had made {lines} quasi-static, whose peaks are then too small. Give rung='elastic'"
            )
            return [(LineRungWarning, text)]
    return []


@once
def warn_of_quasi_static(scene: Scene, model: _core.Model, *, end: float) -> None:
    """Warn of lines that are given as quasi-static where what moves the scene is too near their frequency."""
    lines = {name: line for name, line in lines_of(scene.loads).items() if line.rung == QUASI_STATIC}
    if not lines or scene.orientation != "quaternion" or model.states > LARGEST:
        return
    elastic = compiled(with_rungs(scene, dict.fromkeys(lines, ELASTIC)), merge=False)
    now = line_dynamics(scene, elastic, np.array(elastic.initial_state), 0.0)
    sources = list(excitations(scene, start=0.0, end=end))
    for name, line in lines.items():
        error, worst = _worst_error(line, now, sources)
        if error > LARGEST_TOLD:
            warn_caller(
                f"line {name!r}: its stretch is quasi-static, and its tension errs by about "
                f"{100.0 * error:.2g} % of {worst}, its own frequency being "
                f"{now[name].omega:.4g} rad/s. Give it rung 'elastic', or 'auto', or a smaller settling",
                QuasiStaticLineWarning,
            )


def excitations(scene: Description, *, start: float, end: float) -> Iterator[tuple[str, Array, Array]]:
    """Each source that moves the scene between two times (s): its name, frequencies (rad/s) and weights.

    A weight is the square of an acceleration, in a unit of the source's own.
    """
    if scene.waves is not None:
        yield "the sea", *_sea(scene.waves)
    for element in (*scene.drivers.values(), *all_loads(scene)):
        for name, value in element.__getstate__().items():
            for curve in value if isinstance(value, list) else [value]:
                if not isinstance(curve, _core.Curve):
                    continue
                omega = curve_frequency(curve, _derivative(element, name), start=start, end=end)
                if omega > 0.0:
                    yield f"the {name} of {element.name!r}", np.array([omega]), np.ones(1)


def _sea(waves: Any) -> tuple[Array, Array]:
    """Components by their loads, which are the accelerations of a vessel but for its mass."""
    amplitude = np.abs(np.asarray(waves.amplitude))
    weights = np.zeros(amplitude.size)
    for hull in waves.hulls.values():
        load = np.abs(np.asarray(hull.transfer)) * amplitude[:, None]
        largest = load.max(axis=0)
        weights += ((load / np.where(largest > 0.0, largest, 1.0)) ** 2).sum(axis=1)
    omega = np.asarray(waves.omega, dtype=float)
    return omega, weights if weights.any() else amplitude**2 * omega**4


def _derivative(element: Any, name: str) -> int:
    """Of a curve: the one that is an acceleration of what follows, or a force."""
    if isinstance(element, _core.Line):
        return {"length": 2, "rate": 1}.get(name, 0)
    return 2 if name in ("curve", "reference") else 0


def curve_frequency(curve: _core.Curve, derivative: int, *, start: float, end: float) -> float:
    """The frequency (rad/s) of a derivative of a curve: rate over size, by their mean squares in that time.

    That of the fastest cosine where there is one; 0 where the derivative is zero or steady.
    """
    parts = curve.to_pieces()
    begins = np.asarray(parts["starts"], dtype=float)
    powers = np.asarray(parts["coefficients"], dtype=float).reshape(-1, 6)
    low = np.clip(begins, start, end)
    high = np.clip(np.append(begins[1:], np.inf), start, end)
    low[0] = min(max(begins[0], start), end)
    times = 0.5 * (high + low)[:, None] + 0.5 * (high - low)[:, None] * NODES - begins[:, None]
    share = 0.5 * (high - low)[:, None] * WEIGHTS
    size, rate = (
        float((share * polyval(times, polyder(powers.T, n)[:, :, None], tensor=False) ** 2).sum())
        for n in (derivative, derivative + 1)
    )
    cosines = np.asarray(parts["cosines"], dtype=float).reshape(-1, 3)
    waving = [abs(omega) for amplitude, omega, _ in cosines[: begins.size] if amplitude != 0.0]
    return float(max([np.sqrt(rate / size) if size > 0.0 else 0.0, *waving]))
