"""What scene files of version 0.1 lack, found by the names that it used: the one place that knows them.

These files name no roles: their cranes are those of the paper, with the names of its joints. What the program
knew of a vessel and its sea, it wrote among the user's notes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

from seacrane.description.crane_parts import add_roles
from seacrane.description.description import Description
from seacrane.description.provenance import (
    NUMBER,
    SEA_KINDS,
    SEA_SETTINGS,
    SeaProvenance,
    VesselProvenance,
)

SLEW, LINK, PAYLOAD = "A", "link", "payload"
CYLINDERS = {"main": "main_cylinder", "knuckle": "knuckle_cylinder"}
VESSEL_NOTES = ("database", "database_omega", "memory")
DERIVED_NOTES = ("kinematics", "waves_relative_bound", "wave_phase", "drift")  # the elements tell them


def roles_by_name(scene: Description) -> None:
    """Give a scene the roles of the parts that are named and made as those of the paper's crane."""
    kinds = {name: joint.kind for name, joint in scene.joints.items()}
    cylinders = {label: name for label, name in CYLINDERS.items() if kinds.get(name) == "prismatic"}
    slew = SLEW if kinds.get(SLEW) == "revolute" else None
    link = LINK if kinds.get(LINK) == "distance" else None
    payload = PAYLOAD if PAYLOAD in scene.bodies else None
    if cylinders or slew or link:
        add_roles(scene, slew=slew, cylinders=cylinders, link=link, payload=payload)


def provenance_from_notes(scene: Description) -> None:
    """Move what the program noted on vessels and sea out of the notes."""
    taken: set[str] = set()
    for vessel in scene.vessels.values():
        noted = {key: _noted(scene.notes.get(key), vessel.body) for key in VESSEL_NOTES}
        provenance = VesselProvenance(
            database=_text(noted["database"]),
            omega=_band(noted["database_omega"]),
            memory=_text(noted["memory"]),
        )
        if provenance != VesselProvenance():
            scene.provenance[vessel.name] = provenance
            taken |= {*VESSEL_NOTES, *DERIVED_NOTES}
    if scene.waves is not None:
        known = asdict(sea_of({key: scene.notes.get(key) for key in SEA_SETTINGS}))
        settings = {key: value for key, value in known.items() if value is not None}
        scene.waves = replace(scene.waves, provenance=replace(scene.waves.provenance, **settings))
        taken |= settings.keys()
    for key in taken:
        scene.notes.pop(key, None)


def sea_of(values: Mapping[str, Any]) -> SeaProvenance:
    """What is known of a sea among values that the user may have changed."""
    known = {
        key: values[key]
        for key, (kind, _) in SEA_KINDS.items()
        if isinstance(values.get(key), kind) and not isinstance(values[key], bool)
    }
    return SeaProvenance(**known)


def _noted(value: Any, body: str) -> Any:
    """The note of one vessel as it is, of several by body."""
    return value.get(body) if isinstance(value, Mapping) else value


def _text(value: Any) -> str | None:
    return value if isinstance(value, str) else None


def _band(value: Any) -> tuple[float, float] | None:
    if not (isinstance(value, list) and len(value) == 2 and all(type(omega) in NUMBER for omega in value)):
        return None
    return float(value[0]), float(value[1])
