"""Whether a memory model is that of a database."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import Hydrodynamics
from seacrane.hydro.data.memory_model import RADIATION, FitRow, MemoryModel
from seacrane.hydro.memory.entries import memory_entries
from seacrane.hydro.memory.identification import r_squared
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import MemoryMismatchWarning

FloatArray = NDArray[np.float64]

CLAIMED_R2 = 0.9  # pairs that never followed their data say nothing about where the model belongs
LOST_R2 = 0.05
FEWEST_FREQUENCIES = 8


def judged_rows(model: MemoryModel, database: Hydrodynamics) -> tuple[FitRow, ...]:
    """Rows of a model's radiation pairs against another database's data, beside its other rows as they are.

    A pair is accepted if all fits that the model came from were, or if it reaches the model's R2 itself.
    """
    kept = tuple(row for row in model.rows if row.cause != RADIATION)
    before = all(row.accepted for row in model.rows if row.cause == RADIATION)
    rows = []
    for j, k in _pairs(model, database):
        touching = [
            block
            for block in model.blocks
            if block.cause == RADIATION and j in block.outputs and k in block.inputs
        ]
        poles = np.concatenate([block.poles for block in touching])
        r2 = _pair_r2(model, database, j, k, inside=_inside(model, database))
        r2_all = _pair_r2(model, database, j, k, inside=np.ones(len(database.omega), dtype=bool))
        rows.append(
            FitRow(
                cause=RADIATION,
                output=j,
                input=k,
                order=len(poles),
                r2_added_mass=r2[0],
                r2_damping=r2[1],
                r2_added_mass_all=r2_all[0],
                r2_damping_all=r2_all[1],
                slowest_decay=float(-poles.real.max()),
                fastest_pole=float(np.abs(poles).max()),
                accepted=before or min(r2) >= model.r2,
            )
        )
    return (*rows, *kept)


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
    inside = _inside(model, database)
    if np.count_nonzero(inside) < FEWEST_FREQUENCIES:
        return ""
    for row in model.rows:
        claimed = min(row.r2_added_mass, row.r2_damping)
        if row.cause != RADIATION or claimed < CLAIMED_R2:
            continue
        found = min(_pair_r2(model, database, row.output, row.input, inside=inside))
        if found < claimed - LOST_R2:
            pair = f"{row.output + 1}{row.input + 1}"
            return f"it states R2 = {claimed:.3f} for pair {pair}, and follows these with {found:.3f}"
    return ""


def _inside(model: MemoryModel, database: Hydrodynamics) -> NDArray[np.bool_]:
    low, high = model.band
    return np.asarray((database.omega >= low - 1e-9) & (database.omega <= high + 1e-9))


def _pair_r2(
    model: MemoryModel, database: Hydrodynamics, j: int, k: int, *, inside: NDArray[np.bool_]
) -> tuple[float, float]:
    """R2 of added mass and damping of one pair, the data made symmetric as for the fit."""
    fitted = model.frequency_response(database.omega[inside])
    data = (database.added_mass[inside], database.damping[inside])
    a, b = (
        r_squared(0.5 * (table[:, j, k] + table[:, k, j]), model_table[:, j, k])
        for table, model_table in zip(data, fitted, strict=True)
    )
    return a, b


def _pairs(model: MemoryModel, database: Hydrodynamics) -> Iterator[tuple[int, int]]:
    """Pairs (j <= k) that the model has blocks for and the database data that vary."""
    added_mass, damping = (0.5 * (x + x.swapaxes(1, 2)) for x in (database.added_mass, database.damping))
    modelled = {
        (int(j), int(k))
        for block in model.blocks
        if block.cause == RADIATION
        for j in block.outputs
        for k in block.inputs
    }
    for pair in memory_entries(added_mass, damping, database.omega):
        if pair in modelled:
            yield pair
