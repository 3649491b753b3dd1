"""Several hulls in one sea, each where it is: as the hull alone, and as at the origin of a moved sea."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import (
    FlowCoefficients,
    Result,
    Scene,
    SceneError,
    balance,
    linear_model,
    simulate,
    simulate_to_file,
)
from seacrane.accuracy.quantities import quantities_of
from seacrane.analysis import response_summed
from seacrane.crane import Payload
from seacrane.hydro import DriftCoefficients, HydroDatabase, shipped_database
from seacrane.inputs.frames import rotation_about_z
from seacrane.scene import HullLoads, Waves
from seacrane.trading import simpler_scenes

Array = NDArray[np.float64]
G = 9.80665
STEPS: dict[str, Any] = {"integrator": "rk4", "dt": 0.1}  # the same for every scene, so that runs compare
CHANNELS = ("vessel_motion", "wave_force", "drift_force", "wave_elevation")


@lru_cache(maxsize=1)
def database() -> HydroDatabase:
    """The shipped one with drift that differs at every heading."""
    heading, omega = np.linspace(0.0, np.pi, 13), np.linspace(0.2, 2.6, 25)
    along, across = -2e3 * np.cos(heading)[:, None], 6e3 * np.sin(heading)[:, None]
    values = np.zeros((13, 25, 6))
    values[..., 0], values[..., 1], values[..., 5] = (
        along * omega,
        across * omega,
        20.0 * along * across * 1e-3,
    )
    drift = DriftCoefficients(heading=heading, omega=omega, coefficient=values)
    return replace(shipped_database(), drift=drift)


@dataclass(frozen=True)
class Pose:
    """Where a hull starts."""

    x: float
    y: float
    heading_deg: float

    def place(self) -> dict[str, Any]:
        return {"position": (self.x, self.y, 0.0), "heading_deg": self.heading_deg}


def blown(scene: Scene, name: str, direction_deg: float) -> None:
    """Wind and current on a hull, towards the same side."""
    rows = FlowCoefficients(
        angle=np.radians([0.0, 45.0, 90.0, 135.0, 180.0]),
        x=np.array([0.6, 0.4, 0.0, -0.4, -0.6]),
        y=np.array([0.0, 0.6, 0.8, 0.6, 0.0]),
        yaw=np.array([0.0, 0.05, 0.0, -0.05, 0.0]),
    )
    given: dict[str, Any] = {
        "coefficients": rows,
        "body": name,
        "length": 115.0,
        "direction_deg": direction_deg,
    }
    scene.add_wind(speed=15.0, frontal_area=700.0, lateral_area=1800.0, name=f"wind on {name}", **given)
    scene.add_current(speed=0.5, frontal_area=160.0, lateral_area=740.0, name=f"current on {name}", **given)


@dataclass(frozen=True)
class Weather:
    """What a random scene has beside its hulls."""

    direction_deg: float
    spreading: float | None
    seed: int
    phase: Any
    drift: bool
    wind_deg: float | None

    @classmethod
    def random(cls, random: np.random.Generator) -> Weather:
        return cls(
            direction_deg=random.uniform(-180.0, 180.0),
            spreading=float(random.choice([2.0, 8.0])) if random.random() < 0.5 else None,
            seed=int(random.integers(1, 1000)),
            phase=str(random.choice(["mean", "slow", "actual"])),
            drift=bool(random.random() < 0.5),
            wind_deg=random.uniform(-180.0, 180.0) if random.random() < 0.5 else None,
        )

    def of(self, poses: dict[str, Pose]) -> Scene:
        scene = Scene(name="hulls")
        for name, pose in poses.items():
            scene.add_vessel(database(), name=name, **pose.place())
        for name in poses:
            scene.add_sea(
                vessel=name, hs=2.5, tp=8.0, count=25, direction_deg=self.direction_deg,
                spreading=self.spreading, seed=self.seed, phase=self.phase, drift=self.drift,
            )  # fmt: skip
            if self.wind_deg is not None:
                blown(scene, name, self.wind_deg)
        return scene

    def moved_to_the_origin(self, pose: Pose) -> Scene:
        """A hull at the origin, heading along x, in the sea, wind and current that are the same to it."""
        scene = Scene(name="moved")
        scene.add_vessel(database(), name="hull")
        asked = self.of({"a": Pose(0.0, 0.0, 0.0)}).waves
        assert asked is not None
        heading = np.radians(pose.heading_deg)
        travel = pose.x * np.cos(asked.direction) + pose.y * np.sin(asked.direction)
        direction = asked.direction - heading
        scene.waves = Waves(
            omega=asked.omega,
            amplitude=asked.amplitude,
            phase=asked.phase - asked.omega**2 / G * travel,
            direction=direction,
            hulls={"hull": HullLoads(transfer=database().force_at(asked.omega, direction))},
        )
        if self.drift:
            scene.add_drift()
        if self.phase == "actual":
            scene.use_actual_position()
        if self.phase == "slow":
            scene.use_slow_position()
        if self.wind_deg is not None:
            blown(scene, "hull", self.wind_deg - pose.heading_deg)
        return scene


def random_poses(random: np.random.Generator) -> dict[str, Pose]:
    count = int(random.integers(2, 4))
    return {
        f"hull {i}": Pose(*random.uniform(-300.0, 300.0, 2), random.uniform(-180.0, 180.0))
        for i in range(count)
    }


def same(one: Result, other: Result, *, vessel: str | None = None, tolerance: float) -> None:
    """Channels of one vessel of a result against those of a result with one vessel."""
    for name in CHANNELS:
        if name not in other.channels:
            assert name not in one.channels
            continue
        got = one[name] if vessel is None else one.select(name, vessel=vessel)
        scale = np.abs(other[name]).max(axis=0)
        # Motions that a hull's symmetry keeps at nothing have the scale of the others.
        floor = 1e-3 * np.max(scale)
        assert np.all(np.abs(got - other[name]).max(axis=0) <= tolerance * np.maximum(scale, floor)), name


def compare_with_single_runs(seed: int) -> None:
    random = np.random.default_rng(seed)
    weather, poses = Weather.random(random), random_poses(random)
    together = simulate(weather.of(poses), t_end=20.0, dt_out=0.5, **STEPS)
    assert together.coords["vessel"] == tuple(poses)
    for name, pose in poses.items():
        alone = simulate(weather.of({name: pose}), t_end=20.0, dt_out=0.5, **STEPS)
        same(together, alone, vessel=name, tolerance=1e-7)
        # Loads from tables are within 1e-9 of the sum of all components, which is some ten times their size.
        moved = simulate(weather.moved_to_the_origin(pose), t_end=20.0, dt_out=0.5, **STEPS)
        same(alone, moved, tolerance=1e-6)


@pytest.mark.warns(sometimes=["CompassDirectionWarning"])
@pytest.mark.parametrize("seed", range(6))
def test_hulls_together_are_as_alone_and_as_at_the_origin_of_a_moved_sea(seed: int) -> None:
    compare_with_single_runs(seed)


@pytest.mark.slow("hundreds of random seas")
@pytest.mark.parametrize("seed", range(100, 300))
def test_more_hulls_together_are_as_alone_and_as_at_the_origin_of_a_moved_sea(seed: int) -> None:
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
    assert waves is not None
    result = simulate(scene, t_end=10.0, dt_out=0.5)
    for name, (x, y), heading in (("ship", (0.0, 0.0), 0.0), ("barge", (60.0, 40.0), np.pi / 2.0)):
        wavenumber = waves.omega**2 / G
        along = x * np.cos(waves.direction) + y * np.sin(waves.direction)
        angle = np.outer(result.time, waves.omega) + waves.phase - wavenumber * along
        wave = waves.amplitude * np.exp(1j * angle)
        expected = (wave @ database().force_at(waves.omega, waves.direction - heading)).real
        error = np.abs(result.select("wave_force", vessel=name) - expected)
        assert np.all(error < 1e-7 * np.abs(expected).max())
        np.testing.assert_allclose(
            result.select("wave_elevation", vessel=name), wave.real.sum(axis=1), atol=1e-7
        )
    surge, sway = np.abs(result.select("wave_force", vessel="barge"))[:, :2].max(axis=0)
    assert sway > 10.0 * surge  # beam seas: what follows the ship comes from the side of the barge


def test_the_place_of_a_hull_that_does_not_move_gives_the_same_load_by_table_and_at_the_moment() -> None:
    loads = []
    for phase in ("mean", "slow", "actual"):
        scene = Scene(name="ahead")
        scene.add_vessel(database(), position=(60.0, 0.0, 0.0), heading_deg=40.0)
        scene.add_sea(hs=2.0, count=30, phase=phase)  # type: ignore[arg-type]
        loads.append(simulate(scene, t_end=0.1, channels=["wave_force"])["wave_force"][0])
    for other in loads[1:]:
        np.testing.assert_allclose(loads[0], other, atol=1e-7 * np.abs(loads[0]).max())


def test_loads_are_taken_at_a_pose_given_instead_of_the_start() -> None:
    scene = Scene(name="given")
    scene.add_vessel(database(), position=(5.0, 0.0, 0.0))
    scene.add_sea(hs=2.0, count=20, position=(12.0, -7.0), heading_deg=30.0)
    assert scene.waves is not None
    hull = scene.waves.hull()
    assert hull.position == (12.0, -7.0) and hull.heading == pytest.approx(np.radians(30.0))
    expected = database().force_at(scene.waves.omega, scene.waves.direction - np.radians(30.0))
    np.testing.assert_array_equal(hull.transfer, expected)


def test_a_second_sea_is_refused_and_the_same_one_is_not() -> None:
    scene = two_hulls(hs=3.0)
    before = scene.waves
    assert before is not None and list(before.hulls) == ["ship", "barge"]
    scene.add_sea(vessel="barge", hs=3.0, count=20, direction_deg=0.0)
    assert scene.waves is not None and scene.waves.phase is before.phase
    for change in ({"hs": 2.0}, {"tp": 9.0}, {"seed": 2}, {"direction_deg": 5.0}, {"count": 21}):
        given: dict[str, Any] = {"hs": 3.0, "count": 20, "direction_deg": 0.0, **change}
        for vessel in ("ship", "barge"):
            with pytest.raises(SceneError, match=f"'{vessel}' is given another sea than 'ship', 'barge' has"):
                scene.add_sea(vessel=vessel, **given)
    with pytest.raises(SceneError, match=r"relative_bound is 0\.1, that of 'ship', 'barge' is 1e-09"):
        scene.add_sea(vessel="barge", relative_bound=0.1)
    with pytest.raises(SceneError, match="no vessel 'tug', the scene has 'ship', 'barge'; call add_vessel"):
        scene.add_sea(vessel="tug")
    with pytest.raises(SceneError, match="the sea is on 'ship', 'barge'; name one of them"):
        scene.add_drift()
    with pytest.raises(SceneError, match="heading_deg is 'north'"):
        scene.add_sea(vessel="barge", heading_deg="north")  # type: ignore[arg-type]
    with pytest.raises(SceneError, match="give finite"):
        scene.add_sea(vessel="barge", position=(np.nan, 0.0))


def test_the_papers_kinematics_refuse_a_heading() -> None:
    scene = Scene(name="paper")
    scene.add_vessel(database(), kinematics="paper", heading_deg=20.0)
    with pytest.raises(SceneError, match=r"'vessel'.*kinematics 'paper' act along the inertial axes.*0.349"):
        scene.compile()


def test_a_hull_may_be_at_the_moments_place_beside_one_at_its_mean() -> None:
    scene = two_hulls()
    scene.use_actual_position(vessel="barge")
    scene.add_drift(vessel="ship")
    result = simulate(scene, t_end=5.0, dt_out=0.5)
    assert np.abs(result.select("drift_force", vessel="ship")).max() > 1.0
    assert not result.select("drift_force", vessel="barge").any()
    plain = simulate(two_hulls(), t_end=5.0, dt_out=0.5)
    moved = result.select("wave_force", vessel="barge") - plain.select("wave_force", vessel="barge")
    assert 0.0 < np.abs(moved).max() < 0.1 * np.abs(plain["wave_force"]).max()


def test_files_and_tables_name_the_vessels(tmp_path: Path) -> None:
    scene = two_hulls()
    result = simulate(scene, t_end=5.0)
    data = result.to_xarray()
    assert data["vessel_motion"].dims == ("time", "vessel", "motion")
    assert list(data["vessel"].values) == ["ship", "barge"]
    read = Result.load(result.save(tmp_path / "two.nc"))
    grown = simulate_to_file(scene, tmp_path / "grown.nc", t_end=5.0)
    for other in (read, Result.load(grown.path)):
        assert other.dims == result.dims and other.coords["vessel"] == ("ship", "barge")
        np.testing.assert_array_equal(other["vessel_motion"], result["vessel_motion"])
    scene.save(tmp_path / "two.json")
    again = simulate(Scene.load(tmp_path / "two.json"), t_end=5.0)
    np.testing.assert_array_equal(again["vessel_motion"], result["vessel_motion"])
    rows = dict(scene.report()["elements"])
    assert rows["waves"] == ["ship", "barge"]


def test_an_overview_shows_every_vessel() -> None:
    from seacrane.pictures.overview import overview_sheet

    sheet = overview_sheet(simulate(two_hulls(), t_end=2.0))
    shown = [panel.quantity for panel in sheet.panels]
    assert shown.count("ship") == shown.count("barge") == 2


def test_the_linear_model_sums_the_loads_of_all_hulls() -> None:
    """Two hulls that nothing joins answer as each alone does."""
    both = two_hulls()
    assert both.waves is not None
    for name in ("ship", "barge"):
        alone = both.copy(waves=replace(both.waves, hulls={name: both.waves.hulls[name]}))
        for other in {"ship", "barge"} - {name}:
            del alone.vessels[other], alone.bodies[other]
        expected = response_summed(alone, body=name).amplitude
        got = response_summed(both, body=name).amplitude
        np.testing.assert_allclose(got, expected, atol=1e-9 * np.abs(expected).max())
    with pytest.raises(SceneError, match="has vessels ship, barge; name one as vessel"):
        linear_model(both)
    runs = simulate(both, t_end=0.5)
    roll = quantities_of(both, both.compile(), None)["roll"].values(runs)
    assert roll.shape == (runs.time.size, 2, 1)
    names = {variant.rung for variant in simpler_scenes.variants(both, quick=True)}
    assert simpler_scenes.PRESCRIBED not in names and simpler_scenes.LINEAR in names


def test_joined_hulls_move_as_their_linear_model_under_the_loads_of_both() -> None:
    scene = Scene(name="joined")
    scene.add_vessel(database(), name="ship", position=(-30.0, 20.0, 0.0), heading_deg=25.0)
    scene.add_vessel(database(), name="barge", position=(60.0, 40.0, 0.0), heading_deg=100.0)
    for body in ("ship", "barge"):
        scene.add_sea(vessel=body, hs=0.02, tp=8.0, count=10, direction_deg=70.0)
    apart = float(np.hypot(90.0, 20.0))
    scene.add_spring(name="hawser", first="ship", second="barge", stiffness=2e7, natural_length=apart)
    linear = linear_model(scene, vessel="ship")
    summed = {body: response_summed(linear, body=body) for body in ("ship", "barge")}
    start = linear.full_state(summed["ship"].state_at(0.0))
    result = simulate(scene, t_end=30.0, dt_out=0.5, start=start, channels=["vessel_motion"])
    alone = scene.copy(springs={})
    for body, heading_deg in (("ship", 25.0), ("barge", 100.0)):
        turn = rotation_about_z(np.radians(heading_deg))
        expected = summed[body].at(result.time) @ np.kron(np.eye(2), turn)
        got = result.select("vessel_motion", vessel=body)
        scale = np.abs(expected).max(axis=0)
        assert np.all(np.abs(got - expected).max(axis=0) < 0.01 * np.maximum(scale, 1e-2 * scale.max()))
        free = response_summed(alone, body=body).at(result.time) @ np.kron(np.eye(2), turn)
        assert np.abs(free - expected)[:, :2].max() > 0.05 * scale[:2].max()  # the hawser carries


def carried(pose: Pose) -> Scene:
    scene = Scene(name="carried")
    scene.add_vessel(database(), **pose.place())
    scene.add_crane(base="vessel", slew=0.3, payload=Payload(mass=20e3))
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        scene.add_actuator(name=joint, joint=joint, stiffness=1e8, damping=1e7)
    return scene


@pytest.mark.warns("BallastWarning", "OutsideRangeWarning")
def test_a_crane_stands_on_its_vessel_wherever_that_is() -> None:
    pose = Pose(120.0, -40.0, 130.0)
    here, there = carried(Pose(0.0, 0.0, 0.0)), carried(pose)
    turn = rotation_about_z(np.radians(pose.heading_deg))
    one, other = balance(here), balance(there)
    assert one.vessel_wrench is not None and other.vessel_wrench is not None
    expected = np.kron(np.eye(2), turn) @ one.vessel_wrench
    np.testing.assert_allclose(other.vessel_wrench, expected, atol=1e-6 * np.abs(expected).max())
    center = turn @ one.weight_center + (pose.x, pose.y, 0.0)
    np.testing.assert_allclose(other.weight_center, center, atol=1e-9)
    for name, load in one.loads.items():
        assert other.loads[name] == pytest.approx(load, rel=1e-9, abs=1e-3)
    runs = [simulate(scene, t_end=10.0, dt_out=0.5, **STEPS) for scene in (here, there)]
    np.testing.assert_allclose(runs[1]["vessel_motion"], runs[0]["vessel_motion"], atol=1e-8)
    np.testing.assert_allclose(runs[1]["actuator_force"], runs[0]["actuator_force"], rtol=1e-6, atol=1.0)


def test_balance_tells_the_wrench_on_every_vessel() -> None:
    held = balance(two_hulls())
    assert set(held.vessel_wrenches) == {"ship", "barge"}
    with pytest.raises(SceneError, match="vessels 'ship', 'barge' have a wrench each"):
        _ = held.vessel_wrench


def test_a_prescribed_vessel_moves_along_its_own_heading() -> None:
    scene = Scene(name="prescribed")
    scene.add_vessel(database(), position=(30.0, 10.0, 0.0), heading_deg=-70.0)
    scene.add_sea(hs=2.0, count=20)
    run = simulate(scene, t_end=8.0, dt_out=0.05, rtol=1e-9)
    held = simpler_scenes.with_prescribed_vessel(scene, run.time, run["vessel_motion"])
    again = simulate(held, t_end=8.0, dt_out=0.5, rtol=1e-9)
    assert np.abs(again["vessel_motion"] - run["vessel_motion"][::10]).max() < 1e-6
    assert np.abs(run["vessel_motion"]).max() > 0.05
