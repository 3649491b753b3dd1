"""Hydraulic cylinders of a crane, in place of those that drives move as they like."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.crane import Crane
from seacrane.crane.data import JointData
from seacrane.crane.mass_properties import Tube
from seacrane.crane.pose import extent_of
from seacrane.description.description import Description
from seacrane.description.hydraulic_cylinders import place_cylinder
from seacrane.description.roles import require_cylinders
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown

Array = NDArray[np.float64]
Hydraulics = Mapping[str, Mapping[str, Any]]
ON_AXIS = 1e-6  # of the crane's extent: a pin so near to the axis is on it


def hydraulics_of(crane: Crane, given: Hydraulics | None) -> Hydraulics:
    """Keywords of the hydraulic cylinders by label: those given, else those of the data file."""
    if given is None:
        return crane.data.hydraulics
    labels = crane.data.cylinders
    if not isinstance(given, Mapping) or not all(isinstance(one, Mapping) for one in given.values()):
        example = ", ".join(f"{label!r}: {{...}}" for label in labels)
        raise SceneError.of("crane: hydraulics", f"are {shown(given)}; give {{{example}}}")
    require_cylinders("crane: hydraulics are", given, labels)
    return given


def add_hydraulics(
    scene: Description,
    crane: Crane,
    hydraulics: Hydraulics,
    *,
    coordinates: Mapping[str, float],
    payload_mass: float,
    prefix: str,
) -> None:
    """Add cylinders between barrels and rods, with pressures that hold the crane and a payload, kg."""
    if not hydraulics:
        return
    forces = crane.static_cylinder_forces(payload_mass=payload_mass, gravity=scene.gravity, **coordinates)
    by_label = dict(zip(crane.data.cylinders, forces.tolist(), strict=True))
    for label, entries in hydraulics.items():
        slide = crane.data.tree[crane.data.cylinders[label]]
        names = {"name": slide.name, "first": slide.first, "second": slide.second}
        given = {key: prefix + name for key, name in names.items()} | _ends(crane, label, slide)
        given |= _areas(crane, label, slide, entries)
        place_cylinder(scene, given | dict(entries), partial(by_label.__getitem__, label))


def _ends(crane: Crane, label: str, slide: JointData) -> dict[str, Any]:
    """Points of barrel and rod in their coordinates, length at stroke 0 and largest stroke, m.

    The points are the outermost pins of both that lie on the cylinder's axis.

    Raises SceneError for a cylinder without such pins, or without a range.
    """
    what, axis = f"crane {crane.data.name!r}: cylinder {label!r}", slide.axis
    assert axis is not None
    if slide.range is None:
        raise SceneError(f"{what}: has no range, which its stroke would be; give its joint a range_m")
    pins, near = [], ON_AXIS * extent_of(crane.data)
    for body, outward in ((slide.first, -1.0), (slide.second, 1.0)):
        others = [
            one.point for one in crane.data.joints if body in (one.first, one.second) and one is not slide
        ]
        on_axis = [at for at in others if float(np.linalg.norm(np.cross(axis, at - slide.point))) < near]
        if not on_axis:
            raise SceneError(
                f"{what}: where it takes hold is not known, as no other joint of {body!r} is on its axis; "
                "add it by add_hydraulic_cylinder with its points"
            )
        pins.append(max(on_axis, key=lambda at: outward * float((at - slide.point) @ axis)))
    length = float((pins[1] - pins[0]) @ axis)
    low, high = slide.range
    if not length + low > 0.0:
        raise SceneError(
            f"{what}: is {length:.4g} m long at home, and its range_m begins {-low:.4g} m below; correct it"
        )
    frames = (crane.body(body).frame for body in (slide.first, slide.second))
    first, second = (frame.axes.T @ (at - frame.origin) for frame, at in zip(frames, pins, strict=True))
    reach = {"retracted_length": length + low, "stroke": high - low}
    return {"first_point": first, "second_point": second} | reach


def _areas(crane: Crane, label: str, slide: JointData, entries: Mapping[str, Any]) -> dict[str, Any]:
    """The areas of the data file, or of the bore and the rod of its members."""
    if label in crane.data.areas:
        return dict(zip(("full_area", "rod_side_area"), crane.data.areas[label], strict=True))
    if "full_area" in entries and "rod_side_area" in entries:
        return {}
    barrel, rod = (crane.body(name).members for name in (slide.first, slide.second))
    bores = [part.inner_diameter for part in barrel if isinstance(part, Tube)]
    rods = [part.outer_diameter for part in rod if isinstance(part, Tube)]
    if not bores or not rods or not 0.0 < max(rods) < min(bores):
        raise SceneError(
            f"crane: the areas of the {label} cylinder are not known, as its rod and barrel are no tubes "
            "that fit; give full_area and rod_side_area, m2"
        )
    full = math.pi / 4.0 * min(bores) ** 2
    return {"full_area": full, "rod_side_area": full - math.pi / 4.0 * max(rods) ** 2}
