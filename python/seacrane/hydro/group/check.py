"""Self-check of a group: symmetry, damping, far field, dispersion over all motions; the water in the gaps."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_group_data import HydroGroupData, in_trusted_band
from seacrane.hydro.data.relations import (
    damping_from_forces,
    infinite_added_mass_from_damping,
    resolved_by_headings,
)
from seacrane.hydro.database.check import (
    DAMPING_LIMIT,
    FORCE_DAMPING_LIMIT,
    KRAMERS_KRONIG_LIMIT,
    SYMMETRY_LIMIT,
    CheckRow,
    at_least,
    at_most,
    fit_rows,
    info,
    passivity_rows,
    skewness,
)
from seacrane.hydro.group.gap import clearance, gaps, long_wave_lift, radiating, spikes
from seacrane.inputs.frames import MOTIONS

COUPLING_LIMIT = 0.1  # thin plates and narrow gaps: codes differ by 25 % on coupling
LIFT_LIMIT = 0.1


def check_group(group: HydroGroupData) -> list[CheckRow]:
    """All checks that the group's content allows; docs/hull-hydrodynamics.md says what each value means."""
    return [
        *_matrix_rows(group),
        *_far_field_rows(group),
        *_dispersion_rows(group),
        *_water_rows(group),
        *([] if group.memory is None else fit_rows(group.memory) + passivity_rows(group.memory)),
    ]


def _matrix_rows(group: HydroGroupData) -> list[CheckRow]:
    """Symmetry of the hulls' own blocks and of what couples them, and damping that takes energy from all.

    Of motions that radiate: what a file holds for others is noise.
    """
    own = np.kron(np.eye(len(group.bodies)), np.ones((6, 6))).astype(bool)
    inside, felt = in_trusted_band(group), radiating(group)
    both = np.outer(felt, felt)
    rows = []
    for name, matrix in (("added_mass", group.added_mass), ("damping", group.damping)):
        skew = np.where(both, skewness(matrix[inside]), 0.0)
        rows.append(at_most(f"symmetry_{name}", float(skew[own].max()), SYMMETRY_LIMIT))
        rows.append(at_most(f"symmetry_{name}_coupling", float(skew[~own].max()), COUPLING_LIMIT))
    damping = group.damping[inside][:, felt][:, :, felt]
    if damping.size:
        rows.append(at_least("damping_smallest_eigenvalue", _smallest_damping(damping), DAMPING_LIMIT))
    return rows


def _smallest_damping(damping: NDArray[np.float64]) -> float:
    """Smallest eigenvalue of B over all frequencies, scaled by the square roots of its largest diagonals."""
    peak = np.sqrt(np.maximum(np.diagonal(damping, axis1=1, axis2=2).max(axis=0), 0.0))
    active = peak > 0.0
    if not np.any(active):
        return 0.0
    scaled = (damping[:, active][:, :, active]) / np.outer(peak[active], peak[active])
    return float(np.linalg.eigvalsh(0.5 * (scaled + scaled.swapaxes(1, 2)))[:, 0].min())


def _far_field_rows(group: HydroGroupData) -> list[CheckRow]:
    """Damping (own and coupled) against the waves that the exciting forces say are radiated."""
    radiated = damping_from_forces(group)
    inside = in_trusted_band(group) & resolved_by_headings(group)
    if radiated is None or not np.any(inside):
        return []
    peak = np.sqrt(np.abs(np.diagonal(group.damping, axis1=1, axis2=2)).max(axis=0))
    felt = radiating(group)
    error = np.abs(radiated - 0.5 * (group.damping + group.damping.swapaxes(1, 2)))[inside].max(axis=0)
    share = np.where(np.outer(felt, felt), error / np.maximum(np.outer(peak, peak), 1e-300), 0.0)
    return _by_motion_and_pair(group, "damping_from_forces", share, felt, FORCE_DAMPING_LIMIT)


def _dispersion_rows(group: HydroGroupData) -> list[CheckRow]:
    """Infinite-frequency added mass against what the damping implies, by the range of the motions' own."""
    if group.infinite_frequency_added_mass is None:
        return []
    known = group.infinite_frequency_added_mass
    difference = np.abs(infinite_added_mass_from_damping(group) - known)
    span = np.ptp(np.diagonal(group.added_mass, axis1=1, axis2=2), axis=0)
    felt = radiating(group) & (span > 0.0)
    share = np.where(
        np.outer(felt, felt), difference / np.maximum(np.sqrt(np.outer(span, span)), 1e-300), 0.0
    )
    return _by_motion_and_pair(group, "kramers_kronig", share, felt, KRAMERS_KRONIG_LIMIT)


def _by_motion_and_pair(
    group: HydroGroupData, name: str, share: NDArray[np.float64], felt: NDArray[np.bool_], limit: float
) -> list[CheckRow]:
    """A row for each motion that is felt, and one for the largest entry between each two hulls."""
    labels = [f"{hull}_{motion}" for hull in group.names for motion in MOTIONS]
    rows = [at_most(f"{name}_{labels[i]}", float(share[i, i]), limit) for i in np.flatnonzero(felt)]
    for (i, a), (j, b) in combinations(enumerate(group.names), 2):
        block = share[6 * i : 6 * i + 6, 6 * j : 6 * j + 6]
        rows.append(at_most(f"{name}_{a}_{b}", float(block.max()), limit))
    return rows


def _water_rows(group: HydroGroupData) -> list[CheckRow]:
    """Each hull's C33 against the force of a long wave on it, which hydrostatics of another hull fail; widths
    of the gaps, their piston modes, and what explains each narrow peak of the damping.

    An irregular frequency within the trusted band is an error of the source; a resonance of a gap is water,
    too high without a damping lid.
    """
    lift = long_wave_lift(group)
    rows = [
        at_most(f"c33_against_long_wave_{body.name}", abs(body.restoring[2, 2] / force - 1.0), LIFT_LIMIT)
        for body, force in zip(group.bodies, () if lift is None else lift, strict=lift is not None)
    ]
    for a, b in combinations(group.bodies, 2):
        rows.append(info(f"clearance_{a.name}_{b.name}_m", clearance(a, b)[0]))
    rows += [info(f"gap_{gap.first}_{gap.second}_piston_rad_s", gap.piston) for gap in gaps(group)]
    for spike in spikes(group):
        label = f"{spike.cause}_frequency{'_' if spike.of else ''}{spike.of}_rad_s"
        wrong = spike.cause == "irregular" and in_trusted_band(group, np.array(spike.omega))
        verdict = "fail" if wrong else "info"
        rows.append(CheckRow(check=label, value=spike.omega, limit=None, verdict=verdict))
    if group.lid_damping is not None:
        rows.append(info("lid_damping", group.lid_damping))
    return rows
