"""Places, points, forces of loads and signs, as a scene describes them and docs/conventions.md shows."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from multibody_runs import ramp

from seacrane import Curve, Scene, SceneError, _core, cases, simulate
from seacrane.analysis import driven
from seacrane.crane import FOOT, Payload, load_crane
from seacrane.inputs.frames import rotation_matrix

POSE = {"slew": -1.2, "s1": 1.0, "s2": 2.0}
BOX: dict[str, Any] = {"mass": 2e4, "size": (3.0, 2.0, 1.0)}


def test_the_tip_of_a_crane_on_a_turned_ship_is_where_its_geometry_says() -> None:
    scene = Scene()
    scene.add_vessel(motion="rest", position=(100.0, -30.0, 1.0), heading_deg=90.0)
    body, point = scene.add_crane(**POSE).tip or ("", ())
    x, y, z = np.asarray(FOOT) + load_crane().tip(**POSE)
    np.testing.assert_allclose(scene.place_of(body=body, point=point), (100.0 - y, -30.0 + x, 1.0 + z))
    np.testing.assert_array_equal(scene.place_of("tip"), scene.place_of(body=body, point=point))
    np.testing.assert_allclose(simulate(scene, 0.1, dt_out=0.1).place_of("tip")[0], scene.place_of("tip"))


def test_vectors_are_turned_by_quaternions() -> None:
    random = np.random.default_rng(5)
    quaternion, vector = random.normal(size=(7, 4)), random.normal(size=3)
    quaternion /= np.linalg.norm(quaternion, axis=1, keepdims=True)
    np.testing.assert_allclose(
        _core.turned(quaternion, vector), rotation_matrix(quaternion) @ vector, atol=1e-14
    )


def test_a_body_is_placed_below_the_tip() -> None:
    scene = Scene()
    scene.add_crane(base="ground", prefix="aft ", **POSE)
    tip, down = scene.place_of("aft tip"), np.array([0.0, 0.0, 1.0])
    box = BOX | {"center_of_mass": (0.1, 0.2, 0.3), "below": "aft tip", "drop": 4.0}
    half = np.sqrt(0.5)  # a quarter turn about x: body y is up
    for name, turned in (("box", (1.0, 0.0, 0.0, 0.0)), ("turned", (half, half, 0.0, 0.0))):
        scene.add_body(name, **box, quaternion=turned)
        np.testing.assert_allclose(scene.place_of(name, (0.1, 0.2, 0.8)), tip - 4.0 * down)
    scene.add_body("ball", mass=1.0, inertia=(1.0, 1.0, 1.0), below="aft tip", drop=2.0)
    np.testing.assert_allclose(scene.place_of("ball"), tip - 2.0 * down)


def test_a_body_with_two_places_is_refused() -> None:
    scene = Scene()
    scene.add_crane(base="ground")
    for place, words in (
        ({"below": "tip", "position": (1.0, 0, 0)}, "position and below"), ({"drop": 3.0}, "drop")
    ):  # fmt: skip
        with pytest.raises(SceneError, match=words):
            scene.add_body("new", **BOX, **place)
    assert "new" not in scene.bodies


def spinning() -> Scene:
    """A free body that flies and turns, with a point off its centre of mass."""
    scene = Scene(name="spinning")
    scene.add_body(
        name="box", mass=3.0, inertia=(1.0, 2.0, 2.5), center_of_mass=(0.1, -0.2, 0.3),
        velocity=(1.0, 0.5, 2.0), angular_velocity=(0.3, -0.7, 1.1),
    )  # fmt: skip
    scene.add_point(name="corner", body="box", point=(1.0, 2.0, -0.5))
    return scene


def test_point_moves_with_its_body(formulation: str) -> None:
    channels = ["position", "quaternion", "point_position", "point_velocity", "point_acceleration"]
    result = simulate(
        spinning(), t_end=1.0, dt_out=1e-3, rtol=1e-11, channels=channels, formulation=formulation
    )
    lever = np.array([1.0, 2.0, -0.5]) - np.array([0.1, -0.2, 0.3])
    turned = rotation_matrix(result["quaternion"][:, 0])
    at = result["point_position"]
    np.testing.assert_allclose(at[:, 0], result["position"][:, 0] + turned @ lever, atol=1e-12)
    for rate, of in (("point_velocity", at), ("point_acceleration", result["point_velocity"])):
        fourth_order = (8 * (of[3:-1] - of[1:-3]) - (of[4:] - of[:-4])) / 12e-3
        np.testing.assert_allclose(result[rate][2:-2], fourth_order, atol=2e-9)


def test_loads_of_one_name_are_told_apart_and_add_up_to_mass_times_acceleration() -> None:
    scene = spinning()
    scene.add_body(name="other", mass=2.0, inertia=(1.0, 1.0, 1.0), position=(0.0, 0.0, 4.0))
    at = {"spring pull": (0.0, 0.4, 0.2), "point force pull": (0.2, 0.1, 0.0)}
    scene.add_spring(
        name="pull", first="other", second="box", first_point=(0.1, 0.0, 0.0), second_point=at["spring pull"],
        stiffness=70.0, damping=3.0, natural_length=1.0,
    )  # fmt: skip
    scene.add_force("box", name="pull", point=at["point force pull"], force=(5.0, -2.0, 1.0))
    channels = ["acceleration", "load_force", "load_moment", "quaternion"]
    result = simulate(scene, t_end=0.5, channels=channels)
    assert set(result.coords["load"]) == set(at)
    total = np.array([0.0, 0.0, -3.0 * scene.gravity])
    for name, point in at.items():
        force = result.select("load_force", load=name)
        lever = rotation_matrix(result["quaternion"][:, 0]) @ np.array(point)
        np.testing.assert_allclose(result.select("load_moment", load=name), np.cross(lever, force), atol=1e-9)
        total = total + force
    np.testing.assert_allclose(3.0 * result["acceleration"][:, 0], total, atol=1e-9)


def hanging(offlead: float, sidelead: float, slewed: float = 0.0, rate: float = 0.0) -> Scene:
    """A post that slews, its boom, and a payload on a link that is held where the angles put it."""
    scene = Scene(name="hanging", gravity=9.81)
    turned = (np.cos(slewed / 2), 0.0, 0.0, np.sin(slewed / 2))
    scene.add_body(
        name="boom", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(4.0, 1.0, 0.0), quaternion=turned,
        angular_velocity=(0.0, 0.0, rate),
    )  # fmt: skip
    scene.add_joint(kind="revolute", name="slew", first="ground", second="boom", point=(4.0, 1.0, 0.0))
    scene.add_driver(joint="slew", curve=ramp(rate))
    out = np.array([np.cos(slewed), np.sin(slewed), 0.0])
    across = np.array([-np.sin(slewed), np.cos(slewed), 0.0])
    hang = np.tan(offlead) * out + np.tan(sidelead) * across - np.array([0.0, 0.0, 1.0])
    tip = np.array([4.0, 1.0, 8.0]) + 10.0 * out
    load = tip + 2.0 * hang / np.linalg.norm(hang)
    scene.add_body(name="load", mass=50.0, inertia=(5.0, 5.0, 5.0), position=load)
    scene.add_joint(
        kind="distance", name="link", first="boom", second="load", point=tip, second_point=load
    )  # fmt: skip
    scene.add_roles(slew="slew", link="link")
    return scene


@pytest.mark.warns(sometimes=["LargeSwingWarning"])
@pytest.mark.parametrize(
    ("offlead", "sidelead", "slewed", "rate"),
    [(0.2, 0.0, 0.0, 0.0), (-0.1, 0.15, 2.0, 0.0), (0.0, 0.0, 0.0, 0.2)],
)
def test_lead_is_that_of_the_pose_and_tip_velocity_that_of_the_slewing_boom(
    offlead: float, sidelead: float, slewed: float, rate: float
) -> None:
    result = simulate(hanging(offlead, sidelead, slewed, rate), t_end=1.0)
    assert result["offlead"][0] == pytest.approx(offlead, abs=1e-12)
    assert result["sidelead"][0] == pytest.approx(sidelead, abs=1e-12)
    angle = slewed + rate * result.time
    expected = 10.0 * rate * np.stack([-np.sin(angle), np.cos(angle), 0.0 * angle], axis=1)
    np.testing.assert_allclose(result["tip_velocity"], expected, atol=1e-9)


PUSHES = {
    "surge": ((0.0, 0.0, 0.0), (1e5, 0.0, 0.0)),
    "sway": ((0.0, 0.0, 0.0), (0.0, 1e5, 0.0)),  # to port
    "heave": ((0.0, 0.0, 0.0), (0.0, 0.0, 1e6)),
    "roll": ((0.0, 10.0, 0.0), (0.0, 0.0, 1e6)),  # the port side up
    "pitch": ((50.0, 0.0, 0.0), (0.0, 0.0, -1e6)),  # the bow down
    "yaw": ((50.0, 0.0, 0.0), (0.0, 1e5, 0.0)),  # the bow to port
}


@pytest.mark.parametrize("motion", PUSHES)
def test_a_push_moves_the_vessel_in_the_positive_sense(motion: str) -> None:
    scene = cases.vessel(hs=0.0)
    point, force = PUSHES[motion]
    scene.add_force("vessel", name="push", point=point, force=force)
    result = simulate(scene, t_end=2.0)
    assert result.select("vessel_motion", motion=motion)[-1] > 1e-5


def _elevation(joint: str, **strokes: float) -> float:
    """Of the jib from a joint on, in the crane plane."""
    points = load_crane().points(**{"main": 1.0, "knuckle": 1.0} | strokes)
    arm = points["tip" if joint == "F" else "F"] - points[joint]
    return float(np.arctan2(arm[2], -arm[0]))


@pytest.mark.parametrize(("cylinder", "joint"), [("main", "C"), ("knuckle", "F")])
def test_extending_a_cylinder_raises_its_jib(cylinder: str, joint: str) -> None:
    scene = Scene(name="crane")
    scene.add_crane(base="ground", s1=1.0, s2=1.0, payload=Payload())
    scene.add_channel(joint=joint, name="jib")
    for name, moved in {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}.items():
        scene.add_actuator(name=name, joint=moved)
    out = Curve.quintic(start_time=0.0, end_time=20.0, start=0.0, end=1.0)
    result = simulate(driven(scene, references={cylinder: out}), t_end=20.0)
    raised = _elevation(joint, **{cylinder: 2.0}) - _elevation(joint)
    assert raised > 0.05
    assert result.select("coordinate[jib]")[-1] == pytest.approx(raised, abs=1e-6)
    assert result.select("cylinder_force", cylinder="main").min() > 0.0, "it carries the jib: it pushes"
    assert result["link_tension"].min() > 0.0, "the payload hangs: the link pulls"
