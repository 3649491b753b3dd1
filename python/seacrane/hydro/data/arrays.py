"""The arrays of a database: shapes, finite values, rising axes; read-only copies."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_SHAPES = {
    "omega": "n",
    "heading": "m",
    "added_mass": "nij",
    "damping": "nij",
    "infinite_frequency_added_mass": "ij",
    "zero_frequency_added_mass": "ij",
    "mass_matrix": "ij",
    "force": "mni",
    "motion_rao": "mni",
    "motion_rao_limit": "i",
    "motion_rao_floor": "i",
    "linear_damping": "ij",
    "quadratic_damping": "i",
    "linear": "n",
    "quadratic": "n",
    "linearised": "mn",
}


def freeze(part: Any, n: int, m: int, name: str, *, restoring: str) -> None:
    """Replace every array of ``part`` by a finite, read-only copy of the right shape and type.

    ``restoring`` says in letters what shape that matrix has there: "ij", or "nij" where it has frequencies.
    """
    sizes = {"n": n, "m": m, "i": 6, "j": 6}
    for entry in fields(part):
        value = getattr(part, entry.name)
        letters = _SHAPES.get(entry.name)
        if entry.name == "restoring":
            letters = restoring
        if letters is None or value is None:
            continue
        wanted = tuple(sizes[letter] for letter in letters)
        array = np.array(value, dtype=complex if letters == "mni" else float)
        if array.shape != wanted:
            raise ValueError(f"database {name!r}: {entry.name} has shape {array.shape}; {wanted} is needed")
        if not np.all(np.isfinite(array)):
            where = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
            raise ValueError(
                f"database {name!r}: {entry.name}{list(where)} is {array[where]}; give finite numbers"
            )
        array.setflags(write=False)
        object.__setattr__(part, entry.name, array)


def check_increasing(name: str, what: str, values: FloatArray, *, low: float, high: float) -> None:
    """Raise unless ``values`` are strictly increasing and inside (low, high)."""
    if values.size == 0:
        raise ValueError(f"database {name!r}: {what} is empty; give at least one value")
    steps = np.flatnonzero(np.diff(values) <= 0.0)
    if steps.size:
        i = int(steps[0])
        raise ValueError(
            f"database {name!r}: {what} is not strictly increasing: {values[i]:.6g} then {values[i + 1]:.6g} "
            "at index "
            f"{i + 1}; sort it and drop duplicates"
        )
    if not (values[0] > low and values[-1] < high):
        raise ValueError(
            f"database {name!r}: {what} spans {values[0]:.6g} to {values[-1]:.6g}, outside ({low}, {high})"
        )
