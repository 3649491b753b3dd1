"""Vessels in one water from a group of hulls, in a scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.description import Description
from seacrane.description.hydrodynamics import add_group
from seacrane.description.provenance import VesselProvenance
from seacrane.description.vessel_hydrodynamics import VesselHydrodynamics
from seacrane.errors import SceneError
from seacrane.hydro import HydroGroup, MemoryModel, fit_memory
from seacrane.hydro.data.data_warnings import warn_of_water
from seacrane.hydro.memory.independent_states import independent_blocks
from seacrane.hydro.vessel.parameters import time_domain_vessel
from seacrane.inputs.checked import name_of, shaped_of
from seacrane.inputs.frames import rotation_about_z
from seacrane.inputs.plausible import direction_of
from seacrane.inputs.shown import shown
from seacrane.scene.vessel import MOORING_DAMPING, MOORING_PERIOD, put_afloat
from seacrane.scene.vessel_memory import core_block

FloatArray = NDArray[np.float64]
MEMORY = ("joint", "none")
AFLOAT = 1e-6  # m


def add_vessels(
    scene: Description,
    group: HydroGroup,
    *,
    names: Sequence[str] | None = None,
    position: Any = (0.0, 0.0, 0.0),
    heading_deg: float = 0.0,
    memory: str = "joint",
    mooring_period: float | None = MOORING_PERIOD,
    mooring_damping: float = MOORING_DAMPING,
) -> tuple[VesselHydrodynamics, ...]:
    """Add vessels that feel each other's motions and waves, from a group of hulls.

    Each is a body with hydrodynamics of its own, as `add_vessel` makes it, and `add_sea` puts each into the
    sea by its name: its wave loads are those beside the others. What they do to each other is
    `scene.groups[group.name]`: added masses between them and one fluid memory of all their motions, in axes
    that follow the yaw of each. It holds as long as they keep their places and headings to each other; a run
    that leaves them warns.

    Parameters
    ----------
    group : HydroGroup
        Hydrodynamics of the hulls without the bodies that the scene models itself.
    names : sequence of str, optional
        Of the vessels and their bodies, in the order of the group's bodies; default: their names there.
    position : array_like, shape (3,)
        Of the group's origin at the start, m, inertial frame. Moorings have no load there; the hulls float at
        rest at z = 0, and heave from another z.
    heading_deg : float
        Of the group's x axis at the start, deg from +x towards +y; default 0.
    memory : str
        "joint" (default): one passive state-space model of all motions, the group's own or one fitted here.
        "none": without radiation damping.
    mooring_period : float or None
        Natural period (s) of soft linear station keeping of each in surge, sway and yaw; default 200 s; None:
        no mooring.
    mooring_damping : float
        Its damping as a fraction of critical; default 0.1.

    Returns
    -------
    tuple of VesselHydrodynamics
        In the order of the names.

    Raises
    ------
    SceneError
        For a group that is none, another number of names, a hull whose reference point is not on the still
        water, a memory that this version does not have, or a value out of range.

    Warns
    -----
    WaterMismatchWarning
        The scene's gravity is not the group's.
    AngleUnitWarning, CompassDirectionWarning
        A heading that looks like radians, or like a compass bearing.
    """
    if not isinstance(group, HydroGroup):
        raise SceneError(f"vessels: group is {shown(group)}; give a HydroGroup, as load_database reads")
    if memory not in MEMORY:
        raise SceneError(f"memory {shown(memory)} of a group is not available; choose {' or '.join(MEMORY)}")
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
    model = _memory_of(group)
    turn = rotation_about_z(heading)
    added = []
    for i, (name, body) in enumerate(zip(called, group.bodies, strict=True)):
        if abs(body.position[2]) > AFLOAT:
            raise SceneError(
                f"{what}: the reference point of {body.name!r} is {body.position[2]:g} m above the still "
                "water; give a group whose reference points are on it"
            )
        database = group[body.name]
        parameters = time_domain_vessel(database, memory=_own_part(model, i))
        added.append(
            put_afloat(
                scene, database, parameters, name=name,
                pose=(place + turn @ body.position, heading + body.heading), memory=[],
                kinematics="yaw_following", mooring=None, mooring_period=mooring_period,
                mooring_damping=mooring_damping,
            )
        )  # fmt: skip
        band = (float(group.omega[0]), float(group.omega[-1]))
        scene.provenance[name] = VesselProvenance(database=database.name, omega=band, memory=memory)
    blocks = () if memory == "none" else model.blocks
    add_group(
        scene, name=group.name, vessels=list(called), added_mass=_between(model),
        memory=[core_block(part) for block in blocks for part in independent_blocks(block)],
    )  # fmt: skip
    return tuple(added)


@lru_cache(maxsize=8)
def _memory_of(group: HydroGroup) -> MemoryModel:
    return group.memory or fit_memory(database=group)


def _own_part(model: MemoryModel, body: int) -> MemoryModel:
    """What one hull has of the added masses and stiffness by itself, without states."""
    own = slice(6 * body, 6 * body + 6)
    parts = ("added_mass", "additional_added_mass", "additional_stiffness")
    return replace(
        model, blocks=(), rows=(), motion=None, **{key: getattr(model, key)[own, own] for key in parts}
    )


def _between(model: MemoryModel) -> FloatArray:
    """Added masses (6 k, 6 k) of the hulls on each other, symmetric."""
    whole = model.added_mass + model.additional_added_mass
    own = np.kron(np.eye(len(whole) // 6), np.ones((6, 6)))
    return np.asarray(0.5 * (whole + whole.T) * (1.0 - own))
