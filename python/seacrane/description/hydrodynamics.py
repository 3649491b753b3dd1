"""Linear hydrodynamics of a body, by its matrices."""

from __future__ import annotations

from typing import Any

from seacrane import _core
from seacrane.description.scene import Description, insert
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of


def add_hydrodynamics(
    scene: Description, *, body: str, name: str | None = None, **hydrodynamics: Any
) -> _core.VesselHydrodynamics:
    """Linear hydrodynamics of a body about its origin; see `VesselHydrodynamics` for the arguments."""
    name = name_of("vessel", name, body)
    known = [field.name for field in _core.VesselHydrodynamics.FIELDS if field.role == "value"]
    for key in hydrodynamics:
        if key not in known:
            raise SceneError(f"vessel {name!r}: {key} is unknown; a vessel takes {', '.join(known)}")
    element = _core.VesselHydrodynamics(name=name, body=body, **hydrodynamics)
    inserted: _core.VesselHydrodynamics = insert("vessel", scene.vessels, element)
    return inserted
