"""Relations of exact linear hydrodynamics: damping from wave forces, added mass and memory from damping."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.hydro.data.excitation import full_circle
from seacrane.hydro.data.heading_circle import largest_gap
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import Hydrodynamics
from seacrane.hydro.data.interpolation import by_straight_lines, spline_weights

HEADINGS = 720
FINE_POINTS = 6001
TAIL_EXPONENT = 3.0
TAIL_REACH, TAIL_POINTS = 30.0, 400
LARGEST_PHASE_STEP = 2.0  # rad between headings: splines through every second or third heading err by 2 %


def damping_from_forces(database: Hydrodynamics) -> Array | None:
    """Radiation damping (n, 6, 6) from the exciting forces, or None where the headings do not close.

    Energy radiated to all directions, with Haskind's relation in deep water (Newman 1977, Marine
    Hydrodynamics, section 6.18): ``B_jk = omega^3 / (4 pi rho g^3) integral Re(X_j conj(X_k)) d beta``.
    """
    if np.isfinite(database.depth) or database.speed != 0.0:
        return None
    circle, force = full_circle(database)
    if largest_gap(circle) > np.radians(20.0):
        return None
    beta = np.arange(HEADINGS) * 2.0 * np.pi / HEADINGS
    weights = spline_weights(circle, beta, period=2.0 * np.pi)
    x = (weights @ force.reshape(len(circle), -1)).reshape(HEADINGS, *force.shape[1:])
    product = np.einsum("hnj,hnk->njk", x, x.conj()).real * 2.0 * np.pi / HEADINGS
    factor = database.omega**3 / (4.0 * np.pi * database.rho * database.g**3)
    return np.asarray(factor[:, None, None] * product)


def resolved_by_headings(database: Hydrodynamics) -> NDArray[np.bool_]:
    """Frequencies (n,) whose force pattern the headings resolve, in deep water.

    The force from an end of the ship turns by up to ``k L / 2`` radians of phase per radian of heading.
    """
    if isinstance(database, HydroData):
        length = database.length
    else:  # over all
        boxes = [(np.hypot(*body.position[:2]), body.length, body.breadth) for body in database.bodies]
        length = float(2.0 * max(away + 0.5 * np.hypot(length, breadth) for away, length, breadth in boxes))
    circle, _ = full_circle(database)
    phase = largest_gap(circle) * database.omega**2 / database.g * length / 2.0
    return np.asarray(phase <= LARGEST_PHASE_STEP)


def infinite_added_mass_from_damping(database: Hydrodynamics) -> Array:
    """Infinite-frequency added mass (6, 6) that the damping implies, averaged over the trusted band.

    Kramers-Kronig (Ogilvie 1964) with the pole subtracted:
    ``A(w) - A_inf = 2 / pi integral_0^inf (B(v) - B(w)) / (v^2 - w^2) dv``. Beyond the data B falls as
    ``v^-3``.
    """
    low, high = database.trusted_band or (database.omega[0], database.omega[-1])
    high = min(high, 0.8 * float(database.omega[-1]))  # closer to the end the assumed tail would decide
    inside = np.flatnonzero((database.omega >= low) & (database.omega <= high))
    estimates = [database.added_mass[i] - _dispersion_integral(database, int(i)) for i in inside]
    return np.asarray(np.mean(estimates, axis=0))


def _dispersion_integral(database: Hydrodynamics, index: int) -> Array:
    """``2 / pi`` times the integral above at one of the database's frequencies, (6, 6)."""
    w, end = float(database.omega[index]), float(database.omega[-1])
    fine = np.linspace(0.0, end, FINE_POINTS)
    knots = np.concatenate([[0.0], database.omega])
    table = np.concatenate([np.zeros_like(database.damping[:1]), database.damping])
    at = database.damping[index]
    damping = by_straight_lines(knots, table, fine)
    gap = fine**2 - w**2
    near = np.abs(gap) < 1e-6
    ratio = (damping - at) / np.where(near, 1.0, gap)[:, None, None]
    ratio[near] = 0.0
    body = np.trapezoid(ratio, fine, axis=0) - at / (2.0 * w) * np.log((end + w) / (end - w))
    beyond = np.geomspace(end, 100.0 * end, 2001)
    tail = np.trapezoid((end / beyond) ** TAIL_EXPONENT / (beyond**2 - w**2), beyond)
    return np.asarray(2.0 / np.pi * (body + table[-1] * tail))


def retardation_from_damping(database: Hydrodynamics, time: Array) -> Array:
    """Retardation functions (t, 6, 6) at ``time`` (t,) in s, from the damping alone.

    ``K(t) = 2 / pi integral_0^inf B(w) cos(w t) dw`` (Ogilvie 1964), exact for the damping joined by straight
    lines, from zero at zero frequency and with a tail ``w^-3`` beyond the trusted band, up to `TAIL_REACH`
    times its end.
    """
    high = np.inf if database.trusted_band is None else database.trusted_band[1]
    kept = max(1, int(np.count_nonzero(database.omega <= high + 1e-9)))
    end = float(database.omega[kept - 1])
    tail = np.geomspace(end, TAIL_REACH * end, TAIL_POINTS)[1:]
    omega = np.concatenate([[0.0], database.omega[:kept], tail])
    fall = ((end / tail) ** TAIL_EXPONENT)[:, None, None]
    last = database.damping[kept - 1]
    damping = np.concatenate([np.zeros_like(database.damping[:1]), database.damping[:kept], last * fall])
    slope = np.diff(damping, axis=0) / np.diff(omega)[:, None, None]
    late = np.asarray(time, dtype=float) * end > 1e-6
    t = np.where(late, time, 1.0)[:, None]
    bends = np.diff(np.cos(omega * t), axis=1) / t**2
    kernel = np.einsum("ts,sjk->tjk", bends, slope) + np.einsum(
        "t,jk->tjk", np.sin(omega[-1] * t[:, 0]) / t[:, 0], damping[-1]
    )
    kernel[~late] = np.trapezoid(damping, omega, axis=0)
    return np.asarray(2.0 / np.pi * kernel)
