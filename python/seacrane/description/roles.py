"""The parts of a crane by the work they do: slew drive, cylinders, ropes, link, payload, tip and capacity."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, rows_of, shaped_of
from seacrane.inputs.read_only import ReadOnly
from seacrane.inputs.shown import shown

LARGEST_FACTOR = 10.0
Capacity = tuple[tuple[float, float], ...]  # radius, m, and load, kg
Areas = tuple[float, float]  # full side and rod side, m2
Vector = tuple[float, float, float]
Block = tuple[str, Vector]


def capacity_of(what: str, given: Any) -> Capacity:
    """Rows of radius and load, the radii increasing; SceneError for anything else."""
    rows = rows_of(f"{what}: capacity", given, 2)
    if not np.all(np.isfinite(rows)) or np.any(rows <= 0.0) or np.any(np.diff(rows[:, 0]) <= 0.0):
        raise SceneError.of(
            f"{what}: capacity",
            f"is {rows.tolist()}; give rows of radius (m, increasing) and load (kg), all above zero",
        )
    return tuple((float(radius), float(load)) for radius, load in rows)


def design_factor_of(what: str, given: Any) -> float:
    """The dynamic factor that a table contains; SceneError below 1."""
    factor = number_of(f"{what}: design_factor", given)
    if not 1.0 <= factor <= LARGEST_FACTOR:
        raise SceneError.of(
            f"{what}: design_factor",
            f"is {factor:g}; give the dynamic factor that the capacity contains, from "
            f"1 to {LARGEST_FACTOR:g}",
        )
    return factor


def allowed_at(capacity: Capacity, radius: ArrayLike) -> Array:
    """Loads (kg) at radii: linear between rows, that of the first below it, none beyond the last."""
    radii, loads = zip(*capacity, strict=True)
    return np.asarray(np.interp(np.asarray(radius, dtype=float), radii, loads, right=0.0))


def areas_of(what: str, given: Any) -> Areas:
    """Full side and rod side of a piston, m2; SceneError for what is no cylinder."""
    full, ring = (float(value) for value in shaped_of(f"{what}: areas", given, (2,)))
    if not (np.isfinite(full) and 0.0 < ring <= full):
        raise SceneError.of(
            f"{what}: areas",
            f"are {full:g} and {ring:g} m2; give the full side and then the rod side, which is "
            "above zero and not larger",
        )
    return full, ring


def areas_by_label(what: str, given: Any, cylinders: Mapping[str, str]) -> dict[str, Areas]:
    """Areas by the labels of cylinders."""
    if not isinstance(given, Mapping):
        raise SceneError.of(
            f"{what}: areas", f"are {shown(given)}; give {{label: (full side, rod side)}}, m2"
        )
    require_cylinders(f"{what}: areas are", given, cylinders)
    return {label: areas_of(f"{what}: cylinder {label!r}", pair) for label, pair in given.items()}


def require_cylinders(what: str, labels: Iterable[str], cylinders: Mapping[str, str]) -> None:
    """SceneError for something that is given of a cylinder which is not there."""
    for label in labels:
        if label not in cylinders:
            known = ", ".join(map(repr, cylinders)) or "none"
            raise SceneError(f"{what} given of cylinder {label!r}; the cylinders are {known}")


def pressure(force: ArrayLike, areas: Areas) -> Array:
    """Pressure (Pa) of the chamber that carries a force (N; positive pushes), the other one being relieved:
    positive on the full side, negative on the rod side."""
    loads = np.asarray(force, dtype=float)
    return np.asarray(np.where(loads >= 0.0, loads / areas[0], loads / areas[1]))


@dataclass(frozen=True, kw_only=True)
class LuffingRope:
    """A rope of several falls between blocks on both sides of a hinge."""

    name: str  # of the line that stands for it once it is one, see `Scene.add_winch`
    falls: int  # parts of rope between the blocks; all carry the same tension
    EA: float  # axial stiffness of one fall, N
    first: Block  # body and point in its coordinates, m
    second: Block  # which moves with the hinge


def lengthening(hinge: Array, axis: Array, first: Array, second: Array) -> float:
    """Rate of the distance between two blocks per rate of a hinge's angle, m/rad, by a point of the hinge and
    its unit vector; (3,) in one frame, m."""
    along = (second - first) / np.linalg.norm(second - first)
    return float(along @ np.cross(axis, second - hinge))


@dataclass(frozen=True, kw_only=True)
class CraneRoles:
    """Which elements of a scene are the parts of one crane. Channels, figures and studies read it.

    Its attributes are the words of `Scene.add_roles`, as they were given or found: labels are without the
    prefix, a drive is a joint and its coordinate, and what is not known is None or empty.
    """

    prefix: str = ""
    slew: tuple[str, str] | None = None
    cylinders: Mapping[str, str] = field(default_factory=dict)
    link: str | None = None
    payload: str | None = None
    tip: tuple[str, Vector] | None = None
    capacity: Capacity = ()
    areas: Mapping[str, Areas] = field(default_factory=dict)
    luffs: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    ropes: Mapping[str, LuffingRope] = field(default_factory=dict)
    held: bool = False
    design_factor: float = 1.0
    line: str | None = None
    structure: str | None = None

    def __post_init__(self) -> None:
        for name in ("cylinders", "areas", "luffs", "ropes"):
            object.__setattr__(self, name, ReadOnly(getattr(self, name)))
