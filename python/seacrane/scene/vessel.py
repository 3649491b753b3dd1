"""A vessel from a hydrodynamic database, in a scene."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from seacrane.description.bodies import add_body
from seacrane.description.description import Description
from seacrane.description.hydrodynamics import add_hydrodynamics
from seacrane.description.provenance import VesselProvenance
from seacrane.description.vessel_hydrodynamics import VesselHydrodynamics
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase, MemoryModel, vessel_parameters
from seacrane.hydro.data.data_warnings import warn_of_water
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.memory.fit import enough_frequencies, fit_memory
from seacrane.hydro.memory.retardation import retardation_functions
from seacrane.hydro.vessel.parameters import VesselParameters, following_yaw
from seacrane.inputs.checked import shaped_of
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import direction_of
from seacrane.inputs.shown import shown
from seacrane.scene.mooring import add_mooring_springs, chosen_mooring, with_mooring, without_rounding
from seacrane.scene.mooring_parts import Mooring
from seacrane.scene.vessel_memory import core_memory, memory_of

MOORING_PERIOD = 200.0  # s, of surge, sway and yaw (the paper's station keeping)
MOORING_DAMPING = 0.1  # of critical
MEMORY = ("by-motion", "per-pair", "passive", "convolution", "none")
KINDS = ("per-pair", "by-motion")
ROLL = 3, 3
STEP, PHASE, DURATION = 0.2, 1.0, 60.0  # s, rad at the highest frequency, s: of a convolution that is not run
FloatArray = NDArray[np.float64]


@overload
def add_vessel(
    scene: Description,
    database: HydroDatabase,
    *,
    name: str = "vessel",
    position: Any = (0.0, 0.0, 0.0),
    heading_deg: float = 0.0,
    memory: str = "by-motion",
    kinematics: str = "yaw_following",
    mooring: Any = None,
    mooring_period: float | None = MOORING_PERIOD,
    mooring_damping: float = MOORING_DAMPING,
) -> VesselHydrodynamics: ...


@overload
def add_vessel(
    scene: Description, *, body: str, name: str | None = None, **hydrodynamics: Any
) -> VesselHydrodynamics: ...


def add_vessel(
    scene: Description,
    database: HydroDatabase | None = None,
    *,
    name: str | None = None,
    body: str | None = None,
    **hydrodynamics: Any,
) -> VesselHydrodynamics:
    """Add a vessel: from a database, or the hydrodynamics of a body that is there by their matrices.

    From a database it floats upright, and its body frame has its origin at the database's reference point.

    Parameters
    ----------
    database : HydroDatabase, optional
        Hydrodynamics of the vessel without the bodies that the scene models itself. The scene keeps it: what
        needs it later, as `add_sea`, takes it from `scene.vessels[name].database`. With `body` and matrices:
        the one whose wave loads act on that body.
    name : str
        Of the hydrodynamics. With a database also of the new body, and "vessel" by default; else the body's.
    body : str
        Without a database: the body, about whose origin the matrices are.
    position : array_like, shape (3,)
        With a database. Of the reference point at the start, m, inertial frame. Its mooring has no load at
        this x and y; it floats at rest at z = 0, and heaves from another z.
    heading_deg : float
        With a database. At the start, deg from +x towards +y; default 0.
    memory : str, or list of StateSpaceBlock, or RetardationFunctions
        With a database, "by-motion" (default): fluid memory as one passive state-space model per group of
        coupled motions, the smallest that leaves the motions within 1 % of the database's own. "per-pair":
        the paper's, one model per pair of motions, eqs (28)-(31), judged by R2. "passive": of the form of
        "by-motion", judged by R2. "convolution": the reference, without a fit: the database's retardation
        functions convolved with the history of the motion, see `seacrane.hydro.retardation_functions`; the
        steps land on its samples.
        "none": without radiation damping, as the paper does for comparison. The database's own fitted memory
        is used where it is of the kind asked for; else one is fitted here, once for each database. Without a
        database: the models themselves.
    kinematics : str
        "yaw_following" (default) or "paper", eqs (17)-(31).
    mooring : float, array_like of shape (6, 6), or list of MooringSpring, optional
        With a database, in place of `mooring_period`: a natural period (s); or a stiffness matrix about the
        reference point, vessel's axes, N/m to N m/rad; or horizontal springs. It holds the pose of the start.
        Default: by `mooring_period`, or the stiffness of surge, sway and yaw that the database's own
        restoring holds, with an `OwnMooringWarning`.
    mooring_period : float or None
        With a database. Natural period (s) of soft linear station keeping in surge, sway and yaw; default
        200 s; None: no mooring.
    mooring_damping : float
        Its damping as a fraction of critical; default 0.1. Without a database: (3,), N s/m and N m s/rad.
    added_mass, linear_damping, quadratic_damping, restoring, mooring_stiffness
        Without a database: see `seacrane.hydro.VesselHydrodynamics`.
    floats : bool
        Without a database: whether the restoring carries the body's weight, as that of a ship does; else it
        weighs as any body, and its buoyancy is a point force of yours. Default: whether heave is restored.

    Raises
    ------
    SceneError
        For a memory model that this version does not have, a place or heading that is no finite number,
        matrices of another shape, a mooring that no springs have, or a second one beside the database's own.

    Warns
    -----
    WaterMismatchWarning
        The scene's gravity is not the database's; `vessel_parameters` has warnings of its own.
    OwnMooringWarning
        The database's own mooring is used.
    AngleUnitWarning, CompassDirectionWarning
        A heading that looks like radians, or like a compass bearing.
    """
    if database is None:
        if body is None:
            raise SceneError("vessel: give a database, or the body whose hydrodynamics the matrices are")
        return add_hydrodynamics(scene, body=body, name=name, **_buoyant(hydrodynamics))
    if not isinstance(database, HydroDatabase):
        raise SceneError(
            f"vessel: database is {shown(database)}; give a HydroDatabase, as load_database reads"
        )
    if body is not None and hydrodynamics:
        return add_hydrodynamics(scene, body=body, name=name, database=database, **_buoyant(hydrodynamics))
    if body is not None:
        raise SceneError(f"vessel: body {body!r} is given beside a database, which brings its own; use name=")
    return named(_from_database, "add_vessel", owners=1)(
        scene, database, name="vessel" if name is None else name, **hydrodynamics
    )


def _buoyant(hydrodynamics: dict[str, Any]) -> dict[str, Any]:
    """With `floats`: what nothing brings back in heave does not float, it only has water about it."""
    restoring = np.asarray(hydrodynamics.get("restoring", 0.0))
    held = restoring.shape == (6, 6) and bool(restoring[2, 2] > 0.0)
    return {"floats": held} | hydrodynamics


def _from_database(
    scene: Description,
    database: HydroDatabase,
    *,
    name: str,
    position: Any = (0.0, 0.0, 0.0),
    heading_deg: float = 0.0,
    memory: str = "by-motion",
    kinematics: str = "yaw_following",
    mooring: Any = None,
    mooring_period: float | None = MOORING_PERIOD,
    mooring_damping: float = MOORING_DAMPING,
) -> VesselHydrodynamics:
    if memory not in MEMORY:
        raise SceneError(f"memory {memory!r} is not available in this version; choose {' or '.join(MEMORY)}")
    warn_of_water(database, gravity=scene.gravity)
    heading = np.radians(direction_of(f"vessel {name!r}: heading_deg", heading_deg))
    parameters = vessel_parameters(database, memory=None if memory == "none" else memory_of(database, memory))
    place = shaped_of(f"vessel {name!r}: position", position, (3,))
    added = put_afloat(
        scene, database, parameters, name=name, pose=(place, float(heading)),
        memory=[] if memory == "none" else core_memory(parameters.memory), kinematics=kinematics,
        mooring=mooring, mooring_period=mooring_period, mooring_damping=mooring_damping,
    )  # fmt: skip
    band = (float(database.omega[0]), float(database.omega[-1]))
    scene.provenance[name] = VesselProvenance(
        database=database.name, omega=band, memory=memory, memory_error=_memory_error(parameters, memory),
        free_surface=free_surface(database, parameters.memory.additional_stiffness),
    )  # fmt: skip
    return added


def put_afloat(
    scene: Description,
    database: HydroDatabase,
    parameters: VesselParameters,
    *,
    name: str,
    pose: tuple[FloatArray, float],
    memory: Any,
    kinematics: str,
    mooring: Any,
    mooring_period: float | None,
    mooring_damping: float,
) -> VesselHydrodynamics:
    """A body with the parameters of a database, and its hydrodynamics; `pose`: position (3,), m, yaw, rad."""
    place, half = pose[0], 0.5 * pose[1]
    add_body(
        scene,
        name=name,
        mass=parameters.mass,
        inertia=parameters.inertia,
        center_of_mass=parameters.center_of_mass,
        position=place,
        quaternion=(np.cos(half), 0.0, 0.0, np.sin(half)),
    )
    held = chosen_mooring(
        f"vessel {name!r}", database, mooring, mooring_period, usual=mooring_period == MOORING_PERIOD
    )
    heavy = _horizontal_inertia(parameters)
    restoring = without_rounding(following_yaw(parameters.restoring))
    if isinstance(held, Mooring):
        restoring = with_mooring(restoring, held)
        stiffness = held.horizontal
        damping = 2.0 * mooring_damping * np.sqrt(np.diagonal(held.matrix)[[0, 1, 5]] * heavy)
        add_mooring_springs(scene, name, held, pose=(place, 2.0 * half))
    else:
        omega = 0.0 if held is None else 2.0 * np.pi / held
        stiffness, damping = heavy * omega**2, 2.0 * mooring_damping * omega * heavy
    return add_hydrodynamics(
        scene,
        body=name,
        added_mass=parameters.added_mass,
        linear_damping=parameters.linear_damping,
        quadratic_damping=parameters.quadratic_damping,
        restoring=restoring,
        mooring_stiffness=stiffness,
        mooring_damping=damping,
        memory=memory,
        kinematics=kinematics,
        database=database,
    )


def _memory_error(parameters: VesselParameters, memory: str) -> float | None:
    """What a memory fitted by motion changes of the motions; None of others."""
    model = parameters.memory
    if memory != "by-motion" or not isinstance(model, MemoryModel) or model.motion is None:
        return None
    return model.motion.error.worst


def _horizontal_inertia(parameters: VesselParameters) -> NDArray[np.float64]:
    """Mass in surge and sway (kg) and inertia in yaw (kg m2) about the reference point, with added mass."""
    heavy = parameters.mass * np.array([1.0, 1.0, 0.0]) + np.diag(parameters.added_mass)[[0, 1, 5]]
    heavy[2] += parameters.inertia[2, 2] + parameters.mass * float(np.sum(parameters.center_of_mass[:2] ** 2))
    return np.asarray(heavy)


def free_surface(database: HydroData, used: FloatArray) -> tuple[float, float, float] | None:
    """N m/rad that additional causes (roll tanks) take from C44: as used, least and most of all fits.

    A table of matrices by frequency does not tell a static stiffness: it is what a fit extends them to.

    Parameters
    ----------
    used : (6, 6) `additional_stiffness` of the model that a vessel has.
    """
    if not database.additional:
        return None
    table = sum(float(part.restoring[(0, *ROLL)]) for part in database.additional)
    fits = [used]
    if enough_frequencies(database):
        step = min(STEP, PHASE / float(database.omega[-1]))
        slow = retardation_functions(database=database, step=step, duration=DURATION)
        fits.append(slow.additional_stiffness)
        fits += [fit_memory(database=database, kind=kind).additional_stiffness for kind in KINDS]
    taken = [-(table + float(one[ROLL])) for one in fits]
    return (taken[0], min(taken), max(taken)) if any(taken) else None
