"""What the page tells beside shapes: stages, named points, clearances, and the force in each wire."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.description import Description
from seacrane.pictures.packing import Blob
from seacrane.pictures.pose_curves import Motion, linear_rows
from seacrane.pictures.wires import end_of
from seacrane.result import Result

Array = NDArray[np.float64]
FINENESS = 2.0**-14  # step of a force over its largest


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
