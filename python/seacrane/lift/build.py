"""A scene and its stages from the tables of a lift: each table makes its call, in the order of the tables."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from seacrane._core import Curve
from seacrane.analysis.inverse import reflected_inertia, tuned_gains
from seacrane.analysis.quasi_static import feed_forward
from seacrane.analysis.weight_balance import Balance, balance, balance_by_force
from seacrane.description.description import coordinate_of
from seacrane.description.holding import with_holds
from seacrane.description.places import ANGLES
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.caller import untold, warn_caller
from seacrane.lift.calls import Caller, Keywords, by_name, keywords, require_unit_of_channel
from seacrane.lift.check_keys import Entry, only, plain, titled
from seacrane.lift.document import Place
from seacrane.lift.inner_keys import COMMANDS, STAGE, UNTIL, WAITS
from seacrane.lift.keys import Key, require_unit
from seacrane.lift.tables import ASIDE
from seacrane.run.commands import HOLE, Command, Move, targets
from seacrane.run.plan import checked_stages
from seacrane.run.stage import Condition, Stage, Until
from seacrane.scene.scene import Scene
from seacrane.warnings import StartTransientWarning

NO_CALLS = ("scene", "balance", "control", *ASIDE)
LATER = ("command", "heave_compensation", "ballast", "notes")  # in this order, after what they act on
GAINS = ("stiffness", "damping")
Made = TypeVar("Made")
MOST_TIMES = 10_000  # each takes a rest state
WHOLE = 1e-6  # of an interval


def made(entries: Sequence[Entry], table: str, make: Callable[..., Made]) -> Made:
    """What a table that occurs once describes; with defaults where it does not. Raises FileFormatError."""
    one = only(entries, table)
    if one is None:
        return make()
    with refused_at(one):
        return make(**keywords(one.table.keys, one.values))


class SceneBuild:
    """Builds one scene: first without control, which takes a scene to compute, then with it."""

    def __init__(self, entries: Sequence[Entry]) -> None:
        self.entries, self.caller = entries, Caller()

    def scene(self) -> Scene:
        """The scene, with every command controlled; FileFormatError with the line of what it refuses."""
        scene, start = self._started()
        commands = [entry for entry in self.entries if entry.table.name == "command"]
        control = only(self.entries, "control")
        if commands and control is None:
            commands[0].fail(f"{commands[0].title} has no [control] to follow; add it")
        if control is not None:
            self._control(scene, control, commands, start)
        return scene

    def _started(self, *, at_rest: bool = False) -> tuple[Scene, Balance | None]:
        """The scene with its commands not yet controlled, and what balances it where [balance] says so."""
        scene = made(self.entries, "scene", Scene)
        for entry in _in_order(self.entries):
            with untold(), refused_at(entry):
                match entry.table.name:
                    case "command":
                        given = keywords(entry.table.keys, entry.values, scene)
                        scene.add_actuator(**{key: one for key, one in given.items() if key != "reference"})
                    case "notes":
                        scene.notes.update(plain(entry.values))
                    case _:
                        self.caller.call(scene, entry.table, entry.values, at_rest=at_rest)
        balanced = only(self.entries, "balance")
        if balanced is None:
            return scene, None
        if only(self.entries, "ballast"):
            balanced.fail("[balance] stands beside [ballast]; leave one out")
        with refused_at(balanced):
            return scene, balance_by_force(scene, body=balanced.values["vessel"])

    def _control(
        self, scene: Scene, control: Entry, commands: Sequence[Entry], start: Balance | None
    ) -> None:
        """Give every command gains and feed-forward, in place of an actuator without."""
        if not commands:
            control.fail("[control] has no [[command]] to control; add one, or leave it out")
        given = [keywords(entry.table.keys, entry.values, scene) for entry in commands]
        references = {str(one.get("name", one["joint"])): _curve(one.get("reference", 0.0)) for one in given}
        with refused_at(control):
            settings = keywords(control.table.keys, control.values)
            tuned_at = settings.pop("tuned_at", None)
            tuning = scene if tuned_at is None else self._tuning(tuned_at, given)
            for key in ("natural_frequency", "damping_ratio"):
                if not settings[key] > 0.0:
                    raise SceneError.of(key, f"is {settings[key]:g}; give a number above zero")
            inertia, omega = reflected_inertia(tuning), 2.0 * np.pi * settings["natural_frequency"]
            gains = tuned_gains(inertia, natural_frequency=omega, damping_ratio=settings["damping_ratio"])
            loads = feed_forward_of(
                scene, start, references, settings, at_rest=lambda: self._started(at_rest=True)[0]
            )
            for name in references:
                del scene.actuators[name]
            for name, one in zip(references, given, strict=True):
                chosen = dict(zip(GAINS, gains[name], strict=True))
                scene.add_actuator(**one | chosen, feed_forward=loads.get(name, 0.0))

    def _tuning(self, pose: Keywords, commands: Sequence[Keywords]) -> Scene:
        """The cranes alone on a fixed base, in the pose at which the inertia of their drives is taken."""
        scene = Scene(name="tuning")
        for entry in self.entries:
            if entry.table.name == "crane":
                with refused_at(entry):
                    self.caller.crane(scene, entry.table, entry.values, {"base": "ground"} | pose)
        for given in commands:
            scene.add_actuator(**{key: value for key, value in given.items() if key != "reference"})
        return scene


def _in_order(entries: Sequence[Entry]) -> list[Entry]:
    """Those that make calls; bodies that are placed below a crane's tip follow the cranes."""
    calls = [entry for entry in entries if entry.table.name not in NO_CALLS]
    below = [entry for entry in calls if entry.table.name == "body" and "below" in entry.values]
    later = sorted(
        (entry for entry in calls if entry.table.name in LATER),
        key=lambda entry: LATER.index(entry.table.name),
    )
    rest = [entry for entry in calls if entry not in [*below, *later]]
    last = max((i for i, entry in enumerate(rest) if entry.table.name == "crane"), default=-1) + 1
    return [*rest[:last], *below, *rest[last:], *later]


@contextlib.contextmanager
def refused_at(entry: Entry, *inside: str | int) -> Iterator[None]:
    """What is refused within the block is refused at this table of the file, or at what is inside."""
    try:
        yield
    except (SceneError, FileFormatError, TypeError) as error:
        if isinstance(error, FileFormatError) and error.placed:
            raise
        title = titled((*entry.path, *inside)) if inside else entry.title
        about = getattr(error, "about", ())
        path = inside or _about(entry.table.keys, entry.values, about)
        entry.fail(f"{title}: {error}", *path)


def _about(keys: Iterable[Key], values: Mapping[str, Any], about: Sequence[str]) -> Place:
    """The place in a table of the key that an error is about: an element's parts, and last the keyword."""
    for key in keys:
        for spelling in key.spellings:
            if spelling not in values or not about:
                continue
            if about[-1] in (key.entry or key.name, spelling):
                return (spelling,)
            if key.type == "table" and (key.name in about or any(one.entry for one in key.keys)):
                inside = _about(key.keys, values[spelling], about)
                if inside:
                    return (spelling, *inside)
    return ()


def _curve(value: float | Curve) -> Curve:
    return value if isinstance(value, Curve) else Curve.constant(value=value)


def feed_forward_of(
    scene: Scene,
    start: Balance | None,
    references: Mapping[str, Curve],
    settings: Mapping[str, Any],
    *,
    at_rest: Callable[[], Scene],
) -> dict[str, Curve]:
    """Loads that hold the coordinates at rest, by the settings of [control]; `references` are by command.

    `start` balances the scene, where it is known; `at_rest` makes it without waves and fluid memory.
    """
    kind = settings.get("feed_forward", "references")
    if kind != "references":
        for key in ("times", "period"):
            if key in settings:
                raise SceneError.of(
                    key, f"is given, which feed_forward = {kind!r} has no use for; leave it out"
                )
    if kind == "none":
        return {}
    if kind == "start":
        loads = (balance(scene) if start is None else start).loads
        return {name: Curve.constant(value=loads[name]) for name in references}
    if "times" not in settings:
        raise SceneError(
            "feed_forward along the references needs times, such as [{until_s = 45, every_s = 5}]"
        )
    times = times_of(settings["times"])
    return feed_forward(at_rest(), references=references, times=times, period=settings.get("period"))


def times_of(parts: Sequence[Mapping[str, float]]) -> list[float]:
    """From zero on, part after part, each at its own interval, s."""
    times = [0.0]
    for part in parts:
        begin, until, every = times[-1], part["until"], part["every"]
        steps = (until - begin) / every if every > 0.0 else 0.0
        count = round(min(steps, MOST_TIMES))
        if not 1 <= count < MOST_TIMES - len(times) or abs(steps - count) > WHOLE:
            raise SceneError.of(
                "times",
                f"is wrong from {begin:g} s until {until:g} s every {every:g} s; the part must begin before "
                f"its end, hold its interval a whole number of times, and all parts {MOST_TIMES} times",
            )
        times += (begin + every * np.arange(1, count + 1)).tolist()
    return times


LIMITED = {
    "tension": "line_tension", "length": "line_unstretched_length", "depth": "immersed_depth",
    "clear": "contact_least_gap",
}  # fmt: skip
WAYS = ("to", "by", "value", "curve")
OF_LOADS = {
    "rate": "m/s", "tension": "N", "brake": "1", "length": "m", "command": "1", "reference": "m", HOLE: "m2",
}  # fmt: skip


def stages_of(entries: Iterable[Entry]) -> tuple[Stage, ...]:
    """The stages, as far as they make sense by themselves.

    Raises FileFormatError with the line of the table.
    """
    made = []
    for entry in _tables(entries):
        with refused_at(entry):
            made.append(_stage(entry))
    return tuple(made)


def check_stages(entries: Sequence[Entry], scene: Scene, stages: Any) -> None:
    """Raise FileFormatError for stages that do not fit the scene or one another."""
    if not stages:
        return
    for entry in _tables(entries):
        with refused_at(entry):
            for command in entry.values.get("commands", ()):
                _require_unit_of_target(scene, command)
    try:
        checked_stages(scene, stages)
    except SceneError as error:
        tables = _tables(entries)
        next((one for one in tables if one.values["name"] == error.name), tables[0]).fail(str(error))
    _warn_of_ramps(scene, stages)


def _warn_of_ramps(scene: Scene, stages: Sequence[Stage]) -> None:
    """Warn where something is done before the given motion of a ship has grown to that of its sea."""
    acts = [bool(one.commands or one.connect or one.release) for one in stages]
    before = stages[: acts.index(True)] if any(acts) else stages
    wait = sum(float(one.duration or one.maximum_duration or 0.0) for one in before)
    for name, told in scene.provenance.items():
        if told.ramp and wait < told.ramp:
            warn_caller(
                f"vessel {name!r}: its motion grows over {told.ramp:g} s, and what the stages do begins "
                f"after {wait:g} s, on a ship that hardly moves yet. Wait longer in a first stage, or give "
                "a shorter ramp",
                StartTransientWarning,
            )


def _tables(entries: Iterable[Entry]) -> list[Entry]:
    return [entry for entry in entries if entry.table.name == "stage"]


def _stage(entry: Entry) -> Stage:
    given = keywords(STAGE, entry.values)
    tables = zip(entry.values.get("until", ()), given.get("until", ()), strict=True)
    given["until"] = [_condition(table, values) for table, values in tables]
    commands = by_name("commands", given.get("commands", ()))
    given["commands"] = {name: _command(name, values) for name, values in commands.items()}
    return Stage(**given)


def _condition(table: Mapping[str, Any], values: Keywords) -> Condition:
    """A table as it is written, and as keywords."""
    kinds = [name for name in WAITS if name in values]
    if len(kinds) != 1:
        raise SceneError(f"until: has {' and '.join(kinds) or 'nothing to wait for'}; give one of "
                         f"{', '.join(WAITS)}")  # fmt: skip
    kind, names = kinds[0], values.get("names", {})
    if kind != "channel" and "names" in values:
        raise SceneError(f"until: names goes with channel; leave it out beside {kind}")
    bounds = {key: values[key] for key in ("minimum", "maximum") if key in values}
    made: Callable[..., Condition] = getattr(Until, kind)
    if kind in ("contact", "release"):
        if bounds:
            raise SceneError(f"until: {' and '.join(bounds)} stands beside {kind}; leave it out")
        return made(values[kind])
    require_unit_of_channel(UNTIL, table, LIMITED.get(kind, str(values[kind])), names)
    if kind == "clear" and bounds.keys() != {"minimum"}:
        raise SceneError("until: clear needs a minimum, in m, and no maximum; give minimum_m")
    return made(values[kind], **bounds, **names)


def _command(name: str, values: Mapping[str, Any]) -> Command:
    ways = [way for way in WAYS if way in values]
    if len(ways) != 1:
        told = " and ".join(ways) or "no value"
        raise SceneError(f"commands: {name!r} has {told}; give one of {', '.join(WAYS)}")
    (way,) = ways
    moves = way in ("to", "by")
    if moves != ("over" in values):
        fix = "give over_s, the time that the move takes" if moves else f"leave over_s out beside {way}"
        raise SceneError(f"commands: {name!r} {'has no' if moves else 'has an'} over_s; {fix}")
    if moves:
        return Move(over=values["over"], **{way: values[way]})
    command: Command = values[way]
    return command


def _require_unit_of_target(scene: Scene, table: Mapping[str, Any]) -> None:
    """Refuse metres of an angle, and the like."""
    name = table["name"]
    if name not in targets(scene):
        return  # the check of all stages says so, with what there is
    ways = [key for key in COMMANDS if key.name in WAYS]
    require_unit(ways, table, _unit(scene, name), f"command {name!r}")


def _unit(scene: Scene, name: str) -> str:
    scene = with_holds(scene)
    target = targets(scene)[name]
    if target.kind == "load":
        return OF_LOADS[target.attribute]
    table = scene.actuators if target.kind == "actuator" else scene.drivers
    element = table[target.element]
    angular = coordinate_of(scene, target.kind, element.joint, element.coordinate) in ANGLES
    if target.attribute == "feed_forward":
        return "N m" if angular else "N"
    return "rad" if angular else "m"
