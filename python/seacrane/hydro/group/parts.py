"""One hull of a group, the group in another order or without coupling, and a group of single databases."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.arrays import Array, Complex
from seacrane.errors import SceneError
from seacrane.hydro.data.excitation import force_at, full_circle
from seacrane.hydro.data.heading_circle import phase_at
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import GroupBody, HydroGroupData
from seacrane.hydro.data.memory_model import MODEL_MATRICES, MemoryModel
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.database.transform import motion_transform, point_of, warn_of_quadratic
from seacrane.hydro.memory.moved_memory import moved_memory

Group = TypeVar("Group", bound=HydroGroupData)

LIMITS = ("infinite_frequency_added_mass", "zero_frequency_added_mass")
MATRICES = ("added_mass", "damping", *LIMITS)
WATER = ("rho", "g", "depth")
OWN = (
    "mass_matrix", "restoring", "linear_damping", "quadratic_damping", "length", "breadth", "draught",
)  # fmt: skip
SAME = 1e-9
SAME_HEADING = 1e-6  # rad
ON_WATER = 1e-9  # m


def hull_of(group: HydroGroupData, name: str) -> HydroDatabase:
    """One hull while the others are held at rest beside it: its own blocks, forces with shielding.

    It is not the hull alone: the others reflect its waves, and shield it. Waves have zero phase at its
    reference point, headings count from its own x axis.
    """
    at = group.place(name)
    body = group.bodies[at.start // 6]
    own = np.mod(group.heading - body.heading, 2.0 * np.pi)
    own[2.0 * np.pi - own < SAME_HEADING] = 0.0
    order = np.argsort(own)
    shared = (*WATER, "omega", "trusted_band", "port_starboard_symmetric")
    return HydroDatabase(
        name=f"{group.name}/{name}",
        heading=own[order],
        force=(group.force[:, :, at] * phase_at_body(group, body))[order],
        **_matrices(group, lambda whole: whole[..., at, at]),
        **_entries(body, OWN),
        **_entries(group, shared),
        origin=f"reference point of {name}, {place_of(body.position)} m from the {group.origin}",
        source=f"{group.source}; {name} with the others held at rest beside it",
    )


def _matrices(group: HydroGroupData, change: Callable[[Array], Array]) -> dict[str, Any]:
    """Matrices of radiation that the group has, each changed."""
    return {name: change(one) for name in MATRICES if (one := getattr(group, name)) is not None}


def _entries(part: Any, names: Sequence[str]) -> dict[str, Any]:
    return {name: getattr(part, name) for name in names}


def phase_at_body(group: HydroGroupData, body: GroupBody) -> Complex:
    """`phase_at` of a body's reference point."""
    return phase_at(body.position, group.omega, group.heading, g=group.g, depth=group.depth)


def ordered_group(group: Group, names: Sequence[str]) -> Group:
    """The same group with its bodies in another order; a memory moves along.

    Raises
    ------
    ValueError : not each body once.
    """
    if sorted(names) != sorted(group.names):
        raise ValueError(
            f"group {group.name!r}: the order {', '.join(map(str, names))} does not name each of "
            f"{', '.join(group.names)} once"
        )
    at = np.concatenate([np.arange(6) + group.place(name).start for name in names])
    moved = replace(
        group,
        bodies=tuple(group.bodies[group.names.index(name)] for name in names),
        **_matrices(group, lambda whole: whole[..., at, :][..., at]),
        force=group.force[:, :, at],
        memory=None,
    )
    return moved if group.memory is None else replace(moved, memory=_ordered_memory(group.memory, at))


def _ordered_memory(memory: MemoryModel, at: NDArray[np.intp]) -> MemoryModel:
    """The memory with motion ``at[i]`` in place i."""
    now = np.argsort(at)

    def pair(j: int, k: int) -> tuple[int, int]:
        low, high = sorted(now[[j, k]].tolist())
        return low, high

    blocks = [replace(one, outputs=now[one.outputs], inputs=now[one.inputs]) for one in memory.blocks]
    rows = []
    for row in memory.rows:
        low, high = pair(row.output, row.input)
        rows.append(replace(row, output=low, input=high))
    motion = memory.motion
    if motion is not None:
        error = replace(motion.error, seas=motion.error.seas[at], peaks=motion.error.peaks[at])
        motion = replace(motion, error=error, left_out=tuple(sorted(pair(*one) for one in motion.left_out)))
    matrices = {name: getattr(memory, name)[np.ix_(at, at)] for name in MODEL_MATRICES}
    return replace(memory, blocks=tuple(blocks), rows=tuple(rows), motion=motion, **matrices)


def uncoupled_group(group: Group) -> Group:
    """The group whose hulls do not feel each other's motions: no blocks beside the diagonal, no memory.

    Forces stay as they are, with the shielding.
    """
    own = np.kron(np.eye(len(group.bodies)), np.ones((6, 6)))
    apart = _matrices(group, lambda whole: whole * own)
    return replace(group, **apart, memory=None, source=f"{group.source}; without coupling")


def group_of_databases(
    kind: type[Group],
    databases: Mapping[str, HydroData],
    positions: Mapping[str, ArrayLike],
    headings: Mapping[str, float],
    name: str,
) -> Group:
    """`HydroGroup.from_databases`."""
    _check_alike(name, databases)
    unknown = sorted({*positions, *headings} - set(databases))
    missing = sorted(set(databases) - set(positions))
    if unknown or missing:
        wrong = f"no database is named {unknown[0]!r}" if unknown else f"{missing[0]!r} has no position"
        raise ValueError(f"group {name!r}: {wrong}; give databases and positions of the same names")
    bodies = tuple(
        GroupBody(
            name=label,
            position=np.asarray(positions[label], dtype=float),
            heading=float(headings.get(label, 0.0)),
            **_entries(database, OWN),
        )
        for label, database in databases.items()
    )
    first = next(iter(databases.values()))
    keeps = all(
        body.position[1] == 0.0 and abs(np.sin(body.heading)) < SAME_HEADING and data.port_starboard_symmetric
        for body, data in zip(bodies, databases.values(), strict=True)
    )
    circle = first.heading if keeps else full_circle(first)[0]
    k = 6 * len(bodies)
    matrices: dict[str, Any] = {}
    for key in MATRICES:
        parts = [getattr(database, key) for database in databases.values()]
        if all(part is not None for part in parts):
            matrices[key] = np.zeros((*parts[0].shape[:-2], k, k))
            for i, part in enumerate(parts):
                matrices[key][..., 6 * i : 6 * i + 6, 6 * i : 6 * i + 6] = part
    force = np.concatenate(
        [_forces(data, circle - body.heading) for body, data in zip(bodies, databases.values(), strict=True)],
        axis=2,
    )
    bands = [database.trusted_band for database in databases.values() if database.trusted_band is not None]
    band = (max(low for low, _ in bands), min(high for _, high in bands)) if bands else None
    group = kind(
        name=name, bodies=bodies, omega=first.omega, heading=circle, **matrices, force=force,
        **_entries(first, WATER), trusted_band=band, port_starboard_symmetric=keeps,
        origin="group's origin, on the still waterline",
        source="hulls without interaction: " + "; ".join(data.source for data in databases.values()),
    )  # fmt: skip
    phases = np.concatenate([np.repeat(phase_at_body(group, body), 6, axis=2) for body in bodies], axis=2)
    return replace(group, force=force / phases)


def _check_alike(name: str, databases: Mapping[str, HydroData]) -> None:
    """One water, one set of frequencies, and nothing that has no place in a group."""
    first_name, first = next(iter(databases.items()))
    for label, database in databases.items():
        if database.additional or database.roll_damping is not None or database.speed != 0.0:
            raise ValueError(
                f"database {database.name!r}: has additional matrices, tabulated roll damping or a forward "
                "speed, which a group does not take; use with_roll_damping(), and a database without them"
            )
        for what in WATER:
            ours, theirs = float(getattr(first, what)), float(getattr(database, what))
            if not np.isclose(ours, theirs, rtol=SAME, atol=0.0):
                raise ValueError(
                    f"group {name!r}: {what} is {ours:g} in {first_name!r} and {theirs:g} in {label!r}; a "
                    "group has one water: compute both in the same"
                )
        if not np.array_equal(first.omega, database.omega):
            raise ValueError(
                f"group {name!r}: {first_name!r} and {label!r} have other frequencies; compute both at "
                "the same"
            )


def _forces(database: HydroData, heading: Array) -> Complex:
    """Forces (q, n, 6) at headings (q,): the stored ones where all are stored, else by splines."""
    circle, table = full_circle(database)
    distance = np.abs(np.angle(np.exp(1j * (heading[:, None] - circle))))
    if np.all(distance.min(axis=1) < SAME_HEADING):
        return np.asarray(table[distance.argmin(axis=1)])
    return force_at(database, database.omega, heading[:, None])


def place_of(point: ArrayLike) -> str:
    """A point in m, for messages."""
    return "(" + ", ".join(f"{value:g}" for value in np.ravel(np.asarray(point, dtype=float))) + ")"


def moved_group(group: Group, points: Mapping[str, ArrayLike]) -> Group:
    """The same hulls about other reference points; nothing is fitted or interpolated anew.

    Matrices, forces and the memory model (with the same states) are moved exactly; waves keep their zero
    phase at the group's origin.

    Parameters
    ----------
    points : by body, (3,) m from its present reference point, in its own axes; a hull that is not named
        keeps its own. Off the group's x axis the headings of both sides are written out.

    Warns
    -----
    seacrane.warnings.QuadraticDampingWarning : quadratic damping of a translation cannot be moved.

    Raises
    ------
    SceneError : no body of a name, or a point that is not three finite numbers.
    """
    unknown = [name for name in points if name not in group.names]
    if unknown:
        raise SceneError(f"group {group.name!r}: has no body {unknown[0]!r}; it has {', '.join(group.names)}")
    from scipy.linalg import block_diag

    levers = [
        point_of(f"group {group.name!r}: point of {name!r}", points.get(name, (0.0, 0.0, 0.0)))
        for name in group.names
    ]
    if not np.any(levers):
        return group
    transforms = [motion_transform(lever) for lever in levers]
    whole = np.asarray(block_diag(*transforms))
    bodies = tuple(map(_moved_body, group.bodies, levers, transforms))
    changes = _matrices(group, lambda matrix: np.asarray(whole.T @ matrix @ whole))
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


def _moved_body(body: GroupBody, lever: Array, transform: Array) -> GroupBody:
    cos, sin = np.cos(body.heading), np.sin(body.heading)
    turn = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    warn_of_quadratic(f"body {body.name!r}", body.quadratic_damping, transform)
    return replace(
        body,
        position=body.position + turn @ lever,
        **{
            name: transform.T @ matrix @ transform
            for name in ("mass_matrix", "restoring", "linear_damping")
            if (matrix := getattr(body, name)) is not None
        },
    )
