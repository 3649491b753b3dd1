"""Points of bodies, forces of loads, and how a payload hangs from a crane."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from seacrane import Curve, Scene, simulate
from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_matrix

LENGTH = 2.0


def spinning() -> Scene:
    """A free body that flies and turns, with a point off its centre of mass."""
    scene = Scene(name="spinning")
    scene.add_body(
        name="box", mass=3.0, inertia=(1.0, 2.0, 2.5), center_of_mass=(0.1, -0.2, 0.3),
        velocity=(1.0, 0.5, 2.0), angular_velocity=(0.3, -0.7, 1.1),
    )  # fmt: skip
    scene.add_point(name="corner", body="box", point=(1.0, 2.0, -0.5))
    scene.add_point(name="origin", body="box")
    return scene


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
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
    assert list(result.coords["point"]) == ["corner", "origin"]


def test_loads_add_up_to_mass_times_acceleration() -> None:
    scene = spinning()
    scene.add_body(name="other", mass=2.0, inertia=(1.0, 1.0, 1.0), position=(0.0, 0.0, 4.0))
    scene.add_spring(
        name="rope", first="other", second="box", first_point=(0.1, 0.0, 0.0), second_point=(0.0, 0.4, 0.2),
        stiffness=70.0, damping=3.0, natural_length=1.0,
    )  # fmt: skip
    scene.add_point_force(name="push", body="box", point=(0.2, 0.1, 0.0), force=(5.0, -2.0, 1.0))
    channels = ["acceleration", "load_force", "load_moment", "position", "quaternion"]
    result = simulate(scene, t_end=0.5, channels=channels)
    force = result.select("load_force", load="rope") + result.select("load_force", load="push")
    weight = np.array([0.0, 0.0, -3.0 * scene.gravity])
    np.testing.assert_allclose(3.0 * result["acceleration"][:, 0], force + weight, atol=1e-9)
    turned = rotation_matrix(result["quaternion"][:, 0])
    push = result.select("load_force", load="push")
    lever = turned @ np.array([0.2, 0.1, 0.0])
    np.testing.assert_allclose(result.select("load_moment", load="push"), np.cross(lever, push), atol=1e-12)
    ends = turned @ np.array([0.0, 0.4, 0.2])
    np.testing.assert_allclose(
        result.select("load_moment", load="rope"), np.cross(ends, result.select("load_force", load="rope")),
        atol=1e-9
    )  # fmt: skip


def hanging(offlead: float, sidelead: float, slewed: float = 0.0, rate: float = 0.0) -> Scene:
    """A post that slews, its boom, and a payload on a link that is held where the angles put it."""
    scene = Scene(name="hanging", gravity=9.81)
    turned = (np.cos(slewed / 2), 0.0, 0.0, np.sin(slewed / 2))
    scene.add_body(
        name="boom", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(4.0, 1.0, 0.0), quaternion=turned,
        angular_velocity=(0.0, 0.0, rate),
    )  # fmt: skip
    scene.add_joint(kind="revolute", name="slew", first="ground", second="boom", point=(4.0, 1.0, 0.0))
    turning = Curve.pieces(starts=[0.0], coefficients=[[0.0, rate, 0.0, 0.0, 0.0, 0.0]])
    scene.add_driver(joint="slew", curve=turning)
    out = np.array([np.cos(slewed), np.sin(slewed), 0.0])
    across = np.array([-np.sin(slewed), np.cos(slewed), 0.0])
    hang = np.tan(offlead) * out + np.tan(sidelead) * across - np.array([0.0, 0.0, 1.0])
    tip = np.array([4.0, 1.0, 8.0]) + 10.0 * out
    load = tip + LENGTH * hang / np.linalg.norm(hang)
    scene.add_body(name="load", mass=50.0, inertia=(5.0, 5.0, 5.0), position=load)
    scene.add_joint(
        kind="distance", name="link", first="boom", second="load", point=tip, second_point=load
    )  # fmt: skip
    scene.add_roles(slew="slew", link="link")
    return scene


@pytest.mark.parametrize(("offlead", "sidelead"), [(0.2, 0.0), (-0.1, 0.15)])
@pytest.mark.parametrize("slewed", [0.0, 2.0])
def test_offlead_and_sidelead_are_those_of_the_pose(offlead: float, sidelead: float, slewed: float) -> None:
    result = simulate(hanging(offlead, sidelead, slewed), t_end=0.1)
    assert result["offlead"][0] == pytest.approx(offlead, abs=1e-12)
    assert result["sidelead"][0] == pytest.approx(sidelead, abs=1e-12)


def test_small_swing_is_that_of_a_pendulum() -> None:
    result = simulate(hanging(1e-3, 0.0), t_end=3.0, rtol=1e-9)
    pendulum = 1e-3 * np.cos(np.sqrt(9.81 / LENGTH) * result.time)
    np.testing.assert_allclose(result["offlead"], pendulum, atol=2e-9)


@pytest.mark.warns("LargeSwingWarning")
def test_tip_velocity_is_that_of_the_slewing_boom() -> None:
    result = simulate(hanging(0.0, 0.0, rate=0.2), t_end=1.0)
    angle = 0.2 * result.time
    expected = 0.2 * 10.0 * np.stack([-np.sin(angle), np.cos(angle), 0.0 * angle], axis=1)
    np.testing.assert_allclose(result["tip_velocity"], expected, atol=1e-9)


def test_loads_of_one_name_are_told_apart_by_kind() -> None:
    scene = spinning()
    scene.add_body(name="other", mass=2.0, inertia=(1.0, 1.0, 1.0), position=(0.0, 0.0, 4.0))
    scene.add_spring(name="pull", first="other", second="box", stiffness=1.0)
    scene.add_point_force(name="pull", body="box", force=(1.0, 0.0, 0.0))
    result = simulate(scene, t_end=0.1, channels=["load_force"])
    assert list(result.coords["load"]) == ["point force pull", "spring pull"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"name": "corner", "body": "box"}, "point 'corner': .*twice"),
        ({"name": "p", "body": "bax"}, "point 'p': .*'bax'"),
        ({"name": "p", "body": "ground"}, "point 'p': .*'ground'"),
    ],
)
def test_points_that_are_refused(arguments: dict[str, Any], words: str) -> None:
    scene = spinning()
    with pytest.raises(SceneError, match=words):
        scene.add_point(**arguments)
        scene.compile()
    with pytest.raises(SceneError, match="point 'corner', point 'origin' refer"):
        spinning().remove("box")
