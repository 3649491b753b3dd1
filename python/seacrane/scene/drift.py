"""Slow wave drift of a vessel."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.description.databases import database_of
from seacrane.description.description import Description
from seacrane.description.waves import ByHeading, Waves
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase
from seacrane.hydro.data.heading_circle import PORT_STARBOARD
from seacrane.hydro.data.interpolation import spline_weights

Array = NDArray[np.float64]


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
