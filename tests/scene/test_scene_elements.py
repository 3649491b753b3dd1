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
    scene = Scene(name="trolley")
    scene.add_body(name="trolley", mass=100.0, inertia=(10.0, 10.0, 10.0))
    scene.add_body(name="load", mass=50.0, inertia=(5.0, 5.0, 5.0), position=(0.0, 0.0, -4.0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="trolley", axis=(1.0, 0.0, 0.0))
    scene.add_joint(
        kind="distance", name="wire", first="trolley", second="load", point=(0.0, 0.0, 0.0),
        second_point=(0.0, 0.0, -4.0),
    )  # fmt: skip
    scene.add_line(joint="wire", rung="rigid")
    scene.add_actuator(joint="rail", name="drive", stiffness=10.0)
    scene.add_range(joint="rail", minimum=-3.0, maximum=3.0)
    scene.record_coordinate(joint="rail")
    return scene


@pytest.mark.parametrize("table", KINDS)
def test_a_name_that_is_not_there_says_what_is(table: str) -> None:
    scene = hung()
    with pytest.raises(KeyError, match=f"there is no {KINDS[table]} 'lost'; the scene has"):
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


def test_a_number_becomes_a_constant_curve() -> None:
    scene = hung()
    scene.replace("drive", feed_forward=3.0)
    assert scene.actuators["drive"].feed_forward == Curve.constant(value=3.0)
    assert scene.actuators["drive"].stiffness == 10.0
    held = scene.add_driver(joint="rail", curve=0.0)
    assert held.curve == Curve.constant(value=0.0)


WRONG: dict[str, tuple[Callable[[Scene], Any], str]] = {
    "lost": (lambda s: s.replace("lost", mass=1.0), "scene 'trolley': there is no element 'lost'"),
    "lost, of a kind": (lambda s: s.remove("load", kind="joint"), "there is no joint 'load'"),
    "ambiguous": (
        lambda s: s.replace("wire", length=3.0),
        "'wire' is the name of several elements; pass kind='joint' or 'load'",
    ),
    "unknown kind": (lambda s: s.remove("load", kind="bodies"), "kind 'bodies' is unknown; choose body"),
    "unknown argument": (lambda s: s.replace("load", weight=3.0), "body 'load': cannot change 'weight'"),
    "a new name": (lambda s: s.replace("load", name="cargo"), "cannot change 'name'"),
    "a wrong value": (
        lambda s: s.replace("load", mass="heavy"), "body 'load': mass is 'heavy'; give a number"
    ),
    "a recorded one": (
        lambda s: s.replace("rail", kind="recorded coordinate", joint="wire"), "is not replaced; remove it"
    ),
    "a body in use": (
        lambda s: s.remove("load"), "body 'load': joint 'wire' refer to it; remove these first"
    ),
    "a joint in use": (
        lambda s: s.remove("rail", kind="joint"),
        "joint 'rail': actuator 'drive', range 'rail', recorded coordinate 'rail' refer to it",
    ),
    "a wire's joint": (lambda s: s.remove("wire", kind="joint"), "joint 'wire': load 'wire' refer to it"),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_cannot_be_done_is_refused_and_changes_nothing(case: str) -> None:
    scene, (do, words) = hung(), WRONG[case]
    with pytest.raises((SceneError, TypeError), match=words):
        do(scene)
    assert scene == hung()


def test_elements_are_removed_from_the_outside_in() -> None:
    scene = hung()
    scene.remove("wire", kind="load")
    scene.remove("wire")
    scene.remove("load")
    scene.remove("drive")
    scene.remove("rail", kind="range")
    scene.remove("rail", kind="recorded coordinate")
    scene.remove("rail")
    scene.remove("trolley")
    assert scene == Scene(name="trolley")


def test_a_vessel_in_a_sea_is_kept() -> None:
    scene = cases.vessel()
    with pytest.raises(SceneError, match=r"vessel 'vessel': the waves on it \(scene.waves\) refer to it"):
        scene.remove("vessel", kind="vessel")
    scene.waves = None
    scene.remove("vessel", kind="vessel")
    assert not scene.vessels and not scene.provenance
    scene.remove("vessel")
    assert not scene.bodies


def test_a_scene_prints_as_a_table_of_what_it_holds() -> None:
    text = str(hung())
    assert text.splitlines()[0] == "Scene 'trolley', gravity 9.80665 m/s2"
    assert "    2  bodies" in text and "trolley, load" in text and "drive (rail displacement)" in text
    assert "limits and friction" in text and "rail (-3 to 3)" in text
    assert str(Scene(name="none")).endswith("  empty")
    case2 = str(cases.case2())
    assert "knuckle (knuckle_cylinder)" in case2 and max(map(len, case2.splitlines())) <= 100


def test_a_scene_shows_as_a_table_in_notebooks() -> None:
    scene = hung()
    scene.add_body(name="<b>", mass=1.0, inertia=(1.0, 1.0, 1.0))
    page = scene._repr_html_()
    assert "<table>" in page and "&lt;b&gt;" in page and "<b>" not in page


def test_methods_carry_the_documentation_of_what_they_do() -> None:
    for name in dir(Scene):
        if not name.startswith("_") and callable(getattr(Scene, name)):
            assert getattr(Scene, name).__doc__, name
