"""Links, wires, springs, lines and cylinders between points of bodies, slack ones with their length."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.crane_parts import luffing_ropes
from seacrane.description.description import Description
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, slide_of
from seacrane.description.line_path import Array, described_poses, laid
from seacrane.description.loads import lines_of, springs_of
from seacrane.pictures.shapes import plain

GROUND = -1
WALL = 1.15  # outer over inner radius of a barrel
THINNEST_ROD = 0.4  # of the piston, where both sides have one area
STEEL_ROPE = 40e9  # N/m2, EA over the square of the diameter; unverified


def wires_of(scene: Description, bodies: Sequence[str]) -> list[dict[str, Any]]:
    """Distance joints, springs, the spans of elastic lines, and hydraulic cylinders for the page.

    Of each: name, the element that it is of, kind ("link", "wire", "spring", "barrel" or "rod"; a span is a
    link), both ends as the body's number (-1: the ground) and a point relative to its centre of mass, the
    length (m) below which it hangs slack, 0 if it never does, the radius (m) that it has, 0 for that of all
    lines, how far it goes (m), 0 for all the way, and the radius (m) of a steel rope of its EA, 0 where that
    is not known. A luffing rope whose hinge is led by the moment is a link. Arcs over sheaves are short links
    without a name. Where a line meets a sheave is as in the pose that the scene describes.
    """
    limits = {limit.joint for limit in scene.loads.values() if getattr(limit, "kind", None) == "wire"}
    found = []
    for name, joint in scene.joints.items():
        if joint.kind == "distance":
            pulls = name in limits
            start = end_of(scene, bodies, joint.first, joint.first_frame.point)
            stop = end_of(scene, bodies, joint.second, joint.second_frame.point)
            slack = float(joint.parameters["length"]) if pulls else 0.0
            found.append(_wire(name, "wire" if pulls else "link", start, stop, length=slack))
    for name, spring in springs_of(scene.springs, scene.loads):
        start = end_of(scene, bodies, spring.first, spring.first_point)
        stop = end_of(scene, bodies, spring.second, spring.second_point)
        found.append(_wire(name, "spring", start, stop, length=_free_length(spring)))
    for name, line in lines_of(scene.loads).items():
        found += _over(scene, bodies, name, line)
    for rope in luffing_ropes(scene).values():
        if rope.name not in scene.loads:  # else it is a line
            start, stop = (end_of(scene, bodies, *block) for block in (rope.first, rope.second))
            found.append(_wire(rope.name, "link", start, stop))
    of_cranes = {slide for roles in scene.roles.values() for slide in roles.cylinders.values()}
    for name, cylinder in hydraulic_cylinders(scene).items():
        if slide_of(scene, cylinder) not in of_cranes:  # else its barrel and its rod are bodies
            found += _cylinder(scene, bodies, name, cylinder)
    return found


def _wire(element: str, kind: str, start: list[float], stop: list[float], **given: Any) -> dict[str, Any]:
    """As `wires_of` tells it."""
    usual = {"name": element, "length": 0.0, "radius": 0.0, "reach": 0.0, "size": 0.0}
    return {"element": element, "kind": kind, "from": start, "to": stop} | usual | given


def _cylinder(
    scene: Description, bodies: Sequence[str], name: str, one: _core.HydraulicCylinder
) -> list[dict[str, Any]]:
    """A rod from point to point, and about it the barrel, as long as the cylinder is retracted."""
    piston = np.sqrt(one.full_area / np.pi)
    rod = max(np.sqrt((one.full_area - one.rod_side_area) / np.pi), THINNEST_ROD * piston)
    ends = (
        end_of(scene, bodies, one.first, one.first_point),
        end_of(scene, bodies, one.second, one.second_point),
    )
    wall = float(WALL * piston)
    return [
        _wire(name, "rod", *ends, radius=float(rod)),
        _wire(name, "barrel", *ends, name="", radius=wall, reach=one.retracted_length),
    ]


def _over(scene: Description, bodies: Sequence[str], name: str, line: _core.Line) -> list[dict[str, Any]]:
    """Spans and arcs of an elastic line."""
    poses = described_poses(scene)
    path = laid(line, poses)

    def end(at: int, place: Array) -> list[float]:
        origin, rotation = poses(line.bodies[at])
        return end_of(scene, bodies, line.bodies[at], rotation.T @ (place - origin))

    size = 0.5 * float(np.sqrt(line.EA / STEEL_ROPE))
    found = [
        _wire(name, "link", end(i, start), end(i + 1, stop), name=f"{name} {i + 1}", size=size)
        for i, (start, stop) in enumerate(zip(path.starts, path.ends, strict=True))
    ]
    for at in np.flatnonzero(path.wraps > 0.0).tolist():
        arc = [end(at, place) for place in path.arc(at)]
        found += [_wire(name, "link", *ends, name="", size=size) for ends in pairwise(arc)]
    return found


def end_of(scene: Description, bodies: Sequence[str], body: str, point: Any) -> list[float]:
    """Number of the body, and the point (m) relative to its centre of mass."""
    where = np.asarray(point, dtype=float).reshape(3)
    if body not in scene.bodies:
        return [GROUND, *plain(where)]
    return [
        list(bodies).index(body),
        *plain(where - np.asarray(scene.bodies[body].center_of_mass).reshape(3)),
    ]


def _free_length(spring: Any) -> float:
    """The longest length at which a table of tension is still zero; 0 for a spring that also pushes."""
    if not hasattr(spring, "lengths"):
        return 0.0
    free = [length for length, force in zip(spring.lengths, spring.forces, strict=True) if force <= 0.0]
    return float(max(free)) if free and spring.forces[0] == 0.0 else 0.0
