"""`vessel_parameters`: the vessel of the time domain, and warnings of what will go wrong there."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from seacrane.hydro.data.data_warnings import warn_of_matrices, warn_of_resonance_below_band
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.memory_model import PEAK_ALLOWANCE, MemoryModel, MotionFit
from seacrane.hydro.data.motion import natural_frequency
from seacrane.hydro.memory.moved_memory import warn_of_mismatch
from seacrane.hydro.memory.retardation import RetardationModel
from seacrane.hydro.vessel.parameters import RigidPart, VesselParameters, growth_rate, time_domain_vessel
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.one_thread import one_thread
from seacrane.warnings import MemoryFitWarning, NonPassiveMemoryWarning, RollDampingWarning

LOST_DAMPING = 0.02  # of its standard deviation
SCALED_DAMPING_LIMIT = -0.05
GROWTH_LIMIT = 1e-6  # 1/s, a factor e in eleven days: above the round-off of eigenvalues at zero
ROUNDING = 1e-9
AUDIT = np.geomspace(2e-2, 2e1, 201)


@one_thread
def vessel_parameters(
    database: HydroData,
    *,
    memory: MemoryModel | RetardationModel | None = None,
    take_out: Sequence[RigidPart] = (),
) -> VesselParameters:
    """Parameters of the vessel without the parts that the scene models as bodies of their own.

    Parameters
    ----------
    database : hydrodynamics; its own fitted memory is used, else one is fitted here.
    memory : a fit, or retardation functions, to use in place of it.
    take_out : parts that the database's mass and restoring include and the scene models itself (a crane):
        their mass and inertia leave the mass matrix and their weight leaves the restoring (C44 and C55 grow
        by m g z, C46 and C56 lose theirs; buoyancy stays as it is).

    Returns
    -------
    VesselParameters : roll damping tabulated by frequency enters as linear + quadratic, both taken at the
        roll natural frequency (the linearised column belongs to the frequency domain).

    Warns
    -----
    RollDampingWarning, MemoryFitWarning, MemoryMismatchWarning, NonPassiveMemoryWarning, DampingWarning,
    AsymmetryWarning, BelowBandWarning

    Raises
    ------
    ValueError : what is left after taking parts out has no positive mass or inertia, or the database is of
        a forward speed.
    """
    vessel = time_domain_vessel(database, memory=memory, take_out=take_out)
    _warn(database, vessel)
    return vessel


def _warn(database: HydroData, vessel: VesselParameters) -> None:
    """Name fits that miss their aim, a memory of other data or that delivers energy, and roll damping."""
    warn_of_matrices(database)
    warn_of_resonance_below_band(database)
    if isinstance(vessel.memory, MemoryModel):
        _warn_of_misfits(database.name, vessel.memory)
        warn_of_mismatch(database, vessel.memory)
        warn_of_lost_passivity(database, vessel)
    else:
        _warn_of_lost_damping(database.name, vessel.memory)
    if vessel.linear_damping[3, 3] == 0.0 and vessel.quadratic_damping[3] == 0.0:
        warn_caller(
            f"database {database.name!r}: no roll damping beside radiation; roll at resonance will be far "
            "too large. Add linear_damping or quadratic_damping for roll",
            RollDampingWarning,
        )
    elif database.roll_damping is not None and natural_frequency(database, 3) is None:
        warn_caller(
            f"database {database.name!r}: roll resonance lies outside {database.omega[0]:.4g} to "
            f"{database.omega[-1]:.4g} rad/s; the tabulated roll damping is taken in the middle of the "
            "table, and roll near its resonance is off by as much as the damping varies",
            RollDampingWarning,
        )


def _warn_of_misfits(name: str, fit: MemoryModel) -> None:
    if fit.motion is not None:
        _warn_of_motions(name, fit.motion)
        return
    for row in fit.rows:
        if not row.accepted:
            warn_caller(
                f"database {name!r}: memory {row.output + 1}{row.input + 1} ({row.cause}) follows "
                f"added mass with R2 = {row.r2_added_mass:.3f} and damping with {row.r2_damping:.3f}; "
                f"{fit.r2} was asked, and motions that depend on it carry that error",
                MemoryFitWarning,
            )


def _warn_of_motions(name: str, fit: MotionFit) -> None:
    if fit.reached:
        return
    error = fit.error
    seas, peaks = int(error.seas.argmax()), int(error.peaks.argmax())
    what = f"{error.seas[seas]:.2g} of {MOTIONS[seas]} in a sea"
    if error.peaks[peaks] / PEAK_ALLOWANCE > error.seas[seas]:
        what = f"{error.peaks[peaks]:.2g} of {MOTIONS[peaks]} at its peak"
    nearer = (
        f", or take memory='convolution', which errs by {fit.floor:.2g}" if fit.floor < error.worst else ""
    )
    warn_caller(
        f"database {name!r}: the memory errs by {what}, at best, and its limit is {fit.limit:g} "
        f"({PEAK_ALLOWANCE * fit.limit:g} at a peak): {fit.obstacle}. Narrow the database's trusted_band, "
        f"give it a memory of a larger limit, by fit_memory(limit=...){nearer}",
        MemoryFitWarning,
    )


def _warn_of_lost_damping(name: str, model: RetardationModel) -> None:
    j, k = np.unravel_index(int(model.error_damping.argmax()), (6, 6))
    if model.error_damping[j, k] > LOST_DAMPING:
        warn_caller(
            f"database {name!r}: retardation functions of {model.duration:g} s at steps of {model.step:g} s "
            f"return damping {j + 1}{k + 1} with an error of {model.error_damping[j, k]:.3f} of its standard "
            "deviation, and motions that depend on it carry that error; take a longer duration, a shorter "
            "step or a database with closer frequencies",
            MemoryFitWarning,
        )


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
