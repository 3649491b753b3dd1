"""One hull of a group, the group in another order or without coupling, and a group of single databases."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.hydro.data.excitation import force_at, full_circle
from seacrane.hydro.data.group_body import GroupBody
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import HydroGroupData
from seacrane.hydro.data.memory_model import MemoryBlock, MemoryModel
from seacrane.hydro.database.database import HydroDatabase
from seacrane.sea.dispersion import wavenumber

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
Group = TypeVar("Group", bound=HydroGroupData)

LIMITS = ("infinite_frequency_added_mass", "zero_frequency_added_mass")
SAME = 1e-9
SAME_HEADING = 1e-6  # rad


def hull_of(group: HydroGroupData, name: str) -> HydroDatabase:
    """`HydroGroup.__getitem__`."""
    at = group.place(name)
    body = group.bodies[at.start // 6]
    own = np.mod(group.heading - body.heading, 2.0 * np.pi)
    own[2.0 * np.pi - own < SAME_HEADING] = 0.0
    order = np.argsort(own)
    force = group.force[:, :, at] * phase_at_body(group, body)
    limits: dict[str, Any] = {
        key: None if (whole := getattr(group, key)) is None else whole[at, at] for key in LIMITS
    }
    return HydroDatabase(
        name=f"{group.name}/{name}",
        omega=group.omega,
        heading=own[order],
        added_mass=group.added_mass[:, at, at],
        damping=group.damping[:, at, at],
        force=force[order],
        mass_matrix=body.mass_matrix,
        restoring=body.restoring,
        linear_damping=body.linear_damping,
        quadratic_damping=body.quadratic_damping,
        **limits,
        rho=group.rho,
        g=group.g,
        depth=group.depth,
        length=body.length,
        breadth=body.breadth,
        draught=body.draught,
        trusted_band=group.trusted_band,
        port_starboard_symmetric=group.port_starboard_symmetric,
        origin=f"reference point of {name}, {_place(body.position)} m from the {group.origin}",
        source=f"{group.source}; {name} with the others held at rest beside it",
    )


def phase_at_body(group: HydroGroupData, body: GroupBody) -> ComplexArray:
    """Factor (m, n, 1) that gives waves of zero phase at the body: exp(+i k (x cos b + y sin b))."""
    along = body.position[0] * np.cos(group.heading) + body.position[1] * np.sin(group.heading)
    k = wavenumber(group.omega, g=group.g, depth=group.depth)
    return np.asarray(np.exp(1j * np.outer(along, k)))[:, :, None]


def ordered_group(group: Group, names: Sequence[str]) -> Group:
    """`HydroGroup.ordered`."""
    if sorted(names) != sorted(group.names):
        raise ValueError(
            f"group {group.name!r}: the order {', '.join(map(str, names))} does not name each of "
            f"{', '.join(group.names)} once"
        )
    at = np.concatenate([np.arange(6) + group.place(name).start for name in names])
    square = np.ix_(at, at)
    limits: dict[str, Any] = {
        key: None if (whole := getattr(group, key)) is None else whole[square] for key in LIMITS
    }
    moved = replace(
        group,
        bodies=tuple(group.bodies[group.names.index(name)] for name in names),
        added_mass=group.added_mass[:, at][:, :, at],
        damping=group.damping[:, at][:, :, at],
        force=group.force[:, :, at],
        **limits,
        memory=None,
    )
    return moved if group.memory is None else replace(moved, memory=_ordered_memory(group.memory, at))


def _ordered_memory(memory: MemoryModel, at: NDArray[np.intp]) -> MemoryModel:
    """The memory with motion ``at[i]`` in place i."""
    now = np.argsort(at)
    square = np.ix_(at, at)
    blocks: tuple[MemoryBlock, ...] = tuple(
        replace(block, outputs=now[block.outputs], inputs=now[block.inputs]) for block in memory.blocks
    )
    rows = tuple(
        replace(row, output=min(pair), input=max(pair))
        for row in memory.rows
        for pair in [(int(now[row.output]), int(now[row.input]))]
    )
    motion = memory.motion
    if motion is not None:
        error = replace(motion.error, seas=motion.error.seas[at], peaks=motion.error.peaks[at])
        left_out = tuple(sorted((min(p), max(p)) for j, k in motion.left_out for p in [(now[j], now[k])]))
        motion = replace(motion, error=error, left_out=left_out)
    return replace(
        memory,
        blocks=blocks,
        rows=rows,
        motion=motion,
        added_mass=memory.added_mass[square],
        additional_added_mass=memory.additional_added_mass[square],
        additional_stiffness=memory.additional_stiffness[square],
    )


def uncoupled_group(group: Group) -> Group:
    """`HydroGroup.without_coupling`."""
    own = np.kron(np.eye(len(group.bodies)), np.ones((6, 6)))
    limits: dict[str, Any] = {
        key: None if (whole := getattr(group, key)) is None else whole * own for key in LIMITS
    }
    return replace(
        group,
        added_mass=group.added_mass * own,
        damping=group.damping * own,
        **limits,
        memory=None,
        source=f"{group.source}; without coupling",
    )


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
        _body_of(label, database, positions[label], headings.get(label, 0.0))
        for label, database in databases.items()
    )
    first = next(iter(databases.values()))
    keeps = all(
        body.position[1] == 0.0 and abs(np.sin(body.heading)) < SAME_HEADING and data.port_starboard_symmetric
        for body, data in zip(bodies, databases.values(), strict=True)
    )
    circle = first.heading if keeps else full_circle(first)[0]
    n, k = len(first.omega), 6 * len(bodies)
    tables: dict[str, Any] = {key: np.zeros((n, k, k)) for key in ("added_mass", "damping")}
    limits: dict[str, Any] = {key: np.zeros((k, k)) for key in LIMITS}
    force = np.zeros((len(circle), n, k), dtype=complex)
    for i, (body, database) in enumerate(zip(bodies, databases.values(), strict=True)):
        at = slice(6 * i, 6 * i + 6)
        for key, table in tables.items():
            table[:, at, at] = getattr(database, key)
        for key in LIMITS:
            whole, part = limits[key], getattr(database, key)
            if whole is None or part is None:
                limits[key] = None
            else:
                whole[at, at] = part
        force[:, :, at] = _forces(database, circle - body.heading)
    bands = [database.trusted_band for database in databases.values() if database.trusted_band is not None]
    band = (max(low for low, _ in bands), min(high for _, high in bands)) if bands else None
    group = kind(
        name=name,
        bodies=bodies,
        omega=first.omega,
        heading=circle,
        **tables,
        **limits,
        force=force,
        rho=first.rho,
        g=first.g,
        depth=first.depth,
        trusted_band=band,
        port_starboard_symmetric=keeps,
        origin="group's origin, on the still waterline",
        source="hulls without interaction: " + "; ".join(data.source for data in databases.values()),
    )
    phases = np.concatenate(
        [np.broadcast_to(phase_at_body(group, b), (len(circle), n, 6)) for b in bodies], 2
    )
    return replace(group, force=force / phases)


def _body_of(name: str, database: HydroData, position: ArrayLike, heading: float) -> GroupBody:
    """A vessel of zero speed as a body; what stands apart by cause has no place in a group."""
    if database.additional or database.roll_damping is not None or database.speed != 0.0:
        raise ValueError(
            f"database {database.name!r}: has additional matrices, tabulated roll damping or a forward "
            "speed, "
            "which a group does not take; use with_roll_damping(), and a database without them"
        )
    return GroupBody(
        name=name,
        position=np.asarray(position, dtype=float),
        heading=float(heading),
        mass_matrix=database.mass_matrix,
        restoring=database.restoring,
        linear_damping=database.linear_damping,
        quadratic_damping=database.quadratic_damping,
        length=database.length,
        breadth=database.breadth,
        draught=database.draught,
    )


def _check_alike(name: str, databases: Mapping[str, HydroData]) -> None:
    """One water and one set of frequencies."""
    first_name, first = next(iter(databases.items()), ("", None))
    for label, database in databases.items():
        assert first is not None
        for what in ("rho", "g", "depth"):
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


def _forces(database: HydroData, heading: FloatArray) -> ComplexArray:
    """Forces (q, n, 6) at headings (q,): the stored ones where all are stored, else by splines."""
    circle, table = full_circle(database)
    distance = np.abs(np.angle(np.exp(1j * (heading[:, None] - circle))))
    if np.all(distance.min(axis=1) < SAME_HEADING):
        return np.asarray(table[distance.argmin(axis=1)])
    return force_at(database, database.omega, heading[:, None])


def _place(position: FloatArray) -> str:
    return "(" + ", ".join(f"{value:g}" for value in position) + ")"


def joined_memory(memories: Sequence[MemoryModel]) -> MemoryModel:
    """The memory of hulls that do not feel each other, one after another; states as they are.

    Raises
    ------
    ValueError : of other bands, so that the parts were judged by other frequencies.
    """
    bands = {memory.band for memory in memories}
    if len(bands) != 1:
        raise ValueError(
            f"the memories are of other bands, {sorted(bands)} rad/s; fit them over the same one"
        )
    worst = min((memory.passivity for memory in memories), key=lambda each: each.minimum)
    starts = np.concatenate([[0], np.cumsum([memory.motions for memory in memories])])
    shifted = list(zip(memories, (int(start) for start in starts), strict=False))
    return MemoryModel(
        blocks=tuple(
            replace(block, outputs=block.outputs + start, inputs=block.inputs + start)
            for memory, start in shifted
            for block in memory.blocks
        ),
        added_mass=_diagonal([memory.added_mass for memory in memories]),
        additional_added_mass=_diagonal([memory.additional_added_mass for memory in memories]),
        additional_stiffness=_diagonal([memory.additional_stiffness for memory in memories]),
        band=bands.pop(),
        r2=min(memory.r2 for memory in memories),
        rows=tuple(
            replace(row, output=row.output + start, input=row.input + start)
            for memory, start in shifted
            for row in memory.rows
        ),
        passivity=worst,
    )


def _diagonal(matrices: Sequence[FloatArray]) -> FloatArray:
    """Matrices along the diagonal of a larger one."""
    from scipy.linalg import block_diag

    return np.asarray(block_diag(*matrices))
