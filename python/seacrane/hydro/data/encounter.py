"""Forward speed: encounter frequency, and matrices tabulated per heading as one function of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.interpolation import spline_weights
from seacrane.sea.dispersion import wavenumber

FloatArray = NDArray[np.float64]

SLACK = 1e-9  # of the highest frequency: the rounding of sums that meet an end of the table
BEAM = 1e-6  # |cos(heading)| below which speed leaves the frequency as it is


@dataclass(frozen=True, eq=False)
class OneFunction:
    """Tables (n, k) by encounter frequency, and how well the headings agree on them.

    ``difference`` (k,) is the largest difference between a heading's table and the function, in the tables'
    units; ``known`` is the range of encounter frequencies that some heading covers.
    """

    values: FloatArray
    difference: FloatArray
    known: tuple[float, float]


def encounter_frequency(database: HydroData) -> FloatArray:
    """``omega - k U cos(heading)`` (m, n) in rad/s; negative where following waves are overtaken."""
    k = wavenumber(database.omega, g=database.g, depth=database.depth)
    return np.asarray(database.omega - database.speed * np.outer(np.cos(database.heading), k))


def encounter_frequency_at(database: HydroData, omega: FloatArray, heading: FloatArray) -> FloatArray:
    """``omega - k U cos(heading)`` in rad/s of any wave frequencies and headings, which broadcast."""
    k = wavenumber(np.ravel(omega), g=database.g, depth=database.depth).reshape(np.shape(omega))
    return np.asarray(omega - database.speed * np.cos(heading) * k)


def require_zero_speed(database: HydroData) -> None:
    """Raise at forward speed, at which the memory and the equations of the time domain do not hold.

    Raises ValueError: names the speed.
    """
    if database.speed != 0.0:
        raise ValueError(
            f"database {database.name!r}: forward speed {database.speed:g} m/s; memory and the time "
            "domain are for zero speed: read the database with speed=0"
        )


def inside_table(omega: FloatArray, encounter: FloatArray) -> NDArray[np.bool_]:
    """Whether encounter frequencies, whatever their sign, lie within the range of ``omega``."""
    slack, size = SLACK * omega[-1], np.abs(encounter)
    return np.asarray((size >= omega[0] - slack) & (size <= omega[-1] + slack))


def at_encounter(omega: FloatArray, encounter: FloatArray, table: FloatArray) -> FloatArray:
    """``table`` (n, ...) by cubic splines at ``|encounter|`` (...), which outside the table is an end."""
    weights = spline_weights(omega, np.clip(np.abs(encounter).ravel(), omega[0], omega[-1]))
    found = weights @ table.reshape(len(omega), -1)
    return np.asarray(found.reshape(*encounter.shape, *table.shape[1:]))


def one_function(
    tables: FloatArray, *, omega: FloatArray, encounter: FloatArray, band: tuple[float, float]
) -> OneFunction:
    """Tables (m, n, k) per heading and wave frequency as one function of encounter frequency at ``omega``.

    Where a heading has encounter frequencies equal to ``omega`` (a beam sea), its table is taken; elsewhere
    all headings are joined by linear interpolation in the encounter frequency, and held beyond their ends.
    Agreement is judged where encounter frequencies lie within ``band`` (rad/s).
    """
    size = np.abs(encounter)
    beam = np.flatnonzero(np.all(np.abs(encounter - omega) <= BEAM * omega, axis=1))
    known = (float(omega[0]), float(omega[-1])) if beam.size else (float(size.min()), float(size.max()))
    values = tables[beam[0]] if beam.size else _joined(tables, size, omega)
    low, high = max(band[0], known[0], omega[0]), min(band[1], known[1], omega[-1])
    judged = (size >= low) & (size <= high)
    found = at_encounter(omega, encounter, values)
    difference = np.where(judged[:, :, None], np.abs(found - tables), 0.0).max(axis=(0, 1))
    return OneFunction(values, difference, known)


def _joined(tables: FloatArray, size: FloatArray, omega: FloatArray) -> FloatArray:
    """Linear interpolation (n, k) through the points of all headings; coinciding points are averaged."""
    points, place = np.unique(np.round(size.ravel(), 9), return_inverse=True)
    rows = np.zeros((len(points), tables.shape[2]))
    np.add.at(rows, place.ravel(), tables.reshape(-1, tables.shape[2]))
    rows /= np.bincount(place.ravel())[:, None]
    if len(points) == 1:
        return np.repeat(rows, len(omega), axis=0)
    where = np.clip(omega, points[0], points[-1])
    right = np.clip(np.searchsorted(points, where), 1, len(points) - 1)
    part = ((where - points[right - 1]) / (points[right] - points[right - 1]))[:, None]
    return np.asarray((1.0 - part) * rows[right - 1] + part * rows[right])
