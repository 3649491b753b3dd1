"""`section_eddy_damping`: roll damping by eddies of one section, by Ikeda's own method."""

from __future__ import annotations

import math

import numpy as np

from seacrane.errors import SceneError
from seacrane.inputs.checked import not_negative_of, number_of, positive_of

FULLEST, DEEPEST = 1.0, 1.0  # area coefficient; depth of the roll axis over the draught, which it stays below


def section_eddy_damping(
    *,
    breadth: float,
    draught: float,
    area_coefficient: float,
    amplitude_deg: float,
    omega: float,
    axis_height: float = 0.0,
    bilge_radius: float | None = None,
    rho: float = 1025.0,
) -> float:
    """Eddies of a naked section that rolls without speed, as linear damping of the same work per period.

    The section counts as the Lewis form of its breadth, draught and area. Integrated over the length of a
    ship this is what the simple formulas of `ikeda_roll_damping` were fitted to, and it has none of their
    ranges. docs/measurements.md compares it with sections in a tank.

    Parameters
    ----------
    breadth, draught : float
        At the waterline, m.
    area_coefficient : float
        Area over breadth times draught, up to 1.
    amplitude_deg : float
        Of roll, deg.
    omega : float
        Of roll, rad/s.
    axis_height : float
        Of the roll axis above the waterline, m.
    bilge_radius : float, optional
        m. Default: the one that gives the area, at most the draught or half of the breadth.
    rho : float
        kg/m3.

    Returns
    -------
    float
        N m s/rad for each metre of length.

    Raises
    ------
    SceneError
        A size that is not positive, an area that no Lewis form has, a roll axis below the keel.

    Notes
    -----
    B = 4 rho d^4 w phi C_r / (3 pi); Y. Ikeda, On eddy making component of roll damping force on naked hull,
    J. SNAJ 142 (1978), in the form of ITTC 7.5-02-07-04.5 (2011), 2.2.4. Neither was at hand: the equations
    agree with a public program but for the brackets of gamma, where the measured sections decided.
    """
    sizes = {"breadth": breadth, "draught": draught, "area_coefficient": area_coefficient}
    sizes |= {"amplitude_deg": amplitude_deg, "omega": omega, "rho": rho}
    for name, value in sizes.items():
        positive_of(f"section eddies: {name}", value)
    if bilge_radius is not None:
        not_negative_of("section eddies: bilge_radius", bilge_radius)
    depth = -number_of("section eddies: axis_height", axis_height) / draught
    if area_coefficient > FULLEST or not depth < DEEPEST:
        raise SceneError(
            f"section eddies: area_coefficient is {area_coefficient:.4g} and the roll axis {depth:.4g} "
            "draughts below the waterline; give an area of at most 1 and an axis above the keel"
        )
    half = 0.5 * breadth / draught
    two_arcs = 2.0 * math.sqrt(half * (1.0 - area_coefficient) / (4.0 - math.pi))  # which give the area
    radius = min(two_arcs, 1.0, half) if bilge_radius is None else bilge_radius / draught
    coefficient = eddy_coefficient(half=half, area=area_coefficient, depth=depth, radius=radius)
    swing = omega * np.radians(amplitude_deg)
    return float(4.0 / (3.0 * np.pi) * rho * draught**4 * swing * coefficient)


def eddy_coefficient(*, half: float, area: float, depth: float, radius: float) -> float:
    """C_r of a section with its ``area`` coefficient; over the draught: ``half`` of its breadth, ``depth`` of
    the roll axis, bilge ``radius``."""
    reach, speed = _fastest(half, area)
    fullness = 1.0 + 4.0 * np.exp(-1.65e5 * (1.0 - area) ** 2)
    below = (half / (1.0 - depth)) * (area - depth) / (1.0 - depth)
    if below <= 0.0:
        raise SceneError(
            f"section eddies: the roll axis is {depth:.4g} draughts below the waterline, where a section of "
            f"the area coefficient {area:.4g} has no area below it; raise the axis"
        )
    gamma = np.sqrt(np.pi) * fullness / (2.0 * (1.0 - depth) * np.sqrt(below)) * (reach + speed)
    pressure = 0.5 * (0.87 * np.exp(-gamma) - 4.0 * np.exp(-0.187 * gamma) + 3.0)
    f1 = 0.5 * (1.0 + np.tanh(20.0 * (area - 0.7)))
    f2 = 0.5 * (1.0 - np.cos(np.pi * area))
    f2 -= 1.5 * (1.0 - np.exp(-5.0 * (1.0 - area))) * np.sin(np.pi * area) ** 2
    lever = (1.0 - f1 * radius) * (1.0 - depth - f1 * radius) + f2 * (half - f1 * radius) ** 2
    return float(lever * pressure * reach**2)


def _fastest(half: float, area: float) -> tuple[float, float]:
    """Over the draught: the largest radius of a Lewis form, and the potential flow there over the rate of
    roll."""
    slim = (half - 1.0) / (half + 1.0)
    d = 3.0 + 4.0 * area / np.pi + (1.0 - 4.0 * area / np.pi) * slim**2
    if d > 4.5:
        raise SceneError(
            f"section eddies: no Lewis form has the area coefficient {area:.4g} with B/2T {half:.4g}"
        )
    a3 = (3.0 - d + np.sqrt(9.0 - 2.0 * d)) / d
    a1 = (1.0 + a3) * slim
    scale = half / (1.0 + a1 + a3)
    turn = 0.5 * np.arccos(np.clip(a1 * (1.0 + a3) / (4.0 * a3), -1.0, 1.0)) if a3 else 0.0

    def radius(psi: float) -> float:
        across = (1.0 + a1) * np.sin(psi) - a3 * np.sin(3.0 * psi)
        down = (1.0 - a1) * np.cos(psi) + a3 * np.cos(3.0 * psi)
        return float(scale * np.hypot(across, down))

    psi = max((0.0, turn), key=radius)
    stretch = 1.0 + a1**2 + 9.0 * a3**2 + 2.0 * a1 * (1.0 - 3.0 * a3) * np.cos(2.0 * psi)
    stretch -= 6.0 * a3 * np.cos(4.0 * psi)
    even, odd = 6.0 * a3**2 + a1**2 * (1.0 + a3), 3.0 * a1 * a3 * (1.0 + a3)
    down = a1 * (1.0 - a3) * np.cos(3.0 * psi) + (even - odd) * np.cos(psi) - 2.0 * a3 * np.cos(5.0 * psi)
    across = a1 * (1.0 - a3) * np.sin(3.0 * psi) + (even + odd) * np.sin(psi) - 2.0 * a3 * np.sin(5.0 * psi)
    return radius(psi), float(2.0 * scale / stretch * np.hypot(down, across))
