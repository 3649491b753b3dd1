"""Points around half sections: even between the knuckles, which are kept."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.hull.panels import along, fractions

FloatArray = NDArray[np.float64]

KNUCKLE = np.radians(15.0)  # by which an outline turns at a corner; a round bilge turns less at each point
LEAST_PART = 1e-6  # of a section's length between two corners


def around(sections: Sequence[FloatArray], count: int) -> list[FloatArray]:
    """Every half section (p, 2) with ``count`` pieces: corners stay corners, points between them are even.

    Where sections have equally many corners, one corner is the same point of each, so that a chine stays one
    line of the mesh. A section of another kind, such as a stem, has even points where its corners are not.
    """
    corners = [knuckles(section) for section in sections]
    usual = _usual_number(corners)
    lengths = np.mean([np.diff([0.0, *c, 1.0]) for c in corners if len(c) == usual], axis=0)
    shares = _shared_out(lengths, count) if usual < count else np.array([count])
    made = []
    for section, own in zip(sections, corners, strict=True):
        if len(own) == usual and usual < count:
            at = _between([0.0, *own, 1.0], shares)
        else:
            at = _snapped(np.linspace(0.0, 1.0, count + 1), own)
        made.append(along(section, at))
    return made


def knuckles(section: FloatArray) -> FloatArray:
    """Shares of a half section's length at which it has a corner."""
    at = fractions(section)
    keep = np.append(True, np.diff(at) > LEAST_PART)
    at, points = at[keep], section[keep]
    if len(points) < 3:
        return np.zeros(0)
    direction = np.arctan2(*np.diff(points, axis=0).T[::-1])
    turn = np.abs(np.angle(np.exp(1j * np.diff(direction))))
    return np.asarray(at[1:-1][turn > KNUCKLE])


def _usual_number(corners: Sequence[FloatArray]) -> int:
    """How many corners most sections have."""
    number, times = np.unique([len(c) for c in corners], return_counts=True)
    return int(number[times.argmax()])


def _shared_out(lengths: FloatArray, count: int) -> NDArray[np.intp]:
    """Pieces for each part, at least one, in proportion to its length."""
    pieces = np.ones(len(lengths), dtype=np.intp)
    for _ in range(count - len(lengths)):
        pieces[np.argmax(lengths / pieces)] += 1
    return pieces


def _between(corners: Sequence[float], pieces: NDArray[np.intp]) -> FloatArray:
    parts = [np.linspace(corners[i], corners[i + 1], n + 1)[bool(i) :] for i, n in enumerate(pieces.tolist())]
    return np.concatenate(parts)


def _snapped(even: FloatArray, corners: FloatArray) -> FloatArray:
    """Even shares, the nearest of which moves to each corner."""
    at = even.copy()
    free = np.ones(len(at), dtype=bool)
    free[[0, -1]] = False
    for corner in corners:
        if not free.any():
            break
        nearest = int(np.argmin(np.where(free, np.abs(at - corner), np.inf)))
        at[nearest], free[nearest] = corner, False
    return np.sort(at)
