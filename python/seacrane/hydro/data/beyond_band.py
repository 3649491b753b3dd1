"""Wave excitation above the frequencies of a database: how much of a sea is left out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.excitation import force_at
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.inputs.frames import MOTIONS

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

END = 0.8  # of the highest frequency: the slope of the forces is fitted from there on
FEWEST = 3  # frequencies of that fit
AT_ONCE = 256  # headings, to bound the memory it takes
SLIGHT = 1e-3  # of the variance that the same waves would give a load from its worst heading


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
    database: HydroData,
    *,
    omega: FloatArray,
    amplitude: FloatArray,
    direction: FloatArray,
    force: ComplexArray,
) -> WithoutLoad:
    """What the components of a sea above the band would add.

    Forces there are taken to continue as the power of the frequency that they follow at the end of the band
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
        return WithoutLoad(energy=0.0, variance=0.0, load=MOTIONS[0])
    carried = energy @ np.abs(force) ** 2
    missing = energy[above] @ _tail(database, omega[above], direction[above]) ** 2
    whole = carried + missing
    judged = whole > SLIGHT * (energy[~above] @ _worst_heading(database, omega[~above]) ** 2)
    share = np.where(judged, missing / np.where(judged, whole, 1.0), 0.0)
    worst = int(share.argmax())
    return WithoutLoad(
        energy=float(energy[above].sum() / energy.sum()), variance=float(share[worst]), load=MOTIONS[worst]
    )


def _worst_heading(database: HydroData, omega: FloatArray) -> FloatArray:
    """Largest magnitudes (n, 6) over all headings."""
    largest = np.abs(database.force).max(axis=0)
    return np.stack([np.interp(omega, database.omega, column) for column in largest.T], axis=1)


def _tail(database: HydroData, omega: FloatArray, direction: FloatArray) -> FloatArray:
    """Magnitudes (n, 6) of the forces above the band."""
    end = database.omega[database.omega >= END * database.omega[-1]]
    end = end if end.size >= FEWEST else database.omega[-FEWEST:]
    heading, of_component = np.unique(direction, return_inverse=True)
    parts = np.array_split(heading, -(-heading.size // AT_ONCE))
    force = np.abs(np.concatenate([force_at(database, end[None, :], part[:, None]) for part in parts]))
    least = 1e-9 * np.abs(database.force).max(axis=(0, 1)) + 1e-300
    level, x = np.log(np.maximum(force, least)), np.log(end / database.omega[-1])
    spread = x - x.mean()
    slope = np.einsum("k,hkd->hd", spread, level) / np.sum(spread**2)
    last = level.mean(axis=1) - slope * x.mean()
    growth = np.minimum(slope, 0.0)[of_component] * np.log(omega / database.omega[-1])[:, None]
    return np.asarray(np.exp(last[of_component] + growth))
