"""`VesselParameters`: what the time domain needs of a database, as plain arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.memory_model import MemoryModel
from seacrane.hydro.data.motion import natural_frequency, require_zero_speed
from seacrane.hydro.data.rigid_mass import cross_matrix, rigid_mass_matrix, weight_restoring
from seacrane.hydro.memory.fit import fit_memory
from seacrane.hydro.memory.retardation import RetardationModel
from seacrane.one_thread import one_thread

FloatArray = NDArray[np.float64]

RIGID_TOLERANCE = 1e-5
ROUND_OFF = 1e-6  # of the mass: an added mass below it is none


@dataclass(frozen=True, kw_only=True, eq=False)
class RigidPart:
    """A rigid part about its own centre: ``mass`` (kg), ``position`` (3,) of its centre (m) from the
    database's reference point, ``inertia`` (3, 3) about its centre (kg m2), all in the vessel's axes."""

    mass: float
    position: FloatArray
    inertia: FloatArray


@dataclass(frozen=True, kw_only=True, eq=False)
class VesselParameters:
    """Vessel of the time domain; reference point, axes and signs as in `HydroDatabase`.

    Attributes
    ----------
    mass : kg. center_of_mass : (3,) m from the reference point. inertia : (3, 3) kg m2 about the centre of
        mass.
    added_mass : (6, 6) at infinite frequency, with additional causes and with what the source's mass matrix
        holds beyond a rigid body.
    linear_damping : (6, 6) and quadratic_damping : (6,), beside radiation.
    restoring : (6, 6), with the static stiffness of additional causes (roll tanks).
    memory : of radiation and additional causes, as states or as retardation functions.
    """

    mass: float
    center_of_mass: FloatArray
    inertia: FloatArray
    added_mass: FloatArray
    linear_damping: FloatArray
    quadratic_damping: FloatArray
    restoring: FloatArray
    memory: MemoryModel | RetardationModel


def time_domain_vessel(
    database: HydroData,
    *,
    memory: MemoryModel | RetardationModel | None = None,
    take_out: Sequence[RigidPart] = (),
) -> VesselParameters:
    """`vessel_parameters` without its warnings."""
    require_zero_speed(database)
    model = memory or database.memory or fit_memory(database=database)
    mass_matrix, restoring = database.mass_matrix.copy(), database.restoring.copy()
    for part in take_out:
        mass_matrix -= rigid_mass_matrix(
            part.mass, np.asarray(part.position, float), np.asarray(part.inertia, float)
        )
        restoring -= weight_restoring(part.mass * database.g, np.asarray(part.position, float))
    restoring += sum(part.restoring[0] for part in database.additional) + model.additional_stiffness
    linear, quadratic = database.linear_damping.copy(), database.quadratic_damping.copy()
    _add_roll_damping(database, linear, quadratic)
    mass, centre, inertia = _split_mass_matrix(mass_matrix, database.name)
    rest = _not_of_a_rigid_body(mass_matrix, rigid_mass_matrix(mass, centre, inertia))
    return VesselParameters(
        mass=mass,
        center_of_mass=centre,
        inertia=inertia,
        added_mass=_without_round_off(model.added_mass + model.additional_added_mass, mass_matrix) + rest,
        linear_damping=linear,
        quadratic_damping=quadratic,
        restoring=restoring,
        memory=model,
    )


def _without_round_off(added_mass: FloatArray, mass_matrix: FloatArray) -> FloatArray:
    """The added mass; directions in which it is negative by round-off, beside the mass, have none.

    Yaw of a round body is such a direction. What is beyond round-off stays, and is refused by name.
    """
    scale = np.sqrt(np.diag(mass_matrix))
    scaled = 0.5 * (added_mass + added_mass.T) / np.outer(scale, scale)
    values, axes = np.linalg.eigh(scaled)
    if values[0] >= 0.0 or values[0] < -ROUND_OFF * max(1.0, values[-1]):
        return added_mass
    lifted = (axes * np.maximum(-values, 0.0)) @ axes.T
    return np.asarray(added_mass + lifted * np.outer(scale, scale))


def rigid_part(database: HydroData) -> tuple[float, FloatArray]:
    """Mass (kg) of a database's rigid body, and what its mass matrix (6, 6) holds beyond such a body."""
    mass, centre, inertia = _split_mass_matrix(database.mass_matrix, database.name)
    return mass, _not_of_a_rigid_body(database.mass_matrix, rigid_mass_matrix(mass, centre, inertia))


def following_yaw(restoring: FloatArray) -> FloatArray:
    """Restoring (..., 6, 6) without C46 and C56 (a new array), as it acts in the frame that follows yaw.

    About fixed axes these turn a residual trim or heel moment with the ship (WAMIT: m g x_G - rho g V x_B);
    in that frame the moment does not depend on yaw.
    """
    kept = restoring.copy()
    kept[..., 3:5, 5] = 0.0
    return kept


def _split_mass_matrix(matrix: FloatArray, name: str) -> tuple[float, FloatArray, FloatArray]:
    """Mass, centre of mass and inertia about it."""
    mass = float(np.trace(matrix[:3, :3]) / 3.0)
    if mass <= 0.0:
        raise ValueError(f"database {name!r}: {mass:.6g} kg are left after taking parts out; take out less")
    lever = 0.5 * (matrix[3:, :3] - matrix[:3, 3:]) / mass
    centre = np.array([lever[2, 1], lever[0, 2], lever[1, 0]])
    cross = cross_matrix(centre)
    inertia = 0.5 * (matrix[3:, 3:] + matrix[3:, 3:].T) + mass * cross @ cross
    if np.any(np.linalg.eigvalsh(inertia) <= 0.0):
        raise ValueError(
            f"database {name!r}: the inertia about the centre of mass has eigenvalues "
            f"{np.linalg.eigvalsh(inertia)}; check the mass matrix, or take out less"
        )
    return mass, centre, _of_a_mass_distribution(inertia)


def _of_a_mass_distribution(inertia: FloatArray) -> FloatArray:
    """The inertia with its largest principal moment cut to the sum of the others, which no body exceeds."""
    moments, axes = np.linalg.eigh(inertia)
    excess = moments[2] - moments[0] - moments[1]
    if excess <= 0.0:
        return inertia
    cut = excess + 1e-6 * moments[2]  # clear of the round-off of whoever checks it again
    return np.asarray(inertia - cut * np.outer(axes[:, 2], axes[:, 2]))


def _not_of_a_rigid_body(matrix: FloatArray, rigid: FloatArray) -> FloatArray:
    """What a mass matrix (6, 6) holds beyond a rigid body, as added mass, so that the sum stays as given.

    Zero up to the digits of files. Measured or rounded matrices break the rules of a mass distribution: the
    WAMIT tanker has a yaw inertia above the sum of roll and pitch, and M35 without its M26.
    """
    rest = 0.5 * (matrix + matrix.T) - rigid
    scale = np.sqrt(np.abs(np.diagonal(matrix)))
    small = np.abs(rest) <= RIGID_TOLERANCE * np.outer(scale, scale)
    return np.zeros((6, 6)) if np.all(small) else rest


def _add_roll_damping(database: HydroData, linear: FloatArray, quadratic: FloatArray) -> None:
    """Add the tabulated roll damping at the roll natural frequency."""
    resonance = natural_frequency(database, 3)
    if database.roll_damping is not None:
        at = resonance if resonance is not None else float(np.median(database.omega))
        linear[3, 3] += float(np.interp(at, database.omega, database.roll_damping.linear))
        quadratic[3] += float(np.interp(at, database.omega, database.roll_damping.quadratic))


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
