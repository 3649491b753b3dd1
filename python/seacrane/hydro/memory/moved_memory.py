"""A memory model about another reference point, or of the mirrored vessel: exact, with the same states."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.heading_circle import PORT_STARBOARD
from seacrane.hydro.data.hydro_group_data import Hydrodynamics
from seacrane.hydro.data.memory_model import MemoryBlock, MemoryModel, MotionFit
from seacrane.hydro.memory.audit import judged_rows
from seacrane.hydro.memory.joint_passivity import joint_passivity
from seacrane.hydro.memory.motion_judge import motion_judge
from seacrane.hydro.memory.realisation import TYPICAL_VELOCITY, largest_states
from seacrane.hydro.memory.retardation import retardation_functions
from seacrane.one_thread import one_thread

FloatArray = NDArray[np.float64]

MATRICES = ("added_mass", "additional_added_mass", "additional_stiffness")


@one_thread
def moved_memory(model: MemoryModel, transform: FloatArray, moved: Hydrodynamics) -> MemoryModel:
    """``T^T K T``: every block drives, and is driven by, all motions that its own are made of.

    Parameters
    ----------
    model : of the database before it was moved.
    transform : (6, 6) T, of a group (6 k, 6 k), motions at the old point from those at the new one.
    moved : the database about the new point, against which the quality of each pair is judged anew.
    """
    blocks = tuple(_moved_block(block, transform) for block in model.blocks)
    matrices = {name: transform.T @ getattr(model, name) @ transform for name in MATRICES}
    passivity = joint_passivity(list(blocks), moved.damping, model.band)
    about = dataclasses.replace(model, blocks=blocks, passivity=passivity, **matrices)
    if model.motion is not None:
        about = dataclasses.replace(about, motion=_moved_motion(model.motion, about, moved))
    return dataclasses.replace(about, rows=judged_rows(about, moved))


def _moved_motion(motion: MotionFit, model: MemoryModel, moved: Hydrodynamics) -> MotionFit:
    """The motions of the new point judged anew."""
    judge = motion_judge(moved, model.band)
    floor = judge.error_of(retardation_functions(database=moved)).worst
    return dataclasses.replace(motion, error=judge.error_of(model), floor=floor)


def _moved_block(block: MemoryBlock, transform: FloatArray) -> MemoryBlock:
    """The block with ``B T`` and ``T^T C`` in place of B and C, over the motions that are left in them."""
    b = block.B @ transform[block.inputs]
    c = transform[block.outputs].T @ block.C
    if np.array_equal(block.inputs, block.outputs) and np.array_equal(block.B, block.C.T):
        c = b.T  # to the last bit, so that the energy of a passive block stays proven
    d = transform[block.outputs].T @ block.D @ transform[block.inputs]
    inputs = np.flatnonzero(np.any(b, axis=0) | np.any(d, axis=0))
    outputs = np.flatnonzero(np.any(c, axis=1) | np.any(d, axis=1))
    return dataclasses.replace(
        block,
        inputs=inputs,
        outputs=outputs,
        B=b[:, inputs],
        C=c[outputs],
        D=d[np.ix_(outputs, inputs)],
        state_scale=largest_states(block.A, b[:, inputs] * TYPICAL_VELOCITY[inputs % 6]),
    )


def mirrored_memory(model: MemoryModel) -> MemoryModel:
    """Sway, roll and yaw with their signs changed; fits, passivity and states stay as they are."""
    sign = np.outer(PORT_STARBOARD, PORT_STARBOARD)
    blocks = tuple(
        dataclasses.replace(
            block,
            B=block.B * PORT_STARBOARD[block.inputs],
            C=block.C * PORT_STARBOARD[block.outputs, None],
            D=block.D * sign[np.ix_(block.outputs, block.inputs)],
        )
        for block in model.blocks
    )
    return dataclasses.replace(
        model, blocks=blocks, **{name: getattr(model, name) * sign for name in MATRICES}
    )
