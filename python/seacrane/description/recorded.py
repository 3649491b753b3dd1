"""Joint coordinates that are recorded, and where they are meant to stay."""

from __future__ import annotations

from seacrane.description.range import Range
from seacrane.description.scene import Description, coordinate_of, insert
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, number_of


def record_coordinate(
    scene: Description, *, joint: str, coordinate: str | None = None, name: str | None = None
) -> None:
    """Record a joint coordinate and its rate under a name (default: the joint's)."""
    coordinate = coordinate_of(scene, "recorded coordinate", joint, coordinate)
    name = name_of("recorded coordinate", name, joint)
    if scene.recorded.get(name, (joint, coordinate)) != (joint, coordinate):
        raise SceneError(
            f"recorded coordinate {name!r}: is {'.'.join(scene.recorded[name])} already; give another name"
        )
    scene.recorded[name] = (joint, coordinate)


def add_range(
    scene: Description,
    *,
    joint: str,
    minimum: float,
    maximum: float,
    coordinate: str | None = None,
    name: str | None = None,
) -> Range:
    """Tell where a joint coordinate is meant to stay, m or rad; it exerts no load (`add_end_stop` does).

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
