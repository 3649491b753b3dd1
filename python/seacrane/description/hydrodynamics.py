"""Linear hydrodynamics of a body, by its matrices."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from seacrane import _core
from seacrane.description.scene import Description, insert
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, shaped_of, text_of

SHAPES: dict[str, tuple[int, ...]] = {
    "added_mass": (6, 6),
    "linear_damping": (6, 6),
    "quadratic_damping": (6,),
    "restoring": (6, 6),
    "mooring_stiffness": (3,),
    "mooring_damping": (3,),
}


def add_hydrodynamics(
    scene: Description, *, body: str, name: str | None = None, **hydrodynamics: Any
) -> _core.VesselHydrodynamics:
    """Linear hydrodynamics of a body about its origin; see `VesselHydrodynamics` for the arguments."""
    name = name_of("vessel", name, body)
    for key, value in hydrodynamics.items():
        what = f"vessel {name!r}: {key}"
        if key in SHAPES:
            hydrodynamics[key] = shaped_of(what, value, SHAPES[key])
        elif key == "memory":
            blocks = list(value) if isinstance(value, Sequence) else [value]
            states = all(isinstance(block, _core.StateSpaceBlock) for block in blocks)
            if not (states or isinstance(value, _core.RetardationFunctions)):
                kinds = "a list of seacrane.StateSpaceBlock or seacrane.RetardationFunctions"
                raise SceneError(f"{what} is {value!r}; give {kinds}")
        elif key == "kinematics":
            text_of(what, value)
        else:
            known = ", ".join([*SHAPES, "memory", "kinematics"])
            raise SceneError(f"{what} is unknown; a vessel takes {known}")
    element = _core.VesselHydrodynamics(
        name=name, body=text_of(f"vessel {name!r}: body", body), **hydrodynamics
    )
    inserted: _core.VesselHydrodynamics = insert("vessel", scene.vessels, element)
    return inserted
