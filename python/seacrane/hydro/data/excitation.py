"""Wave excitation at any frequency and heading: splines inside the database, limits beyond its band."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.arrays import Array, Complex
from seacrane.errors import SceneError
from seacrane.hydro.data.heading_circle import centred, heading_weights, travel, with_mirror_images
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import Hydrodynamics
from seacrane.hydro.data.interpolation import spline_weights
from seacrane.inputs.checked import is_finite
from seacrane.one_thread import one_thread
from seacrane.sea.dispersion import wavenumber


@one_thread
def force_at(database: HydroData, omega: ArrayLike, heading: ArrayLike, *, outside: str = "error") -> Complex:
    """`HydroDatabase.force_at`."""
    if outside not in ("error", "limits"):
        raise SceneError(f"database {database.name!r}: outside is {outside!r}; choose 'error' or 'limits'")
    w, b = np.asarray(omega, float), np.asarray(heading, float)
    if w.shape != b.shape:
        w, b = np.broadcast_arrays(w, b)
    shape = w.shape
    w, b = w.ravel(), b.ravel()
    if not (is_finite(w) and is_finite(b)):
        raise SceneError(f"database {database.name!r}: frequencies and headings must be finite numbers")
    slack = 1e-9 * database.omega[-1]
    beyond = (w < database.omega[0] - slack) | (w > database.omega[-1] + slack)
    if outside == "error" and np.any(beyond):
        raise SceneError(
            f"database {database.name!r}: omega = {w[beyond][0]:.6g} rad/s is outside "
            f"{database.omega[0]:.6g} to {database.omega[-1]:.6g} rad/s; ask within it, or pass "
            "outside='limits'"
        )
    inside = np.clip(w, database.omega[0], database.omega[-1])
    force = _core.weighted_sums(spline_weights(database.omega, inside), _by_heading(database, b))
    _, _, centre = _held_circle(database)
    if np.any(centre):
        k = wavenumber(inside, g=database.g, depth=database.depth)
        force = force * travel(centre, k, b)[:, None]
    return with_limits(database, w, force).reshape(*shape, 6)


@one_thread
def force_on_grid(database: HydroData, omega: Array, heading: Array) -> Complex:
    """Forces (q, k, 6) at headings (q,) times frequencies (k,) within the table, as `force_at` has them."""
    circle, table, centre = _held_circle(database)
    in_heading = heading_weights(f"database {database.name!r}", circle, np.asarray(heading, dtype=float))
    by_heading = np.tensordot(in_heading, table, axes=1)
    in_frequency = spline_weights(database.omega, np.asarray(omega, dtype=float))
    force = np.asarray(np.einsum("kn,qnd->qkd", in_frequency, by_heading, optimize=True))
    if not np.any(centre):
        return force
    k = wavenumber(np.asarray(omega, dtype=float), g=database.g, depth=database.depth)
    return np.asarray(force * travel(centre, k, np.asarray(heading, dtype=float)[:, None])[:, :, None])


def _by_heading(database: HydroData, heading: Array) -> Complex:
    """Forces (q, n, 6) at headings (q,) and the database's frequencies (n,); (n, 6) where all are equal.

    Their phases are those of `_held_circle`.
    """
    if heading.size and np.all(heading == heading[0]):  # long-crested seas, one seed after another
        one = _of_equal_headings(database, float(heading[0]), heading.size)
        if one is not None:
            return one
    return _interpolated_in_heading(database, heading)


@lru_cache(maxsize=64)
def _of_equal_headings(database: HydroData, heading: float, count: int) -> Complex | None:
    """What so many equal headings have in common to the last bit; None where a product rounds by row."""
    every = _interpolated_in_heading(database, np.full(count, heading))
    return every[0].copy() if np.array_equal(every, np.broadcast_to(every[0], every.shape)) else None


def _interpolated_in_heading(database: HydroData, heading: Array) -> Complex:
    circle, table, _ = _held_circle(database)
    in_heading = heading_weights(f"database {database.name!r}", circle, heading)
    return np.asarray(
        (in_heading @ table.reshape(len(circle), -1)).reshape(len(heading), len(database.omega), 6)
    )


@lru_cache(maxsize=8)
def _held_circle(database: HydroData) -> tuple[Array, Complex, Array]:
    """As `full_circle`, without the phases of the wave's travel to the phase centre, and that centre (2,)."""
    circle, table = full_circle(database)
    return circle, *centred(wavenumber(database.omega, g=database.g, depth=database.depth), circle, table)


def full_circle(database: Hydrodynamics) -> tuple[Array, Complex]:
    """Headings (k,) within [0, 2 pi), the mirrored ones added, and their forces (k, n, 6); new arrays.

    Of a group forces are (k, n, 6 hulls), with phases as in the group.
    """
    if not database.port_starboard_symmetric:
        return database.heading.copy(), database.force.copy()
    return with_mirror_images(database.heading, database.force)


def with_limits(database: HydroData, omega: Array, force: Complex) -> Complex:
    """Forces beyond the band: towards the hydrostatic ones of a long wave below it, none above it.

    A wave much longer than the hull lifts the water around it as one: its force tends to the third column of
    the restoring matrix, and what is left of it falls with the wavenumber (slope of the surface, and
    acceleration along it). So below the band F = C_3 + (F_lowest - C_3) k / k_lowest.

    Parameters
    ----------
    omega : (n,) rad/s.
    force : (..., n, 6) N/m and N m/m, beyond the band those of its nearest end.
    """
    out = np.array(force)
    lowest, highest = database.omega[0], database.omega[-1]
    slack = 1e-9 * highest
    below = omega < lowest - slack
    if below.any():
        longest = np.append(np.maximum(omega[below], 1e-9 * lowest), lowest)
        k = wavenumber(longest, g=database.g, depth=database.depth)
        share = (k[:-1] / k[-1])[:, None]
        out[..., below, :] = database.restoring[:, 2] * (1.0 - share) + out[..., below, :] * share
    above = omega > highest + slack
    if above.any():
        out[..., above, :] = 0.0
    return out
