"""A crane in a scene, with its roles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from seacrane import _core
from seacrane.crane.crane import Crane, Vector, add_hydraulics, hydraulics_of
from seacrane.crane.data import JointData, MeshData, RopeData
from seacrane.crane.load_crane import load_crane
from seacrane.crane.parts import FAR, STRUCTURE, UP, CraneParts, Lean, Payload, leaning
from seacrane.description.description import Description
from seacrane.description.elements import add_driver, add_joint
from seacrane.description.roles import CraneRoles, LuffingRope
from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of, number_of, positive_of, text_of
from seacrane.inputs.frames import quaternion_product, rotation_matrix
from seacrane.inputs.shown import shown
from seacrane.scene.bodies import add_body, add_mesh
from seacrane.scene.recorded import add_range, record_coordinate
from seacrane.scene.roles import add_roles
from seacrane.scene.springs import add_spring
from seacrane.scene.wind_current import damp_load

Array = npt.NDArray[np.float64]
PAYLOAD = "payload"
TOO_LARGE = 20.0  # times the crane's extent: no mesh in m
POINTS = ("point", "second_point")
AXES = ("axis", "second_axis")

FOOT: Vector = (33.0, 10.0, 10.0)
"""Crane foot V seen from {0} in the paper's vessel: 33 m forward, 10 m to port, 10 m above."""


def add_crane(
    scene: Description, crane: Crane | None = None, *, base: str = "vessel", foot: Vector = FOOT,
    slew: float = 0.0, s1: float = 0.0, s2: float = 0.0, coordinates: Mapping[str, float] | None = None,
    payload: Payload | None = None, payload_mass: float | None = None, damping: bool = True,
    held: bool | None = None, hydraulics: Mapping[str, Mapping[str, Any]] | None = None,
    design_factor: float = 1.0, stiffness: float | None = None, prefix: str = "",
) -> CraneRoles:  # fmt: skip
    """Add a crane, and a payload at rest; its coordinates are recorded and keep the data file's ranges.

    Parameters
    ----------
    crane : Crane, optional
        As `load_crane` reads it. Default: the 250 t knuckle boom that comes with seacrane.
    base : str
        Body that carries the crane, wherever it is described ("ground" for a fixed base).
    foot : (float, float, float)
        Crane foot in the frame of the base, m.
    slew, s1, s2 : float
        Slew angle, rad; of a knuckle boom, strokes of the main and the knuckle cylinder, m.
    coordinates : mapping of str to float, optional
        Angles (rad) and strokes (m) from the pose in which the crane is drawn, by label, such as
        ``{"slew": 0.5, "boom": 1.0}``; those that are not given stay there, or follow their loop.
    payload : Payload, optional
        What hangs from the tip; default: nothing.
    payload_mass : float, optional
        In its place, kg: a `Payload` of this mass, all else as usual.
    damping : bool
        Whether the payload has its small damping: of its swing, and drag in the air. False: neither.
    held : bool, optional
        Default: what nothing acts on when the scene is compiled, of slew, luffs and strokes, is held where it
        is described; `Scene.report` names it. False: it is free, and falls. True: drivers hold all of them
        from now on, named ``"<joint>.<coordinate>"``, which stages and `Scene.replace` may change. Hydraulic
        cylinders hold their strokes themselves.
    hydraulics : mapping of str to mapping, optional
        By the labels of cylinders, "main" and "knuckle" of a knuckle boom, the keywords of
        `add_hydraulic_cylinder` beside its geometry: that cylinder is hydraulic, named as its joint, and
        holds the crane and its payload at the start. Areas default to the data file's, or to those of its
        barrel and rod. Default: what the data file says; it may say nothing.
    design_factor : float
        Dynamic factor that the crane's capacity contains, 1 or more, as of `add_roles`.
    stiffness : float, optional
        Of the crane's structure, boom and pedestal together, N/m: vertical force over sag at the tip as
        described, without the hoist rope. The crane leans by that in the plane of its jib, about a hinge at
        the slew bearing, with 2 % of critical damping; at other radii the sag goes with their square. As
        described it stands under its own weight and what hangs on it then. Default: it does not give.
    prefix : str
        Begins the names of all bodies and joints of this crane and the labels of its channels, such as
        "aft "; a scene's cranes need different ones.

    Returns
    -------
    CraneRoles
        Which of the elements are the slew drive, the cylinders, the link, the payload and the tip.

    Raises
    ------
    SceneError
        For names that the scene has already, or values out of range.

    Warns
    -----
    AngleUnitWarning
        A slew angle that looks like degrees.
    """
    if crane is None:
        crane = load_crane()
    prefix = text_of("crane: prefix", prefix) if prefix else ""
    if prefix in scene.roles:
        raise SceneError(f"crane: there is one with prefix {prefix!r}; give this one another, such as 'aft '")
    if not isinstance(crane, Crane):
        raise SceneError.of("crane", f"is {shown(crane)}; give what load_crane returns, or leave it out")
    place = _place(crane, {"slew": slew, "s1": s1, "s2": s2}, coordinates)
    parts = crane.parts(foot=foot, **place)
    damped = flag_of("crane: damping", damping)
    is_held = None if held is None else flag_of("crane: held", held)
    if payload_mass is not None:
        if payload is not None:
            raise SceneError("crane: payload and payload_mass are given; put the mass into the Payload")
        payload = Payload(mass=payload_mass)
    lean = None
    if stiffness is not None:
        positive_of("crane: stiffness", stiffness, "N/m")
        parts, lean = leaning(parts, crane.data.slew)
    bodies, joints = list(parts.bodies), list(parts.joints)
    if payload is not None:
        bodies.append(payload.under(parts.tip[1]))
        joints.append(payload.link(parts.tip[1], parts.tip[0]))
    oil = hydraulics_of(crane, hydraulics)
    names = {"": base} | {body.name: prefix + body.name for body in bodies}
    frame = _Frame(scene, base)
    for one in bodies:
        frame.add_body(one, names[one.name])
    for joint in joints:
        frame.add_joint(joint, prefix + joint.name, names[joint.first], names[joint.second])
    for name, (low, high) in parts.ranges.items():
        add_range(scene, prefix + name, joint=prefix + name, minimum=low, maximum=high)
    for body in crane.data.bodies:
        for mesh in body.meshes:
            _draw(scene, mesh, names[body.name], prefix, parts)
    load = 0.0 if payload is None else payload.mass
    add_hydraulics(scene, crane, oil, coordinates=place, payload_mass=load, prefix=prefix)
    tip = frame.in_body(prefix + parts.tip[0], parts.tip[1])
    if lean is not None and stiffness is not None:
        frame.add_lean(lean, stiffness, load, prefix + STRUCTURE, names)
    if payload is not None and damped:
        damp_load(
            scene, names[PAYLOAD], payload.size, tip, ratio=payload.swing_damping_ratio,
            drag=payload.drag_coefficient,
        )  # fmt: skip
    drives = crane.data.coordinates
    led = [joint for label, joint in drives.items() if label not in oil]
    for name in led if is_held else ():
        add_driver(scene, joint=prefix + name, curve=0.0)
    for name in drives.values():
        record_coordinate(scene, prefix + name)
    return add_roles(
        scene, prefix=prefix, slew=None if crane.data.slew is None else prefix + crane.data.slew,
        cylinders={label: prefix + name for label, name in crane.data.cylinders.items()},
        link=None if payload is None else f"{prefix}link", tip=None if payload is not None else tip,
        capacity=crane.data.capacity, areas=crane.data.areas,
        luffs={label: prefix + name for label, name in crane.data.luffs.items()},
        ropes={rope.luff: frame.rope(rope, prefix, names) for rope in parts.ropes},
        held=is_held is not False, design_factor=design_factor,
        structure=None if lean is None else prefix + STRUCTURE,
    )  # fmt: skip


def _place(
    crane: Crane, given: dict[str, float], coordinates: Mapping[str, float] | None
) -> dict[str, float]:
    """Coordinates by name; those that have a keyword of their own are left out where they are 0."""
    if not isinstance(coordinates, Mapping | None):
        raise SceneError.of("crane: coordinates", f"are {shown(coordinates)}; give {{label: rad or m}}")
    found = dict(coordinates or {})
    for label in found:
        crane.data.led_by(label)
    for name, value in given.items():
        if number_of(f"crane: {name}", value) != 0.0:
            if name in found:
                raise SceneError.of(f"crane: {name}", "is given, and one of the coordinates; give it once")
            found[name] = value
    return found


def _draw(scene: Description, mesh: MeshData, body: str, prefix: str, parts: CraneParts) -> None:
    """SceneError for a mesh that is far larger than its crane."""
    frame = _core.Frame(point=mesh.frame.origin, axes=mesh.frame.axes)
    shape: dict[str, Any] = {"file": mesh.file, "scale": mesh.scale}
    if mesh.file is None:
        shape = {"vertices": mesh.vertices, "faces": mesh.faces}
    added = add_mesh(scene, body=body, name=prefix + mesh.name, frame=frame, **shape)
    size = float(np.ptp(added.vertices, axis=0).max())
    points = np.array([*(joint.point for joint in parts.joints), parts.tip[1]])
    extent = float(np.ptp(points, axis=0).max())
    if size > TOO_LARGE * extent > 0.0:
        raise SceneError(
            f"mesh {added.name!r}: spans {size:.4g} m, and the joints of its crane {extent:.4g} m; it is "
            "most likely in mm: give it scale 0.001"
        )


class _Frame:
    """The frame of a base, in which a crane is described, in a scene."""

    def __init__(self, scene: Description, base: str) -> None:
        self.scene = scene
        self.origin, self.turn = np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0])
        if base in scene.bodies:
            self.origin = np.array(scene.bodies[base].position)
            self.turn = np.array(scene.bodies[base].quaternion)
        self.to_inertial = rotation_matrix(self.turn)

    def add_body(self, body: _core.Body, name: str) -> None:
        add_body(
            self.scene, name=name, mass=body.mass, inertia=body.inertia, center_of_mass=body.center_of_mass,
            position=self.origin + self.to_inertial @ body.position,
            quaternion=quaternion_product(self.turn, body.quaternion),
        )  # fmt: skip

    def add_joint(self, joint: JointData, name: str, first: str, second: str) -> None:
        given: dict[str, Any] = {key: getattr(joint, key) for key in (*POINTS, *AXES)}
        used = {key: value for key, value in given.items() if value is not None}
        used |= {key: self.origin + self.to_inertial @ used[key] for key in POINTS if key in used}
        used |= {key: self.to_inertial @ used[key] for key in AXES if key in used}
        add_joint(self.scene, kind=joint.kind, name=name, first=first, second=second, **used)

    def in_body(self, name: str, point: Array) -> tuple[str, Vector]:
        """A point of the base's frame in the coordinates of a body, which may be a base that is not there."""
        at = point
        if name in self.scene.bodies:
            body = self.scene.bodies[name]
            inertial = self.origin + self.to_inertial @ point
            at = rotation_matrix(body.quaternion).T @ (inertial - body.position)
        x, y, z = at.tolist()
        return name, (x, y, z)

    def add_lean(
        self, lean: Lean, stiffness: float, load: float, name: str, names: Mapping[str, str]
    ) -> None:
        """The spring that holds a crane up, and its load, kg: vertical, as far out as the tip."""
        first, second = (
            self.in_body(names[body], at)
            for body, at in ((lean.first, lean.point + FAR * UP), (lean.second, lean.point))
        )
        add_spring(
            self.scene, name, first=first[0], first_point=first[1], second=second[0], second_point=second[1],
            stiffness=stiffness, damping=lean.damping(stiffness),
            natural_length=FAR - (lean.weight + load) * self.scene.gravity / stiffness,
        )  # fmt: skip

    def rope(self, rope: RopeData, prefix: str, names: Mapping[str, str]) -> LuffingRope:
        """With its blocks in the coordinates of the scene's bodies."""
        ends = [self.in_body(names.get(body, names[""]), at) for body, at in (rope.first, rope.second)]
        return LuffingRope(
            name=prefix + rope.name, falls=rope.falls, EA=rope.EA, first=ends[0], second=ends[1]
        )
