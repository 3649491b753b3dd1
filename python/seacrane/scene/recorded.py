"""What is recorded beside the usual channels, and where coordinates and channels are meant to stay."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.channels import CHANNELS, COUNTED_ON, FIXED, OWN, unit_of
from seacrane.description.description import GROUND, Description, coordinate_of, insert, require
from seacrane.description.expression import Curve, Number, Program, dimension_of, parsed, worked_out
from seacrane.description.limit_state import LimitState, Range
from seacrane.description.pick import Pick, pick_of
from seacrane.description.places import ANGLES, MOTION, POSE
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, number_of, shaped_of, text_of, texts_of
from seacrane.inputs.keywords import taken
from seacrane.inputs.plain_data import DERIVED
from seacrane.inputs.shown import shown
from seacrane.inputs.units import UNITS, Dimension, unit_text
from seacrane.inputs.values import told_by

Vector = tuple[float, float, float]
SLACK = "slack"  # in place of a channel: the margin that marine operations are planned with
SLACK_MARGIN = 0.1  # of the static tension: 10 % as DNV-RP-N103 is quoted to ask for; unverified
KINDS: Mapping[str, tuple[str, ...]] = {  # of channels of one's own: what they are made of
    "joint": ("joint", "coordinate", "minimum", "maximum"),
    "points": ("points", "body", "center", "size"),
    "expression": ("expression",),
}
PLACES = {"points": ("point_", "point"), "bodies": ("", "body")}  # how channels begin, and their dimension


@told_by(_core.Point)
def add_point(scene: Description, name: str, *, body: str, point: Any = (0.0, 0.0, 0.0)) -> _core.Point:
    """Record the motion of a point of a body: channels point_position, point_velocity, point_acceleration.

    Parameters
    ----------
    name : str
        Of the point along the dimension "point" of these channels.
    point : array_like, shape (3,)
        In the coordinates of the body, m; default: the origin of the body.

    Raises
    ------
    SceneError
        For a duplicate name or a value that is not three numbers; the body is checked at compile().
    """
    return insert("point", scene.points, _core.Point(name=name, body=body, point=point))


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


@dataclass(frozen=True, kw_only=True)
class Clearance:
    """A box on a body, and the points whose distance from it is recorded."""

    name: str
    points: tuple[str, ...]
    body: str = GROUND
    center: Vector = (0.0, 0.0, 0.0)
    size: Vector = (0.0, 0.0, 0.0)


def add_channel(
    scene: Description, name: str | None = None, *, expression: str | None = None, joint: str | None = None,
    coordinate: str | None = None, minimum: float | None = None, maximum: float | None = None,
    points: str | Sequence[str] | None = None, body: str | None = None, center: Any = None, size: Any = None,
) -> OwnChannel | Clearance | str:  # fmt: skip
    """Record an expression of other channels, a joint's coordinate, or the distance of points from a box.

    An expression, recorded as ``own[name]``, has curves ("hook_load[main]", "roll"), named points and bodies
    by axis ("tip.z", "load.z", of a body its centre of mass), their speeds ("tip.vz"), both also along the
    axes of a body and from its origin ("corner.z in barge", "corner.vz in barge": as who stands on it sees
    them), numbers with a unit ("3 m", "10 deg"; without one pure), + - * /, parentheses, sqrt, abs, hypot,
    atan2, min and max. What is added or compared has one unit; atan2 gives rad. No code is run. The channels
    that it needs are recorded by themselves.

    Parameters
    ----------
    name : str
        Along the dimension "expression" of the channel own, "joint_coordinate" of the channels coordinate
        and coordinate_rate (default: the joint's), or "gap" of the channel clearance.
    expression : str
        Such as "tip.z - load.z".
    joint, coordinate : str
        Whose coordinate is recorded, and which; default: its usual one.
    minimum, maximum : float
        Where the coordinate is meant to stay, m or rad; no load keeps it there (`add_stop` does). A
        reference that leaves it is refused when a run starts, a motion that does is warned of after the run
        (OutsideRangeWarning). A crane has the strokes of its data file.
    points : str or sequence of str
        Named by `add_point`: the distance of the nearest from a box, negative inside.
    body : str
        That carries the box; default: the ground.
    center, size : array_like, shape (3,)
        Of the box, m, coordinates of the body and along its axes; without a size it is a point.

    Raises
    ------
    SceneError
        For a text that is none, a joint, channel, point or body that is not there, units that do not fit, and
        bounds or a box that make no sense. A name along a channel that the scene does not have is refused
        when a run starts.
    """
    of = "joint" if joint is not None else "points" if points is not None else "expression"
    given = taken(
        "channel", f"channel by {of}", KINDS[of], expression=expression, joint=joint, coordinate=coordinate,
        minimum=minimum, maximum=maximum, points=points, body=body, center=center, size=size,
    )  # fmt: skip
    if joint is not None:
        label = record_coordinate(scene, joint, coordinate=coordinate, name=name)
        if minimum is not None or maximum is not None:
            add_range(scene, label, joint=joint, coordinate=coordinate, minimum=minimum, maximum=maximum)
        return label
    if points is not None:
        return add_clearance(scene, name_of("channel", name), **given)
    label = name_of("channel", name)
    what = f"channel {label!r}"
    text = text_of(f"{what}: expression", expression)

    def leaf(step: Number | Curve) -> Dimension:
        if isinstance(step, Number):
            return step.dimension
        return _dimension(scene, what, picked(scene, what, step))

    found = worked_out(parsed(what, text), leaf, lambda call, values: dimension_of(what, call, values))
    channel = OwnChannel(name=label, expression=text, unit=unit_text(found))
    return insert("channel", scene.channels, channel)


def record_coordinate(
    scene: Description, joint: str, *, coordinate: str | None = None, name: str | None = None
) -> str:
    """Record a joint coordinate and its rate under a name (default: the joint's), which is returned."""
    coordinate = coordinate_of(scene, "recorded coordinate", joint, coordinate)
    name = name_of("recorded coordinate", name, joint)
    if scene.recorded.get(name, (joint, coordinate)) != (joint, coordinate):
        raise SceneError(
            f"recorded coordinate {name!r}: is {'.'.join(scene.recorded[name])} already; give another name"
        )
    scene.recorded[name] = (joint, coordinate)
    return name


def add_range(
    scene: Description, name: str, *, joint: str, coordinate: str | None = None, minimum: Any, maximum: Any
) -> Range:
    """Where a joint coordinate is meant to stay, m or rad."""
    coordinate = coordinate_of(scene, "range", joint, coordinate)
    low = number_of(f"range {name!r}: minimum", minimum)
    high = number_of(f"range {name!r}: maximum", maximum)
    if not low < high:
        raise SceneError.of(
            f"range {name!r}: minimum", f"is {low} and maximum {high}; the minimum must be below the maximum"
        )
    element = Range(name=name, joint=joint, coordinate=coordinate, minimum=low, maximum=high)
    return insert("range", scene.ranges, element)


def add_clearance(scene: Description, name: str, *, points: str | Sequence[str], **box: Any) -> Clearance:
    """The distance of points from a box on a body, as `add_channel` describes it."""
    what = f"clearance {name!r}"
    names = tuple(texts_of(f"{what}: points", [points] if isinstance(points, str) else points))
    if not names:
        raise SceneError(f"{what}: has no points; name at least one of add_point")
    for point in names:
        require(scene, what, "points", point, "points")
    require(scene, what, "body", box.get("body", GROUND), ground=True)
    for key, least in (("center", -math.inf), ("size", 0.0)):
        if key in box:
            numbers = shaped_of(f"{what}: {key}", box[key], (3,))
            if not np.all(np.isfinite(numbers) & (numbers >= least)):
                told = "finite numbers" if key == "center" else "numbers that are not negative"
                raise SceneError.of(f"{what}: {key}", f"is {numbers.tolist()} m; give three {told}")
            box[key] = tuple(numbers.tolist())
    return insert("clearance", scene.clearances, Clearance(name=name, points=names, **box))


def distance_from_box(points: Array, size: Vector) -> Array:
    """Distance of points (..., 3) in a box's frame about its centre, m; inside it is negative."""
    beyond = np.abs(points) - 0.5 * np.asarray(size)
    outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=-1)
    return np.asarray(outside + np.minimum(beyond.max(axis=-1), 0.0))


def programs(scene: Description) -> dict[str, Program]:
    """The program of every channel of one's own."""
    return {name: parsed(f"channel {name!r}", one.expression) for name, one in scene.channels.items()}


def picks(scene: Description) -> dict[str, list[Pick]]:
    """The curves that every channel of one's own is made of."""
    found: dict[str, list[Pick]] = {}
    for name, program in programs(scene).items():
        curves = [step for step in program if isinstance(step, Curve)]
        found[name] = [picked(scene, f"channel {name!r}", curve) for curve in curves]
        for one in (curve for curve in curves if curve.along):
            for channel in MOTION if one.is_rate else POSE:
                others = {dim: FIXED[dim][0] for dim in CHANNELS[channel].dims[2:]}
                found[name].append(Pick(channel=channel, names={"body": one.along} | others))
    return found


def picked(scene: Description, what: str, curve: Curve) -> Pick:
    """A curve of an expression as a selector; SceneError where the scene has no such place or channel."""
    if not curve.axis:
        pick = pick_of(what, curve.text)
    else:
        there = [key for key in PLACES if curve.text in getattr(scene, key)]
        if len(there) != 1:
            raise SceneError(f"{what}: {_which(scene, curve, several=len(there) > 1)}")
        if curve.along:
            require(scene, what, "axes", curve.along)
        channel, dim = PLACES[there[0]]
        channel += "velocity" if curve.is_rate else "position"
        pick = Pick(channel=channel, names={dim: curve.text, "axis": curve.axis[-1]})
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


def add_limit_state(
    scene: Description, channel: str, *, maximum: float | None = None, minimum: float | None = None,
    names: Mapping[str, str] | None = None, name: str | None = None,
) -> LimitState:  # fmt: skip
    """State what a channel may reach: every result then tells its utilisation, `Result.utilisation`.

    It exerts no load. The channel is recorded even where it is none of the usual ones.

    Parameters
    ----------
    channel : str
        As results name it, such as "link_tension", or a selector with names: "vessel_motion[roll]". "slack",
        or "slack[hoist]", is `slack_margin` with a minimum of 0.1: no line below a tenth of its static load.
    maximum, minimum : float, optional
        Largest and smallest value that it may have, in its SI unit (rad for angles); not zero.
    names : mapping of str to str, optional
        Names along its dimensions beside those in the selector, such as ``{"cylinder": "main"}``. Of a
        dimension that is not named, the worst counts.
    name : str, optional
        Default: the channel and the names.

    Raises
    ------
    SceneError
        For an unknown channel, and for bounds that leave nothing between them or are zero; a channel or a
        name that the scene does not have is refused when a run starts.
    """
    if not isinstance(names or {}, Mapping):
        raise SceneError.of("limit state: names", f"is {shown(names)}; give names by dimension")
    word, bracket, rest = channel.partition("[") if isinstance(channel, str) else ("", "", "")
    if word.strip() == SLACK:
        channel = f"slack_margin{bracket}{rest}"
        minimum = SLACK_MARGIN if maximum is None and minimum is None else minimum
    pick = pick_of("limit state", channel, names)
    if pick.parts:
        raise SceneError(f"limit state {pick}: holds at all times; leave {pick.parts} out")
    words = [pick.channel.replace("_", " "), *pick.names.values()]
    name = name_of("limit state", name, " ".join(words))
    high, low = _bound(name, "maximum", maximum), _bound(name, "minimum", minimum)
    if high is None and low is None:
        raise SceneError(f"limit state {name!r}: has neither maximum nor minimum; give one")
    if high is not None and low is not None and not low < high:
        raise SceneError.of(
            f"limit state {name!r}: minimum",
            f"is {low:g} and maximum {high:g}; minimum must be below maximum",
        )
    state = LimitState(name=name, channel=pick.channel, maximum=high, minimum=low, names=pick.names)
    return insert("limit state", scene.limit_states, state)


def _bound(name: str, key: str, value: Any) -> float | None:
    if value is None:
        return None
    number = number_of(f"limit state {name!r}: {key}", value)
    if not math.isfinite(number) or number == 0.0:
        raise SceneError.of(
            f"limit state {name!r}: {key}",
            f"is {number:g}; a utilisation is over a finite value that is not "
            "zero: give a small one for a load that may just not vanish",
        )
    return number
