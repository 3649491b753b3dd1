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
from seacrane.scene.drift import drift_by_heading
from seacrane.validity.hull_range import peak_frequency

Array = NDArray[np.float64]
SLOW_SHARE = 0.2  # of the peak frequency: motions below are slow


def with_actual_position(scene: Description, waves: Waves, vessel: str, cutoff: float = 0.0) -> Waves:
    """The sea with loads of all headings on a vessel: they are taken where it is at the moment.

    Phases follow the vessel (a moving one meets the encounter frequency), and force RAOs its heading
    relative to the waves, by the same splines as `HydroDatabase.force_at`. All components are summed in every
    evaluation.

    First-order loads belong to the position about which a hull oscillates: at that of the moment its motion
    in the waves is counted a second time. With a `cutoff`, rad/s, the fast part of surge, sway and yaw, that
    above it, is left out. It is kept as nine states of the vessel: each motion through the high-pass filter
    s^2 (s + 2 w) / (s^3 + 2 w s^2 + 2 w^2 s + w^3), w the cut-off, from zero at the start. What is left
    follows a steady drift without lag, and keeps 2 (w / omega)^2 of a motion at omega far above w.

    Raises SceneError if the headings of its database do not cover the circle.
    """
    database = database_of(scene, vessel, "its wave loads at all headings")
    drift = None if waves.hull(vessel).drift is None else drift_by_heading(database, waves.omega)
    table = force_by_heading(database, waves.omega)
    return waves.changed(vessel, force_by_heading=table, drift_by_heading=drift, cutoff=cutoff)


def slow_below(waves: Waves, cutoff: float | None) -> float:
    """The cut-off between slow drift and waves, rad/s; SceneError for what is none."""
    if cutoff is None:
        return SLOW_SHARE * peak_frequency(waves)
    if not (np.isfinite(number_of("sea: cutoff", cutoff)) and cutoff > 0.0):
        raise SceneError(f"sea: cutoff is {cutoff} rad/s; give a frequency between slow drift and waves")
    return float(cutoff)


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
