"""Parametric ship hull: waterline and section shape, panel mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.hull.panels import lofted, mirrored

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class ParametricHull:
    """Hull with a parallel midbody, parabolic entrance, raised run with transom, rounded bilge.

    Sections are superellipses ``(y / b(x))^p + (-z / d(x))^p = 1`` between the half breadth ``b`` and the
    local draught ``d``. Over the entrance ``b`` falls parabolically to a vertical stem; over the run ``b``
    and ``d`` fall parabolically to the transom's fractions. Axes: x forward, y port, z up, x = 0 at
    ``origin_from_transom`` forward of the transom, z = 0 on the still waterline. SI units.
    """

    length: float
    breadth: float
    draught: float
    entrance_length: float
    run_length: float
    transom_breadth_fraction: float
    transom_draught_fraction: float
    section_exponent: float
    origin_from_transom: float = 0.0

    def half_breadth(self, x: FloatArray) -> FloatArray:
        """Half breadth of the waterline (m) at the stations ``x`` (n,) in m."""
        entrance, run = self._end_parameters(x)
        shape = (1.0 - entrance**2) * (1.0 - (1.0 - self.transom_breadth_fraction) * run**2)
        return np.asarray(0.5 * self.breadth * shape)

    def local_draught(self, x: FloatArray) -> FloatArray:
        """Draught of the keel line (m) at the stations ``x`` (n,) in m."""
        _, run = self._end_parameters(x)
        return np.asarray(self.draught * (1.0 - (1.0 - self.transom_draught_fraction) * run**2))

    def _end_parameters(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Fractions (0 midbody side, 1 end) along the entrance and along the run."""
        from_transom = np.asarray(x, dtype=float) + self.origin_from_transom
        entrance = np.clip(
            (from_transom - self.length + self.entrance_length) / self.entrance_length, 0.0, 1.0
        )
        run = np.clip(1.0 - from_transom / self.run_length, 0.0, 1.0)
        return entrance, run

    def section(self, x: float, count: int) -> FloatArray:
        """Points (count + 1, 2) of y, z (m) on the port half section, waterline to keel, evenly spaced."""
        angle = np.linspace(0.0, 0.5 * np.pi, 2001)
        power = 2.0 / self.section_exponent
        station = np.array([x])
        y = self.half_breadth(station)[0] * np.cos(angle) ** power
        z = -self.local_draught(station)[0] * np.sin(angle) ** power
        y[-1] = 0.0
        arc = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))])
        wanted = np.linspace(0.0, arc[-1], count + 1)
        return np.column_stack([np.interp(wanted, arc, y), np.interp(wanted, arc, z)])

    def panels(self, *, stations: int, girth: int) -> FloatArray:
        """Quadrilateral panels of the wetted hull.

        Parameters
        ----------
        stations : number of panels along the length.
        girth : number of panels on each half section.

        Returns
        -------
        (2 * stations * girth + 2 * (girth - 1), 4, 3) vertices in m, normals pointing into the water, the
        transom's panels last.
        """
        x = np.linspace(-self.origin_from_transom, self.length - self.origin_from_transom, stations + 1)
        sections = [self.section(float(station), girth) for station in x]
        edge = np.column_stack([np.full(girth + 1, x[0]), sections[0]])
        top = edge * np.array([1.0, 1.0, 0.0])
        transom = np.stack([top[1:-1], edge[1:-1], edge[2:], top[2:]], axis=1)  # upright strips
        transom[0, :2] = edge[:2]  # the outermost, which would be a sliver, is joined to its neighbour
        return np.concatenate([lofted(x.tolist(), sections), transom, mirrored(transom)])
