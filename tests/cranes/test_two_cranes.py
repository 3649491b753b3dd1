"""Roles of a crane's parts: who writes them, what reads them, and two cranes in one scene."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Curve, Result, Scene, SceneError, balance, cases, simulate
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
        one, other = (run.select("position", body=body) for run in (both, alone))
        np.testing.assert_allclose(one, other, atol=1e-9)
    for channel, dim, labels, scale in (
        ("stroke", "cylinder", ("main", "knuckle"), 1e-9),
        ("stroke_rate", "cylinder", ("main", "knuckle"), 1e-9),
        ("cylinder_force", "cylinder", ("main", "knuckle"), 1e-2), ("slew_angle", "slew", ("slew",), 1e-9),
        ("slew_torque", "slew", ("slew",), 1e-2), ("link_tension", "hook", ("hook",), 1e-3),
    ):  # fmt: skip
        for label in labels:
            one = both.select(channel, **{dim: prefix + label})
            single = len(labels) == 1
            other = alone[channel] if single else alone.select(channel, **{dim: prefix + label})
            assert not single or alone.dims[channel] == ("time",)
            np.testing.assert_allclose(one, other, atol=scale)
    assert alone["stroke"][-1, 0] == pytest.approx(ENDS[prefix][1], rel=0.2)


def test_two_cranes_are_told_apart_in_files_too(both: Result, tmp_path: Path) -> None:
    again = Result.load(both.save(tmp_path / "both.nc"))
    for result in (both, again):
        assert result.coords["cylinder"] == ("main", "knuckle", "aft main", "aft knuckle")
        assert result.coords["slew"] == ("slew", "aft slew") and result.coords["hook"] == ("hook", "aft hook")
        assert result.dims["slew_angle"] == ("time", "slew")
    np.testing.assert_array_equal(again["slew_angle"], both["slew_angle"])
    scene = cranes("", "aft ")
    scene.save(tmp_path / "two.json")
    back = Scene.load(tmp_path / "two.json")
    assert back == scene and dict(back.roles) == dict(scene.roles)
    aft = back.roles["aft "]
    assert aft.payload == "aft payload" and aft.cylinders["knuckle"] == "aft knuckle_cylinder"
    with pytest.raises(SceneError, match="there is one with prefix ''"):
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


@pytest.mark.warns("FreeCraneWarning")
def test_roles_of_a_crane_by_hand() -> None:
    for name in ("A", "main_cylinder"):  # a name is no role
        assert not {"slew_angle", "stroke"} & set(simulate(falling_slide(name), t_end=1.0))
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
