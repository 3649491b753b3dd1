"""A knuckle boom from its lengths: pivots in the plane of its jibs, members, strokes (see docs/crane.md)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.data import BodyData, CraneData, JointData, Placed
from seacrane.crane.file_table import FileTable
from seacrane.crane.mass_properties import combine

Array = NDArray[np.float64]
CYLINDERS = {"main": "main_cylinder", "knuckle": "knuckle_cylinder"}
SHORT_NAMES = {"s1": "main", "s2": "knuckle"}
APART = 1e-6  # m: pivots nearer than that are one
LEVEL, UP, DOWN = 0.0, math.pi / 2.0, -math.pi / 2.0
"""Elevation of a body's "along" at zero pitch of its frame, rad. It is chosen for each body so that pitch is
small in the stowed pose and XYZ Euler angles stay far from their singularity."""


def knuckle_boom(root: FileTable) -> CraneData:
    """Stowed at home: slew and both strokes are 0, and the jibs point aft.

    Raises
    ------
    FileFormatError
        A key is missing or a value out of range, a stroke cannot be reached, or a cylinder comes too near its
        dead centre.
    """
    name, least = root.text("name"), root.number("minimum_lever_arm")
    keys = ("tower", "king", "main_jib", "knuckle_jib", *CYLINDERS.values())
    tower, king, main_jib, knuckle_jib, main, knuckle = tables = [root.table(key) for key in keys]
    a = np.array([0.0, tower.number("height")])
    b, c = a + king.point("main_cylinder_pivot"), a + king.point("main_jib_pivot")
    head = np.array(main_jib.point("main_cylinder_head"))
    elbow = np.array([main_jib.number("length"), 0.0])
    foot = np.array(main_jib.point("knuckle_cylinder_pivot"))
    hand = np.array(knuckle_jib.point("knuckle_cylinder_head"))
    first, main_stroke = _jib_angle(main, b - c, head, least)
    relative, knuckle_stroke = _jib_angle(knuckle, foot - elbow, hand, least)
    second = first + relative
    d, e, f = (c + _turn(first, point) for point in (head, foot, elbow))
    g, tip = (f + _turn(second, point) for point in (hand, np.array([knuckle_jib.number("length"), 0.0])))
    push, pull = (math.atan2(*(end - start)[::-1]) for start, end in ((b, d), (e, g)))
    bodies = (
        _body("tower", np.zeros(2), LEVEL, LEVEL, tower, "members"),
        _body("king", a, LEVEL, LEVEL, king, "members"),
        _body("main_barrel", b, push, UP, main, "barrel"),
        _body("main_rod", d, push, UP, main, "rod"),
        _body("main_jib", c, first, LEVEL, main_jib, "members"),
        _body("knuckle_barrel", e, pull, LEVEL, knuckle, "barrel"),
        _body("knuckle_rod", g, pull, LEVEL, knuckle, "rod"),
        _body("knuckle_jib", f, second, DOWN, knuckle_jib, "members"),
    )
    pivot: dict[str, Any] = {"axis": np.array([0.0, 1.0, 0.0])}  # angles grow as the jibs rise
    along, above = zip(*(_plane(angle).T for angle in (push, pull)), strict=True)
    joints = (
        _joint("A", "revolute", "tower", "king", a, axis=np.array([0.0, 0.0, 1.0])),
        _joint("B", "universal", "king", "main_barrel", b, second_axis=above[0], **pivot),
        _joint("C", "revolute", "king", "main_jib", c, **pivot),
        _joint("D", "spherical", "main_rod", "main_jib", d, closes=True),
        _joint("E", "universal", "main_jib", "knuckle_barrel", e, second_axis=above[1], **pivot),
        _joint("F", "revolute", "main_jib", "knuckle_jib", f, **pivot),
        _joint("G", "spherical", "knuckle_rod", "knuckle_jib", g, closes=True),
        _joint("main_cylinder", "prismatic", "main_barrel", "main_rod", b,
               axis=along[0], range=(0.0, main_stroke)),
        _joint("knuckle_cylinder", "prismatic", "knuckle_barrel", "knuckle_rod", e,
               axis=along[1], range=(0.0, knuckle_stroke)),
    )  # fmt: skip
    pistons = {"main": (main.areas(), main.hydraulics()), "knuckle": (knuckle.areas(), knuckle.hydraulics())}
    for table in tables:
        table.finish()
    return CraneData(
        name=name,
        root="tower",
        bodies=bodies,
        joints=joints,
        slew="A",
        cylinders=CYLINDERS,
        tip=("knuckle_jib", _space(tip)),
        capacity=root.capacity(),
        areas={label: pair for label, (pair, _) in pistons.items() if pair is not None},
        hydraulics={label: oil for label, (_, oil) in pistons.items() if oil is not None},
        short_names=SHORT_NAMES,
    )


def _jib_angle(cylinder: FileTable, foot: Array, head: Array, least: float) -> tuple[float, float]:
    """Elevation of a jib at stroke 0 in the body before it, rad, and the largest stroke, m.

    The cylinder's foot and head, both from the jib's pivot, form a triangle with it, which must close at both
    ends of the stroke. The squared lever arm is concave in the squared length, so its least value is at an
    end of the stroke.
    """
    retracted, stroke = cylinder.number("retracted_length"), cylinder.number("stroke")
    a, b = math.hypot(*foot), math.hypot(*head)
    if min(a, b) < APART:
        cylinder.refuse(f"{cylinder.where} is pinned at its jib's own pivot; move its pivot or head")
    for at in (stroke, 0.0):
        length = retracted + at
        if not abs(a - b) <= length <= a + b:
            cylinder.refuse(
                f"{cylinder.where} cannot reach stroke {at:g} m: its length there is {length:g} m, its "
                f"pivots allow {abs(a - b):.4g} to {a + b:.4g} m; change retracted_length, stroke or a pivot"
            )
        opening = math.acos(min(max((a**2 + b**2 - length**2) / (2.0 * a * b), -1.0), 1.0))
        lever = a * b * math.sin(opening) / length
        if lever < least:
            cylinder.refuse(
                f"{cylinder.where} has a lever arm of {lever:.4g} m at stroke {at:g} m, near its dead "
                f"centre; minimum_lever_arm is {least:g} m: change retracted_length, stroke or a pivot"
            )
    return math.atan2(foot[1], foot[0]) + opening - math.atan2(head[1], head[0]), stroke


def _turn(angle: float, point: Array) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * point[0] - s * point[1], s * point[0] + c * point[1]])


def _plane(elevation: float) -> Array:
    """Unit vectors "along" and "above" in the crane-foot frame, (3, 2): the jibs point aft, to -x."""
    c, s = math.cos(elevation), math.sin(elevation)
    return np.array([[-c, s], [0.0, 0.0], [s, c]])


def _space(point: Array) -> Array:
    """A point (outward, up) in the crane-foot frame, m."""
    return _plane(LEVEL) @ point


def _body(name: str, at: Array, elevation: float, level: float, table: FileTable, key: str) -> BodyData:
    """Its members are given (along, above); "along" has an elevation, and is at `level` in its frame."""
    members = table.members(key, _plane(level))
    c, s = math.cos(elevation - level), math.sin(elevation - level)
    axes = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    return BodyData(name=name, properties=combine(members), frame=Placed(axes, _space(at)), members=members)


def _joint(name: str, kind: str, first: str, second: str, at: Array, **given: Any) -> JointData:
    return JointData(name=name, kind=kind, first=first, second=second, point=_space(at), **given)
