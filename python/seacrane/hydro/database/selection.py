"""Part of a database: fewer frequencies, fewer headings, the same numbers."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import HydroData

FloatArray = NDArray[np.float64]
Data = TypeVar("Data", bound=HydroData)
Indices = NDArray[np.intp]
Choice = tuple[float, float] | slice | Sequence[int] | NDArray[np.integer[Any]] | None

TOLERANCE = 1e-9  # rad/s or rad: ends of a range belong to it
BY_FREQUENCY = ("added_mass", "damping")
PER_CAUSE = ("added_mass", "damping", "restoring")


def selected_database(database: Data, omega: Choice, heading: Choice, every: int, every_heading: int) -> Data:
    """`HydroDatabase.select`."""
    n = _chosen(database.name, "omega", omega, database.omega, turning=False)
    m = _chosen(database.name, "heading", heading, database.heading, turning=True)
    n, m = (
        _thinned(database.name, "every", n, every),
        _thinned(database.name, "every_heading", m, every_heading),
    )
    changes: dict[str, Any] = {name: getattr(database, name)[n] for name in BY_FREQUENCY}
    changes |= {"omega": database.omega[n], "heading": database.heading[m]}
    changes["force"] = database.force[np.ix_(m, n)]
    if database.motion_rao is not None:
        changes["motion_rao"] = database.motion_rao[np.ix_(m, n)]
    if database.roll_damping is not None:
        changes["roll_damping"] = dataclasses.replace(
            database.roll_damping,
            linear=database.roll_damping.linear[n],
            quadratic=database.roll_damping.quadratic[n],
            linearised=database.roll_damping.linearised[np.ix_(m, n)],
        )
    changes["additional"] = tuple(
        dataclasses.replace(part, **{name: getattr(part, name)[n] for name in PER_CAUSE})
        for part in database.additional
    )
    changes["trusted_band"] = _band(database, database.omega[n])
    if len(n) < len(database.omega):
        changes["memory"] = None
    return dataclasses.replace(database, **changes)


def _chosen(name: str, what: str, choice: Choice, values: FloatArray, *, turning: bool) -> Indices:
    """Rising indices of the values that are chosen: a pair is a range, anything else indices."""
    every = np.arange(len(values))
    if choice is None:
        return every
    if isinstance(choice, tuple):
        found = _in_range(name, what, choice, values, turning=turning)
    elif isinstance(choice, slice):
        found = every[choice]
    else:
        found = _indices(name, what, choice, len(values))
    if found.size == 0:
        raise ValueError(
            f"database {name!r}: {what} = {choice!r} leaves nothing of {values[0]:.4g} to {values[-1]:.4g} "
            f"{'rad' if turning else 'rad/s'}; widen it"
        )
    return np.sort(found)


def _in_range(
    name: str, what: str, choice: tuple[float, float], values: FloatArray, *, turning: bool
) -> Indices:
    ends = np.asarray(choice, dtype=float) if len(choice) == 2 else np.full(2, np.nan)
    low, high = float(ends[0]), float(ends[1])
    if not np.all(np.isfinite(ends)) or low > high:
        raise ValueError(
            f"database {name!r}: {what} = {choice!r} is no range; give (low, high), or a list of indices"
        )
    if not turning:
        return np.flatnonzero((values >= low - TOLERANCE) & (values <= high + TOLERANCE))
    from_low = np.mod(values - low + TOLERANCE, 2.0 * np.pi)
    return np.flatnonzero(from_low <= high - low + 2.0 * TOLERANCE)


def _indices(name: str, what: str, choice: Any, count: int) -> Indices:
    array = np.asarray(choice)
    if array.ndim != 1 or (array.size and not np.issubdtype(array.dtype, np.integer)):
        raise ValueError(
            f"database {name!r}: {what} = {choice!r} is neither a range (low, high) nor a list of integer "
            "indices"
        )
    if np.any((array < -count) | (array >= count)):
        raise ValueError(f"database {name!r}: {what} = {choice!r} counts beyond its {count} values")
    found = np.mod(array.astype(np.intp), count)
    if len(np.unique(found)) < len(found):
        raise ValueError(f"database {name!r}: {what} = {choice!r} names a value twice; name each once")
    return found


def _thinned(name: str, what: str, indices: Indices, step: int) -> Indices:
    if isinstance(step, bool) or not isinstance(step, (int, np.integer)) or step < 1:
        raise ValueError(f"database {name!r}: {what} = {step!r}; give a positive whole number")
    return indices[::step]


def _band(database: HydroData, omega: FloatArray) -> tuple[float, float] | None:
    """The trusted band within the frequencies that are left; where only one is inside, the band as it was."""
    if database.trusted_band is None:
        return None
    low, high = database.trusted_band
    if not np.any((omega >= low - TOLERANCE) & (omega <= high + TOLERANCE)):
        raise ValueError(
            f"database {database.name!r}: the selected frequencies, {omega[0]:.4g} to {omega[-1]:.4g} rad/s, "
            f"all lie outside the trusted band {low:.4g} to {high:.4g} rad/s; include some of it"
        )
    inner = max(low, float(omega[0])), min(high, float(omega[-1]))
    return inner if inner[0] < inner[1] else (low, high)
