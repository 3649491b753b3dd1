"""`Hull`: the wetted surface of one vessel, from a parametric hull, an offset table or a mesh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array
from seacrane.hydro.hull.hydrostatics import Hydrostatics, panel_hydrostatics
from seacrane.hydro.hull.lines import OffsetTable, ParametricHull, read_offset_table
from seacrane.hydro.hull.panels import (
    Slice,
    afloat,
    along,
    area_vectors,
    closed_below,
    closed_loft,
    cut_panels,
    fractions,
    mesh_triangles,
    slices,
    triangles_of,
    without_slivers,
)
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import finite_of, positive_of
from seacrane.inputs.mesh_files import read_stl

LONGEST = 2000.0  # m: no ship is, a drawing in mm is
ON_WATERLINE = 1e-6  # of the length
FLAT = 1e-9  # of the cube of the length: less is no volume
CLOSED = 1e-3  # of the volume: what the integrals of x n_x, y n_y and z n_z may differ by
SYMMETRIC = 1e-3  # of the breadth: how far off the centre plane volume and waterplane may lie
KNUCKLE = np.radians(15.0)  # by which an outline turns at a corner; a round bilge turns less at each point
LEAST_PART = 1e-6  # of a section's length between two corners


@dataclass(frozen=True, kw_only=True, eq=False)
class Hull:
    """Wetted surface of a port-starboard symmetric vessel; immutable, the array read-only.

    x forward, y port, z up, z = 0 on the still waterline. The origin becomes the reference point of a
    database made from the hull.

    Attributes
    ----------
    name : text.
    panels : (n, 4, 3) vertices in m of both sides up to the waterline, normals into the water; a triangle
        repeats its last vertex. Closed, but for the waterplane.
    source : where the shape comes from, in words.

    Raises
    ------
    ValueError : nothing below the waterline, panels above it, inward normals, an open surface, a hull that is
        not symmetric, lies across the x axis, or is as long as a drawing in mm.
    """

    name: str
    panels: Array
    source: str

    __repr__ = brief

    def __post_init__(self) -> None:
        panels = np.array(self.panels, dtype=float)
        _require_panels(self.name, panels)
        panels.flags.writeable = False
        object.__setattr__(self, "panels", panels)
        _require_closed(self.name, panels)
        _require_floating(self.name, panels, self.hydrostatics)

    @cached_property
    def hydrostatics(self) -> Hydrostatics:
        """Volume, centres, waterplane and restoring about the hull's origin."""
        return panel_hydrostatics(self.panels)

    @property
    def extent(self) -> Array:
        """Smallest and largest x, y, z (2, 3) of the wetted surface, m."""
        points = self.panels.reshape(-1, 3)
        return np.array([points.min(axis=0), points.max(axis=0)])

    @property
    def length(self) -> float:
        """Length of the wetted surface, m."""
        return float(np.ptp(self.panels[..., 0]))

    @property
    def breadth(self) -> float:
        """Largest breadth under water, m."""
        return float(np.ptp(self.panels[..., 1]))

    @property
    def draught(self) -> float:
        """Depth of the lowest point, m."""
        return float(-self.panels[..., 2].min())

    @property
    def panel_size(self) -> float:
        """Side (m) of a square panel of the mean area."""
        return float(np.sqrt(self.hydrostatics.wetted_surface / len(self.panels)))

    def moved(self, x: float) -> Hull:
        """The same hull ``x`` metres further forward: what lay at -x becomes the origin."""
        ahead = finite_of(f"hull {self.name!r}: x", x, "m")
        return replace(self, panels=self.panels + np.array([ahead, 0.0, 0.0]))

    def at_centre_of_buoyancy(self) -> Hull:
        """The same hull with the origin on the waterline over its centre of buoyancy."""
        return self.moved(-float(self.hydrostatics.center_of_buoyancy[0]))

    def sections(self, x: ArrayLike) -> list[Slice]:
        """Half sections at the stations ``x`` (s,) in m; see `seacrane.hydro.hull.panels.slices`."""
        return slices(self.name, self.panels, np.asarray(x, dtype=float))

    def remeshed(self, *, stations: int, girth: int) -> Hull:
        """The hull with even panels: ``stations`` along the length, ``girth`` on each half section.

        What a panel method wants of an offset table or a mesh from a drawing. Bilges and chines that turn by
        more than 15 deg stay corners; along the length corners between stations are cut off. Compare the
        hydrostatics, and the hydrodynamics by ``hydro_from_hull(..., check=True)``.

        Raises
        ------
        ValueError : fewer than 2 panels either way, or a hull that is not one outline at every station.
        """
        if stations < 2 or girth < 2:
            raise ValueError(
                f"hull {self.name!r}: {stations} x {girth} panels; give 2 or more along the length and around"
            )
        x = np.linspace(self.extent[0, 0], self.extent[1, 0], stations + 1)
        cut = self.sections(x)
        if hanging := [v for v, s in zip(x, cut, strict=True) if s.apart > 0.0]:
            raise ValueError(
                f"hull {self.name!r}: at x = {hanging[0]:.4g} m something hangs apart under water; remeshing "
                "takes one outline: use the mesh as it is"
            )
        panels = closed_loft(x.tolist(), around([s.section for s in cut], girth))
        source = f"{self.source}; remeshed with {stations} x {girth} panels on each side"
        return Hull(name=self.name, panels=panels, source=source)

    @staticmethod
    def from_parametric(
        hull: ParametricHull, *, stations: int = 56, girth: int = 20, name: str = "parametric"
    ) -> Hull:
        """From `ParametricHull`, with that many panels along the length and on each half section."""
        return Hull(name=name, panels=hull.panels(stations=stations, girth=girth), source=str(hull))

    @staticmethod
    def from_offsets(table: OffsetTable | str | PathLike[str], *, draught: float | None = None) -> Hull:
        """From an offset table or its file, lofted straight between stations, with flat ends.

        Parameters
        ----------
        table : `OffsetTable`, or a path for `read_offset_table`.
        draught : m above the lowest point of the keel; None: z = 0 of the table is the waterline.

        Raises
        ------
        ValueError, seacrane.errors.FileFormatError : as `OffsetTable`, `read_offset_table` and `Hull`.
        """
        offsets = table if isinstance(table, OffsetTable) else read_offset_table(table)
        panels = _wetted(offsets.panels(draught=draught))
        source = f"offset table {offsets.name!r}, {len(offsets.x)} stations"
        return Hull(name=offsets.name, panels=panels, source=source)

    @staticmethod
    def from_mesh(
        *, vertices: ArrayLike, faces: ArrayLike, draught: float | None = None, name: str = "mesh",
        source: str = "mesh",
    ) -> Hull:  # fmt: skip
        """From a surface of triangles or quadrilaterals, cut at the waterline.

        Parameters
        ----------
        vertices : (n, 3) m. x forward, y port with the centre plane at y = 0, z up.
        faces : (m, 3) or (m, 4) indices, anticlockwise from outside.
        draught : m above the lowest vertex; None: z = 0 of the mesh is the waterline.

        Raises
        ------
        ValueError : as `seacrane.hydro.hull.panels` (open, overlapping or badly oriented) and `Hull`.
        """
        triangles = afloat(name, mesh_triangles(name, vertices, faces), draught)
        triangles = closed_below(f"hull {name!r}", triangles)
        return Hull(name=name, panels=_wetted(triangles[:, [0, 1, 2, 2]]), source=source)

    @staticmethod
    def from_stl(path: str | PathLike[str], *, draught: float | None = None, scale: float = 1.0) -> Hull:
        """From an STL file, ASCII or binary, its coordinates multiplied by ``scale`` (0.001 for mm).

        Raises
        ------
        ValueError, seacrane.errors.FileFormatError : as `from_mesh` and `seacrane.hydro.read_stl`.
        """
        triangles = positive_of(f"hull {str(path)!r}: scale", scale) * read_stl(path)
        return Hull.from_mesh(
            vertices=triangles.reshape(-1, 3),
            faces=np.arange(3 * len(triangles)).reshape(-1, 3),
            draught=draught,
            name=Path(path).stem,
            source=f"STL file {Path(path).name}, {len(triangles)} triangles",
        )


def _wetted(panels: Array) -> Array:
    """The panels below z = 0."""
    tolerance = ON_WATERLINE * float(np.ptp(panels[..., 0]))
    return without_slivers(cut_panels(panels, axis=2, side=-1, tolerance=tolerance))


def _require_panels(name: str, panels: Array) -> None:
    if panels.ndim != 3 or panels.shape[1:] != (4, 3):
        raise ValueError(f"hull {name!r}: panels have shape {panels.shape}; give (n, 4, 3)")
    if not np.all(np.isfinite(panels)):
        raise ValueError(f"hull {name!r}: a panel's vertex is not finite; repair the surface")
    if len(panels) == 0 or not np.any(panels[..., 2] < 0.0):
        raise ValueError(
            f"hull {name!r}: nothing is below the waterline z = 0; lower it, or give the draught"
        )
    if (longest := float(np.ptp(panels.reshape(-1, 3), axis=0).max())) > LONGEST:
        raise ValueError(
            f"hull {name!r}: is {longest:.6g} m long; in mm, perhaps? Multiply the coordinates (scale=0.001)"
        )
    if (top := float(panels[..., 2].max())) > ON_WATERLINE * float(np.ptp(panels[..., 0])):
        raise ValueError(f"hull {name!r}: a panel reaches z = {top:.4g} m; cut the surface at z = 0")


def _require_closed(name: str, panels: Array) -> None:
    """A volume that is the same by x, y and z, and positive."""
    triangles, points = triangles_of(panels), panels.reshape(-1, 3)
    centre, flux = triangles.mean(axis=1), area_vectors(triangles)
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0)) * [1, 1, 0]
    volumes = np.sum((centre - middle) * flux, axis=0)
    if np.all(volumes < 0.0):
        raise ValueError(
            f"hull {name!r}: encloses {volumes[2]:.4g} m3, so its normals point inwards; reverse the "
            "order of the vertices of every face"
        )
    leak = np.abs(flux[:, :2].sum(axis=0)).max() / max(np.abs(flux).sum(), 1e-300)
    smallest = FLAT * float(np.ptp(points, axis=0).max()) ** 3
    if not (volumes.max() > smallest and np.ptp(volumes) <= CLOSED * volumes.max() and leak <= CLOSED):
        raise ValueError(
            f"hull {name!r}: volume by x, y and z is {volumes[0]:.6g}, {volumes[1]:.6g}, {volumes[2]:.6g} "
            "m3; the surface is not closed below the waterline, or some normals point inwards"
        )


def _require_floating(name: str, panels: Array, statics: Hydrostatics) -> None:
    """At the waterline, symmetric, along the x axis."""
    if statics.waterplane_area <= CLOSED * statics.wetted_surface:
        raise ValueError(
            f"hull {name!r}: is wholly under water (waterplane area {statics.waterplane_area:.4g} m2); only "
            "what floats at the waterline has a database: lower the draught"
        )
    breadth, length = float(np.ptp(panels[..., 1])), float(np.ptp(panels[..., 0]))
    off = max(
        abs(float(statics.center_of_buoyancy[1])),
        abs(statics.waterplane_moment_y) / statics.waterplane_area,
        abs(statics.waterplane_product) / (statics.waterplane_area * length),
    )
    if off > SYMMETRIC * breadth:
        raise ValueError(
            f"hull {name!r}: volume or waterplane lies {off:.4g} m off the plane y = 0; give a "
            "port-starboard symmetric hull with that plane in its middle"
        )
    if breadth > 1.5 * length:
        raise ValueError(
            f"hull {name!r}: is {length:.4g} m long in x and {breadth:.4g} m in y; turn it: x is forward"
        )


def around(sections: Sequence[Array], count: int) -> list[Array]:
    """Every half section (p, 2) with ``count`` pieces: corners stay corners, points between them are even.

    Where sections have equally many corners, one corner is the same point of each, so that a chine stays one
    line of the mesh. A section of another kind, such as a stem, has even points where its corners are not.
    """
    corners = [knuckles(section) for section in sections]
    number, times = np.unique([len(own) for own in corners], return_counts=True)
    usual = int(number[times.argmax()])  # that most sections have
    lengths = np.mean([np.diff([0.0, *own, 1.0]) for own in corners if len(own) == usual], axis=0)
    pieces = np.ones(len(lengths), dtype=np.intp)  # at least one for each part, in proportion to its length
    for _ in range(count - len(lengths)):
        pieces[np.argmax(lengths / pieces)] += 1
    made = []
    for section, own in zip(sections, corners, strict=True):
        if len(own) == usual < count:
            ends = np.array([0.0, *own, 1.0])
            parts = [
                np.linspace(ends[i], ends[i + 1], n + 1)[bool(i) :] for i, n in enumerate(pieces.tolist())
            ]
            at = np.concatenate(parts)
        else:
            at = _snapped(np.linspace(0.0, 1.0, count + 1), own)
        made.append(along(section, at))
    return made


def knuckles(section: Array) -> Array:
    """Shares of a half section's length at which it has a corner."""
    at = fractions(section)
    keep = np.append(True, np.diff(at) > LEAST_PART)
    at, points = at[keep], section[keep]
    if len(points) < 3:
        return np.zeros(0)
    direction = np.arctan2(*np.diff(points, axis=0).T[::-1])
    turn = np.abs(np.angle(np.exp(1j * np.diff(direction))))
    return np.asarray(at[1:-1][turn > KNUCKLE])


def _snapped(even: Array, corners: Array) -> Array:
    """Even shares, the nearest of which moves to each corner."""
    at = even.copy()
    free = np.ones(len(at), dtype=bool)
    free[[0, -1]] = False
    for corner in corners[: len(at) - 2]:
        nearest = int(np.argmin(np.where(free, np.abs(at - corner), np.inf)))
        at[nearest], free[nearest] = corner, False
    return np.sort(at)


VOLUME = 14.0e6 / 1025.0  # m3
STATIONS, GIRTH = 56, 20
# Of the entrance that encloses the volume, about its centre of buoyancy.
LINES = ParametricHull(
    length=115.0, breadth=25.0, draught=6.4, entrance_length=46.77395891238753, run_length=34.5,
    transom_breadth_fraction=0.75, transom_draught_fraction=0.2, section_exponent=6.0,
    origin_from_transom=55.298818409692544,
)  # fmt: skip


@cache
def shipped_hull() -> Hull:
    """The hull of 115 m of `shipped_database`, its origin the database's reference point; made once."""
    return Hull.from_parametric(LINES, stations=STATIONS, girth=GIRTH, name="hull_115")
