"""What is recorded beside the usual channels, and where coordinates and channels are meant to stay."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import GROUND, Description, coordinate_of, insert, require
from seacrane.description.limit_state import LimitState, Range
from seacrane.description.pick import pick_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, number_of, shaped_of, texts_of
from seacrane.inputs.shown import shown

Array = NDArray[np.float64]
Vector = tuple[float, float, float]
SLACK = "slack"  # in place of a channel: the margin that marine operations are planned with
SLACK_MARGIN = 0.1  # of the static tension: 10 % as DNV-RP-N103 is quoted to ask for; unverified


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


def add_point(scene: Description, name: str, *, body: str, point: Any = (0.0, 0.0, 0.0)) -> _core.Point:
    """Record the motion of a point of a body: channels point_position, point_velocity, point_acceleration.

    Parameters
    ----------
    name : str
        Of the point along the dimension "point" of these channels.
    body : str
        Body that carries it.
    point : array_like, shape (3,)
        In the coordinates of the body, m; default: the origin of the body.

    Raises
    ------
    SceneError
        For a duplicate name or a value that is not three numbers; the body is checked at compile().
    """
    return insert("point", scene.points, _core.Point(name=name, body=body, point=point))


def add_range(
    scene: Description,
    joint: str,
    *,
    minimum: float,
    maximum: float,
    coordinate: str | None = None,
    name: str | None = None,
) -> Range:
    """Tell where a joint coordinate is meant to stay, m or rad; it exerts no load (`add_stop` does).

    A reference that leaves it is refused when a run starts, a motion that does is warned of after the run
    (OutsideRangeWarning). A crane adds the strokes of its data file.
    """
    coordinate = coordinate_of(scene, "range", joint, coordinate)
    name = name_of("range", name, joint)
    low = number_of(f"range {name!r}: minimum", minimum)
    high = number_of(f"range {name!r}: maximum", maximum)
    if not low < high:
        raise SceneError.of(
            f"range {name!r}: minimum", f"is {low} and maximum {high}; the minimum must be below the maximum"
        )
    element = Range(name=name, joint=joint, coordinate=coordinate, minimum=low, maximum=high)
    return insert("range", scene.ranges, element)


@dataclass(frozen=True, kw_only=True)
class Clearance:
    """A box on a body, and the points whose distance from it is recorded, as of `Scene.add_clearance`."""

    name: str
    points: tuple[str, ...]
    body: str
    center: Vector
    size: Vector


def add_clearance(
    scene: Description,
    name: str,
    *,
    points: str | Sequence[str],
    body: str = GROUND,
    center: Any = (0.0, 0.0, 0.0),
    size: Any = (0.0, 0.0, 0.0),
) -> Clearance:
    """Record the distance of points from a box on another body: the channel clearance, negative inside.

    Parameters
    ----------
    name : str
        Along the dimension "gap" of the channel.
    points : str or sequence of str
        Named by `add_point`; of several the nearest counts.
    body : str
        That carries the box; default: the ground.
    center : array_like, shape (3,)
        Of the box, coordinates of the body, m.
    size : array_like, shape (3,)
        Of the box, along the axes of the body, m; default: none, the distance from a point.

    Raises
    ------
    SceneError
        For points or a body that are not there, or a size that is negative.
    """
    what = f"clearance {name_of('clearance', name)!r}"
    names = tuple(texts_of(f"{what}: points", [points] if isinstance(points, str) else points))
    if not names:
        raise SceneError(f"{what}: has no points; name at least one of add_point")
    for point in names:
        require(scene, what, "points", point, "points")
    require(scene, what, "body", body, ground=True)
    place, extent = (
        shaped_of(f"{what}: {key}", value, (3,)) for key, value in (("center", center), ("size", size))
    )
    if not np.all(np.isfinite(place)):
        raise SceneError.of(f"{what}: center", f"is {place.tolist()}; give three finite numbers, m")
    if not (np.all(np.isfinite(extent)) and np.all(extent >= 0.0)):
        raise SceneError.of(
            f"{what}: size", f"is {extent.tolist()} m; give three numbers that are not negative"
        )
    element = Clearance(name=name, points=names, body=body, center=_vector(place), size=_vector(extent))
    return insert("clearance", scene.clearances, element)


def distance_from_box(points: Array, size: Vector) -> Array:
    """Distance of points (..., 3) in a box's frame about its centre, m; inside it is negative."""
    beyond = np.abs(points) - 0.5 * np.asarray(size)
    outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=-1)
    return np.asarray(outside + np.minimum(beyond.max(axis=-1), 0.0))


def _vector(values: Array) -> Vector:
    x, y, z = (float(value) for value in values)
    return x, y, z


@dataclass(frozen=True, kw_only=True)
class Relative:
    """Two points whose relative position and velocity are recorded, as of `Scene.add_relative`."""

    name: str
    point: str
    to: str
    axes: str


def add_relative(scene: Description, name: str, *, point: str, to: str, axes: str = GROUND) -> Relative:
    """Record where a point is over another: the channels relative_position and relative_velocity.

    The velocity is the rate of the position as it is told: along axes that turn, without their turning.
    Height and speed of a load over a deck are the z of its lowest point over a point of the deck, along the
    axes of the body that has the deck.

    Parameters
    ----------
    name : str
        Along the dimension "pair" of the channels.
    point : str
        Named by `add_point`.
    to : str
        The point, named likewise, from which it is looked at.
    axes : str
        A body along whose axes it is told; default: the inertial frame.

    Raises
    ------
    SceneError
        For a point or a body that is not there.
    """
    what = f"relative {name_of('relative', name)!r}"
    for key, one in (("point", point), ("to", to)):
        require(scene, what, key, one, "points")
    require(scene, what, "axes", axes, ground=True)
    return insert("relative", scene.relatives, Relative(name=name, point=point, to=to, axes=axes))


def add_limit_state(
    scene: Description,
    channel: str,
    *,
    maximum: float | None = None,
    minimum: float | None = None,
    names: Mapping[str, str] | None = None,
    name: str | None = None,
) -> LimitState:
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
