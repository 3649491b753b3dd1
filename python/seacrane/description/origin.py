"""What a result records of where its scene comes from: databases, memory, sea."""

from __future__ import annotations

from typing import Any

from seacrane.description.description import Description
from seacrane.description.provenance import VesselProvenance
from seacrane.inputs.plain_data import plain_data


def origin_settings(scene: Description) -> dict[str, Any]:
    """Of vessels and sea, by the names of a result's settings; by body where several vessels differ.

    Raises
    ------
    SceneError
        For a value that is not plain data.
    """
    found: dict[str, dict[str, Any]] = {}
    for vessel in scene.vessels.values():
        known = scene.provenance.get(vessel.name, VesselProvenance())
        band = None if known.omega is None else list(known.omega)
        values: dict[str, Any] = {"database": known.database, "database_omega": band, "memory": known.memory}
        values |= {"memory_error": known.memory_error, "given_motion": known.motion}
        for key, value in {**values, "kinematics": vessel.kinematics}.items():
            found.setdefault(key, {})[vessel.body] = value
    hulls = {} if scene.waves is None else scene.waves.hulls
    for body, hull in hulls.items():
        if hull.force_by_heading is not None:
            found.setdefault("wave_phase", {})[body] = "slow" if hull.cutoff else "actual"
        if hull.drift is not None:
            found.setdefault("drift", {})[body] = "newman"
    told = {key: one for key, by_body in found.items() if (one := _one(by_body)) is not None}
    return dict(plain_data(f"scene {scene.name!r}: provenance", told)) | sea_settings(scene)


def sea_settings(scene: Description) -> dict[str, Any]:
    """Of its sea alone; raises as `origin_settings`."""
    if scene.waves is None:
        return {}
    told = {**scene.waves.provenance.settings(), "waves_relative_bound": scene.waves.relative_bound}
    return dict(plain_data(f"scene {scene.name!r}: provenance", told))


def _one(by_body: dict[str, Any]) -> Any:
    """The value of all bodies, or the mapping where they differ."""
    first, *others = by_body.values()
    return first if all(other == first for other in others) else by_body
