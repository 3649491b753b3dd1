"""Joint coordinates and points that are recorded, and where coordinates are meant to stay."""

from __future__ import annotations

from typing import Any

from seacrane import _core
from seacrane.description.description import Description, coordinate_of, insert
from seacrane.description.range import Range
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, number_of, shaped_of


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
    place = shaped_of(f"point {name_of('point', name)!r}: point", point, (3,))
    inserted: _core.Point = insert("point", scene.points, _core.Point(name=name, body=body, point=place))
    return inserted


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
        raise SceneError(
            f"range {name!r}: minimum is {low} and maximum {high}; the minimum must be below the maximum"
        )
    element = Range(name=name, joint=joint, coordinate=coordinate, minimum=low, maximum=high)
    inserted: Range = insert("range", scene.ranges, element)
    return inserted
