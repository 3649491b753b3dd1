"""`vessel_parameters`: what the time domain needs of a database, and warnings of what will go wrong there."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from seacrane.arrays import Array
from seacrane.hydro.data.data_warnings import warn_of_matrices, warn_of_resonance_below_band
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import mass_of
from seacrane.hydro.data.memory_model import PEAK_ALLOWANCE, MemoryModel
from seacrane.hydro.data.motion import natural_frequency, require_zero_speed
from seacrane.hydro.data.rigid_mass import cross_matrix, rigid_mass_matrix
from seacrane.hydro.memory.certificate import smallest_damping
from seacrane.hydro.memory.fit import fit_memory
from seacrane.hydro.memory.moved_memory import warn_of_mismatch
from seacrane.hydro.memory.retardation import RetardationModel
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.one_thread import one_thread
from seacrane.warnings import MemoryFitWarning, NonPassiveMemoryWarning, RollDampingWarning

RIGID_TOLERANCE = 1e-5
ROUND_OFF = 1e-6  # of the mass: an added mass below it is none
LOST_DAMPING = 0.02  # of its standard deviation
SCALED_DAMPING_LIMIT = -0.05
GROWTH_LIMIT = 1e-6  # 1/s, a factor e in eleven days: above the round-off of eigenvalues at zero
ROUNDING = 1e-9
AUDIT = np.geomspace(2e-2, 2e1, 201)


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
    center_of_mass: Array
    inertia: Array
    added_mass: Array
    linear_damping: Array
    quadratic_damping: Array
    restoring: Array
    memory: MemoryModel | RetardationModel


@one_thread
def vessel_parameters(
    database: HydroData, *, memory: MemoryModel | RetardationModel | None = None
) -> VesselParameters:
    """Parameters of the vessel in the time domain.

    Parameters
    ----------
    database : hydrodynamics; its own fitted memory is used, else one is fitted here.
    memory : a fit, or retardation functions, to use in place of it.

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
    ValueError : no positive inertia about the centre of mass, or a database of a forward speed.
    """
    vessel = time_domain_vessel(database, memory=memory)
    warn_of_matrices(database)
    warn_of_resonance_below_band(database)
    if isinstance(vessel.memory, MemoryModel):
        _warn_of_misfits(database.name, vessel.memory)
        warn_of_mismatch(database, vessel.memory)
        _warn_of_lost_passivity(database, vessel)
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
    return vessel


def time_domain_vessel(
    database: HydroData, *, memory: MemoryModel | RetardationModel | None = None
) -> VesselParameters:
    """`vessel_parameters` without its warnings."""
    require_zero_speed(database)
    model = memory or database.memory or fit_memory(database=database)
    restoring = database.restoring.copy()
    restoring += sum(part.restoring[0] for part in database.additional) + model.additional_stiffness
    linear, quadratic = database.linear_damping.copy(), database.quadratic_damping.copy()
    if (tabulated := database.roll_damping) is not None:
        resonance = natural_frequency(database, 3)
        at = resonance if resonance is not None else float(np.median(database.omega))
        linear[3, 3] += float(np.interp(at, database.omega, tabulated.linear))
        quadratic[3] += float(np.interp(at, database.omega, tabulated.quadratic))
    mass, centre, inertia, rest = _split_mass_matrix(database)
    added_mass = model.added_mass + model.additional_added_mass
    return VesselParameters(
        mass=mass, center_of_mass=centre, inertia=inertia,
        added_mass=_without_round_off(added_mass, mass_of(database)) + rest, linear_damping=linear,
        quadratic_damping=quadratic, restoring=restoring, memory=model,
    )  # fmt: skip


def _without_round_off(added_mass: Array, mass_matrix: Array) -> Array:
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


def rigid_part(database: HydroData) -> tuple[float, Array]:
    """Mass (kg) of a database's rigid body, and what its mass matrix (6, 6) holds beyond such a body."""
    mass, *_, rest = _split_mass_matrix(database)
    return mass, rest


def following_yaw(restoring: Array) -> Array:
    """Restoring (..., 6, 6) without C46 and C56 (a new array), as it acts in the frame that follows yaw.

    About fixed axes these turn a residual trim or heel moment with the ship (WAMIT: m g x_G - rho g V x_B);
    in that frame the moment does not depend on yaw.
    """
    kept = restoring.copy()
    kept[..., 3:5, 5] = 0.0
    return kept


def _split_mass_matrix(database: HydroData) -> tuple[float, Array, Array, Array]:
    """Mass, centre of mass, inertia about it, and what the mass matrix (6, 6) holds beyond a rigid body.

    The last is added mass, so that the sum stays as given, and zero up to the digits of files. Measured or
    rounded matrices break the rules of a mass distribution: the WAMIT tanker has a yaw inertia above the sum
    of roll and pitch, and M35 without its M26.
    """
    matrix = mass_of(database)
    mass = float(np.trace(matrix[:3, :3]) / 3.0)
    lever = 0.5 * (matrix[3:, :3] - matrix[:3, 3:]) / mass
    centre = np.array([lever[2, 1], lever[0, 2], lever[1, 0]])
    cross = cross_matrix(centre)
    inertia = 0.5 * (matrix[3:, 3:] + matrix[3:, 3:].T) + mass * cross @ cross
    if np.any(np.linalg.eigvalsh(inertia) <= 0.0):
        raise ValueError(
            f"database {database.name!r}: the inertia about the centre of mass has eigenvalues "
            f"{np.linalg.eigvalsh(inertia)}; check the mass matrix"
        )
    moments, axes = np.linalg.eigh(inertia)
    excess = moments[2] - moments[0] - moments[1]
    if excess > 0.0:  # no body exceeds the sum of the others; cut clear of the round-off of a second check
        inertia = inertia - (excess + 1e-6 * moments[2]) * np.outer(axes[:, 2], axes[:, 2])
    rest = 0.5 * (matrix + matrix.T) - rigid_mass_matrix(mass, centre, inertia)
    scale = np.sqrt(np.abs(np.diagonal(matrix)))
    small = np.abs(rest) <= RIGID_TOLERANCE * np.outer(scale, scale)
    return mass, centre, inertia, np.zeros((6, 6)) if np.all(small) else rest


@one_thread
def growth_rate(vessel: VesselParameters) -> float:
    """Largest real part (1/s) among the eigenvalues of the freely floating vessel with its memory.

    Positions of motions without restoring (surge, sway, yaw) are left out of the state: nothing depends on
    them, and they would add eigenvalues of zero. A positive value means that motions grow from nothing.
    """
    return float(np.linalg.eigvals(free_vessel_system(vessel)).real.max())


def free_vessel_system(vessel: VesselParameters) -> Array:
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


def _warn_of_misfits(name: str, model: MemoryModel) -> None:
    for row in model.rows if model.motion is None else ():
        if not row.accepted:
            warn_caller(
                f"database {name!r}: memory {row.output + 1}{row.input + 1} ({row.cause}) follows "
                f"added mass with R2 = {row.r2_added_mass:.3f} and damping with {row.r2_damping:.3f}; "
                f"{model.r2} was asked, and motions that depend on it carry that error",
                MemoryFitWarning,
            )
    fit = model.motion
    if fit is None or fit.reached:
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


def _warn_of_lost_passivity(database: HydroData, vessel: VesselParameters) -> None:
    """Warn where the radiation memory can feed a motion, beyond what fits per pair usually leave.

    Where the smallest eigenvalue of the fitted damping, scaled by the largest diagonals of the data, is below
    -5 %, or where it is negative and the floating vessel, whose restoring and linear damping alone keep it at
    rest, has an eigenvalue that grows with this memory.
    """
    minimum, at = _smallest_damping(database, vessel.memory)
    if minimum >= 0.0:
        return
    stiffness, damping = vessel.restoring[2:5, 2:5], vessel.linear_damping
    calm = np.linalg.eigvalsh(0.5 * (stiffness + stiffness.T))[0] > 0.0 and (
        np.linalg.eigvalsh(0.5 * (damping + damping.T))[0] >= -ROUNDING * np.abs(damping).max()
    )
    growth = growth_rate(vessel) if calm else 0.0
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


@lru_cache(maxsize=8)
def _smallest_damping(database: HydroData, model: MemoryModel) -> tuple[float, float]:
    """Smallest scaled eigenvalue and its rad/s: what the model states, or what an audit finds below it."""
    stated = model.passivity.minimum, model.passivity.omega
    found = smallest_damping(model.blocks, database.damping, AUDIT)
    return stated if stated[0] < found[0] else found
