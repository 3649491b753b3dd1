"""What each body of a scene looks like, and what is said of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.crane import Crane, load_crane, shipped_cranes
from seacrane.crane.mass_properties import MassProperties, Member, Tube, member_axes
from seacrane.description import crane_parts
from seacrane.description.description import Description, all_loads
from seacrane.description.given import USUAL_SIZE, floating_bodies, given_vessels, shown_size
from seacrane.description.loads import holding_loads, lines_of, path_of
from seacrane.errors import SceneError
from seacrane.hydro import Hull
from seacrane.hydro.hull.hull import VOLUME, shipped_hull
from seacrane.inputs.shown import shown
from seacrane.pictures.shapes import (
    BoxShape,
    HullShape,
    MeshShape,
    Shape,
    TubeShape,
    box_hull,
    distinct,
    equivalent_box,
    framework,
    hull_shape,
    schematic_size,
    wet_shapes,
)

SLENDER = 0.02  # radius of a generic body's tubes over its extent
SMALLEST = 0.02  # edge of a box over the scene's extent
SHIPPED = "hull_115"
LARGEST_HULL = 100_000  # panels: more make a page that browsers choke on
COLOURS = {
    **dict.fromkeys(("tower", "pedestal"), "tower"),
    **dict.fromkeys(("barrel", "main_barrel", "knuckle_barrel"), "barrel"),
    **dict.fromkeys(("rod", "main_rod", "knuckle_rod"), "rod"),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class Look:
    """The looks of a "vessel", "payload", "crane" or "body": shapes about its centre of mass, body axes.

    The note tells what they stand for, where they are no more than that.
    """

    role: str
    shapes: list[Shape] = field(default_factory=list)
    note: str = ""

    @property
    def points(self) -> Array:
        """(n, 3), what the shapes reach."""
        return np.concatenate([shape.points for shape in self.shapes])


def looks(
    scene: Description, *, hulls: Mapping[str, Hull] | None = None, crane: Crane | None = None
) -> dict[str, Look]:
    """The look of every body, by name; SceneError for a hull that is none, or of a body that is no vessel."""
    floating = floating_bodies(scene)
    given = _checked_hulls(hulls or {}, floating)
    members = crane_shapes(scene, crane)
    hanging, holding = set(crane_parts.payloads(scene).values()), floating | members.keys()
    for line in lines_of(scene.loads).values():
        free = [body for body, _ in path_of(line) if body in scene.bodies and body not in holding]
        hanging.update(free[-1:])
    found: dict[str, Look] = {}
    extent = _extent(scene)
    meshed = {mesh.body for mesh in scene.meshes.values()}
    of_cranes = crane_parts.crane_bodies(scene) if meshed else set()
    for name in scene.bodies:
        role = "payload" if name in hanging else "body"
        if name in meshed and name not in given:
            role = "crane" if role == "body" and name in of_cranes else role
            found[name] = _by_meshes(scene, name, "vessel" if name in floating else role)
        elif name in floating:
            found[name] = _vessel(scene, name, given.get(name))
        elif name in members:
            found[name] = Look(role="crane", shapes=members[name])
        else:
            found[name] = _generic(scene, name, role, extent)
    return found


def _checked_hulls(hulls: Mapping[str, Hull], floating: set[str]) -> dict[str, Hull]:
    if not isinstance(hulls, Mapping):
        raise SceneError(
            f"view: hulls is {shown(hulls)}; give hulls by the vessel's body, such as {{'vessel': hull}}"
        )
    for name, hull in hulls.items():
        if name not in floating:
            known = ", ".join(map(repr, sorted(floating))) or "none"
            raise SceneError(f"view: hulls names {shown(name)}; the vessels of the scene are {known}")
        if not isinstance(hull, Hull):
            raise SceneError(f"view: the hull of {name!r} is {shown(hull)}; give a seacrane.hydro.Hull")
        if len(hull.panels) > LARGEST_HULL:
            raise SceneError(
                f"view: the hull of {name!r} has {len(hull.panels)} panels, above {LARGEST_HULL}; give "
                "hull.remeshed(stations=60, girth=20)"
            )
    return dict(hulls)


def _vessel(scene: Description, name: str, hull: Hull | None) -> Look:
    body = scene.bodies[name]
    centre = np.asarray(body.center_of_mass, dtype=float)
    above = [point[2] for point in body_points(scene, name) if point[2] > 0.0]
    deck = float(np.median(above)) if above else None
    known = scene.provenance.get(name)
    if hull is None and known is not None and known.database == SHIPPED:
        displaced = 1025.0 * VOLUME
        if known.motion is not None or np.isclose(body.mass, displaced, rtol=1e-6):
            hull = shipped_hull()
    if hull is not None:
        level = deck if deck is not None else 0.6 * hull.draught
        note = f"hull {hull.name!r} below the water, straight sides above"
        return Look(role="vessel", shapes=[hull_shape(hull, level, centre)], note=note)
    if name in given_vessels(scene):
        size = shown_size(scene, name)
        note = "schematic hull, whose size nobody gave" if size == USUAL_SIZE else "schematic hull"
        return Look(role="vessel", shapes=[box_hull(*size, deck, centre)], note=note)
    size = schematic_size(body.mass, np.asarray(body.inertia))
    note = "schematic hull, from mass and inertia"
    return Look(role="vessel", shapes=[box_hull(*size, deck, centre)], note=note)


def _by_meshes(scene: Description, name: str, role: str) -> Look:
    """The user's own triangles; of a vessel with the still waterline."""
    centre = np.asarray(scene.bodies[name].center_of_mass, dtype=float)
    names = [name.removeprefix(prefix) for prefix in scene.roles] if role == "crane" else []
    colour = next((COLOURS[one] for one in names if one in COLOURS), "")
    shapes: list[Shape] = []
    for mesh in scene.meshes.values():
        given = {"vertices": mesh.vertices - centre, "faces": mesh.faces}
        if mesh.body == name and role == "vessel":
            shapes.append(HullShape(**given, waterline=-float(centre[2])))
        elif mesh.body == name:
            shapes.append(MeshShape(**given, colour=colour))
    return Look(role=role, shapes=shapes)


def _generic(scene: Description, name: str, role: str, extent: float) -> Look:
    """Its box; else tubes between the points at which others take hold of it, or a box. And its wet parts."""
    body, wet = scene.bodies[name], wet_shapes(scene, name)
    more = " and its parts in water" if wet else ""
    if np.any(body.size):
        at = -np.asarray(body.center_of_mass, dtype=float)
        sized = BoxShape(centre=at, axes=np.eye(3), size=np.maximum(body.size, SMALLEST * extent))
        return Look(role=role, shapes=[sized, *wet], note=f"the box of its size{more}")
    points = distinct([point - np.asarray(body.center_of_mass) for point in body_points(scene, name)])
    span = float(np.ptp(points, axis=0).max()) if len(points) else 0.0
    if role != "payload" and len(points) > 1 and span > SMALLEST * extent:
        tubes: list[Shape] = list(framework(points, SLENDER * span))
        return Look(role=role, shapes=[*tubes, *wet], note=f"bars between its joints{more}")
    box = equivalent_box(body.mass, np.asarray(body.inertia))
    box = replace(box, size=np.maximum(box.size, SMALLEST * extent))
    return Look(role=role, shapes=[box, *wet], note=f"the uniform box with its mass and inertia{more}")


def body_points(scene: Description, name: str) -> list[Array]:
    """Where joints, springs, cylinders and cranes take hold of a body, in its coordinates, m."""
    places: list[tuple[str, Any]] = []
    for joint in scene.joints.values():
        places += [(joint.first, joint.first_frame.point), (joint.second, joint.second_frame.point)]
    for line in lines_of(scene.loads).values():
        places += path_of(line)
    for load in holding_loads(all_loads(scene)):
        places += [(load.first, load.first_point), (load.second, load.second_point)]
    places += crane_parts.tips(scene).values()
    return [np.asarray(point, dtype=float).reshape(3) for body, point in places if body == name]


def _extent(scene: Description) -> float:
    """How far the described bodies and their joints lie apart, m; 1 for a single point."""
    joints = scene.joints.values()
    points = [np.asarray(one.first_frame.point) for one in joints if one.first not in scene.bodies]
    for name, body in scene.bodies.items():
        points += [np.asarray(body.position) + point for point in (np.zeros(3), *body_points(scene, name))]
    spread = float(np.ptp(np.array(points), axis=0).max()) if points else 0.0
    return spread or 1.0


def crane_shapes(scene: Description, crane: Crane | None) -> dict[str, list[Shape]]:
    """Members of the bodies that have the mass, centre and inertia of this crane's, or of a shipped one."""
    if not scene.roles:
        return {}
    known = [crane] if crane is not None else [load_crane(name) for name in shipped_cranes()]
    every = [(prefix, body) for prefix in scene.roles for one in known for body in one.data.bodies]
    return {
        prefix + body.name: [_shape(body.name, part, body.properties.center_of_mass) for part in body.members]
        for prefix, body in every
        if body.members and _is(scene, prefix + body.name, body.properties)
    }


def _is(scene: Description, body: str, wanted: MassProperties) -> bool:
    if body not in scene.bodies:
        return False
    there = scene.bodies[body]
    pairs = [(getattr(there, key), getattr(wanted, key)) for key in ("mass", "center_of_mass", "inertia")]
    return all(np.allclose(a, b, rtol=1e-9, atol=1e-9 * float(np.abs(b).max())) for a, b in pairs)


def _shape(name: str, member: Member, centre: Array) -> Shape:
    """A member relative to the body's centre of mass, body axes."""
    start, end = (np.array(point) - centre for point in (member.start, member.end))
    colour = COLOURS.get(name, "crane")
    if isinstance(member, Tube):
        return TubeShape(start=start, end=end, radius=0.5 * member.outer_diameter, colour=colour)
    size = np.array([float(np.linalg.norm(end - start)), member.width, member.depth])
    axes = np.column_stack(member_axes(member))
    return BoxShape(centre=0.5 * (start + end), axes=axes, size=size, colour=colour)
