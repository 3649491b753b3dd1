"""Choices about lines, drives, contacts and small damping."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.accuracy.simpler_scenes import locked
from seacrane.description.description import Description
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, slide_of
from seacrane.description.loads import bodies_of, lines_of, whole_of
from seacrane.description.places import place_of
from seacrane.description.rungs import AUTO, ELASTIC, QUASI_STATIC
from seacrane.description.suspension import hung_loads
from seacrane.errors import SceneError
from seacrane.needs.choice import Choice, by_calls, call
from seacrane.scene.heavy_line import chain_of_segments, on_a_winch, scaled
from seacrane.scene.line_fluid import Wire
from seacrane.scene.scene import Scene

TOUCHING = 0.05  # m: a body this near to a plane, or in it, stands on it


def stiff_slings(scene: Scene) -> Iterator[Choice]:
    """Slings and block welded to the load: the line alone stretches."""
    for hung in hung_loads(scene):
        block, load = hung.suspension.lower[0], hung.load
        slings = _between(scene, block, load)
        if len(slings) > 1 and _carried_by_lines(scene, block, {*slings, *hung.suspension.parts}):
            yield by_calls(
                f"slings and block as one with {load}",
                *(call("remove", name, kind="load") for name in slings),
                call("add_joint", kind="weld", name=f"{block} on {load}", first=load, second=block),
                of=f"slings of {load}",
            )


def quasi_static(scene: Scene) -> Iterator[Choice]:
    """The stretch of elastic lines without its own oscillation; slings of one load together."""
    return _on_rung(scene, (ELASTIC, AUTO), QUASI_STATIC)


def elastic(scene: Scene) -> Iterator[Choice]:
    """What a quasi-static line leaves out: its own oscillation, and slack."""
    return _on_rung(scene, (QUASI_STATIC,), ELASTIC)


def _on_rung(scene: Scene, rungs: tuple[str, ...], rung: str) -> Iterator[Choice]:
    for of, names in _groups(scene):
        if all(scene.loads[name].rung in rungs for name in names):
            calls = (call("replace", name, kind="load", rung=rung) for name in names)
            yield by_calls(f"{of} {rung}", *calls, of=of)


def rigid(scene: Scene) -> Iterator[Choice]:
    """A line in one span as a rod of its length, which pushes too."""
    for hung in hung_loads(scene):
        one = hung.suspension
        line = scene.loads.get(one.name)
        if not isinstance(line, _core.Line) or len(set(line.bodies)) != 2:
            continue
        if whole_of(one.name, line) == one.name:
            ends = one.upper, one.lower
            start, end = (np.round(place_of(scene, body=b, point=p), 9).tolist() for b, p in ends)
            rod = {"first": one.upper[0], "second": one.lower[0], "point": start, "second_point": end}
            yield by_calls(
                f"{_said(scene, one.name)} rigid",
                call("remove", one.name, kind="load"),
                call("add_joint", kind="distance", name=one.name, **rod),
                of=_said(scene, one.name),
            )


def fewer_segments(scene: Scene) -> Iterator[Choice]:
    """A line with mass in half its segments, and in one; none that something else holds at its masses."""
    for name in dict.fromkeys(whole_of(own, line) for own, line in lines_of(scene.loads).items()):
        count = len(segments_of(scene, name))
        for fewer in sorted({max(count // 2, 1), 1} - {count}, reverse=True):
            try:
                with_segments(scene, name, fewer)
            except SceneError:
                continue
            yield Choice(
                name=f"line {name} in {fewer} of {count} segments",
                script=f'scene = needs.with_segments(scene, "{name}", {fewer})',
                made=partial(_in_segments, name=name, segments=fewer),
                of=f"segments of line {name}",
            )


def _in_segments(scene: Scene, *, name: str, segments: int) -> Scene:
    return with_segments(scene, name, segments) if segments_of(scene, name) else scene


def _between(scene: Scene, block: str, load: str) -> list[str]:
    """The lines from one body to the other."""
    return [name for name, line in lines_of(scene.loads).items() if list(line.bodies) == [block, load]]


def _carried_by_lines(scene: Scene, block: str, known: set[str]) -> bool:
    """Whether nothing but these lines acts on a body."""
    others = [load for load in scene.all_loads() if load.name not in known]
    jointed = any(block in (joint.first, joint.second) for joint in scene.joints.values())
    return (
        block in scene.bodies and not jointed and not any(block in bodies_of(o, scene.joints) for o in others)
    )


def _groups(scene: Scene) -> Iterator[tuple[str, list[str]]]:
    """Lines by what they are called: slings between two bodies together, else each; none of one with mass."""
    lines = lines_of(scene.loads)
    groups: dict[str, list[str]] = {}
    for name, line in lines.items():
        if whole_of(name, line) == name:
            groups.setdefault(_said(scene, name), []).append(name)
    yield from groups.items()


def _said(scene: Scene, name: str) -> str:
    """How a line is called."""
    line = scene.loads[name]
    slings = _between(scene, *line.bodies) if len(line.bodies) == 2 else []
    if len(slings) < 2:
        return f"line {name}"
    first, last = line.bodies
    return f"slings of {last}" if first in scene.bodies else f"lines from {first} to {last}"


def held_oil(scene: Scene) -> Iterator[Choice]:
    """Hydraulic cylinders that hold their stroke, each held by a driver instead."""
    held = {
        name: slide
        for name, one in hydraulic_cylinders(scene).items()
        if (slide := slide_of(scene, one)) is not None and _is_still(one.reference)
    }
    if held:
        removed = (call("remove", name, kind="load") for name in held)
        added = (call("add_driver", slide, curve=0.0) for slide in held.values())
        yield by_calls(f"cylinders held without oil: {', '.join(held)}", *removed, *added, of="drives")


def _is_still(curve: _core.Curve) -> bool:
    pieces = curve.to_pieces()
    return len(pieces["starts"]) == 1 and not np.any(np.reshape(pieces["coefficients"], (-1, 6))[:, 1:])


def held_crane(scene: Scene) -> Iterator[Choice]:
    """Controlled coordinates held where they start."""
    if scene.actuators:
        yield Choice(
            name="crane held where it starts", script="scene = needs.locked(scene)", made=locked, of="drives"
        )


def no_air_drag(scene: Scene) -> Iterator[Choice]:
    """Of each body, in still air."""
    for name, load in scene.loads.items():
        if isinstance(load, _core.FlowForce) and not np.any(load.speed.to_pieces()["coefficients"]):
            yield without(f"no air drag on {load.body}", name, of=f"air drag of {load.body}")


def no_wind(scene: Scene) -> Iterator[Choice]:
    """On each body that wind or current loads by coefficients."""
    for name, load in scene.loads.items():
        if isinstance(load, _core.FlowForce) and np.any(load.speed.to_pieces()["coefficients"]):
            yield without(f"no {name}", name, of=name)


def no_pendulum_damping(scene: Scene) -> Iterator[Choice]:
    """Of each load's swing."""
    for name, load in scene.loads.items():
        if isinstance(load, _core.PendulumDamping):
            yield without(f"no pendulum damping of {load.second}", name, of=f"damping of {load.second}")


def more_pendulum_damping(scene: Scene) -> Iterator[Choice]:
    """The usual damping of a load whose swing has none."""
    damped = {load.second for load in scene.loads.values() if isinstance(load, _core.PendulumDamping)}
    for hung in hung_loads(scene):
        if hung.load not in damped:
            first, point = hung.suspension.upper
            ends = {"first": first, "first_point": tuple(map(float, point)), "second": hung.load}
            yield by_calls(
                f"pendulum damping of {hung.load}",
                call("add_pendulum_damping", f"{hung.load} swing", **ends),
                of=f"damping of {hung.load}",
            )


def without(name: str, load: str, *, of: str) -> Choice:
    """The choice that takes a load out of a scene."""
    return by_calls(name, call("remove", load, kind="load"), of=of)


def no_contact(scene: Scene) -> Iterator[Choice]:
    """Without one of the contacts."""
    for name in _contacts(scene):
        yield without(f"no contact {name}", name, of=f"contact {name}")


def welded_contact(scene: Scene) -> Iterator[Choice]:
    """A body that stands on a plane held by a seat until it is lifted off."""
    for name, one in _contacts(scene).items():
        jointed = any(one.body in (joint.first, joint.second) for joint in scene.joints.values())
        if one.surface == "plane" and not jointed and _stands(scene, one):
            place, axis = _foot(scene, one)
            weld = {"first": one.on, "second": one.body, "point": place, "axis": axis}
            yield by_calls(
                f"seat in place of contact {name}",
                call("remove", name, kind="load"),
                call("add_joint", name, kind="weld", **weld),
                call("add_stop", name),
                of=f"contact {name}",
            )


def _contacts(scene: Scene) -> dict[str, _core.Contact]:
    return {name: load for name, load in scene.loads.items() if isinstance(load, _core.Contact)}


def _stands(scene: Scene, one: _core.Contact) -> bool:
    place, axis = _foot(scene, one)
    heights = [
        float(np.dot(place_of(scene, body=one.body, point=p) - np.array(place), axis)) for p in one.points
    ]
    return max(heights) < TOUCHING


def _foot(scene: Scene, one: _core.Contact) -> tuple[list[float], list[float]]:
    """A place on the plane and the axis away from it, inertial frame."""
    origin = place_of(scene, body=one.on, point=one.place)
    tip = place_of(scene, body=one.on, point=np.asarray(one.place) + np.asarray(one.axes)[:, 2])
    middle = np.mean([place_of(scene, body=one.body, point=p) for p in one.points], axis=0)
    axis = tip - origin
    foot = middle - np.dot(middle - origin, axis) * axis
    return np.round(foot, 9).tolist(), np.round(axis, 12).tolist()


OF_THE_LINE = (
    "name", "bodies", "points", "EA", "length", "damping_ratio", "mass", "rung", "settling", "paid_out_by",
    "share",
)  # fmt: skip
MADE = ("winding", "water", "drag")  # of each segment, with the line: after its name


def with_segments(scene: Scene, name: str, segments: int) -> Scene:
    """The scene with a line with mass in so many segments, from its rest shape between the same ends.

    Raises SceneError for a line that is none with mass, and one at whose masses there is something else, such
    as a seabed.
    """
    chain = segments_of(scene, name)
    if not chain:
        raise SceneError(f"line {name!r}: is no line with mass of scene {scene.name!r}")
    first, length = chain[0], chain[0].length
    start = float(length.evaluate([0.0])[0, 0])
    wound = not first.paid_out_by and f"{name}.1 winding" in scene.loads
    ends = [_end(scene, chain[0], 0, f"{name}.first"), _end(scene, chain[-1], 1, f"{name}.last")]
    around = Wire.around(scene.loads.get(f"{name}.1 water", scene.loads.get(f"{name}.1 drag")))
    wire = Wire(mass_per_length=first.mass / start, segments=segments, **around)
    out = scene.copy()
    _remove(out, name, chain)
    chain_of_segments(
        out, name, [body for body, _ in ends], [point for _, point in ends], wire, EA=first.EA,
        length=scaled(length, len(chain)) if wound else start * len(chain),
        damping_ratio=first.damping_ratio, rung=first.rung, settling=first.settling,
    )  # fmt: skip
    if first.paid_out_by:
        on_a_winch(out, name, _winch(first))
    return out


def segments_of(scene: Description, name: str) -> list[_core.Line]:
    """The segments of a line with mass in their order; none of another line."""
    return [line for own, line in lines_of(scene.loads).items() if own != name == whole_of(own, line)]


def _end(scene: Description, segment: _core.Line, side: int, tied: str) -> tuple[str, Any]:
    """The body that an end of the line is on, and where in its coordinates, m."""
    if segment.bodies[side] != tied:
        return segment.bodies[side], segment.points[side]
    return scene.joints[tied].first, scene.joints[tied].first_frame.point


def _winch(segment: _core.Line) -> dict[str, Any]:
    """What the first segment has of the line's winch."""
    return {key: value for key, value in segment.__getstate__().items() if key not in OF_THE_LINE}


def _remove(scene: Scene, name: str, chain: list[_core.Line]) -> None:
    for one in chain:
        for load in (*(f"{one.name} {kind}" for kind in MADE), one.name):
            if load in scene.loads:
                scene.remove(load, kind="load")
    for body in (f"{name}.first", f"{name}.last", *(one.name for one in chain[:-1])):
        if body in scene.joints:
            scene.remove(body, kind="joint")
        if body in scene.bodies:
            scene.remove(body, kind="body")
