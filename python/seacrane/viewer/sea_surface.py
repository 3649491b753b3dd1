"""The sea as a round sheet of triangles, finer towards its middle; exact at its points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.viewer.palette import SKY, rgb

Array = NDArray[np.float64]

RINGS = 90
REACH = 9.0  # radius over that of the things in it
DEEP, CREST = (0.03, 0.17, 0.27), (0.20, 0.50, 0.58)  # colours of troughs and crests, rgb
FADES = (0.3, 0.95)  # of the radius, between which the water turns into sky


@dataclass(frozen=True, kw_only=True, eq=False)
class SeaSurface:
    """A sheet of points `place` (n, 2), m, with triangles `faces` (m, 3); `far` (n,) is 0 to 1 outwards."""

    components: Array
    place: Array
    faces: NDArray[np.intp]
    far: Array

    def elevation(self, time: float) -> tuple[Array, Array]:
        """Heights (n,), m, and slopes (n, 2), of the sum of all components at a time, s."""
        amplitude, omega, phase, kx, ky = self.components.T
        angle = np.remainder(omega * time + phase, 2.0 * np.pi) - self.place @ np.array([kx, ky])
        rise = amplitude * np.sin(angle)
        return np.cos(angle) @ amplitude, np.column_stack([rise @ kx, rise @ ky])

    def colours(self, height: Array) -> NDArray[np.uint8]:
        """(n, 3): darker in troughs, sky far out."""
        usual = float(np.sqrt(np.sum(self.components[:, 0] ** 2))) or 0.5
        up = np.clip(0.45 + 0.3 * height / usual, 0.0, 1.0)[:, None]
        out = np.clip((self.far - FADES[0]) / (FADES[1] - FADES[0]), 0.0, 1.0)[:, None]
        out = out**2 * (3.0 - 2.0 * out)
        water = np.array(DEEP) * (1.0 - up) + np.array(CREST) * up
        return np.asarray(np.rint(255.0 * (water * (1.0 - out) + np.array(rgb(SKY)) * out)), dtype=np.uint8)


def sea_surface(components: Array, centre: Array, radius: float) -> SeaSurface:
    """Of components as of `sea_components`, about a centre (2,), for things of that radius, m."""
    spokes = 2 * RINGS
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(1, RINGS + 1), np.arange(spokes), indexing="ij"))
    u, angle = i / RINGS, 2.0 * np.pi * (j + 0.5 * (i % 2)) / spokes
    far = 0.22 * u + 0.78 * u**4
    ring = (REACH * radius * far)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    place = np.concatenate([np.zeros((1, 2)), ring]) + centre
    number = np.arange(1, 1 + RINGS * spokes).reshape(RINGS, spokes)
    after = np.roll(number, -1, axis=1)
    a, b, c, d = (one.ravel() for one in (number[:-1], number[1:], after[1:], after[:-1]))
    middle = np.column_stack([np.zeros(spokes, dtype=int), number[0], after[0]])
    faces = np.concatenate([middle, np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    return SeaSurface(components=components, place=place, faces=faces, far=np.concatenate([[0.0], far]))
