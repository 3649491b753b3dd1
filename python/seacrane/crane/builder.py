"""A knuckle-boom crane: its bodies and joints at a pose, from its data."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from seacrane.crane import crane_weight, data_file
from seacrane.crane.geometry import BODIES, CraneGeometry, plane_axes
from seacrane.crane.mass_properties import MassProperties, combine
from seacrane.crane.parts import CraneParts
from seacrane.crane.payload import Payload
from seacrane.crane.records import BodyRecord, JointRecord
from seacrane.errors import SceneError
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import number_of, numbers_of
from seacrane.inputs.plausible import angle_of

Array = npt.NDArray[np.float64]
Vector = tuple[float, float, float]
SLEW = "A"
CYLINDERS = {"main": "main_cylinder", "knuckle": "knuckle_cylinder"}
TIP_BODY = "knuckle_jib"

FOOT: Vector = (33.0, 10.0, 10.0)
"""Crane foot V seen from {0} in the paper's vessel: 33 m forward, 10 m to port, 10 m above."""


def _vector(name: str, value: Vector | Array) -> Array:
    vector = numbers_of(f"crane: {name}", value).copy()
    if vector.shape != (3,) or not np.all(np.isfinite(vector)):
        raise SceneError(f"crane: {name} is {value!r}; give three finite numbers (x, y, z) in m.")
    return vector


def _slew_pitch_quaternion(slew: float, pitch: float) -> Array:
    """Quaternion of Rz(slew) Ry(pitch), scalar first."""
    cz, sz, cy, sy = (f(a / 2.0) for a in (slew, pitch) for f in (math.cos, math.sin))
    return np.array([cz * cy, -sz * sy, cz * sy, sz * cy])


@dataclass(frozen=True, eq=False)
class KnuckleBoomCrane:
    """A knuckle-boom crane: data, kinematics and mass properties. Make one with `load`.

    Attributes
    ----------
    mass_properties : mapping of body name to MassProperties
        Body axes; computed from the members' shapes.
    """

    data: data_file.CraneData
    geometry: CraneGeometry = field(init=False)
    mass_properties: Mapping[str, MassProperties] = field(init=False)

    __repr__ = brief

    def __post_init__(self) -> None:
        members = self.data.members()
        properties = {name: combine(members[name], plane_axes(name)) for name in BODIES}
        object.__setattr__(self, "geometry", CraneGeometry(self.data))
        object.__setattr__(self, "mass_properties", MappingProxyType(properties))

    @classmethod
    def load(cls, path: str | Path | None = None) -> KnuckleBoomCrane:
        """Read a crane data file; without a path, the 250 t crane that comes with seacrane.

        Raises
        ------
        FileFormatError
            The file is malformed or describes a crane that cannot work; the message names the item.
        """
        return cls(data_file.load(path))

    @property
    def mass(self) -> float:
        """Mass of the eight bodies, kg."""
        return math.fsum(item.mass for item in self.mass_properties.values())

    def center_of_mass(
        self, *, foot: Vector = FOOT, slew: float = 0.0, s1: float = 0.0, s2: float = 0.0
    ) -> Array:
        """Common centre of mass of the eight bodies in the vessel frame, shape (3,), m."""
        center = crane_weight.center_of_mass(self.geometry, self.mass_properties, slew=slew, s1=s1, s2=s2)
        return _vector("foot", foot) + center

    def static_cylinder_forces(
        self,
        *,
        s1: float,
        s2: float,
        payload_mass: float = 0.0,
        gravity: float = crane_weight.STANDARD_GRAVITY,
    ) -> Array:
        """Forces of the main and the knuckle cylinder at rest on a level base, N, positive when they push.

        See `seacrane.crane.crane_weight.static_cylinder_forces`.
        """
        return crane_weight.static_cylinder_forces(
            self.geometry, self.mass_properties, s1=s1, s2=s2, payload_mass=payload_mass, gravity=gravity
        )

    def bodies(
        self, *, foot: Vector = FOOT, slew: float = 0.0, s1: float = 0.0, s2: float = 0.0
    ) -> list[BodyRecord]:
        """The eight bodies at a pose, from the tower to the knuckle jib.

        Parameters
        ----------
        foot : (float, float, float)
            Crane foot in the vessel frame, m.
        slew, s1, s2 : float
            Slew angle, rad; strokes, m.

        Raises
        ------
        SceneError
            A value is not finite, or a stroke is out of range.
        """
        origin = _vector("foot", foot)
        angle_of("crane: slew", number_of("crane: slew", slew))
        pose = self.geometry.pose(slew=slew, s1=s1, s2=s2)
        pitch = self.geometry.plane_pose(s1=s1, s2=s2).pitch()
        records = []
        for name in BODIES:
            item = self.mass_properties[name]
            turned = 0.0 if name == "tower" else slew
            records.append(
                BodyRecord(
                    name=name,
                    mass=item.mass,
                    inertia=item.inertia.copy(),
                    center_of_mass=item.center_of_mass.copy(),
                    position=origin + pose[name][0],
                    quaternion=_slew_pitch_quaternion(turned, pitch[name]),
                )
            )
        return records

    def parts(
        self, *, foot: Vector = FOOT, slew: float = 0.0, s1: float = 0.0, s2: float = 0.0
    ) -> CraneParts:
        """All that it brings into a scene at a pose; arguments and errors as of `bodies`."""
        place: dict[str, Any] = {"foot": foot, "slew": slew, "s1": s1, "s2": s2}
        cylinders = {name: getattr(self.data, name) for name in CYLINDERS.values()}
        areas = {label: cylinders[name].areas for label, name in CYLINDERS.items()}
        return CraneParts(
            bodies=self.bodies(**place),
            joints=self.joints(**place, base=""),
            tip=(TIP_BODY, _vector("foot", foot) + self.geometry.tip(slew=slew, s1=s1, s2=s2)),
            slew=SLEW,
            cylinders=CYLINDERS,
            ranges={
                name: (-stroke, cylinders[name].stroke - stroke)
                for name, stroke in zip(CYLINDERS.values(), (s1, s2), strict=True)
            },
            capacity=self.data.capacity,
            areas={label: pair for label, pair in areas.items() if pair is not None},
        )

    def payload_body(
        self,
        payload: Payload,
        *,
        foot: Vector = FOOT,
        slew: float = 0.0,
        s1: float = 0.0,
        s2: float = 0.0,
    ) -> BodyRecord:
        """The payload hanging at rest under the tip, its frame at its centre, parallel to the vessel's."""
        return payload.under(_vector("foot", foot) + self.geometry.tip(slew=slew, s1=s1, s2=s2))

    def joints(
        self,
        *,
        foot: Vector = FOOT,
        slew: float = 0.0,
        s1: float = 0.0,
        s2: float = 0.0,
        base: str = "vessel",
        payload: Payload | None = None,
    ) -> list[JointRecord]:
        """The ten joints of the crane at a pose, and the payload's link as the eleventh.

        The angle of A is the slew angle; the angles of C and F grow as the jibs rise; the displacements of
        the prismatic joints grow with the strokes. All are zero at the pose described here.

        Parameters
        ----------
        foot, slew, s1, s2
            As `bodies`.
        base : str
            Body the tower is welded to.
        """
        origin = _vector("foot", foot)
        points = self.geometry.points(slew=slew, s1=s1, s2=s2)
        p = {name: origin + point for name, point in points.items()}
        pose = self.geometry.pose(slew=slew, s1=s1, s2=s2)
        axes = {name: pose[name][1] @ plane_axes(name) for name in ("main_barrel", "knuckle_barrel")}
        (main_along, main_above), (knuckle_along, knuckle_above) = (axis.T for axis in axes.values())
        up, pivot = np.array([0.0, 0.0, 1.0]), pose["king"][1][:, 1]

        def joint(name: str, kind: str, first: str, second: str, point: Array, **extra: Any) -> JointRecord:
            copies: dict[str, Any] = {key: np.array(value) for key, value in extra.items()}
            return JointRecord(name=name, kind=kind, first=first, second=second, point=point.copy(), **copies)

        records = [
            joint("deck", "weld", base, "tower", origin),
            joint("A", "revolute", "tower", "king", p["A"], axis=up),
            joint("B", "universal", "king", "main_barrel", p["B"], axis=pivot, second_axis=main_above),
            joint("C", "revolute", "king", "main_jib", p["C"], axis=pivot),
            joint("D", "spherical", "main_rod", "main_jib", p["D"]),
            joint("E", "universal", "main_jib", "knuckle_barrel", p["E"], axis=pivot,
                  second_axis=knuckle_above),
            joint("F", "revolute", "main_jib", "knuckle_jib", p["F"], axis=pivot),
            joint("G", "spherical", "knuckle_rod", "knuckle_jib", p["G"]),
            joint("main_cylinder", "prismatic", "main_barrel", "main_rod", p["B"], axis=main_along),
            joint("knuckle_cylinder", "prismatic", "knuckle_barrel", "knuckle_rod", p["E"],
                  axis=knuckle_along),
        ]  # fmt: skip
        if payload is not None:
            records.append(payload.link(p["tip"], TIP_BODY))
        return records
