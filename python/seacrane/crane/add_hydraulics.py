"""Hydraulic cylinders of a crane, in place of those that drives move as they like."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from functools import partial
from typing import Any

from seacrane.crane.builder import CYLINDERS, KnuckleBoomCrane
from seacrane.crane.data_file import CylinderData
from seacrane.crane.jointed import JointedCrane
from seacrane.crane.jointed_cylinder import ends_of, static_force
from seacrane.crane.mass_properties import Member, Tube
from seacrane.description.cylinder_areas import Areas
from seacrane.description.description import Description
from seacrane.description.hydraulic_cylinders import place_cylinder
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown

Hydraulics = Mapping[str, Mapping[str, Any]]


def hydraulics_of(crane: KnuckleBoomCrane | JointedCrane, given: Hydraulics | None) -> Hydraulics:
    """Keywords of the hydraulic cylinders by label: those given, else those of the data file."""
    if given is None:
        return _of_file(crane)
    labels = CYLINDERS if isinstance(crane, KnuckleBoomCrane) else crane.data.cylinders
    if not isinstance(given, Mapping) or not all(isinstance(one, Mapping) for one in given.values()):
        example = ", ".join(f"{label!r}: {{...}}" for label in labels)
        raise SceneError(f"crane: hydraulics are {shown(given)}; give {{{example}}}")
    for label in given:
        if label not in labels:
            raise SceneError(
                f"crane: hydraulics are given of cylinder {label!r}; the cylinders are "
                f"{', '.join(map(repr, labels)) or 'none'}"
            )
    return given


def _of_file(crane: KnuckleBoomCrane | JointedCrane) -> Hydraulics:
    if isinstance(crane, JointedCrane):
        return crane.data.hydraulics
    of_file = {label: _data(crane, label).hydraulics for label in CYLINDERS}
    return {label: entries for label, entries in of_file.items() if entries is not None}


def add_hydraulics(
    scene: Description,
    crane: KnuckleBoomCrane | JointedCrane,
    hydraulics: Hydraulics,
    *,
    pose: Mapping[str, float],
    payload_mass: float,
    prefix: str,
) -> None:
    """Add hydraulic cylinders between barrels and rods, with pressures that hold the crane and a payload.

    Parameters
    ----------
    pose : mapping of str to float
        "s1" and "s2" of a knuckle boom, coordinates of another crane.
    payload_mass : kg.
    """
    for label, entries in hydraulics.items():
        if isinstance(crane, JointedCrane):
            name, (first, second) = crane.data.cylinders[label], crane.slide(label)
            ends, areas = ends_of(crane, label), crane.data.areas.get(label)
            barrel, rod = crane.member_of(first), crane.member_of(second)
        else:
            data = _data(crane, label)
            name, first, second = CYLINDERS[label], f"{label}_barrel", f"{label}_rod"
            ends = {"retracted_length": data.retracted_length, "stroke": data.stroke}
            areas, barrel, rod = data.areas, data.barrel, data.rod
        given = {"name": prefix + name, "first": prefix + first, "second": prefix + second} | ends
        given |= _areas(label, areas, barrel, rod, entries)
        holding = partial(_force, crane, label, pose, payload_mass, scene.gravity)
        place_cylinder(scene, given | dict(entries), holding)


def _force(
    crane: KnuckleBoomCrane | JointedCrane,
    label: str,
    pose: Mapping[str, float],
    payload_mass: float,
    gravity: float,
) -> float:
    """With which a cylinder holds the crane and a payload, N."""
    if isinstance(crane, JointedCrane):
        return static_force(crane, label, coordinates=pose, payload_mass=payload_mass, gravity=gravity)
    forces = crane.static_cylinder_forces(**pose, payload_mass=payload_mass, gravity=gravity)
    return float(forces[list(CYLINDERS).index(label)])


def _data(crane: KnuckleBoomCrane, label: str) -> CylinderData:
    data: CylinderData = getattr(crane.data, CYLINDERS[label])
    return data


def _areas(
    label: str,
    areas: Areas | None,
    barrel: Iterable[Member],
    rod: Iterable[Member],
    entries: Mapping[str, Any],
) -> dict[str, Any]:
    """The areas of the data file, or of the bore and the rod of its members."""
    if areas is not None:
        return {"full_area": areas[0], "rod_side_area": areas[1]}
    if "full_area" in entries and "rod_side_area" in entries:
        return {}
    bores = [part.inner_diameter for part in barrel if isinstance(part, Tube)]
    rods = [part.outer_diameter for part in rod if isinstance(part, Tube)]
    if not bores or not rods or not 0.0 < max(rods) < min(bores):
        raise SceneError(
            f"crane: the areas of the {label} cylinder are not known, as its rod and barrel are no tubes "
            "that fit; give full_area and rod_side_area, m2"
        )
    full = math.pi / 4.0 * min(bores) ** 2
    return {"full_area": full, "rod_side_area": full - math.pi / 4.0 * max(rods) ** 2}
