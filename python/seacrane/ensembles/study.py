"""What an ensemble runs: where its scenes come from, how they are run and what is kept of them."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from seacrane import _core
from seacrane.description.description import ELEMENTS, KINDS
from seacrane.ensembles.dataset import RESERVED, Labelled
from seacrane.ensembles.kept import Kept, StageTime, made_by
from seacrane.ensembles.members import Value
from seacrane.ensembles.other_sea import WORDS, require_same_sea, with_sea
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import shown
from seacrane.result import Result
from seacrane.result.record import Record
from seacrane.run.commands import Move
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.stage import Stage
from seacrane.scene.scene import Scene

Source = Scene | Callable[..., Scene]
Start = _core.State | Callable[[Scene], _core.State] | None
Keep = Mapping[str, Kept | Callable[[Result], Any]]
Asked = Mapping[str, Kept | str | Callable[[Result], Any]]  # of which `checked_keep` makes the other
Values = Mapping[str, Value]
Stages = Sequence[Stage] | Callable[[Scene], Sequence[Stage]]
FIRST = "stages."
START_TIME = "start_time"  # when a lift in stages begins, s
TIMES = ("duration", "maximum_duration")
MOVED = ("to", "by", "over")  # of a `Move`
Place = tuple[str, ...]  # of a value in a stage
PEAKS = ("maximum", "minimum")  # of what is kept, those that are reached between outputs too
SETTINGS = ("gravity", "baumgarte", "length_scale")


@dataclass(frozen=True, kw_only=True)
class Study:
    """One run of it for given values.

    Attributes
    ----------
    t_end : s.
    method, outputs : Of every run.
    keep : What is kept of each, by name.
    start : Where every run begins, or a function of its scene that tells it; default: its assembled start.
    lanes : Runs that are stepped side by side, by the number of the member; 1: none.
    member_limit : Processor time of a member, s; of those side by side together.
    stages : Of a lift in stages, or a function of the scene that tells them; none: it is one run to `t_end`.
    start_times : At which lifts in stages begin, where that varies, s, ascending.
    """

    source: Source
    t_end: float
    method: Method
    outputs: Outputs
    keep: Keep
    start: Start = None
    lanes: int = 1
    member_limit: float = math.inf
    stages: Stages = ()
    start_times: tuple[float, ...] = ()

    @property
    def peaks(self) -> tuple[str, ...] | None:
        """Channels of which largest or least values are kept; None where functions may read those of any."""
        curves = kept_curves(self.keep)
        return None if curves is None else tuple(one.channel for one in curves if one.what in PEAKS)

    def require_names(self, names: list[str]) -> None:
        """Raise SceneError for a parameter that the scene does not have, or one whose sea cannot vary."""
        if not isinstance(self.source, Scene):
            return
        require_paths(self.source, names, WORDS, stage_paths(self.stages))
        words = [name for name in names if name in WORDS]
        if words:
            require_same_sea(self.source, words)

    def parts(self, values: Values) -> tuple[Values, Values]:
        """From the values of a member, words of the sea and the others."""
        sea = {name: value for name, value in values.items() if name in WORDS}
        return sea, {name: value for name, value in values.items() if name not in WORDS}

    def scene(self, values: Values) -> Scene:
        """The scene of a member."""
        if isinstance(self.source, Scene):
            sea, others = self.parts(scene_values(values))
            made = with_values(self.source, others)
            return with_sea(made, sea) if sea else made
        made = self.source(**scene_values(values))
        if not isinstance(made, Scene):
            raise SceneError(f"the function returned {shown(made)}; return a Scene")
        return made

    def stages_of(self, scene: Scene, values: Values) -> list[Stage]:
        """A member's stages with their own values."""
        given = self.stages(scene) if callable(self.stages) else self.stages
        return [_changed(stage, values) for stage in given]

    def start_of(self, scene: Scene) -> _core.State | None:
        """Where the run of a scene begins; None: its assembled start."""
        return self.start(scene) if callable(self.start) else self.start

    @property
    def keeps_curves(self) -> bool:
        """Whether what is kept is of channels alone; a function may read anything of a result."""
        return kept_curves(self.keep) is not None

    def kept_of(self, result: Record) -> dict[str, Labelled]:
        """What is kept of a result, or of the record of one where that `keeps_curves`."""
        return {
            name: what.of(result) if isinstance(what, Kept) else made_by(name, what, result)
            for name, what in self.keep.items()
        }


def checked_keep(keep: Any) -> Keep:
    """The mapping, or a SceneError that names what is wrong in it."""
    if not isinstance(keep, Mapping) or not keep:
        raise SceneError(
            f"keep is {shown(keep)}; give what to keep by name, such as {{'hook': 'hook_load.max'}}"
        )
    found: dict[str, Kept | Callable[[Result], Any]] = {}
    for name, what in keep.items():
        if not isinstance(name, str) or not name.isidentifier():
            raise SceneError(f"keep: {shown(name)} is no name; give letters, digits and underscores")
        if name in RESERVED:
            raise SceneError(f"keep: the name {name!r} is taken; choose another")
        if not (isinstance(what, Kept | str) or callable(what)):
            raise SceneError(
                f"keep: {name} is {shown(what)}; give a text such as 'hook_load.max', a Kept, or a function "
                "of a Result"
            )
        found[name] = (StageTime.of_text(what) or Kept.of_text(what)) if isinstance(what, str) else what
    return found


def outputs_for(keep: Keep, outputs: Outputs) -> Outputs:
    """The outputs; where they name no channels and no function is kept, those that are kept."""
    curves = kept_curves(keep)
    if outputs.channels is not None or curves is None:
        return outputs
    return Outputs(dt_out=outputs.dt_out, channels=tuple(dict.fromkeys(one.channel for one in curves)))


def kept_curves(keep: Keep) -> list[Kept] | None:
    """What is kept of channels; None where a function is kept, which may read anything of a result."""
    every = [what for what in keep.values() if not isinstance(what, StageTime)]
    known = [what for what in every if isinstance(what, Kept)]
    return known if len(known) == len(every) else None


def require_paths(
    scene: Scene, names: list[str], words: tuple[str, ...], others: Collection[str] = ()
) -> None:
    """Raise SceneError for a name that is no path into the scene, no word of its sea and none of others."""
    known = [*words, *SETTINGS, *_paths(scene), *others]
    for name in names:
        if name not in known:
            near = difflib.get_close_matches(name, known, n=1, cutoff=0.3)
            raise SceneError(
                f"over: scene {scene.name!r} has no parameter {name!r}"
                + (f"; nearest: {near[0]!r}" if near else "")
                + ". Give a path such as 'bodies.<name>.mass', or a word of the sea: "
                + ", ".join(words)
            )


def with_values(scene: Scene, values: Mapping[str, Any]) -> Scene:
    """A copy of the scene with values at paths."""
    out = scene.copy()
    for path, value in values.items():
        if path in SETTINGS:
            setattr(out, path, number_of(path, value))
            continue
        table, rest = path.split(".", 1)
        name, attribute = rest.rsplit(".", 1)
        out.replace(name, kind=KINDS[table], **{attribute: value})
    return out


def _paths(scene: Scene) -> list[str]:
    return [
        f"{table}.{name}.{attribute}"
        for table in ELEMENTS
        for name, element in getattr(scene, table).items()
        for attribute in element.__getstate__()
        if attribute not in ("name", "database")
    ]


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
