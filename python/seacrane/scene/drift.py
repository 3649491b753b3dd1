"""Slow wave drift of a vessel."""

from __future__ import annotations

from typing import Literal

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


def add_drift(
    scene: Description,
    *,
    vessel: str | None = None,
    outside: Literal["error", "hold"] = "error",
) -> Waves:
    """Add the slowly varying wave drift load from mean drift coefficients, by Newman's approximation.

    F(t) = sum_ik a_i a_k (D_i + D_k) / 2 cos(theta_i - theta_k) with the coefficients D of the database at
    each component's frequency and heading: difference frequencies only, mean sum a^2 D. Good for the slow
    motions of a moored vessel; it leaves out the second-order potential (which matters in shallow water) and
    the change of drift with the vessel's speed (wave drift damping). Call it after `add_sea`, for a vessel
    whose database has `drift`.

    Parameters
    ----------
    vessel : str, optional
        Body of the vessel; default: the only one in the sea.
    outside : str
        "error", or "hold": components beyond the frequencies of the coefficients take those of the nearest.

    Raises
    ------
    SceneError
        Without a sea or without drift coefficients, for a vessel that is not in the sea, or for components
        outside the coefficients' frequencies or in a gap of more than 45 deg between headings.
    """
    waves = sea_of(scene, "drift")
    hull, by_heading = waves.hull(vessel), None
    database = database_of(scene, waves.body_of(vessel), "its slow drift")
    if hull.force_by_heading is not None:
        by_heading = drift_by_heading(database, waves.omega, outside)
    drift = _drift_at(database, waves.omega, waves.direction - hull.heading, outside)
    scene.waves = waves.changed(vessel, drift=drift, drift_by_heading=by_heading)
    return scene.waves


def sea_of(scene: Description, what: str) -> Waves:
    if scene.waves is None:
        raise SceneError(f"scene {scene.name!r}: {what} needs a sea; call add_sea first")
    return scene.waves


def drift_by_heading(database: HydroDatabase, omega: Array, outside: str) -> ByHeading:
    heading, values = _circle_of(database, omega, outside)
    return ByHeading(heading=heading, values=values)


def _circle_of(database: HydroDatabase, omega: Array, outside: str) -> tuple[Array, Array]:
    """Headings all round (m,) and the coefficients there at the frequencies asked for (m, n, 6)."""
    drift = getattr(database, "drift", None)
    if drift is None:
        raise SceneError(f"database {database.name!r}: has no drift coefficients; read a set that holds them")
    low, high = drift.omega[0] * (1.0 - 1e-9), drift.omega[-1] * (1.0 + 1e-9)
    beyond = omega[(omega < low) | (omega > high)]
    if outside not in ("error", "hold"):
        raise SceneError(f"drift: outside is {outside!r}; choose 'error' or 'hold'")
    if outside == "error" and beyond.size:
        raise SceneError(
            f"database {database.name!r}: omega = {beyond[0]:.6g} rad/s is outside the drift coefficients' "
            f"{drift.omega[0]:.6g} to {drift.omega[-1]:.6g} rad/s; narrow the sea's band, or pass "
            "outside='hold' to add_drift"
        )
    weights = spline_weights(drift.omega, np.clip(omega, drift.omega[0], drift.omega[-1]))
    heading, values = drift.heading, np.einsum("qn,mnd->mqd", weights, drift.coefficient)
    if database.port_starboard_symmetric:
        mirrored = np.mod(-heading, 2.0 * np.pi)
        new = np.abs(np.angle(np.exp(1j * (mirrored[:, None] - heading)))).min(axis=1) > 1e-6
        heading = np.concatenate([heading, mirrored[new]])
        values = np.concatenate([values, values[new] * PORT_STARBOARD])
    order = np.argsort(heading)
    return heading[order], values[order]


def _drift_at(database: HydroDatabase, omega: Array, direction: Array, outside: str) -> Array:
    """Coefficients of every component, shape (n, 6)."""
    heading, values = _circle_of(database, omega, outside)
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
