"""Warnings about the load of a crane: at the limit, beyond it, and with the numbers that a reader checks."""

from __future__ import annotations

import re
import warnings

import numpy as np
import pytest
from test_summary import pendulum

from seacrane import Curve, Scene, simulate, statics
from seacrane.crane import Payload
from seacrane.hydro import shipped_database
from seacrane.warnings import LargeSwingWarning, LoadInHullWarning, OverloadWarning

JOINTS = ("A", "main_cylinder", "knuckle_cylinder")


def told(scene: Scene, t_end: float, **settings: object) -> dict[type[Warning], str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        simulate(scene, t_end=t_end, **settings)  # type: ignore[arg-type]
    return {one.category: str(one.message) for one in caught}


@pytest.mark.parametrize(("angle", "warned"), [(19.9, False), (20.1, True)])
def test_a_swing_beyond_20_deg_warns(angle: float, warned: bool) -> None:
    found = told(pendulum(angle=np.radians(angle)), 5.0)
    assert (LargeSwingWarning in found) == warned
    if warned:
        assert "'load' swings 20.1 deg from vertical at t = 0 s" in found[LargeSwingWarning]
        assert f"a pendulum of {2.0 * np.pi * np.sqrt(5.0 / 9.80665):.3g} s" in found[LargeSwingWarning]


@pytest.mark.parametrize(("speed", "warned"), [(3.0, False), (3.4, True)])
def test_a_swing_on_a_line_beyond_20_deg_warns(speed: float, warned: bool) -> None:
    """v^2 = 2 g L (1 - cos 20 deg) at 3.26 m/s."""
    scene = Scene(name="hook")
    scene.add_body(
        name="load", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0, 0, -9), velocity=(speed, 0, 0)
    )
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=1e8, length=8.9991)
    found = told(scene, 3.0)
    assert (LargeSwingWarning in found) == warned
    assert not warned or "line 'wire': 'load' swings" in found[LargeSwingWarning]


@pytest.mark.parametrize("second", ["tugger", "joint"])
def test_a_line_that_does_not_alone_hold_its_body_is_not_judged(second: str) -> None:
    scene = Scene(name="held")
    scene.add_body(name="load", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0, 0, -9), velocity=(4.0, 0, 0))
    wire = {"points": np.zeros((2, 3)), "bodies": ["ground", "load"], "EA": 1e7}
    scene.add_line(name="wire", length=8.99, **wire)  # type: ignore[arg-type]
    if second == "tugger":
        wire = wire | {"points": [(20.0, 0.0, -9.0), (0.0, 0.0, 0.0)]}
        scene.add_line(name="tugger", length=19.9, **wire)  # type: ignore[arg-type]
    else:
        scene.add_joint(kind="planar", name="plane", first="ground", second="load", axis=(0, 1, 0))
    assert LargeSwingWarning not in told(scene, 3.0)


def test_a_swing_without_poses_is_not_judged() -> None:
    assert not told(pendulum(angle=0.5), 2.0, channels=["tension"])


def crane(*, mass: float = 20e3, capacity: object = ()) -> Scene:
    scene = Scene(name="quay")
    roles = scene.add_crane(base="ground", s1=1.0, s2=1.5, payload=Payload(mass=mass))
    del scene.roles[""]
    scene.add_roles(
        slew=roles.slew, cylinders=roles.cylinders, link=roles.link, payload=roles.payload, capacity=capacity
    )
    scene.add_driver(joint="A", curve=Curve.constant(value=0.0))
    lower = Curve.quintic(start_time=0.0, end_time=8.0, start=0.0, end=-0.8)
    scene.add_driver(joint="main_cylinder", curve=Curve.constant(value=0.0))
    scene.add_driver(joint="knuckle_cylinder", curve=lower.then(time=8.0, curve=Curve.constant(value=-0.8)))
    return scene


def test_a_load_above_the_table_at_the_radius_where_it_comes_to_hang_warns() -> None:
    """The tip comes in while the knuckle cylinder retracts: the largest radius is that of the start."""
    radius = statics(crane())["tip radius"].item()
    table = [(10.0, 60e3), (radius, 19.9e3), (radius + 5.0, 10e3)]
    words = told(crane(capacity=table), 10.0)[OverloadWarning]
    assert "of 20 t, with what holds it, is above the 19.9 t of the crane's table" in words
    assert float(re.search(r"radius of (\S+) m", words)[1]) == pytest.approx(radius, abs=0.01)  # type: ignore[index]
    assert "at t = 0 s" in words
    enough = [(10.0, 60e3), (radius, 20.1e3), (radius + 5.0, 10e3)]
    assert OverloadWarning not in told(crane(capacity=enough), 10.0)


def test_a_load_beyond_the_last_radius_of_the_table_warns() -> None:
    words = told(crane(capacity=[(5.0, 60e3), (10.0, 40e3)]), 0.2)[OverloadWarning]
    assert "above the 0 t of the crane's table" in words


@pytest.mark.parametrize("heading_deg", [0.0, 75.0])
@pytest.mark.parametrize(
    ("link", "warned"), [(8.0, False), (10.4, False), (11.0, True), (20.0, True), (60.0, False)]
)
def test_a_load_that_starts_in_the_hull_warns(link: float, warned: bool, heading_deg: float) -> None:
    """The deck is where the crane's foot is, 10 m above the water; the keel some 7 m below it."""
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), memory="none", heading_deg=heading_deg)
    scene.add_crane(payload=Payload(mass=20e3, link_length=link))
    scene.add_ballast()
    for joint in JOINTS:
        scene.add_driver(joint=joint, curve=Curve.constant(value=0.0))
    found = told(scene, 0.2)
    assert (LoadInHullWarning in found) == warned
    if warned:
        edge = re.search(r"its lower edge is at (\S+) m", found[LoadInHullWarning])
        assert edge and float(edge[1]) == pytest.approx(20.427 - link, abs=0.001)
        assert "below the deck at 10 m" in found[LoadInHullWarning]


def test_a_load_over_the_side_is_not_in_the_hull() -> None:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_crane(slew=-np.pi / 2, payload=Payload(mass=20e3, link_length=20.0))
    scene.add_ballast()
    for joint in JOINTS:
        scene.add_driver(joint=joint, curve=Curve.constant(value=0.0))
    assert LoadInHullWarning not in told(scene, 0.2)
