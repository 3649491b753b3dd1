"""Natural modes of hulls in one water, each without its damping, and what damps it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_group_data import HydroGroupData
from seacrane.inputs.brief import brief

FloatArray = NDArray[np.float64]

BISECTIONS = 40


@dataclass(frozen=True, kw_only=True, eq=False)
class GroupMode:
    """A natural mode of a group.

    Attributes
    ----------
    omega : rad/s. period : s.
    damping_ratio : of critical, by radiation and linear damping at that frequency.
    shape : (6 k,) motions, m and rad, read-only, the largest of ``shape`` times half the lengths being 1.
    """

    omega: float
    damping_ratio: float
    shape: FloatArray

    __repr__ = brief

    @property
    def period(self) -> float:
        """Natural period, s."""
        return 2.0 * np.pi / self.omega


def natural_modes_of(group: HydroGroupData) -> tuple[GroupMode, ...]:
    """`HydroGroup.natural_modes`.

    Where an eigenvalue of ``C - w^2 (M + A(w))``, symmetric, falls through zero between two of the
    frequencies; A is a straight line between them.
    """
    dynamic = _dynamic(group, group.omega)
    size = _sizes(group)
    scaled = np.linalg.eigvalsh(dynamic * np.outer(size, size))
    modes = []
    for i in range(len(group.omega) - 1):
        for place in np.flatnonzero((scaled[i] > 0.0) & (scaled[i + 1] <= 0.0)):
            modes.append(_mode(group, (float(group.omega[i]), float(group.omega[i + 1])), int(place), size))
    return tuple(sorted(modes, key=lambda mode: mode.omega))


def _mode(group: HydroGroupData, between: tuple[float, float], place: int, size: FloatArray) -> GroupMode:
    low, high = between
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        value = np.linalg.eigvalsh(_dynamic(group, np.array([middle]))[0] * np.outer(size, size))[place]
        low, high = (middle, high) if value > 0.0 else (low, middle)
    omega = 0.5 * (low + high)
    dynamic = _dynamic(group, np.array([omega]))[0]
    vector = np.linalg.eigh(dynamic * np.outer(size, size))[1][:, place]
    shape = vector * size / vector[np.abs(vector).argmax()]
    inertia = group.mass_matrix + _symmetric(_table(group, group.added_mass, np.array([omega]))[0])
    damping = group.linear_damping + _table(group, group.damping, np.array([omega]))[0]
    ratio = (shape @ damping @ shape) / (2.0 * omega * (shape @ inertia @ shape))
    shape.setflags(write=False)
    return GroupMode(omega=omega, damping_ratio=float(ratio), shape=shape)


def _dynamic(group: HydroGroupData, omega: FloatArray) -> FloatArray:
    inertia = group.mass_matrix + _symmetric(_table(group, group.added_mass, omega))
    return np.asarray(_symmetric(group.restoring) - omega[:, None, None] ** 2 * inertia)


def _table(group: HydroGroupData, table: FloatArray, omega: FloatArray) -> FloatArray:
    """Matrices at frequencies of the band, by straight lines."""
    right = np.clip(np.searchsorted(group.omega, omega), 1, len(group.omega) - 1)
    left = right - 1
    part = (omega - group.omega[left]) / (group.omega[right] - group.omega[left])
    return np.asarray((1.0 - part)[:, None, None] * table[left] + part[:, None, None] * table[right])


def _symmetric(matrices: FloatArray) -> FloatArray:
    return np.asarray(0.5 * (matrices + matrices.swapaxes(-1, -2)))


def _sizes(group: HydroGroupData) -> FloatArray:
    """1 for translations, 1 over half the length for rotations: motions that move the ends alike."""
    return np.concatenate([np.repeat([1.0, 2.0 / body.length], 3) for body in group.bodies])
