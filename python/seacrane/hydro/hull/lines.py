"""The lines of a hull, before it has panels: parametric, or offset tables, from arrays or a text file."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.hydro.data.frozen import reading
from seacrane.hydro.hull.panels import closed_loft, lofted, mirrored
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import finite_of, positive_of
from seacrane.inputs.shown import shown
from seacrane.inputs.whole_file import read_whole


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

    def half_breadth(self, x: Array) -> Array:
        """Half breadth of the waterline (m) at the stations ``x`` (n,) in m."""
        entrance, run = self._end_parameters(x)
        shape = (1.0 - entrance**2) * (1.0 - (1.0 - self.transom_breadth_fraction) * run**2)
        return np.asarray(0.5 * self.breadth * shape)

    def _end_parameters(self, x: Array) -> tuple[Array, Array]:
        """Fractions (0 midbody side, 1 end) along the entrance and along the run."""
        from_transom = np.asarray(x, dtype=float) + self.origin_from_transom
        entrance = np.clip(
            (from_transom - self.length + self.entrance_length) / self.entrance_length, 0.0, 1.0
        )
        run = np.clip(1.0 - from_transom / self.run_length, 0.0, 1.0)
        return entrance, run

    def section(self, x: float, count: int) -> Array:
        """Points (count + 1, 2) of y, z (m) on the port half section, waterline to keel, evenly spaced."""
        angle = np.linspace(0.0, 0.5 * np.pi, 2001)
        power = 2.0 / self.section_exponent
        station = np.array([x])
        y = self.half_breadth(station)[0] * np.cos(angle) ** power
        run = self._end_parameters(station)[1][0]
        z = -(self.draught * (1.0 - (1.0 - self.transom_draught_fraction) * run**2)) * np.sin(angle) ** power
        y[-1] = 0.0
        arc = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))])
        wanted = np.linspace(0.0, arc[-1], count + 1)
        return np.column_stack([np.interp(wanted, arc, y), np.interp(wanted, arc, z)])

    def panels(self, *, stations: int, girth: int) -> Array:
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


LARGEST_FILE = 16 * 2**20  # bytes: half a million points
LARGEST = 1e9  # m: areas and volumes do not overflow


@dataclass(frozen=True, kw_only=True, eq=False)
class OffsetTable:
    """Points on the port half of each station; immutable.

    Attributes
    ----------
    x : (s,) m, increasing, forward.
    sections : s arrays (p, 2) of y >= 0 and z in m, along the outline from deck to keel or from keel to deck.
        An outline whose keel end is off the centre line is closed by a flat bottom.
    name : text.

    Raises
    ------
    ValueError : fewer than two stations, stations that do not increase, points that are not finite or cross
        the centre line.
    """

    x: Array
    sections: tuple[Array, ...]
    name: str = "offsets"

    __repr__ = brief

    def __post_init__(self) -> None:
        x = np.array(self.x, dtype=float)
        if x.ndim != 1 or len(x) < 2 or len(x) != len(self.sections):
            raise ValueError(
                f"offset table {self.name!r}: {len(self.sections)} sections at stations of shape {x.shape}; "
                "give two or more stations and one section for each"
            )
        if not np.all(np.abs(x) <= LARGEST) or np.any(np.diff(x) <= 0.0):
            raise ValueError(
                f"offset table {self.name!r}: stations {shown(x.tolist())} have to increase, forward, "
                f"in m, {LARGEST:g} at most"
            )
        sections = tuple(self._checked(x[i], section) for i, section in enumerate(self.sections))
        x.flags.writeable = False
        object.__setattr__(self, "x", x)
        object.__setattr__(self, "sections", sections)

    def _checked(self, x: float, section: Array) -> Array:
        """The section as a read-only array, keel last and on the centre line."""
        points = np.array(section, dtype=float)
        station = f"offset table {self.name!r}: station x = {x:.6g} m"
        if points.ndim != 2 or points.shape[1] != 2 or len(points) == 0:
            raise ValueError(f"{station} has points of shape {points.shape}; give (p, 2), y and z")
        if not np.all(np.abs(points) <= LARGEST):
            raise ValueError(
                f"{station} has a coordinate that is not finite or above {LARGEST:g}; correct the table"
            )
        if points[:, 0].min() < 0.0:
            raise ValueError(f"{station} has y = {points[:, 0].min():.6g} m; give the port half, y >= 0")
        if points[0, 1] < points[-1, 1]:
            points = points[::-1]
        if points[-1, 0] > 0.0:
            points = np.vstack([points, [0.0, points[-1, 1]]])
        points = np.ascontiguousarray(points)
        points.flags.writeable = False
        return points

    def panels(self, *, draught: float | None = None) -> Array:
        """Panels (n, 4, 3) of both sides and flat ends, z = 0 on the waterline; not cut there.

        Raises
        ------
        ValueError : a draught that is not positive, or a station whose outline begins under water.
        """
        keel = min(float(section[:, 1].min()) for section in self.sections)
        what = f"offset table {self.name!r}"
        waterline = 0.0 if draught is None else keel + positive_of(f"{what}: draught", draught, "m")
        tolerance = 1e-6 * float(np.ptp(self.x))
        for x, section in zip(self.x, self.sections, strict=True):
            if section[0, 1] < waterline - tolerance:
                raise ValueError(
                    f"{what}: station x = {x:.6g} m begins {waterline - section[0, 1]:.4g} m below the "
                    "waterline; continue it upwards, or leave it out (a bulb ahead of the stem needs a mesh)"
                )
        return closed_loft(self.x.tolist(), [section - [0.0, waterline] for section in self.sections])


def read_offset_table(path: str | PathLike[str]) -> OffsetTable:
    """Read a text file of three columns x, y, z in m, separated by commas.

    One point a line; the points of a station follow each other along the outline, stations forward or aft.
    Blank lines and lines that begin with ``#`` are skipped; a first line ``x,y,z`` may name the columns.

    Raises
    ------
    seacrane.errors.FileFormatError : missing or malformed, names the line; or no hull, as `OffsetTable`.
    """
    source = Path(path)
    try:
        lines = read_whole(source, LARGEST_FILE, "give fewer points").decode("utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(f"{source}: cannot be read ({error}); give a text file x,y,z") from error
    stations: dict[float, list[list[float]]] = {}
    last: float | None = None
    for number, line in enumerate(lines, start=1):
        cells = [cell.strip() for cell in line.split(",")]
        named = not stations and [cell.lower() for cell in cells] == ["x", "y", "z"]
        if named or not line.strip() or line.strip().startswith("#"):
            continue
        try:
            x, y, z = (finite_of("a cell", float(cell)) for cell in cells)
        except ValueError as error:
            raise FileFormatError(
                f"{source}: line {number}: {line.strip()[:80]!r} is not three finite numbers x,y,z (in m, "
                "separated by commas)"
            ) from error
        if x != last and x in stations:
            raise FileFormatError(
                f"{source}: line {number}: station x = {x:g} comes back; keep its points together"
            )
        stations.setdefault(x, []).append([y, z])
        last = x
    order = list(stations)
    if len(order) > 1 and order[0] > order[-1]:
        order = order[::-1]
    with reading(source):  # stations that neither rise nor fall are for the table to refuse
        sections = tuple(np.array(stations[x]) for x in order)
        return OffsetTable(x=np.array(order), sections=sections, name=source.stem)
