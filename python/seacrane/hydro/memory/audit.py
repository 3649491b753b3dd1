"""Whether a memory model is that of a database, and whether it can be trusted not to deliver energy."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.memory.identification import r_squared
from seacrane.hydro.memory.model import RADIATION, FitRow, MemoryModel
from seacrane.inputs.caller import warn_caller

if TYPE_CHECKING:
    from seacrane.hydro.database.database import HydroDatabase
    from seacrane.hydro.vessel import VesselParameters

FloatArray = NDArray[np.float64]

CLAIMED_R2 = 0.9  # pairs that never followed their data say nothing about where the model belongs
LOST_R2 = 0.05
FEWEST_FREQUENCIES = 8
SCALED_DAMPING_LIMIT = -0.05
GROWTH_LIMIT = 1e-6  # 1/s, a factor e in eleven days: above the round-off of eigenvalues at zero
ROUNDING = 1e-9
AUDIT = np.geomspace(2e-2, 2e1, 201)


class MemoryMismatchWarning(UserWarning):
    """A memory model of other data: radiation loads belong to another ship, point or loading."""


class NonPassiveMemoryWarning(UserWarning):
    """A memory model can feed energy into a motion: motions may grow out of nothing."""


def judged_rows(model: MemoryModel, database: HydroDatabase) -> tuple[FitRow, ...]:
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


def warn_of_mismatch(database: HydroDatabase, model: MemoryModel) -> None:
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
def _mismatch(database: HydroDatabase, model: MemoryModel) -> str:
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


def warn_of_lost_passivity(database: HydroDatabase, vessel: VesselParameters) -> None:
    """Warn where the radiation memory can feed a motion, beyond what fits per pair usually leave.

    Where the smallest eigenvalue of the fitted damping, scaled by the largest diagonals of the data, is below
    -5 %, or where it is negative and the floating vessel, whose restoring and linear damping alone keep it at
    rest, has an eigenvalue that grows with this memory.
    """
    from seacrane.hydro.database.coupled import growth_rate

    model = vessel.memory
    minimum, at = _smallest_damping(database, model)
    if minimum >= 0.0:
        return
    growth = growth_rate(vessel) if _calm_without_memory(vessel) else 0.0
    if minimum < SCALED_DAMPING_LIMIT or growth > GROWTH_LIMIT:
        grows = (
            f", and motions of the free vessel grow with {growth:.2g} 1/s" if growth > GROWTH_LIMIT else ""
        )
        warn_caller(
            f"database {database.name!r}: the memory model is not passive: its damping falls to "
            f"{100.0 * minimum:.3g} % of the largest at {at:.3g} rad/s{grows}. A motion can gain energy from "
            "still water; use fit_memory(kind='passive')",
            NonPassiveMemoryWarning,
        )


def _calm_without_memory(vessel: VesselParameters) -> bool:
    """Whether restoring and linear damping cannot be what makes a motion grow."""
    stiffness, damping = vessel.restoring[2:5, 2:5], vessel.linear_damping
    lowest = np.linalg.eigvalsh(0.5 * (damping + damping.T))[0]
    stable = np.linalg.eigvalsh(0.5 * (stiffness + stiffness.T))[0] > 0.0
    return bool(stable and lowest >= -ROUNDING * np.abs(damping).max())


@lru_cache(maxsize=8)
def _smallest_damping(database: HydroDatabase, model: MemoryModel) -> tuple[float, float]:
    """Smallest scaled eigenvalue and its rad/s: what the model states, or what an audit finds below it."""
    peak = np.sqrt(np.maximum(np.diagonal(database.damping, axis1=1, axis2=2).max(axis=0), 0.0))
    active = peak > 1e-6 * peak.max(initial=0.0)
    if not np.any(active) or not model.blocks:
        return 0.0, 0.0
    damping = model.transfer(AUDIT).real
    scaled = (0.5 * (damping + damping.swapaxes(1, 2)))[:, active][:, :, active]
    lowest = np.linalg.eigvalsh(scaled / np.outer(peak[active], peak[active]))[:, 0]
    where = int(lowest.argmin())
    stated = model.passivity
    if stated.minimum < lowest[where]:
        return stated.minimum, stated.omega
    return float(lowest[where]), float(AUDIT[where])


def _inside(model: MemoryModel, database: HydroDatabase) -> NDArray[np.bool_]:
    low, high = model.band
    return np.asarray((database.omega >= low - 1e-9) & (database.omega <= high + 1e-9))


def _pair_r2(
    model: MemoryModel, database: HydroDatabase, j: int, k: int, *, inside: NDArray[np.bool_]
) -> tuple[float, float]:
    """R2 of added mass and damping of one pair, the data made symmetric as for the fit."""
    fitted = model.frequency_response(database.omega[inside])
    data = (database.added_mass[inside], database.damping[inside])
    a, b = (
        r_squared(0.5 * (table[:, j, k] + table[:, k, j]), model_table[:, j, k])
        for table, model_table in zip(data, fitted, strict=True)
    )
    return a, b


def _pairs(model: MemoryModel, database: HydroDatabase) -> Iterator[tuple[int, int]]:
    """Pairs (j <= k) that the model has blocks for and the database data that vary."""
    from seacrane.hydro.memory.fit import memory_entries

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
