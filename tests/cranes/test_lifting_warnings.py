"""Warnings about the load of a crane: at the limit, beyond it, and with the numbers that a reader checks."""

from __future__ import annotations

import re
import warnings
from dataclasses import replace

import numpy as np
import pytest
from test_summary import pendulum

from seacrane import Curve, Scene, simulate, statics
from seacrane.crane import Payload
from seacrane.hydro import shipped_database
from seacrane.warnings import LargeSwingWarning, LoadInHullWarning, OverloadWarning


def told(scene: Scene, t_end: float, **settings: object) -> dict[type[Warning], str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        simulate(scene, t_end=t_end, **settings)  # type: ignore[arg-type]
    return {one.category: str(one.message) for one in caught}


@pytest.mark.parametrize(("angle", "warned"), [(19.9, False), (20.1, True)])
def test_a_swing_beyond_20_deg_warns_on_a_rod_or_on_a_line(angle: float, warned: bool) -> None:
    found = told(pendulum(angle=np.radians(angle)), 5.0)
    assert (LargeSwingWarning in found) == warned
    if warned:
        assert "'load' swings 20.1 deg from vertical at t = 0 s" in found[LargeSwingWarning]
        assert f"a pendulum of {2.0 * np.pi * np.sqrt(5.0 / 9.80665):.3g} s" in found[LargeSwingWarning]
    scene, speed = Scene(name="hook"), np.sqrt(2.0 * 9.80665 * 9.0 * (1.0 - np.cos(np.radians(angle))))
    scene.add_body("load", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0, 0, -9), velocity=(speed, 0, 0))
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=1e8, length=8.9991)
    found = told(scene, 3.0)
    assert (LargeSwingWarning in found) == warned
    assert not warned or "line 'wire': 'load' swings" in found[LargeSwingWarning]


@pytest.mark.parametrize("scale", [0.99, 1.01])
def test_a_load_above_the_table_at_the_radius_where_it_comes_to_hang_warns(scale: float) -> None:
    """The tip comes in while the knuckle cylinder retracts: the largest radius is that of the start."""
    scene = Scene(name="quay")
    roles = scene.add_crane(base="ground", s1=1.0, s2=1.5, payload=Payload(mass=20e3))
    lower = Curve.quintic(start_time=0.0, end_time=8.0, start=0.0, end=-0.8)
    scene.add_driver(joint="knuckle_cylinder", curve=lower)
    radius = statics(scene)["tip radius"].item()
    table = ((10.0, 60e3), (radius, scale * 20e3), (radius + 5.0, 10e3))
    scene.roles[""] = replace(roles, capacity=table)
    found = told(scene, 10.0)
    assert (OverloadWarning in found) == (scale < 1.0)
    if scale < 1.0:
        words = found[OverloadWarning]
        assert "of 20 t, with what holds it, is above the 19.8 t" in words and "at t = 0 s" in words
        assert float(re.search(r"radius of (\S+) m", words)[1]) == pytest.approx(radius, abs=0.01)  # type: ignore[index]
        scene.roles[""] = replace(roles, capacity=((5.0, 60e3), (10.0, 40e3)))
        assert "above the 0 t of the crane's table" in told(scene, 0.2)[OverloadWarning]


@pytest.mark.parametrize(
    ("link", "slew", "heading_deg", "warned"),
    [
        (10.4, 0.0, 0.0, False), (11.0, 0.0, 75.0, True), (60.0, 0.0, 0.0, False),
        (20.0, -np.pi / 2, 0.0, False),
    ],
)  # fmt: skip
def test_a_load_that_starts_in_the_hull_warns(
    link: float, slew: float, heading_deg: float, warned: bool
) -> None:
    """The deck is where the crane's foot is, 10 m above the water; the keel some 7 m below it."""
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), memory="none", heading_deg=heading_deg)
    scene.add_crane(slew=slew, payload=Payload(mass=20e3, link_length=link))
    scene.add_ballast()
    found = told(scene, 0.2)
    assert (LoadInHullWarning in found) == warned
    if warned:
        edge = re.search(r"its lower edge is at (\S+) m", found[LoadInHullWarning])
        assert edge and float(edge[1]) == pytest.approx(20.427 - link, abs=0.001)
        assert "below the deck at 10 m" in found[LoadInHullWarning]
