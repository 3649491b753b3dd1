"""Closed-form kinematics: loops close, angles and strokes invert, Euler angles stay regular."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seacrane.crane import BODIES, KnuckleBoomCrane
from seacrane.crane.geometry import REFERENCE_ELEVATION, plane_axes
from seacrane.errors import SceneError

Array = npt.NDArray[np.float64]
CRANE = KnuckleBoomCrane.load()
DATA, GEOMETRY = CRANE.data, CRANE.geometry
STROKE = st.floats(0.0, 5.0)
ANGLE = st.floats(-math.pi, math.pi)


def on_body(pose: dict[str, tuple[Array, Array]], name: str, point: tuple[float, float]) -> Array:
    """A point of the crane plane fixed on a body, in the crane-foot frame."""
    position, rotation = pose[name]
    return position + rotation @ plane_axes(name) @ np.array(point)


@given(slew=ANGLE, s1=STROKE, s2=STROKE)
@settings(max_examples=200, deadline=None)
def test_all_loops_close(slew: float, s1: float, s2: float) -> None:
    pose = GEOMETRY.pose(slew=slew, s1=s1, s2=s2)
    main = DATA.main_cylinder.retracted_length + s1
    knuckle = DATA.knuckle_cylinder.retracted_length + s2
    pairs = {
        "A": (("tower", (0.0, DATA.tower_height)), ("king", (0.0, 0.0))),
        "B": (("king", DATA.main_cylinder_pivot), ("main_barrel", (0.0, 0.0))),
        "C": (("king", DATA.main_jib_pivot), ("main_jib", (0.0, 0.0))),
        "D": (("main_rod", (0.0, 0.0)), ("main_jib", DATA.main_cylinder_head)),
        "E": (("main_jib", DATA.knuckle_cylinder_pivot), ("knuckle_barrel", (0.0, 0.0))),
        "F": (("main_jib", (DATA.main_jib_length, 0.0)), ("knuckle_jib", (0.0, 0.0))),
        "G": (("knuckle_rod", (0.0, 0.0)), ("knuckle_jib", DATA.knuckle_cylinder_head)),
        "main rod on the barrel's axis": (("main_barrel", (main, 0.0)), ("main_rod", (0.0, 0.0))),
        "knuckle rod on the barrel's axis": (("knuckle_barrel", (knuckle, 0.0)), ("knuckle_rod", (0.0, 0.0))),
    }
    for name, (first, second) in pairs.items():
        gap = on_body(pose, *first) - on_body(pose, *second)
        assert np.abs(gap).max() < 1e-12, name
    points = GEOMETRY.points(slew=slew, s1=s1, s2=s2)
    tip = on_body(pose, "knuckle_jib", (DATA.knuckle_jib_length, 0.0))
    np.testing.assert_allclose(points["tip"], tip, atol=1e-12)


@given(slew=ANGLE, s1=STROKE, s2=STROKE)
@settings(max_examples=100, deadline=None)
def test_axes_of_cylinders_and_pivots(slew: float, s1: float, s2: float) -> None:
    pose = GEOMETRY.pose(slew=slew, s1=s1, s2=s2)
    pivot = np.array([-math.sin(slew), math.cos(slew), 0.0])
    for name in BODIES[1:]:
        np.testing.assert_allclose(pose[name][1][:, 1], pivot, atol=1e-14)
        np.testing.assert_allclose(pose[name][1] @ pose[name][1].T, np.eye(3), atol=1e-14)
        assert np.linalg.det(pose[name][1]) == pytest.approx(1.0, abs=1e-13)
    for cylinder in ("main", "knuckle"):
        barrel, rod = (pose[f"{cylinder}_{part}"] for part in ("barrel", "rod"))
        along = barrel[1] @ plane_axes(f"{cylinder}_barrel")[:, 0]
        np.testing.assert_allclose(np.cross(along, rod[0] - barrel[0]), 0.0, atol=1e-11)
        np.testing.assert_allclose(barrel[1], rod[1], atol=1e-15)


@given(s1=STROKE, s2=STROKE)
@settings(max_examples=100, deadline=None)
def test_strokes_from_angles(s1: float, s2: float) -> None:
    main, knuckle = GEOMETRY.jib_angles(s1=s1, s2=s2)
    assert GEOMETRY.strokes(main_angle=main, knuckle_angle=knuckle) == pytest.approx((s1, s2), abs=1e-12)


@pytest.mark.parametrize("s", [0.01, 1.0, 2.5, 4.0, 4.99])
def test_lever_arms_are_distance_and_derivative(s: float) -> None:
    levers = GEOMETRY.lever_arms(s1=s, s2=s)
    p = GEOMETRY.points(slew=0.3, s1=s, s2=s)
    for lever, pivot, foot, head in ((levers[0], "C", "B", "D"), (levers[1], "F", "E", "G")):
        axis = p[head] - p[foot]
        distance = np.linalg.norm(np.cross(p[pivot] - p[foot], axis)) / np.linalg.norm(axis)
        assert lever == pytest.approx(distance, rel=1e-12)
    h = 1e-4
    ahead = np.array(GEOMETRY.jib_angles(s1=s + h, s2=s + h))
    behind = np.array(GEOMETRY.jib_angles(s1=s - h, s2=s - h))
    np.testing.assert_allclose(2.0 * h / (ahead - behind), levers, rtol=1e-6)


def test_directions_of_motion() -> None:
    stowed = GEOMETRY.tip(slew=0.0, s1=0.0, s2=0.0)
    assert stowed[0] < 0.0 and stowed[1] == 0.0
    out = GEOMETRY.tip(slew=-math.pi / 2.0, s1=0.0, s2=0.0)
    np.testing.assert_allclose(out, [0.0, -stowed[0], stowed[2]], atol=1e-12)  # to port
    assert GEOMETRY.tip(slew=0.0, s1=1.0, s2=0.0)[2] > stowed[2]  # both cylinders lift
    lowest = GEOMETRY.points(slew=0.0, s1=0.0, s2=0.0)["F"][2]
    assert GEOMETRY.points(slew=0.0, s1=1.0, s2=0.0)["F"][2] > lowest
    assert GEOMETRY.jib_angles(s1=0.0, s2=1.0)[1] > GEOMETRY.jib_angles(s1=0.0, s2=0.0)[1]


def euler_xyz(rotation: Array) -> Array:
    """XYZ Euler angles of R = Rx Ry Rz, rad."""
    return np.array(
        [
            math.atan2(-rotation[1, 2], rotation[2, 2]),
            math.asin(rotation[0, 2]),
            math.atan2(-rotation[0, 1], rotation[0, 0]),
        ]
    )


def test_stowed_bodies_are_pitched_only() -> None:
    pitch = GEOMETRY.plane_pose(s1=0.0, s2=0.0).pitch()
    for name, (_, rotation) in GEOMETRY.pose(slew=0.0, s1=0.0, s2=0.0).items():
        np.testing.assert_allclose(euler_xyz(rotation), [0.0, pitch[name], 0.0], atol=1e-14)
        assert abs(math.degrees(pitch[name])) < 45.0, name
    assert set(REFERENCE_ELEVATION) == set(BODIES)


def quintic(t: float, end: float) -> float:
    x = min(t / end, 1.0)
    return x**3 * (10.0 - 15.0 * x + 6.0 * x * x)


def case_motion(case: int, t: float) -> tuple[float, float]:
    """Slew angle and (common) stroke of the paper's cases."""
    target = 4.0 if case == 3 else 2.0
    ramp = quintic(t, 45.0)
    stroke = 3.0 + math.cos(math.tau * t / 5.0) if case == 3 and t > 50.0 else target * ramp
    return -math.pi / 2.0 * ramp, stroke


def rotation_xyz(x: float, y: float, z: float) -> Array:
    cx, sx, cy, sy, cz, sz = (f(a) for a in (x, y, z) for f in (math.cos, math.sin))
    return (
        np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
        @ np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
        @ np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    )


@pytest.mark.parametrize("case", [1, 2, 3])
@pytest.mark.parametrize("tilt", [(0, 0, 0), (5, 5, 5), (5, -5, 5), (-5, 5, -5), (-5, -5, -5)])
def test_euler_pitch_stays_away_from_its_singularity(case: int, tilt: tuple[int, int, int]) -> None:
    vessel = rotation_xyz(*(math.radians(a) for a in tilt))
    worst = dict.fromkeys(BODIES, 0.0)
    for t in np.linspace(0.0, 60.0, 601):
        slew, stroke = case_motion(case, float(t))
        for name, (_, rotation) in GEOMETRY.pose(slew=slew, s1=stroke, s2=stroke).items():
            worst[name] = max(worst[name], abs(euler_xyz(vessel @ rotation)[1]))
    assert math.degrees(max(worst.values())) < 75.0, worst


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"slew": 0.0, "s1": -0.1, "s2": 0.0}, r"main_cylinder: stroke -0.1 m is outside 0 to 5 m"),
        ({"slew": 0.0, "s1": 0.0, "s2": 5.5}, r"knuckle_cylinder: stroke 5.5 m is outside 0 to 5 m"),
        ({"slew": 0.0, "s1": math.nan, "s2": 0.0}, r"main_cylinder: stroke nan m"),
        ({"slew": math.inf, "s1": 0.0, "s2": 0.0}, r"slew is inf; give a finite angle"),
    ],
)
def test_bad_poses_name_the_item(values: dict[str, float], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        GEOMETRY.pose(**values)


@pytest.mark.parametrize("beyond", [-0.01, 0.01, math.pi])
def test_unreachable_jib_angle(beyond: float) -> None:
    main, knuckle = GEOMETRY.jib_angles(s1=0.0 if beyond < 0.0 else 5.0, s2=2.0)
    with pytest.raises(SceneError, match=r"main_cylinder: jib angle .* deg is out of reach; choose one from"):
        GEOMETRY.strokes(main_angle=main + beyond, knuckle_angle=knuckle)
