"""The stages of a lift looked at together before any is run: what is there in each, and what it can meet."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.channels import FIXED, NAMED
from seacrane.description.description import KINDS, LOADS, Some
from seacrane.description.holding import decided
from seacrane.description.loads import lines_of, named, winches_of
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.run.channel_names import derived_coords, missing_names
from seacrane.run.commands import HOLE, Command, Move, check_command, targets
from seacrane.run.stage import Contact, Level, Stage, of_contact
from seacrane.scene.recorded import picks
from seacrane.scene.scene import Scene

TABLES = ("joints", "drivers", *LOADS)
SAMPLES = 4001


def checked_stages(scene: Scene, given: Any) -> tuple[Stage, ...]:
    """The stages, which fit the scene and each other, conditions on contacts as such on their gaps.

    Raises SceneError for names given twice, connections of what is there and releases of what is not,
    commands and conditions of what is not there in their stage.
    """
    stages = tuple(given) if isinstance(given, Iterable) else (given,)
    for one in stages:
        if not isinstance(one, Stage):
            raise SceneError(f"stages hold {shown(one)}; give a list of seacrane.Stage")
    if not stages:
        raise SceneError("stages: there are none; give at least one seacrane.Stage")
    contacts = [name for name, load in scene.loads.items() if isinstance(load, _core.Contact)]
    stages = tuple(
        replace(one, until=tuple(of_contact(each, contacts) for each in one.conditions)) for one in stages
    )
    seen: set[str] = set()
    absent, burst = waiting(stages), dict[str, str]()
    for stage in stages:
        try:
            if stage.name in seen:
                raise SceneError(f"{stage.title}: the name is used twice; names of stages must differ")
            seen.add(stage.name)
            _check(scene, stage, absent, burst)
        except SceneError as error:
            error.name = stage.name
            raise
    return stages


def _check(scene: Scene, stage: Stage, absent: set[str], burst: dict[str, str]) -> None:
    """A stage after those before it, which changes what is absent, and which hoses burst in which stage."""
    _change(scene, stage, absent)
    there = without(scene, absent)
    known = targets(there)
    for name, value in stage.commands.items():
        check_command(stage.title, name, value, known)
        if known[name].attribute == HOLE and burst.setdefault(name, stage.name) != stage.name:
            raise SceneError(
                f"{stage.title}: commands {name!r}, and that hose bursts in stage {burst[name]!r}; leave "
                "one of them out"
            )
    check_limits(stage, there)
    _check_bounds(stage, there)
    _check_names(stage, there)


def waiting(stages: Sequence[Stage]) -> set[str]:
    """What is absent at the start: what a stage connects before any releases it."""
    released: set[str] = set()
    out: set[str] = set()
    for stage in stages:
        released |= set(stage.release)
        out |= set(stage.connect) - released
    return out


def first_scene(scene: Scene, stages: Sequence[Stage]) -> Scene:
    """The scene before the first stage, without what stages connect."""
    out = decided(scene)
    return without(out, waiting(checked_stages(out, stages)))


def _change(scene: Scene, stage: Stage, absent: set[str]) -> None:
    """Carry out a stage's connections on the set of absent ones."""
    for name in stage.release:
        table_of(scene, f"{stage.title} releases", name)
        if name in absent:
            raise SceneError(f"{stage.title}: releases {name!r}, which is not connected then; leave it out")
        absent.add(name)
    for name in stage.connect:
        table_of(scene, f"{stage.title} connects", name)
        if name not in absent:
            raise SceneError(
                f"{stage.title}: connects {name!r}, which is connected already; release it before"
            )
        absent.discard(name)


def _check_names(stage: Stage, there: Scene) -> None:
    """Raise SceneError for conditions on what the scene of the stage does not have."""
    known: dict[str, Collection[str]] = {
        **derived_coords(there), **FIXED,
        "line": lines_of(there.loads), "body": there.bodies, "joint": there.joints, "vessel": there.vessels,
        "actuator": there.actuators, "driver": there.drivers, "joint_coordinate": there.recorded,
        "point": there.points,
        "contact": [name for name, load in there.loads.items() if isinstance(load, _core.Contact)],
    }  # fmt: skip
    for condition in stage.conditions:
        for dim, name in condition.names if isinstance(condition, Level) else ():
            if dim in known and name not in known[dim]:
                has = ", ".join(known[dim]) or "none"
                raise SceneError(
                    f"{stage.title}: waits for {dim} {name!r}, which is not there then; there are {has}"
                )


def table_of(scene: Scene, what: str, name: str) -> str:
    """The table of a connection; a joint goes before what acts on it and bears its name.

    Raises SceneError for a name that is not there, or is that of several elements.
    """
    found = [table for table in TABLES if name in getattr(scene, table)]
    if "joints" in found:
        return "joints"
    if not found:
        known = [key for table in TABLES for key in getattr(scene, table)]
        raise SceneError(
            f"{what}: the scene has no {name!r}; it has {', '.join(known) or 'nothing to connect'}"
        )
    if len(found) > 1:
        kinds = " and ".join(f"a {KINDS[table]}" for table in found)
        raise SceneError(f"{what}: {name!r} is {kinds}; give one of them another name")
    return found[0]


def without(scene: Some, names: Collection[str]) -> Some:
    """The scene without these connections, and without what acts on, records or limits them alone."""
    out = scene.copy()
    for name in names:
        joint = name in out.joints
        for table in TABLES:
            elements = getattr(out, table)
            if not joint or table == "joints":
                elements.pop(name, None)
                continue
            for other in [key for key, one in elements.items() if name in named(one, "joint")]:
                del elements[other]
        for key in [key for key, (on, _) in out.recorded.items() if joint and on == name]:
            del out.recorded[key]
        for key in [key for key, limit in out.ranges.items() if joint and limit.joint == name]:
            del out.ranges[key]
        for key, curves in picks(out).items():
            if any(name == one for pick in curves for dim, one in pick.names.items() if dim in NAMED):
                del out.channels[key]
    states = out.limit_states
    for one in missing_names(out, [state.channel for state in states.values()]) if names else ():
        for state in [key for key, state in states.items() if state.channel == one]:
            del states[state]
    return out


def check_limits(stage: Stage, scene: Scene) -> None:
    """Raise SceneError for conditions on limits that the stage does not have, or that never take hold."""
    limits = {name: load for name, load in scene.loads.items() if isinstance(load, _core.Limit)}
    for condition in stage.conditions:
        if not isinstance(condition, Contact):
            continue
        name = condition.limit
        limit = limits.get(name) or limits.get(name.removesuffix(".minimum").removesuffix(".maximum"))
        if limit is None:
            has = ", ".join(limits) or "none"
            raise SceneError(
                f"{stage.title}: waits for {name!r}, and there is no such limit; there are {has}"
            )
        if limit.kind == "seat" and condition.holds:
            raise SceneError(
                f"{stage.title}: would never end: seat {name!r} lets go and never takes hold again; set the "
                "load down on an end stop of a free joint"
            )


def _check_bounds(stage: Stage, scene: Scene) -> None:
    """Raise SceneError for what is met at once or never, and for rates beyond a winch's `maximum_rate`."""
    bottom = np.inf if scene.waves is None else scene.waves.depth
    for one in stage.conditions:
        if not isinstance(one, Level) or not one.above:
            continue
        if one.channel == "line_tension" and one.value <= 0.0:
            raise SceneError(
                f"{stage.title}: would end at once: it waits for {one.text}, which every line has; "
                "give a tension above 0 N for a line that is taut, or maximum=0 for one that is slack"
            )
        if one.channel == "immersed_depth" and one.value > bottom:
            raise SceneError(
                f"{stage.title}: waits for {one.text}, and the sea is {bottom:g} m deep; wait for "
                "less, or give the sea the depth of the place (SeaState)"
            )
    winches = winches_of(scene.loads)
    for name, value in stage.commands.items():
        if name.endswith(".rate") and name.removesuffix(".rate") in winches:
            _check_rate(stage, name, winches[name.removesuffix(".rate")], value)


def _check_rate(stage: Stage, name: str, line: _core.Line, command: Command) -> None:
    if isinstance(command, Move):
        fastest = 0.0 if command.to is None else abs(command.to)
    elif isinstance(command, _core.Curve):
        longest = stage.duration if stage.duration is not None else stage.maximum_duration
        assert longest is not None
        fastest = float(np.abs(command.evaluate(np.linspace(0.0, longest, SAMPLES))[:, 0]).max())
    else:
        fastest = abs(float(command))
    if fastest > line.maximum_rate:
        raise SceneError(
            f"{stage.title}: command {name!r} reaches {fastest:.6g} m/s, beyond the winch's maximum_rate of "
            f"{line.maximum_rate:g} m/s; command less, or give a larger maximum_rate"
        )
