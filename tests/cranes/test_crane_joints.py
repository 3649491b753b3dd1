"""Records for a scene: names, kinds and places of the joints, and the rank of their constraints."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from seacrane import Scene
from seacrane.crane import BODIES, FOOT, BodyRecord, JointRecord, KnuckleBoomCrane, Payload
from seacrane.errors import SceneError

Array = npt.NDArray[np.float64]
CRANE = KnuckleBoomCrane.load()
PLACE: dict[str, Any] = {"slew": -0.6, "s1": 1.7, "s2": 2.9}
TOPOLOGY = [
    ("deck", "weld", "vessel", "tower"),
    ("A", "revolute", "tower", "king"),
    ("B", "universal", "king", "main_barrel"),
    ("C", "revolute", "king", "main_jib"),
    ("D", "spherical", "main_rod", "main_jib"),
    ("E", "universal", "main_jib", "knuckle_barrel"),
    ("F", "revolute", "main_jib", "knuckle_jib"),
    ("G", "spherical", "knuckle_rod", "knuckle_jib"),
    ("main_cylinder", "prismatic", "main_barrel", "main_rod"),
    ("knuckle_cylinder", "prismatic", "knuckle_barrel", "knuckle_rod"),
    ("link", "distance", "knuckle_jib", "payload"),
]


def matrix(quaternion: Array) -> Array:
    w, x, y, z = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def skew(v: Array) -> Array:
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def normals(axis: Array) -> tuple[Array, Array]:
    start = np.eye(3)[np.argmin(np.abs(axis))]
    first = np.cross(axis, start)
    first /= np.linalg.norm(first)
    return first, np.cross(axis, first)


class Motion:
    """Small rigid motions of all bodies, about their origins, and joint residuals after them."""

    def __init__(self, bodies: list[BodyRecord]) -> None:
        self.index = {body.name: k for k, body in enumerate(bodies)}
        self.origin = np.array([body.position for body in bodies])
        self.size = 6 * len(bodies)

    def point(self, name: str, point: Array, q: Array) -> Array:
        k = self.index[name]
        return self.origin[k] + q[6 * k : 6 * k + 3] + self.turn(name, point - self.origin[k], q)

    def turn(self, name: str, vector: Array, q: Array) -> Array:
        k = self.index[name]
        w = q[6 * k + 3 : 6 * k + 6]
        angle = float(np.linalg.norm(w))
        s = skew(w)
        a, b = (1.0, 0.5) if angle < 1e-12 else (math.sin(angle) / angle, (1 - math.cos(angle)) / angle**2)
        return np.asarray(vector + a * s @ vector + b * s @ s @ vector)

    def residual(self, joint: JointRecord, q: Array) -> Array:
        def both(vector: Array) -> tuple[Array, Array]:
            return self.turn(joint.first, vector, q), self.turn(joint.second, vector, q)

        if joint.kind == "distance":
            assert joint.second_point is not None and joint.length is not None
            ends = self.point(joint.second, joint.second_point, q) - self.point(joint.first, joint.point, q)
            return np.array([np.linalg.norm(ends) - joint.length])
        gap = self.point(joint.second, joint.point, q) - self.point(joint.first, joint.point, q)
        if joint.kind == "spherical":
            return gap
        if joint.kind == "weld":
            x, y, z = (both(e) for e in np.eye(3))
            return np.array([*gap, x[0] @ y[1], y[0] @ z[1], z[0] @ x[1]])
        assert joint.axis is not None
        if joint.kind == "universal":
            assert joint.second_axis is not None
            first = self.turn(joint.first, joint.axis, q)
            return np.array([*gap, first @ self.turn(joint.second, joint.second_axis, q)])
        n1, n2 = normals(joint.axis)
        axis = both(joint.axis)
        (n1a, n1b), (n2a, _) = both(n1), both(n2)
        tilt = [n1a @ axis[1], n2a @ axis[1]]
        if joint.kind == "revolute":
            return np.array([*gap, *tilt])
        assert joint.kind == "prismatic"
        return np.array([n1a @ gap, n2a @ gap, *tilt, n1b @ n2a])

    def jacobian(self, joints: list[JointRecord], h: float = 1e-5) -> Array:
        columns = []
        for k in range(self.size):
            step = np.zeros(self.size)
            step[k] = h
            ahead, behind = (
                np.concatenate([self.residual(joint, sign * step) for joint in joints]) for sign in (1, -1)
            )
            columns.append((ahead - behind) / (2.0 * h))
        return np.array(columns).T


def vessel() -> BodyRecord:
    return BodyRecord(
        name="vessel",
        mass=14.0e6,
        inertia=np.eye(3) * 1e10,
        center_of_mass=np.zeros(3),
        position=np.zeros(3),
        quaternion=np.array([1.0, 0.0, 0.0, 0.0]),
    )


def full_scene(place: dict[str, Any]) -> tuple[Motion, list[JointRecord]]:
    payload = Payload()
    bodies = [vessel(), *CRANE.bodies(**place), CRANE.payload_body(payload, **place)]
    return Motion(bodies), CRANE.joints(**place, payload=payload)


def rank(jacobian: Array) -> int:
    values = np.linalg.svd(jacobian, compute_uv=False)
    return int(np.sum(values > 1e-6 * values[0]))


def test_names_and_topology() -> None:
    joints = CRANE.joints(payload=Payload())
    assert [(j.name, j.kind, j.first, j.second) for j in joints] == TOPOLOGY
    assert [b.name for b in CRANE.bodies()] == list(BODIES)
    assert [j.name for j in CRANE.joints()] == [row[0] for row in TOPOLOGY[:-1]]


@pytest.mark.parametrize("place", [{"slew": 0.0, "s1": 0.0, "s2": 0.0}, PLACE])
def test_46_independent_constraints_of_60_coordinates(place: dict[str, Any]) -> None:
    motion, joints = full_scene(place)
    closed = np.concatenate([motion.residual(joint, np.zeros(motion.size)) for joint in joints])
    assert np.abs(closed).max() < 1e-12
    jacobian = motion.jacobian(joints)
    assert jacobian.shape == (46, 60)
    assert rank(jacobian) == 46


def test_rank_sees_a_joint_too_many() -> None:
    motion, joints = full_scene(PLACE)
    b = next(joint for joint in joints if joint.name == "B")
    stiff = JointRecord(
        name="B2", kind="revolute", first=b.first, second=b.second, point=b.point, axis=b.axis
    )
    jacobian = motion.jacobian([*joints, stiff])
    assert jacobian.shape[0] == 51
    assert rank(jacobian) == 46  # the loop is planar already: nothing new


def test_free_motions_are_slew_and_strokes() -> None:
    """The mechanism may move along every derivative of the closed-form pose, and those are independent."""
    motion, joints = full_scene(PLACE)
    jacobian, h = motion.jacobian(joints), 1e-5
    tangents = []
    for name in ("slew", "s1", "s2"):
        ahead, behind = ({**PLACE, name: PLACE[name] + sign * h} for sign in (1, -1))
        q = np.zeros(motion.size)
        pairs = zip(
            [*CRANE.bodies(**ahead), CRANE.payload_body(Payload(), **ahead)],
            [*CRANE.bodies(**behind), CRANE.payload_body(Payload(), **behind)],
            strict=True,
        )
        for k, (one, other) in enumerate(pairs, start=1):
            spin = matrix(one.quaternion) @ matrix(other.quaternion).T
            q[6 * k : 6 * k + 3] = (one.position - other.position) / (2 * h)
            q[6 * k + 3 : 6 * k + 6] = np.array(
                [spin[2, 1] - spin[1, 2], spin[0, 2] - spin[2, 0], spin[1, 0] - spin[0, 1]]
            ) / (4 * h)
        assert np.abs(jacobian @ q).max() < 1e-6 * np.abs(q).max()
        tangents.append(q / np.linalg.norm(q))
    assert np.linalg.matrix_rank(np.array(tangents), tol=1e-3) == 3


def test_axes_and_points_of_joints() -> None:
    joints = {joint.name: joint for joint in CRANE.joints(**PLACE, payload=Payload())}
    slew = PLACE["slew"]
    pivot = np.array([-math.sin(slew), math.cos(slew), 0.0])
    for name in "BCEF":
        axis = joints[name].axis
        assert axis is not None
        np.testing.assert_allclose(axis, pivot, atol=1e-15)
    for name, cylinder, head in (("B", "main_cylinder", "D"), ("E", "knuckle_cylinder", "G")):
        along, second = joints[cylinder].axis, joints[name].second_axis
        assert along is not None and second is not None
        assert abs(second @ pivot) < 1e-14 and abs(second @ along) < 1e-14
        stretch = joints[head].point - joints[name].point
        np.testing.assert_allclose(along, stretch / np.linalg.norm(stretch), atol=1e-13)
    np.testing.assert_allclose(joints["deck"].point, FOOT)
    link = joints["link"]
    assert link.second_point is not None
    np.testing.assert_allclose(link.point - link.second_point, [0.0, 0.0, 8.0], atol=1e-12)


def test_quaternions_match_rotations() -> None:
    pose = CRANE.geometry.pose(**PLACE)
    for body in CRANE.bodies(**PLACE):
        np.testing.assert_allclose(matrix(body.quaternion), pose[body.name][1], atol=1e-15)
        np.testing.assert_allclose(body.position, pose[body.name][0] + np.array(FOOT), atol=1e-12)


def test_payload_hangs_by_the_centroid_of_its_top() -> None:
    payload = Payload(mass=10e3, size=(6.0, 6.0, 4.0), link_length=8.0)
    body = CRANE.payload_body(payload)
    tip = CRANE.geometry.tip(slew=0.0, s1=0.0, s2=0.0) + np.array(FOOT)
    np.testing.assert_allclose(tip - body.position, [0.0, 0.0, 10.0], atol=1e-12)
    np.testing.assert_allclose(body.inertia, np.diag([52.0, 52.0, 72.0]) * 10e3 / 12.0)


def test_add_to_a_scene() -> None:
    scene = Scene()
    scene.add_crane(CRANE, base="ground", foot=(0.0, 0.0, 0.0), payload=Payload(), **PLACE)
    assert list(scene.bodies) == [*BODIES, "payload"]
    assert sum(body.mass for body in scene.bodies.values()) == pytest.approx(400e3)
    assert scene.joints["deck"].first == "ground"
    strokes = {"main_cylinder": PLACE["s1"], "knuckle_cylinder": PLACE["s2"]}
    for cylinder, stroke in strokes.items():
        limits = scene.ranges[cylinder]
        assert limits.minimum == -stroke
        assert limits.maximum == getattr(CRANE.data, cylinder).stroke - stroke
    kinds = {name: joint.kind for name, joint in scene.joints.items()}
    assert {kinds["deck"], kinds["link"]} == {"weld", "distance"}
    assert {kinds[cylinder] for cylinder in strokes} <= {"prismatic", "cylindrical"}
    assert scene.joints["link"].length == Payload().link_length
    bare = Scene()
    bare.add_body(name="vessel", mass=1.0, inertia=(1.0, 1.0, 1.0))
    bare.add_crane(CRANE, foot=FOOT)
    assert "link" not in bare.joints and bare.joints["deck"].first == "vessel"


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"mass": -1.0}, r"payload: mass is -1.0; give a finite number above zero"),
        ({"link_length": math.nan}, r"payload: link_length is nan"),
        ({"size": (6.0, 0.0, 4.0)}, r"payload: size\[1\] is 0.0"),
    ],
)
def test_bad_payload(values: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        Payload(**values)


def test_bad_foot() -> None:
    with pytest.raises(SceneError, match=r"crane: foot is \(33.0, nan, 10.0\); give three finite numbers"):
        CRANE.bodies(foot=(33.0, math.nan, 10.0))
