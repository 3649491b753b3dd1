"""Parts of a load in the water: shapes with the coefficients of their added mass, slam and drag."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, get_args

import numpy as np

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.hydro.parts.added_mass import (
    CIRCLE_SOURCE,
    RAMP_KNOTS,
    SPHERE_SOURCE,
    circle_table,
    disc_added_mass,
    disc_share,
    ring_added_mass,
    sphere_table,
    wetted_at,
)
from seacrane.hydro.parts.flat_parts import (
    LEAST_SLAM_ROUND,
    MOST_STRIPS,
    BoxPart,
    Piece,
    PlatePart,
    Shape,
    cells_of,
    check_slam,
    check_strips,
)
from seacrane.inputs.checked import not_negative_of, number_of, positive_of, shaped_of, vector_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.inputs.values import made_of, value

CIRCLE_SLAM = np.pi  # von Karman: what the added mass of a circle gives as it touches
DISC_DRAG = 1.17  # C_D of a thin disc across the flow (Hoerner, Fluid-Dynamic Drag; unverified)
IN_LID = 1e-9  # of the height, as in the engine
CLOSED, OPEN, JOINED = "closed", "open", "joined"  # what an end of a cylinder is


@named
@dataclass(frozen=True, kw_only=True)
class CylinderPart(Shape):
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
        keeps water out, or a `Compartment` brings it in. An open end needs it.
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
        if self.strips is not None:
            check_strips("cylinder", (self.strips,), 1)
        check_slam("cylinder", self.slam, LEAST_SLAM_ROUND)
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
                "outside, flooded=False where nothing or a Compartment brings it in"
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
        depths = radius * wetted_at(shares, faster)
        hollow = self._hollow() if self.flooded else 0.0
        inside = hollow * disc_share(depths / radius)  # what is in it comes in as the circle becomes wet
        scale = density * radius**2 * self.length / count
        across, along = scale * (values + np.pi * inside), scale * np.pi * inside
        if self.ends[0] == self.ends[1] == OPEN:
            along = np.zeros_like(along)
        size = np.array([self.length / count, self.diameter, self.diameter])
        side = 0.5 * density * self.drag * self.diameter * self.length
        for cell in cells_of(np.array([self.length, 0.0, 0.0]), (count, 1)):
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
class SpherePart(Shape):
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
class TablePart(Shape):
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
        depths = vector_of("table: depths", self.depths)
        for name in ("depths", "volumes"):
            for one in vector_of(f"table: {name}", getattr(self, name)):
                not_negative_of(f"table: {name}", one, "m" if name == "depths" else "m3")
        shaped_of("table: added_masses", self.added_masses, (len(depths), 3))
        for one in shaped_of("table: drag_area", self.drag_area, (3,)):
            not_negative_of("table: drag_area", one, "m2")
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


@named
@dataclass(frozen=True, kw_only=True)
class Opening:
    """A hole in the wall of a compartment, small against its section.

    Parameters
    ----------
    point : array_like, shape (3,)
        Its centre, m, body coordinates, between bottom and top of the compartment.
    area : float
        m2, of the hole itself; the jet fills `discharge_coefficient` of it.
    """

    point: Any
    area: float

    def __post_init__(self) -> None:
        shaped_of("opening: point", self.point, (3,))
        positive_of("opening: area", self.area, "m2")


@value(_core.EntrappedWater)
class Compartment:
    """A compartment of a body, into which water comes, and which it leaves, through openings.

    It is a prism that stands on `point` along the body's z axis: a suction anchor, a tube, a bucket. Its
    openings are `Opening`, or tables {"point": ..., "area": ...}; 12 at most. By default `name` is "water in
    <body>". `air` is that above the water: "vented", coming and going by the openings alone, against their
    resistance; "free", against none; or "shut", whose mass stays while no opening lets air through, and which
    expands and is compressed. Default: "vented" with an opening in the lid; without one, it is asked for.
    """

    area: float  # m2
    height: float  # m
    openings: Any
    point: Any = (0.0, 0.0, 0.0)
    air: str | None = None
    exponent: float = 0.0
    air_pressure: float = 101325.0  # Pa
    discharge_coefficient: float = 0.6
    initial: float = 0.0  # m3
    name: str | None = None

    def __post_init__(self) -> None:
        given = self.openings
        if isinstance(given, Mapping | str) or not isinstance(given, Sequence) or not given:
            raise SceneError.of("compartment: openings", f"is {shown(given)}; give a list of Opening")
        holes = tuple(made_of("compartment", "openings", Opening, one) for one in given)
        object.__setattr__(self, "openings", holes)

    @property
    def air_above(self) -> str:
        """`air`, or what an opening in the lid says; "" is asked for when a scene is compiled."""
        bottom = shaped_of("compartment: point", self.point, (3,))[2]
        lid = bottom + (1.0 - IN_LID) * number_of("compartment: height", self.height)
        return self.air or ("vented" if any(hole.point[2] > lid for hole in self.openings) else "")


Part = BoxPart | PlatePart | CylinderPart | SpherePart | TablePart
PARTS: dict[str, type[Part]] = {kind.kind: kind for kind in get_args(Part)}
