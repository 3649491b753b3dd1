"""Points of bodies, forces of loads, and how a payload hangs from a crane."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from seacrane import Curve, Lift, Scene, simulate
from seacrane.errors import SceneError

LENGTH = 2.0


def spinning(**velocity: object) -> Scene:
    """A free body that flies and turns, with a point off its centre of mass."""
    scene = Scene(name="spinning")
    scene.add_body(
        name="box",
        mass=3.0,
        inertia=(1.0, 2.0, 2.5),
        center_of_mass=(0.1, -0.2, 0.3),
        velocity=(1.0, 0.5, 2.0),
        angular_velocity=(0.3, -0.7, 1.1),
        **velocity,  # type: ignore[arg-type]
    )
    scene.add_point(name="corner", body="box", point=(1.0, 2.0, -0.5))
    scene.add_point(name="origin", body="box")
    return scene


def rotations(quaternion: np.ndarray) -> np.ndarray:
    w, x, y, z = np.moveaxis(quaternion, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_point_moves_with_its_body(formulation: str) -> None:
    channels = ["position", "quaternion", "point_position", "point_velocity", "point_acceleration"]
    result = simulate(
        spinning(), t_end=1.0, dt_out=1e-3, rtol=1e-11, channels=channels, formulation=formulation
    )
    lever = np.array([1.0, 2.0, -0.5]) - np.array([0.1, -0.2, 0.3])
    turned = rotations(result["quaternion"][:, 0])
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
    turned = rotations(result["quaternion"][:, 0])
    push = result.select("load_force", load="push")
    lever = turned @ np.array([0.2, 0.1, 0.0])
    np.testing.assert_allclose(result.select("load_moment", load="push"), np.cross(lever, push), atol=1e-12)
    ends = turned @ np.array([0.0, 0.4, 0.2])
    np.testing.assert_allclose(
        result.select("load_moment", load="rope"), np.cross(ends, result.select("load_force", load="rope")),
        atol=1e-9
    )  # fmt: skip


def test_loads_of_one_name_are_told_apart_by_kind() -> None:
    scene = spinning()
    scene.add_body(name="other", mass=2.0, inertia=(1.0, 1.0, 1.0), position=(0.0, 0.0, 4.0))
    scene.add_spring(name="pull", first="other", second="box", stiffness=1.0)
    scene.add_point_force(name="pull", body="box", force=(1.0, 0.0, 0.0))
    result = simulate(scene, t_end=0.1, channels=["load_force"])
    assert list(result.coords["load"]) == ["point force pull", "spring pull"]


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


@pytest.mark.parametrize(("offlead", "sidelead"), [(0.2, 0.0), (0.0, -0.3), (-0.1, 0.15)])
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


def test_file_keeps_points(tmp_path: Path) -> None:
    scene = spinning()
    scene.save(tmp_path / "scene.json")
    again = Scene.load(tmp_path / "scene.json")
    assert again == scene
    assert list(again.points) == ["corner", "origin"]


def test_lift_file_adds_points(tmp_path: Path) -> None:
    path = tmp_path / "lift.toml"
    path.write_text(
        'format = "seacrane lift"\nversion = 2\n[scene]\nname = "one"\n'
        '[[body]]\nname = "box"\nmass_kg = 1.0\ninertia_kg_m2 = [1.0, 1.0, 1.0]\n'
        '[[point]]\nname = "corner"\nbody = "box"\npoint_m = [1.0, 0.0, 0.0]\n[run]\nt_end_s = 1.0\n'
    )
    assert np.allclose(Lift.load(path).scene().points["corner"].point, (1.0, 0.0, 0.0))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"name": "corner", "body": "box"}, "point 'corner': the name is used twice"),
        ({"name": "p", "body": "bax"}, "point 'p': .*'bax'"),
        ({"name": "p", "body": "ground"}, "point 'p': .*'ground'"),
        ({"name": "p", "body": "box", "point": (1.0, 2.0)}, "point 'p': point"),
        ({"name": "p", "body": "box", "point": (np.nan, 0.0, 0.0)}, "point 'p': point.*finite"),
        ({"name": "p", "body": "box", "point": (1e9, 0.0, 0.0)}, "point 'p': point"),
    ],
)
def test_points_that_are_refused(arguments: dict[str, object], words: str) -> None:
    scene = spinning()
    with pytest.raises(SceneError, match=words):
        scene.add_point(**arguments)  # type: ignore[arg-type]
        scene.compile()


def test_body_of_a_point_is_not_removed() -> None:
    with pytest.raises(SceneError, match="point 'corner', point 'origin' refer to it"):
        spinning().remove("box")
