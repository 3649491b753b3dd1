"""Links, wires, cylinders, sheaves, drums that turn as they pay out, and what contacts press on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.crane_parts import luffing_ropes
from seacrane.description.description import Description, all_loads
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, slide_of
from seacrane.description.line_path import described_poses, laid
from seacrane.description.loads import drawn_springs, lines_of, winch_of
from seacrane.description.places import place_of
from seacrane.description.revolved import revolved
from seacrane.inputs.frames import rotation_matrix
from seacrane.pictures.drawn_bodies import Look
from seacrane.pictures.pose_curves import Motion, linear_rows
from seacrane.pictures.shapes import BoxShape, MeshShape, Shape, TubeShape, plain
from seacrane.result import Result

UP = np.array([0.0, 0.0, 1.0])
ON_RIM = 1e-3  # of the radius: a line that starts that near to a rim starts on it
UPRIGHT = 1e-6  # sine of the angle to the vertical below which a direction has no horizontal part
# Of the radius, along the axis and across it.
DISC, HUB_WIDTH, HUB = 0.2, 0.3, 0.25
BARREL, FLANGE_WIDTH, FLANGE, MARK = 1.8, 0.1, 1.3, 0.08
PLATE = 0.05  # m, that is drawn of a plane, below it
MARGIN = 1.0  # m, of a plane beyond the points that come down on it
AROUND = 24  # faces of a pipe
SURFACE = "surface"
GROUND = -1
WALL = 1.15  # outer over inner radius of a barrel
THINNEST_ROD = 0.4  # of the piston, where both sides have one area
STEEL_ROPE = 40e9  # N/m2, EA over the square of the diameter; unverified


def wires_of(scene: Description, bodies: Sequence[str]) -> list[dict[str, Any]]:
    """Distance joints, springs, the spans of elastic lines, and hydraulic cylinders for the page.

    Of each: name, the element that it is of, kind ("link", "wire", "spring", "barrel" or "rod"; a span is a
    link), both ends as the body's number (-1: the ground) and a point relative to its centre of mass, the
    length below which it hangs slack, its radius, its reach, and as `size` the radius of a steel rope of its
    EA, m, 0 where that does not apply. Arcs over sheaves are short links without a name, as described.
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
    for spring in drawn_springs(all_loads(scene)):
        found.append(_wire(spring.name, "spring", *_ends(scene, bodies, spring), length=_free_length(spring)))
    for name, line in lines_of(scene.loads).items():
        found += _over(scene, bodies, name, line)
    for rope in luffing_ropes(scene).values():
        if rope.name not in scene.loads:  # else it is a line
            start, stop = (end_of(scene, bodies, *block) for block in (rope.first, rope.second))
            found.append(_wire(rope.name, "link", start, stop))
    of_cranes = {slide for roles in scene.roles.values() for slide in roles.cylinders.values()}
    for name, one in hydraulic_cylinders(scene).items():
        if slide_of(scene, one) in of_cranes:  # its barrel and its rod are bodies
            continue
        piston, ends = np.sqrt(one.full_area / np.pi), _ends(scene, bodies, one)
        rod = max(np.sqrt((one.full_area - one.rod_side_area) / np.pi), THINNEST_ROD * piston)
        barrel: dict[str, Any] = {"name": "", "radius": float(WALL * piston), "reach": one.retracted_length}
        found += [_wire(name, "rod", *ends, radius=float(rod)), _wire(name, "barrel", *ends, **barrel)]
    return found


def _wire(element: str, kind: str, start: list[float], stop: list[float], **given: Any) -> dict[str, Any]:
    """As `wires_of` tells it."""
    usual = {"name": element, "length": 0.0, "radius": 0.0, "reach": 0.0, "size": 0.0}
    return {"element": element, "kind": kind, "from": start, "to": stop} | usual | given


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
    centre = np.asarray(scene.bodies[body].center_of_mass).reshape(3)
    return [list(bodies).index(body), *plain(where - centre)]


def _ends(scene: Description, bodies: Sequence[str], one: Any) -> tuple[list[float], list[float]]:
    """Both ends of an element between two points."""
    first = end_of(scene, bodies, one.first, one.first_point)
    return first, end_of(scene, bodies, one.second, one.second_point)


def _free_length(spring: Any) -> float:
    """The longest length at which a table of tension is still zero; 0 for a spring that also pushes."""
    if not hasattr(spring, "lengths"):
        return 0.0
    free = [length for length, force in zip(spring.lengths, spring.forces, strict=True) if force <= 0.0]
    return float(max(free)) if free and spring.forces[0] == 0.0 else 0.0


@dataclass(frozen=True, kw_only=True, eq=False)
class Wheel:
    """A "sheave" or a "drum" on its body; or a "surface" of a contact, which does not turn.

    Its centre is as the end of a wire, its axis of length one and its shapes about the centre are in body
    axes, the angle (frames,) is that by which it has turned, rad; None for what stands still on its body.
    """

    name: str
    at: list[float]
    axis: Array
    kind: str
    shapes: Sequence[Shape]
    angle: Array | None = None

    @property
    def reach(self) -> float:
        """How far from its centre it goes, m."""
        radii = [one.radius if isinstance(one, TubeShape) else 0.0 for one in self.shapes]
        far = [float(np.linalg.norm(one.points, axis=1).max()) for one in self.shapes]
        return max(map(sum, zip(far, radii, strict=True)))

    @property
    def look(self) -> Look:
        """As of a body."""
        return Look(role=self.kind, shapes=list(self.shapes))


def turns(axis: Array, angles: Array) -> Array:
    """Unit quaternions (n, 4), w first, that turn about an axis by angles, rad."""
    return np.asarray(np.column_stack([np.cos(0.5 * angles), np.sin(0.5 * angles)[:, None] * axis]))


def wheels_of(scene: Description, result: Result | None, motion: Motion) -> list[Wheel]:
    """Drums, and every other sheave once, however often lines pass it."""
    lines = lines_of(scene.loads)
    drums = [_drum(scene, result, motion, line) for line in lines.values() if line.winch]
    sheaves = [
        _sheave(scene, motion, f"{name} sheave {i}", line, i)
        for name, line in lines.items()
        for i in np.flatnonzero(line.radii).tolist()
    ]
    found: dict[tuple[float, ...], Wheel] = {}
    for wheel in filter(None, (*drums, *sheaves)):
        sign = np.sign(wheel.axis[int(np.argmax(np.abs(wheel.axis)))])  # at one place, about one axis
        found.setdefault((*wheel.at, *plain(sign * wheel.axis)), wheel)
    return list(found.values())


def _sheave(scene: Description, motion: Motion, name: str, line: _core.Line, i: int) -> Wheel:
    axis, radius = _unit(line.axes[i]), line.radii[i]
    at = end_of(scene, motion.bodies, line.bodies[i], line.points[i])
    disc = _round(axis, DISC * radius, radius, "sheave")
    hub = _round(axis, HUB_WIDTH * radius, HUB * radius, "hub")
    return Wheel(name=name, kind="sheave", at=at, axis=axis, shapes=[disc, hub])


def _drum(scene: Description, result: Result | None, motion: Motion, line: _core.Line) -> Wheel | None:
    """That of a winch, if it has one: the sheave on whose rim its line starts, or one of `drum_radius`."""
    if _starts_on_rim(line):
        centre, axis, radius = line.points[1], _unit(line.axes[1]), float(line.radii[1])
    elif line.drum_radius > 0.0:
        radius = line.drum_radius
        centre, axis = _beside_first_span(scene, line, radius)
    else:
        return None
    return Wheel(
        name=f"{winch_of(line)} drum", kind="drum", at=end_of(scene, motion.bodies, line.bodies[0], centre),
        axis=axis, shapes=_barrel(axis, radius), angle=_angle(result, motion, line, radius),
    )  # fmt: skip


def _starts_on_rim(line: _core.Line) -> bool:
    """Whether the first point is on the rim of the sheave that comes next, both on one body."""
    if not len(line.radii) or line.radii[1] == 0.0 or line.bodies[0] != line.bodies[1]:
        return False
    apart = line.points[0] - line.points[1]
    return bool(abs(np.linalg.norm(apart) - line.radii[1]) < ON_RIM * line.radii[1])


def _beside_first_span(scene: Description, line: _core.Line, radius: float) -> tuple[Array, Array]:
    """Centre and axis, body coordinates, of a drum whose upper side the first span leaves."""
    poses = described_poses(scene)
    _, turn = poses(line.bodies[0])
    path = laid(line, poses)
    span = path.ends[0] - path.starts[0]
    along = _unit(span) if np.any(span) else -UP
    level = (np.cross(UP, one) for one in (along, turn[:, 0], turn[:, 1]))
    axis = _unit(next(one for one in level if np.linalg.norm(one) > UPRIGHT))
    out = _unit(np.cross(along, axis))
    return line.points[0] - radius * (turn.T @ out), turn.T @ axis


def _angle(result: Result | None, motion: Motion, line: _core.Line, radius: float) -> Array | None:
    """rad, at the frames; None without the paid-out length."""
    for channel, dim, name, share in (
        ("line_unstretched_length", "line", line.name, line.share),
        ("load_state", "state_name", f"{winch_of(line)}.length", 1.0),
    ):
        if result is not None and channel in result.channels and name in result.coords[dim]:
            length = result.select(channel, **{dim: name}) / share
            return np.asarray(linear_rows(motion, result.time, (length - length[0]) / radius)[0])
    return None


def _barrel(axis: Array, radius: float) -> list[TubeShape]:
    """Between two flanges, with a mark on each that shows how it turns."""
    out = 0.5 * BARREL * radius * axis
    thick = 0.5 * FLANGE_WIDTH * radius * axis
    across = _unit(np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))]))
    shapes = [_round(axis, BARREL * radius, radius, "barrel")]
    for side in (-1.0, 1.0):
        centre, face = side * out, side * (out + thick)
        rim = face + FLANGE * radius * across
        shapes += [
            TubeShape(start=centre - thick, end=centre + thick, radius=FLANGE * radius, colour="drum"),
            TubeShape(start=face, end=rim, radius=MARK * radius, colour="mark"),
        ]
    return shapes


def _round(axis: Array, width: float, radius: float, colour: str) -> TubeShape:
    """A disc about the origin."""
    return TubeShape(start=-0.5 * width * axis, end=0.5 * width * axis, radius=radius, colour=colour)


def _unit(vector: Array) -> Array:
    return np.asarray(vector / np.linalg.norm(vector))


def surfaces_of_contacts(scene: Description, motion: Motion) -> Iterator[Wheel]:
    """Each as something on its body, or on the ground, that does not turn."""
    for name, contact in scene.loads.items():
        if isinstance(contact, _core.Contact):
            at = end_of(scene, motion.bodies, contact.on, contact.place)
            yield Wheel(name=name, kind=SURFACE, at=at, axis=UP, shapes=[_contact_shape(scene, contact)])


def _contact_shape(scene: Description, contact: _core.Contact) -> Shape:
    """About the place of the surface, in axes of its body."""
    axes, size = np.asarray(contact.axes, dtype=float), np.asarray(contact.size, dtype=float)
    if contact.surface == "box":
        return BoxShape(centre=np.zeros(3), axes=axes, size=size)
    if contact.surface == "post":
        return _round(axes[:, 2], float(size[2]), 0.5 * float(size[1]), "")
    if contact.surface == "pipe":
        inner, outer, half = 0.5 * size
        wall = np.array([[inner, -half], [outer, -half], [outer, half], [inner, half]])
        points, faces = revolved(wall, AROUND, closed=True)
        return MeshShape(vertices=points @ axes.T, faces=faces)
    away = np.array([place_of(scene, body=contact.body, point=point) for point in contact.points])
    away = away - place_of(scene, body=contact.on, point=contact.place)
    if (body := scene.bodies.get(contact.on)) is not None:
        away = away @ rotation_matrix(body.quaternion)
    points = away @ axes  # a piece of a plane below the points of the contact, in its own axes
    low, high = points[:, :2].min(axis=0) - MARGIN, points[:, :2].max(axis=0) + MARGIN
    centre = axes @ np.array([*(0.5 * (low + high)), -0.5 * PLATE])
    return BoxShape(centre=centre, axes=axes, size=np.array([*(high - low), PLATE]))
