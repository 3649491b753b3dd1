"""Where points of bodies are, as a scene describes them."""

from __future__ import annotations

import numpy as np
import pytest

from seacrane import Scene, SceneError, simulate
from seacrane.crane import FOOT, KnuckleBoomCrane

POSE = {"slew": -1.2, "s1": 1.0, "s2": 2.0}


def test_the_tip_of_a_crane_on_a_turned_ship_is_where_its_geometry_says() -> None:
    scene = Scene()
    scene.add_given_vessel("rest", position=(100.0, -30.0, 1.0), heading_deg=90.0)
    body, point = scene.add_crane(**POSE).tip or ("", ())
    x, y, z = np.asarray(FOOT) + KnuckleBoomCrane.load().geometry.tip(**POSE)
    np.testing.assert_allclose(scene.place_of(body=body, point=point), (100.0 - y, -30.0 + x, 1.0 + z))


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


def test_what_has_no_place_is_refused() -> None:
    scene = Scene()
    scene.add_body(name="box", mass=1.0, inertia=(1.0, 1.0, 1.0))
    with pytest.raises(SceneError, match="no body 'bocks', the scene has 'box'; add it first"):
        scene.place_of(body="bocks")
    with pytest.raises(SceneError, match=r"place on 'box': point has shape \(2,\); give \(3,\)"):
        scene.place_of(body="box", point=(1.0, 2.0))
