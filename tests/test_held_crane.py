"""A crane is held in its pose by one word, and one that nothing holds is told of."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from seacrane import Scene, equilibrium, simulate
from seacrane.crane import Payload
from seacrane.warnings import FreeCraneWarning


def crane(*, prefix: str = "", **given: object) -> Scene:
    scene = Scene(name="quay")
    scene.add_crane(base="ground", theta=-1.0, s1=1.0, s2=2.0, prefix=prefix, **given)  # type: ignore[arg-type]
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


def test_a_crane_that_nothing_holds_is_told_of() -> None:
    told = r"^crane: nothing holds slew drive \(joint 'A'\), main \(joint 'main_cylinder'\), .*held=True"
    with pytest.warns(FreeCraneWarning, match=told):
        simulate(crane(), t_end=0.1)


def test_each_crane_and_joint_is_told_apart() -> None:
    scene = crane(held=True)
    scene.add_crane(base="ground", foot=(50.0, 0.0, 0.0), s1=1.0, s2=2.0, prefix="aft ")
    scene.add_actuator(joint="aft A", stiffness=1e7, damping=1e7)
    scene.add_driver(joint="aft main_cylinder", curve=0.0)
    with pytest.warns(FreeCraneWarning, match=r"^crane 'aft ': nothing holds knuckle \(joint 'aft knuckle_c"):
        simulate(scene, t_end=0.1)


def test_a_spring_beside_a_cylinder_holds_it_and_friction_does_not() -> None:
    scene = crane(held=True)
    scene.remove("main_cylinder.displacement")
    joint = scene.joints["main_cylinder"]
    scene.add_friction(joint="main_cylinder", load=1e3, speed=0.01)
    with pytest.warns(FreeCraneWarning, match="nothing holds main"):
        simulate(scene, t_end=0.01)
    scene.add_spring(name="prop", first=joint.first, second=joint.second, stiffness=1e8, natural_length=1.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error", FreeCraneWarning)
        simulate(scene, t_end=0.01)


def test_a_run_that_goes_on_and_one_without_a_crane_s_joint_are_not_judged() -> None:
    scene = crane(held=True, payload=Payload(mass=20e3))
    start = equilibrium(scene)
    with warnings.catch_warnings():
        warnings.simplefilter("error", FreeCraneWarning)
        simulate(scene, t_end=0.1, start=start)
