"""Cranes and their loads told of: swings, tables, hulls, seats passed through, and cranes that none holds."""

from __future__ import annotations

import re
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from test_summary import pendulum

import seacrane
from seacrane import Curve, Result, Scene, SceneError, simulate, statics
from seacrane.crane import Payload, load_crane, shipped_cranes
from seacrane.description.holding import with_holds
from seacrane.hydro import shipped_database
from seacrane.warnings import (
    FreeCraneWarning,
    LargeSwingWarning,
    LoadInHullWarning,
    OverloadWarning,
    ThroughSeatWarning,
)


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


HEAVE, OMEGA, DECK = 0.8, 0.8, 2.0
INERTIA = 5e4  # of 30 t: half a diagonal of 2.7 m


def lifted(rate: float = -0.05, heave: float = HEAVE, aside: float = 0.0) -> Scene:
    """A load on a barge that heaves, hauled up by a winch; `aside`: N that draw it off the deck."""
    scene = Scene(name="re-hit")
    scene.add_body(name="barge", mass=1e6, inertia=(1e8,) * 3)
    scene.add_joint(kind="prismatic", name="heave", first="ground", second="barge", axis=(0, 0, 1))
    wave = Curve.harmonic(start_time=0.0, offset=0.0, amplitude=heave, omega=OMEGA, phase=-np.pi / 2)
    scene.add_driver(joint="heave", curve=wave)
    scene.add_body(name="load", mass=30e3, inertia=(INERTIA,) * 3, position=(0, 0, DECK))
    scene.add_joint(kind="weld", name="on deck", first="barge", second="load")
    scene.add_seat(joint="on deck")
    scene.add_line(name="hoist", bodies=["ground", "load"], points=[(0, 0, 40.0), (0, 0, 0)], EA=1e8,
                   length=38.1)  # fmt: skip
    scene.add_winch(line="hoist", lag=0.2, rate=rate)
    if aside:
        scene.add_point_force(name="tug", body="load", force=(aside, 0, 0))
    return scene


def run(scene: Scene, **options: object) -> Result:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return simulate(scene, **{"t_end": 20.0, "dt_out": 0.01} | options)


def height(result: Result) -> np.ndarray:
    rise = result.select("position", body="load", axis="z") - result.select(
        "position", body="barge", axis="z"
    )
    return np.asarray(rise) - DECK


def through(result: Result) -> list[float]:
    return [event.time for event in result.events if event.kind == "through"]


@pytest.mark.parametrize("integrator", ["dopri5", "rk4", "cvode-bdf"])
@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_each_passage_is_an_event_where_the_load_passes(integrator: str, formulation: str) -> None:
    step = {"dt": 0.01} if integrator == "rk4" else {"rtol": 1e-6}
    result = run(lifted(), integrator=integrator, formulation=formulation, **step)
    gap = height(result) + 1e-3
    left = result.time > next(event.time for event in result.events if event.kind == "release")
    passed = np.flatnonzero((gap[:-1] >= 0.0) & (gap[1:] < 0.0) & left[1:])
    times = through(result)
    assert len(times) == passed.size >= 2
    for at, time in zip(passed, times, strict=True):
        assert result.time[at] - 1e-9 <= time <= result.time[at + 1] + 1e-9


def test_beside_the_seat_nothing_is_told() -> None:
    """The load is drawn aside by more than its own size before it sinks below the deck's height."""
    result = run(lifted(aside=2e4), t_end=12.0)
    away = np.hypot(*(result.select("position", body="load", axis=axis) for axis in "xy"))
    under = height(result) < -0.1
    assert under.any() and away[under].min() > 4.0
    assert through(result) == []


def test_a_run_that_goes_on_tells_each_passage_once() -> None:
    assert through(run(lifted(rate=-1.0))) == []  # fast enough
    with pytest.warns(ThroughSeatWarning, match=r"seat 'on deck'.*'load' .*at t = [0-9.]+ s"):
        result = simulate(lifted(), t_end=20.0, dt_out=0.01)
    whole = through(result)
    assert "through it" in seacrane.report(result).html
    cut = 0.5 * (whole[0] + whole[1])
    first = run(lifted(), t_end=cut)
    second = run(lifted(), start=first.state)
    assert len(through(first)) == 1
    np.testing.assert_allclose([*through(first), *through(second)], whole, atol=1e-6)


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
