"""Linear hydrodynamics of a body, by its matrices."""

from __future__ import annotations

from typing import Any

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
