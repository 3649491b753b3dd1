"""Channels of one's own: expressions of others, and coordinates of joints."""

from __future__ import annotations

from dataclasses import dataclass, field
from difflib import get_close_matches

from seacrane.description.channels import CHANNELS, COUNTED_ON, OWN, unit_of
from seacrane.description.description import Description, insert
from seacrane.description.expression import (
    UNITS,
    Curve,
    Dimension,
    Number,
    Program,
    dimension_of,
    parsed,
    unit_text,
    worked_out,
)
from seacrane.description.pick import Pick, pick_of
from seacrane.description.places import ANGLES
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, text_of
from seacrane.inputs.keywords import taken
from seacrane.inputs.plain_data import DERIVED
from seacrane.inputs.shown import shown
from seacrane.scene.recorded import record_coordinate


@dataclass(frozen=True, kw_only=True)
class OwnChannel:
    """An expression of curves that results hold under a name, as ``own[name]``.

    Attributes
    ----------
    unit : SI, by the units of its curves.
    """

    name: str
    expression: str
    unit: str = field(metadata=DERIVED)


def add_channel(
    scene: Description, name: str | None = None, *, expression: str | None = None, joint: str | None = None,
    coordinate: str | None = None,
) -> OwnChannel | str:  # fmt: skip
    """Record an expression of other channels as ``own[name]``, or a joint's coordinate and its rate.

    An expression has curves ("hook_load[main]", "roll"), named points and bodies by axis ("tip.z", "load.z",
    of a body its centre of mass), numbers with a unit ("3 m", "10 deg"; without one pure), + - * /,
    parentheses, sqrt, abs, hypot, atan2, min and max. What is added or compared has one unit; atan2 gives
    rad. No code is run. The channels that it needs are recorded by themselves.

    Parameters
    ----------
    name : str
        Along the dimension "expression" of the channel own, or "joint_coordinate" of the channels coordinate
        and coordinate_rate; default: the joint's.
    expression : str
        Such as "tip.z - load.z".
    joint, coordinate : str
        Whose coordinate is recorded, and which; default: its usual one.

    Raises
    ------
    SceneError
        For a text that is none, a joint, channel, point or body that is not there, and units that do not fit.
        A name along a channel that the scene does not have is refused when a run starts.
    """
    takes = ("expression",) if joint is None else ("joint", "coordinate")
    taken(
        "channel", f"channel by {takes[0]}", takes, expression=expression, joint=joint, coordinate=coordinate
    )
    if joint is not None:
        return record_coordinate(scene, joint, coordinate=coordinate, name=name)
    label = name_of("channel", name)
    what = f"channel {label!r}"
    text = text_of(f"{what}: expression", expression)
    program = parsed(what, text)

    def leaf(step: Number | Curve) -> Dimension:
        if isinstance(step, Number):
            return step.dimension
        return _dimension(scene, what, picked(scene, what, step))

    found = worked_out(program, leaf, lambda call, values: dimension_of(what, call, values))
    channel = OwnChannel(name=label, expression=text, unit=unit_text(found))
    return insert("channel", scene.channels, channel)


def programs(scene: Description) -> dict[str, Program]:
    """The program of every channel of one's own."""
    return {name: parsed(f"channel {name!r}", one.expression) for name, one in scene.channels.items()}


def picks(scene: Description) -> dict[str, list[Pick]]:
    """The curves that every channel of one's own is made of."""
    return {
        name: [picked(scene, f"channel {name!r}", step) for step in program if isinstance(step, Curve)]
        for name, program in programs(scene).items()
    }


def picked(scene: Description, what: str, curve: Curve) -> Pick:
    """A curve of an expression as a selector; SceneError where the scene has no such place or channel."""
    if not curve.axis:
        pick = pick_of(what, curve.text)
    else:
        there = [key for key in ("points", "bodies") if curve.text in getattr(scene, key)]
        if len(there) != 1:
            raise SceneError(f"{what}: {_which(scene, curve, several=len(there) > 1)}")
        channel, dim = {"points": ("point_position", "point"), "bodies": ("position", "body")}[there[0]]
        pick = Pick(channel=channel, names={dim: curve.text, "axis": curve.axis})
    if pick.parts:
        raise SceneError.of(f"{what}: {pick}", f"is of a part of a run; leave {pick.parts} out")
    if pick.channel == OWN:
        raise SceneError.of(f"{what}: {pick}", "is a channel of your own too; write its expression here")
    if CHANNELS[pick.channel].turns or pick.channel in COUNTED_ON:
        raise SceneError(
            f"{what}: {pick.channel} counts on over a whole run, which an expression does not; take another"
        )
    return pick


def _which(scene: Description, curve: Curve, *, several: bool) -> str:
    if several:
        return (
            f"{shown(curve.text)} is a point and a body; write "
            f"point_position[{curve.text}, {curve.axis}] or position[{curve.text}, {curve.axis}]"
        )
    near = get_close_matches(curve.text, [*scene.points, *scene.bodies], n=1)
    fix = f"did you mean {near[0]!r}?" if near else "add_point or add_body it first"
    return f"there is no point or body {shown(curve.text)}; {fix}"


def _dimension(scene: Description, what: str, pick: Pick) -> Dimension:
    unit = unit_of(pick.channel, pick.names.values())
    straight, _, angular = unit.partition(" or ")
    if angular and (coordinate := _coordinate(scene, pick)):
        unit = angular if coordinate in ANGLES else straight
    if unit not in UNITS:
        raise SceneError.of(
            f"{what}: {pick}", f"is in {unit}, which says not what it is; name a curve of one unit"
        )
    return UNITS[unit][1]


def _coordinate(scene: Description, pick: Pick) -> str:
    """The coordinate of a joint that a curve is of; no text where it is of none that is known."""
    if name := pick.names.get("joint_coordinate"):
        return scene.recorded[name][1] if name in scene.recorded else ""
    for dim, table in (("actuator", scene.actuators), ("driver", scene.drivers)):
        if pick.names.get(dim) in table:
            return str(table[pick.names[dim]].coordinate)
    return ""
