"""What the free surface of fitted tanks takes from the roll restoring, by every way of fitting it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.memory.fit import enough_frequencies, fit_memory
from seacrane.hydro.memory.retardation import retardation_functions

KINDS = ("per-pair", "by-motion")
ROLL = 3, 3
STEP, PHASE, DURATION = 0.2, 1.0, 60.0  # s, rad at the highest frequency, s: of a convolution that is not run

FloatArray = NDArray[np.float64]


def free_surface(database: HydroData, used: FloatArray) -> tuple[float, float, float] | None:
    """N m/rad that additional causes (roll tanks) take from C44: as used, least and most of all fits.

    A table of matrices by frequency does not tell a static stiffness: it is what a fit extends them to.

    Parameters
    ----------
    database : HydroDatabase
    used : ndarray, shape (6, 6)
        `additional_stiffness` of the model that a vessel has.

    Returns
    -------
    (float, float, float), or None without such causes, or where they take nothing.
    """
    if not database.additional:
        return None
    table = sum(float(part.restoring[(0, *ROLL)]) for part in database.additional)
    fits = [used]
    if enough_frequencies(database):
        step = min(STEP, PHASE / float(database.omega[-1]))
        slow = retardation_functions(database=database, step=step, duration=DURATION)
        fits.append(slow.additional_stiffness)
        fits += [fit_memory(database=database, kind=kind).additional_stiffness for kind in KINDS]
    taken = [-(table + float(one[ROLL])) for one in fits]
    return (taken[0], min(taken), max(taken)) if any(taken) else None
