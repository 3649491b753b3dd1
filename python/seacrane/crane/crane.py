"""A crane of bodies and joints: knuckle and lattice booms, A-frames, gantries, robots' arms."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, is_dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.crane.data import BodyData, CraneData, JointData, Placed, RopeData
from seacrane.crane.mass_properties import MassProperties, Tube
from seacrane.crane.parts import CraneParts
from seacrane.crane.pose import UNITS, Pose, extent_of, gap_rates, in_loops, pose_of, twists
from seacrane.description.description import Description
from seacrane.description.hydraulic_cylinders import place_cylinder
from seacrane.description.roles import require_cylinders
from seacrane.errors import SceneError
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import numbers_of
from seacrane.inputs.frames import quaternion_of
from seacrane.inputs.shown import shown
from seacrane.one_thread import one_thread

Vector = tuple[float, float, float]
Hydraulics = Mapping[str, Mapping[str, Any]]
ROUNDING = 1e-9  # rad or m
ON_AXIS = 1e-6  # of the crane's extent: a pin so near to the axis is on it
STANDARD_GRAVITY = 9.80665


@dataclass(frozen=True, eq=False)
class Crane:
    """A crane of bodies and joints, from its data. Make one with `load_crane`.

    Coordinates are those of its joints from the pose in which it is drawn, its home: rad and m, by the labels
    "slew" and those of its luffs and cylinders, of a knuckle boom also "s1" and "s2". Methods take them as
    keywords; those that are not given stay at home, or follow their loop. An unknown coordinate, a value
    out of its range and a loop that cannot close are a SceneError.
    """

    data: CraneData

    __repr__ = brief

    def __post_init__(self) -> None:
        _lock(self.data)

    @property
    def mass_properties(self) -> dict[str, MassProperties]:
        """Of every body, in its own frame."""
        return {body.name: body.properties for body in self.data.bodies}

    @property
    def mass(self) -> float:
        """The mass of all bodies, kg."""
        return math.fsum(body.properties.mass for body in self.data.bodies)

    def body(self, name: str) -> BodyData:
        """The data of a body."""
        return next(one for one in self.data.bodies if one.name == name)

    def tip(self, **coordinates: float) -> Array:
        """The tip in the crane-foot frame, shape (3,), m."""
        return self.points(**coordinates)["tip"]

    def points(self, **coordinates: float) -> dict[str, Array]:
        """Points of its joints by name and the "tip", in the crane-foot frame, each shape (3,), m."""
        moved = pose_of(self.data, coordinates).moved
        body, tip = self.data.tip
        points = {joint.name: moved[joint.first].point(joint.point) for joint in self.data.joints}
        return points | {"tip": moved[body].point(tip)}

    def center_of_mass(self, *, foot: Vector | Array = (0.0, 0.0, 0.0), **coordinates: float) -> Array:
        """Common centre of mass of all bodies, shape (3,), m, of a crane whose foot is at `foot`."""
        moved = pose_of(self.data, coordinates).moved
        moments = [one.properties.mass * moved[one.name].point(one.center) for one in self.data.bodies]
        return np.asarray(_point("foot", foot) + np.sum(moments, axis=0) / self.mass)

    def static_cylinder_forces(
        self, *, payload_mass: float = 0.0, gravity: float = STANDARD_GRAVITY, **coordinates: float
    ) -> Array:
        """Forces of the cylinders at rest on a level base, N, shape (cylinders,), positive when they push.

        By virtual work, the slope of the potential energy over each stroke, the other strokes held. The
        cylinders' own weights count, and the payload's (kg), which hangs at rest from the tip; gravity: m/s2.
        """
        moved = pose_of(self.data, coordinates).moved
        strokes = [self.data.tree[name] for name in self.data.cylinders.values()]
        follow = [joint for joint in in_loops(self.data) if joint not in strokes]
        forces = np.array([self._weight(joint, moved, payload_mass)[0] for joint in strokes])
        if strokes and follow:
            weights = np.concatenate([self._weight(joint, moved, payload_mass) for joint in follow])
            with one_thread:
                rates = np.linalg.lstsq(
                    gap_rates(self.data, follow, moved), -gap_rates(self.data, strokes, moved), rcond=None
                )[0]
            forces = forces + weights @ rates
        return np.asarray(gravity * forces)

    def parts(self, *, foot: Vector | Array = (0.0, 0.0, 0.0), **coordinates: float) -> CraneParts:
        """All that it brings into a scene at a pose, with its foot at `foot` of its base's frame, m."""
        at, pose = _point("foot", foot), pose_of(self.data, coordinates)
        decks = [
            JointData(name="deck", kind="weld", first="", second=body.name, point=at)
            for body in self.data.bodies
            if body.name == self.data.root
        ]
        body, tip = self.data.tip
        return CraneParts(
            bodies=[_body(one, at, pose) for one in self.data.bodies],
            joints=[*decks, *(self._joint(joint, at, pose) for joint in self.data.joints)],
            tip=(body, at + pose.moved[body].point(tip)),
            ranges=self._ranges(pose),
            ropes=tuple(_rope(rope, at, pose) for rope in self.data.ropes),
        )

    def _weight(self, joint: JointData, moved: Mapping[str, Placed], payload_mass: float) -> Array:
        """Rates of mass times height, kg m, with each coordinate of a joint."""
        beyond, (holder, tip) = self.data.beyond(joint.name), self.data.tip
        loads = [
            (one.properties.mass, moved[one.name].point(one.center))
            for one in self.data.bodies
            if one.name in beyond
        ]
        loads += [(payload_mass, moved[holder].point(tip))] if holder in beyond else []
        return np.array([
            math.fsum(mass * float(up @ [*place, 1.0]) for mass, place in loads)
            for *_, up in twists(joint, moved)
        ])  # fmt: skip

    def _joint(self, joint: JointData, foot: Array, pose: Pose) -> JointData:
        first, second = pose.moved[joint.first], pose.moved[joint.second]
        massless = {self.data.root: ""} if self.data.root not in self.mass_properties else {}
        return replace(
            joint, first=massless.get(joint.first, joint.first),
            second=massless.get(joint.second, joint.second), point=foot + first.point(joint.point),
            axis=None if joint.axis is None else first.axes @ joint.axis,
            second_axis=None if joint.second_axis is None else second.axes @ joint.second_axis,
        )  # fmt: skip

    def _ranges(self, pose: Pose) -> dict[str, tuple[float, float]]:
        """From the pose on; SceneError for a pose that is out of one."""
        found = {}
        for joint in self.data.tree.values():
            if joint.range is not None:
                value, (low, high) = float(pose.values[joint.name][0]), joint.range
                if not low - ROUNDING <= value <= high + ROUNDING:
                    raise SceneError(
                        f"crane {self.data.name!r}: joint {joint.name!r} is at {value:g} {UNITS[joint.kind]} "
                        f"in this pose, outside its range of {low:g} to {high:g}; give coordinates within"
                    )
                found[joint.name] = (min(low - value, 0.0), max(high - value, 0.0))
        return found


def _lock(value: Any) -> None:
    """From now on no array in it is written into: scenes share a crane."""
    if isinstance(value, np.ndarray):
        value.setflags(write=False)
    for one in value if isinstance(value, tuple) else vars(value).values() if is_dataclass(value) else ():
        _lock(one)


def _body(body: BodyData, foot: Array, pose: Pose) -> _core.Body:
    placed, given = pose.moved[body.name].inner(body.frame), body.properties
    return _core.Body(
        name=body.name, mass=given.mass, inertia=given.inertia, center_of_mass=given.center_of_mass,
        position=foot + placed.origin, quaternion=quaternion_of(placed.axes),
    )  # fmt: skip


def _rope(rope: RopeData, foot: Array, pose: Pose) -> RopeData:
    ends = [(body, foot + pose.moved[body].point(at)) for body, at in (rope.first, rope.second)]
    return replace(rope, first=ends[0], second=ends[1])


def _point(name: str, value: Vector | Array) -> Array:
    point = numbers_of(f"crane: {name}", value).copy()
    if point.shape != (3,) or not np.all(np.isfinite(point)):
        raise SceneError.of(f"crane: {name}", f"is {value!r}; give three finite numbers (x, y, z) in m.")
    return point


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
    scene: Description, crane: Crane, hydraulics: Hydraulics, *, coordinates: Mapping[str, float],
    payload_mass: float, prefix: str,
) -> None:  # fmt: skip
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

    The points are the outermost pins of both on the cylinder's axis; SceneError where there are none, or for
    a cylinder without a range.
    """
    what, axis = f"crane {crane.data.name!r}: cylinder {label!r}", slide.axis
    assert axis is not None
    if slide.range is None:
        raise SceneError(f"{what}: has no range, which its stroke would be; give its joint a range_m")
    near, reaches, points = ON_AXIS * extent_of(crane.data), [], []
    for name, outward in ((slide.first, -1.0), (slide.second, 1.0)):
        pins = [
            one.point for one in crane.data.joints if name in (one.first, one.second) and one is not slide
        ]
        on_axis = [at for at in pins if float(np.linalg.norm(np.cross(axis, at - slide.point))) < near]
        if not on_axis:
            raise SceneError(
                f"{what}: where it takes hold is not known, as no other joint of {name!r} is on its axis; "
                "add it by add_hydraulic_cylinder with its points"
            )
        pin = max(on_axis, key=lambda at: outward * float((at - slide.point) @ axis))
        frame = crane.body(name).frame
        reaches.append(float(pin @ axis))
        points.append(frame.axes.T @ (pin - frame.origin))
    length, (low, high) = reaches[1] - reaches[0], slide.range
    if not length + low > 0.0:
        raise SceneError(
            f"{what}: is {length:.4g} m long at home, and its range_m begins {-low:.4g} m below; correct it"
        )
    reach = {"retracted_length": length + low, "stroke": high - low}
    return {"first_point": points[0], "second_point": points[1]} | reach


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
