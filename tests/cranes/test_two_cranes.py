"""Roles of a crane's parts: who writes them, what reads them, and two cranes in one scene."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Curve, Result, Scene, SceneError, balance, cases, simulate, simulate_to_file
from seacrane.accuracy.quantities import quantities_of
from seacrane.crane import Payload
from seacrane.warnings import LargeSwingWarning

FEET = {"": (0.0, 0.0, 0.0), "aft ": (-60.0, 5.0, 0.0)}
PARTS = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}
ENDS = {"": (-0.6, 0.5, 0.3), "aft ": (0.4, 0.2, 0.6)}
LOADS = {"": 10e3, "aft ": 25e3}


def cranes(*prefixes: str) -> Scene:
    """Cranes on a fixed base, each with its own payload and its own swing-out."""
    scene = Scene(name="cranes")
    for prefix in prefixes:
        payload = Payload(mass=LOADS[prefix])
        scene.add_crane(base="ground", foot=FEET[prefix], payload=payload, prefix=prefix)
        for name, joint in PARTS.items():
            scene.record_coordinate(joint=prefix + joint)
            scene.add_actuator(name=prefix + name, joint=prefix + joint)
    loads = balance(scene).loads
    like = cases.case2(hs=0.0, memory="none").actuators
    for prefix in prefixes:
        for name, end in zip(PARTS, ENDS[prefix], strict=True):
            scene.replace(
                prefix + name, kind="actuator", stiffness=like[name].stiffness, damping=like[name].damping,
                feed_forward=loads[prefix + name],
                reference=Curve.quintic(start_time=0.0, end_time=4.0, start=0.0, end=end),
            )  # fmt: skip
    return scene


RUN: dict[str, Any] = {"t_end": 3.0, "integrator": "rk4", "dt": 0.02}


@pytest.fixture(scope="module")
def both() -> Result:
    with pytest.warns(LargeSwingWarning):
        return simulate(cranes("", "aft "), **RUN)


@pytest.mark.warns(sometimes=["LargeSwingWarning"])
@pytest.mark.parametrize("prefix", FEET)
def test_two_cranes_on_a_fixed_base_move_as_each_does_alone(both: Result, prefix: str) -> None:
    alone = simulate(cranes(prefix), **RUN)
    for body in alone.coords["body"]:
        np.testing.assert_allclose(
            both.select("position", body=body), alone.select("position", body=body), atol=1e-9
        )
    for channel, scale in (("stroke", 1e-9), ("stroke_rate", 1e-9), ("cylinder_force", 1e-2)):
        for name in ("main", "knuckle"):
            label = {"cylinder": prefix + name}
            np.testing.assert_allclose(
                both.select(channel, **label), alone.select(channel, **label), atol=scale
            )
    for channel, dim, label, scale in (
        ("slew_angle", "slew", "slew", 1e-9),
        ("slew_torque", "slew", "slew", 1e-2),
        ("link_tension", "hook", "hook", 1e-3),
    ):
        assert alone.dims[channel] == ("time",)
        np.testing.assert_allclose(both.select(channel, **{dim: prefix + label}), alone[channel], atol=scale)
    assert alone["stroke"][-1, 0] == pytest.approx(ENDS[prefix][1], rel=0.2)


def test_labels_tell_two_cranes_apart_in_files_too(both: Result, tmp_path: Path) -> None:
    again = Result.load(both.save(tmp_path / "both.nc"))
    for result in (both, again):
        assert result.coords["cylinder"] == ("main", "knuckle", "aft main", "aft knuckle")
        assert result.coords["slew"] == ("slew", "aft slew")
        assert result.coords["hook"] == ("hook", "aft hook")
        assert result.dims["slew_angle"] == ("time", "slew")
        assert result.dims["link_tension"] == ("time", "hook")
    np.testing.assert_array_equal(again["slew_angle"], both["slew_angle"])


@pytest.mark.warns("LargeSwingWarning")
def test_pieces_of_a_long_run_of_two_cranes_join(both: Result, tmp_path: Path) -> None:
    told = simulate_to_file(cranes("", "aft "), tmp_path / "long.nc", **RUN)
    np.testing.assert_allclose(told.load()["slew_angle"], both["slew_angle"], atol=1e-12)


def test_a_scene_of_two_cranes_keeps_its_roles_in_a_file(tmp_path: Path) -> None:
    scene = cranes("", "aft ")
    scene.save(tmp_path / "two.json")
    back = Scene.load(tmp_path / "two.json")
    assert back == scene and dict(back.roles) == dict(scene.roles)
    assert back.roles["aft "].cylinders == {"main": "aft main_cylinder", "knuckle": "aft knuckle_cylinder"}
    assert back.roles["aft "].payload == "aft payload"
    assert back.roles["aft "].tip is not None and back.roles["aft "].tip[0] == "aft knuckle_jib"


def test_quantities_are_the_worst_of_both_cranes(both: Result) -> None:
    scene = cranes("", "aft ")
    offered = quantities_of(scene, scene.compile(), None)
    assert set(offered) == {"payload_position", "tip_velocity", "cylinder_force", "hook_load"}
    shapes = {name: quantity.values(both).shape[1:] for name, quantity in offered.items()}
    assert shapes == {
        "payload_position": (2, 3), "tip_velocity": (2, 3), "cylinder_force": (4, 1), "hook_load": (2, 1),
    }  # fmt: skip


def test_two_cranes_need_different_prefixes() -> None:
    scene = cranes("")
    with pytest.raises(SceneError, match="there is one with prefix ''; give this one another"):
        scene.add_crane(base="ground")


def test_a_crane_stands_on_a_body_named_as_one_of_its_own() -> None:
    scene = Scene()
    scene.add_crane(base="ground")
    scene.add_crane(base="tower", foot=(5.0, 0.0, 0.0), prefix="upper ")
    assert (scene.joints["upper deck"].first, scene.joints["upper deck"].second) == ("tower", "upper tower")


def test_the_tip_is_known_without_a_payload() -> None:
    bare, loaded = Scene(), Scene()
    pose: dict[str, Any] = {"base": "ground", "slew": 0.3, "s1": 1.0, "s2": 2.0}
    told, known = bare.add_crane(**pose), loaded.add_crane(**pose, payload=Payload())
    assert told.link is None and told.payload is None and known.link == "link"
    assert told.tip is not None and known.tip is not None and told.tip[0] == known.tip[0]
    np.testing.assert_allclose(told.tip[1], known.tip[1], atol=1e-12)


def falling_slide(name: str) -> Scene:
    scene = Scene(name="slide")
    scene.add_body(name="box", mass=1.0, inertia=(1.0, 1.0, 1.0))
    scene.add_joint(kind="prismatic", name=name, first="ground", second="box")
    scene.record_coordinate(joint=name)
    return scene


@pytest.mark.parametrize("name", ["A", "main_cylinder"])
def test_a_name_is_no_role(name: str, tmp_path: Path) -> None:
    scene = falling_slide(name)
    scene.save(tmp_path / "slide.json")
    for one in (scene, Scene.load(tmp_path / "slide.json")):
        result = simulate(one, t_end=1.0)
        assert not {"slew_angle", "stroke"} & set(result)
        assert result["coordinate"][-1, 0] == pytest.approx(-0.5 * 9.80665)


@pytest.mark.warns("FreeCraneWarning")
def test_roles_of_a_crane_by_hand() -> None:
    scene = falling_slide("hoist")
    with pytest.raises(SceneError, match="crane: its cylinder 'lift' is joint 'lost', which is not in"):
        scene.add_roles(cylinders={"lift": "lost"})
    with pytest.raises(SceneError, match="crane: link 'hoist' is a prismatic joint; give a distance joint"):
        scene.add_roles(link="hoist")
    scene.add_roles(cylinders={"lift": "hoist"})
    result = simulate(scene, t_end=0.5)
    np.testing.assert_array_equal(result.select("stroke", cylinder="lift"), result["coordinate"][:, 0])
    with pytest.raises(SceneError, match="prefix '' is used twice"):
        scene.add_roles(cylinders={"lift": "hoist"})
