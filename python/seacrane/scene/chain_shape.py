"""The rest shape of a chain of elastic segments with point masses between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

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
    """

    span: Array
    segment: float
    stiffness: float
    weights: Array

    @property
    def count(self) -> int:
        """The number of the segments."""
        return int(self.weights.size) + 1

    def forces(self) -> Array | None:
        """Tension of each segment as a vector, (n, 3), N, from the first end on; None where there is no rest.

        The complementary energy, the sum of segment (|T|^2 / (2 EA) + |T|) less T . span, is convex in the
        force at the first end: Newton's method with a line search finds its minimum.
        """
        hung = np.zeros((self.count, 3))
        hung[1:, 2] = np.cumsum(self.weights)
        force = self._start(float(hung[-1, 2]))
        scale = max(float(np.linalg.norm(force)), abs(float(hung[-1, 2])))
        for _ in range(LARGEST_COUNT):
            tension = force + hung
            gap = self._reach(tension) - self.span
            if np.linalg.norm(gap) <= LARGEST_ERROR * self.segment * self.count:
                return tension
            step: Array = np.asarray(-np.linalg.solve(self._slope(tension, scale), gap), dtype=np.float64)
            force = force + self._share(force, hung, step, float(gap @ step)) * step
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

    def _reach(self, tension: Array) -> Array:
        return np.asarray(self._spans(tension).sum(axis=0))

    def _slope(self, tension: Array, scale: float) -> Array:
        size = np.maximum(np.linalg.norm(tension, axis=1), SOFTEST * scale)[:, None, None]
        along = tension[:, :, None] / size
        across = (np.eye(3) - along * np.swapaxes(along, 1, 2)) / size
        return np.asarray(self.segment * (np.eye(3) / self.stiffness + across).sum(axis=0))

    def _energy(self, force: Array, hung: Array) -> float:
        size = np.linalg.norm(force + hung, axis=1)
        stored = self.segment * (size**2 / (2.0 * self.stiffness) + size)
        return float(stored.sum() - force @ self.span)

    def _share(self, force: Array, hung: Array, step: Array, fall: float) -> float:
        """Share of a step, halved until the energy falls as it should; near the minimum rounding hides it."""
        now, share = self._energy(force, hung), 1.0
        rounding = 1e-13 * abs(now)
        while self._energy(force + share * step, hung) > now + LEAST_GAIN * share * fall + rounding:
            share *= 0.5
            if share < 1e-12:
                break
        return share
