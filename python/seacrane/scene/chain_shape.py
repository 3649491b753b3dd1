"""The rest shape of a chain of elastic segments with point masses between them, in part on a seabed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.one_thread import one_thread

Array = NDArray[np.float64]
LARGEST_ERROR = 1e-12  # of the chain's length
LARGEST_COUNT = 500  # of iterations
SOFTEST = 1e-9  # of the reference force: below it a segment has no direction
LEAST_GAIN = 1e-4  # share of the expected fall that a step must bring


@dataclass(frozen=True, eq=False, kw_only=True)
class Chain:
    """A chain of equal segments between two points.

    Attributes
    ----------
    span : (3,) From the first end to the second, m.
    segment : Unstretched length of each segment, m.
    stiffness : EA, N.
    weights : (n - 1,) Of the masses between the n segments, N, along -z; below zero in water: they float up.
    bed : Height of a level seabed over the first end, m; None: there is none.
    bed_stiffness : Of it under each mass, N/m.
    """

    span: Array
    segment: float
    stiffness: float
    weights: Array
    bed: float | None = None
    bed_stiffness: float = 1.0

    @property
    def count(self) -> int:
        """The number of the segments."""
        return int(self.weights.size) + 1

    @one_thread
    def forces(self) -> Array | None:
        """Tension of each segment as a vector, (n, 3), N, from the first end on; None where there is no rest.

        The complementary energy, the sum of segment (|T|^2 / (2 EA) + |T|) less T . span, is convex in the
        force at the first end: Newton's method with a line search finds its minimum. A seabed bears the
        masses by further forces N >= 0, each with N^2 / (2 k) and N times the height of the second end: it is
        convex in all of them.
        """
        hung = np.zeros((self.count, 3))
        hung[1:, 2] = np.cumsum(self.weights)
        force = self._start(float(hung[-1, 2]))
        scale = max(float(np.linalg.norm(force)), abs(float(hung[-1, 2])))
        borne = 0 if self.bed is None else self.count - 1
        forces = np.concatenate([force, np.zeros(borne)])
        for _ in range(LARGEST_COUNT):
            tension = self._tension(forces, hung)
            gap = self._gap(tension, forces)
            free = np.ones(gap.size, dtype=bool)
            free[3:] = (forces[3:] > 0.0) | (gap[3:] < 0.0)
            if np.abs(gap[free]).max() <= LARGEST_ERROR * self.segment * self.count:
                return tension
            step = np.zeros(gap.size)
            step[free] = -np.linalg.solve(self._slope(tension, scale)[np.ix_(free, free)], gap[free])
            forces = self._moved(forces, hung, step, gap)
        return None

    def points(self, forces: Array) -> Array:
        """The places of the masses, (n - 1, 3), m from the first end."""
        return np.asarray(np.cumsum(self._spans(forces), axis=0)[:-1])

    def _start(self, weight: float) -> Array:
        """By the parabola of a shallow chain; along the span where it is taut."""
        length, span = self.segment * self.count, float(np.linalg.norm(self.span))
        flat = float(np.hypot(self.span[0], self.span[1]))
        size = abs(weight)  # below zero it floats up
        if span >= length or size == 0.0:
            pull = max(self.stiffness * (span / length - 1.0), 0.1 * size, 1e-6 * self.stiffness)
            return np.asarray(pull * self.span / span) - [0.0, 0.0, 0.5 * weight]
        sag = np.sqrt(3.0 * max((length**2 - self.span[2] ** 2) / max(flat, 0.01 * length) ** 2 - 1.0, 1e-6))
        level = 0.5 * size * max(flat, 0.01 * length) / length / sag
        rise = 0.5 * (size * self.span[2] / length / np.tanh(sag) - weight)
        ahead = self.span[:2] / flat if flat > 0.0 else np.array([1.0, 0.0])
        return np.array([*(level * ahead), rise])

    def _spans(self, tension: Array) -> Array:
        size = np.linalg.norm(tension, axis=1, keepdims=True)
        return np.asarray(self.segment * tension * (1.0 / self.stiffness + 1.0 / np.maximum(size, 1e-300)))

    def _tension(self, forces: Array, hung: Array) -> Array:
        tension = forces[:3] + hung
        if forces.size > 3:
            tension[1:, 2] -= np.cumsum(forces[3:])
        return np.asarray(tension)

    def _gap(self, tension: Array, forces: Array) -> Array:
        """Of the second end from its place, and of each mass over where the seabed bears its force, m."""
        spans = self._spans(tension)
        gap = spans.sum(axis=0) - self.span
        if self.bed is None:
            return np.asarray(gap)
        beyond = np.cumsum(spans[:0:-1, 2])[::-1]  # from each mass up to the second end
        return np.concatenate([gap, forces[3:] / self.bed_stiffness + self.span[2] - self.bed - beyond])

    def _slope(self, tension: Array, scale: float) -> Array:
        size = np.maximum(np.linalg.norm(tension, axis=1), SOFTEST * scale)[:, None, None]
        along = tension[:, :, None] / size
        across = (np.eye(3) - along * np.swapaxes(along, 1, 2)) / size
        each = np.eye(3) / self.stiffness + across
        whole = np.asarray(self.segment * each.sum(axis=0))
        if self.bed is None:
            return whole
        beyond = self.segment * np.cumsum(each[:0:-1, :, 2], axis=0)[::-1]
        later = np.maximum.outer(*[np.arange(len(beyond))] * 2)
        borne = beyond[later, 2] + np.eye(len(beyond)) / self.bed_stiffness
        return np.block([[whole, -beyond.T], [-beyond, borne]])

    def _energy(self, forces: Array, hung: Array) -> float:
        size = np.linalg.norm(self._tension(forces, hung), axis=1)
        stored = self.segment * (size**2 / (2.0 * self.stiffness) + size)
        energy = float(stored.sum() - forces[:3] @ self.span)
        if self.bed is None:
            return energy
        sunk = forces[3:] ** 2 / (2.0 * self.bed_stiffness) + forces[3:] * (self.span[2] - self.bed)
        return energy + float(sunk.sum())

    def _moved(self, forces: Array, hung: Array, step: Array, gap: Array) -> Array:
        """By a share of a step, halved until the energy falls as it should, as far as rounding shows it."""
        now, share = self._energy(forces, hung), 1.0
        rounding = 1e-13 * abs(now)
        while True:
            moved = forces + share * step
            moved[3:] = np.maximum(moved[3:], 0.0)
            fall = float(gap @ (moved - forces))
            if share < 1e-12 or self._energy(moved, hung) <= now + LEAST_GAIN * fall + rounding:
                return np.asarray(moved)
            share *= 0.5
