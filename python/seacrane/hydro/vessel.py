"""`vessel_parameters`: what the time domain needs of a database, as plain arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.database.data_warnings import warn_of_damping
from seacrane.hydro.database.encounter import require_zero_speed
from seacrane.hydro.database.motion import natural_frequency
from seacrane.hydro.memory.audit import warn_of_lost_passivity, warn_of_mismatch
from seacrane.hydro.memory.fit import fit_memory
from seacrane.hydro.memory.model import MemoryModel
from seacrane.hydro.memory.retardation import RetardationModel
from seacrane.inputs.caller import warn_caller

if TYPE_CHECKING:
    from seacrane.hydro.database.database import HydroDatabase

FloatArray = NDArray[np.float64]

RIGID_TOLERANCE = 1e-5
LOST_DAMPING = 0.02  # of its standard deviation


class RollDampingWarning(UserWarning):
    """The vessel has no roll damping beside radiation: its roll at resonance has no converged answer."""


class MemoryFitWarning(UserWarning):
    """A memory model does not follow the data as closely as was asked."""


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
    mass : kg. centre_of_mass : (3,) m from the reference point. inertia : (3, 3) kg m2 about the centre of
        mass.
    added_mass : (6, 6) at infinite frequency, with additional causes and with what the source's mass matrix
        holds beyond a rigid body.
    linear_damping : (6, 6) and quadratic_damping : (6,), beside radiation.
    restoring : (6, 6), with the static stiffness of additional causes (roll tanks).
    memory : of radiation and additional causes, as states or as retardation functions.
    """

    mass: float
    centre_of_mass: FloatArray
    inertia: FloatArray
    added_mass: FloatArray
    linear_damping: FloatArray
    quadratic_damping: FloatArray
    restoring: FloatArray
    memory: MemoryModel | RetardationModel


def vessel_parameters(
    database: HydroDatabase,
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
    RollDampingWarning, MemoryFitWarning, MemoryMismatchWarning, NonPassiveMemoryWarning, DampingWarning

    Raises
    ------
    ValueError : what is left after taking parts out has no positive mass or inertia, or the database is of
        a forward speed.
    """
    vessel = time_domain_vessel(database, memory=memory, take_out=take_out)
    _warn(database, vessel)
    return vessel


def time_domain_vessel(
    database: HydroDatabase,
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
        restoring -= _weight_restoring(part.mass * database.g, np.asarray(part.position, float))
    restoring += sum(part.restoring[0] for part in database.additional) + model.additional_stiffness
    linear, quadratic = database.linear_damping.copy(), database.quadratic_damping.copy()
    _add_roll_damping(database, linear, quadratic)
    mass, centre, inertia = _split_mass_matrix(mass_matrix, database.name)
    rest = _not_of_a_rigid_body(mass_matrix, rigid_mass_matrix(mass, centre, inertia))
    return VesselParameters(
        mass=mass,
        centre_of_mass=centre,
        inertia=inertia,
        added_mass=model.added_mass + model.additional_added_mass + rest,
        linear_damping=linear,
        quadratic_damping=quadratic,
        restoring=restoring,
        memory=model,
    )


def rigid_mass_matrix(mass: float, centre: FloatArray, inertia: FloatArray) -> FloatArray:
    """Mass matrix (6, 6) about the reference point, equation (12) of the paper for any centre of mass."""
    cross = _cross(centre)
    matrix = np.zeros((6, 6))
    matrix[:3, :3] = mass * np.eye(3)
    matrix[:3, 3:] = -mass * cross
    matrix[3:, :3] = mass * cross
    matrix[3:, 3:] = inertia - mass * cross @ cross
    return matrix


def _cross(v: FloatArray) -> FloatArray:
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def _weight_restoring(weight: float, position: FloatArray) -> FloatArray:
    """Share of a weight (N) at ``position`` in the restoring matrix about the reference point."""
    x, y, z = position
    c = np.zeros((6, 6))
    c[3, 3] = c[4, 4] = -weight * z
    c[3, 5], c[4, 5] = weight * x, weight * y
    return c


def _split_mass_matrix(matrix: FloatArray, name: str) -> tuple[float, FloatArray, FloatArray]:
    """Mass, centre of mass and inertia about it."""
    mass = float(np.trace(matrix[:3, :3]) / 3.0)
    if mass <= 0.0:
        raise ValueError(f"database {name!r}: {mass:.6g} kg are left after taking parts out; take out less")
    lever = 0.5 * (matrix[3:, :3] - matrix[:3, 3:]) / mass
    centre = np.array([lever[2, 1], lever[0, 2], lever[1, 0]])
    cross = _cross(centre)
    inertia = 0.5 * (matrix[3:, 3:] + matrix[3:, 3:].T) + mass * cross @ cross
    if np.any(np.linalg.eigvalsh(inertia) <= 0.0):
        raise ValueError(
            f"database {name!r}: the inertia about the centre of mass has eigenvalues "
            f"{np.linalg.eigvalsh(inertia)}; "
            "check the mass matrix, or take out less"
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


def _add_roll_damping(database: HydroDatabase, linear: FloatArray, quadratic: FloatArray) -> None:
    """Add the tabulated roll damping at the roll natural frequency."""
    resonance = natural_frequency(database, 3)
    if database.roll_damping is not None:
        at = resonance if resonance is not None else float(np.median(database.omega))
        linear[3, 3] += float(np.interp(at, database.omega, database.roll_damping.linear))
        quadratic[3] += float(np.interp(at, database.omega, database.roll_damping.quadratic))


def _warn(database: HydroDatabase, vessel: VesselParameters) -> None:
    """Name fits that miss their aim, a memory of other data or that delivers energy, and roll damping."""
    warn_of_damping(database)
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
    for row in fit.rows:
        if not row.accepted:
            warn_caller(
                f"database {name!r}: memory {row.output + 1}{row.input + 1} ({row.cause}) follows "
                f"added mass with R2 = {row.r2_added_mass:.3f} and damping with {row.r2_damping:.3f}; "
                f"{fit.r2} was asked, and motions that depend on it carry that error",
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
