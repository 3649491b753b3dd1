"""Values far beyond what their kind usually has: each a warning when a run starts.

Usual magnitudes stand with the fields of the elements; what only other values of the scene tell is in
`proportions`.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane import _core
from seacrane.analysis.proportions import Around, disproportions
from seacrane.arrays import Array
from seacrane.description.description import ELEMENTS, KINDS, LOADS
from seacrane.description.loads import BEYOND, kind_of, named
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.plausible import TURN
from seacrane.warnings import UnitWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description

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
    around = Around(scene, times, described=described)
    for table in ELEMENTS:
        for name, element in getattr(scene, table).items():
            # Springs of moorings have ends beyond the horizon, which stand for a direction.
            far = any(np.abs(np.asarray(getattr(element, key, 0.0))).max() >= BEYOND for key in POINTS[1:3])
            by_itself = () if far else (*_unusual(element, times), *_far_points(element))
            for text in (*by_itself, *disproportions(around, element)):
                what = kind_of(element) if table in LOADS else KINDS[table]
                warn_caller(f"{what} {name!r}: {text}", UnitWarning)


@cache
def _bounded(kind: Any) -> tuple[tuple[Any, float, float], ...]:
    """Fields of elements of a kind with usual bounds, and these."""
    turns = {field.name: TURN for field in kind.FIELDS if (field.unit, field.type) == ("rad", "number")}
    bounds = ((field, field.least, turns.get(field.name, field.most)) for field in kind.FIELDS)
    return tuple(one for one in bounds if any(one[1:]))


def _unusual(element: Any, times: Array) -> Iterator[str]:
    """Values beyond the usual magnitudes of their fields."""
    kind: Any = type(element)
    for field, least, most in _bounded(kind):
        value = getattr(element, field.name)
        if isinstance(value, float):
            sizes = [abs(value)] if value not in (0.0, field.default) else []
        else:
            size = _magnitudes(value, times)
            size = size[size > 0.0]
            sizes = [float(size.min()), float(size.max())] if size.size else []
        high = bool(sizes) and sizes[-1] > most * SLACK > 0.0
        if not sizes or not (high or sizes[0] * SLACK < least):
            continue
        worst = sizes[-1] if high else sizes[0]
        unit = f" {field.unit}" if field.unit else ""
        bounds = f"{least:.6g} to {most:.6g}" if most else f"{least:.6g} and more"
        yield (
            f"{field.name} reaches {worst:.6g}{unit}, and usual are {bounds}{unit}: a slip in its unit? Give "
            f"it in {field.unit}" if unit else
            f"{field.name} reaches {worst:.6g}, and usual are {bounds}: it is a ratio or a share, no "
            "percentage"
        )  # fmt: skip


def _magnitudes(value: Any, times: Array) -> Array:
    """The magnitude of a number, of those of an array, or the largest of a curve at some times."""
    if isinstance(value, _core.Curve):
        return np.asarray(np.abs(value.evaluate(times)[:, 0]).max(keepdims=True))
    return np.asarray(np.abs(np.asarray(value, dtype=float)).ravel())


def _far_points(element: Any) -> Iterator[str]:
    """Points of bodies that no body reaches."""
    given = {key: getattr(element, key) for key in POINTS if hasattr(element, key)}
    given |= {key: getattr(element, key).point for key in FRAMES if hasattr(element, key)}
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
