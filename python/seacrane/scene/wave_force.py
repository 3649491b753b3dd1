"""Force RAOs of a database at the components of a sea."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro import HydroDatabase

Array = NDArray[np.float64]
AT_ONCE = 4096  # components whose transfer is interpolated together, to bound the memory it takes


def force_of_components(database: HydroDatabase, omega: Array, heading: Array) -> NDArray[np.complex128]:
    """N/m and N m/m, (n, 6), at frequencies (n,), rad/s, and headings (n,), rad, relative to the vessel."""
    rows = [
        database.force_at(omega[i : i + AT_ONCE], heading[i : i + AT_ONCE], outside="limits")
        for i in range(0, omega.size, AT_ONCE)
    ]
    return np.concatenate(rows).astype(complex).reshape(-1, 6)
