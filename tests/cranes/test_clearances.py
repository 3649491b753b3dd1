"""Clearances of points from boxes against their geometry, with limit states, files and refusals."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from seacrane import Scene, SceneError, simulate, summary
from seacrane.description.clearances import distance_from_box
from seacrane.description.file import scene_digest

G = 9.80665


def falling(*, turned: float = 0.0) -> Scene:
    """A block that falls past a box on a body that is turned about z."""
    scene = Scene(name="falling", gravity=G)
    scene.add_body(name="block", mass=1.0, inertia=(1.0, 1.0, 1.0), position=(3.0, 0.0, 10.0))
    scene.add_point(name="left", body="block", point=(-1.0, 0.0, 0.0))
    scene.add_point(name="right", body="block", point=(1.0, 0.0, 0.0))
    quaternion = (np.cos(0.5 * turned), 0.0, 0.0, np.sin(0.5 * turned))
    scene.add_body(
        name="house", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, 0.0), quaternion=quaternion,
        gravity=False,
    )  # fmt: skip
    return scene


def test_distances_from_a_box() -> None:
    points = np.array([(0, 0, 0), (0, 0, 0.9), (3, 0, 0), (4, 6, 0), (2, 3, 5), (1, 0, 0)], dtype=float)
    expected = [-1.0, -0.1, 2.0, 5.0, np.sqrt(1 + 1 + 16), 0.0]
    assert_allclose(distance_from_box(points, (2.0, 4.0, 2.0)), expected, atol=1e-15)
    assert_allclose(distance_from_box(points[3], (0.0, 0.0, 0.0)), np.hypot(4.0, 6.0))


@pytest.mark.parametrize("turned", [0.0, np.pi / 2.0])
def test_a_block_falls_past_a_box(turned: float) -> None:
    """The box is 2 m by 8 m by 4 m high; turned, its long side lies below the block."""
    scene = falling(turned=turned)
    scene.add_clearance(name="house", points=["left", "right"], body="house", size=(2.0, 8.0, 4.0))
    result = simulate(scene, 1.2, dt_out=0.1)
    height = 10.0 - 0.5 * G * result.time**2
    above, aside = np.maximum(np.abs(height) - 2.0, 0.0), 1.0 if turned == 0.0 else 0.0
    expected = np.hypot(above, aside)
    inside = (np.abs(height) < 2.0) & (turned > 0.0)
    expected[inside] = np.maximum(np.abs(height[inside]) - 2.0, -1.0)
    found = result.select("clearance", gap="house")
    assert_allclose(found[~inside], expected[~inside], atol=1e-6)
    assert np.all(found[inside] < 0.0)


def test_it_has_a_limit_state_and_a_row_and_is_kept_in_files(tmp_path: Path) -> None:
    scene = falling()
    digest = scene_digest(scene)
    scene.add_clearance(name="deck", points="left", center=(2.0, 0.0, 0.0))
    assert scene_digest(scene) == digest
    scene.add_limit_state(channel="clearance", minimum=6.0, names={"gap": "deck"})
    result = simulate(scene, 1.0, dt_out=0.25)
    lowest = 10.0 - 0.5 * G
    (used,) = result.utilisation
    assert used.utilisation == pytest.approx(6.0 / lowest, rel=1e-6)
    assert summary(result)["clearance deck"].minimum == pytest.approx(lowest, rel=1e-6)
    scene.save(tmp_path / "scene.json")
    again = Scene.load(tmp_path / "scene.json")
    assert again == scene and again.clearances == scene.clearances
    with pytest.raises(SceneError, match="clearance 'deck' refer to it"):
        scene.remove("left", kind="point")


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"points": []}, "no points"), ({"points": "top"}, "no point 'top'"),
        ({"body": "ship"}, "no body 'ship'"), ({"size": (1.0, -1.0, 1.0)}, "not negative"),
        ({"center": (np.nan, 0.0, 0.0)}, "three finite numbers"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_told(given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        falling().add_clearance(**({"name": "gap", "points": "left"} | given))
