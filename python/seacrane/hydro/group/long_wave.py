"""What a wave far longer than the hulls does to each of them, whatever lies beside it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_group_data import HydroGroupData
from seacrane.sea.dispersion import wavenumber

FloatArray = NDArray[np.float64]

LONGEST_SIZE = 0.05  # of 1 / k: hulls this small, and this deep, are lifted as by a rising water level


def long_wave_lift(group: HydroGroupData) -> FloatArray | None:
    """Vertical force (k,) on each body per metre of the group's longest wave, which is C33 in the limit, N/m.

    None where that wave is not much longer than the bodies are deep.
    """
    k = float(wavenumber(group.omega[:1], g=group.g, depth=group.depth)[0])
    if k * max(body.draught for body in group.bodies) > LONGEST_SIZE:
        return None
    return np.asarray(np.abs(group.force[:, 0, 2::6]).mean(axis=0))
