"""Radiation of Lewis sections by multipoles in the origin: an independent formulation to test strip theory.

Ursell (1949) for the circle and Tasai (1959) for Lewis forms, here with collocation in place of their stream
function: a source or a horizontal dipole on the free surface makes the waves, and wave-free potentials
``f_n = Z^-n - i nu int Z^-n dz`` correct the flow near the section, which is the image of the unit circle
``|Z| = 1`` under ``z = M (Z + a1 / Z + a3 / Z^3)``. Their complex potentials satisfy ``Re(i f' - nu f) = 0``
on the surface term by term.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import expi

from seacrane.arrays import Array, Complex


@dataclass(frozen=True, kw_only=True)
class LewisSection:
    """Coefficients of the mapping, and its scale M in m."""

    a1: float
    a3: float
    scale: float = 1.0

    def outline(self, angle: Array) -> Complex:
        """Points y + i z (m) at angles 0 (waterline) to pi / 2 (keel)."""
        zeta = np.exp(-1j * angle)
        return np.asarray(self.scale * (zeta + self.a1 / zeta + self.a3 / zeta**3))

    def points(self, count: int) -> Array:
        """Half section (count + 1, 2) from waterline to keel."""
        z = self.outline(np.linspace(0.0, 0.5 * np.pi, count + 1))
        points = np.column_stack([z.real, z.imag])
        points[0, 1] = points[-1, 0] = 0.0
        return points

    def slope(self, zeta: Complex) -> Complex:
        """dz / dZ."""
        return self.scale * (1.0 - self.a1 / zeta**2 - 3.0 * self.a3 / zeta**4)


def radiation(section: LewisSection, nu: float, terms: int = 20) -> Complex:
    """Added mass + damping / (i omega), over density, (3, 3) in sway, heave, roll at the wavenumber nu."""
    node, weight = np.polynomial.legendre.leggauss(6 * terms)
    angle = 0.25 * np.pi * (node + 1.0)
    zeta, z = np.exp(-1j * angle), section.outline(angle)
    tangent = section.slope(zeta) * -1j * zeta  # dz / d angle, from waterline to keel
    length = 0.25 * np.pi * weight * np.abs(tangent)
    normal = 1j * tangent / np.abs(tangent)
    modes = np.column_stack([normal.real, normal.imag, (np.conj(1j * z) * normal).real])
    out = np.zeros((3, 3), dtype=complex)
    for parity in (0, 1):
        columns = [0, 2] if parity == 1 else [1]
        potential, velocity = _basis(section, zeta, z, normal, nu, parity, terms)
        size = np.abs(velocity).max(axis=0)
        strength = np.linalg.lstsq(velocity / size, modes[:, columns].astype(complex), rcond=None)[0]
        on_section = (potential / size) @ strength
        out[np.ix_(columns, columns)] = -2.0 * (modes[:, columns] * length[:, None]).T @ on_section
    return out


def _basis(
    section: LewisSection, zeta: Complex, z: Complex, normal: Complex, nu: float, parity: int,
    terms: int,
) -> tuple[Complex, Complex]:  # fmt: skip
    """Potentials and normal velocities (points, terms + 1); the imaginary part is that of exp(i omega t)."""
    w = 1j * nu * z
    wave, standing = np.exp(-w), np.exp(-w) * expi(w)
    first = -standing + 1.0 / w  # d/dw
    if parity == 0:
        f = [standing / np.pi, wave]
        slope = [1j * nu * first / np.pi, -1j * nu * wave]
    else:
        second = -first - 1.0 / w**2
        f = [1j * nu * first / np.pi, -1j * nu * wave]
        slope = [-(nu**2) * second / np.pi, -(nu**2) * wave]
    potential = [f[0].real + 1j * f[1].real]
    velocity = [(slope[0] * normal).real + 1j * (slope[1] * normal).real]
    for m in range(1, terms + 1):
        n = 2 * m + parity
        integral = section.scale * (
            zeta ** (1 - n) / (1 - n)
            + section.a1 * zeta ** (-1 - n) / (1 + n)
            + 3.0 * section.a3 * zeta ** (-3 - n) / (3 + n)
        )
        potential.append((zeta ** (-n) - 1j * nu * integral).real + 0j)
        change = -n * zeta ** (-n - 1) / section.slope(zeta) - 1j * nu * zeta ** (-n)
        velocity.append((change * normal).real + 0j)
    return np.stack(potential, axis=1), np.stack(velocity, axis=1)
