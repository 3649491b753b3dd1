"""Linear hydrodynamics of a body, and of vessels that feel each other's motions, by their matrices."""

from __future__ import annotations

from typing import Any

from seacrane import _core
from seacrane.description.description import Description, insert
from seacrane.description.vessel_hydrodynamics import VesselHydrodynamics
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of


def add_hydrodynamics(
    scene: Description, *, body: str, name: str | None = None, **hydrodynamics: Any
) -> VesselHydrodynamics:
    """Linear hydrodynamics of a body about its origin; see `VesselHydrodynamics` for the arguments."""
    name = name_of("vessel", name, body)
    known = [field.name for field in VesselHydrodynamics.FIELDS if field.role == "value"]
    for key in hydrodynamics:
        if key not in (*known, "database"):
            raise SceneError(f"vessel {name!r}: {key} is unknown; a vessel takes {', '.join(known)}")
    element = VesselHydrodynamics(name=name, body=body, **hydrodynamics)
    inserted: VesselHydrodynamics = insert("vessel", scene.vessels, element)
    return inserted


def add_group(scene: Description, *, name: str, **matrices: Any) -> _core.GroupHydrodynamics:
    """Vessels that load each other through the water; see `GroupHydrodynamics` for the arguments."""
    element = _core.GroupHydrodynamics(name=name_of("group", name), **matrices)
    for vessel in element.vessels:
        if vessel not in scene.vessels:
            raise SceneError(f"group {name!r}: there is no vessel {vessel!r}; add it first")
    inserted: _core.GroupHydrodynamics = insert("group", scene.groups, element)
    return inserted


def group_of(scene: Description, body: str | None) -> _core.GroupHydrodynamics | None:
    """The group in which the vessel of a body is; None where it is in none."""
    vessel = next((one.name for one in scene.vessels.values() if one.body == body), None)
    return next((one for one in scene.groups.values() if vessel in one.vessels), None)
