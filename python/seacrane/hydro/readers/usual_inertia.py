"""The mass matrix of a ship whose source tells its displaced volume alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.rigid_mass import rigid_mass_matrix
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import AssumedInertiaWarning

FloatArray = NDArray[np.float64]

USUAL_RADII = (0.36, 0.25, 0.25)  # of breadth, length, length


def usual_mass_matrix(
    where: object, why: str, *, mass: float, centre: FloatArray, length: float, breadth: float
) -> FloatArray:
    """The displaced mass (kg) at its centre (3,), m, with usual radii of gyration: (6, 6) in SI.

    Warns
    -----
    AssumedInertiaWarning : always; the message begins with ``where`` and ``why``.
    """
    radii = np.array(USUAL_RADII) * (breadth, length, length)
    warn_caller(
        f"{where}: {why}; the displaced mass {mass:.6g} kg with radii of gyration of "
        f"{radii[0]:.3g}, {radii[1]:.3g}, {radii[2]:.3g} m (0.36 B, 0.25 L, 0.25 L) is taken, and natural "
        "periods in roll and pitch follow from that guess",
        AssumedInertiaWarning,
    )
    return rigid_mass_matrix(mass, centre, np.diag(mass * radii**2))
