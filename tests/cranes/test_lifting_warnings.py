"""Cranes and their loads told of: swings, tables, hulls, seats passed through, and cranes that none holds."""

from __future__ import annotations

import re
import warnings
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from test_summary import pendulum

from seacrane import Curve, Result, Scene, simulate, statics
from seacrane.crane import Payload, load_crane, shipped_cranes
from seacrane.description.holding import with_holds
from seacrane.hydro import shipped_database
from seacrane.warnings import FreeCraneWarning, LargeSwingWarning, LoadInHullWarning, OverloadWarning


def told(scene: Scene, t_end: float, **settings: object) -> dict[type[Warning], str]:
    with warnings.catch_warnings(record=True, action="always") as caught:
        simulate(scene, t_end=t_end, **settings)  # type: ignore[arg-type]
    return {one.category: str(one.message) for one in caught}


@pytest.mark.parametrize(("angle", "warned"), [(19.9, False), (20.1, True)])
def test_a_swing_beyond_20_deg_warns_on_a_rod_or_on_a_line(angle: float, warned: bool) -> None:
    found = told(pendulum(angle=np.radians(angle)), 5.0)
    assert (LargeSwingWarning in found) == warned
    if warned:
        assert "'load' swings 20.1 deg from vertical at t = 0 s" in found[LargeSwingWarning]
    scene, speed = Scene(name="hook"), np.sqrt(2.0 * 9.80665 * 9.0 * (1.0 - np.cos(np.radians(angle))))
    scene.add_body("load", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0, 0, -9), velocity=(speed, 0, 0))
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=1e8, length=8.9991)
    found = told(scene, 3.0)
    assert (LargeSwingWarning in found) == warned


@pytest.mark.parametrize("scale", [0.99, 1.01])
def test_a_load_above_the_table_at_the_radius_where_it_comes_to_hang_warns(scale: float) -> None:
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
        assert "of 20 t, with what holds it, is above the 19.8 t" in found[OverloadWarning]
        scene.roles[""] = replace(roles, capacity=((5.0, 60e3), (10.0, 40e3)))
        assert "above the 0 t of the crane's table" in told(scene, 0.2)[OverloadWarning]


@pytest.mark.parametrize(
    ("link", "slew", "heading_deg", "warned"),
    [(10.4, 0.0, 0.0, False), (11.0, 0.0, 75.0, True), (20.0, -np.pi / 2, 0.0, False)],
)
def test_a_load_that_starts_in_the_hull_warns(
    link: float, slew: float, heading_deg: float, warned: bool
) -> None:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), memory="none", heading_deg=heading_deg)
    scene.add_crane(slew=slew, payload=Payload(mass=20e3, link_length=link))
    scene.add_ballast()
    found = told(scene, 0.2)
    assert (LoadInHullWarning in found) == warned
    if warned:
        edge = re.search(r"its lower edge is at (\S+) m", found[LoadInHullWarning])
        assert edge and float(edge[1]) == pytest.approx(20.427 - link, abs=0.001)


def through_seat(rate: float = -0.05, aside: float = 0.0) -> Scene:
    """A load of 5.4 m across on a barge that heaves, hauled up by a winch; `aside`: N that draw it away."""
    scene = Scene(name="re-hit")
    scene.add_body(name="barge", mass=1e6, inertia=(1e8,) * 3)
    scene.add_joint(kind="prismatic", name="heave", first="ground", second="barge", axis=(0, 0, 1))
    scene.add_driver(joint="heave", curve=Curve.harmonic(amplitude=0.8, omega=0.8, phase=-np.pi / 2))
    scene.add_body(name="load", mass=30e3, inertia=(5e4,) * 3, position=(0, 0, 2.0))
    scene.add_joint(kind="weld", name="on deck", first="barge", second="load")
    scene.add_stop(joint="on deck")
    hoist = {"points": [(0, 0, 40.0), (0, 0, 0)], "EA": 1e8, "length": 38.1}
    scene.add_line(name="hoist", bodies=["ground", "load"], **hoist)
    scene.add_winch(line="hoist", lag=0.2, rate=rate)
    if aside:
        scene.add_force("load", name="tug", force=(aside, 0, 0))
    return scene


@pytest.mark.filterwarnings("ignore")
def test_each_passage_through_a_seat_is_an_event_where_the_load_passes_told_once() -> None:
    def passages(result: Result) -> list[float]:
        return [event.time for event in result.events if event.kind == "through"]

    def gap(result: Result) -> NDArray[np.float64]:
        load, barge = (result.select("position", body=name, axis="z") for name in ("load", "barge"))
        return np.asarray(load - barge - 2.0)

    how = {"t_end": 20.0, "dt_out": 0.01}
    assert passages(simulate(through_seat(rate=-1.0), **how)) == []  # fast enough
    beside = simulate(through_seat(aside=2e4), 12.0, dt_out=0.1)
    away = beside.select("position", body="load", axis="x")[gap(beside) < -0.1]
    assert away.size and away.min() > 4.0 and passages(beside) == []
    for form, step in (("redundant", {"integrator": "rk4", "dt": 0.01}), ("recursive", {"rtol": 1e-6})):
        result = simulate(through_seat(), formulation=form, **step, **how)
        over = gap(result) + 1e-3
        left = result.time > next(event.time for event in result.events if event.kind == "release")
        passed = np.flatnonzero((over[:-1] >= 0.0) & (over[1:] < 0.0) & left[1:])
        times = passages(result)
        assert len(times) == passed.size >= 2
        assert np.all(np.abs(np.array(times) - result.time[passed] - 0.005) <= 0.005 + 1e-9)
    first = simulate(through_seat(), 0.5 * (times[0] + times[1]), rtol=1e-6)
    second = simulate(through_seat(), start=first.state, rtol=1e-6, **how)
    np.testing.assert_allclose([*passages(first), *passages(second)], times, atol=1e-6)


def crane(**given: object) -> Scene:
    scene = Scene(name="quay")
    scene.add_crane(base="ground", slew=-1.0, s1=1.0, s2=2.0, **given)  # type: ignore[arg-type]
    return scene


@pytest.mark.parametrize("name", shipped_cranes())
def test_of_every_shipped_crane_the_same_drives_are_held_as_by_held(name: str) -> None:
    found = []
    for held in (None, True):
        scene = Scene()
        scene.add_crane(load_crane(name), base="ground", held=held)
        found.append({(one.joint, one.coordinate) for one in with_holds(scene).drivers.values()})
    assert found[0] == found[1] and found[0]


def test_a_crane_that_nothing_acts_on_is_held_as_by_drivers() -> None:
    scene = crane(payload_mass=20e3)
    result = simulate(scene, t_end=2.0)
    led = simulate(crane(payload_mass=20e3, held=True), t_end=2.0)
    assert list(result.channels) == list(led.channels)
    for name in result:
        np.testing.assert_array_equal(result[name], led[name])
    assert not scene.drivers  # a scene is not changed by being compiled
    scene.add_driver("slew", curve=Curve.table([0, 3], [0, 0.1]))
    holds = {one.joint for one in with_holds(scene).drivers.values()}
    assert holds == {"A", "main_cylinder", "knuckle_cylinder"} and len(with_holds(scene).drivers) == 3


def test_a_crane_that_is_free_is_told_of_and_a_spring_holds_but_friction_does_not() -> None:
    scene = crane(held=False)
    with pytest.warns(
        FreeCraneWarning, match=r"^crane: .* \(joint 'A'\), main .*'main_cylinder'.*held=False"
    ):
        simulate(scene, t_end=0.1)
    for name in ("A", "knuckle_cylinder"):
        scene.add_driver(name, curve=0.0)
    joint = scene.joints["main_cylinder"]
    scene.add_friction(joint="main_cylinder", load=1e3, speed=0.01)
    with pytest.warns(FreeCraneWarning, match="nothing holds main"):
        simulate(scene, t_end=0.01)
    scene.add_spring(name="prop", first=joint.first, second=joint.second, stiffness=1e8, natural_length=1.0)
    simulate(scene, t_end=0.01)
