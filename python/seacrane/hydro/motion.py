"""Frequency-domain motions and natural periods of the vessel alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from seacrane.hydro.database import HydroDatabase

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]


def motion_response(
    database: HydroDatabase, *, added_mass: FloatArray | None = None, damping: FloatArray | None = None
) -> ComplexArray:
    """Motions (m, n, 6) per metre of wave amplitude, at the database's headings and frequencies.

    Solves ``(-w^2 (M + A + A_add) + i w (B + B_add + B_lin + B_roll) + C + C_add) X = F``, the roll damping
    being the linear plus the linearised one where the source tabulates them. ``added_mass`` and ``damping``
    (n, 6, 6), when given, take the place of A and B *and* of the additional A, B and C: that is how a fitted
    memory is judged. The database's quadratic damping is left out.
    """
    w = database.omega[:, None, None]
    if added_mass is None or damping is None:
        added_mass = database.added_mass + sum(part.added_mass for part in database.additional)
        damping = database.damping + sum(part.damping for part in database.additional)
        restoring = database.restoring + sum(part.restoring for part in database.additional)
    else:
        restoring = database.restoring
    dynamic: ComplexArray = np.asarray(
        -(w**2) * (database.mass_matrix + added_mass)
        + 1j * w * (damping + database.linear_damping)
        + restoring
    )
    by_heading = np.broadcast_to(dynamic, (len(database.heading), *dynamic.shape)).copy()
    if database.roll_damping is not None:
        roll = database.roll_damping.linear + database.roll_damping.linearised
        by_heading[:, :, 3, 3] += 1j * database.omega * roll
    return np.asarray(np.linalg.solve(by_heading, database.force[..., None])[..., 0])


def natural_frequency(database: HydroDatabase, motion: int) -> float | None:
    """Undamped, uncoupled natural frequency (rad/s) of one motion, additional matrices left out.

    None where the motion has no restoring, or the resonance lies outside the database.
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
