"""What rods, wires and lines carry at their lower ends, out of what the core records."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.analysis.least_pulls import least_pulls
from seacrane.description.crane_parts import hooks
from seacrane.description.loads import lines_of, path_of, whole_of
from seacrane.description.once import once_in_any_sea
from seacrane.description.places import POSE, position_of
from seacrane.description.suspension import hooked_body, hung_loads, names_of_suspensions

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]


def hook_loads(scene: Description, arrays: Mapping[str, Array]) -> Array | None:
    """Loads (time, suspension), N; None where there is none, or the core recorded too little.

    Of a rod or wire its tension. Of a line the resultant of all its sections on the body that it reaches
    last, from its first point on: of n falls n times the tension where they are parallel. Of the lowest
    segment of a line with mass, with the tension at the line's end.
    """
    lines = list(lines_of(scene.loads).values())
    lowest = lowest_segments(scene)
    parts = [arrays["tension"]] if "tension" in arrays else []
    if lines:
        needed = ("line_tension", *POSE, *(["end_tension"] if lowest else []))
        if not all(name in arrays for name in needed):
            return None
        for i, line in enumerate(lines):
            whole = lowest.get(line.name)
            pull = arrays["line_tension"][:, i] if whole is None else arrays["end_tension"][:, whole, 1]
            parts.append((pull * _falls(scene, arrays, line))[:, None])
    return np.concatenate(parts, axis=1) if parts else None


@once_in_any_sea
def lowest_segments(scene: Description) -> Mapping[str, int]:
    """The last segment of each line with mass: the place of the line along `whole_line`."""
    wholes = list(dict.fromkeys(whole_of(name, line) for name, line in lines_of(scene.loads).items()))
    last = {whole_of(name, line): name for name, line in lines_of(scene.loads).items()}
    return {name: wholes.index(whole) for whole, name in last.items() if name != whole}


def link_tensions(scene: Description, arrays: Mapping[str, Array], loads: Array | None) -> Array | None:
    """Tensions (time, hook) of the links of cranes, N; of a line there its hook load. None without links."""
    links = hooks(scene)
    if not links or "tension" not in arrays:
        return None
    names = names_of_suspensions(scene)
    known = arrays["tension"] if loads is None else loads
    unknown = np.full(len(known), np.nan)
    columns = [names.index(one.suspension.channel) for one in hung_loads(scene) if one.crane is not None]
    return np.stack([known[:, i] if i < known.shape[1] else unknown for i in columns], axis=1)


def slack_margins(scene: Description, loads: Array) -> Array | None:
    """Hook loads (time, suspension) over the least static ones, (time, weighed); None without any.

    Zero of a sling that carries nothing at rest.
    """
    least, names = least_pulls(scene), names_of_suspensions(scene)
    if not least:
        return None
    columns = [
        loads[:, names.index(name)] / pull if pull > 0.0 else np.zeros(len(loads))
        for name, pull in least.items()
    ]
    return np.stack(columns, axis=1)


def _falls(scene: Description, arrays: Mapping[str, Array], line: Any) -> Array:
    """The resultant of unit tensions on the hooked body, (time,)."""
    path = path_of(line)
    hooked = hooked_body(line)
    pull = np.zeros((len(arrays["position"]), 3))
    for (first, start), (second, end) in pairwise(path):
        if (first == hooked) == (second == hooked):
            continue
        along = position_of(scene, arrays, second, end) - position_of(scene, arrays, first, start)
        unit = along / np.linalg.norm(along, axis=1, keepdims=True)
        pull += unit if first == hooked else -unit
    return np.asarray(np.linalg.norm(pull, axis=1))
