"""The channels that the page draws over time, chosen as `Result.plot` chooses."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.pick import Pick
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.pictures.packing import Blob
from seacrane.pictures.pose_curves import Motion, linear_rows
from seacrane.result import Result
from seacrane.result.history import wanted_traces
from seacrane.result.traces import Trace

Array = NDArray[np.float64]
MOST_LINES, MOST_PANELS, USUAL_PANELS = 6, 8, 4
FINENESS = 2.0**-13  # step of a line over its range
USUAL = (
    "link_tension", "line_tension", "roll", "heave", "wave_elevation", "limit_force", "stroke", "coordinate",
)  # fmt: skip


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
    step = max((high - low) * FINENESS, 1e-12)
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
