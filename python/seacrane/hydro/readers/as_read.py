"""What every reader asks of what it read: motions that were solved, whole matrices, a mass, smooth data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import Hydrodynamics, mass_scales
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.group.gap import long_wave_lift
from seacrane.hydro.group.group import HydroGroup
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.warnings import FloatingPositionWarning, RoughDataWarning

Found = TypeVar("Found", bound=HydroDatabase | HydroGroup)
Given = ArrayLike | Mapping[str, ArrayLike]  # of one body, or by name

SAME_FREQUENCY = 1e-3  # of one that is to be left out, as messages round it
LIGHTEST, HEAVIEST = 0.5, 2.0  # mass over displaced mass of a vessel that floats
SHALLOWEST = 1e-3  # draught over breadth
WIDEST = 5.0  # radius of gyration over the largest side of the box
HALVES = 1e-3  # of the largest entry, by which those of a mass matrix may differ
OBLIQUE = 0.1  # sine of twice a heading: waves from there load every motion
ROUND = 1e-3  # by which two motions of a round body may differ
SAME_DIRECTION = 1e-9  # rad
LIFT_LIMIT = 0.1  # of C33
ROUGH = 0.01  # misfit of a left-out value, as a share of what varies
UNRESOLVED = 4.0  # misfit over twice the step by that over the step: 16 of smooth data, 1 of noise
LEAST_INERTIA, LEAST_DAMPING = 0.1, 0.01  # scales at least, by the mass and by mass times frequency
COARSEST = 0.15  # step by frequency, beyond which a table does not tell noise from shape
NEIGHBOURS = 4


@dataclass(frozen=True, kw_only=True, eq=False)
class Asked:
    """Who reads which file (for messages), and what the caller gives that it does not hold.

    ``motions`` names those that were solved (None: all), ``leave_out`` frequencies in rad/s to do without;
    the matrices are (6, 6) in SI, of several bodies by name.
    """

    where: Path
    reader: str
    mass_matrix: Given | None = None
    restoring: Given | None = None
    motions: Sequence[str] | None = None
    leave_out: ArrayLike | None = None


def require_solved(asked: Asked, found: HydroDatabase | HydroGroup) -> None:
    """Raise where a motion has no added mass and damping, or no load, and the caller does not say so.

    Yaw of a round body, in which water takes no part, may have none.
    """
    known = set(MOTIONS) if asked.motions is None else {str(motion).lower() for motion in asked.motions}
    if not known <= set(MOTIONS):
        raise FileFormatError(
            f"{asked.where}: motions names {', '.join(sorted(known - set(MOTIONS)))}; give some of "
            f"{', '.join(MOTIONS)}"
        )
    moved = np.any(found.added_mass, axis=(0, 2)) | np.any(found.damping, axis=(0, 2))
    forced = np.any(found.force, axis=(0, 1)) | (np.abs(np.sin(2.0 * found.heading)).max() < OBLIQUE)
    names = found.names if isinstance(found, HydroGroup) else ("",)
    for there, what in (
        (moved, "no added mass and no damping at any frequency"),
        (forced, "no wave force at any frequency and heading"),
    ):
        empty = [i for i in np.flatnonzero(~there).tolist() if MOTIONS[i % 6] in known]
        lacking = [i for i in empty if i % 6 != 5 or not _is_round(found, i - 5)]
        if lacking:
            told = ", ".join(f"{names[i // 6]} {MOTIONS[i % 6]}".strip() for i in lacking)
            solved = tuple(name for i, name in enumerate(MOTIONS) if i not in {one % 6 for one in lacking})
            raise FileFormatError(
                f"{asked.where}: {told} {'has' if len(lacking) == 1 else 'have'} {what}: not solved for. "
                f"Solve for it, or say which were by {asked.reader}(motions={solved}), and keep the vessel "
                "from the others"
            )


def _is_round(found: Hydrodynamics, first: int) -> bool:
    """Whether a body is round about its vertical axis."""
    a = np.diagonal(found.added_mass, axis1=1, axis2=2)[:, first : first + 5]
    return bool(np.all(np.abs(a[:, 0] - a[:, 1]) <= ROUND * np.abs(a[:, 0])) and np.any(a[:, 0]))


def left_out(names: Sequence[str]) -> str:
    """The end of a source: what stands there and is not read."""
    return f"; left out: {', '.join(names)[:200]}" if names else ""


def mirrored(matrices: Array) -> Array:
    """Symmetric matrices (..., k, k) of which a file holds one half: the other is its mirror image."""
    lower = np.tril(np.ones(matrices.shape[-2:], dtype=bool), -1)
    there = [bool(np.any(matrices[..., half])) for half in (lower, lower.T)]
    if there[0] == there[1]:
        return matrices
    diagonal = np.where(np.eye(len(lower), dtype=bool), matrices, 0.0)
    half = matrices - diagonal
    return np.asarray(diagonal + half + half.swapaxes(-1, -2))


def whole_stiffness(restoring: Array) -> Array:
    """`mirrored` of heave, roll and pitch: moments of weights about the vertical stand in one half alone."""
    out = restoring.copy()
    out[2:5, 2:5] = mirrored(restoring[2:5, 2:5])
    return out


def warn_of_turning_over(where: object, hull: HydroData) -> None:
    """Warn of a hull whose C44 or C55 is not positive: it floats upright with what is not in it yet."""
    weight = mass_scales(hull)[0] * hull.g
    told = [
        f"{name} is {hull.restoring[at, at]:.4g} N m/rad, a metacentric height of "
        f"{hull.restoring[at, at] / weight:.3g} m"
        for name, at in (("C44", 3), ("C55", 4))
        if hull.restoring[at, at] <= 0.0
    ]
    if told:
        warn_caller(
            f"{where}: {', and '.join(told)}: the hull turns over by itself. It is read as it is; check its "
            "centre of gravity, or add what keeps it upright",
            FloatingPositionWarning,
        )


def mass_of_file(
    asked: Asked,
    mass_matrix: ArrayLike,
    *,
    where: Path | None = None,
    displaced: float | None = None,
    box: tuple[float, float, float] | None = None,
) -> Array:
    """The mass matrix (6, 6) of a file or as given, its halves completed; asked for where it is of no vessel.

    Parameters
    ----------
    where : the file that holds it, where that is another one.
    displaced : kg, where the file tells it.
    box : length, breadth and draught of the equivalent box, m, where the mass is all that tells the last.

    Raises FileFormatError: no mass, no inertia, halves that differ, or a placeholder.
    """
    matrix = mirrored(np.asarray(mass_matrix, dtype=float))
    mass = float(matrix[0, 0]) if matrix.shape == (6, 6) else np.nan
    wrong = ""
    if not np.all(np.isfinite(matrix)) or matrix.shape != (6, 6):
        wrong = "its mass matrix is not (6, 6) finite numbers"
    elif displaced is not None and not LIGHTEST <= mass / displaced <= HEAVIEST:
        wrong = (
            f"its mass is {mass:.6g} kg, and it displaces {displaced:.6g} kg of water: in t, or a placeholder"
        )
    elif box is not None and 0.0 < box[2] < SHALLOWEST * box[1]:
        wrong = (
            f"its mass is {mass:.6g} kg, which floats {box[2]:.3g} m deep on {box[0]:.4g} x {box[1]:.4g} m: "
            "in t, or a placeholder"
        )
    elif np.abs(matrix - matrix.T).max() > HALVES * np.abs(matrix).max():
        wrong = "its mass matrix is not symmetric"
    elif np.linalg.eigvalsh(0.5 * (matrix + matrix.T))[0] <= 0.0:
        wrong = "its mass matrix is not positive definite: no mass or no inertia in some motion"
    elif box is not None and (radius := np.sqrt(np.diag(matrix)[3:].max() / mass)) > WIDEST * max(box):
        wrong = f"its inertia has a radius of {radius:.4g} m on {box[0]:.4g} x {box[1]:.4g} m"
    if wrong:
        raise FileFormatError(
            f"{where or asked.where}: {wrong}; give {asked.reader}(mass_matrix=...), (6, 6) in SI, or to "
            "load_database, or seacrane hydro --mass"
        )
    return matrix


def frequencies_kept(asked: Asked, omega: Array, tables: Mapping[str, Any]) -> NDArray[np.intp]:
    """Places of the positive, finite frequencies that are taken, rising.

    Parameters
    ----------
    omega : (n,) rad/s.
    tables : added_mass, damping (n, ...) and force (m, n, ...), which have to be finite.

    Raises FileFormatError: values are not finite, or a frequency to leave out is none of the file's.
    """
    rows = np.argsort(omega)
    rows = rows[(omega[rows] > 0.0) & np.isfinite(omega[rows])]
    kept, omega = np.ones(len(rows), dtype=bool), omega[rows]
    for one in np.ravel(np.asarray([] if asked.leave_out is None else asked.leave_out, dtype=float)):
        same = np.isclose(omega, one, rtol=SAME_FREQUENCY, atol=0.0)
        if not same.any():
            raise FileFormatError(
                f"{asked.where}: leave_out holds {one:g} rad/s, none of its frequencies, "
                f"{omega.min(initial=np.inf):.4g} to {omega.max(initial=0.0):.4g} rad/s"
            )
        kept &= ~same
    bad, first = np.zeros(len(omega), dtype=bool), ""
    for name, axis in (("added_mass", 0), ("damping", 0), ("force", 1)):
        table = np.take(tables[name], rows, axis=axis)
        places = np.argwhere(~np.isfinite(table))
        places = places[kept[places[:, axis]]]
        bad[places[:, axis]] = True
        if len(places) and not first:
            first = f"{name}{places[0].tolist()} is {table[tuple(places[0])]}"
    if bad.any():
        listed = ", ".join(f"{value:.5g}" for value in omega[bad][:8])
        raise FileFormatError(
            f"{asked.where}: {first}: values at {listed} rad/s are not finite, as of a solution that failed; "
            f"solve again, or do without these frequencies by {asked.reader}(leave_out=[{listed}])"
        )
    if not kept.any():
        raise FileFormatError(
            f"{asked.where}: no finite positive frequency is left; solve for some, or leave out fewer"
        )
    return rows[kept]


def omega_of(values: Array, unit: str) -> Array:
    """Frequencies in rad/s of those in "rad/s", "Hz" or "s"; a period of 0 is infinity."""
    if np.any(values < 0.0):
        raise ValueError(f"period or frequency {values.min():g}; give positive ones")
    with np.errstate(divide="ignore"):
        return 2.0 * np.pi / values if unit == "s" else values * (2.0 * np.pi if unit == "Hz" else 1.0)


def rising_directions(raw: Array) -> tuple[Array, NDArray[np.intp]]:
    """Directions (rad) in [0, 2 pi), rising, and their places in ``raw``; a full turn beside 0 is dropped."""
    wrapped = np.mod(raw, 2.0 * np.pi)
    wrapped[2.0 * np.pi - wrapped < SAME_DIRECTION] = 0.0
    order = np.argsort(wrapped, kind="stable")
    new = np.append(True, np.diff(wrapped[order]) > SAME_DIRECTION)
    return wrapped[order][new], order[new]


def rising_degrees(degrees: Array) -> tuple[Array, NDArray[np.intp]]:
    """The same of degrees, in [0, 360) to 1e-6."""
    wrapped = np.round(np.mod(degrees, 360.0), 6) % 360.0
    return np.unique(wrapped, return_index=True)


def require_own_hydrostatics(where: object, found: HydroGroup, fix: str) -> None:
    """Raise unless a long wave lifts each body with its own C33, as it does whatever lies beside it.

    Files by body that stand in another order, or that hold all bodies together, fail it. Nothing is told
    where no wave is long enough.
    """
    lift = long_wave_lift(found)
    if lift is None:
        return
    stiffness = np.array([body.restoring[2, 2] for body in found.bodies])
    off = np.abs(stiffness / lift - 1.0)
    if off.max() <= LIFT_LIMIT:
        return
    at = int(off.argmax())
    others = [i for i in range(len(lift)) if i != at and abs(stiffness[at] / lift[i] - 1.0) <= LIFT_LIMIT]
    guess = (
        "all bodies together, perhaps"
        if not others
        else f"{found.names[others[0]]}: they stand in another order"
    )
    raise FileFormatError(
        f"{where}: the restoring of {found.names[at]} has C33 = {stiffness[at]:.4g} N/m, and a wave of "
        f"{found.omega[0]:.3g} rad/s lifts it with {lift[at]:.4g} N/m: it is that of {guess}. Give {fix}"
    )


def with_band_of_data(found: Found) -> Found:
    """The database or group; where it has no trusted band, with one that ends below the first jump of a hull.

    Warns with RoughDataWarning of matrices that jump. In a group it may be a resonance of the water between
    hulls, where the frequencies are too far apart to show its shape.
    """
    if found.trusted_band is not None:
        return found
    hulls = found.hulls if isinstance(found, HydroGroup) else {"": found}
    first = {name: first_rough_value(hull) for name, hull in hulls.items()}
    rough = [(each[0], name, each[1]) for name, each in first.items() if each is not None and each[0] >= 2]
    if not rough:
        return found
    at, name, entry = min(rough, key=lambda each: each[0])
    low, high = float(found.omega[0]), float(found.omega[at - 1])
    kind, where, cause = "database", entry, ""
    if isinstance(found, HydroGroup):
        kind, where = "group", f"{entry} of {name}"
        cause = (
            ", or of a resonance of the water between the hulls that the frequencies do not resolve "
            "(group.check() tells the causes apart)"
        )
    warn_caller(
        f"{kind} {found.name!r}: its files do not say how far their panels can be trusted, and {where} jumps "
        f"at {found.omega[at]:.4g} rad/s, as of waves too short for the panels or of an irregular frequency"
        f"{cause}. The trusted band ends at {high:.4g} rad/s; nothing above it is fitted. For another one "
        "give load_database(path, trusted_band=(low, high)) in rad/s",
        RoughDataWarning,
    )
    return replace(found, trusted_band=(low, high))


def first_rough_value(database: HydroData) -> tuple[int, str] | None:
    """Where A or B first jumps: index of the frequency, and the entry ("A33"); None: smooth to the end.

    Each value is left out, and compared with the cubic through its two neighbours on either side. It is rough
    where the misfit, by what noise of that size would give, exceeds 1 % of the range of A or of the peak of B
    (geometric mean of two motions), and is not that of a curve too coarse for the cubic, which grows
    sixteenfold with twice the step.

    Looked at are steps of up to 15 % of the frequency, whose deep-water wave is shorter than two breadths.
    Below, resonances of the fluid are as narrow as errors; above, the matrices of a ship are smooth, and the
    lowest irregular frequency of a box as deep as it is broad is about there.
    """
    omega = database.omega
    start = np.sqrt(np.pi * database.g / database.breadth)
    if len(omega) < 2 * NEIGHBOURS:
        return None
    values = _by_scale(database, start)
    near, wide = (_misfit(omega, values, step) for step in (1, 2))
    around = np.maximum(wide, np.maximum(np.roll(wide, 1, axis=0), np.roll(wide, -1, axis=0)))
    lower = near[(omega >= 0.5 * start) & (omega < start)]
    allowed = np.maximum(ROUGH, lower.max(axis=0, initial=0.0))
    judged = (omega >= start) & (np.gradient(omega) <= COARSEST * omega)
    rough = (near > allowed) & (near * UNRESOLVED > around) & judged[:, None]
    found = np.flatnonzero(rough.any(axis=1))
    if not len(found):
        return None
    worst = int(np.argmax(np.where(rough[found[0]], near[found[0]], 0.0)))
    table, entry = divmod(worst, 36)
    return int(found[0]), f"{'AB'[table]}{entry // 6 + 1}{entry % 6 + 1}"


def _by_scale(database: HydroData, start: float) -> Array:
    """Symmetric parts of A and B (n, 72), by what the motions of each pair vary; forbidden pairs are zero."""
    mass = np.abs(mass_scales(database))
    kept = np.ones((6, 6))
    if database.port_starboard_symmetric:
        kept = 1.0 - np.add.outer(np.arange(6), np.arange(6)) % 2
    diagonals = [np.diagonal(table, axis1=1, axis2=2) for table in (database.added_mass, database.damping)]
    scales = (
        np.maximum(np.ptp(diagonals[0], axis=0), LEAST_INERTIA * mass),
        np.maximum(diagonals[1].max(axis=0), LEAST_DAMPING * start * mass),
    )
    parts = []
    for table, scale in zip((database.added_mass, database.damping), scales, strict=True):
        symmetric = 0.5 * (table + table.swapaxes(1, 2))
        parts.append((kept * symmetric / np.sqrt(np.outer(scale, scale))).reshape(len(table), 36))
    return np.concatenate(parts, axis=1)


def _misfit(omega: Array, values: Array, step: int) -> Array:
    """Size of values (n, p) less the cubic through four others, every ``step``, in deviations of noise.

    They are two on either side, moved inwards at an end; zero where there are not so many.
    """
    n = len(omega)
    out = np.zeros_like(values)
    for i in range(n):
        reach = NEIGHBOURS * step
        others = [k for k in range(i - reach, i + reach + 1, step) if 0 <= k < n and k != i]
        first = min(max(sum(k < i for k in others) - 2, 0), max(len(others) - NEIGHBOURS, 0))
        near = others[first : first + NEIGHBOURS]
        if len(near) < NEIGHBOURS:
            continue
        x = omega[near]
        away = x[:, None] - x[None, :] + np.eye(NEIGHBOURS)
        toward = np.where(np.eye(NEIGHBOURS, dtype=bool), 1.0, omega[i] - x[None, :])
        weights = np.prod(toward / away, axis=1)
        out[i] = np.abs(values[i] - weights @ values[near]) / np.sqrt(1.0 + weights @ weights)
    return out
