"""Components of roll damping by Ikeda's method, as functions of ratios.

The eddy and bilge keel components are the simple formulas of Kawahara, Maekawa and Ikeda (2009), fitted to
Ikeda's method over systematically varied hulls.
"""

from __future__ import annotations

import numpy as np


def friction(
    *, radius: float, surface: float, amplitude: float, omega: float, rho: float, viscosity: float
) -> float:
    """Friction without speed, N m s/rad: laminar (Kato 1957), and turbulent (Hughes) beside it.

    ``radius`` (m) is the mean one of the ``surface`` (m2), ``amplitude`` in rad. ITTC 7.5-02-07-04.5, 2.2.3:
    B = (4 / 3 pi) rho S r^3 phi w Cf, Cf = 1.328 Re^-0.5 + 0.014 Re^-0.114, Re = 3.22 (r phi)^2 / (T nu).
    """
    reynolds = 3.22 * (radius * amplitude) ** 2 * omega / (2.0 * np.pi * viscosity)
    coefficient = 1.328 * reynolds**-0.5 + 0.014 * reynolds**-0.114
    return float(4.0 / (3.0 * np.pi) * rho * surface * radius**3 * amplitude * omega * coefficient)


def eddy(*, cb: float, cm: float, bd: float, og: float, amplitude: float, frequency: float) -> float:
    """Eddies of the naked hull, without dimensions; ``amplitude`` in rad."""
    size = (-0.0182 * cb + 0.0155) * (bd - 1.8) ** 3 + np.polyval(
        [-79.414, 215.695, -215.883, 93.894, -14.848], cb
    )
    height = (3.98 * cb - 5.1525) * (-0.2 * bd + 1.6) * og
    height *= (0.9717 * cb**2 - 1.55 * cb + 0.723) * og + 0.04567 * cb + 0.9408
    fullness = (0.25 * og + 0.95) * og + np.polyval([-219.2, 443.7, -283.3, 59.6], cb)
    power = -15.0 * cb * bd + 46.5 * cb + 11.2 * bd - 28.6
    pressure = size * np.exp(height + fullness * cm**power)
    return float(4.0 * frequency * amplitude / (3.0 * np.pi * cb * bd**3) * pressure)


def bilge_keels(
    *,
    cb: float,
    cm: float,
    bd: float,
    og: float,
    breadth: float,
    length: float,
    amplitude: float,
    frequency: float,
) -> float:
    """Bilge keels of both sides, their pressure on the hull included, without dimensions.

    ``breadth`` and ``length`` are shares of the ship's. The formula counts the amplitude in degrees.
    """
    degrees = np.degrees(amplitude)
    hull = (-0.3651 * cb + 0.3907) * (bd - 2.83) ** 2 - 2.21 * cb + 2.632
    swing = np.polyval([0.00255, 0.122, 0.4794], degrees)
    keel = (-0.8913 * breadth**2 - 0.0733 * breadth) * length**2
    keel += (5.2857 * breadth**2 - 0.01185 * breadth + 0.00189) * length
    height = 5.0 * breadth + 0.3 * bd - 0.2 * length + 0.00125 * degrees**2 - 0.0425 * degrees - 1.86
    fullness = -15.0 * breadth + 1.2 * cb - 0.1 * bd - 0.0657 * og**2 + 0.0586 * og + 1.6164
    return float(hull * swing * keel * np.exp(height * og + fullness * cm ** (2.5 * og + 15.75)) * frequency)


def lift(*, length: float, draught: float, speed: float, og: float, slope: float, rho: float) -> float:
    """Lift of the hull at speed, N m s/rad; ``og`` (m) from the waterline down to the axis, ``slope`` of the
    lift. ITTC 7.5-02-07-04.5, 2.2.2, with the levers 0.3 and 0.5 of the draught."""
    force, point = 0.3 * draught, 0.5 * draught
    shape = 1.0 - 1.4 * og / point + 0.7 * og**2 / (force * point)
    return 0.5 * rho * length * draught * speed * slope * force * point * shape


def lift_slope(*, length: float, breadth: float, draught: float, cm: float) -> float:
    """2 pi T / L + kappa (4.1 B / L - 0.045) with kappa = 106 (Cm - 0.91)^2 - 700 (Cm - 0.91)^3."""
    full = max(cm - 0.91, 0.0)
    kappa = 106.0 * full**2 - 700.0 * full**3
    return float(2.0 * np.pi * draught / length + kappa * (4.1 * breadth / length - 0.045))


def friction_at_speed(speed: float, omega: float, length: float) -> float:
    """Factor on friction (Tamiya and Komura 1972)."""
    return 1.0 + 4.1 * speed / (omega * length)


def eddy_at_speed(speed: float, omega: float, length: float) -> float:
    """Factor on eddies, which are shed downstream: (0.04 K)^2 / (1 + (0.04 K)^2), K = w L / U."""
    return (0.04 * omega * length) ** 2 / (speed**2 + (0.04 * omega * length) ** 2)
