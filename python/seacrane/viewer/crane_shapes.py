"""The bodies of cranes as the members of their data files."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from seacrane.crane import Crane, KnuckleBoomCrane, load_crane, shipped_cranes
from seacrane.crane.geometry import BODIES, plane_axes
from seacrane.crane.mass_properties import MassProperties, Member, Tube, member_axes
from seacrane.description.scene import Description
from seacrane.viewer.shapes import BoxShape, Shape, TubeShape

Array = NDArray[np.float64]
COLOURS = {
    "tower": "tower",
    "pedestal": "tower",
    "main_barrel": "barrel",
    "main_rod": "rod",
    "knuckle_barrel": "barrel",
    "knuckle_rod": "rod",
    "barrel": "barrel",
    "rod": "rod",
}


def crane_shapes(scene: Description, crane: Crane | None) -> dict[str, list[Shape]]:
    """Members of the bodies that are this crane's (default: those that come with seacrane) by their mass,
    centre of mass and inertia, in every crane of the scene."""
    if not scene.roles:
        return {}
    known = list(_known(crane))
    shapes: dict[str, list[Shape]] = {}
    for prefix in scene.roles:
        for one, members in known:
            for name, parts in members.items():
                properties = one.mass_properties[name]
                if _is(scene, prefix + name, properties):
                    centre = properties.center_of_mass
                    shapes[prefix + name] = [_shape(name, part, one, centre) for part in parts]
    return shapes


def _known(crane: Crane | None) -> Iterator[tuple[Crane, dict[str, tuple[Member, ...]]]]:
    for one in [crane] if crane is not None else map(load_crane, shipped_cranes()):
        if isinstance(one, KnuckleBoomCrane):
            yield one, {name: one.data.members()[name] for name in BODIES}
        else:
            yield one, one.members()


def _is(scene: Description, body: str, wanted: MassProperties) -> bool:
    if body not in scene.bodies:
        return False
    there = scene.bodies[body]
    pairs = [(getattr(there, key), getattr(wanted, key)) for key in ("mass", "center_of_mass", "inertia")]
    return all(np.allclose(a, b, rtol=1e-9, atol=1e-9 * float(np.abs(b).max())) for a, b in pairs)


def _shape(name: str, member: Member, crane: Crane, centre: Array) -> Shape:
    """A member relative to the body's centre of mass, body axes."""
    ends = [np.array(point) for point in (member.start, member.end)]
    if isinstance(crane, KnuckleBoomCrane):
        ends = [plane_axes(name) @ point for point in ends]
    start, end = (point - centre for point in ends)
    colour = COLOURS.get(name, "crane")
    if isinstance(member, Tube):
        return TubeShape(start=start, end=end, radius=0.5 * member.outer_diameter, colour=colour)
    along = (end - start) / np.linalg.norm(end - start)
    across = np.array([0.0, 1.0, 0.0])
    if not isinstance(crane, KnuckleBoomCrane):
        across = member_axes(member)[1]
    size = np.array([float(np.linalg.norm(end - start)), member.width, member.depth])
    axes = np.column_stack([along, across, np.cross(along, across)])
    return BoxShape(centre=0.5 * (start + end), axes=axes, size=size, colour=colour)
