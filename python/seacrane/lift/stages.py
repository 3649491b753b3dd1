"""The stages of a lift from its [[stage]] tables."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from seacrane.description.description import coordinate_of
from seacrane.description.holding import with_holds
from seacrane.description.places import ANGLES
from seacrane.errors import SceneError
from seacrane.lift.build import refused_at
from seacrane.lift.calls import Keywords, keywords, require_unit, require_unit_of_channel
from seacrane.lift.check_keys import Entry
from seacrane.lift.inner_keys import COMMANDS, STAGE, UNTIL, WAITS
from seacrane.run.commands import HOLE, Command, Move, targets
from seacrane.run.plan import checked_stages
from seacrane.run.stage import Condition, Stage, Until
from seacrane.scene.scene import Scene

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


def _tables(entries: Iterable[Entry]) -> list[Entry]:
    return [entry for entry in entries if entry.table.name == "stage"]


def _stage(entry: Entry) -> Stage:
    given = keywords(STAGE, entry.values)
    tables = zip(entry.values.get("until", ()), given.get("until", ()), strict=True)
    given["until"] = [_condition(table, values) for table, values in tables]
    given["commands"] = _commands(given.get("commands", ()))
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


def _commands(tables: Iterable[Keywords]) -> dict[str, Command]:
    found: dict[str, Command] = {}
    for values in tables:
        name = values["name"]
        if name in found:
            raise SceneError(f"commands: {name!r} is given twice; give one command of it in a stage")
        found[name] = _command(name, values)
    return found


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
