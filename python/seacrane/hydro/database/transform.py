"""The same vessel about another reference point, in a mirror, or with fewer frequencies and headings.

With the new point at r from the old one (vessel's axes) a small motion is ``eta_old = T eta_new``,
``T = [[I, S(r)], [0, I]]``, ``S(r) v = r x v``. Loads follow from their work, ``F_new = T^T F_old``, and
every matrix X from a motion to a load becomes ``T^T X T``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.hydro.data.heading_circle import PORT_STARBOARD, both_sides, mirrored_heading, phase_at
from seacrane.hydro.data.hydro_data import HydroData, Part, axes_of
from seacrane.hydro.data.rigid_mass import cross_matrix, weight_restoring
from seacrane.hydro.memory.moved_memory import mirrored_memory, moved_memory
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import finite_of, shaped_of
from seacrane.warnings import QuadraticDampingWarning

Data = TypeVar("Data", bound=HydroData)
Change = Callable[[NDArray[Any], str], NDArray[Any]]  # of an array with axes as `axes_of` says
Indices = NDArray[np.intp]
Choice = tuple[float, float] | slice | Sequence[int] | NDArray[np.integer[Any]] | None

TOLERANCE = 1e-9  # rad/s or rad: ends of a range belong to it
MIRRORED = "; mirrored in the centre plane"


def motion_transform(point: Array) -> Array:
    """T (6, 6): motions at the old reference point from those at ``point`` (3,), m from it."""
    transform = np.eye(6)
    transform[:3, 3:] = cross_matrix(point)
    return transform


def _arrays(part: Part, change: Change) -> dict[str, Any]:
    """The arrays that a part has, each changed."""
    there = {name: (getattr(part, name), axes) for name, axes in axes_of(part).items()}
    return {name: change(array, axes) for name, (array, axes) in there.items() if array is not None}


def _with_arrays(database: Data, change: Change, of_drift: Change | None = None, **others: Any) -> Data:
    """The database with all arrays changed, those of its parts too, and ``others`` in place of its own."""
    parts: dict[str, Any] = {
        "additional": tuple(replace(part, **_arrays(part, change)) for part in database.additional)
    }
    if database.roll_damping is not None:
        parts["roll_damping"] = replace(database.roll_damping, **_arrays(database.roll_damping, change))
    if database.drift is not None and of_drift is not None:
        parts["drift"] = replace(database.drift, **_arrays(database.drift, of_drift))
    return replace(database, **_arrays(database, change) | parts | others)


def moved_database(
    database: Data, point: ArrayLike, *, phase_origin: bool = True, net_lift: float = 0.0
) -> Data:
    """The same vessel about another reference point; nothing is fitted or interpolated anew.

    Matrices, forces, motions, limits of the added mass, restoring, drift and the memory model (with the
    same states) are moved exactly. Damping tabulated by frequency acts on roll alone and stays; the time
    domain takes it at the uncoupled roll frequency, which is another one about another point.

    Parameters
    ----------
    point : (3,) the new point in m from the present one, vessel's axes. Off the centreline the headings
        of both sides are written out, as no side of that point mirrors the other.
    phase_origin : whether waves have zero phase at the new point from now on, as everything that takes a
        database expects: forces and motions are multiplied by ``exp(+i k (x cos b + y sin b))`` with the
        wavenumber of the database's depth. False keeps the phases of waves at the old point, which
        `origin` then says: for comparison with other codes.
    net_lift : N, buoyancy minus weight at rest. Zero for a vessel that floats by itself: its restoring
        moves like any matrix. Else C44, C55, C46 and C56 gain what that load does as it turns with the
        ship.

    Warns
    -----
    seacrane.warnings.QuadraticDampingWarning : quadratic damping of a translation cannot be moved.

    Raises
    ------
    ValueError : the point is not three finite numbers.
    """
    r = point_of(f"database {database.name!r}: reference point", point)
    net_lift = finite_of(f"database {database.name!r}: net_lift", net_lift, "N")
    if r[1] != 0.0 and database.port_starboard_symmetric:
        database = _unfolded(database)
    transform = motion_transform(r)
    warn_of_quadratic(f"database {database.name!r}", database.quadratic_damping, transform)

    def change(array: NDArray[Any], axes: str) -> NDArray[Any]:
        return np.asarray(transform.T @ array @ transform) if axes.endswith("ij") else array

    def of_drift(array: NDArray[Any], axes: str) -> NDArray[Any]:
        return array @ transform if axes == "mni" else array

    water = {"g": database.g, "depth": database.depth}
    shift = phase_at(r, database.omega, database.heading, **water) if phase_origin else np.ones((1, 1, 1))
    others: dict[str, Any] = {"force": (database.force @ transform) * shift}
    if database.motion_rao is not None:
        others["motion_rao"] = (database.motion_rao @ np.linalg.inv(transform).T) * shift
    for name in ("motion_rao_limit", "motion_rao_floor"):  # the largest of all old motions in a new one
        others[name] = np.where(transform != 0.0, getattr(database, name), 0.0).max(axis=1)
    # The moment about the moving point gains -(theta x r) x F with the load F that is there at rest.
    others["restoring"] = change(database.restoring, "ij") + weight_restoring(net_lift, r)
    waves = "" if phase_origin else "; waves have zero phase at the latter"
    place = ", ".join(f"{value:g}" for value in r)
    others["origin"] = f"({place}) m from: {database.origin}{waves}"
    moved = _with_arrays(database, change, of_drift, **others, memory=None)
    if database.memory is None:
        return moved
    return replace(moved, memory=moved_memory(database.memory, transform, moved))


def _reordered(heading: Array, places: Indices, signs: Array, square: Array | float = 1.0) -> Change:
    """Other headings (m,), whose loads are those at ``places`` times ``signs``; matrices times ``square``."""

    def change(array: NDArray[Any], axes: str) -> NDArray[Any]:
        if axes == "m":
            return heading
        if axes.endswith("ij"):
            return np.asarray(array * square)
        array = array[places] if axes.startswith("m") else array
        return np.asarray(array * signs) if axes == "mni" else array

    return change


def mirrored_database(database: Data) -> Data:
    """The vessel with port and starboard exchanged: sway, roll, yaw and headings change their signs.

    Memory and drift are mirrored too. Mirroring twice gives the database back; for a symmetric vessel
    the mirrored headings are the other side of the same `full_circle`.
    """
    sign = np.outer(PORT_STARBOARD, PORT_STARBOARD)

    def mirror(heading: Array) -> Change:
        turned = mirrored_heading(heading)
        order = np.argsort(turned)
        return _reordered(turned[order], order, PORT_STARBOARD, sign)

    drift = None if database.drift is None else mirror(database.drift.heading)
    was_mirrored = database.source.endswith(MIRRORED)
    source = database.source.removesuffix(MIRRORED) if was_mirrored else database.source + MIRRORED
    memory = None if database.memory is None else mirrored_memory(database.memory)
    return _with_arrays(database, mirror(database.heading), drift, source=source, memory=memory)


def _unfolded(database: Data) -> Data:
    """A symmetric vessel with all headings of both sides written out, as one that is not symmetric."""

    def unfold(heading: Array) -> Change:
        circle, source, mirrored = both_sides(heading)
        return _reordered(circle, source, np.where(mirrored[:, None], PORT_STARBOARD, 1.0)[:, None, :])

    drift = None if database.drift is None else unfold(database.drift.heading)
    return _with_arrays(database, unfold(database.heading), drift, port_starboard_symmetric=False)


def point_of(what: str, value: Any) -> Array:
    """Three finite numbers (3,), m; raises SceneError."""
    point = shaped_of(what, value, (3,))
    if not np.all(np.isfinite(point)):
        raise SceneError.of(what, f"is {point}; give three finite numbers in m")
    return point


def warn_of_quadratic(what: str, damping: Array, transform: Array) -> None:
    """Moments move as they are; v |v| of a translation at the old point is no such term at the new one."""
    coupled = np.any(transform[:, 3:] - np.eye(6)[:, 3:], axis=1) & (damping != 0.0)
    if np.any(coupled):
        motion = int(np.flatnonzero(coupled)[0])
        warn_caller(
            f"{what}: quadratic_damping[{motion}] = {damping[motion]:.4g} belongs to the velocity at the old "
            "reference point; it is kept with the velocity of the new one and gives no moment there, so that "
            "damping of translations and rotations is off while they are coupled. Set quadratic_damping anew",
            QuadraticDampingWarning,
        )


def selected_database(
    database: Data, *, omega: Choice = None, heading: Choice = None, every: int = 1, every_heading: int = 1
) -> Data:
    """Some of the frequencies and headings, with the stored values as they are.

    Parameters
    ----------
    omega : a tuple (low, high) in rad/s, ends included; or indices: a list, an integer array, a slice.
    heading : a tuple (low, high) in rad, which may cross 2 pi (-0.5, 0.5); or indices.
    every, every_heading : keep every n-th of what is selected.

    Returns
    -------
    HydroDatabase : the trusted band is cut to the frequencies left. A memory model is kept while all
        frequencies are, and dropped with the first one: it belongs to all the data it was fitted to.
        Drift coefficients have frequencies and headings of their own, and stay.

    Raises
    ------
    ValueError : nothing is left, nothing of the trusted band is left, or a choice is no range or index.
    """
    what = f"database {database.name!r}"
    n = _chosen(f"{what}: omega", omega, database.omega, every)
    m = _chosen(f"{what}: heading", heading, database.heading, every_heading)

    def change(array: NDArray[Any], axes: str) -> NDArray[Any]:
        for axis, places in (("n", n), ("m", m)):
            array = array.take(places, axes.index(axis)) if axis in axes else array
        return array

    others: dict[str, Any] = {"trusted_band": _band(database, database.omega[n])}
    if len(n) < len(database.omega):
        others["memory"] = None
    return _with_arrays(database, change, **others)


def _chosen(what: str, choice: Choice, values: Array, every: int) -> Indices:
    """Rising indices of the values that are chosen, a pair being a range, and every n-th of them."""
    found = np.arange(len(values))
    turning = what.endswith("heading")
    if isinstance(choice, tuple):
        low, high = map(float, choice) if len(choice) == 2 else (np.nan, np.nan)
        if not -np.inf < low <= high < np.inf:
            raise ValueError(f"{what} = {choice!r} is no range; give (low, high), or a list of indices")
        above = values - low + TOLERANCE
        above = np.mod(above, 2.0 * np.pi) if turning else np.where(above < 0.0, np.inf, above)
        found = np.flatnonzero(above <= high - low + 2.0 * TOLERANCE)
    elif isinstance(choice, slice):
        found = found[choice]
    elif choice is not None:
        array = np.asarray(choice)
        if array.ndim != 1 or (array.size and not np.issubdtype(array.dtype, np.integer)):
            raise ValueError(
                f"{what} = {choice!r} is neither a range (low, high) nor a list of integer indices"
            )
        if np.any((array < -len(values)) | (array >= len(values))):
            raise ValueError(f"{what} = {choice!r} counts beyond its {len(values)} values")
        found = np.mod(array.astype(np.intp), len(values))
        if len(np.unique(found)) < len(found):
            raise ValueError(f"{what} = {choice!r} names a value twice; name each once")
    if found.size == 0:
        raise ValueError(
            f"{what} = {choice!r} leaves nothing of {values[0]:.4g} to {values[-1]:.4g} "
            f"{'rad' if turning else 'rad/s'}; widen it"
        )
    if isinstance(every, bool) or not isinstance(every, (int, np.integer)) or every < 1:
        step = "every_heading" if turning else "every"
        raise ValueError(f"{what.rpartition(' ')[0]} {step} = {every!r}; give a positive whole number")
    return np.sort(found)[::every]


def _band(database: HydroData, omega: Array) -> tuple[float, float] | None:
    """The trusted band within the frequencies that are left; where only one is inside, the band as it was."""
    if database.trusted_band is None:
        return None
    low, high = database.trusted_band
    if not np.any((omega >= low - TOLERANCE) & (omega <= high + TOLERANCE)):
        raise ValueError(
            f"database {database.name!r}: the selected frequencies, {omega[0]:.4g} to {omega[-1]:.4g} rad/s, "
            f"all lie outside the trusted band {low:.4g} to {high:.4g} rad/s; include some of it"
        )
    inner = max(low, float(omega[0])), min(high, float(omega[-1]))
    return inner if inner[0] < inner[1] else (low, high)
