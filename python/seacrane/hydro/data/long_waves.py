"""What motions are in waves far longer than a hull, which follows them: whatever it is, that is known."""

from __future__ import annotations

from weakref import WeakKeyDictionary

import numpy as np

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.motion import motion_response
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import RaoPhaseWarning

FOLLOWS = (0.5, 1.6)  # of the limit's amplitude: a hull that follows the wave
LARGEST_PHASE = np.radians(60.0)  # from the limit's
ALONG = 0.5  # least cosine of a heading in which pitch is judged
_SLIPS: WeakKeyDictionary[HydroData, list[str]] = WeakKeyDictionary()  # each database is judged once


def phase_slip(omega: float, heading: Array, motions: Complex, *, depth: float, g: float) -> str:
    """What is wrong with the phases of motions (m, 6) in a wave; empty: nothing that can be told.

    A hull follows a wave where both amplitudes are those of the limit; in shorter waves nothing is told.
    """
    slope = float(wavenumber(np.array([omega]), g=g, depth=depth)[0])
    along = np.cos(heading)
    limit = np.stack([np.ones(along.size, dtype=complex), 1j * slope * along], axis=1)  # heave and pitch
    judged = np.stack([np.ones(along.size, dtype=bool), np.abs(along) >= ALONG], axis=1)
    found = motions[:, [2, 4]]
    ratio = np.divide(found, limit, out=np.ones_like(found), where=judged)
    mirrored = np.divide(np.conj(found), limit, out=np.ones_like(found), where=judged)
    follows = np.all((np.abs(ratio) >= FOLLOWS[0]) & (np.abs(ratio) <= FOLLOWS[1]), axis=1)
    off = np.where(follows[:, None], np.abs(np.angle(ratio)), 0.0)
    at, motion = np.unravel_index(int(off.argmax()), off.shape)
    if off[at, motion] <= LARGEST_PHASE:
        return ""
    turned = np.all(np.abs(np.angle(mirrored[follows])) <= LARGEST_PHASE)
    guess = (
        "their signs are those of lags: give the complex conjugate" if turned
        else "phases in degrees take numpy.radians; else their origin or an axis is another one"
    )  # fmt: skip
    towards, angle = np.degrees(heading[at]), np.degrees(off[at, motion])
    return (
        f"{MOTIONS[(2, 4)[int(motion)]]} at {omega:.4g} rad/s, in waves to {towards:.4g} deg, is {angle:.3g} "
        "deg out of phase with a hull that follows the wave, as it does by its amplitudes: "
        f"{guess}. See docs/conventions.md"
    )


def warn_of_long_waves(database: HydroData) -> None:
    """Warn of a database at zero speed by its motions in the longest wave, as given and as its loads make."""
    if database not in _SLIPS:
        _SLIPS[database] = _slips(database)
    for said in _SLIPS[database]:
        warn_caller(f"database {database.name!r}: {said}", RaoPhaseWarning)


def _slips(database: HydroData) -> list[str]:
    if database.speed != 0.0:
        return []
    given = {"": database.motion_rao}
    if database.mass_matrix is not None:
        given["by its wave loads, "] = motion_response(database)
    lowest, water = float(database.omega[0]), {"depth": database.depth, "g": database.g}
    slips = {
        source: phase_slip(lowest, database.heading, motions[:, 0], **water)
        for source, motions in given.items()
        if motions is not None
    }
    return [source + said for source, said in slips.items() if said]
