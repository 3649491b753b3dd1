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
from seacrane.description.loads import lines_of, named, on_winch, winch_of, winches_of
from seacrane.description.pick import Pick
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
    stages = tuple(_with_gaps(stage, contacts) for stage in stages)
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


def _with_gaps(stage: Stage, contacts: Collection[str]) -> Stage:
    until = tuple(of_contact(one, contacts) for one in stage.conditions)
    return stage if until == stage.conditions else replace(stage, until=until)


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
    check_bounds(stage, there)
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


def place_of(stages: Sequence[Stage], first: str | None) -> int:
    """The place of the stage to begin with; SceneError for a name that no stage has."""
    names = [stage.name for stage in stages]
    if first is not None and first not in names:
        raise SceneError(f"first is {shown(first)}; the stages are {', '.join(names)}")
    return 0 if first is None else names.index(first)


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
        if joint:
            _forget(out, name)
        for channel in [key for key, curves in picks(out).items() if _told_of(curves, name)]:
            del out.channels[channel]
    states = out.limit_states
    for one in missing_names(out, [state.channel for state in states.values()]) if names else ():
        for state in [key for key, state in states.items() if state.channel == one]:
            del states[state]
    return out


def _told_of(curves: Iterable[Pick], name: str) -> bool:
    """Whether one of the curves is of an element of this name."""
    return any(name == one for pick in curves for dim, one in pick.names.items() if dim in NAMED)


def _forget(scene: Any, joint: str) -> None:
    for key in [key for key, (on, _) in scene.recorded.items() if on == joint]:
        del scene.recorded[key]
    for key in [key for key, limit in scene.ranges.items() if limit.joint == joint]:
        del scene.ranges[key]


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


def check_bounds(stage: Stage, scene: Scene) -> None:
    """Raise SceneError for what no line or winch of the stage does, whatever it is commanded.

    A line does not push, and a winch stops at its `minimum_length`. Commands stay within its `maximum_rate`.
    What is lowered stops above the seabed.
    """
    lines = lines_of(scene.loads)
    bottom = np.inf if scene.waves is None else scene.waves.depth
    levels = [one for one in stage.conditions if isinstance(one, Level)]
    for one in levels:
        if one.above and one.channel == "line_tension" and one.value <= 0.0:
            raise SceneError(
                f"{stage.title}: would end at once: it waits for {one.text}, which every line has; "
                "give a tension above 0 N for a line that is taut, or maximum=0 for one that is slack"
            )
        if one.above and one.channel == "immersed_depth" and one.value > bottom:
            raise SceneError(
                f"{stage.title}: waits for {one.text}, and the sea is {bottom:g} m deep; wait for "
                "less, or give the sea the depth of the place (SeaState)"
            )
    for one in levels if len(stage.conditions) == 1 else ():
        line = lines.get(dict(one.names).get("line", ""))
        if one.above or line is None:
            continue
        if one.channel == "line_tension" and one.value < 0.0:
            raise SceneError(
                f"{stage.title}: would never end: it waits for {one.text}, and a line does not push; "
                "slack is a tension below 0"
            )
        wound = on_winch(lines, line)
        if one.channel != "line_unstretched_length" or wound is None:
            continue
        if one.value < line.share * wound.minimum_length:
            raise SceneError(
                f"{stage.title}: would never end: it waits for {one.text}, and the winch stops at its "
                f"minimum_length of {wound.minimum_length:g} m; wait for more, or give it a smaller one"
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


def check_lengths(stage: Stage, scene: Scene, lengths: dict[str, float], begin: float) -> None:
    """Raise SceneError for a length of line that no command of the stage leads to.

    Parameters
    ----------
    lengths : dict of str to float
        Unstretched, by line, m, as the stage begins.
    begin : s.
    """
    lines = lines_of(scene.loads)
    for condition in stage.conditions:
        if not isinstance(condition, Level) or condition.channel != "line_unstretched_length":
            continue
        name = dict(condition.names).get("line", "")
        if len(stage.conditions) > 1 or name not in lines:
            continue  # another condition may end it; a line that is not there is told by its channel
        wound = on_winch(lines, lines[name])
        if wound is not None and (wound.tension_gain > 0.0 or wound.drum_inertia > 0.0):
            continue  # its tension, motor or brake may lead it there
        assert stage.maximum_duration is not None
        share = lines[name].share
        reached = _reached(wound or lines[name], lengths[name] / share, begin, stage.maximum_duration)
        least, most = (share * length for length in reached)
        if float(condition.excess(np.array([least, most])).max()) >= -1e-9 * lengths[name]:
            continue
        what = f"{name}.length" if wound is None else f"{winch_of(wound)}.rate"
        raise SceneError(
            f"{stage.title}: would never end: it waits for {condition.text}, and line {name!r} goes from "
            f"{lengths[name]:.6g} m to {least:.6g} m at the least and {most:.6g} m at the most within its "
            f"maximum_duration of {stage.maximum_duration:g} s. Command {what!r} towards it, or give more"
        )


def _reached(line: _core.Line, length: float, begin: float, longest: float) -> tuple[float, float]:
    """The least and the most length that a stage's commands lead to; a lag only delays them."""
    time = np.linspace(begin, begin + longest, SAMPLES)
    if not line.winch:
        lengths = line.length.evaluate(time)[:, 0]
        return float(lengths.min()), float(lengths.max())
    rate = np.clip(line.rate.evaluate(time)[:, 0], -line.maximum_rate, line.maximum_rate)
    paid = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(time))])
    slack = line.lag * float(np.abs(rate).max())  # what the drum goes on by while its rate dies out
    least = max(line.minimum_length, length + float(paid.min()) - slack)
    return least, length + float(paid.max()) + slack
