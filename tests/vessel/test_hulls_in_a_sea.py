"""Several hulls in one sea, each where it is: as the hull alone, and as at the origin of a moved sea."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
import pytest

from seacrane import FlowCoefficients, Result, Scene, SceneError, balance, linear_model, simulate
from seacrane.analysis import response_summed
from seacrane.analysis.inverse import SIX, hold_vessel
from seacrane.crane import Payload
from seacrane.description.curves import spline_curve
from seacrane.description.waves import calm_water
from seacrane.hydro import DriftCoefficients, HydroDatabase, shipped_database
from seacrane.inputs.frames import rotation_about_z
from seacrane.scene import HullLoads, Waves

G = 9.80665
STEPS: dict[str, Any] = {"integrator": "rk4", "dt": 0.1}  # the same for every scene, so that runs compare
CHANNELS = ("vessel_motion", "wave_force", "drift_force", "wave_elevation")


@lru_cache(maxsize=1)
def database() -> HydroDatabase:
    """The shipped one with drift that differs at every heading."""
    heading, omega = np.linspace(0.0, np.pi, 13), np.linspace(0.2, 2.6, 25)
    along, across = -2e3 * np.cos(heading)[:, None] * omega, 6e3 * np.sin(heading)[:, None] * omega
    values = np.zeros((13, 25, 6))
    values[..., 0], values[..., 1], values[..., 5] = along, across, 0.02 * along * across
    drift = DriftCoefficients(heading=heading, omega=omega, coefficient=values)
    return replace(shipped_database(), drift=drift)


def blown(scene: Scene, name: str, direction_deg: float) -> None:
    """Wind and current on a hull, towards the same side."""
    rows = FlowCoefficients(
        angle=np.radians([0.0, 45.0, 90.0, 135.0, 180.0]), x=np.array([0.6, 0.4, 0.0, -0.4, -0.6]),
        y=np.array([0.0, 0.6, 0.8, 0.6, 0.0]), yaw=np.array([0.0, 0.05, 0.0, -0.05, 0.0]),
    )  # fmt: skip
    given = {"coefficients": rows, "body": name, "length": 115.0, "direction_deg": direction_deg}
    scene.add_wind(speed=15.0, frontal_area=700.0, lateral_area=1800.0, name=f"wind on {name}", **given)
    scene.add_current(speed=0.5, frontal_area=160.0, lateral_area=740.0, name=f"current on {name}", **given)


def same(one: Result, other: Result, *, vessel: str | None = None, tolerance: float) -> None:
    """Channels of one vessel of a result against those of a result with one vessel."""
    for name in CHANNELS:
        assert (name in one.channels) == (name in other.channels)
        if name in other.channels:
            got = one[name] if vessel is None else one.select(name, vessel=vessel)
            scale = np.abs(other[name]).max(axis=0)
            # Motions that a hull's symmetry keeps at nothing have the scale of the others.
            floor = 1e-3 * np.max(scale)
            off = np.abs(got - other[name]).max(axis=0)
            assert np.all(off <= tolerance * np.maximum(scale, floor)), name


def hulls(poses: dict[str, Any], wind_deg: float | None, sea: dict[str, Any]) -> Scene:
    scene = Scene(name="hulls")
    for name, pose in poses.items():
        scene.add_vessel(database(), name=name, position=(*pose[:2], 0.0), heading_deg=pose[2])
    for name in poses:
        scene.add_sea(vessel=name, hs=2.5, tp=8.0, count=25, **sea)
        if wind_deg is not None:
            blown(scene, name, wind_deg)
    return scene


def moved_to_the_origin(pose: Any, wind_deg: float | None, sea: dict[str, Any]) -> Scene:
    """A hull at the origin, heading along x, in the sea, wind and current that are the same to it."""
    scene = Scene(name="moved")
    scene.add_vessel(database(), name="hull")
    asked = hulls({"a": (0.0, 0.0, 0.0)}, None, sea).waves
    travel = pose[0] * np.cos(asked.direction) + pose[1] * np.sin(asked.direction)
    direction = asked.direction - np.radians(pose[2])
    scene.waves = Waves(
        omega=asked.omega, amplitude=asked.amplitude, phase=asked.phase - asked.omega**2 / G * travel,
        direction=direction,
        hulls={"hull": HullLoads(transfer=database().force_at(asked.omega, direction))},
    )  # fmt: skip
    scene.add_sea(vessel="hull", drift=sea["drift"], phase=sea["phase"])
    if wind_deg is not None:
        blown(scene, "hull", wind_deg - pose[2])
    return scene


def compare_with_single_runs(seed: int) -> None:
    random = np.random.default_rng(seed)
    sea = {
        "direction_deg": random.uniform(-180.0, 180.0),
        "spreading": float(random.choice([2.0, 8.0])) if random.random() < 0.5 else None,
        "seed": int(random.integers(1, 1000)),
        "phase": str(random.choice(["mean", "slow", "actual"])),
        "drift": bool(random.random() < 0.5),
    }
    wind = random.uniform(-180.0, 180.0) if random.random() < 0.5 else None
    poses = {
        f"hull {i}": (*random.uniform(-300.0, 300.0, 2), random.uniform(-180.0, 180.0))
        for i in range(int(random.integers(2, 4)))
    }
    together = simulate(hulls(poses, wind, sea), t_end=20.0, dt_out=0.5, **STEPS)
    assert together.coords["vessel"] == tuple(poses)
    for name, pose in poses.items():
        alone = simulate(hulls({name: pose}, wind, sea), t_end=20.0, dt_out=0.5, **STEPS)
        same(together, alone, vessel=name, tolerance=1e-7)
        # Loads from tables are within 1e-9 of the sum of all components, which is some ten times their size.
        moved = simulate(moved_to_the_origin(pose, wind, sea), t_end=20.0, dt_out=0.5, **STEPS)
        same(alone, moved, tolerance=1e-6)


NIGHT = pytest.mark.slow("hundreds of random seas")


@pytest.mark.warns(sometimes=["CompassDirectionWarning"])
@pytest.mark.parametrize("seed", [*range(6), *(pytest.param(n, marks=NIGHT) for n in range(100, 300))])
def test_hulls_together_are_as_alone_and_as_at_the_origin_of_a_moved_sea(seed: int) -> None:
    compare_with_single_runs(seed)


def two_hulls(**options: Any) -> Scene:
    scene = Scene(name="two")
    scene.add_vessel(database(), name="ship")
    scene.add_vessel(database(), name="barge", position=(60.0, 40.0, 0.0), heading_deg=90.0)
    scene.add_sea(vessel="ship", **{"hs": 2.0, "count": 20, "direction_deg": 0.0} | options)
    scene.add_sea(vessel="barge")
    return scene


def test_a_load_is_the_sum_over_components_at_the_place_and_heading_of_the_hull() -> None:
    scene = two_hulls()
    waves = scene.waves
    result = simulate(scene, t_end=10.0, dt_out=0.5)
    for name, (x, y), heading in (("ship", (0.0, 0.0), 0.0), ("barge", (60.0, 40.0), np.pi / 2.0)):
        along = x * np.cos(waves.direction) + y * np.sin(waves.direction)
        angle = np.outer(result.time, waves.omega) + waves.phase - waves.omega**2 / G * along
        wave = waves.amplitude * np.exp(1j * angle)
        expected = (wave @ database().force_at(waves.omega, waves.direction - heading)).real
        error = np.abs(result.select("wave_force", vessel=name) - expected)
        assert np.all(error < 1e-7 * np.abs(expected).max())
        elevation = result.select("wave_elevation", vessel=name)
        np.testing.assert_allclose(elevation, wave.real.sum(axis=1), atol=1e-7)
    surge, sway = np.abs(result.select("wave_force", vessel="barge"))[:, :2].max(axis=0)
    assert sway > 10.0 * surge  # beam seas: what follows the ship comes from the side of the barge


def test_loads_are_taken_at_a_pose_given_instead_of_the_start() -> None:
    scene = Scene(name="given")
    scene.add_vessel(database(), position=(5.0, 0.0, 0.0))
    scene.add_sea(hs=2.0, count=20, position=(12.0, -7.0), heading_deg=30.0)
    hull, turn = scene.waves.hull(), np.radians(30.0)
    assert hull.position == (12.0, -7.0) and hull.heading == pytest.approx(turn)
    expected = database().force_at(scene.waves.omega, scene.waves.direction - turn)
    np.testing.assert_array_equal(hull.transfer, expected)


def test_a_second_sea_is_refused_and_the_same_one_is_not() -> None:
    scene = two_hulls(hs=3.0)
    before = scene.waves
    scene.add_sea(vessel="barge", hs=3.0, count=20, direction_deg=0.0)
    assert list(before.hulls) == ["ship", "barge"] and scene.waves.phase is before.phase
    for call, message in (
        (lambda: scene.add_sea(vessel="ship", hs=3.0, count=20, direction_deg=5.0), "'ship'.*another sea"),
        (lambda: linear_model(scene), "name one as vessel"),
        (lambda: balance(scene).vessel_wrench, "'ship', 'barge' have a wrench each"),
    ):
        with pytest.raises(SceneError, match=message):
            call()


def test_joined_hulls_move_as_their_linear_model_under_the_loads_of_both() -> None:
    poses = {"ship": (-30.0, 20.0, 25.0), "barge": (60.0, 40.0, 100.0)}
    scene = Scene(name="joined")
    for body, (x, y, heading_deg) in poses.items():
        scene.add_vessel(database(), name=body, position=(x, y, 0.0), heading_deg=heading_deg)
        scene.add_sea(vessel=body, hs=0.02, tp=8.0, count=10, direction_deg=70.0)
    apart = float(np.hypot(90.0, 20.0))
    scene.add_spring(name="hawser", first="ship", second="barge", stiffness=2e7, natural_length=apart)
    linear = linear_model(scene, vessel="ship")
    summed = {body: response_summed(linear, body=body) for body in poses}
    start = linear.full_state(summed["ship"].state_at(0.0))
    result = simulate(scene, t_end=30.0, dt_out=0.5, start=start, channels=["vessel_motion"])
    alone = scene.copy(springs={})
    for body, (_, _, heading_deg) in poses.items():
        turn = np.kron(np.eye(2), rotation_about_z(np.radians(heading_deg)))
        expected = summed[body].at(result.time) @ turn
        got = result.select("vessel_motion", vessel=body)
        scale = np.abs(expected).max(axis=0)
        assert np.all(np.abs(got - expected).max(axis=0) < 0.01 * np.maximum(scale, 1e-2 * scale.max()))
        free = response_summed(alone, body=body).at(result.time) @ turn
        assert np.abs(free - expected)[:, :2].max() > 0.05 * scale[:2].max()  # the hawser carries


def carried(x: float, y: float, heading_deg: float) -> Scene:
    scene = Scene(name="carried")
    scene.add_vessel(database(), position=(x, y, 0.0), heading_deg=heading_deg)
    scene.add_crane(base="vessel", slew=0.3, payload=Payload(mass=20e3))
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        scene.add_actuator(name=joint, joint=joint, stiffness=1e8, damping=1e7)
    return scene


@pytest.mark.warns("BallastWarning", "OutsideRangeWarning")
def test_a_crane_stands_on_its_vessel_wherever_that_is() -> None:
    here, there = carried(0.0, 0.0, 0.0), carried(120.0, -40.0, 130.0)
    turn = rotation_about_z(np.radians(130.0))
    one, other = balance(here), balance(there)
    expected = np.kron(np.eye(2), turn) @ one.vessel_wrench
    np.testing.assert_allclose(other.vessel_wrench, expected, atol=1e-6 * np.abs(expected).max())
    center = turn @ one.weight_center + (120.0, -40.0, 0.0)
    np.testing.assert_allclose(other.weight_center, center, atol=1e-9)
    for name, load in one.loads.items():
        assert other.loads[name] == pytest.approx(load, rel=1e-9, abs=1e-3)
    runs = [simulate(scene, t_end=10.0, dt_out=0.5, **STEPS) for scene in (here, there)]
    np.testing.assert_allclose(runs[1]["vessel_motion"], runs[0]["vessel_motion"], atol=1e-8)
    np.testing.assert_allclose(runs[1]["actuator_force"], runs[0]["actuator_force"], rtol=1e-6, atol=1.0)


def test_a_prescribed_vessel_moves_along_its_own_heading() -> None:
    scene = Scene(name="prescribed")
    scene.add_vessel(database(), position=(30.0, 10.0, 0.0), heading_deg=-70.0)
    scene.add_sea(hs=2.0, count=20)
    run = simulate(scene, t_end=8.0, dt_out=0.05, rtol=1e-9)
    held = scene.copy(waves=calm_water(scene.waves))
    held.replace("vessel", kind="vessel", memory=[])
    curves = (spline_curve(times=run.time, values=run["vessel_motion"][:, i]) for i in range(6))
    hold_vessel(held, "vessel", dict(zip(SIX, curves, strict=True)))
    again = simulate(held, t_end=8.0, dt_out=0.5, rtol=1e-9)
    assert np.abs(again["vessel_motion"] - run["vessel_motion"][::10]).max() < 1e-6
    assert np.abs(run["vessel_motion"]).max() > 0.05
