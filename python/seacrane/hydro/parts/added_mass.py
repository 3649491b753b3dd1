"""Added mass over depth at infinite frequency: of a circle in closed form, of plates and boxes by tables.

A depth is that of the lowest point below a level surface on which the pressure of the motion is zero: what
a fast motion sees. Added mass grows with depth, also below the surface, up to that of an unbounded fluid.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array

CIRCLE_SOURCE = (
    "Greenhow and Li 1987 to awash, images in the free surface below it, in the plane of each circle; "
    "ends: one side of a disc"
)
PLATE_SOURCE = "DNV-RP-N103 (plate, height; unverified), half of it where one side is wet"
SPHERE_SOURCE = (
    "von Karman's disc, Hulme 1982 at half depth (C_A 0.5), first image below; between: unverified"
)
PLATES = ((1.0, 0.579), (0.5, 0.757), (0.25, 0.872), (0.1, 0.947), (0.0, 1.0))  # short side over long, factor
ROUNDING = 0.25  # of the depth of a ramp, over which its end is rounded to either side
RAMP_KNOTS = 40
SETTLED = 0.1  # radii, over which wetting faster than that of a level surface goes over into it
DEEPEST_CIRCLE = 40.0  # radii, at which the added mass is that of an unbounded fluid: 1 - 1/3042 of it before


def circle_added_mass(depth: ArrayLike) -> Array:
    """Added mass of a circle that moves across the surface, over density times radius squared.

    Parameters
    ----------
    depth : array_like
        Of its lowest point, over its radius: 0 where it touches, 1 half, 2 where its crown is awash.

    Returns
    -------
    ndarray
        pi/2 at 1, pi^3/6 - pi at 2, pi at infinity.

    Notes
    -----
    Up to the crown M. Greenhow, Y. Li, Ocean Eng. 14 (1987) 325, with depth = 1 - cos(theta/2):
    1/2 (2 pi^3 (1 - cos theta) / (3 (2 pi - theta)^2) + pi/3 (1 - cos theta) + sin theta - theta). Below it
    a dipole with its images in a surface without pressure, cosh a = depth - 1:
    pi (1 + 2 sum (-1)^n sinh^2 a / sinh^2 (n + 1) a), n from 1. Value and slope of both agree at the crown.
    """
    given = np.asarray(depth, dtype=float)
    out = np.zeros_like(given)
    wet = (given > 0.0) & (given < 2.0)
    theta = 2.0 * np.arccos(1.0 - given[wet])
    left = 2.0 * np.pi - theta
    flat = 1.0 - np.cos(theta)
    out[wet] = 0.5 * (2.0 * np.pi**3 * flat / (3.0 * left**2) + np.pi / 3.0 * flat + np.sin(theta) - theta)
    out[given >= 2.0] = [_submerged(one) for one in given[given >= 2.0]]
    return out


def _submerged(depth: float) -> float:
    a = float(np.arccosh(depth - 1.0))
    if a < 1e-6:
        return float(np.pi**3 / 6.0 - np.pi)
    n = np.arange(1, int(40.0 / a) + 2)
    decay = np.exp(-n * a)
    images = (1.0 - np.exp(-2.0 * a)) ** 2 * decay**2 / (1.0 - decay**2 * np.exp(-2.0 * a)) ** 2
    return float(np.pi * (1.0 + 2.0 * np.sum((-1.0) ** n * images)))


def circle_table() -> tuple[Array, Array]:
    """Depths over the radius, and added mass over density times radius squared, for a spline through them."""
    above = 1.0 - np.cos(np.linspace(0.0, np.pi, 257))
    below = 1.0 + np.cosh(np.arange(0.1, 3.7, 0.1))
    depths = np.concatenate([above[:-1], [2.0], below, [DEEPEST_CIRCLE]])
    values = circle_added_mass(depths)
    values[-1] = np.pi
    return depths, values


def wetted_at(shares: Array, faster: float) -> Array:
    """Depths at which a circle has the added mass that it has by itself at `shares`, radii: as if the first
    of its depth were wetted `faster` times as deep."""
    if faster == 1.0:
        return shares
    more = (faster - 1.0) * SETTLED
    out = np.array(shares)
    for _ in range(60):  # Newton's method for h + more (1 - exp(-h / SETTLED)) = share
        left = out + more * (1.0 - np.exp(-out / SETTLED)) - shares
        out -= left / (1.0 + (faster - 1.0) * np.exp(-out / SETTLED))
    out[0] = 0.0
    return np.asarray(out)


def disc_added_mass(radius: float) -> float:
    """Added mass of one side of a disc along its axis, over the density, m3: 4/3 radius^3 (H. Lamb,
    Hydrodynamics, art. 102: 8/3 of both)."""
    return 4.0 / 3.0 * radius**3


def ring_added_mass(radius: float, wall: float) -> float:
    """Of one side of a ring of outer radius and width (m), along its axis, over the density, m3: that of a
    flat strip, pi/8 wall^2 for each metre, along the ring's mean circle, for thin walls."""
    return np.pi / 8.0 * wall**2 * 2.0 * np.pi * (radius - 0.5 * wall)


def disc_share(depth: Array) -> Array:
    """Share of a disc on its edge that is wet, with its lowest point at a depth, in radii."""
    x = np.clip(depth - 1.0, -1.0, 1.0)
    return np.asarray(0.5 + (x * np.sqrt(1.0 - x**2) + np.arcsin(x)) / np.pi)


def plate_factor(short_over_long: float) -> float:
    """Added mass of a thin rectangular plate across itself, over density pi/4 short^2 long; linear between
    the values of DNV-RP-N103, table A-2 (as quoted by others; unverified)."""
    shares, factors = zip(*sorted(PLATES), strict=True)
    return float(np.interp(short_over_long, shares, factors))


def perforation_factor(share: float) -> float:
    """What holes leave of the added mass of a plate or a box.

    Parameters
    ----------
    share : float
        Of the area, 0 to 0.5.

    Notes
    -----
    DNV-RP-N103 (unverified): 1 up to 5 %, 0.7 + 0.3 cos(pi (p - 5)/34) to 34 %, exp((10 - p)/28) to 50 %.
    Both differ by 1.7 % where they meet; a cubic step from 32 to 36 % leads from one to the other.
    """
    p = 100.0 * share
    near = 1.0 if p <= 5.0 else 0.7 + 0.3 * np.cos(np.pi * (p - 5.0) / 34.0)
    s = float(np.clip((p - 32.0) / 4.0, 0.0, 1.0))
    step = s * s * (3.0 - 2.0 * s)
    return float((1.0 - step) * near + step * np.exp((10.0 - p) / 28.0))


def ramp(depth: Array, length: float) -> Array:
    """From 0 to 1: straight over a length, its end rounded so that the slope never exceeds 1 / length."""
    x = depth / length
    s = np.clip((x - (1.0 - ROUNDING)) / (2.0 * ROUNDING), 0.0, 1.0)
    lost = 2.0 * ROUNDING * (s**4 * (2.5 + s * (s - 3.0)))  # integral of s^3 (10 - 15 s + 6 s^2)
    lost += np.maximum(x - (1.0 + ROUNDING), 0.0)
    return np.asarray(x - lost)


def step(depth: Array, start: float, length: float) -> Array:
    """From 0 to 1 over a length, with two continuous derivatives."""
    s = np.clip((depth - start) / length, 0.0, 1.0)
    return np.asarray(s**3 * (10.0 + s * (6.0 * s - 15.0)))


def box_deep(size: Array) -> Array:
    """Added mass of a box along its axes in an unbounded fluid, over the density, m3.

    That of the plate of its face, of area A, times 1 + sqrt((1 - l^2) / (2 (1 + l^2))) with
    l = sqrt(A) / (height + sqrt(A)), height along the axis (DNV-RP-N103, 4.6.3.3, unverified; within 4 % of
    its values for square prisms).
    """
    out = np.zeros(3)
    for i in range(3):
        short, long = sorted(np.delete(size, i))
        if short == 0.0:
            continue
        root = np.sqrt(short * long)
        share = root / (size[i] + root)
        tall = 1.0 + np.sqrt((1.0 - share**2) / (2.0 * (1.0 + share**2)))
        out[i] = tall * plate_factor(short / long) * np.pi / 4.0 * short**2 * long
    return out


def box_growth(size: Array, deep: Array, *, density: float, holes: float, slam: float) -> tuple[Array, Array]:
    """Depths (n,), m, and the added masses (n, 3), kg, of a box at them, up to those far below (3,), kg.

    `holes`: what they leave of the added mass; `slam`: C_S of its bottom, by which the first part is gained.
    """
    area, height = size[0] * size[1], size[2]
    short, long = sorted(size[:2])
    plate = density * plate_factor(short / long if long else 1.0) * np.pi / 4.0 * short**2 * long
    bottom = min(0.5 * holes * plate, deep[2])
    over = 2.0 * bottom / (density * slam * area) if area else 0.0
    root = float(np.sqrt(area)) or float(np.max(size))
    over = over or 1e-3 * root
    awash, sides, end = max(height, (1.0 + ROUNDING) * over), max(height, over), 1.0 + ROUNDING
    smooth = [(0.0, end * over), (0.0, end * sides), (awash, awash + root)]  # over each of them
    depths = np.unique(np.round(np.concatenate([np.linspace(*one, RAMP_KNOTS + 1) for one in smooth]), 12))
    upright = bottom * ramp(depths, over) + (deep[2] - bottom) * step(depths, awash, root)
    along = ramp(depths, sides)
    return depths, np.stack([deep[0] * along, deep[1] * along, upright], axis=1)


def sphere_table(*, slow: bool = False) -> tuple[Array, Array]:
    """Depths over the radius, and added mass of a sphere over that in an unbounded fluid, for a spline.

    Up to its centre a rational function of the depth that begins as von Karman's disc, of the radius that
    is wet, and ends at half; from awash on 1 - 3/8 (radius / depth of the centre)^3, one image (H. Lamb,
    Hydrodynamics, art. 138, with the sign of a free surface). Monotone between them.

    `slow` is the same at zero frequency, where the surface is a wall: it begins as a piston in it, twice the
    disc (Rayleigh, Theory of Sound, art. 302), has 0.8310 at half depth (Hulme 1982), and the image the other
    sign.
    """
    from scipy.interpolate import PchipInterpolator

    touch, half, image = (2.0, 0.8310, 1.0) if slow else (1.0, 0.5, -1.0)
    shallow = np.linspace(0.0, 1.0, 41) ** 2
    bend = touch * 2.0**2.5 / (np.pi * half) - 1.0
    disc = touch * 2.0 / np.pi * (2.0 * shallow) ** 1.5 / (1.0 + bend * shallow)
    deep = 2.0 + 0.25 * np.arange(33) ** 1.25
    below = 1.0 + image * 0.375 / (deep - 1.0) ** 3
    depths = np.concatenate([shallow, np.linspace(1.0, 2.0, 11)[1:-1], deep, [2.0 * deep[-1]]])
    known = np.concatenate([shallow, deep, [2.0 * deep[-1]]])
    values = PchipInterpolator(known, np.concatenate([disc, below, [1.0]]))(depths)
    return depths, np.asarray(values)
