"""What links, wires and lines carry at their lower ends, out of what the core records."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.body_motion import position_of
from seacrane.description.line_weights import hooked_body
from seacrane.description.loads import lines_of, path_of

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
NEEDED = ("position", "quaternion")


def suspensions(scene: Description) -> list[str]:
    """Links and wires, then elastic lines, by name; a line that has a link's name is "<name> line"."""
    links = [name for name, joint in scene.joints.items() if joint.kind == "distance"]
    return [*links, *(f"{name} line" if name in links else name for name in lines_of(scene.loads))]


def hook_loads(scene: Description, arrays: Mapping[str, Array]) -> Array | None:
    """Loads (time, suspension), N; None where there is none, or the core recorded too little.

    Of a link or wire its tension. Of a line the resultant of all its sections on the body that it reaches
    last, from its first point on: of n falls n times the tension where they are parallel.
    """
    lines = list(lines_of(scene.loads).values())
    parts = [arrays["tension"]] if "tension" in arrays else []
    if lines:
        if not all(name in arrays for name in ("line_tension", *NEEDED)):
            return None
        parts += [(arrays["line_tension"][:, i] * _falls(scene, arrays, line))[:, None]
                  for i, line in enumerate(lines)]  # fmt: skip
    return np.concatenate(parts, axis=1) if parts else None


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
