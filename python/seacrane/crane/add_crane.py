"""A knuckle-boom crane in a scene, with its roles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from seacrane.crane.add_hydraulics import CYLINDERS, add_hydraulics, hydraulics_of
from seacrane.crane.builder import FOOT, KnuckleBoomCrane, Vector
from seacrane.crane.payload import Payload
from seacrane.crane.records import BodyRecord, JointRecord
from seacrane.description.bodies import add_body
from seacrane.description.crane_parts import add_roles
from seacrane.description.damping import add_air_drag, add_pendulum_damping
from seacrane.description.drives import add_driver
from seacrane.description.joints import add_joint
from seacrane.description.recorded import add_range
from seacrane.description.roles import CraneRoles
from seacrane.description.scene import Description
from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of, text_of
from seacrane.inputs.frames import quaternion_product, rotation_matrix
from seacrane.inputs.shown import shown

Array = npt.NDArray[np.float64]
SLEW = "A"
TIP_BODY = "knuckle_jib"
PAYLOAD = "payload"
POINTS = ("point", "second_point")
AXES = ("axis", "second_axis")


def add_crane(
    scene: Description,
    crane: KnuckleBoomCrane | None = None,
    *,
    base: str = "vessel",
    foot: Vector = FOOT,
    theta: float = 0.0,
    s1: float = 0.0,
    s2: float = 0.0,
    payload: Payload | None = None,
    damping: bool = True,
    held: bool = False,
    hydraulics: Mapping[str, Mapping[str, Any]] | None = None,
    prefix: str = "",
) -> CraneRoles:
    """Add a crane, and a payload hanging at rest; its strokes keep the data file's range.

    Parameters
    ----------
    crane : KnuckleBoomCrane, optional
        Default: the 250 t crane that comes with seacrane.
    base : str
        Body that carries the crane, wherever it is described ("ground" for a fixed base).
    foot : (float, float, float)
        Crane foot in the frame of the base, m.
    theta, s1, s2 : float
        Slew angle, rad; strokes of the main and the knuckle cylinder, m.
    payload : Payload or None
    damping : bool
        Whether the payload has its small damping: of its swing, and drag in the air. False: neither.
    held : bool
        Whether drivers hold slew angle and strokes where they are described. False: drives are to be added.
        Hydraulic cylinders hold their strokes themselves.
    hydraulics : mapping of str to mapping, optional
        By "main" and "knuckle", the entries of `add_hydraulic_cylinder` beside its geometry: that cylinder is
        hydraulic, named as its joint, and holds the crane and its payload at the start. Areas default to the
        data file's, or to those of its barrel and rod. Default: what the data file says; it may say nothing.
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
        crane = KnuckleBoomCrane.load()
    if not isinstance(crane, KnuckleBoomCrane):
        raise SceneError(f"crane is {shown(crane)}; give a KnuckleBoomCrane, or leave it out")
    prefix = text_of("crane: prefix", prefix) if prefix else ""
    if prefix in scene.roles:
        raise SceneError(f"crane: there is one with prefix {prefix!r}; give this one another, such as 'aft '")
    place: dict[str, Any] = {"foot": foot, "theta": theta, "s1": s1, "s2": s2}
    records = crane.bodies(**place)
    damped, is_held = flag_of("crane: damping", damping), flag_of("crane: held", held)
    if payload is not None:
        records.append(crane.payload_body(payload, **place))
    oil = hydraulics_of(crane, hydraulics)
    names = {"": base} | {body.name: prefix + body.name for body in records}
    frame = _Frame(scene, base)
    for body in records:
        frame.add_body(body, names[body.name])
    for one in crane.joints(**place, base="", payload=payload):
        frame.add_joint(one, prefix + one.name, names[one.first], names[one.second])
    for name, stroke in zip(CYLINDERS.values(), (s1, s2), strict=True):
        longest = getattr(crane.data, name).stroke
        add_range(scene, joint=prefix + name, minimum=-stroke, maximum=longest - stroke)
    force = crane.static_cylinder_forces(
        s1=s1, s2=s2, payload_mass=0.0 if payload is None else payload.mass, gravity=scene.gravity
    )
    add_hydraulics(scene, crane, oil, force=dict(zip(CYLINDERS, force.tolist(), strict=True)), prefix=prefix)
    tip = frame.in_body(prefix + TIP_BODY, _tip(crane, place))
    if payload is not None and damped:
        _damp(scene, payload, tip, names[PAYLOAD])
    driven = (SLEW, *(name for label, name in CYLINDERS.items() if label not in oil))
    for joint in driven if is_held else ():
        add_driver(scene, joint=prefix + joint, curve=0.0)
    return add_roles(
        scene,
        prefix=prefix,
        slew=prefix + SLEW,
        cylinders={label: prefix + name for label, name in CYLINDERS.items()},
        link=None if payload is None else f"{prefix}link",
        tip=None if payload is not None else tip,
        capacity=crane.data.capacity,
        areas={
            label: areas
            for label, name in CYLINDERS.items()
            if (areas := getattr(crane.data, name).areas) is not None
        },
    )


def _damp(scene: Description, payload: Payload, tip: tuple[str, Vector], body: str) -> None:
    length, breadth, height = payload.size
    if payload.swing_damping_ratio > 0.0:
        add_pendulum_damping(
            scene,
            name=f"{body} swing",
            first=tip[0],
            first_point=tip[1],
            second=body,
            ratio=payload.swing_damping_ratio,
        )
    if payload.drag_coefficient > 0.0:
        add_air_drag(
            scene,
            body=body,
            frontal_area=breadth * height,
            lateral_area=length * height,
            drag_coefficient=payload.drag_coefficient,
        )


def _tip(crane: KnuckleBoomCrane, place: dict[str, Any]) -> Array:
    """In the frame of the base, m."""
    foot, pose = place["foot"], {key: place[key] for key in ("theta", "s1", "s2")}
    return np.asarray(foot, dtype=float) + crane.geometry.tip(**pose)


class _Frame:
    """The frame of a base, in which a crane is described, in a scene."""

    def __init__(self, scene: Description, base: str) -> None:
        self.scene = scene
        self.origin, self.turn = np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0])
        if base in scene.bodies:
            self.origin = np.array(scene.bodies[base].position)
            self.turn = np.array(scene.bodies[base].quaternion)
        self.to_inertial = rotation_matrix(self.turn)

    def add_body(self, body: BodyRecord, name: str) -> None:
        add_body(
            self.scene,
            name=name,
            mass=body.mass,
            inertia=body.inertia,
            center_of_mass=body.center_of_mass,
            position=self.origin + self.to_inertial @ body.position,
            quaternion=quaternion_product(self.turn, body.quaternion),
        )

    def add_joint(self, joint: JointRecord, name: str, first: str, second: str) -> None:
        given: dict[str, Any] = {key: getattr(joint, key) for key in (*POINTS, *AXES, "length")}
        used = {key: value for key, value in given.items() if value is not None}
        used |= {key: self.origin + self.to_inertial @ used[key] for key in POINTS if key in used}
        used |= {key: self.to_inertial @ used[key] for key in AXES if key in used}
        add_joint(self.scene, kind=joint.kind, name=name, first=first, second=second, **used)

    def in_body(self, name: str, point: Array) -> tuple[str, Vector]:
        """A point of the base's frame in the coordinates of a body of the scene."""
        body = self.scene.bodies[name]
        at = self.origin + self.to_inertial @ point
        x, y, z = (rotation_matrix(body.quaternion).T @ (at - body.position)).tolist()
        return name, (x, y, z)
