"""What every reader asks of what it read: motions that were solved, whole matrices, a mass."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import Hydrodynamics, HydroGroupData
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.warnings import FloatingPositionWarning

FloatArray = NDArray[np.float64]
Data = TypeVar("Data", bound=Hydrodynamics)

SYMMETRIC = ("added_mass", "damping", "infinite_frequency_added_mass", "zero_frequency_added_mass")
SAME_FREQUENCY = 1e-3  # of one that is to be left out, as messages round it
LIGHTEST, HEAVIEST = 0.5, 2.0  # mass over displaced mass of a vessel that floats
SHALLOWEST = 1e-3  # draught over breadth
OBLIQUE = 0.1  # sine of twice a heading: waves from there load every motion
ROUND = 1e-3  # by which two motions of a round body may differ


def as_read(where: object, reader: str, found: Data, motions: Sequence[str] | None) -> Data:
    """The database or group, halves of its matrices completed.

    Parameters
    ----------
    where : file, for messages.
    reader : name of the function that takes ``motions``.
    motions : names of those that were solved, as the caller says; None: all.

    Raises FileFormatError: a motion has neither added mass nor damping, and ``motions`` does not say so.

    Warns
    -----
    FloatingPositionWarning : it turns over by itself.
    """
    require_solved(where, reader, found, motions)
    halves: dict[str, Any] = {
        name: mirrored(getattr(found, name)) for name in SYMMETRIC if getattr(found, name) is not None
    }
    if isinstance(found, HydroGroupData):
        bodies = tuple(replace(body, restoring=whole_stiffness(body.restoring)) for body in found.bodies)
        return replace(found, **halves, bodies=bodies)
    whole = replace(found, **halves, restoring=whole_stiffness(found.restoring))
    warn_of_turning_over(where, whole)
    return whole


def require_solved(where: object, reader: str, found: Hydrodynamics, motions: Sequence[str] | None) -> None:
    """Raise where a motion was not solved, and the caller does not say so."""
    known = set(MOTIONS) if motions is None else {str(motion).lower() for motion in motions}
    if not known <= set(MOTIONS):
        raise FileFormatError(
            f"{where}: motions names {', '.join(sorted(known - set(MOTIONS)))}; give some of "
            f"{', '.join(MOTIONS)}"
        )
    moved = np.any(found.added_mass, axis=(0, 2)) | np.any(found.damping, axis=(0, 2))
    forced = np.any(found.force, axis=(0, 1)) | (np.abs(np.sin(2.0 * found.heading)).max() < OBLIQUE)
    _ask_for(where, reader, found, known, ~moved, "no added mass and no damping at any frequency")
    _ask_for(where, reader, found, known, ~forced, "no wave force at any frequency and heading")


def _ask_for(
    where: object, reader: str, found: Hydrodynamics, known: set[str], without: NDArray[np.bool_], what: str
) -> None:
    """Raise where motions that should be known are without something, but for yaw of a round body."""
    empty = [i for i in np.flatnonzero(without).tolist() if MOTIONS[i % 6] in known]
    lacking = [i for i in empty if i % 6 != 5 or not _is_round(found, i - 5)]
    if lacking:
        names = [*getattr(found, "names", [""])]
        told = ", ".join(f"{names[i // 6]} {MOTIONS[i % 6]}".strip() for i in lacking)
        solved = tuple(name for i, name in enumerate(MOTIONS) if i not in {one % 6 for one in lacking})
        raise FileFormatError(
            f"{where}: {told} {'has' if len(lacking) == 1 else 'have'} {what}: not solved for. Solve for it, "
            f"or say which were by {reader}(motions={solved}), and keep the vessel from the others"
        )


def _is_round(found: Hydrodynamics, first: int) -> bool:
    """Whether a body is round about its vertical axis, so that water takes no part in its yaw."""
    a = np.diagonal(found.added_mass, axis1=1, axis2=2)[:, first : first + 5]
    return bool(np.all(np.abs(a[:, 0] - a[:, 1]) <= ROUND * np.abs(a[:, 0])) and np.any(a[:, 0]))


def mirrored(matrices: FloatArray) -> FloatArray:
    """Symmetric matrices (..., k, k) of which a file holds one half: the other is its mirror image."""
    lower = np.tril(np.ones(matrices.shape[-2:], dtype=bool), -1)
    there = [bool(np.any(matrices[..., half])) for half in (lower, lower.T)]
    if there[0] == there[1]:
        return matrices
    diagonal = np.where(np.eye(len(lower), dtype=bool), matrices, 0.0)
    half = matrices - diagonal
    return np.asarray(diagonal + half + half.swapaxes(-1, -2))


def whole_stiffness(restoring: FloatArray) -> FloatArray:
    """`mirrored` of heave, roll and pitch: moments of weights about the vertical stand in one half alone."""
    out = restoring.copy()
    out[2:5, 2:5] = mirrored(restoring[2:5, 2:5])
    return out


def warn_of_turning_over(where: object, hull: HydroData) -> None:
    """Warn of a hull whose C44 or C55 is not positive: it floats upright with what is not in it yet."""
    weight = hull.mass_matrix[0, 0] * hull.g
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
    where: object,
    argument: str,
    mass_matrix: ArrayLike,
    *,
    displaced: float | None = None,
    box: tuple[float, float, float] | None = None,
) -> FloatArray:
    """The mass matrix (6, 6) of a file, its halves completed; asked for where it is none of a vessel.

    Parameters
    ----------
    argument : what the caller gives in its place, such as "read_wamit(mass_matrix=...)".
    displaced : kg, where the file tells it.
    box : length, breadth and draught of the equivalent box, m, where the mass is all that tells the last.

    Raises FileFormatError: no mass, no inertia, or a placeholder.
    """
    matrix = mirrored(np.asarray(mass_matrix, dtype=float))
    mass = float(matrix[0, 0]) if matrix.shape == (6, 6) else np.nan
    wrong = ""
    if not np.all(np.isfinite(matrix)) or matrix.shape != (6, 6):
        wrong = "its mass matrix is not (6, 6) finite numbers"
    elif displaced is not None and not LIGHTEST <= mass / displaced <= HEAVIEST:
        wrong = f"its mass is {mass:.6g} kg, and it displaces {displaced:.6g} kg of water: a placeholder"
    elif box is not None and 0.0 < box[2] < SHALLOWEST * box[1]:
        wrong = (
            f"its mass is {mass:.6g} kg, which floats {box[2]:.3g} m deep on {box[0]:.4g} x {box[1]:.4g} m: "
            "a placeholder"
        )
    elif np.linalg.eigvalsh(0.5 * (matrix + matrix.T))[0] <= 0.0:
        wrong = "its mass matrix is not positive definite: no mass or no inertia in some motion"
    if wrong:
        raise FileFormatError(f"{where}: {wrong}; give {argument}, (6, 6) in SI")
    return matrix


def frequencies_kept(
    where: object,
    reader: str,
    omega: FloatArray,
    tables: Mapping[str, NDArray[Any]],
    leave_out: ArrayLike | None,
) -> NDArray[np.intp]:
    """Places of the frequencies that are taken.

    Parameters
    ----------
    omega : (n,) rad/s.
    tables : by name, added mass and damping (n, ...) and force (m, n, ...), which have to be finite.
    leave_out : rad/s of those that the caller does without.

    Raises FileFormatError: values are not finite, or a frequency to leave out is none of the file's.
    """
    kept = np.ones(len(omega), dtype=bool)
    for one in np.ravel(np.asarray([] if leave_out is None else leave_out, dtype=float)):
        same = np.isclose(omega, one, rtol=SAME_FREQUENCY, atol=0.0)
        if not same.any():
            raise FileFormatError(
                f"{where}: leave_out holds {one:g} rad/s, none of its frequencies, {omega.min():.4g} to "
                f"{omega.max():.4g} rad/s"
            )
        kept &= ~same
    bad = np.zeros(len(omega), dtype=bool)
    first = ""
    for name, table in tables.items():
        places = np.argwhere(~np.isfinite(table))
        at = places[:, 1 if name == "force" else 0]
        places, at = places[kept[at]], at[kept[at]]
        bad[at] = True
        if len(places) and not first:
            first = f"{name}{places[0].tolist()} is {table[tuple(places[0])]}"
    if bad.any():
        listed = ", ".join(f"{value:.5g}" for value in omega[bad][:8])
        raise FileFormatError(
            f"{where}: {first}: values at {listed} rad/s are not finite, as of a solution that failed; solve "
            f"again, or do without these frequencies by {reader}(leave_out=[{listed}])"
        )
    if not kept.any():
        raise FileFormatError(f"{where}: leave_out leaves no frequency; leave out fewer")
    return np.flatnonzero(kept)
