"""The bodies of a knuckle-boom crane as the members of its data file."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.crane import KnuckleBoomCrane
from seacrane.crane.geometry import BODIES, plane_axes
from seacrane.crane.mass_properties import Member, Tube
from seacrane.description.scene import Description
from seacrane.viewer.shapes import BoxShape, Shape, TubeShape

Array = NDArray[np.float64]
COLOURS = {
    "tower": "tower",
    "main_barrel": "barrel",
    "main_rod": "rod",
    "knuckle_barrel": "barrel",
    "knuckle_rod": "rod",
}


def crane_shapes(scene: Description, crane: KnuckleBoomCrane | None) -> dict[str, list[Shape]]:
    """Members of the bodies that are this crane's (default: the one that comes with seacrane) by their mass,
    centre of mass and inertia, in every crane of the scene."""
    crane = crane or KnuckleBoomCrane.load()
    members = crane.data.members()
    shapes: dict[str, list[Shape]] = {}
    for prefix in scene.roles:
        for name in BODIES:
            if _is(scene, prefix + name, crane, name):
                shapes[prefix + name] = [_shape(name, member, crane) for member in members[name]]
    return shapes


def _is(scene: Description, body: str, crane: KnuckleBoomCrane, name: str) -> bool:
    if body not in scene.bodies:
        return False
    there, wanted = scene.bodies[body], crane.mass_properties[name]
    pairs = [(getattr(there, key), getattr(wanted, key)) for key in ("mass", "center_of_mass", "inertia")]
    return all(np.allclose(a, b, rtol=1e-9, atol=1e-9 * float(np.abs(b).max())) for a, b in pairs)


def _shape(name: str, member: Member, crane: KnuckleBoomCrane) -> Shape:
    """A member relative to the body's centre of mass, body axes."""
    plane = plane_axes(name)
    centre = crane.mass_properties[name].center_of_mass
    start, end = (plane @ np.array(point) - centre for point in (member.start, member.end))
    colour = COLOURS.get(name, "crane")
    if isinstance(member, Tube):
        return TubeShape(start=start, end=end, radius=0.5 * member.outer_diameter, colour=colour)
    along = (end - start) / np.linalg.norm(end - start)
    across = np.array([0.0, 1.0, 0.0])
    size = np.array([float(np.linalg.norm(end - start)), member.width, member.depth])
    axes = np.column_stack([along, across, np.cross(along, across)])
    return BoxShape(centre=0.5 * (start + end), axes=axes, size=size, colour=colour)
