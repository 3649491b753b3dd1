"""Wave loads at a vessel's actual or slow position and heading, in place of the mean ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.description.databases import database_of
from seacrane.description.description import Description
from seacrane.description.waves import ByHeading, Waves
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase
from seacrane.hydro.data.excitation import with_limits
from seacrane.hydro.data.interpolation import spline_weights
from seacrane.inputs.checked import number_of
from seacrane.scene.drift import drift_by_heading, sea_of
from seacrane.validity.hull_range import peak_frequency

Array = NDArray[np.float64]
SLOW_SHARE = 0.2  # of the peak frequency: motions below are slow


def use_actual_position(scene: Description, *, vessel: str | None = None) -> None:
    """Take wave loads at the vessel's position and heading of the moment instead of the mean ones.

    Phases follow the vessel (a moving one meets the encounter frequency), and force RAOs its heading
    relative to the waves, by the same splines as `HydroDatabase.force_at`. All components are summed in every
    evaluation. Call it after `add_sea`.

    Parameters
    ----------
    vessel : str, optional
        Body of the vessel; default: the only one in the sea.

    Raises
    ------
    SceneError
        Without a sea, for a vessel that is not in it, or if the headings of its database do not cover the
        circle.
    """
    scene.waves = _with_headings(scene, sea_of(scene, "loads at the actual position"), vessel, cutoff=0.0)


def use_slow_position(scene: Description, *, vessel: str | None = None, cutoff: float | None = None) -> None:
    """Take wave loads at the slow part of the vessel's position and heading.

    First-order loads belong to the position about which a hull oscillates: at that of the moment its motion
    in the waves is counted a second time. The fast part of surge, sway and yaw, that above the cut-off, is
    kept as nine states of the vessel: each motion through the high-pass filter
    s^2 (s + 2 w) / (s^3 + 2 w s^2 + 2 w^2 s + w^3), w the cut-off, from zero at the start. What is left
    follows a steady drift without lag, and keeps 2 (w / omega)^2 of a motion at omega far above w. Otherwise
    as `use_actual_position`, at the same cost. Call it after `add_sea`.

    Parameters
    ----------
    vessel : str, optional
        Body of the vessel; default: the only one in the sea.
    cutoff : float
        rad/s, between slow drift and waves; default: a fifth of the frequency at the sea's peak.

    Raises
    ------
    SceneError
        As `use_actual_position`, or for a cut-off that is not positive.
    """
    waves = sea_of(scene, "loads at the slow position")
    cutoff = SLOW_SHARE * peak_frequency(waves) if cutoff is None else number_of("sea: cutoff", cutoff)
    if not (np.isfinite(cutoff) and cutoff > 0.0):
        raise SceneError(f"sea: cutoff is {cutoff} rad/s; give a frequency between slow drift and waves")
    scene.waves = _with_headings(scene, waves, vessel, cutoff=cutoff)


def _with_headings(scene: Description, waves: Waves, vessel: str | None, *, cutoff: float) -> Waves:
    """The sea with loads of all headings on a vessel."""
    database = database_of(scene, waves.body_of(vessel), "its wave loads at all headings")
    force, drift = force_by_heading(database, waves.omega), None
    if waves.hull(vessel).drift is not None:
        drift = drift_by_heading(database, waves.omega, "hold")  # add_drift has judged the range
    return waves.changed(vessel, force_by_heading=force, drift_by_heading=drift, cutoff=cutoff)


def force_by_heading(database: HydroDatabase, omega: Array) -> ByHeading:
    """Force RAOs at some frequencies for all headings of the database.

    Parameters
    ----------
    omega : (n,) rad/s; beyond the database's as `HydroDatabase.force_at` with ``outside="limits"``.

    Returns
    -------
    ByHeading
        N/m and N m/m.

    Raises SceneError if the headings do not cover the circle.
    """
    heading, table = database.full_circle()
    if np.diff(np.append(heading, heading[0] + 2.0 * np.pi)).max() > np.pi / 4.0 + 1e-9:
        raise SceneError(
            f"database {database.name!r}: headings {np.degrees(heading).round(3).tolist()} deg leave gaps "
            "above 45 deg; a vessel that turns needs them all round"
        )
    weights = spline_weights(database.omega, np.clip(omega, database.omega[0], database.omega[-1]))
    values = np.stack([weights @ at_heading for at_heading in table])
    return ByHeading(heading=heading, values=with_limits(database, omega, values))
