"""The point of a hull at which the waves' phases turn least from heading to heading.

Far from it a force or a motion has the phase of the wave's travel, ``exp(-i k (x cos b + y sin b))``, which
turns by more than a spline over headings follows. It is taken out before interpolating, and put back after.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.heading_circle import LARGEST_HEADING_GAP, largest_gap

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

FEWEST = 3  # headings
FOLLOWED = 0.02  # changes from heading to heading, squared, of the squares themselves: a spline follows them
BETTER = 0.5  # of the changes from heading to heading that are left; a shielded hull has 0.67 aside
STEP = 0.5  # rad of the shortest wave between two places that are tried
FARTHEST, MOST = 1.5, 400  # rad of the longest wave, and places on either side


def phase_centre(k: FloatArray, circle: FloatArray, heave: ComplexArray) -> FloatArray:
    """The centre (2,), m from the reference point; zeros where that is as good.

    Parameters
    ----------
    k : (n,) wavenumbers, 1/m.
    circle : (m,) rad, rising, of all headings.
    heave : (m, n) forces or motions, any unit.
    """
    here = np.zeros(2)
    if len(circle) < FEWEST or not np.any(heave):
        return here
    closed = largest_gap(circle) <= LARGEST_HEADING_GAP + 1e-9
    after = np.roll(np.arange(len(circle)), -1)[: None if closed else -1]
    before = np.arange(len(after))
    along = np.stack([np.cos(circle), np.sin(circle)])
    together = heave[after] * np.conj(heave[before])

    def left(point: FloatArray) -> float:
        """Squares of the changes from heading to heading, but for what no centre alters."""
        turned = np.exp(1j * np.outer((along[:, after] - along[:, before]).T @ point, k))
        return float(-2.0 * np.sum((together * turned).real))

    whole = float(np.sum(np.abs(heave[after]) ** 2 + np.abs(heave[before]) ** 2))
    if whole + left(here) < FOLLOWED * whole:
        return here
    reach = min(FARTHEST / k[0], MOST * STEP / k[-1])
    places = np.arange(-reach, reach, STEP / k[-1])
    best = here
    for axis in (0, 1, 0, 1):
        tried = [best + (place - best[axis]) * np.eye(2)[axis] for place in places]
        best = min([best, *tried], key=left)
    if whole + left(best) > BETTER * (whole + left(here)):
        return here
    from scipy.optimize import minimize

    found = minimize(left, best, method="Nelder-Mead", options={"xatol": 1e-3 / k[-1], "maxiter": 200})
    return np.asarray(found.x, dtype=float)


def travel(centre: FloatArray, k: FloatArray, heading: FloatArray) -> ComplexArray:
    """``exp(-i k (x cos b + y sin b))`` of k and headings (rad) that are broadcast against each other."""
    return np.asarray(np.exp(-1j * k * (centre[0] * np.cos(heading) + centre[1] * np.sin(heading))))
