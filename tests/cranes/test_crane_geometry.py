"""The knuckle boom: closed-form kinematics, its joints, the paper's data, and what a bad file says."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seacrane import Scene
from seacrane.crane import BODIES, FOOT, KnuckleBoomCrane, Payload
from seacrane.crane.data_file import DEFAULT_PATH, parse
from seacrane.crane.geometry import plane_axes
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.frames import rotation_matrix

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
    angles = GEOMETRY.jib_angles(s1=s1, s2=s2)
    back = GEOMETRY.strokes(main_angle=angles[0], knuckle_angle=angles[1])
    assert back == pytest.approx((s1, s2), abs=1e-12)
    pivot = np.array([-math.sin(slew), math.cos(slew), 0.0])
    for name in BODIES[1:]:
        rotation = pose[name][1]
        np.testing.assert_allclose(rotation[:, 1], pivot, atol=1e-14)
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-14)
        assert np.linalg.det(rotation) == pytest.approx(1.0, abs=1e-13)
    for cylinder in ("main", "knuckle"):
        np.testing.assert_allclose(pose[f"{cylinder}_barrel"][1], pose[f"{cylinder}_rod"][1], atol=1e-15)


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
    stowed = GEOMETRY.tip(slew=0.0, s1=0.0, s2=0.0)  # aft
    assert stowed[0] < 0.0 and stowed[1] == 0.0
    out = GEOMETRY.tip(slew=-math.pi / 2.0, s1=0.0, s2=0.0)
    np.testing.assert_allclose(out, [0.0, -stowed[0], stowed[2]], atol=1e-12)  # to port
    assert GEOMETRY.tip(slew=0.0, s1=1.0, s2=0.0)[2] > stowed[2]  # both cylinders lift
    lowest = GEOMETRY.points(slew=0.0, s1=0.0, s2=0.0)["F"][2]
    assert GEOMETRY.points(slew=0.0, s1=1.0, s2=0.0)["F"][2] > lowest
    assert GEOMETRY.jib_angles(s1=0.0, s2=1.0)[1] > GEOMETRY.jib_angles(s1=0.0, s2=0.0)[1]


def test_poses_out_of_reach_name_the_item() -> None:
    for s1, s2, message in (
        (-0.1, 0.0, "main_cylinder: stroke -0.1"), (0.0, 5.5, "knuckle_cylinder: stroke 5.5")
    ):  # fmt: skip
        with pytest.raises(SceneError, match=message):
            GEOMETRY.pose(slew=0.0, s1=s1, s2=s2)
    for s1, beyond in ((0.0, -0.01), (5.0, 0.01), (5.0, math.pi)):
        main, knuckle = GEOMETRY.jib_angles(s1=s1, s2=2.0)
        with pytest.raises(SceneError, match=r"main_cylinder: jib angle .* out of reach"):
            GEOMETRY.strokes(main_angle=main + beyond, knuckle_angle=knuckle)


PLACE: dict[str, Any] = {"slew": -0.6, "s1": 1.7, "s2": 2.9}


def test_a_crane_in_a_scene_has_its_bodies_joints_ranges_and_payload() -> None:
    pose = CRANE.geometry.pose(**PLACE)
    for body in CRANE.bodies(**PLACE):
        np.testing.assert_allclose(rotation_matrix(body.quaternion), pose[body.name][1], atol=1e-15)
        np.testing.assert_allclose(body.position, pose[body.name][0] + np.array(FOOT), atol=1e-12)
    payload = Payload(mass=10e3, size=(6.0, 6.0, 4.0), link_length=8.0)
    hung = CRANE.payload_body(payload)
    tip = CRANE.geometry.tip(slew=0.0, s1=0.0, s2=0.0) + np.array(FOOT)
    np.testing.assert_allclose(tip - hung.position, [0.0, 0.0, 10.0], atol=1e-12)
    np.testing.assert_allclose(hung.inertia, np.diag([52.0, 52.0, 72.0]) * 10e3 / 12.0)
    scene = Scene()
    scene.add_crane(CRANE, base="ground", foot=(0.0, 0.0, 0.0), payload=Payload(), **PLACE)
    assert list(scene.bodies) == [*BODIES, "payload"]
    assert sum(body.mass for body in scene.bodies.values()) == pytest.approx(400e3)
    assert scene.joints["deck"].first == "ground"
    for cylinder, stroke in (("main_cylinder", PLACE["s1"]), ("knuckle_cylinder", PLACE["s2"])):
        limits = scene.ranges[cylinder]
        assert (limits.minimum, limits.maximum) == (-stroke, getattr(CRANE.data, cylinder).stroke - stroke)


TEXT = DEFAULT_PATH.read_text(encoding="utf-8")


def edit(old: str, new: str) -> str:
    assert old in TEXT
    return TEXT.replace(old, new, 1)


BAD = [
    ("mass = 80.0e3", "mass = 81.0e3", r"add up to 391000 kg"), ("schema = 1", "schema = 7", r"schema is 7"),
    ("wall = 0.03", "wall = 1.0", r"main_jib\.members\[0\] \(girder\)\.wall is 1 m"),
    ("inner_diameter = 4.4", "inner_diameter = 5.0", r"inner_diameter is 5 m, not below"),
    ("stroke = 5.0", "stroke = 12.0", r"main_cylinder cannot reach stroke 12 m"),
    ("retracted_length = 6.8", "retracted_length = 7.3", r"lever arm of .* at stroke 5 m")
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "message"), BAD)
def test_bad_data_names_item_and_fix(old: str, new: str, message: str) -> None:
    with pytest.raises(FileFormatError, match=f"^my_crane.toml: .*{message}"):
        parse(edit(old, new), source="my_crane.toml")
