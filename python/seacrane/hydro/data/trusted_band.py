"""The frequencies for which the source of a database vouches."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_group_data import Hydrodynamics

FloatArray = NDArray[np.float64]


def in_trusted_band(database: Hydrodynamics, omega: FloatArray | None = None) -> NDArray[np.bool_]:
    """Which of ``omega`` (rad/s, any shape; None: the database's) lie in it; all where there is no band."""
    low, high = database.trusted_band or (0.0, np.inf)
    omega = database.omega if omega is None else omega
    return np.asarray((omega >= low - 1e-9) & (omega <= high + 1e-9))
