"""The table of a crane's allowable loads over the radius."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane.errors import SceneError
from seacrane.inputs.checked import rows_of

Capacity = tuple[tuple[float, float], ...]  # radius, m, and load, kg


def capacity_of(what: str, given: Any) -> Capacity:
    """Rows of radius and load, the radii increasing; SceneError for anything else."""
    rows = rows_of(f"{what}: capacity", given, 2)
    if not np.all(np.isfinite(rows)) or np.any(rows <= 0.0) or np.any(np.diff(rows[:, 0]) <= 0.0):
        raise SceneError(
            f"{what}: capacity is {rows.tolist()}; give rows of radius (m, increasing) and load (kg), all "
            "above zero"
        )
    return tuple((float(radius), float(load)) for radius, load in rows)


def allowed_at(capacity: Capacity, radius: float) -> float:
    """Load (kg) at a radius: linear between rows, that of the first below it, none beyond the last."""
    if not capacity or radius > capacity[-1][0]:
        return 0.0
    radii, loads = zip(*capacity, strict=True)
    return float(np.interp(radius, radii, loads))
