"""Parametric ship hull: waterline and section shape, panel mesh."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.hull.hydrostatics import panel_hydrostatics
from seacrane.hydro.hull.panels import mirrored

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
        port = np.empty((stations + 1, girth + 1, 3))
        for i, station in enumerate(x):
            port[i, :, 0] = station
            port[i, :, 1:] = self.section(float(station), girth)
        corners = [port[:-1, :-1], port[1:, :-1], port[1:, 1:], port[:-1, 1:]]
        side = np.stack(corners, axis=2).reshape(-1, 4, 3)
        return np.concatenate([side, mirrored(side), _transom_panels(port[0])])

    def scaled_to_volume(self, volume: float, *, stations: int, girth: int) -> ParametricHull:
        """Hull whose panel mesh encloses ``volume`` (m3), by solving the entrance length, origin at its LCB.

        Raises
        ------
        ValueError : no entrance length between 5 % of the length and the whole length ahead of the run
            encloses it.
        """
        low, high = 0.05 * self.length, self.length - self.run_length

        def excess(entrance: float) -> float:
            hull = replace(self, entrance_length=entrance)
            return panel_hydrostatics(hull.panels(stations=stations, girth=girth)).volume - volume

        if excess(low) < 0.0 or excess(high) > 0.0:
            raise ValueError(
                f"ParametricHull: volume {volume} m3 is out of reach for length {self.length}, breadth "
                f"{self.breadth}, "
                f"draught {self.draught} m; change the volume or the section exponent"
            )
        entrance = _bisect(excess, low, high)
        hull = replace(self, entrance_length=entrance, origin_from_transom=0.0)
        lcb = panel_hydrostatics(hull.panels(stations=stations, girth=girth)).center_of_buoyancy[0]
        return replace(hull, origin_from_transom=float(lcb))


def _transom_panels(edge: FloatArray) -> FloatArray:
    """Cap (2 * girth - 2, 4, 3) of the transom, ``edge`` (girth + 1, 3) its half section; upright strips."""
    top = edge * np.array([1.0, 1.0, 0.0])
    strips = np.stack([top[1:-1], edge[1:-1], edge[2:], top[2:]], axis=1)
    # The outermost strip would be a sliver: it is joined to its neighbour.
    strips[0, 0], strips[0, 1] = edge[0], edge[1]
    return np.concatenate([strips, mirrored(strips)])


def _bisect(function: Callable[[float], float], low: float, high: float) -> float:
    """Root of a continuous function with a sign change between ``low`` and ``high``, to rounding."""
    sign = function(low) > 0.0
    while (middle := 0.5 * (low + high)) not in (low, high):
        low, high = (middle, high) if (function(middle) > 0.0) == sign else (low, middle)
    return middle
