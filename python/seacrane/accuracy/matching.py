"""Two runs of one lift side by side: their events matched, and curves compared at equal phase of a stage."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from seacrane.result import Result

Array = NDArray[np.float64]
Key = tuple[str, str]  # a kind of event and its name
BY_FRICTION = ("slip", "stick")  # of a load that stands: rounding says how often, and no course hangs on it
APART = 1e-9  # s: marks nearer than that are one


@dataclass(frozen=True, kw_only=True)
class Matching:
    """Events of two runs, each with its counterpart.

    Attributes
    ----------
    one, other : Times of stages' ends and of events that are in both, ascending in either, s.
    course : What one run has more often than the other, in words; nothing where both took one course.
    shift : Largest distance in time of what is matched, s.
    """

    one: Array
    other: Array
    course: str
    shift: float


def matched(one: Result, other: Result) -> Matching:
    """Each event with that of the same kind, name and place in the row of these."""
    left, right = _by_key(one), _by_key(other)
    pairs = list(zip(_bounds(one), _bounds(other), strict=False))
    course = ""
    for key in sorted({*left, *right}):
        mine, its = left.get(key, []), right.get(key, [])
        if len(mine) == len(its):
            pairs += zip(mine, its, strict=True)
        elif not course:
            course = f"{key[0]} of {key[1]!r} {len(mine)} times in one run, {len(its)} in another"
    pairs.sort()
    shift = max(abs(a - b) for a, b in pairs)
    kept = pairs[:1]
    for a, b in pairs[1:]:
        if a > kept[-1][0] + APART and b > kept[-1][1] + APART:
            kept.append((a, b))
    a, b = np.array(kept).T
    return Matching(one=a, other=b, course=course, shift=float(shift))


def curve_apart(
    time: Array, values: Array, other_time: Array, other_values: Array, matching: Matching
) -> float:
    """Largest distance of a curve (n, items, parts) from another's.

    At every output the other is taken at that time, and at that phase between two matched events; the nearer
    one counts. So what a shift in time alone makes of a jump is no distance.
    """
    segment = _segments(matching.one, time)
    own, its = np.diff(matching.one)[segment], np.diff(matching.other)[segment]
    phase = matching.other[segment] + (time - matching.one[segment]) * its / own
    there = _inside(other_time, other_values, matching.other, phase, segment)
    then = _inside(other_time, other_values, matching.other, time, _segments(matching.other, time))
    distance = np.fmin(_distance(values, there), _distance(values, then))
    return float(np.nanmax(distance, initial=0.0))


def extremes_apart(values: Array, other_values: Array) -> float:
    """Largest distance of the extremes of any component."""
    found = [
        np.abs(reach(values, axis=0, initial=first) - reach(other_values, axis=0, initial=first))
        for reach, first in ((np.fmax.reduce, -np.inf), (np.fmin.reduce, np.inf))
    ]
    return float(np.nanmax([part[np.isfinite(part)].max(initial=0.0) for part in found]))


def _by_key(result: Result) -> dict[Key, list[float]]:
    """Times of the events that make a course; an event that ends a stage may be seen in the next one."""
    found: dict[Key, list[float]] = defaultdict(list)
    for event in result.events:
        if event.kind not in ("stage", *BY_FRICTION):
            found[event.kind, event.name].append(event.time)
    return found


def _bounds(result: Result) -> list[float]:
    """Times at which stages begin, and the last output."""
    begins = [span.start for span in result.stages] or [float(result.time[0])]
    return [*begins, float(result.time[-1])]


def _segments(marks: Array, time: Array) -> NDArray[np.int64]:
    """Between which two marks times are: after the first of them, up to the second."""
    return np.clip(np.searchsorted(marks, time, side="left") - 1, 0, len(marks) - 2)


def _distance(values: Array, other: Array) -> Array:
    """Of the nearest (n, items, parts), over parts: what neither has is no distance."""
    absent = np.isnan(values) & np.isnan(other)
    return np.asarray(np.linalg.norm(np.where(absent, 0.0, values - other), axis=-1))


def _inside(time: Array, values: Array, marks: Array, wanted: Array, segment: NDArray[np.int64]) -> Array:
    """A curve at times, each from outputs between the same two marks alone; NaN where there are none."""
    found = np.full((len(wanted), *values.shape[1:]), np.nan)
    own = _segments(marks, time)
    for place in np.unique(segment):
        asked, here = np.flatnonzero(segment == place), np.flatnonzero(own == place)
        here = here[np.diff(time[here], prepend=-np.inf) > APART]
        if here.size:
            found[asked] = _interpolated(time[here], values[here], wanted[asked])
    return found


def _interpolated(time: Array, values: Array, wanted: Array) -> Array:
    """By cubics with the slopes of parabolas, beyond the ends by straight lines up to one output away."""
    if time.size == 1:
        return np.where((np.abs(wanted - time) <= APART)[:, None, None], values, np.nan)
    slopes = np.gradient(values, time, axis=0)
    at = np.clip(np.searchsorted(time, wanted, side="right") - 1, 0, time.size - 2)
    step = (time[at + 1] - time[at])[:, None, None]
    x = (wanted - time[at])[:, None, None] / step
    inner, beyond = np.clip(x, 0.0, 1.0), x - np.clip(x, 0.0, 1.0)
    h = inner * inner * (3.0 - 2.0 * inner)
    found = (
        (1.0 - h) * values[at]
        + h * values[at + 1]
        + step * inner * (1.0 - inner) * ((1.0 - inner) * slopes[at] - inner * slopes[at + 1])
    )
    found = found + step * beyond * np.where(beyond > 0.0, slopes[at + 1], slopes[at])
    return np.where(np.abs(beyond) <= 1.0, found, np.nan)
