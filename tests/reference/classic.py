"""Classic motions in minimal coordinates or closed form, without constraint equations."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp
from scipy.special import ellipj

from .rotation import Array

RTOL, ATOL = 1e-12, 1e-13


def integrate(rate: Callable[[float, Array], Any], start: ArrayLike, times: ArrayLike) -> Array:
    """States (k, n) at the output times by DOP853 at tight tolerance, from t = 0."""
    t = np.asarray(times, dtype=float)
    solution = solve_ivp(
        rate, (0.0, float(t[-1])), np.asarray(start, dtype=float), "DOP853", t, rtol=RTOL, atol=ATOL,
        max_step=0.05
    )  # fmt: skip
    if not solution.success:
        raise RuntimeError(solution.message)
    return np.asarray(solution.y.T)


def spherical_pendulum(
    times: ArrayLike, position: ArrayLike, velocity: ArrayLike, gravity: float = 9.81
) -> tuple[Array, Array]:
    """Position and velocity (k, 3) of a point mass on a massless rod about the origin, z up.

    The rod's pull is eliminated by hand: x'' = g - (v.v + g.x) x / L^2. A compound body with isotropic
    inertia J that does not spin follows the same path with gravity scaled by m L^2 / (m L^2 + J).
    """
    x0 = np.asarray(position, dtype=float)
    g = np.array([0.0, 0.0, -gravity])
    square = float(x0 @ x0)

    def rate(_: float, y: Array) -> Array:
        x, v = y[:3], y[3:]
        return np.concatenate([v, g - (v @ v + g @ x) / square * x])

    y = integrate(rate, np.concatenate([x0, np.asarray(velocity, dtype=float)]), times)
    return y[:, :3], y[:, 3:]


@dataclass(frozen=True)
class Link:
    """Planar link: `inertia` about its centre of mass, `center` along it from its pivot."""

    mass: float
    inertia: float
    length: float
    center: float


def free_rotation(times: ArrayLike, inertia: Sequence[float], rates: Sequence[float]) -> Array:
    """Body rates (k, 3) of a free body, I1 > I2 > I3, started at (w1, 0, w3) with w1, w3 > 0.

    Landau & Lifshitz, Mechanics, section 37; the sign of 2 T I2 - L^2 decides which of w1 and w3 reverses.
    """
    i1, i2, i3 = inertia
    w1, _, w3 = rates
    t = np.asarray(times, dtype=float)
    # w1' = k1 w2 w3, w2' = -k2 w1 w3, w3' = k3 w1 w2
    k1, k2, k3 = (i2 - i3) / i1, (i1 - i3) / i2, (i1 - i2) / i3
    if k3 * w1 * w1 <= k1 * w3 * w3:  # w1 reverses, w3 does not
        sn, cn, dn, _ = ellipj(math.sqrt(k1 * k2) * w3 * t, k3 * w1 * w1 / (k1 * w3 * w3))
        return np.stack([w1 * cn, -math.sqrt(k2 / k1) * w1 * sn, w3 * dn], axis=1)
    sn, cn, dn, _ = ellipj(math.sqrt(k2 * k3) * w1 * t, k1 * w3 * w3 / (k3 * w1 * w1))
    return np.stack([w1 * dn, -math.sqrt(k2 / k3) * w3 * sn, w3 * cn], axis=1)
