"""Cylinders of jointed cranes: between which points they push, and with what force they hold."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.jointed import JointedCrane
from seacrane.crane.jointed_data import JointData
from seacrane.crane.jointed_pose import extent_of, pose_of
from seacrane.errors import SceneError

Array = NDArray[np.float64]
ON_AXIS = 1e-6  # of the crane's extent: a pin so near to the axis is on it
STEP = 1e-3  # m, over which the potential energy is differenced


def ends_of(crane: JointedCrane, label: str) -> dict[str, Any]:
    """Points of barrel and rod in their coordinates, length at stroke 0 and largest stroke, m.

    The points are the outermost pins of both that lie on the cylinder's axis.

    Raises SceneError for a cylinder without such pins, or without a range.
    """
    slide, axis = _slide(crane, label)
    what = f"crane {crane.data.name!r}: cylinder {label!r}"
    if slide.range is None:
        raise SceneError(f"{what}: has no range, which its stroke would be; give its joint a range_m")
    pins, extent = [], extent_of(crane.data)
    for body, outward in ((slide.first, -1.0), (slide.second, 1.0)):
        on_axis = [at for at in _pins(crane, body, slide) if _off(slide, axis, at) < ON_AXIS * extent]
        if not on_axis:
            raise SceneError(
                f"{what}: where it takes hold is not known, as no other joint of {body!r} is on its axis; "
                "add it by add_hydraulic_cylinder with its points"
            )
        pins.append(max(on_axis, key=lambda at: outward * float((at - slide.point) @ axis)))
    length = float((pins[1] - pins[0]) @ axis)
    low, high = slide.range
    if not length + low > 0.0:
        raise SceneError(
            f"{what}: is {length:.4g} m long at home, and its range_m begins {-low:.4g} m below; correct it"
        )
    first, second = crane.in_body(slide.first, pins[0]), crane.in_body(slide.second, pins[1])
    reach = {"retracted_length": length + low, "stroke": high - low}
    return {"first_point": first, "second_point": second} | reach


def static_force(
    crane: JointedCrane, label: str, *, coordinates: Mapping[str, float], payload_mass: float, gravity: float
) -> float:
    """Force (N, positive pushes) with which a cylinder holds crane and payload (kg) on a level base.

    By virtual work: the slope of the potential energy over its stroke, the other coordinates held.
    """
    free = dataclasses.replace(
        crane.data, joints=tuple(dataclasses.replace(joint, range=None) for joint in crane.data.joints)
    )
    held = dict(coordinates) | _strokes(crane, coordinates)
    body, tip = free.tip

    def energy(stroke: float) -> float:
        moved = pose_of(free, held | {label: stroke})
        heights = [
            one.properties.mass * moved[one.name].point(one.properties.center_of_mass)[2]
            for one in free.bodies
        ]
        return gravity * math.fsum([*heights, payload_mass * moved[body].point(tip)[2]])

    near, far = (energy(held[label] + h) - energy(held[label] - h) for h in (STEP, 2.0 * STEP))
    return (8.0 * near - far) / (12.0 * STEP)


def _strokes(crane: JointedCrane, coordinates: Mapping[str, float]) -> dict[str, float]:
    """The strokes of all cylinders at a pose, from home, m."""
    moved = pose_of(crane.data, coordinates)
    found = {}
    for label in crane.data.cylinders:
        slide, axis = _slide(crane, label)
        first, second = moved[slide.first], moved[slide.second]
        shift = first.rotation.T @ (second.point(slide.point) - first.point(slide.point))
        found[label] = float(shift @ axis)
    return found


def _slide(crane: JointedCrane, label: str) -> tuple[JointData, Array]:
    """The joint of a cylinder, and its axis."""
    name = crane.data.cylinders[label]
    slide = next(joint for joint in crane.data.joints if joint.name == name)
    assert slide.axis is not None
    return slide, slide.axis


def _pins(crane: JointedCrane, body: str, slide: JointData) -> list[Array]:
    """Points of a body's other joints, at home."""
    joints = (*crane.data.joints, *crane.data.closing_joints)
    return [one.point for one in joints if body in (one.first, one.second) and one.name != slide.name]


def _off(slide: JointData, axis: Array, at: Array) -> float:
    """Distance of a point from the axis, m."""
    return float(np.linalg.norm(np.cross(axis, at - slide.point)))
