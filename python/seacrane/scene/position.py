"""Slow wave drift of a vessel, and wave loads at its actual or slow position and heading."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.description.databases import database_of
from seacrane.description.description import Description
from seacrane.description.waves import ByHeading, Waves
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase
from seacrane.hydro.data.excitation import with_limits
from seacrane.hydro.data.heading_circle import PORT_STARBOARD
from seacrane.hydro.data.interpolation import spline_weights
from seacrane.inputs.checked import number_of
from seacrane.validity.hull_range import peak_frequency

Array = NDArray[np.float64]
SLOW_SHARE = 0.2  # of the peak frequency: motions below are slow


def with_drift(scene: Description, waves: Waves, vessel: str) -> Waves:
    """The sea with the slowly varying drift load on a vessel, by Newman's approximation.

    F(t) = sum_ik a_i a_k (D_i + D_k) / 2 cos(theta_i - theta_k) with the coefficients D of the database at
    each component's frequency and heading: difference frequencies only, mean sum a^2 D. Good for the slow
    motions of a moored vessel; it leaves out the second-order potential (which matters in shallow water) and
    the change of drift with the vessel's speed (wave drift damping).

    Raises SceneError without drift coefficients, and for components in a gap of more than 45 deg between
    their headings; beyond their frequencies those of the nearest are taken.
    """
    hull = waves.hull(vessel)
    database = database_of(scene, vessel, "its slow drift")
    table = None if hull.force_by_heading is None else drift_by_heading(database, waves.omega)
    drift = _drift_at(database, waves.omega, waves.direction - hull.heading)
    return waves.changed(vessel, drift=drift, drift_by_heading=table)


def drift_by_heading(database: HydroDatabase, omega: Array) -> ByHeading:
    heading, values = _circle_of(database, omega)
    return ByHeading(heading=heading, values=values)


def _circle_of(database: HydroDatabase, omega: Array) -> tuple[Array, Array]:
    """Headings all round (m,) and the coefficients there at the frequencies asked for (m, n, 6)."""
    drift = getattr(database, "drift", None)
    if drift is None:
        raise SceneError(f"database {database.name!r}: has no drift coefficients; read a set that holds them")
    weights = spline_weights(drift.omega, np.clip(omega, drift.omega[0], drift.omega[-1]))
    heading, values = drift.heading, np.einsum("qn,mnd->mqd", weights, drift.coefficient)
    if database.port_starboard_symmetric:
        mirrored = np.mod(-heading, 2.0 * np.pi)
        new = np.abs(np.angle(np.exp(1j * (mirrored[:, None] - heading)))).min(axis=1) > 1e-6
        heading = np.concatenate([heading, mirrored[new]])
        values = np.concatenate([values, values[new] * PORT_STARBOARD])
    order = np.argsort(heading)
    return heading[order], values[order]


def _drift_at(database: HydroDatabase, omega: Array, direction: Array) -> Array:
    """Coefficients of every component, shape (n, 6)."""
    heading, values = _circle_of(database, omega)
    distance = np.abs(np.angle(np.exp(1j * (direction[:, None] - heading))))
    if np.diff(np.append(heading, heading[0] + 2.0 * np.pi)).max() <= np.pi / 4.0 + 1e-9:
        weights = spline_weights(heading, direction, period=2.0 * np.pi)
    elif np.all(distance.min(axis=1) < 1e-6):
        weights = np.eye(len(heading))[distance.argmin(axis=1)]
    else:
        raise SceneError(
            f"database {database.name!r}: drift coefficients at headings "
            f"{np.degrees(heading).round(3).tolist()} deg say nothing about all directions of this sea; gaps "
            "above 45 deg are not interpolated"
        )
    return np.asarray(np.einsum("nm,mnd->nd", weights, values))


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
        raise SceneError.of(
            "sea: cutoff", f"is {cutoff} rad/s; give a frequency between slow drift and waves"
        )
    return float(cutoff)


def force_by_heading(database: HydroDatabase, omega: Array) -> ByHeading:
    """Force RAOs (N/m, N m/m) at frequencies (n,), rad/s, for all headings of the database.

    Beyond its frequencies they are as `HydroDatabase.force_at` has them with ``outside="limits"``. Raises
    SceneError if the headings do not cover the circle.
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
