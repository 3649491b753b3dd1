"""The choices of modelling in a scene: each a change to what is simpler, or to what the scene leaves out."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from operator import methodcaller
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.accuracy import simpler_scenes as simpler
from seacrane.crane.parts import SWING_RATIO
from seacrane.description.databases import source_of
from seacrane.description.description import all_loads
from seacrane.description.given import given_vessels
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, slide_of
from seacrane.description.loads import bodies_of, changed, lines_of, whole_of
from seacrane.description.places import place_of
from seacrane.description.rungs import AUTO, ELASTIC, QUASI_STATIC
from seacrane.description.suspension import hung_loads
from seacrane.description.waves import Waves
from seacrane.description.wet_parts import immersed_parts
from seacrane.hydro import HydroDatabase
from seacrane.scene.scene import Scene
from seacrane.scene.sea import as_put

LOOSER = 0.05  # limit of a memory by motion
MORE_WAVES = 1.2  # times the waves at a part: what a hull beside may make of them
Tried = Callable[[Scene], Iterator["Choice"]]


@dataclass(frozen=True, kw_only=True)
class Choice:
    """A change of a scene to what is simpler, or to what it leaves out.

    Attributes
    ----------
    name : What the scene is after it, such as "no air drag on load".
    script : str, lines of Python that do the same to a described `scene`, with `answers` of `seacrane`.
    made : callable
        The changed copy of a scene. What it changes may have gone by another choice: it then does nothing.
    of : str
        What it is about: of choices about the same, one at most is taken.
    """

    name: str
    script: str
    made: Callable[[Scene], Scene]
    of: str


Call = tuple[str, tuple[Any, ...], dict[str, Any]]  # a method of a scene, and what it is given


def call(method: str, *given: Any, **named: Any) -> Call:
    """A call of a scene's method, as `by_calls` takes it."""
    return method, given, named


def by_calls(name: str, *calls: Call, of: str) -> Choice:
    """The choice that such calls make, which are its script; nothing, where a load that they name is gone."""
    lines = []
    for method, given, named in calls:
        told = [*map(repr, given), *(f"{key}={value!r}" for key, value in named.items())]
        lines.append(f"scene.{method}({', '.join(told)})")
    return Choice(name=name, script="\n".join(lines), made=partial(_called, calls=calls), of=of)


def _called(scene: Scene, *, calls: Sequence[Call]) -> Scene:
    loads = [given[0] for _, given, named in calls if named.get("kind") == "load"]
    if not scene.loads.keys() >= {*loads}:
        return scene
    out = scene.copy()
    for method, given, named in calls:
        getattr(out, method)(*given, **named)
    return out


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


def _between(scene: Scene, block: str, load: str) -> list[str]:
    """The lines from one body to the other."""
    return [name for name, line in lines_of(scene.loads).items() if list(line.bodies) == [block, load]]


def _carried_by_lines(scene: Scene, block: str, known: set[str]) -> bool:
    """Whether nothing but these lines acts on a body."""
    others = [load for load in all_loads(scene) if load.name not in known]
    jointed = any(block in (joint.first, joint.second) for joint in scene.joints.values())
    return (
        block in scene.bodies and not jointed and not any(block in bodies_of(o, scene.joints) for o in others)
    )


def quasi_static(scene: Scene) -> Iterator[Choice]:
    """The stretch of elastic lines without its own oscillation; slings of one load together."""
    return _on_rung(scene, (ELASTIC, AUTO), QUASI_STATIC)


def elastic(scene: Scene) -> Iterator[Choice]:
    """What a quasi-static line leaves out: its own oscillation, and slack."""
    return _on_rung(scene, (QUASI_STATIC,), ELASTIC)


def _on_rung(scene: Scene, rungs: tuple[str, ...], rung: str) -> Iterator[Choice]:
    """By what lines are called: slings between two bodies together, else each; none of one with mass."""
    groups: dict[str, list[str]] = {}
    for name, line in lines_of(scene.loads).items():
        if whole_of(name, line) == name:
            groups.setdefault(_said(scene, name), []).append(name)
    for of, names in groups.items():
        if all(scene.loads[name].rung in rungs for name in names):
            calls = (call("replace", name, kind="load", rung=rung) for name in names)
            yield by_calls(f"{of} {rung}", *calls, of=of)


def _said(scene: Scene, name: str) -> str:
    """How a line is called."""
    line = scene.loads[name]
    slings = _between(scene, *line.bodies) if len(line.bodies) == 2 else []
    if len(slings) < 2:
        return f"line {name}"
    first, last = line.bodies
    return f"slings of {last}" if first in scene.bodies else f"lines from {first} to {last}"


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


def held_oil(scene: Scene) -> Iterator[Choice]:
    """Hydraulic cylinders that hold their stroke, each held by a driver instead."""
    held = {
        name: slide
        for name, one in hydraulic_cylinders(scene).items()
        if (slide := slide_of(scene, one)) is not None and _is_constant(one.reference)
    }
    if held:
        removed = (call("remove", name, kind="load") for name in held)
        added = (call("add_driver", slide, curve=0.0) for slide in held.values())
        yield by_calls(f"cylinders held without oil: {', '.join(held)}", *removed, *added, of="drives")


def _is_constant(curve: _core.Curve) -> bool:
    pieces = curve.to_pieces()
    return len(pieces["starts"]) == 1 and not np.any(np.reshape(pieces["coefficients"], (-1, 6))[:, 1:])


def held_crane(scene: Scene) -> Iterator[Choice]:
    """Controlled coordinates held where they start."""
    if scene.actuators:
        yield Choice(
            name="crane held where it starts",
            script="scene = answers.locked(scene)",
            made=simpler.locked,
            of="drives",
        )


def without_loads(scene: Scene) -> Iterator[Choice]:
    """Without one of the small dampings, of the winds by coefficients, or of the contacts."""
    for name, load in scene.loads.items():
        match load:
            case _core.FlowForce() if not np.any(load.speed.to_pieces()["coefficients"]):
                told = f"no air drag on {load.body}", f"air drag of {load.body}"
            case _core.FlowForce():
                told = f"no {name}", name
            case _core.PendulumDamping():
                told = f"no pendulum damping of {load.second}", f"damping of {load.second}"
            case _core.Contact():
                told = f"no contact {name}", f"contact {name}"
            case _:
                continue
        yield by_calls(told[0], call("remove", name, kind="load"), of=told[1])


def more_pendulum_damping(scene: Scene) -> Iterator[Choice]:
    """The usual damping of a load whose swing has none."""
    damped = {load.second for load in scene.loads.values() if isinstance(load, _core.PendulumDamping)}
    for hung in hung_loads(scene):
        if hung.load not in damped:
            first, point = hung.suspension.upper
            ends = {"first": first, "first_point": tuple(map(float, point)), "second": hung.load}
            yield by_calls(
                f"pendulum damping of {hung.load}",
                call("add_spring", f"{hung.load} swing", **ends, damping_ratio=SWING_RATIO),
                of=f"damping of {hung.load}",
            )


def fewer_waves(scene: Scene) -> Iterator[Choice]:
    """The strongest components alone."""
    waves = scene.waves
    if waves is None or not (waves.hulls or immersed_parts(scene)):
        return
    for share in simpler.FEWER:
        count = int(np.ceil(share * len(waves.omega)))
        if count < len(waves.omega):
            name = f"{count} of {len(waves.omega)} wave components"
            script = f"answers.strongest(scene.waves, {count})"
            yield _on_waves(name, script, partial(simpler.strongest, count=count), "wave components")


def _on_waves(name: str, script: str, change: Callable[[Waves], Waves], of: str) -> Choice:
    made = partial(_with_waves, change=change)
    return Choice(name=name, script=f"scene.waves = {script}", made=made, of=of)


def _with_waves(scene: Scene, *, change: Callable[[Waves], Waves]) -> Scene:
    return scene if scene.waves is None else scene.copy(waves=change(scene.waves))


def coarse_table(scene: Scene) -> Iterator[Choice]:
    """Loads of waves from a table with a wide bound, in place of a fine one or of the sum itself."""
    waves = scene.waves
    if waves is None or not waves.has_tables():
        return
    if waves.evaluation == "exact" or waves.relative_bound < simpler.BOUND:
        script = f'dataclasses.replace(scene.waves, evaluation="table", relative_bound={simpler.BOUND!r})'
        change = partial(replace, evaluation="table", relative_bound=simpler.BOUND)
        yield _on_waves(f"wave table within {simpler.BOUND:g}", script, change, "wave table")


def no_drift(scene: Scene) -> Iterator[Choice]:
    """No slow drift of a vessel."""
    for body, hull in {} if scene.waves is None else scene.waves.hulls.items():
        none = {"drift": None, "drift_by_heading": None}
        if any(getattr(hull, key) is not None for key in none):
            script = f'scene.waves.changed("{body}", drift=None, drift_by_heading=None)'
            change = methodcaller("changed", body, **none)
            yield _on_waves(f"no slow drift of {body}", script, change, f"slow drift of {body}")


def more_drift(scene: Scene) -> Iterator[Choice]:
    """The slow drift that a database has, and the scene leaves out."""
    for body, hull in {} if scene.waves is None else scene.waves.hulls.items():
        source = source_of(scene, body)
        if hull.drift is None and isinstance(source, HydroDatabase) and source.drift is not None:
            assert scene.waves is not None
            words = as_put(scene, scene.waves, body) | {"drift": True}
            words = {key: one for key, one in words.items() if one is not None}
            yield by_calls(f"slow drift of {body}", call("add_sea", **words), of=f"slow drift of {body}")


def less_memory(scene: Scene) -> Iterator[Choice]:
    """Fewer states of the fluid memory of the scene's one vessel, and none."""
    kind = _memory_of_one(scene)
    if kind in (None, "none"):
        return
    if _is_known(scene) and kind != "by-motion":
        yield _memory("by-motion")
    if _is_known(scene):
        yield _memory("by-motion", LOOSER)
    yield _memory("none")


def more_memory(scene: Scene) -> Iterator[Choice]:
    """A fluid memory where the scene has none."""
    if _memory_of_one(scene) == "none" and _is_known(scene):
        yield _memory("by-motion")


def _memory(kind: str, level: float | None = None) -> Choice:
    name = "no fluid memory" if kind == "none" else f"fluid memory {kind}"
    more = "" if level is None else f", level={level:g}"
    return Choice(
        name=name if level is None else f"{name} within {100 * level:g} %",
        script=f'scene = answers.with_memory(scene, "{kind}"{more})',
        made=partial(simpler.with_memory, kind=kind, level=level),
        of="fluid memory",
    )


def _memory_of_one(scene: Scene) -> str | None:
    return simpler.memory_name(scene) if len(scene.vessels) == 1 and not given_vessels(scene) else None


def _is_known(scene: Scene) -> bool:
    return all(isinstance(vessel.database, HydroDatabase) for vessel in scene.vessels.values())


def no_coupling(scene: Scene) -> Iterator[Choice]:
    """Vessels of a group that do not feel each other's motions, each with a memory of its own."""
    for name, group in scene.groups.items():
        yield Choice(
            name=f"no coupling of {' and '.join(group.vessels)}",
            script=f'scene = answers.uncoupled(scene, "{name}")',
            made=partial(uncoupled, name=name),
            of=f"coupling of group {name}",
        )


def uncoupled(scene: Scene, name: str) -> Scene:
    """The scene whose vessels of a group move as if the others stood still; waves are those beside them."""
    if name not in scene.groups:
        return scene
    group = scene.groups[name]
    out = scene.copy()
    out.remove(name, kind="group")
    for vessel in group.vessels if len(group.memory) else ():
        out = simpler.with_memory(out, "by-motion", vessel=vessel)
    return out


def no_waves_on_parts(scene: Scene) -> Iterator[Choice]:
    """Parts in still water."""
    if scene.waves is not None and any(part.wave_factor for part in immersed_parts(scene).values()):
        yield _factor("no waves on parts in water", 0.0)


def waves_on_parts(scene: Scene) -> Iterator[Choice]:
    """Waves at parts that see none, or higher ones, as a hull beside them makes."""
    parts = immersed_parts(scene)
    if scene.waves is None or not parts:
        return
    if any(part.wave_factor == 0.0 for part in parts.values()):
        yield _factor("waves on all parts in water", 1.0)
    else:
        yield _factor(f"wave_factor {MORE_WAVES:g} at parts in water", MORE_WAVES)


def _factor(name: str, factor: float) -> Choice:
    script = (
        "for name, load in list(scene.loads.items()):\n"
        '    if type(load).__name__ == "ImmersedPart":\n'
        f'        scene.replace(name, kind="load", wave_factor={factor:g})'
    )
    made = partial(_with_factor, factor=factor)
    return Choice(name=name, script=script, made=made, of="waves on parts in water")


def _with_factor(scene: Scene, *, factor: float) -> Scene:
    out = scene.copy()
    for name, part in immersed_parts(scene).items():
        out.loads[name] = changed(part, wave_factor=factor)
    return out


def scatter(scene: Scene) -> Iterator[Choice]:
    """More and less added mass and drag than described: how well coefficients are known."""
    if not simpler.shapes_in(scene):
        return
    for case, (coefficient, _) in simpler.CASES.items():
        shares = sorted({simpler.SHARES[shape][coefficient] for shape in simpler.shapes_in(scene)})
        told = " to ".join(f"{100 * share:g}" for share in dict.fromkeys([shares[0], shares[-1]]))
        yield Choice(
            name=f"{case} in water, by {told} %",
            script=f'scene = answers.scattered(scene, "{case}")',
            made=partial(simpler.scattered, case=case),
            of="coefficients in water",
        )


SIMPLER: tuple[Tried, ...] = (
    stiff_slings, quasi_static, rigid, fewer_waves, coarse_table, less_memory, no_coupling, no_drift,
    without_loads, no_waves_on_parts, held_oil, held_crane,
)  # fmt: skip
MISSING: tuple[Tried, ...] = (
    more_memory, more_drift, elastic, more_pendulum_damping, waves_on_parts, scatter,
)  # fmt: skip


def choices_of(scene: Scene) -> list[Choice]:
    """What may be made simpler in a scene."""
    return [choice for tried in SIMPLER for choice in tried(scene)]


def missing_from(scene: Scene) -> list[Choice]:
    """What a scene leaves out, or knows badly."""
    return [choice for tried in MISSING for choice in tried(scene)]
