"""Hulls afloat, from their databases or by matrices: one by itself, or several in one water."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import Description, insert, require
from seacrane.description.provenance import VesselProvenance
from seacrane.description.vessel_hydrodynamics import VesselHydrodynamics
from seacrane.errors import SceneError
from seacrane.hydro import (
    HydroDatabase,
    HydroGroup,
    MemoryModel,
    RetardationModel,
    fit_memory,
    retardation_functions,
    vessel_parameters,
)
from seacrane.hydro.data.data_warnings import warn_of_water
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.memory_model import RADIATION, MemoryBlock
from seacrane.hydro.memory.certificate import independent_blocks, is_energy_form
from seacrane.hydro.memory.fit import enough_frequencies
from seacrane.hydro.vessel.parameters import VesselParameters, following_yaw, time_domain_vessel
from seacrane.inputs.checked import name_of, shaped_of
from seacrane.inputs.frames import rotation_about_z
from seacrane.inputs.plausible import direction_of
from seacrane.inputs.shown import shown
from seacrane.scene.bodies import add_body
from seacrane.scene.mooring import (
    USUAL,
    Mooring,
    add_mooring_springs,
    chosen_mooring,
    with_mooring,
    without_rounding,
)

MOORING_DAMPING = 0.1  # of critical
MEMORY = ("by-motion", "per-pair", "convolution", "none")
OF_GROUP = ("joint", "none")
KINDS = ("per-pair", "by-motion")
ROLL = 3, 3
STEP, PHASE, DURATION = 0.2, 1.0, 60.0  # s, rad at the highest frequency, s: of a convolution that is not run
AFLOAT = 1e-6  # m


def add_hydrodynamics(
    scene: Description, *, body: str, name: str | None = None, slack_moment: Any = 0.0, **hydrodynamics: Any
) -> VesselHydrodynamics:
    """Linear hydrodynamics of a body about its origin; see `VesselHydrodynamics` for the arguments."""
    name = name_of("vessel", name, body)
    known = [field.name for field in VesselHydrodynamics.FIELDS if field.role == "value"]
    for key in hydrodynamics:
        if key not in (*known, "database"):
            raise SceneError.of(f"vessel {name!r}: {key}", f"is unknown; a vessel takes {', '.join(known)}")
    pair = slack_moment if np.ndim(slack_moment) else (slack_moment, 0.0)
    taken = shaped_of(f"vessel {name!r}: slack_moment", pair, (2,)) * scene.gravity
    element = VesselHydrodynamics(name=name, body=body, **hydrodynamics)
    if taken.any():
        restoring = np.array(element.restoring)
        if not np.all((taken >= 0.0) & (taken < restoring[[3, 4], [3, 4]])):
            raise SceneError.of(
                f"vessel {name!r}: slack_moment",
                f"is {shown(slack_moment)} kg m; give rho i of the tanks, from 0 to below what its restoring "
                "holds; 1 t m is 1000 kg m",
            )
        restoring[[3, 4], [3, 4]] -= taken
        element = VesselHydrodynamics(**{**element.__getstate__(), "restoring": restoring})
        scene.provenance[name] = VesselProvenance(slack_tanks=(float(taken[0]), float(taken[1])))
    return insert("vessel", scene.vessels, element)


def add_group(scene: Description, *, name: str, **matrices: Any) -> _core.GroupHydrodynamics:
    """Vessels that load each other through the water; see `GroupHydrodynamics` for the arguments."""
    element = _core.GroupHydrodynamics(name=name_of("group", name), **matrices)
    for vessel in element.vessels:
        require(scene, f"group {name!r}", "vessels", vessel, "vessels")
    return insert("group", scene.groups, element)


def add_hull(
    scene: Description, database: HydroDatabase, *, name: str = "vessel", position: Any = (0.0, 0.0, 0.0),
    heading_deg: float = 0.0, memory: str = "by-motion", kinematics: str = "yaw_following",
    mooring: Any = USUAL, mooring_damping: float = MOORING_DAMPING, slack_moment: Any = 0.0,
) -> VesselHydrodynamics:  # fmt: skip
    """A hull that floats by itself, as `Scene.add_vessel` describes it."""
    if memory not in MEMORY:
        raise SceneError(f"memory {memory!r} is not available in this version; choose {' or '.join(MEMORY)}")
    warn_of_water(database, gravity=scene.gravity)
    heading = np.radians(direction_of(f"vessel {name!r}: heading_deg", heading_deg))
    fitted = None if memory == "none" else _memory_of(database, memory)
    parameters = vessel_parameters(database, memory=fitted)
    place = shaped_of(f"vessel {name!r}: position", position, (3,))
    added = _put_afloat(
        scene, database, parameters, name=name, pose=(place, float(heading)),
        memory=[] if memory == "none" else _core_memory(parameters.memory), kinematics=kinematics,
        mooring=mooring, mooring_damping=mooring_damping, slack_moment=slack_moment,
    )  # fmt: skip
    motion = getattr(parameters.memory, "motion", None) if memory == "by-motion" else None
    band = (float(database.omega[0]), float(database.omega[-1]))
    scene.provenance[name] = replace(
        scene.provenance.get(name, VesselProvenance()), database=database.name, omega=band, memory=memory,
        memory_error=None if motion is None else motion.error.worst,
        free_surface=free_surface(database, parameters.memory.additional_stiffness),
    )  # fmt: skip
    return added


def _put_afloat(
    scene: Description, database: HydroDatabase, parameters: VesselParameters, *, name: str,
    pose: tuple[Array, float], mooring: Any, mooring_damping: float, **others: Any,
) -> VesselHydrodynamics:  # fmt: skip
    """A body with the parameters of a database, and its hydrodynamics; `pose`: position (3,), m, yaw, rad."""
    place, half = pose[0], 0.5 * pose[1]
    add_body(
        scene, name=name, mass=parameters.mass, inertia=parameters.inertia,
        center_of_mass=parameters.center_of_mass, position=place,
        quaternion=(np.cos(half), 0.0, 0.0, np.sin(half)),
    )  # fmt: skip
    held = chosen_mooring(f"vessel {name!r}", database, mooring)
    heavy = parameters.mass * np.array([1.0, 1.0, 0.0]) + np.diag(parameters.added_mass)[[0, 1, 5]]
    heavy[2] += parameters.inertia[2, 2] + parameters.mass * float(np.sum(parameters.center_of_mass[:2] ** 2))
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
        scene, body=name, added_mass=parameters.added_mass, linear_damping=parameters.linear_damping,
        quadratic_damping=parameters.quadratic_damping, restoring=restoring, mooring_stiffness=stiffness,
        mooring_damping=damping, database=database, **others,
    )  # fmt: skip


def free_surface(database: HydroData, used: Array) -> tuple[float, float, float] | None:
    """N m/rad that additional causes (roll tanks) take from C44: as used (6, 6), least and most of all fits.

    A table of matrices by frequency does not tell a static stiffness: it is what a fit extends them to.
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


def add_hulls(
    scene: Description, group: HydroGroup, *, names: Sequence[str] | None = None,
    position: Any = (0.0, 0.0, 0.0), heading_deg: float = 0.0, memory: str = "joint",
    mooring: float | None = USUAL, mooring_damping: float = MOORING_DAMPING,
) -> tuple[VesselHydrodynamics, ...]:  # fmt: skip
    """Hulls that feel each other's motions and waves, as `Scene.add_vessel` describes them."""
    if memory not in OF_GROUP:
        raise SceneError(f"memory {shown(memory)} of a group is not there; choose {' or '.join(OF_GROUP)}")
    what = f"group {group.name!r}"
    called = tuple(group.names if names is None else (name_of("vessel", name) for name in names))
    if len(called) != len(group.bodies):
        raise SceneError(
            f"{what}: has bodies {', '.join(group.names)}, and names are {', '.join(called) or 'none'}; give "
            "one for each"
        )
    warn_of_water(next(iter(group.hulls.values())), gravity=scene.gravity)
    heading = float(np.radians(direction_of(f"{what}: heading_deg", heading_deg)))
    place = shaped_of(f"{what}: position", position, (3,))
    model = _joint_memory(group)
    turn = rotation_about_z(heading)
    kept = ("added_mass", "additional_added_mass", "additional_stiffness")
    added = []
    for i, (name, body) in enumerate(zip(called, group.bodies, strict=True)):
        if abs(body.position[2]) > AFLOAT:
            raise SceneError(
                f"{what}: the reference point of {body.name!r} is {body.position[2]:g} m above the still "
                "water; give a group whose reference points are on it"
            )
        database = group[body.name]
        own = slice(6 * i, 6 * i + 6)
        parts = {key: getattr(model, key)[own, own] for key in kept}
        alone = replace(model, blocks=(), rows=(), motion=None, **parts)
        parameters = time_domain_vessel(database, memory=alone)
        added.append(
            _put_afloat(
                scene, database, parameters, name=name,
                pose=(place + turn @ body.position, heading + body.heading), memory=[],
                kinematics="yaw_following", mooring=mooring,
                mooring_damping=mooring_damping,
            )
        )  # fmt: skip
        band = (float(group.omega[0]), float(group.omega[-1]))
        scene.provenance[name] = VesselProvenance(database=database.name, omega=band, memory=memory)
    blocks = () if memory == "none" else model.blocks
    whole = model.added_mass + model.additional_added_mass
    between = 1.0 - np.kron(np.eye(len(added)), np.ones((6, 6)))
    add_group(
        scene, name=group.name, vessels=list(called), added_mass=0.5 * (whole + whole.T) * between,
        memory=[_core_block(part) for block in blocks for part in independent_blocks(block)],
    )  # fmt: skip
    return tuple(added)


@lru_cache(maxsize=8)
def _joint_memory(group: HydroGroup) -> MemoryModel:
    return group.memory or fit_memory(database=group)


@lru_cache(maxsize=8)
def _memory_of(database: HydroDatabase, kind: str) -> MemoryModel | RetardationModel:
    """The memory of a database, its own if that is of the kind asked for."""
    if kind == "convolution":
        return retardation_functions(database=database)
    own = database.memory
    if own is not None:
        joint = all(is_energy_form(block) for block in own.blocks if block.cause == RADIATION)
        if own.motion is not None if kind == "by-motion" else own.motion is None and not joint:
            return own
    return fit_memory(database=database, kind=kind)


def _core_memory(
    model: MemoryModel | RetardationModel,
) -> list[_core.StateSpaceBlock] | _core.RetardationFunctions:
    """A fitted memory, or retardation functions."""
    if isinstance(model, RetardationModel):
        return _core.RetardationFunctions(step=model.step, kernel=model.kernel)
    return [_core_block(block) for block in model.blocks]


def _core_block(block: MemoryBlock) -> _core.StateSpaceBlock:
    """A block of a fitted memory."""
    return _core.StateSpaceBlock(
        inputs=[int(i) for i in block.inputs], outputs=[int(i) for i in block.outputs], a=block.A,
        b=block.B, c=block.C, d=block.D, state_scale=block.state_scale,
    )  # fmt: skip
