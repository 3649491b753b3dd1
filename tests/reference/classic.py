"""Classic mechanisms in minimal coordinates or closed form, to check a constrained solver against.

None of these uses constraint equations: pendulums are ordinary differential equations, slider-crank and
four-bar have one coordinate whose kinematics are differentiated exactly (`jets`), free rotation is solved
by elliptic functions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .rotation import Array

RTOL, ATOL = 1e-12, 1e-13


def integrate(rate: Callable[[float, Array], Any], start: ArrayLike, times: ArrayLike) -> Array:
    """States (k, n) at the output times by DOP853 at tight tolerance, from t = 0."""
    from scipy.integrate import solve_ivp

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
    """Planar link: mass, inertia about its centre of mass, length, and centre of mass along it from its
    pivot.
    """

    mass: float
    inertia: float
    length: float
    center: float


def double_pendulum(
    times: ArrayLike, links: Sequence[Link], angles: ArrayLike, rates: ArrayLike, gravity: float = 9.81
) -> tuple[Array, Array]:
    """Angles and rates (k, 2) of two links from the downward vertical (Lagrange's equations)."""
    a, b = links
    m11 = a.inertia + a.mass * a.center**2 + b.mass * a.length**2
    m22 = b.inertia + b.mass * b.center**2
    coupling = b.mass * a.length * b.center

    def rate(_: float, y: Array) -> list[float]:
        p, q, dp, dq = y
        c, s = coupling * math.cos(p - q), coupling * math.sin(p - q)
        f1 = -s * dq * dq - gravity * (a.mass * a.center + b.mass * a.length) * math.sin(p)
        f2 = s * dp * dp - gravity * b.mass * b.center * math.sin(q)
        determinant = m11 * m22 - c * c
        return [dp, dq, (f1 * m22 - f2 * c) / determinant, (f2 * m11 - f1 * c) / determinant]

    start = np.concatenate([np.asarray(angles, dtype=float), np.asarray(rates, dtype=float)])
    y = integrate(rate, start, times)
    return y[:, :2], y[:, 2:]


def free_rotation(times: ArrayLike, inertia: Sequence[float], rates: Sequence[float]) -> Array:
    """Body rates (k, 3) of a free body, started at (w1, 0, w3) with w1, w3 > 0, by Jacobi's elliptic
    functions.

    Principal moments I1 > I2 > I3 (2 the intermediate axis). Landau & Lifshitz, Mechanics, section 37; the
    sign of 2 T I2 - L^2 decides which of w1 and w3 reverses.
    """
    from scipy.special import ellipj

    i1, i2, i3 = inertia
    w1, w2, w3 = rates
    if not (i1 > i2 > i3 > 0.0 and w1 > 0.0 and w3 > 0.0 and w2 == 0.0):
        raise ValueError(
            f"free_rotation needs I1 > I2 > I3 > 0 and rates (w1 > 0, 0, w3 > 0), not {inertia}, {rates}"
        )
    t = np.asarray(times, dtype=float)
    # w1' = k1 w2 w3, w2' = -k2 w1 w3, w3' = k3 w1 w2
    k1, k2, k3 = (i2 - i3) / i1, (i1 - i3) / i2, (i1 - i2) / i3
    if k3 * w1 * w1 <= k1 * w3 * w3:  # w1 reverses, w3 does not
        sn, cn, dn, _ = ellipj(math.sqrt(k1 * k2) * w3 * t, k3 * w1 * w1 / (k1 * w3 * w3))
        return np.stack([w1 * cn, -math.sqrt(k2 / k1) * w1 * sn, w3 * dn], axis=1)
    sn, cn, dn, _ = ellipj(math.sqrt(k2 * k3) * w1 * t, k1 * w3 * w3 / (k3 * w1 * w1))
    return np.stack([w1 * dn, -math.sqrt(k2 / k3) * w3 * sn, w3 * cn], axis=1)
