"""Direct evaluation of the memory integral, equation (28) of the paper."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .rotation import Array

# Gregory's end corrections of the trapezoidal rule, exact for cubics (error of order h^4 and better)
GREGORY = np.array([3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0])


def memory_force(velocity: ArrayLike, kernel: ArrayLike, step: float) -> Array:
    """mu(t_i) = integral_0^t_i K(t_i - tau) u(tau) dtau (k, 6) of samples of u (k, 6) and K (k, 6, 6).

    Trapezoidal sum with Gregory end corrections (fourth order) once six samples are in reach, plain before.
    """
    u, k = np.asarray(velocity, dtype=float), np.asarray(kernel, dtype=float)
    out = np.zeros_like(u)
    for i in range(1, len(u)):
        weight = np.ones(i + 1)
        if i >= 5:
            weight[:3], weight[-3:] = GREGORY, GREGORY[::-1]
        else:
            weight[0] = weight[-1] = 0.5
        out[i] = step * np.einsum("n,njk,nk->j", weight, k[: i + 1], u[i::-1])
    return out
