"""What a sea loads a vessel with: its slow drift, loads at its actual place, and what its database lacks."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from seacrane.analysis.hull_range import peak_frequency
from seacrane.arrays import Array, Complex
from seacrane.description.databases import database_of
from seacrane.description.description import Description
from seacrane.description.provenance import SeaProvenance
from seacrane.description.waves import ByHeading, HullLoads, Waves
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase
from seacrane.hydro.data.data_warnings import warn_of_waves_below_band
from seacrane.hydro.data.excitation import force_at, with_limits
from seacrane.hydro.data.heading_circle import PORT_STARBOARD
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.interpolation import spline_weights
from seacrane.inputs.alike import alike
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of
from seacrane.inputs.frames import MOTIONS
from seacrane.warnings import WavesWithoutLoadWarning

MOST_WITHOUT_LOAD = 0.02  # of the variance of a load
END = 0.8  # of the highest frequency: the slope of the forces is fitted from there on
FEWEST = 3  # frequencies of that fit
AT_ONCE = 256  # headings, to bound the memory it takes
SLIGHT = 1e-3  # of the variance that the same waves would give a load from its worst heading
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


def with_shares(waves: Waves, database: HydroDatabase, vessel: str, hull: HullLoads) -> SeaProvenance:
    """The sea's provenance, with what of it puts no load on a vessel; of several the largest."""
    left_out = without_load(
        database, omega=waves.omega, amplitude=waves.amplitude, direction=waves.direction - hull.heading,
        force=hull.transfer,
    )  # fmt: skip
    if left_out.variance > MOST_WITHOUT_LOAD:
        warn_caller(
            f"waves on {vessel!r}: those above {database.omega[-1]:.4g} rad/s, where database "
            f"{database.name!r} ends, put no load on it: {left_out.energy:.2%} of the energy of the waves, "
            f"and about {left_out.variance:.1%} of the variance of its {left_out.load} load. Compute the "
            "database to higher frequencies, or take its motions in this sea for too small",
            WavesWithoutLoadWarning,
        )
    energy = waves.amplitude**2
    low = 0.0 if database.trusted_band is None else database.trusted_band[0]
    below = float(energy[waves.omega < low].sum() / energy.sum()) if energy.any() else 0.0
    warn_of_waves_below_band(database, below, f"waves on {vessel!r}")
    known = waves.provenance
    return alike(
        known,
        wave_energy_without_load=max(left_out.energy, known.wave_energy_without_load or 0.0),
        load_variance_without_load=max(left_out.variance, known.load_variance_without_load or 0.0),
    )


class WithoutLoad(NamedTuple):
    """How much of a sea is above the band of a database, and so puts no load on its vessel."""

    energy: float  # share of that of the waves
    variance: float  # largest share of that of a load, estimated from the slope of the forces
    load: str  # which one that is


def without_load(
    database: HydroData, *, omega: Array, amplitude: Array, direction: Array,
    force: Complex,
) -> WithoutLoad:  # fmt: skip
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
    columns = np.abs(database.force).max(axis=0).T
    worst_heading = np.stack([np.interp(omega[~above], database.omega, one) for one in columns], axis=1)
    judged = whole > SLIGHT * (energy[~above] @ worst_heading**2)
    share = np.where(judged, missing / np.where(judged, whole, 1.0), 0.0)
    worst = int(share.argmax())
    return WithoutLoad(
        energy=float(energy[above].sum() / energy.sum()), variance=float(share[worst]), load=MOTIONS[worst]
    )


def _tail(database: HydroData, omega: Array, direction: Array) -> Array:
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
