"""Whether a vessel's memory can feed energy into a motion."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.memory_model import MemoryModel
from seacrane.hydro.vessel.memory_stability import growth_rate
from seacrane.hydro.vessel.parameters import VesselParameters
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import NonPassiveMemoryWarning

SCALED_DAMPING_LIMIT = -0.05
GROWTH_LIMIT = 1e-6  # 1/s, a factor e in eleven days: above the round-off of eigenvalues at zero
ROUNDING = 1e-9
AUDIT = np.geomspace(2e-2, 2e1, 201)


def warn_of_lost_passivity(database: HydroData, vessel: VesselParameters) -> None:
    """Warn where the radiation memory can feed a motion, beyond what fits per pair usually leave.

    Where the smallest eigenvalue of the fitted damping, scaled by the largest diagonals of the data, is below
    -5 %, or where it is negative and the floating vessel, whose restoring and linear damping alone keep it at
    rest, has an eigenvalue that grows with this memory.
    """
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
            "still water; use fit_memory(kind='by-motion')",
            NonPassiveMemoryWarning,
        )


def _calm_without_memory(vessel: VesselParameters) -> bool:
    """Whether restoring and linear damping cannot be what makes a motion grow."""
    stiffness, damping = vessel.restoring[2:5, 2:5], vessel.linear_damping
    lowest = np.linalg.eigvalsh(0.5 * (damping + damping.T))[0]
    stable = np.linalg.eigvalsh(0.5 * (stiffness + stiffness.T))[0] > 0.0
    return bool(stable and lowest >= -ROUNDING * np.abs(damping).max())


@lru_cache(maxsize=8)
def _smallest_damping(database: HydroData, model: MemoryModel) -> tuple[float, float]:
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
