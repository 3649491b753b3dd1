"""The channels that the page draws over time, chosen by name."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.pictures.packing import Blob
from seacrane.pictures.pose_curves import Motion, linear_rows
from seacrane.result import CHANNELS, Result

Array = NDArray[np.float64]
Choice = str | tuple[str, ...]

MOST_LINES, MOST_PANELS, USUAL_PANELS = 6, 8, 4
FINENESS = 2.0**-13  # step of a line over its range
USUAL: Sequence[Choice] = (
    "link_tension",
    "line_tension",
    ("vessel_motion", "roll"),
    ("vessel_motion", "heave"),
    "wave_elevation",
    "limit_force",
    "stroke",
    "coordinate",
)
PREFIXES = ((1e6, "M"), (1e3, "k"))


def strip_of(
    result: Result | None, channels: Sequence[Choice] | None, motion: Motion, blob: Blob
) -> list[dict[str, Any]]:
    """Panels of the strip: title, unit, and lines over the frames.

    Raises
    ------
    SceneError
        For a channel that the result does not hold, a name along its dimensions that there is not, or more
        lines than a panel shows.
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
            f"view: channels is {shown(channels)}; give a list of at most {MOST_PANELS}, each a channel's "
            "name or a tuple of it and names along its dimensions, such as ('vessel_motion', 'roll')"
        )
    return [_panel(result, choice, motion, blob) for choice in channels]


def _held(result: Result, choice: Choice) -> bool:
    try:
        return len(_lines(result, choice)) <= MOST_LINES
    except SceneError:
        return False


def _lines(result: Result, choice: Choice) -> dict[str, Array]:
    """Values (n,) by what tells the lines of a panel apart."""
    name, *picked = (choice,) if isinstance(choice, str) else choice
    if name not in result.channels:
        known = ", ".join(result.channels)
        raise SceneError(f"view: no channel {shown(name)} in the result; it holds {known}")
    dims = result.dims[name][1:]
    array, left = result[name], []
    for place, dim in enumerate(dims):
        names = result.coords[dim]
        found = next((one for one in picked if one in names), None)
        if found is None:
            left.append(names)
            continue
        picked.remove(found)
        array = np.take(array, [names.index(found)], axis=place + 1)
    if picked:
        about = "; ".join(f"{dim}: {', '.join(result.coords[dim])}" for dim in dims) or "nothing to pick"
        raise SceneError(f"view: channel {name!r} has no {shown(picked[0])}; it has {about}")
    columns = array.reshape(len(array), -1).T
    labels = [" ".join(words) for words in itertools.product(*left)]
    return dict(zip(labels, columns, strict=True))


def _panel(result: Result, choice: Choice, motion: Motion, blob: Blob) -> dict[str, Any]:
    lines = _lines(result, choice)
    words = [choice] if isinstance(choice, str) else list(choice)
    if len(lines) > MOST_LINES:
        first = result.coords[result.dims[words[0]][1]][0]
        raise SceneError(
            f"view: channel {words[0]!r} has {len(lines)} lines, a panel shows {MOST_LINES}; pick among "
            f"{', '.join(list(lines)[:12])} with a tuple, such as {(words[0], first)!r}"
        )
    unit, factor = _unit(words, np.array(list(lines.values())))
    rows = factor * linear_rows(motion, result.time, np.array(list(lines.values())).T)
    low, high = float(rows.min()), float(rows.max())
    return {
        "title": " ".join(words).replace("_", " "),
        "unit": unit,
        "labels": [label.strip() for label in lines],
        "low": low,
        "high": high,
        "values": blob.series(rows, max((high - low) * FINENESS, 1e-12)),
    }


def _unit(words: Sequence[str], values: Array) -> tuple[str, float]:
    """Of what is shown, and the factor to it: degrees for radians, k and M for large loads."""
    unit = CHANNELS[words[0]].unit
    if "(" in unit:  # of motions, by name: "m (surge, ...), rad (roll, ...)"
        parts = [part.partition(" (") for part in unit.split("), ")]
        unit = next((one for one, _, names in parts if any(word in names for word in words[1:])), unit)
    if unit.split("/")[0] == "rad":
        return unit.replace("rad", "deg", 1), float(np.degrees(1.0))
    largest = float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
    if unit[0] in "NJ":
        for size, prefix in PREFIXES:
            if largest >= size:
                return " or ".join(prefix + one for one in unit.split(" or ")), 1.0 / size
    return unit, 1.0
