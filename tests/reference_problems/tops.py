"""Bodies that turn freely about a point: the heavy top, and the wing nut of Dzhanibekov.

Heavy top: data of Bruels, Cardona and Arnold (Mechanism and Machine Theory 48, 2012). The cosine u of its
nutation angle is an elliptic function, (u')^2 = a cubic of u, and its precession the integral of
(p - s u) / (I (1 - u^2)).
`PUBLISHED` is the place after 2 s in the verification tests of Kynema (github.com/kynema/kynema,
dynamic_heavy_top.cpp), computed there by those authors' second-order method in steps of 2e-6 s. Wing nut:
Euler's equations near the intermediate axis, by elliptic functions (`reference.classic`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from reference.classic import free_rotation
from scipy.special import ellipj, ellipk, elliprf, elliprj

from seacrane import Scene
from seacrane.arrays import Array

GRAVITY, MASS = 9.81, 15.0
INERTIA = np.array([0.234375, 0.46875, 0.234375])  # about the centre, 1 m from the tip along body y
RATE = np.array([0.0, 150.0, -4.61538])  # rad/s, body axes, the top's axis level at the start
PUBLISHED = np.array([-0.150416985652933, 1.0 - 1.724164450779749, -0.673023460701136])
WING = (3.0, 2.0, 1.0)  # kg m2
# At the start, 1e-3 beside those whose motion would end on the intermediate axis and never flip.
WING_RATES = (
    np.sqrt(WING[2] * (WING[1] - WING[2]) / (WING[0] * (WING[0] - WING[1]))) * (1.0 + 1e-3), 0.0, 1.0
)  # fmt: skip


def scene() -> Scene:
    out, state = Scene(name="heavy top", gravity=GRAVITY), {"angular_velocity": RATE}
    out.add_body(name="top", mass=MASS, inertia=INERTIA, center_of_mass=(0.0, 1.0, 0.0), **state)
    out.add_joint(kind="spherical", name="tip", first="ground", second="top", point=(0, 0, 0))
    return out


def nutation() -> tuple[float, float, float]:
    """How far above -1 the lowest u is, parameter m and argument per second of the elliptic functions.

    Level and without nutation at the start: 0 is a root of (u')^2 = (1 - u^2)(p^2 - beta u) - (p - s u)^2,
    momenta in units of the transverse inertia about the tip. The other two are -1 + d with (p + s)^2 - (2
    beta + p^2 + s^2) d + beta d^2 = 0, and one above 1; u moves between -1 + d and 0.
    """
    p, s, beta = momenta()
    middle = 2.0 * beta + p * p + s * s
    above = 2.0 * (p + s) ** 2 / (middle + np.sqrt(middle**2 - 4.0 * beta * (p + s) ** 2))
    low = above - 1.0
    high = (p * p + s * s) / beta - low
    return above, -low / (high - low), 0.5 * np.sqrt(beta * (high - low))


def momenta() -> tuple[float, float, float]:
    """About the vertical and the top's axis, and twice the weight's moment, over the transverse inertia."""
    across = INERTIA[0] + MASS
    return RATE[2], INERTIA[1] * RATE[1] / across, 2.0 * MASS * GRAVITY / across


def third_kind(n: float, amplitude: Array, m: float) -> Array:
    """Legendre's incomplete elliptic integral Pi(n; amplitude | m), by Carlson's forms and whole periods."""

    def within(angle: Array) -> Array:
        s, c = np.sin(angle), np.cos(angle)
        rest, last = 1.0 - m * s * s, np.ones_like(s)
        # Carlson's forms are homogeneous: arguments times sin^2, so that an amplitude of 0 is no exception.
        return np.asarray(
            s * elliprf(c * c, rest, last) + n / 3.0 * s**3 * elliprj(c * c, rest, last, 1.0 - n * s * s)
        )

    turns = np.round(amplitude / np.pi)
    return np.asarray(within(amplitude - np.pi * turns) + 2.0 * turns * within(np.array(0.5 * np.pi)))


def center(times: ArrayLike) -> Array:
    """Place of the top's centre (k, 3): u = low cn^2, and its precession by integrals of the third kind.

    Hardly any momentum about the downward vertical is left here: the top swings through it, and its
    precession jumps by nearly pi, which quadrature of p - s u over 1 - u^2 would miss.
    """
    above, m, speed = nutation()
    low = above - 1.0
    p, s, _ = momenta()
    sn, cn, _, amplitude = ellipj(ellipk(m) + speed * np.asarray(times, dtype=float), m)
    u, angle = low * cn**2, np.zeros_like(sn)
    for side, share in ((1.0, p - s), (-1.0, p + s)):  # of 1 / (1 - u) and of 1 / (1 + u)
        edge = 1.0 - low if side > 0.0 else above
        n = -side * low / edge
        integral = third_kind(n, amplitude, m) - third_kind(n, amplitude[:1], m)
        angle += 0.5 * share * integral / (edge * speed)
    level = np.sqrt(1.0 - u * u)
    return np.column_stack([-level * np.sin(angle), level * np.cos(angle), u])


def wing_nut() -> Scene:
    out = Scene(name="wing nut", gravity=0.0)
    out.add_body(name="nut", mass=1.0, inertia=WING, angular_velocity=WING_RATES)
    return out


def wing(times: ArrayLike) -> Array:
    """Body rates (k, 3)."""
    return free_rotation(times, WING, WING_RATES)
