"""Choices about lines: the rung of each, and slings and block as one with the load."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from seacrane import _core
from seacrane.description.loads import bodies_of, lines_of, whole_of
from seacrane.description.places import place_of
from seacrane.description.rungs import AUTO, ELASTIC, QUASI_STATIC, with_rungs
from seacrane.description.suspension import Suspension, hung_loads
from seacrane.errors import SceneError
from seacrane.needs.choice import Choice
from seacrane.scene.line_segments import segments_of, with_segments
from seacrane.scene.scene import Scene


def stiff_slings(scene: Scene) -> Iterator[Choice]:
    """Slings and block welded to the load: the line alone stretches."""
    for hung in hung_loads(scene):
        block, load = hung.suspension.lower[0], hung.load
        slings = _between(scene, block, load)
        if len(slings) > 1 and _carried_by_lines(scene, block, {*slings, *hung.suspension.parts}):
            yield Choice(
                name=f"slings and block as one with {load}",
                script=f'for name in {slings!r}:\n    scene.remove(name, kind="load")\n'
                f'scene.add_joint(kind="weld", name="{block} on {load}", first="{load}", second="{block}")',
                made=partial(_welded, slings=slings, block=block, load=load),
                of=f"slings of {load}",
            )


def quasi_static(scene: Scene) -> Iterator[Choice]:
    """The stretch of elastic lines without its own oscillation; slings of one load together."""
    for of, names in _groups(scene):
        if all(scene.loads[name].rung in (ELASTIC, AUTO) for name in names):
            yield Choice(
                name=f"{of} quasi-static",
                script=f'for name in {names!r}:\n    scene.replace(name, kind="load", rung="{QUASI_STATIC}")',
                made=partial(_on_rung, names=names, rung=QUASI_STATIC),
                of=of,
            )


def rigid(scene: Scene) -> Iterator[Choice]:
    """A line in one span as a rod of its length, which pushes too."""
    for hung in hung_loads(scene):
        one = hung.suspension
        line = scene.loads.get(one.name)
        if (
            isinstance(line, _core.Line)
            and len(set(line.bodies)) == 2
            and whole_of(one.name, line) == one.name
        ):
            yield Choice(
                name=f"{_said(scene, one.name)} rigid",
                script=_rod_script(scene, one),
                made=partial(_as_rod, name=one.name),
                of=_said(scene, one.name),
            )


def elastic(scene: Scene) -> Iterator[Choice]:
    """What a quasi-static line leaves out: its own oscillation, and slack."""
    for of, names in _groups(scene):
        if all(scene.loads[name].rung == QUASI_STATIC for name in names):
            yield Choice(
                name=f"{of} elastic",
                script=f'for name in {names!r}:\n    scene.replace(name, kind="load", rung="{ELASTIC}")',
                made=partial(_on_rung, names=names, rung=ELASTIC),
                of=of,
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


def _welded(scene: Scene, *, slings: Sequence[str], block: str, load: str) -> Scene:
    out = scene.copy()
    for name in slings:
        out.remove(name, kind="load")
    out.add_joint(kind="weld", name=f"{block} on {load}", first=load, second=block)
    return out


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


def _on_rung(scene: Scene, *, names: Sequence[str], rung: str) -> Scene:
    return with_rungs(scene, {name: rung for name in names if name in scene.loads})


def _ends(scene: Scene, one: Suspension) -> list[list[float]]:
    """Where a suspension begins and ends as described, m, inertial frame."""
    return [np.round(place_of(scene, body=b, point=p), 9).tolist() for b, p in (one.upper, one.lower)]


def _rod_script(scene: Scene, one: Suspension) -> str:
    start, end = _ends(scene, one)
    return (
        f'scene.remove("{one.name}", kind="load")\n'
        f'scene.add_joint(kind="distance", name="{one.name}", first="{one.upper[0]}", '
        f'second="{one.lower[0]}", point={start}, second_point={end})'
    )


def _as_rod(scene: Scene, *, name: str) -> Scene:
    one = next((hung.suspension for hung in hung_loads(scene) if hung.suspension.name == name), None)
    if one is None or name not in scene.loads:
        return scene
    start, end = _ends(scene, one)
    out = scene.copy()
    out.remove(name, kind="load")
    out.add_joint(
        kind="distance", name=name, first=one.upper[0], second=one.lower[0], point=start, second_point=end
    )
    return out
