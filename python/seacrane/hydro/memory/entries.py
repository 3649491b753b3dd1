"""Which entries of the matrices have a memory, and between what bounds their fitted damping may lie."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.memory.identification import RationalFit

FloatArray = NDArray[np.float64]

NEGLIGIBLE = 1e-4  # a panel code's noise in pairs that a box makes zero is a fifth of it
FEWEST_FREQUENCIES = 8


def memory_entries(
    added_mass: FloatArray, damping: FloatArray, omega: FloatArray, *, symmetric: bool = False
) -> Iterator[tuple[int, int]]:
    """Entries (j <= k) with any memory, judged against the geometric mean of their diagonals.

    ``symmetric``: of a vessel alike to port and starboard, whose surge, heave and pitch know nothing of sway,
    roll and yaw; what a file holds there is noise.
    """
    variation = np.ptp(added_mass, axis=0) * float(np.mean(omega)) + np.abs(damping).max(axis=0)
    diagonal = np.sqrt(np.diag(variation))
    motions = len(diagonal)
    for offset in range(motions):  # diagonals first: they bound the damping of the others
        for j in range(motions - offset):
            k = j + offset
            if symmetric and offset % 2:
                continue
            if variation[j, k] > NEGLIGIBLE * diagonal[j] * diagonal[k] and variation[j, k] > 0.0:
                yield j, k


def motion_groups(pairs: list[tuple[int, int]]) -> list[list[int]]:
    """Motions that hang together through ``pairs``, each group in increasing order."""
    groups: list[set[int]] = []
    for pair in pairs:
        touched = [group for group in groups if group & set(pair)]
        groups = [group for group in groups if group not in touched]
        groups.append(set(pair).union(*touched))
    return sorted(sorted(group) for group in groups)


def dissipation_limit(
    fits: dict[tuple[int, int], RationalFit], j: int, k: int
) -> Callable[[FloatArray], tuple[FloatArray, FloatArray]]:
    """Bounds of the fitted damping: a 2 x 2 damping matrix is positive if b_jk^2 <= b_jj b_kk."""

    def limit(omega: FloatArray) -> tuple[FloatArray, FloatArray]:
        if j == k:
            return np.zeros_like(omega), np.full_like(omega, np.inf)
        bound = np.zeros_like(omega)
        if (j, j) in fits and (k, k) in fits:
            bound = np.sqrt(
                np.maximum(fits[j, j].damping(omega), 0.0) * np.maximum(fits[k, k].damping(omega), 0.0)
            )
        return -bound, bound

    return limit
