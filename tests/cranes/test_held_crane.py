"""A crane that nothing acts on is held where it is described, unless it is said to be free."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest

from seacrane import Curve, Scene, SceneError, equilibrium, simulate, statics
from seacrane.crane import Payload, load_crane, shipped_cranes
from seacrane.description.file import scene_digest
from seacrane.description.holding import with_holds
from seacrane.hydro import shipped_database
from seacrane.warnings import FreeCraneWarning


def crane(*, prefix: str = "", **given: object) -> Scene:
    scene = Scene(name="quay")
    scene.add_crane(base="ground", slew=-1.0, s1=1.0, s2=2.0, prefix=prefix, **given)  # type: ignore[arg-type]
    return scene


@pytest.mark.parametrize("prefix", ["", "aft "])
def test_a_held_crane_stays_where_it_is_described(prefix: str) -> None:
    scene = crane(held=True, payload=Payload(mass=20e3), prefix=prefix)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = simulate(scene, t_end=5.0)
    assert np.abs(result["tip_velocity"]).max() < 1e-9
    assert result["link_tension"] == pytest.approx(20e3 * scene.gravity, rel=1e-6)


def test_it_is_the_loop_over_its_joints() -> None:
    by_hand = crane()
    roles = by_hand.roles[""]
    for joint in (roles.slew[0], *roles.cylinders.values()):
        by_hand.add_driver(joint=joint, curve=0.0)
    assert crane(held=True) == by_hand


def test_a_crane_that_nothing_acts_on_is_held_as_by_drivers_and_the_report_says_so() -> None:
    scene = crane(payload_mass=20e3)
    assert not scene.drivers
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = simulate(scene, t_end=2.0)
        led = simulate(crane(payload_mass=20e3, held=True), t_end=2.0)
    assert list(result.channels) == list(led.channels)
    for name in result:
        np.testing.assert_array_equal(result[name], led[name])
    told = dict(scene.report()["elements"])["held where described, as nothing acts on them"]
    assert told == ["slew drive (A)", "main (main_cylinder)", "knuckle (knuckle_cylinder)"]
    assert not scene.drivers  # a scene is not changed by being compiled


def test_what_acts_on_a_joint_when_the_scene_is_compiled_is_not_held() -> None:
    scene = crane()
    swing = Curve.quintic(start_time=0.0, end_time=2.0, start=0.0, end=0.1)
    scene.add_driver("A", curve=swing)
    result = simulate(scene, t_end=3.0)
    turn = result.scene.drivers["A.angle"].curve.evaluate([3.0])[0, 0]  # type: ignore[union-attr]
    assert turn == pytest.approx(0.1) and set(result.scene.drivers) == {  # type: ignore[union-attr]
        "A.angle", "main_cylinder.displacement", "knuckle_cylinder.displacement",
    }  # fmt: skip
    told = dict(scene.report()["elements"])["held where described, as nothing acts on them"]
    assert told == ["main (main_cylinder)", "knuckle (knuckle_cylinder)"]


@pytest.mark.parametrize("name", shipped_cranes())
def test_of_every_shipped_crane_the_same_drives_are_held_as_by_held(name: str) -> None:
    found = []
    for held in (None, True):
        scene = Scene()
        scene.add_crane(load_crane(name), base="ground", held=held)
        found.append({(one.joint, one.coordinate) for one in with_holds(scene).drivers.values()})
    assert found[0] == found[1] and found[0]


def test_statics_of_a_held_crane_are_those_of_one_that_drivers_hold() -> None:
    tables = []
    for given in ({}, {"held": True}):
        scene = Scene()
        scene.add_vessel(shipped_database())
        scene.add_crane(payload_mass=20e3, slew=-1.5, **given)  # type: ignore[arg-type]
        tables.append(str(statics(scene)))
    assert tables[0] == tables[1]


def test_a_crane_that_is_free_is_told_of() -> None:
    told = r"^crane: nothing holds slew drive \(joint 'A'\), main \(joint 'main_cylinder'\), .*held=False"
    with pytest.warns(FreeCraneWarning, match=told):
        simulate(crane(held=False), t_end=0.1)


@pytest.mark.parametrize("held", [True, False])
def test_files_say_whether_a_crane_is_held(held: bool, tmp_path: Path) -> None:
    scene = crane(held=held)
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json") == scene
    assert Scene.load(tmp_path / "scene.json").roles[""].held == held


def test_a_crane_that_is_driven_has_one_digest_held_or_not() -> None:
    driven, free = crane(held=True), crane(held=False)
    for driver in driven.drivers.values():
        free.add_driver(driver.joint, curve=driver.curve)
    assert scene_digest(driven) == scene_digest(free)
    assert scene_digest(crane()) != scene_digest(crane(held=False))


def test_each_crane_and_joint_is_told_apart() -> None:
    scene = crane(held=True)
    scene.add_crane(base="ground", foot=(50.0, 0.0, 0.0), s1=1.0, s2=2.0, prefix="aft ", held=False)
    scene.add_actuator(joint="aft A", stiffness=1e7, damping=1e7)
    scene.add_driver(joint="aft main_cylinder", curve=0.0)
    with pytest.warns(FreeCraneWarning, match=r"^crane 'aft ': nothing holds knuckle \(joint 'aft knuckle_c"):
        simulate(scene, t_end=0.1)


def test_a_spring_beside_a_cylinder_holds_it_and_friction_does_not() -> None:
    scene = crane(held=False)
    for name in ("A", "knuckle_cylinder"):
        scene.add_driver(name, curve=0.0)
    joint = scene.joints["main_cylinder"]
    scene.add_friction(joint="main_cylinder", load=1e3, speed=0.01)
    with pytest.warns(FreeCraneWarning, match="nothing holds main"):
        simulate(scene, t_end=0.01)
    scene.add_spring(name="prop", first=joint.first, second=joint.second, stiffness=1e8, natural_length=1.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error", FreeCraneWarning)
        simulate(scene, t_end=0.01)


def test_the_mass_of_a_payload_stands_in_one_place() -> None:
    assert crane(payload_mass=20e3) == crane(payload=Payload(mass=20e3))
    with pytest.raises(SceneError, match="payload and payload_mass are given; put the mass into the Payload"):
        crane(payload_mass=20e3, payload=Payload())


def test_a_run_that_goes_on_and_one_without_a_crane_s_joint_are_not_judged() -> None:
    scene = crane(held=True, payload=Payload(mass=20e3))
    start = equilibrium(scene)
    with warnings.catch_warnings():
        warnings.simplefilter("error", FreeCraneWarning)
        simulate(scene, t_end=0.1, start=start)


def test_drives_are_driven_by_what_the_crane_calls_them() -> None:
    scene = crane()
    assert scene.add_driver("slew", curve=0.0).name == "A.angle"
    actuator = scene.add_actuator("main", stiffness=1e8)
    assert (actuator.joint, actuator.coordinate) == ("main_cylinder", "displacement")
    with pytest.raises(SceneError, match="there is no joint 'telescope'"):
        scene.add_driver("telescope", curve=0.0)
