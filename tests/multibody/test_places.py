"""Where points of bodies are, as a scene describes them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from seacrane import Lift, Scene, SceneError, simulate
from seacrane.crane import FOOT, KnuckleBoomCrane

POSE = {"slew": -1.2, "s1": 1.0, "s2": 2.0}


def test_the_tip_of_a_crane_on_a_turned_ship_is_where_its_geometry_says() -> None:
    scene = Scene()
    scene.add_given_vessel("rest", position=(100.0, -30.0, 1.0), heading_deg=90.0)
    body, point = scene.add_crane(**POSE).tip or ("", ())
    x, y, z = np.asarray(FOOT) + KnuckleBoomCrane.load().geometry.tip(**POSE)
    np.testing.assert_allclose(scene.place_of(body=body, point=point), (100.0 - y, -30.0 + x, 1.0 + z))
    np.testing.assert_array_equal(scene.place_of("tip"), scene.place_of(body=body, point=point))
    np.testing.assert_allclose(simulate(scene, 0.1, dt_out=0.1).place_of("tip")[0], scene.place_of("tip"))


def test_a_point_is_recorded_where_it_was_described() -> None:
    scene = Scene(gravity=0.0)
    scene.add_body(
        name="box", mass=1.0, inertia=(1.0, 1.0, 1.0), center_of_mass=(0.1, 0.2, 0.3),
        position=(1.0, 2.0, 3.0), quaternion=(0.5, 0.5, -0.5, 0.5),
    )  # fmt: skip
    corner = (0.4, -0.5, 0.6)
    scene.add_point(name="corner", body="box", point=corner)
    recorded = simulate(scene, t_end=0.1)["point_position"][0, 0]
    np.testing.assert_allclose(scene.place_of(body="box", point=corner), recorded, rtol=1e-12)
    np.testing.assert_array_equal(scene.place_of(body="ground", point=corner), corner)
    np.testing.assert_array_equal(scene.place_of(body="box"), (1.0, 2.0, 3.0))


def test_a_body_is_placed_below_the_tip(tmp_path: Path) -> None:
    """Its top, where it has a size and however it is turned; its origin, where it has none."""
    scene = Scene()
    scene.add_crane(base="ground", prefix="aft ", **POSE)
    tip = scene.place_of("aft tip")
    half = np.sqrt(0.5)  # a quarter turn about x: body y is up
    box = {"mass": 2e4, "size": (3.0, 2.0, 1.0), "center_of_mass": (0.1, 0.2, 0.3)}
    scene.add_body("box", **box, below="aft tip", drop=4.0)
    scene.add_body("turned", **box, below="aft tip", drop=4.0, quaternion=(half, half, 0.0, 0.0))
    scene.add_body("ball", mass=1.0, inertia=(1.0, 1.0, 1.0), below="aft tip", drop=2.0)
    down = np.array([0.0, 0.0, 1.0])
    np.testing.assert_allclose(scene.place_of("box", (0.1, 0.2, 0.8)), tip - 4.0 * down)
    np.testing.assert_allclose(scene.place_of("turned", (0.1, 0.2, 0.8)), tip - 4.0 * down)
    np.testing.assert_allclose(scene.place_of("ball"), tip - 2.0 * down)
    (tmp_path / "lift.toml").write_text(
        """format = "seacrane lift"
version = 2
[[body]]
name = "box"
mass_kg = 2e4
size_m = [3, 2, 1]
center_of_mass_m = [0.1, 0.2, 0.3]
below = "aft tip"
drop_m = 4
[[crane]]
base = "ground"
prefix = "aft "
slew_rad = -1.2
s1_m = 1
s2_m = 2
"""
    )
    read = Lift.load(tmp_path / "lift.toml").scene()
    np.testing.assert_allclose(read.place_of("box"), scene.place_of("box"))


BOX = {"mass": 2e4, "size": (3.0, 2.0, 1.0)}


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda scene: scene.place_of(body="bocks"), "'bocks'.*'box'"),
        (lambda scene: scene.place_of(body="box", point=(1.0, 2.0)), r"'box': point has shape \(2,\)"),
        (lambda scene: scene.add_body("new", **BOX, below="tip", position=(1.0, 0, 0)), "position and below"),
        (lambda scene: scene.add_body("new", **BOX, drop=3.0), "'new': drop"),
        (lambda scene: scene.add_body("new", **BOX, below="top"), "'new': below.*'top', .*'tip'"),
    ],
)
def test_what_has_no_place_or_two_is_refused(call: Callable[[Scene], None], words: str) -> None:
    scene = Scene()
    scene.add_crane(base="ground")
    scene.add_body("box", **BOX)
    with pytest.raises(SceneError, match=words):
        call(scene)
    assert "new" not in scene.bodies
