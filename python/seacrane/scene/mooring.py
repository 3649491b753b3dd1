"""Station keeping of a vessel: by a period, by a full stiffness matrix, or by horizontal springs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.description import GROUND, Description
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of, positive_of, shaped_of
from seacrane.inputs.frames import rotation_about_z
from seacrane.inputs.shown import shown
from seacrane.scene.springs import add_spring
from seacrane.warnings import OwnMooringWarning

HORIZONTAL = [0, 1, 5]  # surge, sway, yaw
FLOATING = slice(2, 5)  # heave, roll, pitch: what water restores
SMALL = 1e-9  # of the diagonals: rounding
SYMMETRIC = 1e-6
FAR = 1e6  # m, of the ends of springs: so far that they keep their directions
IN_PLANE = np.array([1.0, 1.0, 0.0, 0.0, 0.0, 1.0])
USUAL = 200.0  # s, of surge, sway and yaw (the paper's station keeping)


@dataclass(frozen=True, kw_only=True, eq=False)
class Mooring:
    """Parts of a mooring as a scene takes them.

    Attributes
    ----------
    matrix : (6, 6) All of it about the reference point.
    horizontal : (3,) Springs of surge, sway and yaw by themselves.
    floating : (3, 3) What joins the restoring of heave, roll and pitch.
    springs : tuple of (point, direction, stiffness)
        The rest, each along its line.
    left : (3,) Couplings of heave, roll and pitch with yaw that are in none of these.
    """

    matrix: Array
    horizontal: Array
    floating: Array
    springs: tuple[tuple[Array, Array, float], ...]
    left: Array


def parts_of(what: str, matrix: Array) -> Mooring:
    """A matrix as springs of surge, sway and yaw, restoring, and at most two springs along lines.

    Where surge and sway couple with nothing, they are springs by themselves. Else the lines take surge and
    sway with all that they couple; heave, roll, pitch and yaw keep what is left.
    """
    size = np.sqrt(np.abs(np.diagonal(matrix)))
    coupled = matrix - np.diag(np.diagonal(matrix))
    coupled[FLOATING, FLOATING] = coupled[FLOATING, 5] = coupled[5, FLOATING] = 0.0
    lines = np.zeros((0, 6))
    if np.any(np.abs(coupled) > SMALL * np.outer(size, size)):
        values, vectors = np.linalg.eigh(matrix[:2, :2])
        kept = values > SMALL * max(float(values.max()), 0.0)
        lines = _without_twist(what, (matrix[:, :2] @ vectors[:, kept] / np.sqrt(values[kept])).T)
    rest = matrix - lines.T @ lines
    alone = np.diagonal(rest)[HORIZONTAL].copy()
    if len(lines):
        alone[:2] = 0.0
    return Mooring(
        matrix=matrix, horizontal=np.maximum(alone, 0.0), floating=rest[FLOATING, FLOATING].copy(),
        springs=tuple(_line(wrench) for wrench in lines), left=rest[FLOATING, 5].copy(),
    )  # fmt: skip


def check_mooring(what: str, matrix: Array) -> None:
    skew = np.abs(matrix - matrix.T)
    if skew.max() > SYMMETRIC * np.abs(matrix).max():
        i, j = np.unravel_index(int(skew.argmax()), (6, 6))
        raise SceneError(
            f"{what}: mooring({i}, {j}) is {matrix[i, j]:.6g}, mooring({j}, {i}) is {matrix[j, i]:.6g}; "
            "springs have a symmetric matrix"
        )
    size = np.sqrt(np.abs(np.diagonal(matrix)))
    scaled = matrix / np.outer(*[np.where(size > 0.0, size, 1.0)] * 2)
    lowest = float(np.linalg.eigvalsh(0.5 * (scaled + scaled.T))[0])
    if lowest < -SYMMETRIC:
        raise SceneError.of(
            f"{what}: mooring",
            f"has a negative stiffness, {lowest:.3g} of its diagonals: it pushes the vessel "
            "away; check signs and couplings",
        )


def _without_twist(what: str, wrenches: Array) -> Array:
    """The given squares, by wrenches whose force and moment are at right angles: springs along lines.

    Rotating two of them among each other leaves the sum of their twists f . m, which has to be zero.
    """
    forces, moments = wrenches[:, :3], wrenches[:, 3:]
    twist = 0.5 * (forces @ moments.T + moments @ forces.T)
    size = np.linalg.norm(forces, axis=1) @ np.linalg.norm(moments, axis=1)
    if abs(np.trace(twist)) > SYMMETRIC * size:
        raise SceneError(
            f"{what}: mooring turns the vessel about the axis of its force, C14 + C25 come to "
            f"{np.trace(twist):.4g} N, which no springs do; both are zero for a symmetric mooring"
        )
    if len(wrenches) < 2:
        return wrenches
    half = 0.5 * np.arctan2(-twist[0, 0], twist[0, 1]) if np.any(np.abs(twist) > SYMMETRIC * size) else 0.0
    turn = np.array([[np.cos(half), np.sin(half)], [-np.sin(half), np.cos(half)]])
    return np.asarray(turn @ wrenches)


def _line(wrench: Array) -> tuple[Array, Array, float]:
    """Point, direction and stiffness of the spring with a wrench (6,) of sqrt(N/m) at right angles."""
    size = float(np.linalg.norm(wrench[:3]))
    direction = wrench[:3] / size
    return np.cross(direction, wrench[3:] / size), direction, size**2


@dataclass(frozen=True, kw_only=True)
class MooringSpring:
    """A horizontal spring of a mooring, without tension where the vessel starts.

    It keeps its direction: the line that it stands for is long against the vessel's motions.

    Parameters
    ----------
    point : array_like, shape (3,)
        Where it holds, m from the reference point, vessel's axes.
    direction_deg : float
        Where it leads, deg from the bow towards port, at the start.
    stiffness : float
        N/m. It pulls and pushes, as lines under tension do about their mean.
    """

    point: Any
    direction_deg: float
    stiffness: float

    def __post_init__(self) -> None:
        point = shaped_of("mooring spring: point", self.point, (3,))
        object.__setattr__(self, "point", tuple(point.tolist()))
        number_of("mooring spring: direction_deg", self.direction_deg)
        positive_of("mooring spring: stiffness", self.stiffness, "N/m")

    @property
    def direction(self) -> Array:
        """Unit vector (3,), vessel's axes."""
        angle = np.radians(self.direction_deg)
        return np.array([np.cos(angle), np.sin(angle), 0.0])


def mooring_matrix(springs: Sequence[MooringSpring]) -> Array:
    """Stiffness (6, 6) of horizontal springs about the reference point, N/m to N m/rad, vessel's axes.

    The sum of k n n^T with n = (u, p x u) for a spring of stiffness k at p along the unit vector u.
    """
    total = np.zeros((6, 6))
    for spring in springs:
        wrench = np.concatenate([spring.direction, np.cross(spring.point, spring.direction)])
        total += spring.stiffness * np.outer(wrench, wrench)
    return total


def mooring_of(what: str, given: Any) -> Mooring:
    """A mooring by its matrix or its springs. SceneError for what is neither, or pushes the vessel away."""
    if isinstance(given, Sequence) and all(isinstance(one, MooringSpring) for one in given):
        return Mooring(
            matrix=mooring_matrix(given), horizontal=np.zeros(3), floating=np.zeros((3, 3)),
            springs=tuple((np.array(s.point), s.direction, float(s.stiffness)) for s in given),
            left=np.zeros(3),
        )  # fmt: skip
    if isinstance(given, str) or np.ndim(given) != 2:
        raise SceneError.of(
            f"{what}: mooring",
            f"is {shown(given)}; give a natural period in s, a matrix (6, 6), or a list of MooringSpring",
        )
    matrix = shaped_of(f"{what}: mooring", given, (6, 6))
    check_mooring(what, matrix)
    parts = parts_of(what, 0.5 * (matrix + matrix.T))
    left = np.abs(parts.left)
    if np.any(left > SYMMETRIC * np.sqrt(np.abs(np.diagonal(matrix)[FLOATING] * matrix[5, 5]))):
        at = int(left.argmax())
        raise SceneError(
            f"{what}: mooring({at + 2}, 5) couples yaw with more than surge and sway explain: "
            f"{parts.left[at]:.4g} is left; give the springs themselves, mooring=[MooringSpring(...)]"
        )
    return parts


def chosen_mooring(what: str, database: HydroDatabase, mooring: Any) -> Mooring | float | None:
    """The one mooring of a vessel, as `add_vessel` takes it: parts, a natural period (s), or None for none.

    The restoring of the database may hold one of its own; raises SceneError for a second one.
    """
    number = np.ndim(mooring) == 0 and not isinstance(mooring, str)
    own = own_mooring(database)
    if own is not None:
        return _own(what, database, own, given=mooring is not None and not (number and mooring == USUAL))
    if mooring is None:
        return None
    if not number:
        return mooring_of(what, mooring)
    if not number_of(f"{what}: mooring", mooring) > 0.0:
        raise SceneError.of(f"{what}: mooring", f"is a period of {mooring:g} s; give a positive one")
    return float(mooring)


def _own(what: str, database: HydroDatabase, own: Array, *, given: bool) -> Mooring:
    surge, sway, yaw = np.diagonal(own)[HORIZONTAL]
    held = (
        f"{what}: the restoring of database {database.name!r} holds a mooring already "
        f"(C11 = {surge:.4g} N/m, C22 = {sway:.4g} N/m, C66 = {yaw:.4g} N m/rad)"
    )
    if given:
        raise SceneError(
            f"{held}, and a second one is given; leave it out to use the database's, or give "
            "database.without_mooring()"
        )
    warn_caller(
        f"{held}: it is used, in place of the usual period of {USUAL:g} s. Take database.without_mooring() "
        "for another one",
        OwnMooringWarning,
    )
    what = f"{what}, by its database"
    check_mooring(what, own * np.outer(IN_PLANE, IN_PLANE))
    return parts_of(what, own)


def with_mooring(restoring: Array, mooring: Mooring) -> Array:
    """Restoring (6, 6) of heave, roll and pitch alone, with what the mooring adds to them."""
    total = np.zeros((6, 6))
    total[FLOATING, FLOATING] = restoring[FLOATING, FLOATING] + mooring.floating
    return total


def add_mooring_springs(scene: Description, body: str, mooring: Mooring, *, pose: tuple[Any, float]) -> None:
    """Springs from the vessel to far ends on the ground; ``pose``: place (x, y, ...) in m and heading in rad.

    They are named "<body> mooring 1" and so on, and have no tension with the vessel afloat at that place.
    """
    place, heading = pose
    turned = rotation_about_z(heading)
    start = np.array([place[0], place[1], 0.0])
    for i, (point, direction, stiffness) in enumerate(mooring.springs):
        add_spring(
            scene, name=f"{body} mooring {i + 1}", first=body, second=GROUND, first_point=point,
            second_point=start + turned @ (point + FAR * direction), stiffness=stiffness,
            natural_length=FAR,
        )  # fmt: skip


def own_mooring(database: HydroDatabase) -> Array | None:
    """Stiffness (6, 6) that a database's restoring holds in surge, sway and yaw; None where it holds none.

    What heave, roll and pitch have among themselves stays with the restoring. C36, C46 and C56 are no sign of
    a mooring: they turn a residual trim or heel moment with the ship.
    """
    own = 0.5 * (database.restoring + database.restoring.T)
    own[FLOATING, FLOATING] = 0.0
    own[FLOATING, 5] = own[5, FLOATING] = 0.0
    size = np.abs(np.diagonal(database.restoring))
    held = np.diagonal(own)[HORIZONTAL] > SMALL * np.array([size[2], size[2], max(size[4], size[5])])
    return own if np.any(held) else None


def without_rounding(restoring: Array) -> Array:
    """Restoring (6, 6) without the rounding that files hold in surge, sway and yaw."""
    size = np.abs(np.diagonal(restoring)).copy()
    size[:2], size[5] = size[2], max(size[4], size[5])
    small = np.abs(restoring) <= SMALL * np.sqrt(np.outer(size, size))
    small[FLOATING, FLOATING] = False
    small &= restoring != 0.0
    return np.where(small, 0.0, restoring) if small.any() else restoring
