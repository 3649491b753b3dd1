"""The knuckle boom: its kinematics by the law of cosines, the paper's data, and what a bad file says."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seacrane import Scene
from seacrane.crane import Payload, load_crane
from seacrane.crane.load_crane import SHIPPED, parse_crane
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.frames import rotation_matrix

CRANE = load_crane()
TEXT = (SHIPPED / "knuckle_boom_250t.toml").read_text(encoding="utf-8")
STROKE = st.floats(0.0, 5.0)
ANGLE = st.floats(-math.pi, math.pi)
LEVEL = dict.fromkeys(("king", "main_jib", "knuckle_barrel", "knuckle_rod"), 0.0)  # elevations at no pitch
LEVEL |= {"main_barrel": math.pi / 2.0, "main_rod": math.pi / 2.0, "knuckle_jib": -math.pi / 2.0}


RETRACTED = {"main": 8.5, "knuckle": 6.8}  # m, stowed


def jib_angle(foot: complex, head: complex, cylinder: str, stroke: float) -> float:
    """Elevation of a jib in the body before it, by the law of cosines; both pins from its pivot."""
    length = RETRACTED[cylinder] + stroke
    cosine = (abs(foot) ** 2 + abs(head) ** 2 - length**2) / (2.0 * abs(foot) * abs(head))
    return float(np.angle(foot) + math.acos(cosine) - np.angle(head))


def by_hand(s1: float, s2: float) -> tuple[dict[str, complex], dict[str, float]]:
    """Points outward + i up from the crane foot, m, and elevations of what is long, rad."""
    p = {"A": 6.5j, "B": 4.2 + 11.1j, "C": 1.0 + 17.8j}
    main_head, foot, elbow, head = 7.3 - 2.4j, 14.6 - 1.6j, 23.8, 3.0 - 0.5j
    main = jib_angle(p["B"] - p["C"], main_head, "main", s1)
    hand = main + jib_angle(foot - elbow, head, "knuckle", s2)
    turn, further = np.exp(1j * main), np.exp(1j * hand)
    p |= {"D": p["C"] + turn * main_head, "E": p["C"] + turn * foot, "F": p["C"] + turn * elbow}
    p |= {"G": p["F"] + further * head, "tip": p["F"] + further * 13.2}
    angles = {"king": 0.0, "main_jib": main, "knuckle_jib": hand}
    for part in ("barrel", "rod"):
        angles |= {f"main_{part}": float(np.angle(p["D"] - p["B"]))}
        angles |= {f"knuckle_{part}": float(np.angle(p["G"] - p["E"]))}
    return p, angles


@given(slew=ANGLE, s1=STROKE, s2=STROKE)
@settings(max_examples=60, deadline=None)
def test_points_and_bodies_are_those_of_the_law_of_cosines(slew: float, s1: float, s2: float) -> None:
    expected, angles = by_hand(s1, s2)
    found = CRANE.points(slew=slew, s1=s1, s2=s2)
    outward = np.array([-math.cos(slew), -math.sin(slew), 0.0])
    up, pivot = np.array([0.0, 0.0, 1.0]), np.array([-math.sin(slew), math.cos(slew), 0.0])
    for name, point in expected.items():
        np.testing.assert_allclose(found[name], point.real * outward + point.imag * up, atol=2e-12)
    origins = {"main_barrel": "B", "main_rod": "D", "main_jib": "C", "knuckle_barrel": "E"}
    origins |= {"knuckle_rod": "G", "knuckle_jib": "F", "king": "A"}
    bodies = {body.name: body for body in CRANE.parts(slew=slew, s1=s1, s2=s2).bodies}
    for name, origin in origins.items():
        np.testing.assert_allclose(bodies[name].position, found[origin], atol=2e-12)
        rotation, level = rotation_matrix(bodies[name].quaternion), LEVEL[name]
        along = rotation @ [-math.cos(level), 0.0, math.sin(level)]
        angle = angles[name]
        np.testing.assert_allclose(along, math.cos(angle) * outward + math.sin(angle) * up, atol=1e-12)
        np.testing.assert_allclose(rotation[:, 1], pivot, atol=1e-12)


def test_directions_of_motion() -> None:
    stowed = CRANE.tip()  # aft
    assert stowed[0] < 0.0 and abs(stowed[1]) < 1e-12
    out = CRANE.tip(slew=-math.pi / 2.0)
    np.testing.assert_allclose(out, [0.0, -stowed[0], stowed[2]], atol=1e-12)  # to port
    assert CRANE.tip(s1=1.0)[2] > stowed[2]  # both cylinders lift; the knuckle jib leans inward at first
    assert CRANE.tip(s2=1.0)[0] < stowed[0] and CRANE.tip(s2=5.0)[2] > CRANE.tip(s2=4.0)[2]


def test_a_coordinate_that_is_not_given_stays_where_it_is_drawn() -> None:
    crane = load_crane()
    for s in np.linspace(0.0, 5.0, 6):
        np.testing.assert_allclose(crane.tip(s2=s), crane.tip(s1=0.0, s2=s), atol=1e-12)
        np.testing.assert_allclose(crane.tip(s1=s), crane.tip(s1=s, s2=0.0), atol=1e-12)


def test_poses_out_of_reach_name_the_item() -> None:
    for name, value in (("s1", -0.1), ("s2", 5.5)):
        with pytest.raises(SceneError, match=f"{name} is {value:g} m, outside its range of 0 to 5"):
            CRANE.tip(**{name: value})


PLACE: dict[str, Any] = {"slew": -0.6, "s1": 1.7, "s2": 2.9}


def test_a_crane_in_a_scene_has_its_bodies_joints_ranges_and_payload() -> None:
    payload = Payload(mass=10e3, size=(6.0, 6.0, 4.0), link_length=8.0)
    hung = payload.under(CRANE.tip())
    np.testing.assert_allclose(CRANE.tip() - hung.position, [0.0, 0.0, 10.0], atol=1e-12)
    np.testing.assert_allclose(hung.inertia, np.diag([52.0, 52.0, 72.0]) * 10e3 / 12.0)
    scene = Scene()
    scene.add_crane(CRANE, base="ground", foot=(0.0, 0.0, 0.0), payload=Payload(), **PLACE)
    names = "tower king main_barrel main_rod main_jib knuckle_barrel knuckle_rod knuckle_jib payload"
    assert " ".join(scene.bodies) == names
    assert " ".join(scene.joints) == "deck A B C D E F G main_cylinder knuckle_cylinder link"
    assert sum(body.mass for body in scene.bodies.values()) == pytest.approx(400e3)
    assert scene.joints["deck"].first == "ground"
    for cylinder, stroke in (("main_cylinder", PLACE["s1"]), ("knuckle_cylinder", PLACE["s2"])):
        limits = scene.ranges[cylinder]
        assert (limits.minimum, limits.maximum) == (-stroke, 5.0 - stroke)


def edit(old: str, new: str) -> str:
    assert old in TEXT
    return TEXT.replace(old, new, 1)


BAD = [
    ("mass = 80.0e3", "mass = 81.0e3", r"add up to 391000 kg"), ("schema = 1", "schema = 7", r"schema is 7"),
    ("wall = 0.03", "wall = 1.0", r"bodies\[4\] \(main_jib\)\.members\[0\] \(girder\)\.wall is 1 m"),
    ("inner_diameter = 4.4", "inner_diameter = 5.0", r"inner_diameter is 5 m, not below"),
    ('kind = "jointed"', 'kind = "knuckle-boom"', 'kind is .knuckle-boom.; write "jointed"'),
    ("closes = true", "closes = 1", r"joints\[3\] \(D\)\.closes is 1; write true or false"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "message"), BAD)
def test_bad_data_names_item_and_fix(old: str, new: str, message: str) -> None:
    with pytest.raises(FileFormatError, match=f"^my_crane.toml: .*{message}"):
        parse_crane(edit(old, new), source="my_crane.toml")
