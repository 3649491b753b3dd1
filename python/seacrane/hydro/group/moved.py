"""A group about other reference points of its hulls: exact, as `HydroDatabase.at` is of one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import SceneError
from seacrane.hydro.data.excitation import full_circle
from seacrane.hydro.data.group_body import GroupBody
from seacrane.hydro.data.hydro_group_data import HydroGroupData
from seacrane.hydro.database.transform import motion_transform, warn_of_quadratic
from seacrane.hydro.memory.moved_memory import moved_memory
from seacrane.inputs.checked import shaped_of

FloatArray = NDArray[np.float64]
Group = TypeVar("Group", bound=HydroGroupData)
MATRICES = ("added_mass", "damping", "infinite_frequency_added_mass", "zero_frequency_added_mass")
ON_WATER = 1e-9  # m


def moved_group(group: Group, points: Mapping[str, ArrayLike]) -> Group:
    """`HydroGroup.at`."""
    unknown = [name for name in points if name not in group.names]
    if unknown:
        raise SceneError(f"group {group.name!r}: has no body {unknown[0]!r}; it has {', '.join(group.names)}")
    from scipy.linalg import block_diag

    levers = [_lever(group, body, points.get(body.name)) for body in group.bodies]
    if not np.any(levers):
        return group
    transforms = [motion_transform(lever) for lever in levers]
    whole = np.asarray(block_diag(*transforms))
    bodies = tuple(
        _moved_body(body, lever, transform)
        for body, lever, transform in zip(group.bodies, levers, transforms, strict=True)
    )
    changes: dict[str, Any] = {
        name: whole.T @ getattr(group, name) @ whole for name in MATRICES if getattr(group, name) is not None
    }
    heading, force, symmetric = group.heading, group.force, group.port_starboard_symmetric
    if symmetric and any(body.position[1] != 0.0 for body in bodies):
        (heading, force), symmetric = full_circle(group), False
    moved = replace(
        group, **changes, bodies=bodies, heading=heading, force=force @ whole, memory=None,
        port_starboard_symmetric=symmetric,
    )  # fmt: skip
    return moved if group.memory is None else replace(moved, memory=moved_memory(group.memory, whole, moved))


def afloat(group: Group) -> Group:
    """The group with every reference point on the still water, above or below where it was."""
    away = {body.name: (0.0, 0.0, -body.position[2]) for body in group.bodies}
    return moved_group(group, {name: point for name, point in away.items() if abs(point[2]) > ON_WATER})


def _lever(group: HydroGroupData, body: GroupBody, point: ArrayLike | None) -> FloatArray:
    if point is None:
        return np.zeros(3)
    found = shaped_of(f"group {group.name!r}: point of {body.name!r}", point, (3,))
    if not np.all(np.isfinite(found)):
        raise SceneError(f"group {group.name!r}: point of {body.name!r} is {found}; give finite m")
    return found


def _moved_body(body: GroupBody, lever: FloatArray, transform: FloatArray) -> GroupBody:
    cos, sin = np.cos(body.heading), np.sin(body.heading)
    turn = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    warn_of_quadratic(f"body {body.name!r}", body.quadratic_damping, transform)
    return replace(
        body,
        position=body.position + turn @ lever,
        **{
            name: transform.T @ getattr(body, name) @ transform
            for name in ("mass_matrix", "restoring", "linear_damping")
        },
    )
