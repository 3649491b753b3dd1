"""A crane that nothing acts on is held where it is described, unless it is said to be free."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest

from seacrane import Curve, Scene, SceneError, simulate
from seacrane.crane import Payload, load_crane, shipped_cranes
from seacrane.description.holding import with_holds
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


@pytest.mark.parametrize("name", shipped_cranes())
def test_of_every_shipped_crane_the_same_drives_are_held_as_by_held(name: str) -> None:
    found = []
    for held in (None, True):
        scene = Scene()
        scene.add_crane(load_crane(name), base="ground", held=held)
        found.append({(one.joint, one.coordinate) for one in with_holds(scene).drivers.values()})
    assert found[0] == found[1] and found[0]


HELD = "held where described, as nothing acts on them"


def test_a_crane_that_nothing_acts_on_is_held_as_by_drivers_and_the_report_says_so() -> None:
    scene = crane(payload_mass=20e3)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = simulate(scene, t_end=2.0)
        led = simulate(crane(payload_mass=20e3, held=True), t_end=2.0)
    assert list(result.channels) == list(led.channels)
    for name in result:
        np.testing.assert_array_equal(result[name], led[name])
    told = dict(scene.report()["elements"])[HELD]
    assert told == ["slew drive (A)", "main (main_cylinder)", "knuckle (knuckle_cylinder)"]
    assert not scene.drivers  # a scene is not changed by being compiled
    assert scene.add_driver("slew", curve=Curve.table([0, 3], [0, 0.1])).name == "A.angle"
    assert dict(scene.report()["elements"])[HELD] == told[1:]
    (joint,) = {one.joint for one in with_holds(scene).drivers.values()} - set(
        scene.roles[""].cylinders.values()
    )
    assert joint == "A" and len(with_holds(scene).drivers) == 3
    actuator = scene.add_actuator("main", stiffness=1e8)
    assert (actuator.joint, actuator.coordinate) == ("main_cylinder", "displacement")
    with pytest.raises(SceneError, match="no joint 'telescope'"):
        scene.add_driver("telescope", curve=0.0)


def test_a_crane_that_is_free_is_told_of_and_a_spring_holds_but_friction_does_not(tmp_path: Path) -> None:
    scene = crane(held=False)
    with pytest.warns(
        FreeCraneWarning, match=r"^crane: .* \(joint 'A'\), main .*'main_cylinder'.*held=False"
    ):
        simulate(scene, t_end=0.1)
    scene.save(tmp_path / "scene.json")
    again = Scene.load(tmp_path / "scene.json")
    assert again == scene and again.roles[""].held is False
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
