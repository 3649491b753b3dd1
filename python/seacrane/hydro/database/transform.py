"""The same vessel about another reference point, or seen in a mirror.

With the new point at r from the old one (vessel's axes) a small motion is ``eta_old = T eta_new``,
``T = [[I, S(r)], [0, I]]``, ``S(r) v = r x v``. Loads follow from their work, ``F_new = T^T F_old``, and
every matrix X from a motion to a load becomes ``T^T X T``.
"""

from __future__ import annotations

import dataclasses
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.hydro.data.heading_circle import PORT_STARBOARD, both_sides, mirrored_heading
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.memory.moved_memory import mirrored_memory, moved_memory
from seacrane.inputs.caller import warn_caller
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import QuadraticDampingWarning

FloatArray = NDArray[np.float64]
Data = TypeVar("Data", bound=HydroData)

MATRICES = (
    "added_mass",
    "damping",
    "infinite_frequency_added_mass",
    "zero_frequency_added_mass",
    "mass_matrix",
    "linear_damping",
    "restoring",
)
PER_CAUSE = ("added_mass", "damping", "restoring")
MIRRORED = "; mirrored in the centre plane"


def motion_transform(point: FloatArray) -> FloatArray:
    """T (6, 6): motions at the old reference point from those at ``point`` (3,), m from it."""
    x, y, z = point
    transform = np.eye(6)
    transform[:3, 3:] = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    return transform


def moved_database(database: Data, point: ArrayLike, *, phase_origin: bool, net_lift: float) -> Data:
    """Move the reference point. The docstring of `HydroDatabase.at` says what each part becomes."""
    r = _point(database, point, net_lift)
    if r[1] != 0.0 and database.port_starboard_symmetric:
        database = _unfolded(database)
    transform = motion_transform(r)
    warn_of_quadratic(f"database {database.name!r}", database.quadratic_damping, transform)
    changes: dict[str, Any] = {
        name: _congruent(getattr(database, name), transform)
        for name in MATRICES
        if getattr(database, name) is not None
    }
    changes["restoring"] = changes["restoring"] + _unbalanced(r, net_lift)
    changes["additional"] = tuple(
        dataclasses.replace(
            part,
            added_mass=_congruent(part.added_mass, transform),
            damping=_congruent(part.damping, transform),
            restoring=_congruent(part.restoring, transform),
        )
        for part in database.additional
    )
    shift = _phase_shift(database, r) if phase_origin else np.ones((1, 1, 1))
    changes["force"] = (database.force @ transform) * shift
    if database.motion_rao is not None:
        changes["motion_rao"] = (database.motion_rao @ np.linalg.inv(transform).T) * shift
    for name in ("motion_rao_limit", "motion_rao_floor"):
        changes[name] = _of_all_that_mix(getattr(database, name), transform)
    if database.drift is not None:
        changes["drift"] = dataclasses.replace(
            database.drift, coefficient=database.drift.coefficient @ transform
        )
    waves = "" if phase_origin else "; waves have zero phase at the latter"
    place = ", ".join(f"{value:g}" for value in r)
    moved = dataclasses.replace(
        database, **changes, memory=None, origin=f"({place}) m from: {database.origin}{waves}"
    )
    if database.memory is None:
        return moved
    return dataclasses.replace(moved, memory=moved_memory(database.memory, transform, moved))


def mirrored_database(database: Data) -> Data:
    """`HydroDatabase.mirror`."""
    sign = np.outer(PORT_STARBOARD, PORT_STARBOARD)
    turned = mirrored_heading(database.heading)
    order = np.argsort(turned)
    changes: dict[str, Any] = {
        name: getattr(database, name) * sign for name in MATRICES if getattr(database, name) is not None
    }
    changes["additional"] = tuple(
        dataclasses.replace(part, **{name: getattr(part, name) * sign for name in PER_CAUSE})
        for part in database.additional
    )
    changes["force"] = database.force[order] * PORT_STARBOARD
    if database.motion_rao is not None:
        changes["motion_rao"] = database.motion_rao[order] * PORT_STARBOARD
    if database.roll_damping is not None:
        changes["roll_damping"] = dataclasses.replace(
            database.roll_damping, linearised=database.roll_damping.linearised[order]
        )
    if database.drift is not None:
        drift_turned = mirrored_heading(database.drift.heading)
        rising = np.argsort(drift_turned)
        changes["drift"] = dataclasses.replace(
            database.drift,
            heading=drift_turned[rising],
            coefficient=database.drift.coefficient[rising] * PORT_STARBOARD,
        )
    if database.memory is not None:
        changes["memory"] = mirrored_memory(database.memory)
    was_mirrored = database.source.endswith(MIRRORED)
    source = database.source.removesuffix(MIRRORED) if was_mirrored else database.source + MIRRORED
    return dataclasses.replace(database, **changes, heading=turned[order], source=source)


def _point(database: HydroData, point: ArrayLike, net_lift: float) -> FloatArray:
    """The new reference point (3,), or a ValueError."""
    r = np.asarray(point, dtype=float)
    if r.shape != (3,) or not np.all(np.isfinite(r)):
        raise ValueError(
            f"database {database.name!r}: reference point {point!r} is not three finite numbers; give "
            "(x, y, z) in m from the present one"
        )
    if not np.isfinite(net_lift):
        raise ValueError(f"database {database.name!r}: net_lift is {net_lift}; give buoyancy - weight in N")
    return r


def _congruent(matrices: FloatArray, transform: FloatArray) -> FloatArray:
    return np.asarray(transform.T @ matrices @ transform)


def _unbalanced(r: FloatArray, net_lift: float) -> FloatArray:
    """What the restoring gains where weight and buoyancy differ by ``net_lift`` (N, upwards).

    The moment about the moving point gains ``-(theta x r) x F`` with the load F that is there at rest.
    """
    x, y, z = r * net_lift
    extra = np.zeros((6, 6))
    extra[3, 3] = extra[4, 4] = -z
    extra[3, 5], extra[4, 5] = x, y
    return extra


def _phase_shift(database: HydroData, r: FloatArray) -> NDArray[np.complex128]:
    """``exp(+i k (x cos b + y sin b))`` (m, n, 1): waves that had zero phase at the old point get it at r."""
    along = r[0] * np.cos(database.heading) + r[1] * np.sin(database.heading)
    k = wavenumber(database.omega, g=database.g, depth=database.depth)
    return np.asarray(np.exp(1j * np.outer(along, k)))[:, :, None]


def _of_all_that_mix(limits: FloatArray, transform: FloatArray) -> FloatArray:
    """Each motion's limit (6,), the largest of all old motions that it is made of."""
    return np.asarray(np.where(transform != 0.0, limits, 0.0).max(axis=1))


def warn_of_quadratic(what: str, damping: FloatArray, transform: FloatArray) -> None:
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


def _unfolded(database: Data) -> Data:
    """A symmetric vessel with all headings of both sides written out, as one that is not symmetric."""
    heading, source, mirrored = both_sides(database.heading)
    parity = np.where(mirrored[:, None], PORT_STARBOARD, 1.0)[:, None, :]
    changes: dict[str, Any] = {"heading": heading, "force": database.force[source] * parity}
    if database.motion_rao is not None:
        changes["motion_rao"] = database.motion_rao[source] * parity
    if database.roll_damping is not None:
        changes["roll_damping"] = dataclasses.replace(
            database.roll_damping, linearised=database.roll_damping.linearised[source]
        )
    if database.drift is not None:
        circle, at, turned = both_sides(database.drift.heading)
        sign = np.where(turned[:, None], PORT_STARBOARD, 1.0)[:, None, :]
        changes["drift"] = dataclasses.replace(
            database.drift, heading=circle, coefficient=database.drift.coefficient[at] * sign
        )
    return dataclasses.replace(database, **changes, port_starboard_symmetric=False)
