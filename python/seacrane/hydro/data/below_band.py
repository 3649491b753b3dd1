"""Databases used below the frequencies for which their source vouches: each use a warning."""

from __future__ import annotations

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.motion import natural_frequency
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.warnings import BelowBandWarning

MOST_BELOW = 0.1  # of the energy of the waves
FLOATING = (2, 3, 4)  # heave, roll, pitch


def warn_of_waves_below_band(database: HydroData, share: float, what: str) -> None:
    """Warn where more than a tenth of the energy of the waves is below the trusted band.

    Parameters
    ----------
    database : with `trusted_band`, or without, where nothing is known.
    share : of the energy of the waves below the band.
    what : whose waves these are, for the message.
    """
    if database.trusted_band is None or share <= MOST_BELOW:
        return
    warn_caller(
        f"{what}: {share:.0%} of their energy is below {database.trusted_band[0]:.3g} rad/s, where the "
        f"trusted band of database {database.name!r} begins; {_consequence(database)}",
        BelowBandWarning,
    )


def warn_of_resonance_below_band(database: HydroData) -> None:
    """Warn where heave, roll or pitch resonates below the trusted band."""
    if database.trusted_band is None or database.speed != 0.0:
        return
    low = database.trusted_band[0]
    found = {MOTIONS[i]: natural_frequency(database, i) for i in FLOATING}
    below = [f"{name} at {at:.3g} rad/s" for name, at in found.items() if at is not None and at < low]
    if below:
        warn_caller(
            f"database {database.name!r}: {', '.join(below)} resonates below {low:.3g} rad/s, where its "
            f"trusted band begins; {_consequence(database)}",
            BelowBandWarning,
        )


def _consequence(database: HydroData) -> str:
    if "strip theory" in database.source:
        return (
            "radiation damping of strip theory is too large there, several times in roll and more in pitch "
            "and yaw. Use hydro_from_hull(..., method='capytaine')"
        )
    return "its numbers are doubtful there. Use a database that covers these frequencies"
