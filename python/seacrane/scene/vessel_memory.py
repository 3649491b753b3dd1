"""The fluid memory of a database, and as the core takes it."""

from __future__ import annotations

import hashlib
from functools import lru_cache

import numpy as np

from seacrane import _core
from seacrane.hydro import HydroDatabase, MemoryModel, RetardationModel, fit_memory, retardation_functions
from seacrane.hydro.data.memory_model import RADIATION
from seacrane.hydro.memory.certificate import is_energy_form

MOST_KNOWN = 16
_known: dict[str, HydroDatabase] = {}


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


def remember(element: _core.VesselHydrodynamics, database: HydroDatabase) -> None:
    """Know later, in this process, from which database a vessel with a fitted memory was added."""
    _known[_fingerprint(element)] = database
    while len(_known) > MOST_KNOWN:
        _known.pop(next(iter(_known)))


def database_of(element: _core.VesselHydrodynamics) -> HydroDatabase | None:
    """The database that a vessel of these matrices was added from in this process, or None."""
    return _known.get(_fingerprint(element))


def _fingerprint(element: _core.VesselHydrodynamics) -> str:
    digest = hashlib.sha256()
    matrices = [element.added_mass, element.linear_damping, element.restoring]
    if not isinstance(element.memory, _core.RetardationFunctions):
        matrices += [matrix for block in element.memory for matrix in (block.a, block.b, block.c)]
    for matrix in matrices:
        digest.update(np.ascontiguousarray(matrix, dtype=float).tobytes())
    return digest.hexdigest()


def core_memory(
    model: MemoryModel | RetardationModel,
) -> list[_core.StateSpaceBlock] | _core.RetardationFunctions:
    """A fitted memory, or retardation functions."""
    if isinstance(model, RetardationModel):
        return _core.RetardationFunctions(step=model.step, kernel=model.kernel)
    return [
        _core.StateSpaceBlock(
            inputs=[int(i) for i in block.inputs],
            outputs=[int(i) for i in block.outputs],
            a=block.A,
            b=block.B,
            c=block.C,
            d=block.D,
            state_scale=block.state_scale,
        )
        for block in model.blocks
    ]
