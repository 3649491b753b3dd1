"""Wave excitation beyond the frequencies of a database: what it tends to, and how much is left out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.dispersion import wavenumber

if TYPE_CHECKING:
    from seacrane.hydro.database.database import HydroDatabase

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

END = 0.8  # of the highest frequency: the slope of the forces is fitted from there on
FEWEST = 3  # frequencies of that fit
AT_ONCE = 256  # headings, to bound the memory it takes
SLIGHT = 1e-3  # of the variance that the same waves would give a load from its worst heading
LOADS = ("surge", "sway", "heave", "roll", "pitch", "yaw")


def with_limits(database: HydroDatabase, omega: FloatArray, force: ComplexArray) -> ComplexArray:
    """Forces beyond the band: towards the hydrostatic ones of a long wave below it, none above it.

    A wave much longer than the hull lifts the water around it as one: its force tends to the third column of
    the restoring matrix, and what is left of it falls with the wavenumber (slope of the surface, and
    acceleration along it). So below the band F = C_3 + (F_lowest - C_3) k / k_lowest.

    Parameters
    ----------
    omega : (n,) rad/s.
    force : (..., n, 6) N/m and N m/m, beyond the band those of its nearest end.

    Returns
    -------
    (..., n, 6), a new array.
    """
    out = np.array(force)
    lowest, highest = database.omega[0], database.omega[-1]
    slack = 1e-9 * highest
    below = omega < lowest - slack
    longest = np.append(np.maximum(omega[below], 1e-9 * lowest), lowest)
    k = wavenumber(longest, g=database.g, depth=database.depth)
    share = (k[:-1] / k[-1])[:, None]
    out[..., below, :] = database.restoring[:, 2] * (1.0 - share) + out[..., below, :] * share
    out[..., omega > highest + slack, :] = 0.0
    return out


@dataclass(frozen=True, kw_only=True)
class WithoutLoad:
    """How much of a sea is above the band of a database, and so puts no load on its vessel.

    Attributes
    ----------
    energy : float
        Share of the energy of the waves.
    variance : float
        Largest share of the variance of a load; what is left out is estimated from the slope of the forces
        at the end of the band.
    load : str
        Which load that is.
    """

    energy: float
    variance: float
    load: str


def without_load(
    database: HydroDatabase,
    *,
    omega: FloatArray,
    amplitude: FloatArray,
    direction: FloatArray,
    force: ComplexArray,
) -> WithoutLoad:
    """What the components of a sea above the band would add.

    Forces there are taken to go on as the power of the frequency that they follow at the end of the band
    (least squares through its last fifth), and never to grow. Loads that are next to none at these headings
    (roll in a head sea) are not judged.

    Parameters
    ----------
    omega, amplitude, direction : (n,) rad/s, m, rad relative to the vessel.
    force : (n, 6) on the vessel per amplitude, none above the band; N/m and N m/m.
    """
    energy = 0.5 * amplitude**2
    above = omega > database.omega[-1] * (1.0 + 1e-9)
    if not np.any(above):
        return WithoutLoad(energy=0.0, variance=0.0, load=LOADS[0])
    carried = energy @ np.abs(force) ** 2
    missing = energy[above] @ _tail(database, omega[above], direction[above]) ** 2
    whole = carried + missing
    judged = whole > SLIGHT * (energy[~above] @ _worst_heading(database, omega[~above]) ** 2)
    share = np.where(judged, missing / np.where(judged, whole, 1.0), 0.0)
    worst = int(share.argmax())
    return WithoutLoad(
        energy=float(energy[above].sum() / energy.sum()), variance=float(share[worst]), load=LOADS[worst]
    )


def _worst_heading(database: HydroDatabase, omega: FloatArray) -> FloatArray:
    """Largest magnitudes (n, 6) over all headings."""
    largest = np.abs(database.force).max(axis=0)
    return np.stack([np.interp(omega, database.omega, column) for column in largest.T], axis=1)


def _tail(database: HydroDatabase, omega: FloatArray, direction: FloatArray) -> FloatArray:
    """Magnitudes (n, 6) of the forces above the band."""
    end = database.omega[database.omega >= END * database.omega[-1]]
    end = end if end.size >= FEWEST else database.omega[-FEWEST:]
    heading, of_component = np.unique(direction, return_inverse=True)
    parts = np.array_split(heading, -(-heading.size // AT_ONCE))
    force = np.abs(np.concatenate([database.force_at(end[None, :], part[:, None]) for part in parts]))
    least = 1e-9 * np.abs(database.force).max(axis=(0, 1)) + 1e-300
    level, x = np.log(np.maximum(force, least)), np.log(end / database.omega[-1])
    spread = x - x.mean()
    slope = np.einsum("k,hkd->hd", spread, level) / np.sum(spread**2)
    last = level.mean(axis=1) - slope * x.mean()
    growth = np.minimum(slope, 0.0)[of_component] * np.log(omega / database.omega[-1])[:, None]
    return np.asarray(np.exp(last[of_component] + growth))
