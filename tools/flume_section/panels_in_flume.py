"""Radiation and diffraction of a symmetric section in water of finite depth, two-dimensional and linear.

Green's third identity on straight panels with constant strength: the section, the free surface and a vertical
line far away, where only the outgoing wave is left. The image below the bottom keeps it closed, that at the
other side gives even (heave) and odd (sway, roll) flow. Sign of time exp(+i omega t); y across, z up.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
PER_WAVE = 40  # panels
LONGEST = 0.04  # of a panel on the surface, by the depth
REACH = 4.0  # of the free surface from the section, by the depth: what does not travel is below 1e-5 there
ODD = (0, 2)  # sway, roll


@dataclass(frozen=True, kw_only=True)
class SectionInFlume:
    """Answers at one frequency, per metre across: sway, heave, roll about the waterline on the centre line.

    ``added_mass``, ``damping`` (3, 3); ``force`` (3,) complex per metre of a wave that travels to +y, zero
    phase at y = 0; ``reflected``, ``transmitted`` complex, over the wave; ``radiated`` (3,) complex, wave
    to +y per unit of motion; ``wavenumber``.
    """

    omega: float
    wavenumber: float
    added_mass: FloatArray
    damping: FloatArray
    force: ComplexArray
    reflected: complex
    transmitted: complex
    radiated: ComplexArray


def wavenumber_of(omega: float, depth: float, g: float) -> float:
    """The k of omega^2 = g k tanh k h, by Newton's method."""
    nu = omega**2 / g
    k = max(nu, omega / np.sqrt(g * depth))
    for _ in range(50):
        t = np.tanh(k * depth)
        k -= (k * t - nu) / (t + k * depth * (1.0 - t * t))
    return float(k)


def section_in_flume(
    outline: FloatArray, omega: float, *, depth: float, rho: float, g: float, fineness: float = 1.0
) -> SectionInFlume:
    """Of an ``outline`` (p, 2) y, z from the keel to the waterline, panels between its points.

    ``fineness`` multiplies the panels of surface and far line.
    """
    k = wavenumber_of(omega, depth, g)
    grid = _Grid(outline, 2.0 * np.pi / k, depth, fineness)
    normal = grid.modes
    incident = _incident(grid, omega, k, g)
    potential, far, diffracted = np.zeros((grid.body, 3), complex), np.zeros(3, complex), {}
    for sign in (1.0, -1.0):
        kernel, source = grid.influence(sign)
        surface = slice(grid.body, grid.body + grid.surface)
        kernel = kernel.astype(complex)
        kernel[:, surface] += source[:, surface] * (omega**2 / g)
        kernel[:, surface.stop :] += source[:, surface.stop :] * (-1j * k)
        modes = [1] if sign > 0.0 else list(ODD)
        wave = incident[1 if sign > 0.0 else 0]
        right = np.column_stack([normal[:, modes], -wave["velocity"]])
        solved = np.linalg.solve(kernel, -source[:, : grid.body] @ right)
        away = _amplitude(grid, solved, omega, k, depth, g)
        potential[:, modes], far[modes] = solved[: grid.body, :-1], away[:-1]
        diffracted[sign] = (solved[: grid.body, -1] + wave["potential"], away[-1])
    weighted = normal * grid.length[: grid.body, None]
    radiation = rho * 2.0 * weighted.T @ potential
    even_or_odd = np.where([[True, False, True], [False, True, False], [True, False, True]], radiation, 0.0)
    pressure = {sign: -1j * omega * rho * 2.0 * weighted.T @ one[0] for sign, one in diffracted.items()}
    return SectionInFlume(
        omega=omega,
        wavenumber=k,
        added_mass=even_or_odd.real,
        damping=-omega * even_or_odd.imag,
        force=np.array([pressure[-1.0][0], pressure[1.0][1], pressure[-1.0][2]]),
        reflected=complex(diffracted[1.0][1] - diffracted[-1.0][1]),
        transmitted=complex(1.0 + diffracted[1.0][1] + diffracted[-1.0][1]),
        radiated=1j * omega * far,
    )


def infinite_added_mass(
    outline: FloatArray, *, depth: float, rho: float, fineness: float = 1.0
) -> FloatArray:
    """Added mass (3, 3) per metre where the free surface is one of zero potential."""
    grid = _Grid(outline, 20.0 * LONGEST * depth, depth, fineness)
    out = np.zeros((3, 3))
    for sign, modes in ((1.0, [1]), (-1.0, list(ODD))):
        kernel, source = grid.influence(sign)
        surface = slice(grid.body, grid.body + grid.surface)
        kernel[:, surface] = source[:, surface]  # unknown there: the normal velocity
        solved = np.linalg.solve(kernel, -source[:, : grid.body] @ grid.modes[:, modes])[: grid.body]
        weighted = grid.modes[:, modes] * grid.length[: grid.body, None]
        out[np.ix_(modes, modes)] = 2.0 * rho * weighted.T @ solved
    return out


class _Grid:
    """Panels of the right half: section, free surface, far line; their influence with images."""

    def __init__(self, outline: FloatArray, wave: float, depth: float, fineness: float) -> None:
        side = float(outline[-1, 0])
        self.depth = depth
        longest = min(LONGEST * depth, wave / PER_WAVE) / fineness
        out = _graded(side, side + REACH * depth, outline[-1, 1] - outline[-2, 1], longest)
        down = -_graded(0.0, depth, longest / 2.0, LONGEST * depth / fineness)
        nodes = [outline[:, 0] + 1j * outline[:, 1], out[1:] + 0j, out[-1] + 1j * down[1:]]
        self.body, self.surface = len(outline) - 1, len(out) - 1
        every = np.concatenate(nodes)
        self.start, self.end = every[:-1], every[1:]
        self.middle, step = 0.5 * (self.start + self.end), self.end - self.start
        self.length = np.abs(step)
        self.direction = step / self.length
        self.normal = 1j * self.direction  # out of the water, which lies to the right of the way
        self.normal[self.body + self.surface :] = 1.0
        n, at = self.normal[: self.body], self.middle[: self.body]
        self.modes = np.column_stack([n.real, n.imag, at.real * n.imag - at.imag * n.real])

    def influence(self, sign: float) -> tuple[FloatArray, FloatArray]:
        """(kernel, source): kernel phi + source dphi/dn = 0 at the middles, for even or odd (-1) flow."""
        double, single = self._of(self.start, self.end, self.normal)
        np.fill_diagonal(double, -np.pi)
        below, over = -2j * self.depth, self._of
        for start, end, normal, weight in (
            (np.conj(self.start) + below, np.conj(self.end) + below, np.conj(self.normal), 1.0),
            (-np.conj(self.start), -np.conj(self.end), -np.conj(self.normal), sign),
            (-self.start + below, -self.end + below, -self.normal, sign),
        ):
            more, less = over(start, end, normal)
            double += weight * more
            single += weight * less
        return double, -single

    def _of(self, a: ComplexArray, b: ComplexArray, normal: ComplexArray) -> tuple[FloatArray, FloatArray]:
        """Integrals of d ln r / dn and of ln r over panels a to b, at all middles."""
        length = np.abs(b - a)
        along = (b - a) / length
        local = (self.middle[:, None] - a[None, :]) * np.conj(along)
        x, y = local.real, local.imag
        rest = x - length
        angle = np.arctan2(y * length, x * rest + y * y)  # that the panel fills, signed by the side
        side = np.sign((normal * np.conj(along)).imag)
        tiny = 1e-300
        log = 0.5 * (x * np.log(x * x + y * y + tiny) - rest * np.log(rest * rest + y * y + tiny))
        return -angle * side, log - length + y * angle


def _graded(start: float, stop: float, first: float, longest: float) -> FloatArray:
    """Points between two, whose distances grow by 8 % each from the first to the longest."""
    points, step = [start], min(first, longest)
    while points[-1] < stop:
        points.append(points[-1] + step)
        step = min(1.08 * step, longest)
    return start + (np.array(points) - start) * (stop - start) / (points[-1] - start)


def _incident(grid: _Grid, omega: float, k: float, g: float) -> list[dict[str, ComplexArray]]:
    """Odd and even part of a unit wave on the section: its potential, and its velocity along the normals."""
    at, n = grid.middle[: grid.body], grid.normal[: grid.body]
    h = grid.depth
    c, s = np.cosh(k * (at.imag + h)) / np.cosh(k * h), np.sinh(k * (at.imag + h)) / np.cosh(k * h)
    unit, y = 1j * g / omega, at.real
    parts = []
    for profile, slope in (
        (-1j * np.sin(k * y), -1j * k * np.cos(k * y)),
        (np.cos(k * y) + 0j, -k * np.sin(k * y) + 0j),
    ):
        velocity = unit * (slope * c * n.real + profile * k * s * n.imag)
        parts.append({"potential": unit * profile * c, "velocity": velocity})
    return parts


def _amplitude(
    grid: _Grid, potential: ComplexArray, omega: float, k: float, depth: float, g: float
) -> ComplexArray:
    """Elevation of the wave that leaves to +y, per column: the potential at the far line on its profile."""
    line = slice(grid.body + grid.surface, None)
    z, y = grid.middle[line].imag, grid.middle[line][0].real
    profile = np.cosh(k * (z + depth)) / np.cosh(k * depth)
    weight = profile * grid.length[line]
    share = weight @ potential[line] / (weight @ profile)
    return np.asarray(-1j * omega / g * share * np.exp(1j * k * y))
