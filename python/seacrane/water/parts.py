"""Parts of a load in the water: shapes with the coefficients of their added mass, slam and drag."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import (
    finite_of,
    not_negative_of,
    number_of,
    positive_of,
    shaped_of,
    text_of,
    vector_of,
)
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.warnings import UnitWarning
from seacrane.water.added_mass import (
    CIRCLE_SOURCE,
    PLATE_SOURCE,
    ROUNDING,
    SPHERE_SOURCE,
    box_deep,
    circle_table,
    disc_added_mass,
    disc_share,
    perforation_factor,
    plate_factor,
    ramp,
    ring_added_mass,
    sphere_table,
    step,
)

Array = NDArray[np.float64]

LEAST_SLAM_ROUND, LEAST_SLAM = 3.0, 5.0  # DNV-RP-N103 (unverified)
CIRCLE_SLAM = np.pi  # von Karman: what the added mass of a circle gives as it touches
DISC_DRAG = 1.17  # C_D of a thin disc across the flow (Hoerner, Fluid-Dynamic Drag; unverified)
CLOSED, OPEN, JOINED = "closed", "open", "joined"  # what an end of a cylinder is
MOST_PERFORATION = 0.5  # where the factor ends
RAMP_KNOTS = 40
MOST_STRIPS = 1000
MOST_SLAM = 100.0
THICK = 0.5  # m: no plate is as thick, nor as half its side
LONGEST = 1e5  # m: no load is
SETTLED = 0.1  # radii, over which wetting faster than that of a level surface goes over into it


@dataclass(frozen=True, kw_only=True)
class Piece:
    """What the engine is told of a strip of a part: as `ImmersedPart`, its point in axes of the part."""

    shape: str
    offset: Array
    size: Array
    depths: Array
    added_masses: Array
    drag: Array
    fill: float = 1.0
    volumes: Array = field(default_factory=lambda: np.zeros(0))
    slow_added_masses: Array = field(default_factory=lambda: np.zeros((0, 3)))
    row: int = 0  # of which it is strip `place` of `count`, at equal steps in axes of the part
    place: int = 0
    count: int = 1
    step: Array = field(default_factory=lambda: np.zeros(3))
    turn: Array = field(default_factory=lambda: np.eye(3))  # columns: its axes in those of the part


@dataclass(frozen=True, kw_only=True)
class _Part(ABC):
    """What all parts have.

    Parameters
    ----------
    point : array_like, shape (3,)
        Its centre, m, body coordinates.
    axes : array_like, shape (3, 3)
        Columns are its axes, in those of the body. Default: those of the body.
    source : str
        Where its coefficients are from; reports show it beside the defaults that it keeps.
    """

    point: Any = (0.0, 0.0, 0.0)
    axes: Any = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    source: str = ""

    kind: ClassVar[str]

    def __post_init__(self) -> None:
        shaped_of(f"{self.kind}: point", self.point, (3,))
        shaped_of(f"{self.kind}: axes", self.axes, (3, 3))
        text_of(f"{self.kind}: source", self.source, "")

    @property
    @abstractmethod
    def extent(self) -> float:
        """Its longest side, m."""

    @abstractmethod
    def pieces(self, density: float) -> Iterator[Piece]:
        """Its strips in water of a density, kg/m3."""

    @property
    @abstractmethod
    def sources(self) -> str:
        """Where its coefficients are from."""


@named
@dataclass(frozen=True, kw_only=True)
class BoxPart(_Part):
    """A box, flat below: height along its z, upright where that is vertical.

    Parameters
    ----------
    size : array_like, shape (3,)
        m, along its axes.
    strips : tuple of int
        Into how many it is cut along x and y, each with a depth of its own: what turning adds follows.
    slam : float
        C_S of its bottom, at least 5: the added mass of the wet bottom is gained over the depth
        2 A_1 / (density C_S area).
    drag : float
        C_D along each axis, of the area across it. DNV-RP-N103 has 2.5 at least in waves (unverified).
    perforation : float
        Share of its faces that is open, 0 to 0.5: takes from its added mass.
    fill : float
        Share of its volume that keeps water out: 0 of an open frame.
    added_mass : array_like, shape (3,), optional
        kg along its axes in an unbounded fluid, before perforation, in place of that of its size.
    point, axes, source
        As of all parts: centre (m, body coordinates), axes (columns), and where coefficients are from.

    Notes
    -----
    Along z half of a plate's added mass is gained over that depth, the rest from awash on over the root of
    the area; along x and y all of it while the sides become wet. Both growths are assumed (unverified).
    """

    size: Any
    strips: tuple[int, int] = (1, 1)
    slam: float = 5.0
    drag: float = 2.5
    perforation: float = 0.0
    fill: float = 1.0
    added_mass: Any = None

    kind: ClassVar[str] = "box"

    def __post_init__(self) -> None:
        super().__post_init__()
        size = shaped_of(f"{self.kind}: size", self.size, (3,))
        for value in size:
            _length_of(f"{self.kind}: size", value)
        _check_strips(self.kind, self.strips, 2)
        _check_slam(self.kind, self.slam, LEAST_SLAM)
        not_negative_of(f"{self.kind}: drag", self.drag)
        share_of(f"{self.kind}: perforation", self.perforation, MOST_PERFORATION)
        share_of(f"{self.kind}: fill", self.fill, 1.0)
        if self.added_mass is not None:
            for value in shaped_of(f"{self.kind}: added_mass", self.added_mass, (3,)):
                not_negative_of(f"{self.kind}: added_mass", value, "kg")
            if not self.source:
                raise SceneError.of(
                    f"{self.kind}: added_mass", "has no source; say in source where it is from"
                )

    @property
    def extent(self) -> float:
        return float(np.max(np.asarray(self.size, dtype=float)))

    @property
    def sources(self) -> str:
        own = self.source or PLATE_SOURCE
        return f"{own}; C_S {self.slam:g}, C_D {self.drag:g}: DNV-RP-N103 (unverified)"

    def pieces(self, density: float) -> Iterator[Piece]:
        size = np.asarray(self.size, dtype=float)
        if not np.any(size):
            return
        depths, whole = self._growth(size, density)
        count = int(np.prod(self.strips))
        cut = size / np.array([*self.strips, 1.0])
        areas = np.array([size[1] * size[2], size[0] * size[2], size[0] * size[1]])
        for cell in _cells(size, self.strips):
            yield Piece(
                **cell, shape="box", size=cut, depths=depths, added_masses=whole / count,
                drag=0.5 * density * self.drag * areas / count, fill=self.fill,
            )  # fmt: skip

    def _growth(self, size: Array, density: float) -> tuple[Array, Array]:
        """Depths, and added masses (n, 3) of the whole at them."""
        holes = perforation_factor(self.perforation)
        deep = holes * (
            density * box_deep(size) if self.added_mass is None else np.asarray(self.added_mass, dtype=float)
        )
        area, height = size[0] * size[1], size[2]
        short, long = sorted(size[:2])
        plate = density * plate_factor(short / long if long else 1.0) * np.pi / 4.0 * short**2 * long
        bottom = min(0.5 * holes * plate, deep[2])
        over = 2.0 * bottom / (density * self.slam * area) if area else 0.0
        root = float(np.sqrt(area)) or self.extent
        over = over or 1e-3 * root
        awash = max(height, (1.0 + ROUNDING) * over)
        sides = max(height, over)
        ends = [(1.0 + ROUNDING) * over, (1.0 + ROUNDING) * sides, awash, awash + root]
        depths = _knots([(0.0, ends[0]), (0.0, ends[1]), (awash, ends[3])])
        upright = bottom * ramp(depths, over) + (deep[2] - bottom) * step(depths, awash, root)
        along = ramp(depths, sides)
        return depths, np.stack([deep[0] * along, deep[1] * along, upright], axis=1)


@named
@dataclass(frozen=True, kw_only=True)
class PlatePart(_Part):
    """A flat plate, thin along its z: a mudmat, a grating, a stiffened panel.

    Parameters
    ----------
    size : array_like, shape (2,)
        m, along its x and y.
    thickness : float
        m; 0 keeps no water out.
    strips, slam, drag, perforation, added_mass
        As of `BoxPart`.
    point, axes, source
        As of all parts: centre (m, body coordinates), axes (columns), and where coefficients are from.
    """

    size: Any
    thickness: float = 0.0
    strips: tuple[int, int] = (1, 1)
    slam: float = 5.0
    drag: float = 2.5
    perforation: float = 0.0
    added_mass: Any = None

    kind: ClassVar[str] = "plate"

    def __post_init__(self) -> None:
        super().__post_init__()
        shaped_of(f"{self.kind}: size", self.size, (2,))
        _length_of(f"{self.kind}: thickness", self.thickness)
        self._box()
        side = float(np.min(np.asarray(self.size, dtype=float)))
        if self.thickness >= max(THICK, 0.5 * side):
            warn_caller(
                f"plate: thickness is {self.thickness:.6g} m beside sides of {shown(self.size)} m: a slip in "
                "its unit? Give it in m, or a BoxPart",
                UnitWarning,
            )

    def _box(self) -> BoxPart:
        size = (*np.asarray(self.size, dtype=float), self.thickness)
        return BoxPart(
            point=self.point, axes=self.axes, source=self.source, size=size, strips=self.strips,
            slam=self.slam, drag=self.drag, perforation=self.perforation, fill=1.0 - self.perforation,
            added_mass=self.added_mass,
        )  # fmt: skip

    @property
    def extent(self) -> float:
        return self._box().extent

    @property
    def sources(self) -> str:
        return self._box().sources

    def pieces(self, density: float) -> Iterator[Piece]:
        yield from self._box().pieces(density)


@named
@dataclass(frozen=True, kw_only=True)
class CylinderPart(_Part):
    """A circular cylinder along its x.

    Parameters
    ----------
    length, diameter : float
        m.
    strips : int, optional
        Into how many it is cut along its length. Default: as many as make them as long as wide.
    slam : float
        C_S as it touches, pi (von Karman) or more: the first part of the added mass is then gained that
        much faster, within a tenth of the radius.
    drag : float
        C_D across, of diameter times length. Default 1.2: below its critical Reynolds number, DNV-RP-C205.
    ends : tuple of str
        What is at its first end (x < 0) and at its last: "closed", a disc; "open", the ring of its `wall`;
        "joined" to something else, with nothing of its own.
    end_drag : float
        C_D along it of what its ends close, half of it at each. Default 1.17: a thin disc.
    wall : float, optional
        m, thickness of a tube's wall; an open end needs it.
    flooded : bool, optional
        Of a tube: True where the water in it stands as high as outside. Its wall alone keeps water out then;
        what is in it goes along across, and also along it unless both ends are open. False: the whole
        keeps water out, or `add_entrapped_water` brings it in. An open end needs it.
    point, axes, source
        As of all parts: centre (m, body coordinates), axes (columns), and where coefficients are from.

    Notes
    -----
    Across, each circle has the added mass of its distance from the surface in its own plane: a cylinder that
    lies that of its depth, an upright one density pi/4 diameter^2 of what is wet (Morison's C_A of 1). Along
    it each closed end has that of one side of a disc, 4/3 density radius^3.
    """

    length: float
    diameter: float
    strips: int | None = None
    slam: float = CIRCLE_SLAM
    drag: float = 1.2
    ends: tuple[str, str] = (CLOSED, CLOSED)
    end_drag: float = DISC_DRAG
    wall: float | None = None
    flooded: bool | None = None

    kind: ClassVar[str] = "cylinder"

    def __post_init__(self) -> None:
        super().__post_init__()
        _length_of("cylinder: length", self.length)
        _length_of("cylinder: diameter", self.diameter)
        if self.strips is not None:
            _check_strips("cylinder", (self.strips,), 1)
        _check_slam("cylinder", self.slam, LEAST_SLAM_ROUND)
        not_negative_of("cylinder: drag", self.drag)
        not_negative_of("cylinder: end_drag", self.end_drag)
        self._check_tube()

    def _check_tube(self) -> None:
        ends = self.ends if isinstance(self.ends, tuple | list) else ()
        if len(ends) != 2 or not set(ends) <= {CLOSED, OPEN, JOINED}:
            raise SceneError.of(
                "cylinder: ends",
                f"is {shown(self.ends)}; give what its first end (x < 0) and its last are, "
                f"each {CLOSED!r}, {OPEN!r} or {JOINED!r}",
            )
        if self.wall is not None and not 0.0 < number_of("cylinder: wall", self.wall) <= 0.5 * self.diameter:
            raise SceneError.of(
                "cylinder: wall",
                f"is {self.wall:g} m; give its thickness in m, above 0 and up to half of the "
                f"diameter of {self.diameter:g} m",
            )
        if self.wall is None and (OPEN in ends or self.flooded):
            raise SceneError(
                "cylinder: an open or flooded tube needs the thickness of its wall; give wall in m"
            )
        if self.flooded is None and OPEN in ends:
            raise SceneError(
                "cylinder: has an open end; say flooded=True where the water in it stands as high as "
                "outside, flooded=False where nothing or add_entrapped_water brings it in"
            )

    @property
    def extent(self) -> float:
        return float(max(self.length, self.diameter))

    @property
    def sources(self) -> str:
        own = f"C_S {self.slam:.4g}, C_D {self.drag:g}, {self.end_drag:g} along it: DNV-RP-C205 (unverified)"
        return f"{self.source or CIRCLE_SOURCE}; {own}"

    def pieces(self, density: float) -> Iterator[Piece]:
        if self.length == 0.0 or self.diameter == 0.0:
            return
        radius = 0.5 * self.diameter
        count = self.strips or min(MOST_STRIPS, max(1, round(self.length / self.diameter)))
        shares, values = circle_table()
        faster = max(self.slam / CIRCLE_SLAM, 1.0)
        depths = radius * _wetted_at(shares, faster)
        hollow = self._hollow() if self.flooded else 0.0
        inside = hollow * disc_share(depths / radius)  # what is in it comes in as the circle becomes wet
        scale = density * radius**2 * self.length / count
        across, along = scale * (values + np.pi * inside), scale * np.pi * inside
        if self.ends[0] == self.ends[1] == OPEN:
            along = np.zeros_like(along)
        size = np.array([self.length / count, self.diameter, self.diameter])
        side = 0.5 * density * self.drag * self.diameter * self.length
        for cell in _cells(np.array([self.length, 0.0, 0.0]), (count, 1)):
            yield Piece(
                **cell, shape="cylinder", size=size, depths=depths, fill=1.0 - hollow,
                added_masses=np.stack([along, across, across], axis=1),
                drag=np.array([0.0, side, side]) / count,
            )  # fmt: skip
        for way, end in zip((-1.0, 1.0), self.ends, strict=True):
            if end != JOINED:
                yield self._end(way, density, end == OPEN)

    def _hollow(self) -> float:
        """Share of its section within the wall."""
        return float((1.0 - 2.0 * (self.wall or 0.0) / self.diameter) ** 2)

    def _end(self, way: float, density: float, is_open: bool) -> Piece:
        """The disc, or the ring, that closes its first (way -1) or its last end."""
        radius = 0.5 * self.diameter
        area, mass = np.pi * radius**2, disc_added_mass(radius)
        if is_open:
            area *= 1.0 - self._hollow()
            mass = min(mass, ring_added_mass(radius, float(self.wall or 0.0)))
        depths = radius * np.linspace(0.0, 2.0, RAMP_KNOTS + 1)
        return Piece(
            shape="disc", offset=np.array([0.5 * way * self.length, 0.0, 0.0]),
            size=np.array([mass / area, self.diameter, self.diameter]), depths=depths,
            added_masses=density * mass * np.outer(disc_share(depths / radius), (1.0, 0.0, 0.0)),
            drag=np.array([0.25 * density * self.end_drag * area, 0.0, 0.0]),
            turn=np.diag([way, way, 1.0]),
        )  # fmt: skip


@named
@dataclass(frozen=True, kw_only=True)
class SpherePart(_Part):
    """A sphere.

    Parameters
    ----------
    diameter : float
        m.
    drag : float
        C_D, of its cross-section. Default 0.5: below its critical Reynolds number (unverified).
    point, axes, source
        As of all parts: centre (m, body coordinates), axes (columns), and where coefficients are from.
    """

    diameter: float
    drag: float = 0.5

    kind: ClassVar[str] = "sphere"

    def __post_init__(self) -> None:
        super().__post_init__()
        _length_of("sphere: diameter", self.diameter)
        not_negative_of("sphere: drag", self.drag)

    @property
    def extent(self) -> float:
        return float(self.diameter)

    @property
    def sources(self) -> str:
        return f"{self.source or SPHERE_SOURCE}; C_D {self.drag:g} (unverified)"

    def pieces(self, density: float) -> Iterator[Piece]:
        if self.diameter == 0.0:
            return
        radius = 0.5 * self.diameter
        unbounded = 2.0 / 3.0 * np.pi * density * radius**3
        shares, values = sphere_table()
        slow = sphere_table(slow=True)[1]  # of heave; the others see half of a sphere in an unbounded fluid
        yield Piece(
            shape="sphere", offset=np.zeros(3), size=np.full(3, self.diameter), depths=radius * shares,
            added_masses=unbounded * np.outer(values, np.ones(3)),
            slow_added_masses=unbounded * np.stack([values, values, slow], axis=1),
            drag=np.full(3, 0.5 * density * self.drag * np.pi * radius**2),
        )  # fmt: skip


@named
@dataclass(frozen=True, kw_only=True)
class TablePart(_Part):
    """A part of any shape by tables over the depth of its lowest point, at whatever attitude.

    Parameters
    ----------
    height : float
        m, of which half is above its centre.
    depths : array_like, shape (n,)
        m, of its lowest point below the surface, from 0; the last values hold below.
    volumes : array_like, shape (n,)
        m3 that are wet.
    added_masses : array_like, shape (n, 3)
        kg along its axes; none may fall with depth.
    drag_area : array_like, shape (3,)
        C_D times area along its axes, m2.
    point, axes, source
        As of all parts: centre (m, body coordinates), axes (columns), and where coefficients are from;
        `source` is required.
    """

    height: float
    depths: Any
    volumes: Any
    added_masses: Any
    drag_area: Any = (0.0, 0.0, 0.0)

    kind: ClassVar[str] = "table"

    def __post_init__(self) -> None:
        super().__post_init__()
        positive_of("table: height", self.height, "m")
        depths = vector_of("table: depths", self.depths)
        for name in ("depths", "volumes"):
            for value in vector_of(f"table: {name}", getattr(self, name)):
                not_negative_of(f"table: {name}", value, "m" if name == "depths" else "m3")
        shaped_of("table: added_masses", self.added_masses, (len(depths), 3))
        for value in shaped_of("table: drag_area", self.drag_area, (3,)):
            not_negative_of("table: drag_area", value, "m2")
        if not self.source:
            raise SceneError("table: has no source; say where its coefficients are from")

    @property
    def extent(self) -> float:
        return float(self.height)

    @property
    def sources(self) -> str:
        return self.source

    def pieces(self, density: float) -> Iterator[Piece]:
        yield Piece(
            shape="table", offset=np.zeros(3), size=np.full(3, float(self.height)),
            depths=np.asarray(self.depths, dtype=float), volumes=np.asarray(self.volumes, dtype=float),
            added_masses=np.asarray(self.added_masses, dtype=float),
            drag=0.5 * density * np.asarray(self.drag_area, dtype=float),
        )  # fmt: skip


Part = BoxPart | PlatePart | CylinderPart | SpherePart | TablePart
PARTS: dict[str, type[Part]] = {
    kind.kind: kind for kind in (BoxPart, PlatePart, CylinderPart, SpherePart, TablePart)
}


def _wetted_at(shares: Array, faster: float) -> Array:
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


def _knots(stretches: list[tuple[float, float]]) -> Array:
    """Depths for a spline that is smooth over each of the stretches."""
    return np.unique(np.round(np.concatenate([np.linspace(*one, RAMP_KNOTS + 1) for one in stretches]), 12))


def _cells(size: Array, strips: tuple[int, int]) -> Iterator[dict[str, Any]]:
    """Where the cells of a part are that is cut along x and y, in rows along the way of more cells."""
    along = 0 if strips[0] >= strips[1] else 1
    count, steps = strips[along], size / np.array([*strips, 1.0])
    step = np.where(np.arange(3) == along, steps, 0.0) if count > 1 else np.zeros(3)
    for index in np.ndindex(*strips):
        offset = np.array([*((np.array(index) + 0.5) * steps[:2] - 0.5 * size[:2]), 0.0])
        yield {"offset": offset, "row": index[1 - along], "place": index[along], "count": count, "step": step}


def _check_strips(kind: str, strips: Any, count: int) -> None:
    numbers = strips if isinstance(strips, tuple | list) else ()
    whole = len(numbers) == count and all(
        isinstance(one, int | np.integer) and not isinstance(one, bool) and int(one) > 0 for one in numbers
    )
    if not whole or int(np.prod(strips)) > MOST_STRIPS:
        asked = strips[0] if count == 1 else strips
        raise SceneError.of(
            f"{kind}: strips", f"is {asked!r}; give whole numbers from 1, {MOST_STRIPS} in all at most"
        )


def _check_slam(kind: str, value: Any, least: float) -> None:
    if finite_of(f"{kind}: slam", value) < least:
        raise SceneError.of(
            f"{kind}: slam",
            f"is {number_of(f'{kind}: slam', value):g}; a C_S of {least:g} or more is meant "
            f"({'round' if least == LEAST_SLAM_ROUND else 'not round'})",
        )
    if value > MOST_SLAM:
        warn_caller(
            f"{kind}: slam is {float(value):.6g}, and no C_S is above {MOST_SLAM:g}: it is a ratio",
            UnitWarning,
        )


def _length_of(what: str, value: Any) -> None:
    if not_negative_of(what, value, "m") > LONGEST:
        raise SceneError.of(what, f"is {value:g} m; give a length in m, of {LONGEST:g} at the most")


def share_of(what: str, value: Any, most: float) -> None:
    if not 0.0 <= number_of(what, value) <= most:
        raise SceneError.of(what, f"is {value!r}; give a share from 0 to {most:g}")
