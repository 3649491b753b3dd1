"""Lines whose length contradicts their path or lifts what they hold, and winches that met their limits."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from seacrane import _core, warnings
from seacrane.analysis.after_run import Finding, peak
from seacrane.arrays import Array
from seacrane.description.description import all_loads
from seacrane.description.line_path import Laid, described_poses, laid
from seacrane.description.loads import lines_of, whole_of, winch_of, winches_of
from seacrane.description.once import once_in_any_sea
from seacrane.description.rungs import QUASI_STATIC
from seacrane.description.suspension import bodies_below, line_weights
from seacrane.description.wet_parts import carried_by_water, immersed_parts
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import rotation_matrix

if TYPE_CHECKING:
    from seacrane.description.description import Description

Lines = Mapping[str, _core.Line]
LARGEST_CONTRADICTION = 0.01  # of the line's length, at the start
AT_END = 1e-6  # m
STRONGEST = 1e12  # N or W: a bound here or beyond is none
LARGEST_FLEET_ANGLE = 4.0  # degrees, the usual bound for ropes of cranes
LARGEST_LIFT = 1.5  # of a body's weight, by its lines
DRY = 1.25  # times what a body weighs under water, likewise
BOUNDS = {  # of winches: their unit, what happens there, and what to do
    "maximum_tension": ("N", "so that its motor holds no more, and the load may fall", "Lift less"),
    "maximum_power": ("W", "so that its motor gives no more", "Lift slower"),
    "brake_capacity": ("N", "so that its brake slips", "Close it on less"),
}


def bound_findings(scene: Description, reached: Iterable[tuple[float, str]]) -> list[Finding]:
    """Bounds of winches that were reached, by the times (s) and names of events; rates and ends apart."""
    lines, first = winches_of(scene.loads), {name: time for time, name in sorted(reached, reverse=True)}
    return [
        (
            warnings.WinchLimitWarning,
            f"line {name!r}: its winch reached its {bound}, {getattr(line, bound):.4g} {unit}, at t = "
            f"{first[f'{name}.{bound}']:.6g} s, {then}. {fix}, or give it more",
        )
        for name, line in lines.items()
        for bound, (unit, then, fix) in BOUNDS.items()
        if f"{name}.{bound}" in first
    ]


def warn_of_connected(
    title: str, scene: Description, name: str, measured: Mapping[str, Array], time: float
) -> None:
    """Warn of a line that a stage connects at `time` (s) and that is too short for where its ends are."""
    lines = lines_of(scene.loads)
    at = list(lines).index(name)
    length, stretch, tension = (
        float(np.ravel(measured[channel])[at])
        for channel in ("line_unstretched_length", "line_stretch", "line_tension")
    )
    usual = max([LARGEST_CONTRADICTION, *lines[name].strains]) + strains_at_rest(scene).get(name, 0.0)
    if stretch > usual * length:
        warn_caller(
            f"{title}: line {name!r} connects stretched by {stretch:.4g} m, {stretch / length:.3g} of its "
            f"unstretched {length:.6g} m, at t = {time:.6g} s: it pulls with {tension:.4g} N at once. Give "
            f"it {length + stretch:.6g} m, pay out before, or connect it nearer",
            warnings.LineLengthWarning,
        )


def line_findings(
    scene: Description, time: Array, channels: Mapping[str, Array], *, described: bool = True
) -> Iterator[Finding]:
    """All of these in a run; channels left out are not judged, nor lengths where it is not `described`."""
    lines = lines_of(scene.loads)
    given = {
        key: np.asarray(channels[key]).reshape(time.size, len(lines)).T
        for key in ("line_unstretched_length", "line_tension", "line_stretch") if lines and key in channels
    }  # fmt: skip
    if "sheave_fleet_angle" in channels:
        sheaves = [f"{name} {i}" for name, line in lines.items() for i in _turned_at(line)]
        angles = np.degrees(np.asarray(channels["sheave_fleet_angle"])).reshape(time.size, len(sheaves))
        for name, angle in zip(sheaves, angles.T, strict=True):
            for worst, at in peak(angle, above=LARGEST_FLEET_ANGLE):
                yield (
                    warnings.FleetAngleWarning,
                    f"line at sheave {name!r}: leaves the plane of its rim by {worst:.3g} degrees at t = "
                    f"{time[at]:.6g} s, beyond {LARGEST_FLEET_ANGLE:g} degrees; the rope would climb out of "
                    "its groove. Turn the sheave's axis, or put it on a body that swivels",
                )
    if "line_unstretched_length" not in given:
        return
    lengths = given["line_unstretched_length"]
    for line, length in zip(lines.values(), lengths, strict=True):
        if line.winch:
            yield from _met(winch_of(line), line, time, length / line.share)
    for (name, line), tension in zip(lines.items(), given.get("line_tension", ()), strict=False):
        for push, at in peak(-tension, above=0.0) if line.rung == QUASI_STATIC else ():
            yield (
                warnings.PushingLineWarning,
                f"line {name!r}: pushes with {push:.4g} N at t = {time[at]:.6g} s: its stretch is "
                "quasi-static, and follows the tension too late to go slack. Give it rung 'elastic'",
            )
    if "line_stretch" not in given:
        return
    stretches = given["line_stretch"]
    if described and time[0] == 0.0:
        yield from _contradicted(lines, strains_at_rest(scene), lengths[:, 0], stretches[:, 0])
    for (name, line), strain in zip(lines.items(), stretches / lengths, strict=True):
        for worst, at in peak(strain, above=line.strains[-1]) if len(line.strains) else ():
            yield (
                warnings.LineTableWarning,
                f"line {name!r}: is strained by {worst:.4g} at t = {time[at]:.6g} s, and its table ends at "
                f"{line.strains[-1]:.4g}; it went on along its last tangent. Extend the table",
            )


def _turned_at(line: _core.Line) -> list[int]:
    """The points of a line's path at which it lies on a sheave or meets friction."""
    turned = np.zeros(len(line.points), dtype=bool)
    for values, usual in ((line.radii, 0.0), (line.efficiencies, 1.0), (line.frictions, 0.0)):
        if len(values):
            turned |= np.asarray(values) != usual
    return [int(i) for i in np.flatnonzero(turned)]


def strains_at_rest(scene: Description) -> dict[str, float]:
    """The strains of lines with a constant EA that alone carry what hangs on them, by that weight."""
    lines = lines_of(scene.loads)
    return {
        name: weight / falls / lines[name].EA
        for name, (weight, falls) in line_weights(scene).items()
        if not len(lines[name].strains)
    }


def _contradicted(
    lines: Lines, resting: Mapping[str, float], lengths: Array, stretches: Array
) -> Iterator[Finding]:
    """Lines whose described length is not that of their path; a heavy one is the sum of its segments.

    What hangs on a line stretches it at rest, by the strain in `resting`; that is no contradiction.
    """
    wholes: dict[str, list[int]] = {}
    for at, (name, line) in enumerate(lines.items()):
        wholes.setdefault(whole_of(name, line), []).append(at)
    for name, own in wholes.items():
        length, stretch = float(lengths[own].sum()), float(stretches[own].sum())
        segments = [(one, line) for i, (one, line) in enumerate(lines.items()) if i in own]
        at_rest = max(resting.get(one, 0.0) for one, _ in segments)
        tables = [strain for _, line in segments for strain in line.strains]
        usual = max([LARGEST_CONTRADICTION, *tables])  # a cord is meant to be as long as its table
        if -LARGEST_CONTRADICTION * length <= stretch <= (usual + at_rest) * length:
            continue
        state = "stretched" if stretch > 0.0 else "slack"
        yield (
            warnings.LineLengthWarning,
            f"line {name!r}: starts {state} by {abs(stretch):.4g} m, {abs(stretch) / length:.3g} of its "
            f"unstretched {length:.6g} m: its path is {length + stretch:.6g} m long. Correct its length or "
            "its points, or take this as meant where the line starts slack",
        )


def _met(name: str, line: _core.Line, time: Array, length: Array) -> Iterator[Finding]:
    for done, end, at_end in (
        ("hauled in", "minimum_length", length <= line.minimum_length + AT_END),
        ("paid out", "maximum_length", length >= line.maximum_length - AT_END),
    ):
        if at_end.any():
            yield (
                warnings.WinchLimitWarning,
                f"line {name!r}: its winch has {done} to {end}, {getattr(line, end):.6g} m, at t = "
                f"{time[np.argmax(at_end)]:.6g} s, and stops there. Wind less, or give another {end}",
            )
    for rate, at in peak(np.abs(line.rate.evaluate(time)[:, 0]), above=line.maximum_rate):
        yield (
            warnings.WinchLimitWarning,
            f"line {name!r}: its winch is commanded {rate:.4g} m/s at t = {time[at]:.6g} s, beyond its "
            f"maximum_rate of {line.maximum_rate:.4g} m/s, which it keeps. Command less, or give it more",
        )


@once_in_any_sea
def warn_of_line_starts(scene: Description) -> None:
    """Warn of the lines of a scene that starts as it is described."""
    lines = lines_of(scene.loads)
    if not lines:
        return
    paths = {name: laid(line, described_poses(scene)) for name, line in lines.items()}
    tensions = {name: _start_tension(line, paths[name].length) for name, line in lines.items()}
    if all(np.isfinite(tension) for tension in tensions.values()):
        for body in _hung(scene, lines):
            _warn_of_lift(scene.bodies[body], scene.gravity, lines, paths, tensions)
        _warn_of_dry_weights(scene, tensions)
    for name, (weight, falls) in line_weights(scene).items():
        _warn_of_weak_winch(lines[name], weight / max(falls, 1))


def _start_tension(line: _core.Line, path: float) -> float:
    """N, of a path as long (m), without damping."""
    length = float(line.length.evaluate([0.0])[0, 0])
    strain = path / length - 1.0
    if not len(line.strains):
        return max(0.0, float(line.EA) * strain)
    return float(np.interp(strain, line.strains, line.tensions))


def _hung(scene: Description, lines: Lines) -> list[str]:
    """Bodies that lines alone carry; a seat or a free joint does not."""
    seats = {load.joint for load in scene.loads.values() if getattr(load, "kind", None) == "seat"}
    joints = [one for name, one in scene.joints.items() if name not in seats and one.kind != "free"]
    carried = {body for one in joints for body in (one.first, one.second)}
    carried |= {vessel.body for vessel in scene.vessels.values()}
    for load in (one for one in all_loads(scene) if not isinstance(one, _core.Line)):
        carried |= {getattr(load, "first", ""), getattr(load, "second", "")}
    on_lines = dict.fromkeys(body for line in lines.values() for body in line.bodies)
    known = [body for body in on_lines if body in scene.bodies and body not in carried]
    return [body for body in known if scene.bodies[body].gravity]


def _warn_of_lift(
    body: _core.Body, gravity: float, lines: Lines, paths: Mapping[str, Laid], tensions: Mapping[str, float]
) -> None:
    pulls, spans = {}, []
    for name, line in lines.items():
        apart = paths[name].ends - paths[name].starts
        long = np.linalg.norm(apart, axis=1)
        up = apart[:, 2] / np.maximum(long, 1e-300)
        on = np.array([one == body.name for one in line.bodies])
        pulls[name] = tensions[name] * float(up[on[:-1]].sum() - up[on[1:]].sum())
        spans += [float(long.max())] * bool(on.any())  # on which it swings
    weight, lift = body.mass * gravity, sum(pulls.values())
    turned = body.mass * float(np.square(body.velocity).sum()) / max([*spans, 1e-300])
    if weight > 0.0 and lift > LARGEST_LIFT * (weight + turned):
        worst = max(pulls, key=lambda name: pulls[name])
        warn_caller(
            f"body {body.name!r}: its lines start by lifting it with {lift:.4g} N, {lift / weight:.3g} times "
            f"its weight of {weight:.4g} N, most of it line {worst!r}, whose path is "
            f"{paths[worst].length:.6g} m long, and its length "
            f"{float(lines[worst].length.evaluate([0.0])[0, 0]):.6g} m: the load jumps. Correct its length, "
            "or give tension_at_start",
            warnings.LiftedStartWarning,
        )


def _warn_of_dry_weights(scene: Description, tensions: Mapping[str, float]) -> None:
    """Warn of the uppermost lines that start with the weight in air of what hangs on them under water."""
    turns = {name: rotation_matrix(body.quaternion) for name, body in scene.bodies.items()}
    centres = [body.position + turns[name] @ body.center_of_mass for name, body in scene.bodies.items()]
    turned = [body.quaternion for body in scene.bodies.values()]
    poses = {"position": np.array([centres]), "quaternion": np.array([turned])}
    told: set[str] = set()
    for one, bodies in bodies_below(scene):
        if told & set(bodies) or one.top not in tensions:
            continue
        told |= set(bodies)
        weight = sum(scene.bodies[body].mass for body in bodies if scene.bodies[body].gravity) * scene.gravity
        carried = float(carried_by_water(scene, poses, bodies)[0])
        pull = tensions[one.top] * one.falls
        if carried > 0.0 and weight > carried and pull > DRY * (weight - carried):
            wet = next(part.body for part in immersed_parts(scene).values() if part.body in bodies)
            warn_caller(
                f"body {wet!r}: starts under water on line {one.name!r}, which is stretched by {pull:.4g} N; "
                f"water carries {carried:.4g} N of the weight of {weight:.4g} N, so that the load leaps and "
                'the line may go slack. Give start="rest", or a length or tension_at_start for the '
                f"{weight - carried:.4g} N that are left",
                warnings.LiftedStartWarning,
            )


def _warn_of_weak_winch(line: _core.Line, tension: float) -> None:
    """Warn of a winch with a drum that would hold less, N at the rope, at the start or by its brake alone."""
    if not line.winch or line.drum_inertia == 0.0 or tension == 0.0:
        return
    motor, brake = line.maximum_tension, line.brake_capacity
    share = float(np.clip(line.brake.evaluate([0.0])[0, 0], 0.0, 1.0)) if brake else 0.0
    held = (1.0 - share) * motor + share * brake
    both = held if held < STRONGEST else np.inf
    for what, force, then, give in (
        (
            "motor and brake hold {} at the start",
            both,
            "the load falls",
            "maximum_tension and brake_capacity",
        ),
        ("brake holds {}", brake, "it slips when it closes", "brake_capacity"),
        ("motor holds {}", motor, "the load falls when the brake opens", "maximum_tension"),
    ):
        if 0.0 < force < tension:
            warn_caller(
                f"line {line.name!r}: its {what.format(f'{force:.4g} N')}, less than the {tension:.4g} N "
                f"that hang on the rope: {then}. Give {give} in N, enough for it",
                warnings.WinchLimitWarning,
            )
            return
