"""The fluid memory of a database, and as the core takes it."""

from __future__ import annotations

from functools import lru_cache

from seacrane import _core
from seacrane.hydro import HydroDatabase, MemoryModel, RetardationModel, fit_memory, retardation_functions
from seacrane.hydro.data.memory_model import RADIATION, MemoryBlock
from seacrane.hydro.memory.certificate import is_energy_form


@lru_cache(maxsize=8)
def memory_of(database: HydroDatabase, kind: str) -> MemoryModel | RetardationModel:
    """The memory of a database, its own if that is of the kind asked for."""
    if kind == "convolution":
        return retardation_functions(database=database)
    own = database.memory
    if own is not None and kind_of(own) == kind:
        return own
    return fit_memory(database=database, kind=kind)


def kind_of(model: MemoryModel) -> str:
    """The kind of a fitted model, as `fit_memory` takes it."""
    if model.motion is not None:
        return "by-motion"
    joint = all(is_energy_form(block) for block in model.blocks if block.cause == RADIATION)
    return "passive" if joint else "per-pair"


def core_memory(
    model: MemoryModel | RetardationModel,
) -> list[_core.StateSpaceBlock] | _core.RetardationFunctions:
    """A fitted memory, or retardation functions."""
    if isinstance(model, RetardationModel):
        return _core.RetardationFunctions(step=model.step, kernel=model.kernel)
    return [core_block(block) for block in model.blocks]


def core_block(block: MemoryBlock) -> _core.StateSpaceBlock:
    """A block of a fitted memory."""
    return _core.StateSpaceBlock(
        inputs=[int(i) for i in block.inputs],
        outputs=[int(i) for i in block.outputs],
        a=block.A,
        b=block.B,
        c=block.C,
        d=block.D,
        state_scale=block.state_scale,
    )
