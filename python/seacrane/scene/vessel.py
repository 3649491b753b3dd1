"""A vessel from a hydrodynamic database, in a scene."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.scene import Scene
from seacrane.description.vessel_notes import note_on
from seacrane.errors import SceneError
from seacrane.inputs.checked import shaped_of
from seacrane.inputs.plausible import direction_of
from seacrane.scene.sea import add_sea as add_sea

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase, MemoryModel, RetardationModel

MOORING_PERIOD = 200.0  # s, of surge, sway and yaw (PAPER, "station keeping")
MOORING_DAMPING = 0.1  # of critical
MEMORY = ("per-pair", "passive", "convolution", "none")


def add_vessel(
    scene: Scene,
    database: HydroDatabase,
    *,
    name: str = "vessel",
    position: Any = (0.0, 0.0, 0.0),
    heading_deg: float = 0.0,
    memory: str = "per-pair",
    kinematics: str = "yaw_following",
    mooring_period: float | None = MOORING_PERIOD,
    mooring_damping: float = MOORING_DAMPING,
) -> None:
    """Add a vessel, upright; its body frame has its origin at the database's reference point.

    Parameters
    ----------
    scene : Scene
    database : HydroDatabase
        Hydrodynamics of the vessel without the bodies that the scene models itself.
    name : str
        Of the body and of its hydrodynamics.
    position : array_like, shape (3,)
        Of the reference point at the start, m, inertial frame. Its mooring has no load at this x and y; it
        floats at rest at z = 0, and heaves from another z.
    heading_deg : float
        At the start, deg from +x towards +y.
    memory : str
        "per-pair": fluid memory as one state-space model per pair of motions, eqs (28)-(31). "passive": one
        model per group of coupled motions, proven passive and with fewer states. "convolution": the
        reference, without a fit: the database's retardation functions convolved with the history of the
        motion, see `seacrane.hydro.retardation_functions`; the steps land on its samples. "none": without
        radiation damping, as the paper does for comparison. The database's own fitted memory is used where
        it is of the kind asked for; else one is fitted here, once for each database.
    kinematics : str
        "yaw_following" (default) or "paper", eqs (17)-(31).
    mooring_period : float or None
        Natural period (s) of soft linear station keeping in surge, sway and yaw; None: no mooring.
    mooring_damping : float
        Its damping as a fraction of critical.

    Raises
    ------
    SceneError
        For a memory model that this version does not have, or a place or heading that is no finite number.

    Warns
    -----
    WaterMismatchWarning
        The scene's gravity is not the database's; `vessel_parameters` has warnings of its own.
    AngleUnitWarning, CompassDirectionWarning
        A heading that looks like radians, or like a compass bearing.
    """
    from seacrane.hydro import vessel_parameters
    from seacrane.hydro.data.data_warnings import warn_of_water

    if memory not in MEMORY:
        raise SceneError(f"memory {memory!r} is not available in this version; choose {' or '.join(MEMORY)}")
    warn_of_water(database, gravity=scene.gravity)
    half = 0.5 * np.radians(direction_of(f"vessel {name!r}: heading_deg", heading_deg))
    parameters = vessel_parameters(database, memory=None if memory == "none" else _memory(database, memory))
    scene.add_body(
        name=name,
        mass=parameters.mass,
        inertia=parameters.inertia,
        center_of_mass=parameters.centre_of_mass,
        position=shaped_of(f"vessel {name!r}: position", position, (3,)),
        quaternion=(np.cos(half), 0.0, 0.0, np.sin(half)),
    )
    heavy = parameters.mass * np.array([1.0, 1.0, 0.0]) + np.diag(parameters.added_mass)[[0, 1, 5]]
    heavy[2] += parameters.inertia[2, 2] + parameters.mass * float(np.sum(parameters.centre_of_mass[:2] ** 2))
    omega = 0.0 if mooring_period is None else 2.0 * np.pi / mooring_period
    scene.add_vessel(
        body=name,
        added_mass=parameters.added_mass,
        linear_damping=parameters.linear_damping,
        quadratic_damping=parameters.quadratic_damping,
        restoring=_without_yaw(parameters.restoring),
        mooring_stiffness=heavy * omega**2,
        mooring_damping=2.0 * mooring_damping * omega * heavy,
        memory=[] if memory == "none" else _core_memory(parameters.memory),
        kinematics=kinematics,
    )
    band = [float(database.omega[0]), float(database.omega[-1])]
    note_on(scene, name, database=database.name, database_omega=band, memory=memory)
    scene.notes.update(kinematics=kinematics)


def _without_yaw(restoring: NDArray[np.float64]) -> NDArray[np.float64]:
    """The restoring matrix without C46 and C56 (a new array).

    About fixed axes these turn a residual trim or heel moment with the ship (WAMIT: m g x_G - rho g V x_B);
    in the frame that follows yaw, where restoring acts here, that moment does not depend on yaw.
    """
    kept = restoring.copy()
    kept[3:5, 5] = 0.0
    return kept


@lru_cache(maxsize=8)
def _memory(database: HydroDatabase, kind: str) -> MemoryModel | RetardationModel:
    """The memory of a database, its own if that is of the kind asked for."""
    from seacrane.hydro import fit_memory, retardation_functions
    from seacrane.hydro.data.memory_model import RADIATION
    from seacrane.hydro.memory.certificate import is_energy_form

    if kind == "convolution":
        return retardation_functions(database=database)
    own = database.memory
    if own is not None:
        joint = all(is_energy_form(block) for block in own.blocks if block.cause == RADIATION)
        if joint == (kind == "passive"):
            return own
    return fit_memory(database=database, kind=kind)


def _core_memory(
    model: MemoryModel | RetardationModel,
) -> list[_core.StateSpaceBlock] | _core.RetardationFunctions:
    from seacrane.hydro import RetardationModel

    if isinstance(model, RetardationModel):
        return _core.RetardationFunctions(step=model.step, kernel=model.kernel)
    return [
        _core.StateSpaceBlock(
            inputs=[int(i) for i in block.inputs],
            outputs=[int(i) for i in block.outputs],
            a=block.A,
            b=block.B,
            c=block.C,
            d=block.D,
            state_scale=block.state_scale,
        )
        for block in model.blocks
    ]
