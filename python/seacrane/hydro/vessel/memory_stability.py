"""Linear stability of the vessel together with its memory."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.memory_model import MemoryModel
from seacrane.hydro.data.rigid_mass import rigid_mass_matrix
from seacrane.hydro.vessel.parameters import VesselParameters, time_domain_vessel
from seacrane.one_thread import one_thread

FloatArray = NDArray[np.float64]


def largest_growth_rate(database: HydroData, model: MemoryModel) -> float:
    """Largest real part (1/s) among the eigenvalues of the freely floating vessel with its memory.

    Positions of motions without restoring (surge, sway, yaw) are left out of the state: nothing depends on
    them, and they would add eigenvalues of zero. A positive value means that motions grow from nothing.
    """
    return growth_rate(time_domain_vessel(database, memory=model))


@one_thread
def growth_rate(vessel: VesselParameters) -> float:
    """The growth rate of a vessel of the time domain, whose memory it holds."""
    return float(np.linalg.eigvals(free_vessel_system(vessel)).real.max())


def free_vessel_system(vessel: VesselParameters) -> FloatArray:
    """Matrix of ``x' = S x``: positions of motions with restoring, all six velocities, memory states.

    Raises TypeError: the memory is a convolution, which has no states.
    """
    model = vessel.memory
    if not isinstance(model, MemoryModel):
        raise TypeError("the vessel's memory is a convolution; give one of states, from fit_memory")
    rigid = rigid_mass_matrix(vessel.mass, vessel.center_of_mass, vessel.inertia)
    inverse = np.linalg.inv(rigid + vessel.added_mass)
    held = np.flatnonzero(np.any(vessel.restoring != 0.0, axis=0))
    p, total = len(held), len(held) + 6 + model.states
    system = np.zeros((total, total))
    velocity = slice(p, p + 6)
    system[np.arange(p), p + held] = 1.0
    system[velocity, :p] = -inverse @ vessel.restoring[:, held]
    system[velocity, velocity] = -inverse @ vessel.linear_damping
    start = p + 6
    for block in model.blocks:
        states = slice(start, start + len(block.A))
        system[states, states] = block.A
        system[states, p + block.inputs] = block.B
        system[velocity, states] = -inverse[:, block.outputs] @ block.C
        system[velocity, p + block.inputs] -= inverse[:, block.outputs] @ block.D
        start += len(block.A)
    return system
