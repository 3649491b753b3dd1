"""Values far beyond what their kind usually has: each a warning when a run starts.

Usual magnitudes stand with the fields of the elements; what only other values of the scene tell is in
`proportions`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import ELEMENTS, KINDS, LOADS
from seacrane.description.loads import BEYOND, kind_of, named
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.plausible import TURN
from seacrane.validity.proportions import disproportions
from seacrane.warnings import UnitWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
LOOKS = 201  # at a curve, over a run
LONGEST_ARM = 500.0  # m, of a point of a body: ships are shorter
NEAR = 250.0  # m, of each coordinate of a point that is not as far
SLACK = 1.0 + 1e-9  # of rounding
FRAMES = ("first_frame", "second_frame")
POINTS = ("point", "first_point", "second_point", "points")


def warn_of_units(scene: Description, start: float, end: float, *, described: bool) -> None:
    """Every value of every element that is no default, over a run from `start` to `end` (s).

    `described`: in the pose that is described, where lines are as long as they begin.
    """
    times = np.linspace(start, max(end, start), LOOKS)
    for table in ELEMENTS:
        for name, element in getattr(scene, table).items():
            if _stands_for_a_direction(element):
                continue
            for text in (*_unusual(element, times), *_far_points(element)):
                what = kind_of(element) if table in LOADS else KINDS[table]
                warn_caller(f"{what} {name!r}: {text}", UnitWarning)
    for text in disproportions(scene, times, described=described):
        warn_caller(text, UnitWarning)


@dataclass(frozen=True)
class _Looks:
    """What is looked at in elements of a class: fields with their usual bounds and defaults, and points."""

    fields: tuple[tuple[Any, float, float, Any], ...]
    points: tuple[str, ...]
    frames: tuple[str, ...]


def _looks_at(element: Any) -> _Looks:
    kind: Any = type(element)
    return _looks_at_kind(kind)


@cache
def _looks_at_kind(kind: Any) -> _Looks:
    fields = []
    for field in kind.FIELDS:
        most = TURN if field.unit == "rad" and field.type == "number" else field.most
        if field.least != 0.0 or most != 0.0:
            fields.append((field, field.least, most, field.default))
    points, frames = (tuple(key for key in keys if hasattr(kind, key)) for keys in (POINTS, FRAMES))
    return _Looks(tuple(fields), points, frames)


def _stands_for_a_direction(element: Any) -> bool:
    """Springs of moorings have ends beyond the horizon."""
    points = [getattr(element, key) for key in _looks_at(element).points if key in POINTS[1:3]]
    return any(np.abs(np.asarray(point)).max() >= BEYOND for point in points)


def _unusual(element: Any, times: Array) -> Iterator[str]:
    """Values beyond the usual magnitudes of their fields."""
    for field, least, most, default in _looks_at(element).fields:
        value = getattr(element, field.name)
        if isinstance(value, float) and (value == default or _is_usual(abs(value), least, most)):
            continue
        size = magnitudes(value, times)
        largest = float(size.max(initial=0.0))
        if not largest > 0.0 or (least == 0.0 and largest <= most * SLACK):
            continue
        smallest, high = float(size[size > 0.0].min()), largest > most * SLACK > 0.0
        if not (smallest * SLACK < least or high):
            continue
        worst = largest if high else smallest
        unit = f" {field.unit}" if field.unit else ""
        bounds = f"{least:.6g} to {most:.6g}" if most else f"{least:.6g} and more"
        yield (
            f"{field.name} reaches {worst:.6g}{unit}, and usual are {bounds}{unit}: a slip in its unit? Give "
            f"it in {field.unit}" if unit else
            f"{field.name} reaches {worst:.6g}, and usual are {bounds}: it is a ratio or a share, no "
            "percentage"
        )  # fmt: skip


def _is_usual(size: float, least: float, most: float) -> bool:
    return not (size > 0.0 and size * SLACK < least) and not size > most * SLACK > 0.0


def magnitudes(value: Any, times: Array) -> Array:
    """The magnitude of a number, of those of an array, or the largest of a curve at some times."""
    if isinstance(value, _core.Curve):
        return np.asarray(np.abs(value.evaluate(times)[:, 0]).max(keepdims=True))
    return np.asarray(np.abs(np.asarray(value, dtype=float)).ravel())


def _far_points(element: Any) -> Iterator[str]:
    """Points of bodies that no body reaches."""
    looks = _looks_at(element)
    given = {key: getattr(element, key) for key in looks.points}
    given |= {key: getattr(element, key).point for key in looks.frames}
    for key, value in given.items():
        points = np.atleast_2d(np.asarray(value, dtype=float))
        if np.abs(points).max(initial=0.0) < NEAR:
            continue
        bodies = named(element, "body")
        own = bodies if key == "points" else [bodies[-1] if key.startswith("second") else bodies[0]]
        for body, point in zip(own, points, strict=True):
            arm = float(np.linalg.norm(point))
            if body != "ground" and arm > LONGEST_ARM:
                yield (
                    f"{key} is {arm:.6g} m from the origin of {body!r}, longer than any ship: points are "
                    "metres in coordinates of their body; mm for m?"
                )
