"""Weight of a crane at rest: its centre of mass, and the cylinder forces that carry it."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from seacrane.crane.geometry import CraneGeometry, PlanePose, plane_axes
from seacrane.crane.mass_properties import MassProperties

Array = npt.NDArray[np.float64]
STANDARD_GRAVITY = 9.80665


def plane_center(name: str, pose: PlanePose, properties: MassProperties) -> Array:
    """Centre of mass of a body in the crane plane, (outward, up) from the crane foot, m."""
    along, above = plane_axes(name).T @ properties.center_of_mass
    c, s = math.cos(pose.elevation[name]), math.sin(pose.elevation[name])
    turned = np.array([c * along - s * above, s * along + c * above])
    center: Array = pose.origins()[name] + turned
    return center


def _turned(arm: Array) -> Array:
    return np.array([-arm[1], arm[0]])


def _head_rates(
    geometry: CraneGeometry, pose: PlanePose, s1: float, s2: float
) -> tuple[dict[str, float], dict[str, float]]:
    """Angular rates of the jibs per unit rate of the main stroke, and of the knuckle stroke."""
    lever1, lever2 = geometry.lever_arms(s1=s1, s2=s2)
    return {"main": 1.0 / lever1, "knuckle": 1.0 / lever1}, {"main": 0.0, "knuckle": 1.0 / lever2}


def _point_rates(pose: PlanePose, rates: dict[str, float]) -> dict[str, Array]:
    p = pose.points
    main, knuckle = rates["main"], rates["knuckle"]
    velocity = {name: main * _turned(p[name] - p["C"]) for name in ("D", "E", "F")}
    for name in ("G", "tip"):
        velocity[name] = velocity["F"] + knuckle * _turned(p[name] - p["F"])
    velocity["B"] = velocity["C"] = np.zeros(2)
    return velocity


def _cylinder_rate(pose: PlanePose, velocity: dict[str, Array], foot: str, head: str) -> float:
    arm = pose.points[head] - pose.points[foot]
    return float(_turned(arm) @ (velocity[head] - velocity[foot]) / (arm @ arm))


def _height_rates(
    pose: PlanePose, rates: dict[str, float], properties: Mapping[str, MassProperties]
) -> tuple[dict[str, float], float]:
    """Vertical velocities of the moving bodies' centres of mass, and of the tip."""
    velocity = _point_rates(pose, rates)
    main_cylinder = _cylinder_rate(pose, velocity, "B", "D")
    knuckle_cylinder = _cylinder_rate(pose, velocity, "E", "G")
    moving = {
        "main_barrel": ("B", main_cylinder),
        "main_rod": ("D", main_cylinder),
        "main_jib": ("C", rates["main"]),
        "knuckle_barrel": ("E", knuckle_cylinder),
        "knuckle_rod": ("G", knuckle_cylinder),
        "knuckle_jib": ("F", rates["knuckle"]),
    }
    heights = {}
    for name, (origin, turning) in moving.items():
        arm = plane_center(name, pose, properties[name]) - pose.points[origin]
        heights[name] = float(velocity[origin][1] + turning * arm[0])
    return heights, float(velocity["tip"][1])


def static_cylinder_forces(
    geometry: CraneGeometry,
    properties: Mapping[str, MassProperties],
    *,
    s1: float,
    s2: float,
    payload_mass: float = 0.0,
    gravity: float = STANDARD_GRAVITY,
) -> Array:
    """Cylinder forces that hold the crane at rest on a level base, by virtual work: F_k = dV/ds_k.

    The slew axis being vertical, the slew angle does not matter. The cylinders' own weights count.

    Parameters
    ----------
    properties : mapping of body name to MassProperties
    s1, s2 : float
        Strokes, m.
    payload_mass : float
        Mass hanging at rest from the tip, kg.
    gravity : float
        m/s2.

    Returns
    -------
    ndarray, shape (2,)
        Forces of the main and the knuckle cylinder between barrel and rod, N, positive when they push.
    """
    pose = geometry.plane_pose(s1=s1, s2=s2)
    forces = []
    for rates in _head_rates(geometry, pose, s1, s2):
        heights, tip = _height_rates(pose, rates, properties)
        power = math.fsum(properties[name].mass * rate for name, rate in heights.items())
        forces.append(gravity * (power + payload_mass * tip))
    return np.array(forces)


def center_of_mass(
    geometry: CraneGeometry,
    properties: Mapping[str, MassProperties],
    *,
    slew: float,
    s1: float,
    s2: float,
) -> Array:
    """Common centre of mass of the eight bodies in the crane-foot frame, shape (3,), m."""
    pose = geometry.plane_pose(s1=s1, s2=s2)
    total = math.fsum(item.mass for item in properties.values())
    moment = np.sum([item.mass * plane_center(name, pose, item) for name, item in properties.items()], axis=0)
    return geometry.to_space(moment / total, slew)
