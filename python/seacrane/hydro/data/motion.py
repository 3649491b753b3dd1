"""Motions and natural periods of the vessel alone, and at forward speed frequencies of encounter."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import Hydrodynamics, mass_of
from seacrane.hydro.data.interpolation import by_straight_lines, spline_weights
from seacrane.sea.dispersion import wavenumber

SLACK = 1e-9  # of the highest frequency: the rounding of sums that meet an end of the table
BEAM = 1e-6  # |cos(heading)| below which speed leaves the frequency as it is


def encounter_frequency(database: HydroData) -> Array:
    """``omega - k U cos(heading)`` (m, n) in rad/s; negative where following waves are overtaken."""
    k = wavenumber(database.omega, g=database.g, depth=database.depth)
    return np.asarray(database.omega - database.speed * np.outer(np.cos(database.heading), k))


def encounter_frequency_at(database: HydroData, omega: Array, heading: Array) -> Array:
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


def inside_table(omega: Array, encounter: Array) -> NDArray[np.bool_]:
    """Whether encounter frequencies, whatever their sign, lie within the range of ``omega``."""
    slack, size = SLACK * omega[-1], np.abs(encounter)
    return np.asarray((size >= omega[0] - slack) & (size <= omega[-1] + slack))


def at_encounter(omega: Array, encounter: Array, table: Array) -> Array:
    """``table`` (n, ...) by cubic splines at ``|encounter|`` (...), which outside the table is an end."""
    weights = spline_weights(omega, np.clip(np.abs(encounter).ravel(), omega[0], omega[-1]))
    found = weights @ table.reshape(len(omega), -1)
    return np.asarray(found.reshape(*encounter.shape, *table.shape[1:]))


def one_function(
    tables: Array, *, omega: Array, encounter: Array, band: tuple[float, float]
) -> tuple[Array, Array, tuple[float, float]]:
    """Tables (m, n, k) per heading and wave frequency as one function of encounter frequency at ``omega``.

    Where a heading has encounter frequencies equal to ``omega`` (a beam sea), its table is taken; elsewhere
    all headings are joined by linear interpolation in the encounter frequency, and held beyond their ends.

    Returns the function (n, k); by how much a heading's table differs from it at most (k,), within ``band``
    (rad/s); and the range of encounter frequencies that some heading covers.
    """
    size = np.abs(encounter)
    beam = np.flatnonzero(np.all(np.abs(encounter - omega) <= BEAM * omega, axis=1))
    known = (float(omega[0]), float(omega[-1])) if beam.size else (float(size.min()), float(size.max()))
    values = tables[beam[0]] if beam.size else _joined(tables, size, omega)
    low, high = max(band[0], known[0], omega[0]), min(band[1], known[1], omega[-1])
    judged = (size >= low) & (size <= high)
    found = at_encounter(omega, encounter, values)
    difference = np.where(judged[:, :, None], np.abs(found - tables), 0.0).max(axis=(0, 1))
    return values, difference, known


def _joined(tables: Array, size: Array, omega: Array) -> Array:
    """Linear interpolation (n, k) through the points of all headings; coinciding points are averaged."""
    points, place = np.unique(np.round(size.ravel(), 9), return_inverse=True)
    rows = np.zeros((len(points), tables.shape[2]))
    np.add.at(rows, place.ravel(), tables.reshape(-1, tables.shape[2]))
    rows /= np.bincount(place.ravel())[:, None]
    if len(points) == 1:
        return np.repeat(rows, len(omega), axis=0)
    return by_straight_lines(points, rows, np.clip(omega, points[0], points[-1]))


def motion_response(
    database: Hydrodynamics, *, added_mass: Array | None = None, damping: Array | None = None
) -> Complex:
    """Motions (m, n, 6) per metre of wave amplitude, at the database's headings and wave frequencies.

    Of a `HydroGroup` of k hulls (m, n, 6 k): all together, as the water couples them.

    Solves ``(-w^2 (M + A + A_add) + i w (B + B_add + B_lin + B_roll) + C + C_add) X = F``, the roll damping
    being the linear plus the linearised one where the source tabulates them. ``added_mass`` and ``damping``
    (n, 6, 6), when given, take the place of A and B *and* of the additional A, B and C: that is how a fitted
    memory is judged. The database's quadratic damping is left out.

    At forward speed w is the encounter frequency, at which the matrices are interpolated (at its size where
    following waves are overtaken and it is negative). Where it lies outside the database's frequencies, so
    that nothing is known, the motions are NaN.
    """
    dynamic, known = _dynamic_stiffness(database, added_mass, damping)
    dynamic[~known] = np.eye(dynamic.shape[-1])
    motions = np.linalg.solve(dynamic, database.force[..., None])[..., 0]
    return np.asarray(np.where(known[:, :, None], motions, np.nan))


def force_of_motion(database: Hydrodynamics, motion: Complex) -> Complex:
    """The wave forces (m, n, 6) that make these motions (m, n, 6): what `motion_response` solves, backwards.

    NaN where the frequency of encounter lies outside the database's.
    """
    dynamic, known = _dynamic_stiffness(database, None, None)
    force = (dynamic @ motion[..., None])[..., 0]
    return np.asarray(np.where(known[:, :, None], force, np.nan))


def _dynamic_stiffness(
    database: Hydrodynamics, added_mass: Array | None, damping: Array | None
) -> tuple[Complex, NDArray[np.bool_]]:
    """(m, n, 6, 6), and where it is known (m, n); arguments as of `motion_response`."""
    if added_mass is None or damping is None:
        added_mass = database.added_mass + sum(part.added_mass for part in database.additional)
        damping = database.damping + sum(part.damping for part in database.additional)
        restoring = database.restoring + sum(part.restoring for part in database.additional)
    else:
        restoring = database.restoring
    inertia = mass_of(database) + added_mass
    damping = damping + database.linear_damping
    if database.roll_damping is not None:
        damping = damping.copy()
        damping[:, 3, 3] += database.roll_damping.linear
    stiffness = np.broadcast_to(restoring, damping.shape)
    shape = (len(database.heading), len(database.omega))
    known = np.ones(shape, dtype=bool)
    w = np.broadcast_to(database.omega, shape)
    if isinstance(database, HydroData) and database.speed != 0.0:
        w = encounter_frequency(database)
        known = inside_table(database.omega, w)
        inertia, damping, stiffness = (
            at_encounter(database.omega, w, table) for table in (inertia, damping, stiffness)
        )
    square, first = w[:, :, None, None] ** 2, w[:, :, None, None]
    dynamic: Complex = np.asarray(-square * inertia + 1j * first * damping + stiffness)
    if database.roll_damping is not None:
        dynamic[:, :, 3, 3] += 1j * w * database.roll_damping.linearised
    return dynamic, known


def natural_frequency(database: HydroData, motion: int) -> float | None:
    """Undamped, uncoupled natural frequency (rad/s) of one motion, additional matrices left out.

    None where the motion has no restoring, or the resonance lies outside the database. At forward speed it is
    a frequency of encounter.
    """
    stiffness = float(database.restoring[motion, motion])
    if stiffness <= 0.0:
        return None
    inertia = mass_of(database)[motion, motion] + database.added_mass[:, motion, motion]
    balance = stiffness - database.omega**2 * inertia
    falling = np.flatnonzero((balance[:-1] > 0.0) & (balance[1:] <= 0.0))
    if falling.size == 0:
        return None
    i = int(falling[0])
    part = balance[i] / (balance[i] - balance[i + 1])
    return float(database.omega[i] + part * (database.omega[i + 1] - database.omega[i]))


def motion_errors(
    database: HydroData,
    solved: Complex,
    given: Complex,
    *,
    inside: NDArray[np.bool_] | None = None,
) -> Array:
    """Largest difference (6,) over the frequencies and headings, by the largest motion of its heading.

    ``inside`` (n,) or (m, n) says which count.

    Motions that symmetry forbids (sway, roll, yaw in head and following sea, surge in beam sea) are noise in
    files: headings where a motion stays below the source's floor, a share of its largest, are left out.
    """
    use = np.broadcast_to(True if inside is None else inside, given.shape[:2])[:, :, None]
    largest = np.where(use, np.abs(given), 0.0).max(axis=1)
    error = np.where(use, np.abs(solved - given), 0.0).max(axis=1)
    counted = largest > database.motion_rao_floor * largest.max(axis=0)
    return np.asarray(np.where(counted, error / np.where(counted, largest, 1.0), 0.0).max(axis=0))
