"""Main dimensions for sources that give none: the box of the same waterplane area, stiffness and volume."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def equivalent_box(restoring: FloatArray, volume: float, weight_density: float) -> tuple[float, float, float]:
    """Length, breadth, draught (m) of the floating box that C33, C55 (6, 6) and the volume (m3) describe.

    A box has ``C55 / C33 = L^2 / 12`` but for the small term of the heights of buoyancy and gravity,
    waterplane ``C33 / (rho g) = L B`` and volume ``L B T``. ``weight_density`` is rho g in N/m3. A pointed
    ship comes out shorter than it is (246 m as 226 m): good enough for scales, not for geometry. Where C55 is
    not positive, of a hull that turns over by itself, it tells no length: the box is as broad as long.

    Raises ValueError: C33 is not positive: nothing floats on this waterplane.
    """
    heave, pitch = float(restoring[2, 2]), float(restoring[4, 4])
    if heave <= 0.0:
        raise ValueError(
            f"restoring C33 = {heave:.6g} N/m and C55 = {pitch:.6g} N m/rad; the first has to be positive "
            "for a floating vessel: check the hydrostatics"
        )
    area = heave / weight_density if weight_density > 0.0 else 0.0
    length = float(np.sqrt(12.0 * pitch / heave)) if pitch > 0.0 else float(np.sqrt(area))
    if not (0.0 < area < np.inf and 0.0 < length < np.inf):
        raise ValueError(
            f"C33 = {heave:.6g} N/m and C55 = {pitch:.6g} N m/rad with {weight_density:.6g} N/m3 of water "
            "are of no floating box: check density, gravity and hydrostatics"
        )
    return length, area / length, volume / area
