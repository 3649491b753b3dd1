"""Sheaves as discs, the drums of winches, which turn as they pay out, and what contacts press on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from seacrane import _core
from seacrane.description.description import Description
from seacrane.description.line_path import Array, described_poses, laid
from seacrane.description.loads import lines_of, winch_of
from seacrane.description.places import place_of
from seacrane.description.revolved import revolved
from seacrane.inputs.frames import rotation_matrix
from seacrane.pictures.drawn_bodies import Look
from seacrane.pictures.pose_curves import Motion, linear_rows
from seacrane.pictures.shapes import BoxShape, MeshShape, Shape, TubeShape, plain
from seacrane.pictures.wires import end_of
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


@dataclass(frozen=True, kw_only=True, eq=False)
class Wheel:
    """A sheave or a drum on its body; or a surface of a contact, which does not turn.

    Attributes
    ----------
    name : Such as "hoist sheave 1" or "hoist drum".
    at : Its centre, as the end of a wire.
    axis : (3,) Of length one, body axes.
    kind : "sheave", "drum" or "surface".
    shapes : Relative to the centre, body axes.
    angle : ndarray, shape (frames,), or None
        By which it has turned about its axis, rad; None for what stands still on its body.
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
    for wheel in (*drums, *sheaves):
        if wheel is not None:
            found.setdefault(_place(wheel), wheel)
    return list(found.values())


def _place(wheel: Wheel) -> tuple[float, ...]:
    """Alike for wheels at one place about one axis, whatever its sign."""
    sign = np.sign(wheel.axis[int(np.argmax(np.abs(wheel.axis)))])
    return (*wheel.at, *plain(sign * wheel.axis))


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
        half = 0.5 * float(size[2]) * axes[:, 2]
        return TubeShape(start=-half, end=half, radius=0.5 * float(size[1]))
    if contact.surface == "pipe":
        inner, outer, half = 0.5 * size
        wall = np.array([[inner, -half], [outer, -half], [outer, half], [inner, half]])
        points, faces = revolved(wall, AROUND, closed=True)
        return MeshShape(vertices=points @ axes.T, faces=faces)
    return _plate(axes, _points(scene, contact) @ axes)


def _points(scene: Description, contact: _core.Contact) -> Array:
    """Points of a contact as described, from its place, in axes of the surface's body, (n, 3), m."""
    places = np.array([place_of(scene, body=contact.body, point=point) for point in contact.points])
    away = places - place_of(scene, body=contact.on, point=contact.place)
    body = scene.bodies.get(contact.on)
    return away if body is None else np.asarray(away @ rotation_matrix(body.quaternion))


def _plate(axes: Array, points: Array) -> BoxShape:
    """A piece of a plane below points (n, 3) in its own axes."""
    low, high = points[:, :2].min(axis=0) - MARGIN, points[:, :2].max(axis=0) + MARGIN
    centre = axes @ np.array([*(0.5 * (low + high)), -0.5 * PLATE])
    return BoxShape(centre=centre, axes=axes, size=np.array([*(high - low), PLATE]))
