"""The stages of a lift looked at together, before any of them is run."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace
from typing import Any

from seacrane import _core
from seacrane.description.channels import FIXED
from seacrane.description.holding import decided
from seacrane.description.loads import lines_of
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.run.channel_names import derived_coords
from seacrane.run.commands import HOLE, check_command, targets
from seacrane.run.connections import table_of, without
from seacrane.run.stage import Stage
from seacrane.run.unreachable import check_bounds, check_limits
from seacrane.run.until import Level, of_contact
from seacrane.scene.scene import Scene


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
