"""Kinematics of a knuckle-boom crane in closed form: slew angle and strokes to poses, and back."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from seacrane.crane.data_file import CraneData, CylinderData
from seacrane.errors import SceneError

Array = npt.NDArray[np.float64]

BODIES = (
    "tower",
    "king",
    "main_barrel",
    "main_rod",
    "main_jib",
    "knuckle_barrel",
    "knuckle_rod",
    "knuckle_jib",
)

# Elevation of a body's "along" direction at body pitch 0. Chosen per body so that pitch is small in the
# stowed pose and XYZ Euler angles stay far from their singularity: the main cylinder stands steeply, the
# knuckle jib hangs.
REFERENCE_ELEVATION = {
    "tower": 0.0,
    "king": 0.0,
    "main_barrel": math.pi / 2.0,
    "main_rod": math.pi / 2.0,
    "main_jib": 0.0,
    "knuckle_barrel": 0.0,
    "knuckle_rod": 0.0,
    "knuckle_jib": -math.pi / 2.0,
}


def plane_axes(body: str) -> Array:
    """Unit vectors "along" and "above" of the crane plane in body axes, shape (3, 2).

    At slew angle 0 the jibs point aft, so "outward" is -x; body y lies along the jib pivots.
    """
    e = REFERENCE_ELEVATION[body]
    return np.array([[-math.cos(e), math.sin(e)], [0.0, 0.0], [math.sin(e), math.cos(e)]])


def _turn(angle: float, point: Array) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * point[0] - s * point[1], s * point[0] + c * point[1]])


def _elevation(vector: Array) -> float:
    return math.atan2(vector[1], vector[0])


def _rotation_z(angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _rotation_y(angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


class _Triangle:
    """Jib pivot, cylinder pivot and rod head: the cylinder's length sets the angle at the jib pivot."""

    def __init__(self, name: str, foot: Array, head: Array, cylinder: CylinderData) -> None:
        self.name = name
        self.foot = foot  # from the jib pivot, in the body before the jib
        self.head = head  # from the jib pivot, in the jib
        self.retracted, self.stroke = cylinder.retracted_length, cylinder.stroke
        self.a, self.b = float(np.hypot(*foot)), float(np.hypot(*head))

    def length(self, stroke: float) -> float:
        if not (math.isfinite(stroke) and 0.0 <= stroke <= self.stroke):
            raise SceneError(
                f"{self.name}: stroke {stroke:g} m is outside 0 to {self.stroke:g} m; choose one inside."
            )
        return self.retracted + stroke

    def jib_angle(self, stroke: float) -> float:
        """Elevation of the jib in the body before it, rad, in (-pi, pi]; law of cosines."""
        length = self.length(stroke)
        opening = math.acos((self.a**2 + self.b**2 - length**2) / (2.0 * self.a * self.b))
        angle = _elevation(self.foot) + opening - _elevation(self.head)
        return math.pi - (math.pi - angle) % (2.0 * math.pi)

    def stroke_at(self, angle: float) -> float:
        opening = (angle - _elevation(self.foot) + _elevation(self.head)) % (2.0 * math.pi)
        length = math.sqrt(self.a**2 + self.b**2 - 2.0 * self.a * self.b * math.cos(opening))
        stroke = length - self.retracted
        slack = 1e-9 * self.stroke
        if opening > math.pi or not -slack <= stroke <= self.stroke + slack:
            lowest, highest = (math.degrees(self.jib_angle(s)) for s in (0.0, self.stroke))
            raise SceneError(
                f"{self.name}: jib angle {math.degrees(angle):.3f} deg is out of reach; "
                f"choose one from {lowest:.3f} to {highest:.3f} deg."
            )
        return min(max(stroke, 0.0), self.stroke)

    def lever_arm(self, stroke: float) -> float:
        length = self.length(stroke)
        cosine = (self.a**2 + self.b**2 - length**2) / (2.0 * self.a * self.b)
        return self.a * self.b * math.sqrt(1.0 - cosine**2) / length


@dataclass(frozen=True, eq=False)
class PlanePose:
    """The crane in its own plane: (outward, up) from the crane foot, m, and elevations, rad.

    `points` holds joints A to G and the `tip`; `elevation` the "along" direction of each body above the
    horizontal (0 for tower and king, whose "along" is outward).
    """

    points: dict[str, Array]
    elevation: dict[str, float]

    def origins(self) -> dict[str, Array]:
        """Body-frame origin of each body."""
        p = self.points
        foot = np.zeros(2)
        names = (foot, p["A"], p["B"], p["D"], p["C"], p["E"], p["G"], p["F"])
        return dict(zip(BODIES, names, strict=True))

    def pitch(self) -> dict[str, float]:
        """Rotation of each body about the jib pivots' direction (+y when stowed), rad."""
        return {name: self.elevation[name] - REFERENCE_ELEVATION[name] for name in BODIES}


class CraneGeometry:
    """Closed-form kinematics of the crane described by `data`.

    Crane-foot frame: origin at the crane foot on the deck, x forward, y to port, z up; the slew axis is z.
    Slew is right-handed about z, 0 with the jibs pointing aft (-x); slew = -90 deg turns them
    to port. Strokes s1 (main) and s2 (knuckle) are positive in extension and 0 in the stowed pose.

    Parameters
    ----------
    data : CraneData
    """

    def __init__(self, data: CraneData) -> None:
        self._height = data.tower_height
        self._c = np.array(data.main_jib_pivot)
        self._b = np.array(data.main_cylinder_pivot)
        self._d = np.array(data.main_cylinder_head)
        self._e = np.array(data.knuckle_cylinder_pivot)
        self._f = np.array([data.main_jib_length, 0.0])
        self._g = np.array(data.knuckle_cylinder_head)
        self._tip = np.array([data.knuckle_jib_length, 0.0])
        self._main = _Triangle("main_cylinder", self._b - self._c, self._d, data.main_cylinder)
        self._knuckle = _Triangle("knuckle_cylinder", self._e - self._f, self._g, data.knuckle_cylinder)

    @property
    def largest_strokes(self) -> tuple[float, float]:
        """Largest strokes of the main and the knuckle cylinder, m."""
        return self._main.stroke, self._knuckle.stroke

    def jib_angles(self, *, s1: float, s2: float) -> tuple[float, float]:
        """Elevation of the main jib, and of the knuckle jib relative to it, rad, from the strokes, m.

        Raises
        ------
        SceneError
            A stroke is out of range.
        """
        return self._main.jib_angle(s1), self._knuckle.jib_angle(s2)

    def strokes(self, *, main_angle: float, knuckle_angle: float) -> tuple[float, float]:
        """Strokes (s1, s2), m, from the jib angles of `jib_angles`, rad.

        Raises
        ------
        SceneError
            An angle is out of reach.
        """
        return self._main.stroke_at(main_angle), self._knuckle.stroke_at(knuckle_angle)

    def lever_arms(self, *, s1: float, s2: float) -> tuple[float, float]:
        """Distance of each cylinder's line from its jib's pivot (C, F), m; also d(stroke)/d(jib angle)."""
        return self._main.lever_arm(s1), self._knuckle.lever_arm(s2)

    def plane_pose(self, *, s1: float, s2: float) -> PlanePose:
        """Joint points and elevations in the crane plane, measured from the crane foot."""
        main, relative = self.jib_angles(s1=s1, s2=s2)
        knuckle = main + relative
        a = np.array([0.0, self._height])
        c = a + self._c
        f = c + _turn(main, self._f)
        points = {
            "A": a,
            "B": a + self._b,
            "C": c,
            "D": c + _turn(main, self._d),
            "E": c + _turn(main, self._e),
            "F": f,
            "G": f + _turn(knuckle, self._g),
            "tip": f + _turn(knuckle, self._tip),
        }
        main_cylinder = _elevation(points["D"] - points["B"])
        knuckle_cylinder = _elevation(points["G"] - points["E"])
        angles = (0.0, 0.0, main_cylinder, main_cylinder, main, knuckle_cylinder, knuckle_cylinder, knuckle)
        return PlanePose(points, dict(zip(BODIES, angles, strict=True)))

    def to_space(self, point: Array, slew: float) -> Array:
        """A point (outward, up) of the crane plane in the crane-foot frame, shape (3,)."""
        return np.array([-math.cos(slew) * point[0], -math.sin(slew) * point[0], point[1]])

    def points(self, *, slew: float, s1: float, s2: float) -> dict[str, Array]:
        """Joint points A to G and the tip in the crane-foot frame, each shape (3,), m."""
        plane = self.plane_pose(s1=s1, s2=s2)
        return {name: self.to_space(point, _finite_angle(slew)) for name, point in plane.points.items()}

    def tip(self, *, slew: float, s1: float, s2: float) -> Array:
        """Tip of the knuckle jib in the crane-foot frame, shape (3,), m."""
        return self.points(slew=slew, s1=s1, s2=s2)["tip"]

    def outreach(self, *, s1: float, s2: float) -> float:
        """Horizontal distance of the tip from the slew axis, outward, m."""
        return float(self.plane_pose(s1=s1, s2=s2).points["tip"][0])

    def pose(self, *, slew: float, s1: float, s2: float) -> dict[str, tuple[Array, Array]]:
        """Pose of each of the eight bodies in the crane-foot frame.

        Parameters
        ----------
        slew : float
            Slew angle, rad.
        s1, s2 : float
            Strokes of the main and the knuckle cylinder, m.

        Returns
        -------
        dict of name to (position, rotation)
            Body-frame origin, shape (3,), m, and body-to-foot rotation matrix, shape (3, 3).

        Raises
        ------
        SceneError
            The slew angle is not finite, or a stroke is out of range.
        """
        plane = self.plane_pose(s1=s1, s2=s2)
        turned, origins, pitch = _rotation_z(_finite_angle(slew)), plane.origins(), plane.pitch()
        result = {}
        for name in BODIES:
            turn = _rotation_z(0.0) if name == "tower" else turned
            result[name] = (self.to_space(origins[name], slew), turn @ _rotation_y(pitch[name]))
        return result


def _finite_angle(slew: float) -> float:
    if not math.isfinite(slew):
        raise SceneError(f"crane: slew is {slew!r}; give a finite angle in rad.")
    return slew
