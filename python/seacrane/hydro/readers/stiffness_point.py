"""About which point a stiffness is that its file gives without saying so, and the stiffness elsewhere."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.database.transform import motion_transform

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
SAME_POINT = 1e-6  # m
NEAR = 0.1  # of the distance of both points: the waves have told which


def stiffness_about(
    centre: FloatArray,
    stiffness: FloatArray,
    *,
    gravity: FloatArray,
    lift: ComplexArray,
    usual: Literal["centre of gravity", "rotation centre"],
) -> FloatArray:
    """A floating body's stiffness (6, 6) about ``centre``.

    The file gives it about its centre of gravity or about ``centre``; heights make no difference. A long wave
    lifts the body at its centre of flotation, which tells which of both.

    Parameters
    ----------
    centre, gravity : (3,) m, in one frame.
    lift : (m, 6) wave forces of the lowest frequency, about ``centre``.
    usual : what is taken where the waves do not tell.
    """
    away = np.array([centre[0] - gravity[0], centre[1] - gravity[1], 0.0])
    if np.abs(away).max() <= SAME_POINT or stiffness[2, 2] == 0.0:
        return stiffness
    transform = motion_transform(away)
    moved = np.asarray(transform.T @ stiffness @ transform)
    size = float(np.sum(np.abs(lift[:, 2]) ** 2))
    moments = np.sum(lift[:, [4, 3]] * np.conj(lift[:, 2:3]), axis=0).real * (-1.0, 1.0)
    seen = moments / size if size > 0.0 else np.zeros(2)
    flotation = [np.array([-one[2, 4], one[2, 3]]) / one[2, 2] for one in (moved, stiffness)]
    apart = [float(np.hypot(*(seen - point))) for point in flotation]
    told = size > 0.0 and abs(apart[0] - apart[1]) > NEAR * float(np.hypot(*away[:2]))
    return moved if (apart[0] < apart[1] if told else usual == "centre of gravity") else stiffness
