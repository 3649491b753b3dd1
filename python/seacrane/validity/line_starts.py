"""Lines that start with more than the weight of what they hold, and winches that hold less."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.line_path import Laid, described_poses, laid
from seacrane.description.loads import lines_of
from seacrane.description.once import once_in_any_sea
from seacrane.description.suspension import bodies_below, line_weights
from seacrane.description.wet_parts import carried_by_water, immersed_parts
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import rotation_matrix
from seacrane.validity.line_checks import STRONGEST
from seacrane.warnings import LiftedStartWarning, WinchLimitWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
LARGEST_LIFT = 1.5  # of a body's weight, by its lines
DRY = 1.25  # times what a body weighs under water, likewise


@once_in_any_sea
def warn_of_line_starts(scene: Description) -> None:
    """Warn of the lines of a scene that starts as it is described."""
    lines = lines_of(scene.loads)
    if not lines:
        return
    paths = {name: laid(line, described_poses(scene)) for name, line in lines.items()}
    tensions = {name: start_tension(line, paths[name].length) for name, line in lines.items()}
    if all(np.isfinite(tension) for tension in tensions.values()):
        for body in _hung(scene, lines):
            _warn_of_lift(scene, body, lines, paths, tensions)
        _warn_of_dry_weights(scene, lines, tensions)
    weights = line_weights(scene)
    for name, line in lines.items():
        weight, falls = weights.get(name, (0.0, 1))
        for text in _too_weak(line, weight / max(falls, 1)):
            warn_caller(text, WinchLimitWarning)


def start_tension(line: _core.Line, path: float) -> float:
    """N, of a path as long (m), without damping."""
    length = float(line.length.evaluate([0.0])[0, 0])
    strain = path / length - 1.0
    if not len(line.strains):
        return max(0.0, float(line.EA) * strain)
    return float(np.interp(strain, line.strains, line.tensions))


def _hung(scene: Description, lines: dict[str, _core.Line]) -> list[str]:
    """Bodies that lines alone carry; a seat or a free joint does not."""
    seats = {load.joint for load in scene.loads.values() if getattr(load, "kind", None) == "seat"}
    joints = [one for name, one in scene.joints.items() if name not in seats and one.kind != "free"]
    carried = {body for one in joints for body in (one.first, one.second)}
    carried |= {vessel.body for vessel in scene.vessels.values()}
    for load in (one for one in scene.all_loads() if not isinstance(one, _core.Line)):
        carried |= {getattr(load, "first", ""), getattr(load, "second", "")}
    on_lines = dict.fromkeys(body for line in lines.values() for body in line.bodies)
    known = [body for body in on_lines if body in scene.bodies and body not in carried]
    return [body for body in known if scene.bodies[body].gravity]


def _warn_of_lift(
    scene: Description,
    body: str,
    lines: dict[str, _core.Line],
    paths: dict[str, Laid],
    tensions: dict[str, float],
) -> None:
    pulls = {name: tensions[name] * _upwards(line, paths[name], body) for name, line in lines.items()}
    one = scene.bodies[body]
    weight, lift = one.mass * scene.gravity, sum(pulls.values())
    turned = one.mass * float(np.square(one.velocity).sum()) / _longest(body, lines, paths)
    if weight > 0.0 and lift > LARGEST_LIFT * (weight + turned):
        worst = max(pulls, key=lambda name: pulls[name])
        warn_caller(
            f"body {body!r}: its lines start by lifting it with {lift:.4g} N, {lift / weight:.3g} times its "
            f"weight of {weight:.4g} N, most of it line {worst!r}, whose path is {paths[worst].length:.6g} m "
            f"long, and its length {float(lines[worst].length.evaluate([0.0])[0, 0]):.6g} m: the load jumps. "
            "Correct its length, or give tension_at_start",
            LiftedStartWarning,
        )


def _warn_of_dry_weights(
    scene: Description, lines: dict[str, _core.Line], tensions: dict[str, float]
) -> None:
    """Warn of the uppermost lines that start with the weight in air of what hangs on them under water."""
    told: set[str] = set()
    for one, bodies in bodies_below(scene):
        if told & set(bodies) or one.top not in lines:
            continue
        told |= set(bodies)
        weight = sum(scene.bodies[body].mass for body in bodies if scene.bodies[body].gravity) * scene.gravity
        carried = float(carried_by_water(scene, _described(scene), bodies)[0])
        pull = tensions[one.top] * one.falls
        if carried > 0.0 and weight > carried and pull > DRY * (weight - carried):
            wet = next(part.body for part in immersed_parts(scene).values() if part.body in bodies)
            warn_caller(
                f"body {wet!r}: starts under water on line {one.name!r}, which is stretched by {pull:.4g} N; "
                f"water carries {carried:.4g} N of the weight of {weight:.4g} N, so that the load leaps and "
                'the line may go slack. Give start="rest", or a length or tension_at_start for the '
                f"{weight - carried:.4g} N that are left",
                LiftedStartWarning,
            )


def _described(scene: Description) -> dict[str, Array]:
    """Poses as channels have them, at one output."""
    turns = {name: rotation_matrix(body.quaternion) for name, body in scene.bodies.items()}
    centres = [body.position + turns[name] @ body.center_of_mass for name, body in scene.bodies.items()]
    turned = [body.quaternion for body in scene.bodies.values()]
    return {"position": np.array([centres]), "quaternion": np.array([turned])}


def _longest(body: str, lines: dict[str, _core.Line], paths: dict[str, Laid]) -> float:
    """Span (m) of the lines at a body, on which it swings."""
    spans = [
        np.linalg.norm(paths[name].ends - paths[name].starts, axis=1).max()
        for name, line in lines.items()
        if body in line.bodies
    ]
    return max(float(max(spans)), 1e-300)


def _upwards(line: _core.Line, path: Laid, body: str) -> float:
    """Upward pull on a body by 1 N of tension."""
    apart = path.ends - path.starts
    up = apart[:, 2] / np.maximum(np.linalg.norm(apart, axis=1), 1e-300)
    on = np.array([one == body for one in line.bodies])
    return float(up[on[:-1]].sum() - up[on[1:]].sum())


def _too_weak(line: _core.Line, tension: float) -> Iterator[str]:
    """What a winch with a drum would hold less than, N at the rope, at the start or with its brake closed."""
    if not line.winch or line.drum_inertia == 0.0 or tension == 0.0:
        return
    share = float(np.clip(line.brake.evaluate([0.0])[0, 0], 0.0, 1.0)) if line.brake_capacity else 0.0
    held = (1.0 - share) * line.maximum_tension + share * line.brake_capacity
    if 0.0 < held < min(tension, STRONGEST):
        yield (
            f"line {line.name!r}: its motor and brake hold {held:.4g} N at the start, less than the "
            f"{tension:.4g} N that hang on the rope: the load falls. Give maximum_tension and brake_capacity "
            "in N, enough for it"
        )
    elif 0.0 < line.brake_capacity < tension:
        yield (
            f"line {line.name!r}: its brake holds {line.brake_capacity:.4g} N, less than the {tension:.4g} N "
            "that hang on the rope: it slips when it closes. Give brake_capacity in N, enough for it"
        )
    elif 0.0 < line.maximum_tension < tension:
        yield (
            f"line {line.name!r}: its motor holds {line.maximum_tension:.4g} N, less than the "
            f"{tension:.4g} N that hang on the rope: the load falls when the brake opens. Give "
            "maximum_tension in N, enough for it"
        )
