"""`vessel_parameters`: the vessel of the time domain, and warnings of what will go wrong there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from seacrane.hydro.data.below_band import warn_of_resonance_below_band
from seacrane.hydro.data.data_warnings import warn_of_damping
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.memory_model import PEAK_ALLOWANCE, MemoryModel, MotionFit
from seacrane.hydro.data.motion import natural_frequency
from seacrane.hydro.memory.audit import warn_of_mismatch
from seacrane.hydro.memory.retardation import RetardationModel
from seacrane.hydro.vessel.lost_passivity import warn_of_lost_passivity
from seacrane.hydro.vessel.parameters import RigidPart, VesselParameters, time_domain_vessel
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.one_thread import one_thread
from seacrane.warnings import MemoryFitWarning, RollDampingWarning

LOST_DAMPING = 0.02  # of its standard deviation


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
    BelowBandWarning

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
    warn_of_damping(database)
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
