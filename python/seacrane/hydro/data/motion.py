"""Frequency-domain motions and natural periods of the vessel alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.encounter import at_encounter, encounter_frequency, inside_table
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import Hydrodynamics

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]


def motion_response(
    database: Hydrodynamics, *, added_mass: FloatArray | None = None, damping: FloatArray | None = None
) -> ComplexArray:
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


def force_of_motion(database: Hydrodynamics, motion: ComplexArray) -> ComplexArray:
    """The wave forces (m, n, 6) that make these motions (m, n, 6): what `motion_response` solves, backwards.

    NaN where the frequency of encounter lies outside the database's.
    """
    dynamic, known = _dynamic_stiffness(database, None, None)
    force = (dynamic @ motion[..., None])[..., 0]
    return np.asarray(np.where(known[:, :, None], force, np.nan))


def _dynamic_stiffness(
    database: Hydrodynamics, added_mass: FloatArray | None, damping: FloatArray | None
) -> tuple[ComplexArray, NDArray[np.bool_]]:
    """(m, n, 6, 6), and where it is known (m, n); arguments as of `motion_response`."""
    if added_mass is None or damping is None:
        added_mass = database.added_mass + sum(part.added_mass for part in database.additional)
        damping = database.damping + sum(part.damping for part in database.additional)
        restoring = database.restoring + sum(part.restoring for part in database.additional)
    else:
        restoring = database.restoring
    inertia = database.mass_matrix + added_mass
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
    dynamic: ComplexArray = np.asarray(-square * inertia + 1j * first * damping + stiffness)
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
    inertia = database.mass_matrix[motion, motion] + database.added_mass[:, motion, motion]
    balance = stiffness - database.omega**2 * inertia
    falling = np.flatnonzero((balance[:-1] > 0.0) & (balance[1:] <= 0.0))
    if falling.size == 0:
        return None
    i = int(falling[0])
    part = balance[i] / (balance[i] - balance[i + 1])
    return float(database.omega[i] + part * (database.omega[i + 1] - database.omega[i]))


def motion_errors(
    database: HydroData,
    solved: ComplexArray,
    given: ComplexArray,
    *,
    inside: NDArray[np.bool_] | None = None,
) -> FloatArray:
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
