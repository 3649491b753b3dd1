"""Headings of a port-starboard symmetric vessel, completed by their mirror images."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

PORT_STARBOARD = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
SAME_HEADING = 1e-6  # rad
SYMMETRY_TOLERANCE = 0.02
LARGEST_HEADING_GAP = np.radians(45.0)  # above it nothing is interpolated


def mirrored_heading(heading: FloatArray) -> FloatArray:
    """``2 pi - heading`` within [0, 2 pi)."""
    turned = np.mod(-heading, 2.0 * np.pi)
    return np.asarray(np.where(turned >= 2.0 * np.pi, 0.0, turned))


def both_sides(heading: FloatArray) -> tuple[FloatArray, NDArray[np.intp], NDArray[np.bool_]]:
    """Headings (k,) with their mirror images, rising; where each is found in ``heading``; which are mirrored.

    A mirror image that is among the headings already is left out.
    """
    turned = mirrored_heading(heading)
    distance = np.abs(np.angle(np.exp(1j * (turned[:, None] - heading))))
    new = np.flatnonzero(distance.min(axis=1) > SAME_HEADING)
    every = np.concatenate([heading, turned[new]])
    source = np.concatenate([np.arange(len(heading)), new])
    mirrored = np.arange(len(every)) >= len(heading)
    order = np.argsort(every)
    return every[order], source[order], mirrored[order]


def largest_gap(circle: FloatArray) -> float:
    """Largest angle (rad) between neighbouring headings, across 2 pi too."""
    return float(np.diff(np.append(circle, circle[0] + 2.0 * np.pi)).max())


def keeps_sides_apart(added_mass: FloatArray) -> bool:
    """Whether motions that port-starboard symmetric hulls keep apart are apart in (n, 6 k, 6 k), to 2 %."""
    peak = np.sqrt(np.abs(np.diagonal(added_mass, axis1=1, axis2=2)).max(axis=0))
    scale = np.outer(peak, peak)
    sides = np.tile(PORT_STARBOARD, len(peak) // 6)
    mixed = np.outer(sides, sides) < 0.0
    largest = np.abs(added_mass).max(axis=0)
    return bool(np.all(largest[mixed] <= SYMMETRY_TOLERANCE * scale[mixed]))
