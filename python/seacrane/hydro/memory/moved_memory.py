"""A memory model about another reference point, or of the mirrored vessel: exact, with the same states.

And whether a model is that of a database.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from seacrane.arrays import Array
from seacrane.hydro.data.heading_circle import PORT_STARBOARD
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import Hydrodynamics
from seacrane.hydro.data.memory_model import MODEL_MATRICES, RADIATION, MemoryBlock, MemoryModel
from seacrane.hydro.memory.certificate import TYPICAL_VELOCITY, joint_passivity, largest_states
from seacrane.hydro.memory.identification import (
    FEWEST_FREQUENCIES,
    judged_rows,
    memory_entries,
    pair_r2,
    symmetric,
    within,
    worst_r2,
)
from seacrane.hydro.memory.motion_judge import motion_judge
from seacrane.hydro.memory.retardation import retardation_functions
from seacrane.inputs.caller import warn_caller
from seacrane.one_thread import one_thread
from seacrane.warnings import MemoryMismatchWarning

CLAIMED_R2 = 0.9  # pairs that never followed their data say nothing about where the model belongs
LOST_R2 = 0.05


@one_thread
def moved_memory(model: MemoryModel, transform: Array, moved: Hydrodynamics) -> MemoryModel:
    """``T^T K T``: every block drives, and is driven by, all motions that its own are made of.

    T (6, 6), of a group (6 k, 6 k), gives motions at the old point from those at the new one. Pairs are
    judged anew against the ``moved`` database: accepted if all fits were, or if they reach the model's R2.
    """
    blocks = tuple(_moved_block(block, transform) for block in model.blocks)
    matrices = {name: transform.T @ getattr(model, name) @ transform for name in MODEL_MATRICES}
    passivity = joint_passivity(list(blocks), moved.damping, model.band)
    about = replace(model, blocks=blocks, passivity=passivity, **matrices)
    if model.motion is not None:
        judge = motion_judge(moved, model.band)
        floor = judge.error_of(retardation_functions(database=moved)).worst
        motion = replace(model.motion, error=judge.error_of(about), floor=floor)
        about = replace(about, motion=motion)
    before = all(row.accepted for row in model.rows if row.cause == RADIATION)
    pairs = memory_entries(symmetric(moved.added_mass), symmetric(moved.damping), moved.omega)
    rows = judged_rows(about, moved, RADIATION, pairs, -np.inf if before else model.r2)
    return replace(about, rows=(*rows, *(row for row in model.rows if row.cause != RADIATION)))


def _moved_block(block: MemoryBlock, transform: Array) -> MemoryBlock:
    """The block with ``B T`` and ``T^T C`` in place of B and C, over the motions that are left in them."""
    b = block.B @ transform[block.inputs]
    c = transform[block.outputs].T @ block.C
    if np.array_equal(block.inputs, block.outputs) and np.array_equal(block.B, block.C.T):
        c = b.T  # to the last bit, so that the energy of a passive block stays proven
    d = transform[block.outputs].T @ block.D @ transform[block.inputs]
    inputs = np.flatnonzero(np.any(b, axis=0) | np.any(d, axis=0))
    outputs = np.flatnonzero(np.any(c, axis=1) | np.any(d, axis=1))
    return replace(
        block, inputs=inputs, outputs=outputs, B=b[:, inputs], C=c[outputs], D=d[np.ix_(outputs, inputs)],
        state_scale=largest_states(block.A, b[:, inputs] * TYPICAL_VELOCITY[inputs % 6]),
    )  # fmt: skip


def mirrored_memory(model: MemoryModel) -> MemoryModel:
    """Sway, roll and yaw with their signs changed; fits, passivity and states stay as they are."""
    mirror = np.diag(PORT_STARBOARD)
    blocks = [replace(_moved_block(one, mirror), state_scale=one.state_scale) for one in model.blocks]
    matrices = {name: mirror @ getattr(model, name) @ mirror for name in MODEL_MATRICES}
    return replace(model, blocks=tuple(blocks), **matrices)


def warn_of_mismatch(database: HydroData, model: MemoryModel) -> None:
    """Name the first reason why a memory model cannot be this database's.

    A model states the R2 with which each pair followed its data. Where this database's data give a pair less,
    by more than 0.05, they are not the data that it was fitted to: another reference point shows first in the
    pairs off the diagonal.
    """
    reason = _mismatch(database, model)
    if reason:
        warn_caller(
            f"database {database.name!r}: the memory model is not of these data: {reason}. Radiation loads "
            "will be those of the other data; use fit_memory(database=...) with this database, or its at() "
            "and mirror(), which move the memory along",
            MemoryMismatchWarning,
        )


@lru_cache(maxsize=8)  # both are immutable, and every scene of a study asks
def _mismatch(database: HydroData, model: MemoryModel) -> str:
    causes = {part.cause for part in database.additional}
    modelled = {row.cause for row in model.rows} - {RADIATION}
    unknown = sorted(modelled - causes)
    if unknown:
        return f"it holds {', '.join(unknown)}, of which the database has no matrices"
    missing = sorted(
        part.cause
        for part in database.additional
        if part.cause not in modelled and (np.any(part.added_mass) or np.any(part.damping))
    )
    if missing:
        return f"it holds nothing of {', '.join(missing)}, of which the database has matrices"
    inside = within(database.omega, model.band)
    if np.count_nonzero(inside) < FEWEST_FREQUENCIES:
        return ""
    data, fitted = (database.added_mass, database.damping), model.frequency_response(database.omega)
    for row in model.rows:
        pair, claimed = (row.output, row.input), min(row.r2_added_mass, row.r2_damping)
        if row.cause != RADIATION or claimed < CLAIMED_R2:
            continue
        found = worst_r2(pair_r2(pair, data, fitted, inside))
        if found < claimed - LOST_R2:
            name = f"{pair[0] + 1}{pair[1] + 1}"
            return f"it states R2 = {claimed:.3f} for pair {name}, and follows these with {found:.3f}"
    return ""
