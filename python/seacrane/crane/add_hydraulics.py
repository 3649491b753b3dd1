"""Hydraulic cylinders of a knuckle-boom crane, in place of those that drives move as they like."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from seacrane.crane.builder import CYLINDERS, KnuckleBoomCrane
from seacrane.crane.data_file import CylinderData
from seacrane.crane.mass_properties import Tube
from seacrane.description.cylinder_areas import Areas
from seacrane.description.hydraulic_cylinders import place_cylinder
from seacrane.description.scene import Description
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown

Hydraulics = Mapping[str, Mapping[str, Any]]


def hydraulics_of(crane: KnuckleBoomCrane, given: Hydraulics | None) -> Hydraulics:
    """Entries of the hydraulic cylinders by label: those given, else those of the data file."""
    if given is None:
        of_file = {label: _data(crane, label).hydraulics for label in CYLINDERS}
        return {label: entries for label, entries in of_file.items() if entries is not None}
    if not isinstance(given, Mapping) or not all(isinstance(one, Mapping) for one in given.values()):
        raise SceneError(
            f"crane: hydraulics are {shown(given)}; give {{'main': {{...}}, 'knuckle': {{...}}}}"
        )
    for label in given:
        if label not in CYLINDERS:
            raise SceneError(
                f"crane: hydraulics are given of cylinder {label!r}; the cylinders are "
                f"{', '.join(map(repr, CYLINDERS))}"
            )
    return given


def add_hydraulics(
    scene: Description,
    crane: KnuckleBoomCrane,
    hydraulics: Hydraulics,
    *,
    force: Mapping[str, float],
    prefix: str,
) -> None:
    """Add hydraulic cylinders between barrels and rods that hold forces (N, positive push) by label."""
    for label, entries in hydraulics.items():
        data = _data(crane, label)
        full, ring = _areas(label, data, entries)
        place_cylinder(
            scene,
            {
                "name": prefix + CYLINDERS[label],
                "first": f"{prefix}{label}_barrel",
                "second": f"{prefix}{label}_rod",
                "full_area": full,
                "rod_side_area": ring,
                "retracted_length": data.retracted_length,
                "stroke": data.stroke,
            }
            | dict(entries),
            force[label],
        )


def _data(crane: KnuckleBoomCrane, label: str) -> CylinderData:
    data: CylinderData = getattr(crane.data, CYLINDERS[label])
    return data


def _areas(label: str, data: CylinderData, entries: Mapping[str, Any]) -> Areas:
    """Those of the data file, or of the bore and the rod of its members."""
    if data.areas is not None:
        return data.areas
    barrel = [part.inner_diameter for part in data.barrel if isinstance(part, Tube)]
    rod = [part.outer_diameter for part in data.rod if isinstance(part, Tube)]
    if "full_area" in entries and "rod_side_area" in entries:
        return entries["full_area"], entries["rod_side_area"]
    if not barrel or not rod or not 0.0 < max(rod) < min(barrel):
        raise SceneError(
            f"crane: the areas of the {label} cylinder are not known, as its rod and barrel are no tubes "
            "that fit; give full_area and rod_side_area, m2"
        )
    full = math.pi / 4.0 * min(barrel) ** 2
    return full, full - math.pi / 4.0 * max(rod) ** 2
