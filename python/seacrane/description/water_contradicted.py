"""What a scene says twice of its water, and not alike: buoyancy of a hull, depth of a sea."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from seacrane import _core
from seacrane.description.given import floating_bodies, given_vessels
from seacrane.description.places import placed
from seacrane.description.wet_parts import displaced_volume, half_height, immersed_parts
from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_matrix
from seacrane.sea.dispersion import wavenumber

if TYPE_CHECKING:
    from seacrane.description.description import Description

LARGEST_DIFFERENCE = 0.05  # of a sea's wavenumbers, weighed by energy, between two depths
LEVEL = 0.999  # cosine of a seabed's normal with the vertical


def refuse_contradictions_in_water(scene: Description) -> None:
    """Raise SceneError for either."""
    _refuse_parts_of_hulls(scene)
    _refuse_seabeds(scene)


def starts_wet(scene: Description, part: _core.ImmersedPart) -> tuple[float, float]:
    """How deep the top and the lowest point of a part are below z = 0 as described, m."""
    turn = rotation_matrix(scene.bodies[part.body].quaternion) @ np.asarray(part.axes)
    depth, half = -float(placed(scene, part.body, part.point)[2]), float(half_height(part, turn))
    return depth - half, depth + half


def _refuse_parts_of_hulls(scene: Description) -> None:
    hulls = floating_bodies(scene) - set(given_vessels(scene))  # which go as they are given
    for part in immersed_parts(scene).values() if hulls else ():
        if part.body in hulls and displaced_volume(part) > 0.0 and starts_wet(scene, part)[1] > 0.0:
            raise SceneError(
                f"immersed part {part.name!r}: displaces {displaced_volume(part):.4g} m3 as a part of "
                f"{part.body!r}, which floats by its restoring: what the hull displaces is in that already. "
                "Take it without volume for its drag and added mass alone (a box with fill=0, a table with "
                "volumes of 0), or put what is no part of that hull on a body of its own, welded to it"
            )


def _refuse_seabeds(scene: Description) -> None:
    waves = scene.waves
    if waves is None or not np.any(waves.amplitude):
        return
    energy = np.abs(np.asarray(waves.amplitude)) ** 2
    omega = np.asarray(waves.omega, dtype=float)
    known = wavenumber(omega, g=scene.gravity, depth=waves.depth)
    for depth, what in {depth: what for what, depth in _seabeds(scene)}.items():
        there = wavenumber(omega, g=scene.gravity, depth=depth)
        difference = float((energy * np.abs(there / known - 1.0)).sum() / energy.sum())
        if difference > LARGEST_DIFFERENCE:
            sea = "of infinite depth" if np.isinf(waves.depth) else f"{waves.depth:g} m deep"
            raise SceneError(
                f"{what}: lies {depth:g} m below z = 0, and the sea is {sea}: wavenumbers differ by "
                f"{difference:.0%}. Give the sea the depth of the place (SeaState(depth={depth:g}), with a "
                "database of that depth where a vessel has one)"
            )


def _seabeds(scene: Description) -> Iterator[tuple[str, float]]:
    """Level planes of the ground below z = 0, with their depths, m."""
    for name, load in scene.loads.items():
        if isinstance(load, _core.SeabedNode):
            yield f"seabed of {name.removesuffix(' seabed')!r}", float(load.depth)
        elif isinstance(load, _core.Contact) and load.surface == "plane" and load.on not in scene.bodies:
            level, depth = np.asarray(load.axes)[2, 2] > LEVEL, -float(load.place[2])
            if level and depth > 0.0:
                yield f"contact {name!r}", depth
