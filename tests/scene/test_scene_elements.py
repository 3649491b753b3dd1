"""Elements of a scene are looked up, replaced and removed by name; a scene prints what it holds."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from seacrane import Curve, Scene, SceneError, cases, simulate
from seacrane.description.description import KINDS


def hung() -> Scene:
    """A load on a wire, on a trolley."""
    scene, ends = Scene(name="trolley"), {"point": (0.0, 0.0, 0.0), "second_point": (0.0, 0.0, -4.0)}
    scene.add_body("trolley", mass=100.0, inertia=(10.0, 10.0, 10.0))
    scene.add_body("load", mass=50.0, inertia=(5.0, 5.0, 5.0), position=(0.0, 0.0, -4.0))
    scene.add_joint("rail", kind="prismatic", first="ground", second="trolley", axis=(1.0, 0.0, 0.0))
    scene.add_joint("wire", kind="distance", first="trolley", second="load", **ends)
    scene.add_line(joint="wire", rung="rigid")
    scene.add_actuator("rail", name="drive", stiffness=10.0)
    scene.add_range(joint="rail", minimum=-3.0, maximum=3.0)
    scene.record_coordinate(joint="rail")
    return scene


def test_a_name_that_is_not_there_says_what_is() -> None:
    scene = hung()
    for table, kind in KINDS.items():
        with pytest.raises(KeyError, match=f"no {kind} 'lost'; the scene has"):
            getattr(scene, table)["lost"]
        assert getattr(scene, table).get("lost") is None and "lost" not in getattr(scene, table)


def test_a_replaced_element_takes_the_place_of_the_old_one() -> None:
    scene = hung()
    before = list(scene.bodies)
    heavier = scene.replace("load", mass=70.0)
    assert scene.bodies["load"] is heavier and heavier.mass == 70.0
    assert list(scene.bodies) == before
    np.testing.assert_array_equal(heavier.position, (0.0, 0.0, -4.0))
    tension = simulate(scene, t_end=0.1, channels=["tension"])["tension"]
    np.testing.assert_allclose(tension, 70.0 * scene.gravity, rtol=1e-9)
    scene.replace("drive", feed_forward=3.0)
    assert scene.actuators["drive"].feed_forward == Curve.constant(value=3.0)
    assert scene.actuators["drive"].stiffness == 10.0
    assert scene.add_driver("rail", curve=0.0).curve == Curve.constant(value=0.0)


WRONG: tuple[tuple[Callable[[Scene], Any], str], ...] = (
    (lambda s: s.replace("lost", mass=1.0), "scene 'trolley'.*no element 'lost'"),
    (lambda s: s.remove("load", kind="joint"), "no joint 'load'"),
    (lambda s: s.replace("wire", length=3.0), "'wire'.*several elements; pass kind='joint' or 'load'"),
    (lambda s: s.remove("load", kind="bodies"), "kind 'bodies' is unknown; choose body"),
    (lambda s: s.replace("load", weight=3.0), "body 'load': cannot change 'weight'"),
    (lambda s: s.replace("load", name="cargo"), "cannot change 'name'"),
    (lambda s: s.replace("load", mass="heavy"), "body 'load': mass is 'heavy'"),
    (lambda s: s.replace("rail", kind="recorded coordinate", joint="wire"), "not replaced; remove it"),
    (lambda s: s.remove("load"), "body 'load': joint 'wire' refer to it"),
    (
        lambda s: s.remove("rail", kind="joint"),
        "joint 'rail': .*'drive', range 'rail', recorded",
    ),
    (lambda s: s.remove("wire", kind="joint"), "joint 'wire': load 'wire' refer to it"),
)


@pytest.mark.parametrize(("do", "told"), WRONG, ids=[row[1] for row in WRONG])
def test_what_cannot_be_done_is_refused_and_changes_nothing(do: Callable[[Scene], Any], told: str) -> None:
    scene = hung()
    with pytest.raises((SceneError, TypeError), match=told):
        do(scene)
    assert scene == hung()


def test_elements_are_removed_from_the_outside_in() -> None:
    scene = hung()
    scene.remove("wire", kind="load")
    for name in ("wire", "load", "drive"):
        scene.remove(name)
    for kind in ("range", "recorded coordinate"):
        scene.remove("rail", kind=kind)
    for name in ("rail", "trolley"):
        scene.remove(name)
    assert scene == Scene(name="trolley")


def test_a_vessel_in_a_sea_is_kept() -> None:
    scene = cases.vessel()
    with pytest.raises(SceneError, match=r"vessel 'vessel': the waves on it .*refer to it"):
        scene.remove("vessel", kind="vessel")
    scene.waves = None
    scene.remove("vessel", kind="vessel")
    assert not scene.vessels and not scene.provenance
    scene.remove("vessel")
    assert not scene.bodies


def test_a_scene_prints_and_shows_what_it_holds() -> None:
    scene = hung()
    text = str(scene)
    for words in ("Scene 'trolley'", "trolley, load", "drive (rail displacement)", "rail (-3 to 3)"):
        assert words in text
    assert "empty" in str(Scene(name="none")) and max(map(len, str(cases.case2()).splitlines())) <= 100
    scene.add_body("<b>", mass=1.0, inertia=(1.0, 1.0, 1.0))
    page = scene._repr_html_()
    assert "<table>" in page and "&lt;b&gt;" in page and "<b>" not in page
    for name in dir(Scene):
        if not name.startswith("_") and callable(getattr(Scene, name)):
            assert getattr(Scene, name).__doc__, name
