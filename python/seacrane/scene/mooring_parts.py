"""A stiffness matrix as a scene takes it: by motions, and by springs along lines where motions couple."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError

Array = NDArray[np.float64]

HORIZONTAL = [0, 1, 5]  # surge, sway, yaw
FLOATING = slice(2, 5)  # heave, roll, pitch: what water restores
SMALL = 1e-9  # of the diagonals: rounding
SYMMETRIC = 1e-6


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
        lines = _without_twist(what, _wrenches(matrix))
    rest = matrix - lines.T @ lines
    alone = np.diagonal(rest)[HORIZONTAL].copy()
    if len(lines):
        alone[:2] = 0.0
    return Mooring(
        matrix=matrix,
        horizontal=np.maximum(alone, 0.0),
        floating=rest[FLOATING, FLOATING].copy(),
        springs=tuple(_line(wrench) for wrench in lines),
        left=rest[FLOATING, 5].copy(),
    )


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
        raise SceneError(
            f"{what}: mooring has a negative stiffness, {lowest:.3g} of its diagonals: it pushes the vessel "
            "away; check signs and couplings"
        )


def _wrenches(matrix: Array) -> Array:
    """Rows (r, 6) whose squares give all rows of surge and sway of a stiffness matrix."""
    values, vectors = np.linalg.eigh(matrix[:2, :2])
    kept = values > SMALL * max(float(values.max()), 0.0)
    return np.asarray((matrix[:, :2] @ vectors[:, kept] / np.sqrt(values[kept])).T)


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
