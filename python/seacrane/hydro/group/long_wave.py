"""What a wave far longer than the hulls does to each of them, whatever lies beside it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_group_data import HydroGroupData
from seacrane.sea.dispersion import wavenumber

FloatArray = NDArray[np.float64]

LONGEST_SIZE = 0.1  # of 1 / k: hulls this broad and this deep are lifted as by a rising water level


def long_wave_lift(group: HydroGroupData) -> FloatArray | None:
    """C33 (k,) of each body by the vertical force of the group's longest wave, N/m.

    Bodies held in water that rises by 1 m are bodies that all move down, ``F = C33 - w^2 sum A``. None where
    that wave is not much longer than they are broad and deep.
    """
    k = float(wavenumber(group.omega[:1], g=group.g, depth=group.depth)[0])
    if k * max(max(body.breadth, body.draught) for body in group.bodies) > LONGEST_SIZE:
        return None
    inertia = group.omega[0] ** 2 * group.added_mass[0, 2::6, 2::6].sum(axis=1)
    return np.asarray(np.abs(group.force[:, 0, 2::6] + inertia).mean(axis=0))
