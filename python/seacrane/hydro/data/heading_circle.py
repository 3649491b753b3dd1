"""Headings of a vessel: mirror images, gaps, and the phases of waves that go to them.

Far from its phase centre a hull's force or motion has the phase of the wave's travel,
``exp(-i k (x cos b + y sin b))``, which turns by more than a spline over headings follows. It is taken out
before interpolating, and put back after.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array, Complex
from seacrane.errors import SceneError
from seacrane.hydro.data.interpolation import spline_weights
from seacrane.sea.dispersion import wavenumber

PORT_STARBOARD = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
SAME_HEADING = 1e-6  # rad
SYMMETRY_TOLERANCE = 0.02
LARGEST_HEADING_GAP = np.radians(45.0)  # above it nothing is interpolated
FEWEST = 3  # headings
FOLLOWED = 0.02  # changes from heading to heading, squared, of the squares themselves: a spline follows them
BETTER = 0.5  # of the changes from heading to heading that are left; a shielded hull has 0.67 aside
STEP = 0.5  # rad of the shortest wave between two places that are tried
FARTHEST, MOST = 1.5, 400  # rad of the longest wave, and places on either side


def mirrored_heading(heading: Array) -> Array:
    """``2 pi - heading`` within [0, 2 pi)."""
    turned = np.mod(-heading, 2.0 * np.pi)
    return np.asarray(np.where(turned >= 2.0 * np.pi, 0.0, turned))


def both_sides(heading: Array) -> tuple[Array, NDArray[np.intp], NDArray[np.bool_]]:
    """Headings (k,) with their mirror images, rising; where each is found in ``heading``; which are mirrored.

    A mirror image that is among the headings already is left out.
    """
    turned = mirrored_heading(heading)
    distance = np.abs(np.angle(np.exp(1j * (turned[:, None] - heading))))
    new = np.flatnonzero(distance.min(axis=1) > SAME_HEADING)
    every = np.concatenate([heading, turned[new]])
    source = np.concatenate([np.arange(len(heading)), new])
    mirrored = np.arange(len(every)) >= len(heading)
    order = np.argsort(every)
    return every[order], source[order], mirrored[order]


def with_mirror_images(heading: Array, table: Complex) -> tuple[Array, Complex]:
    """`both_sides`, and the forces or motions (m, n, 6 k) there, of k hulls."""
    circle, source, mirrored = both_sides(heading)
    sides = np.tile(PORT_STARBOARD, table.shape[-1] // 6)
    return circle, table[source] * np.where(mirrored[:, None], sides, 1.0)[:, None, :]


def largest_gap(circle: Array) -> float:
    """Largest angle (rad) between neighbouring headings, across 2 pi too."""
    return float(np.diff(np.append(circle, circle[0] + 2.0 * np.pi)).max())


def heading_weights(what: str, circle: Array, heading: Array) -> Array:
    """Weights (q, k) of the periodic spline over the headings; stored headings are exact in any case.

    Raises SceneError: names ``what`` has no such heading, in a gap of more than 45 degrees.
    """
    gap = largest_gap(circle)
    if gap <= LARGEST_HEADING_GAP + 1e-9:
        return spline_weights(circle, heading, period=2.0 * np.pi)
    distance = np.abs(np.angle(np.exp(1j * (heading[:, None] - circle))))
    nearest = distance.argmin(axis=1)
    off = distance[np.arange(len(heading)), nearest] > 1e-6
    if np.any(off):
        raise SceneError(
            f"{what}: heading {np.degrees(heading[off][0]):.6g} deg is not among the stored ones, whose "
            f"largest gap is {np.degrees(gap):.3g} deg; above 45 deg nothing is interpolated"
        )
    return np.asarray(np.eye(len(circle))[nearest])


def keeps_sides_apart(added_mass: Array) -> bool:
    """Whether motions that port-starboard symmetric hulls keep apart are apart in (n, 6 k, 6 k), to 2 %."""
    peak = np.sqrt(np.abs(np.diagonal(added_mass, axis1=1, axis2=2)).max(axis=0))
    scale = np.outer(peak, peak)
    sides = np.tile(PORT_STARBOARD, len(peak) // 6)
    mixed = np.outer(sides, sides) < 0.0
    largest = np.abs(added_mass).max(axis=0)
    return bool(np.all(largest[mixed] <= SYMMETRY_TOLERANCE * scale[mixed]))


def phase_centre(k: Array, circle: Array, heave: Complex) -> Array:
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

    def left(point: Array) -> float:
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


def centred(k: Array, circle: Array, table: Complex) -> tuple[Complex, Array]:
    """Forces or motions (m, n, 6) without the phases of the wave's travel to their centre, and it."""
    centre = phase_centre(k, circle, table[:, :, 2])
    if np.any(centre):
        table = table / travel(centre, k, circle[:, None])[:, :, None]
    return table, centre


def travel(centre: Array, k: Array, heading: Array) -> Complex:
    """``exp(-i k (x cos b + y sin b))`` of k and headings (rad) that are broadcast against each other."""
    return np.asarray(np.exp(-1j * k * (centre[0] * np.cos(heading) + centre[1] * np.sin(heading))))


def phase_at(centre: Array, omega: Array, direction: Array, g: float, depth: float) -> Complex:
    """Factor (m, n, 1) that gives waves of zero phase at the centre: exp(+i k (x cos b + y sin b))."""
    along = centre[0] * np.cos(direction) + centre[1] * np.sin(direction)
    return np.asarray(np.exp(1j * np.outer(along, wavenumber(omega, g=g, depth=depth))))[:, :, None]
