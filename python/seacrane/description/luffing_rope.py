"""The rope that holds a luffing hinge: its blocks, and the tension that a moment about the hinge takes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Vector = tuple[float, float, float]
Block = tuple[str, Vector]


@dataclass(frozen=True, kw_only=True)
class LuffingRope:
    """A rope of several falls between blocks on both sides of a hinge.

    Attributes
    ----------
    name : Of the line that stands for it once it is one, see `Scene.add_luffing_rope`.
    falls : Parts of rope between the blocks; all carry the same tension.
    EA : Axial stiffness of one fall, N.
    first, second : (str, (float, float, float))
        Body and point in its coordinates, m; the second one moves with the hinge.
    """

    name: str
    falls: int
    EA: float
    first: Block
    second: Block


def lengthening(hinge: Array, axis: Array, first: Array, second: Array) -> float:
    """Rate of the distance between the blocks per rate of the hinge's angle, m/rad.

    Parameters
    ----------
    hinge, axis, first, second : ndarray, shape (3,)
        A point of the hinge, its unit vector, and both blocks; one frame, m.
    """
    along = (second - first) / np.linalg.norm(second - first)
    return float(along @ np.cross(axis, second - hinge))
