"""The table of a crane's allowable loads over the radius."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, rows_of

Array = NDArray[np.float64]
LARGEST_FACTOR = 10.0
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


def design_factor_of(what: str, given: Any) -> float:
    """The dynamic factor that a table contains; SceneError below 1."""
    factor = number_of(f"{what}: design_factor", given)
    if not 1.0 <= factor <= LARGEST_FACTOR:
        raise SceneError(
            f"{what}: design_factor is {factor:g}; give the dynamic factor that the capacity contains, from "
            f"1 to {LARGEST_FACTOR:g}"
        )
    return factor


def allowed_at(capacity: Capacity, radius: ArrayLike) -> Array:
    """Loads (kg) at radii: linear between rows, that of the first below it, none beyond the last."""
    radii, loads = zip(*capacity, strict=True)
    return np.asarray(np.interp(np.asarray(radius, dtype=float), radii, loads, right=0.0))
