"""Whether a group is what its user takes it for: order, places, draughts, hulls that do not overlap."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike

from seacrane.errors import SceneError
from seacrane.hydro.data.hydro_group_data import HydroGroupData
from seacrane.hydro.group.gap import clearance

SAME_PLACE = 0.01  # m
SAME_DRAUGHT = 0.02  # of it


def require_group(
    group: HydroGroupData,
    *,
    names: Sequence[str] | None,
    positions: Mapping[str, ArrayLike] | None,
    draughts: Mapping[str, float] | None,
    apart: bool,
) -> None:
    """`HydroGroup.require`."""
    if names is not None and tuple(names) != group.names:
        fix = (
            "they stand in another order: use group.ordered(names)"
            if sorted(names) == sorted(group.names)
            else "name each of its bodies"
        )
        raise SceneError(
            f"group {group.name!r}: holds {', '.join(group.names)}, and {', '.join(map(str, names))} are "
            f"asked for; {fix}"
        )
    for what, given in (("positions", positions), ("draughts", draughts)):
        for name in given or {}:
            if name not in group.names:
                raise SceneError(
                    f"group {group.name!r}: {what} name {name!r}, which it has not; it has "
                    f"{', '.join(group.names)}"
                )
    for body in group.bodies:
        if positions and body.name in positions:
            place = np.asarray(positions[body.name], dtype=float)
            if place.shape != (3,) or not np.allclose(place, body.position, rtol=0.0, atol=SAME_PLACE):
                raise SceneError(
                    f"group {group.name!r}: {body.name} has its reference point at "
                    f"{_point(body.position)} m, not at "
                    f"{_point(place)}: its matrices are about another point; use that one, or compute "
                    "them anew"
                )
        if draughts and body.name in draughts:
            asked = float(draughts[body.name])
            if not abs(asked - body.draught) <= SAME_DRAUGHT * body.draught:
                raise SceneError(
                    f"group {group.name!r}: {body.name} was computed with a draught of "
                    f"{body.draught:.4g} m, and "
                    f"{asked:.4g} m is asked for; compute it at that draught"
                )
    if apart:
        require_apart(group)


def require_apart(group: HydroGroupData) -> None:
    """Raise where the boxes of two hulls overlap.

    A hull within the ring of another has an overlapping box, and is no mistake.
    """
    for first, second in combinations(group.bodies, 2):
        width, _ = clearance(first, second)
        if width < 0.0:
            raise SceneError(
                f"group {group.name!r}: {first.name} and {second.name} overlap by {-width:.3g} m, as "
                "boxes of "
                f"{first.length:.4g} x {first.breadth:.4g} m and {second.length:.4g} x "
                f"{second.breadth:.4g} m at "
                "their positions and headings; move them apart"
            )


def _point(values: ArrayLike) -> str:
    return "(" + ", ".join(f"{value:g}" for value in np.ravel(np.asarray(values, dtype=float))) + ")"
