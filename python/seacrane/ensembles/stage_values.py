"""Numbers of stages as parameters, by paths: "stages.lift.duration", "stages.lift.commands.hoist.rate"."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import shown
from seacrane.run.move import Move
from seacrane.run.stage import Stage
from seacrane.scene.scene import Scene

Stages = Sequence[Stage] | Callable[[Scene], Sequence[Stage]]
FIRST = "stages."
START_TIME = "start_time"  # when a lift in stages begins, s
TIMES = ("duration", "maximum_duration")
MOVED = ("to", "by", "over")  # of a `Move`
Place = tuple[str, ...]  # of a value in a stage


def checked_stages_of(what: str, stages: Any) -> Stages:
    """The stages, or a SceneError that says whose they are."""
    if callable(stages):
        return stages  # type: ignore[no-any-return]
    if not isinstance(stages, Sequence) or not all(isinstance(one, Stage) for one in stages):
        raise SceneError(f"{what}: stages is {shown(stages)}; give a list of Stage, or a function of a scene")
    return tuple(stages)


def scene_values(values: Mapping[str, Any]) -> dict[str, Any]:
    """The values that are not of stages."""
    return {
        name: value for name, value in values.items() if name != START_TIME and not name.startswith(FIRST)
    }


def stage_paths(stages: Stages) -> list[str]:
    """Paths of every number of the stages; those of a function's stages are known once it is called."""
    if callable(stages):
        return [START_TIME]
    return [START_TIME] * bool(stages) + [path for stage in stages for path, _ in _places(stage)]


def with_stage_values(stages: Sequence[Stage], values: Mapping[str, Any]) -> list[Stage]:
    """The stages with those of the values that are theirs."""
    return [_changed(stage, values) for stage in stages]


def _places(stage: Stage) -> Iterator[tuple[str, Place]]:
    """Path and place of each number of a stage that it has."""
    for name in TIMES:
        if getattr(stage, name) is not None:
            yield f"{FIRST}{stage.name}.{name}", (name,)
    for what, command in stage.commands.items():
        path = f"{FIRST}{stage.name}.commands.{what}"
        if isinstance(command, int | float):
            yield path, (what,)
        elif isinstance(command, Move):
            for part in MOVED:
                if getattr(command, part) is not None:
                    yield f"{path}.{part}", (what, part)


def _changed(stage: Stage, values: Mapping[str, Any]) -> Stage:
    times: dict[str, Any] = {}
    commands: dict[str, Any] = dict(stage.commands)
    for path, place in _places(stage):
        if path not in values:
            continue
        value = number_of(path, values[path])
        if place[0] in TIMES:
            times[place[0]] = value
        elif len(place) == 1:
            commands[place[0]] = value
        else:
            commands[place[0]] = replace(commands[place[0]], **{place[1]: value})
    return replace(stage, **times, commands=commands) if values else stage
