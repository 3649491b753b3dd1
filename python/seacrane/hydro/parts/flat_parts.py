"""Parts of a load in the water that are flat below, and what all parts have."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.hydro.parts.added_mass import PLATE_SOURCE, box_deep, box_growth, perforation_factor
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import finite_of, not_negative_of, number_of, positive_of, shaped_of, text_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.warnings import UnitWarning

LEAST_SLAM_ROUND, LEAST_SLAM = 3.0, 5.0  # DNV-RP-N103 (unverified)
MOST_PERFORATION = 0.5  # where the factor ends
MOST_STRIPS = 1000
MOST_SLAM = 100.0
THICK = 0.5  # m: no plate is as thick, nor as half its side
LONGEST = 1e5  # m: no load is


def _length_of(what: str, value: Any) -> None:
    if not_negative_of(what, value, "m") > LONGEST:
        raise SceneError.of(what, f"is {value:g} m; give a length in m, of {LONGEST:g} at the most")


def share_of(what: str, value: Any, most: float) -> None:
    """Refuse what is no share up to the most."""
    if not 0.0 <= number_of(what, value) <= most:
        raise SceneError.of(what, f"is {value!r}; give a share from 0 to {most:g}")


CHECKS: Mapping[str, Callable[[str, Any], object]] = {  # of the fields of parts that have them
    "point": partial(shaped_of, shape=(3,)), "axes": partial(shaped_of, shape=(3, 3)), "source": text_of,
    "length": _length_of, "diameter": _length_of, "thickness": _length_of,
    "height": partial(positive_of, unit="m"), "drag": not_negative_of, "end_drag": not_negative_of,
    "perforation": partial(share_of, most=MOST_PERFORATION), "fill": partial(share_of, most=1.0),
}  # fmt: skip


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
class Shape(ABC):
    """What all parts have, as `BoxPart` says."""

    point: Any = (0.0, 0.0, 0.0)
    axes: Any = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    source: str = ""

    kind: ClassVar[str]

    def __post_init__(self) -> None:
        for name, check in CHECKS.items():
            if hasattr(self, name):
                check(f"{self.kind}: {name}", getattr(self, name))

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


@dataclass(frozen=True, kw_only=True)
class _Flat(Shape):
    """What is flat below."""

    size: Any
    strips: tuple[int, int] = (1, 1)
    slam: float = LEAST_SLAM
    drag: float = 2.5
    perforation: float = 0.0
    added_mass: Any = None

    sides: ClassVar[int]

    def __post_init__(self) -> None:
        super().__post_init__()
        for value in shaped_of(f"{self.kind}: size", self.size, (self.sides,)):
            _length_of(f"{self.kind}: size", value)
        check_strips(self.kind, self.strips, 2)
        check_slam(self.kind, self.slam, LEAST_SLAM)
        if self.added_mass is not None:
            what = f"{self.kind}: added_mass"
            for value in shaped_of(what, self.added_mass, (3,)):
                not_negative_of(what, value, "kg")
            if not self.source:
                raise SceneError.of(what, "has no source; say in source where it is from")

    @property
    @abstractmethod
    def _solid(self) -> tuple[Array, float]:
        """Its size (3,), m, and the share of its volume that keeps water out."""

    @property
    def extent(self) -> float:
        return float(np.max(self._solid[0]))

    @property
    def sources(self) -> str:
        own = self.source or PLATE_SOURCE
        return f"{own}; C_S {self.slam:g}, C_D {self.drag:g}: DNV-RP-N103 (unverified)"

    def pieces(self, density: float) -> Iterator[Piece]:
        size, fill = self._solid
        if not np.any(size):
            return
        holes = perforation_factor(self.perforation)
        deep = (
            density * box_deep(size) if self.added_mass is None else np.asarray(self.added_mass, dtype=float)
        )
        depths, whole = box_growth(size, holes * deep, density=density, holes=holes, slam=self.slam)
        count = int(np.prod(self.strips))
        areas = np.array([size[1] * size[2], size[0] * size[2], size[0] * size[1]])
        for cell in cells_of(size, self.strips):
            yield Piece(
                **cell, shape="box", size=size / np.array([*self.strips, 1.0]), depths=depths,
                added_masses=whole / count, drag=0.5 * density * self.drag * areas / count, fill=fill,
            )  # fmt: skip


@named
@dataclass(frozen=True, kw_only=True)
class BoxPart(_Flat):
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
        As of all parts: centre (m, body coordinates), axes (columns; default: those of the body), and where
        coefficients are from, which reports show beside the defaults that are kept.

    Notes
    -----
    Along z half of a plate's added mass is gained over that depth, the rest from awash on over the root of
    the area; along x and y all of it while the sides become wet. Both growths are assumed (unverified).
    """

    fill: float = 1.0

    kind: ClassVar[str] = "box"
    sides: ClassVar[int] = 3

    @property
    def _solid(self) -> tuple[Array, float]:
        return np.asarray(self.size, dtype=float), self.fill


@named
@dataclass(frozen=True, kw_only=True)
class PlatePart(_Flat):
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

    thickness: float = 0.0

    kind: ClassVar[str] = "plate"
    sides: ClassVar[int] = 2

    def __post_init__(self) -> None:
        super().__post_init__()
        side = float(np.min(np.asarray(self.size, dtype=float)))
        if self.thickness >= max(THICK, 0.5 * side):
            warn_caller(
                f"plate: thickness is {self.thickness:.6g} m beside sides of {shown(self.size)} m: a slip in "
                "its unit? Give it in m, or a BoxPart",
                UnitWarning,
            )

    @property
    def _solid(self) -> tuple[Array, float]:
        return np.array([*np.asarray(self.size, dtype=float), self.thickness]), 1.0 - self.perforation


def cells_of(size: Array, strips: tuple[int, int]) -> Iterator[dict[str, Any]]:
    """Where the cells of a part are that is cut along x and y, in rows along the way of more cells."""
    along = 0 if strips[0] >= strips[1] else 1
    count, steps = strips[along], size / np.array([*strips, 1.0])
    step = np.where(np.arange(3) == along, steps, 0.0) if count > 1 else np.zeros(3)
    for index in np.ndindex(*strips):
        offset = np.array([*((np.array(index) + 0.5) * steps[:2] - 0.5 * size[:2]), 0.0])
        yield {"offset": offset, "row": index[1 - along], "place": index[along], "count": count, "step": step}


def check_strips(kind: str, strips: Any, count: int) -> None:
    numbers = strips if isinstance(strips, tuple | list) else ()
    whole = len(numbers) == count and all(
        isinstance(one, int | np.integer) and not isinstance(one, bool) and int(one) > 0 for one in numbers
    )
    if not whole or int(np.prod(strips)) > MOST_STRIPS:
        asked = strips[0] if count == 1 else strips
        wanted = "a whole number" if count == 1 else "two whole numbers, along its x and along its y, each"
        raise SceneError.of(
            f"{kind}: strips", f"is {shown(asked)}; give {wanted} from 1, {MOST_STRIPS} in all at most"
        )


def check_slam(kind: str, value: Any, least: float) -> None:
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
