"""The trusted band of sources that do not tell their panels: as far as their matrices are smooth."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.group.group import HydroGroup
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import RoughDataWarning

FloatArray = NDArray[np.float64]
Found = TypeVar("Found", bound=HydroDatabase | HydroGroup)
ROUGH = 0.01  # misfit of a left-out value, as a share of what varies
UNRESOLVED = 4.0  # misfit over twice the step by that over the step: 16 of smooth data, 1 of noise
LEAST_INERTIA, LEAST_DAMPING = 0.1, 0.01  # scales at least, by the mass and by mass times frequency
COARSEST = 0.15  # step by frequency, beyond which a table does not tell noise from shape
NEIGHBOURS = 4


def with_band_of_data(found: Found) -> Found:
    """The database or group; where it has no trusted band, with one that ends below the first jump of a hull.

    Warns
    -----
    RoughDataWarning : matrices jump. In a group it may be a resonance of the water between hulls, where the
        frequencies are too far apart to show its shape.
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
    kind, causes, more = "database", "for the panels or of an irregular frequency", ""
    if isinstance(found, HydroGroup):
        kind, entry = "group", f"{entry} of {name}"
        causes = (
            "for the panels, of an irregular frequency, or of a resonance of the water between the hulls "
            "that the frequencies do not resolve"
        )
        more = "; group.check() tells the causes apart"
    warn_caller(
        f"{kind} {found.name!r}: its files do not say how far their panels can be trusted, and {entry} "
        f"jumps at {found.omega[at]:.4g} rad/s, as of waves too short {causes}. The trusted band ends at "
        f"{high:.4g} rad/s; nothing above it is fitted. For another one give load_database(path, "
        f"trusted_band=(low, high)) in rad/s{more}",
        RoughDataWarning,
    )
    return replace(found, trusted_band=(low, high))


def first_rough_value(database: HydroData) -> tuple[int, str] | None:
    """Where A or B first jumps: index of the frequency, and the entry ("A33"); None: smooth to the end.

    Each value is left out, and compared with the cubic through its two neighbours on either side. It is rough
    where the misfit, by what noise of that size would give, exceeds 1 % of the range of A or of the peak of B
    (geometric mean of two motions), and is not that of a curve too coarse for the cubic. Such a misfit grows
    sixteenfold with twice the step, noise does not; and it is larger at lower frequencies, where a ship's
    matrices turn most.

    Looked at are frequencies whose deep-water wave is shorter than two breadths. Below, resonances of the
    fluid are as narrow as errors; above, the matrices of a ship are smooth, the lowest irregular frequency of
    a box as deep as it is broad is about there, and no mesh is as coarse as to fail sooner. Steps above 15 %
    of the frequency are not judged.
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


def _by_scale(database: HydroData, start: float) -> FloatArray:
    """Symmetric parts of A and B (n, 72), by what the motions of each pair vary; forbidden pairs are zero."""
    mass = np.abs(np.diag(database.mass_matrix))
    kept = np.ones((6, 6))
    if database.port_starboard_symmetric:
        kept = 1.0 - np.add.outer(np.arange(6), np.arange(6)) % 2
    parts = []
    for table in (database.added_mass, database.damping):
        diagonal = np.diagonal(table, axis1=1, axis2=2)
        if table is database.added_mass:
            scale = np.maximum(np.ptp(diagonal, axis=0), LEAST_INERTIA * mass)
        else:
            scale = np.maximum(diagonal.max(axis=0), LEAST_DAMPING * start * mass)
        symmetric = 0.5 * (table + table.swapaxes(1, 2))
        parts.append((kept * symmetric / np.sqrt(np.outer(scale, scale))).reshape(len(table), 36))
    return np.concatenate(parts, axis=1)


def _misfit(omega: FloatArray, values: FloatArray, step: int) -> FloatArray:
    """Size of values (n, p) less the cubic through four others, every ``step``, in deviations of noise."""
    n = len(omega)
    out = np.zeros_like(values)
    for i in range(n):
        near = _neighbours(i, n, step)
        if near is None:
            continue
        x = omega[near]
        away = x[:, None] - x[None, :] + np.eye(NEIGHBOURS)
        toward = np.where(np.eye(NEIGHBOURS, dtype=bool), 1.0, omega[i] - x[None, :])
        weights = np.prod(toward / away, axis=1)
        out[i] = np.abs(values[i] - weights @ values[near]) / np.sqrt(1.0 + weights @ weights)
    return out


def _neighbours(i: int, n: int, step: int) -> NDArray[np.intp] | None:
    """Two on either side of i, moved inwards at an end; None where there are not so many."""
    offsets = [k for k in range(-NEIGHBOURS, NEIGHBOURS + 1) if k and 0 <= i + k * step < n]
    below = [k for k in offsets if k < 0]
    first = min(max(len(below) - 2, 0), max(len(offsets) - NEIGHBOURS, 0))
    chosen = offsets[first : first + NEIGHBOURS]
    return i + step * np.array(chosen) if len(chosen) == NEIGHBOURS else None
