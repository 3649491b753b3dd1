"""What readers of several bodies share: values by body, and whether a group has two like sides."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.group_body import GroupBody
from seacrane.hydro.data.heading_circle import keeps_sides_apart
from seacrane.hydro.group.group import HydroGroup
from seacrane.hydro.group.long_wave import long_wave_lift
from seacrane.hydro.readers.equivalent_box import equivalent_box

FloatArray = NDArray[np.float64]

LIFT_LIMIT = 0.1  # of C33


def of_each(
    path: Path, what: str, names: Sequence[str], given: Mapping[str, ArrayLike], shape: tuple[int, ...]
) -> list[FloatArray]:
    """The caller's array of each body, in the order of the file's names.

    Raises FileFormatError: other names than those of the file, or another shape.
    """
    if set(given) != set(names):
        raise FileFormatError(
            f"{path}: holds bodies {', '.join(names)[:200]}; {what} are given for "
            f"{', '.join(map(str, given))[:200] or 'none'}: name each of them"
        )
    arrays = [np.array(given[name], dtype=float) for name in names]
    for name, array in zip(names, arrays, strict=True):
        if array.shape != shape or not np.all(np.isfinite(array)):
            raise FileFormatError(f"{path}: {what} of {name} has shape {array.shape}; {shape} finite numbers")
    return arrays


def box_of(
    path: Path, name: str, restoring: FloatArray, volume: float, weight_density: float
) -> dict[str, Any]:
    """Length, breadth and draught of a body's equivalent box, m; `equivalent_box` with the body's name.

    Raises FileFormatError: nothing floats on such a waterplane, or C55 is that of all bodies together.
    """
    if not restoring[4, 4] > 0.0:
        raise FileFormatError(
            f"{path}: body {name}: restoring C33 = {restoring[2, 2]:.6g} N/m and C55 = {restoring[4, 4]:.6g} "
            "N m/rad; both have to be positive in a group: check whether they are this body's own"
        )
    try:
        length, breadth, draught = equivalent_box(restoring, volume, weight_density)
    except ValueError as error:
        raise FileFormatError(f"{path}: body {name}: {error}") from error
    return {"length": length, "breadth": breadth, "draught": draught}


def group_symmetric(bodies: Sequence[GroupBody], added_mass: FloatArray) -> bool:
    """Whether port mirrors starboard: every body on the x axis, not turned, and alike to both sides."""
    on_axis = all(body.position[1] == 0.0 and body.heading == 0.0 for body in bodies)
    return bool(on_axis and keeps_sides_apart(added_mass))


def require_own_hydrostatics(path: Path, group: HydroGroup, fix: str) -> None:
    """Raise unless a long wave lifts each body with its own C33, as it does whatever lies beside it.

    Files by body that stand in another order, or that hold all bodies together, fail it. Nothing is told
    where no wave is long enough.
    """
    lift = long_wave_lift(group)
    if lift is None:
        return
    stiffness = np.array([body.restoring[2, 2] for body in group.bodies])
    off = np.abs(stiffness / lift - 1.0)
    if off.max() <= LIFT_LIMIT:
        return
    at = int(off.argmax())
    others = [i for i in range(len(lift)) if i != at and abs(stiffness[at] / lift[i] - 1.0) <= LIFT_LIMIT]
    guess = (
        "all bodies together, perhaps"
        if not others
        else f"{group.names[others[0]]}: they stand in another order"
    )
    raise FileFormatError(
        f"{path}: the restoring of {group.names[at]} has C33 = {stiffness[at]:.4g} N/m, and a wave of "
        f"{group.omega[0]:.3g} rad/s lifts it with {lift[at]:.4g} N/m: it is that of {guess}. Give {fix}"
    )
