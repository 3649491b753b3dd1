"""What a memory model changes of the vessel's motions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import in_trusted_band
from seacrane.hydro.data.memory_model import MemoryModel
from seacrane.hydro.data.motion import motion_errors, motion_response
from seacrane.hydro.memory.retardation import RetardationModel
from seacrane.one_thread import one_thread

FloatArray = NDArray[np.float64]


@one_thread
def memory_motion_errors(database: HydroData, model: MemoryModel | RetardationModel) -> FloatArray:
    """Motions (6,) with the memory's matrices against those with the data, within the trusted band.

    As `motion_errors`: the largest difference by the largest motion.
    """
    added_mass, damping = model.frequency_response(database.omega)
    more_mass, more_damping = model.additional_response(database.omega)
    static = sum((part.restoring for part in database.additional), np.zeros((len(database.omega), 6, 6)))
    fitted = motion_response(
        database,
        added_mass=added_mass + more_mass - static / database.omega[:, None, None] ** 2,
        damping=damping + more_damping,
    )
    return motion_errors(database, fitted, motion_response(database), inside=in_trusted_band(database))
