"""What the page tells beside shapes: stages, points, clearances, forces in wires, channels over time."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.description import Description
from seacrane.description.pick import Pick
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.pictures.packing import Blob
from seacrane.pictures.pose_curves import Motion, linear_rows
from seacrane.pictures.wires import end_of
from seacrane.result import Result
from seacrane.result.history import wanted_traces
from seacrane.result.traces import Trace

Array = NDArray[np.float64]
FINENESS = 2.0**-14  # step of a force over its largest
MOST_LINES, MOST_PANELS, USUAL_PANELS = 6, 8, 4
LINE_FINENESS = 2.0**-13  # step of a line over its range
USUAL = (
    "link_tension", "line_tension", "roll", "heave", "wave_elevation", "limit_force", "stroke", "coordinate",
)  # fmt: skip


def marks_of(scene: Description, result: Result | None, bodies: Sequence[str]) -> dict[str, Any]:
    """Stages as name, start and end (s); points and boxes as ends of wires, sizes in m."""
    stages = [] if result is None else [[span.name, span.start, span.end] for span in result.stages]
    points = {
        name: end_of(scene, bodies, one.body, one.point)
        for name, one in scene.points.items()
        if one.body in scene.bodies
    }
    clearances = [
        {
            "name": name,
            "points": [points[point] for point in one.points if point in points],
            "at": end_of(scene, bodies, one.body, one.center),
            "size": list(one.size),
        }
        for name, one in scene.clearances.items()
    ]
    named = [{"name": name, "at": at} for name, at in points.items()]
    return {"stages": stages, "points": named, "clearances": [one for one in clearances if one["points"]]}


def forces_of(
    result: Result | None, wires: Sequence[Mapping[str, Any]], motion: Motion, blob: Blob
) -> dict[str, Any]:
    """Tension of lines and links over the frames, N, by element; of those that were recorded."""
    if result is None:
        return {}
    found = {}
    for element in dict.fromkeys(wire["element"] for wire in wires):
        values = _tension(result, element)
        if values is not None and np.isfinite(values).all() and np.any(values):
            step = float(np.abs(values).max()) * FINENESS
            found[element] = blob.series(linear_rows(motion, result.time, values[:, None]), step)
    return found


def _tension(result: Result, element: str) -> Array | None:
    if element in result.coords.get("line", ()) and "line_tension" in result.channels:
        return result.select("line_tension", line=element)
    if element in result.coords.get("joint", ()) and "reaction_force" in result.channels:
        return np.asarray(np.linalg.norm(result.select("reaction_force", joint=element), axis=1))
    return None


def strip_of(
    result: Result | None, channels: Sequence[str | Pick] | None, motion: Motion, blob: Blob
) -> list[dict[str, Any]]:
    """Panels of the strip: title, unit, lines over the frames, and their least and largest values between.

    Raises SceneError for a channel that the result does not hold, a name along its dimensions that there is
    not, or more lines than a panel shows.
    """
    if result is None:
        if channels:
            raise SceneError("view: channels is given for a scene that has not run; give its result")
        return []
    if channels is None:
        usual = (choice for choice in USUAL if _held(result, choice))
        return [_panel(result, choice, motion, blob) for choice in itertools.islice(usual, USUAL_PANELS)]
    if isinstance(channels, str) or not isinstance(channels, Sequence) or len(channels) > MOST_PANELS:
        raise SceneError(
            f"view: channels is {shown(channels)}; give a list of at most {MOST_PANELS}, such as "
            "['link_tension', 'vessel_motion[roll]']"
        )
    return [_panel(result, choice, motion, blob) for choice in channels]


def _held(result: Result, choice: str) -> bool:
    try:
        return len(_lines(result, choice)) <= MOST_LINES
    except SceneError:
        return False


def _lines(result: Result, choice: str | Pick) -> list[Trace]:
    return next(iter(wanted_traces(result, [choice], {}).values()))


def _panel(result: Result, choice: str | Pick, motion: Motion, blob: Blob) -> dict[str, Any]:
    lines = _lines(result, choice)
    if len(lines) > MOST_LINES:
        names = ", ".join(one.label for one in lines[:12])
        raise SceneError(
            f"view: {choice} has {len(lines)} lines, a panel shows {MOST_LINES}; pick among {names}, such as "
            f"'{lines[0].channel}[{lines[0].names[0]}]'"
        )
    rows = linear_rows(motion, result.time, np.array([one.values for one in lines]).T)
    least = between_frames(motion, result.time, [one.least for one in lines], np.fmin, rows)
    largest = between_frames(motion, result.time, [one.largest for one in lines], np.fmax, rows)
    low, high = float(least.min()), float(largest.max())
    step = max((high - low) * LINE_FINENESS, 1e-12)
    alone = len(lines) == 1
    return {
        "title": lines[0].title if alone else str(choice).replace("_", " "),
        "unit": ", ".join(dict.fromkeys(one.unit for one in lines)),
        "labels": ["" if alone else one.label for one in lines],
        "low": low,
        "high": high,
        "values": blob.series(rows, step),
        "bounds": blob.series(np.concatenate([least, largest]), step),
    }


def between_frames(
    motion: Motion, time: Array, bounds: Sequence[Array], extreme: np.ufunc, rows: Array
) -> Array:
    """The least or largest values (k, frames) of curves since the frame before, with those of the frames."""
    out = rows.copy()
    frame = np.clip(np.ceil((time - motion.start) / motion.interval - 1e-6), 0, rows.shape[1] - 1).astype(int)
    for row, bound in zip(out, bounds, strict=True):
        good = np.isfinite(bound)
        extreme.at(row, frame[good], bound[good])
    return out
