"""What a method of hydrodynamics finds for a hull, and how it is made symmetric."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

ALONG = 1e-9  # rad: headings this close to 0 or 180 deg are along the ship


@dataclass(frozen=True, kw_only=True, eq=False)
class HullSolution:
    """Radiation and excitation of a hull about its origin, in the conventions of `HydroDatabase`.

    Attributes
    ----------
    added_mass, damping : (n, 6, 6).
    added_mass_zero, added_mass_infinite : (6, 6) limits, or None where the method has none.
    force : (m, n, 6) complex, per metre of wave amplitude.
    method : how it was found, in words.
    trusted_band : (low, high) in rad/s within which the method and its panels can be relied upon.
    """

    added_mass: FloatArray
    damping: FloatArray
    added_mass_zero: FloatArray | None
    added_mass_infinite: FloatArray
    force: ComplexArray
    method: str
    trusted_band: tuple[float, float]


def symmetric_solution(solution: HullSolution, *, heading: FloatArray, reciprocal: bool) -> HullSolution:
    """The solution with what port-starboard symmetry forbids set to zero, and its text saying how much.

    ``reciprocal``: the matrices are made symmetric too, as they are at zero speed.
    """
    limits = [m for m in (solution.added_mass_zero, solution.added_mass_infinite) if m is not None]
    limits = [_symmetrised(limit, reciprocal) for limit in limits]
    removed = max(_asymmetry(m, reciprocal) for m in (solution.added_mass, solution.damping))
    force, noise = _symmetrised_force(solution.force, heading)
    return replace(
        solution,
        added_mass=_symmetrised(solution.added_mass, reciprocal),
        damping=_symmetrised(solution.damping, reciprocal),
        added_mass_zero=None if solution.added_mass_zero is None else limits[0],
        added_mass_infinite=limits[-1],
        force=force,
        method=(
            f"{solution.method}; matrices made symmetric, which removed up to {removed:.4f} of the geometric "
            "mean of the largest diagonals; motions that port-starboard symmetry forbids set to zero, which "
            f"removed up to {noise:.1e} of the largest force"
        ),
    )


def _symmetrised(matrix: FloatArray, reciprocal: bool) -> FloatArray:
    """(..., 6, 6) without the entries that port-starboard symmetry forbids; its symmetric part."""
    parity = np.arange(6) % 2
    kept = np.where(parity[:, None] == parity, matrix, 0.0)
    return 0.5 * (kept + kept.swapaxes(-1, -2)) if reciprocal else kept


def _asymmetry(matrix: FloatArray, reciprocal: bool) -> float:
    """Largest change by `_symmetrised`, by the geometric mean of the largest diagonals."""
    scale = np.sqrt(np.abs(np.diagonal(matrix, axis1=-2, axis2=-1)).max(axis=0))
    product = np.outer(scale, scale)
    change = np.abs(matrix - _symmetrised(matrix, reciprocal))
    return float((change / np.where(product > 0.0, product, 1.0)).max())


def _symmetrised_force(force: ComplexArray, heading: FloatArray) -> tuple[ComplexArray, float]:
    """Forces (m, n, 6) with sway, roll and yaw zero in head and following seas, and the share removed."""
    clean = force.copy()
    clean[np.abs(np.sin(heading)) < ALONG, :, 1::2] = 0.0
    largest = np.abs(force).max(axis=(0, 1))
    change = np.abs(force - clean).max(axis=(0, 1))
    return clean, float((change / np.where(largest > 0.0, largest, 1.0)).max())
