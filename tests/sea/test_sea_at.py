"""The sea at points before a run, in a run, and on a current; the current of a scene in its hull's load."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from marks import needs_lanes

from seacrane import FlowCoefficients, Lift, Outputs, Run, Scene, _core, shipped_database, simulate
from seacrane.ensembles.other_sea import require_same_sea, with_sea
from seacrane.errors import SceneError
from seacrane.run.lanes import module_of
from seacrane.sea import Current, SeaState, WaveSystem, cos_2s, jonswap
from seacrane.warnings import BlockedWavesWarning, CurrentInWavesWarning

G = 9.80665


def ship_in_a_sea(**sea: object) -> Scene:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), position=(30.0, -12.0, 0.0))
    scene.add_sea(**({"hs": 2.0, "tp": 8.0, "direction_deg": 160.0, "seed": 3} | sea))
    return scene


def add_mark(scene: Scene, name: str, place: tuple[float, float, float]) -> None:
    scene.add_body(name=name, mass=1.0, inertia=(1.0, 1.0, 1.0), position=place)
    scene.add_joint(kind="weld", name=f"{name} holds", first="ground", second=name, point=place)
    scene.add_point(name, body=name, point=(0.0, 0.0, 0.0))


def test_points_by_name_of_the_scene_and_above_the_water() -> None:
    scene = ship_in_a_sea()
    scene.add_point("bow", body="vessel", point=(50.0, 0.0, -3.0))
    by_name = scene.sea_at(points=["bow"], times=[0.0, 5.0])
    by_place = scene.sea_at(points=[(80.0, -12.0, -3.0), (80.0, -12.0, 30.0)], times=[0.0, 5.0])
    assert np.array_equal(by_name.velocity.sel(point="bow"), by_place.velocity.sel(point=0))
    assert np.array_equal(by_place.elevation.sel(point=0), by_place.elevation.sel(point=1))
    assert not by_place.submerged.sel(point=1).any()
    assert not by_place.velocity.sel(point=1).any()
    wind = WaveSystem(spectrum=jonswap(hs=1.5, tp=6.0), direction_deg=180.0, spreading=cos_2s(6.0))
    swell = WaveSystem(spectrum=jonswap(hs=1.0, tp=13.0), direction_deg=250.0)
    scene = Scene(name="two systems")
    scene.add_sea(vessel=None, sea=SeaState(systems=[wind, swell], seed=2, depth=80.0))
    times = np.arange(0.0, 20.0, 0.7)
    at = scene.sea_at(points=[(4.0, 5.0, -6.0)], times=times)
    plain = scene.waves.components().kinematics(time=times, x=4.0, y=5.0, z=-6.0)
    # Compiling leaves out components of a share of 1e-9.
    assert np.abs(at.velocity[:, 0] - plain.velocity).max() < 1e-8
    assert np.abs(at.acceleration[:, 0] - plain.acceleration).max() < 1e-8
    assert np.abs(at.pressure[:, 0] - plain.dynamic_pressure).max() < 1e-4


@pytest.mark.parametrize("phase", ["mean", "slow", "actual"])
def test_a_vessel_and_a_point_at_its_place_see_one_wave(phase: str) -> None:
    scene = ship_in_a_sea(spreading=8.0, phase=phase)
    scene.add_point("here", body="vessel", point=(0.0, 0.0, 0.0))
    add_mark(scene, "there", (30.0, -12.0, -2.0))
    result = simulate(scene, t_end=6.0, dt_out=0.5, channels=["wave_elevation", "point_wave"])
    place = "here" if phase == "actual" else "there"
    seen = result.select("point_wave", point=place, water="elevation")
    apart = 1e-9 if phase == "actual" else 1e-8  # the table's bound is of the sum of amplitudes
    start = slice(0, 1) if phase == "slow" else slice(None)  # its place is then that of the start
    assert np.abs(seen - result["wave_elevation"])[start].max() < apart
    before = scene.sea_at(points=["there"], times=result.time)
    there = result.select("point_wave", point="there")
    assert np.abs(there[:, 0] - before.elevation[:, 0]).max() < 1e-12
    assert np.abs(there[:, 1:4] - before.velocity[:, 0]).max() < 1e-12
    assert np.abs(there[:, 4:7] - before.acceleration[:, 0]).max() < 1e-12
    assert np.abs(1025.0 * there[:, 7] - before.pressure[:, 0]).max() < 1e-8


def test_a_profile_is_linear_between_depths_and_held_beyond() -> None:
    current = Current(depth=[0.0, 20.0, 60.0], speed=[1.0, 0.5, 0.0], direction_deg=[0.0, 0.0, 90.0])
    assert np.allclose(current.velocity([5.0, -10.0, -40.0, -99.0])[:, 0], [1.0, 0.75, 0.25, 0.0])
    assert current.mean(10.0) == pytest.approx((0.875, 0.0))
    assert current.mean(0.0) == pytest.approx((1.0, 0.0))
    scene = Scene(name="flow")
    scene.add_sea(vessel=None, hs=0.0, current=current)
    at = scene.sea_at(points={"ten": (0.0, 0.0, -10.0), "forty": (3.0, 0.0, -40.0)}, times=[1.0])
    assert np.allclose(at.velocity.sel(point=["forty", "ten"])[0], [[0.25, 0.0, 0.0], [0.75, 0.0, 0.0]])
    assert not at.elevation.any() and not at.acceleration.any()


def test_waves_that_the_current_stops_are_left_out_and_told() -> None:
    scene = Scene(name="against")
    against = Current(speed=1.5, direction_deg=180.0)
    with pytest.warns(BlockedWavesWarning, match=r"above 1\.6\d* rad/s"):
        scene.add_sea(vessel=None, hs=2.0, tp=8.0, direction_deg=0.0, current=against)
    assert scene.waves.omega.max() < G / (4.0 * 1.5)
    assert len(scene.waves.omega) < scene.waves.provenance.wave_components == 200
    with pytest.warns(BlockedWavesWarning):
        ship = ship_in_a_sea(current=Current(speed=1.5, direction_deg=340.0), stretching="none")
    with pytest.warns(BlockedWavesWarning):  # a member of a study keeps the current
        require_same_sea(ship, ["seed", "hs"])
        waves = with_sea(ship, {"seed": 9}).waves
    assert waves.current == Current(speed=1.5, direction_deg=340.0) and waves.stretching == "none"


def test_a_current_keeps_frequencies_and_loads_of_a_hull_but_not_its_phases_elsewhere() -> None:
    still = ship_in_a_sea()
    flowing = ship_in_a_sea(current=Current(speed=0.5, direction_deg=160.0))
    a, b = still.waves, flowing.waves
    assert np.array_equal(a.omega, b.omega) and np.array_equal(a.amplitude, b.amplitude)
    assert np.array_equal(a.hull().transfer, b.hull().transfer)
    at = {"points": [(0.0, 0.0, 0.0), (30.0, -12.0, 0.0)], "times": [3.0]}
    one, other = still.sea_at(**at).elevation[0], flowing.sea_at(**at).elevation[0]
    assert float(one[0]) == pytest.approx(float(other[0]), abs=1e-12)
    assert abs(float(one[1] - other[1])) > 1e-3


def test_the_current_of_the_sea_is_what_a_hull_feels_and_is_counted_once() -> None:
    x, y, yaw = [0.6, 0.4, 0.0, -0.4, -0.6], [0.0, 0.6, 0.8, 0.6, 0.0], [0.0, 0.1, 0.0, -0.1, 0.0]
    c = FlowCoefficients(angle=np.radians([0.0, 45.0, 90.0, 135.0, 180.0]), x=x, y=y, yaw=yaw)
    areas = {"frontal_area": 100.0, "lateral_area": 600.0, "length": 100.0}
    profile = Current(depth=[0.0, 6.0], speed=[1.0, 0.4], direction_deg=90.0)
    scene = ship_in_a_sea(current=profile)
    load = scene.add_current(c, draught=6.0, **areas)
    assert load.speed.evaluate([0.0])[0, 0] == pytest.approx(0.7)
    assert load.direction == pytest.approx(np.pi / 2.0)
    with pytest.raises(SceneError, match="the sea has a current"):
        scene.add_current(c, name="second", speed=1.0, direction_deg=90.0, **areas)


def test_files_keep_current_and_stretching(tmp_path: Path) -> None:
    current = Current(depth=[0.0, 40.0], speed=[0.8, 0.2], direction_deg=90.0)
    scene = ship_in_a_sea(current=current, stretching="none")
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json") == scene
    (tmp_path / "flow.toml").write_text(
        'format = "seacrane lift"\nversion = 2\n\n[[vessel]]\ndatabase = "hull_115"\n\n'
        "[[sea]]\nhs_m = 1.5\ntp_s = 9.0\ndirection_deg = 180.0\nstretching = 'none'\n"
        "current = { depth_m = [0, 40], speed_m_per_s = [0.8, 0.2], direction_deg = [90, 90] }\n"
    )
    waves = Lift.load(tmp_path / "flow.toml").scene().waves
    assert waves.current == current and waves.stretching == "none"


def test_another_sea_for_a_compiled_model_is_another_field() -> None:
    scenes = [ship_in_a_sea(seed=seed) for seed in (3, 7)]
    for scene in scenes:
        add_mark(scene, "deep", (10.0, 0.0, -4.0))
    given = {"t_end": 1.0, "outputs": Outputs(dt_out=0.5, channels=["point_wave"])}
    again, alone = Run(scenes[0], **given).in_sea(scenes[1].waves), Run(scenes[1], **given)
    for run in (again, alone):
        run.advance(1.0)
    result = again.result()
    assert np.array_equal(result["point_wave"], alone.result()["point_wave"])
    expected = scenes[1].sea_at(points=["deep"], times=result.time)
    seen = result.select("point_wave", point="deep", water="velocity_x")
    assert np.abs(seen - expected.velocity[:, 0, 0]).max() < 1e-12


@needs_lanes
def test_each_lane_is_in_its_own_sea() -> None:
    def scene(seed: int) -> Scene:
        out = ship_in_a_sea(seed=seed, count=40, current=Current(speed=0.1 * seed, direction_deg=160.0))
        out.add_body(name="box", mass=5e3, inertia=(8e3, 8e3, 8e3), position=(40.0, -12.0, -9.0))
        out.add_spring("wire", first="vessel", second="box", lengths=[0.0, 90.0], forces=[0.0, 9e5])
        ends = {"name": "span", "first": "vessel", "second": "box", "density": 1025.0, "length": 20.0}
        size = {"diameter": 0.3, "drag_coefficient": 1.2, "drag_coefficient_along": 0.01}
        out.add_load(_core.ImmersedSpan(**ends, **size))
        return out

    evaluator = _core.LaneEvaluator(module_of(4), [scene(seed).compile() for seed in (1, 2, 3, 4)])
    start, rng = evaluator.start(), np.random.default_rng(1)
    for t in (0.0, 0.7, 4.1):
        state = start + 1e-3 * rng.normal(size=start.shape)
        alone, side_by_side = evaluator.scalar_derivative(t, state), evaluator.derivative(t, state)
        assert np.abs((side_by_side - alone) / np.abs(alone).max(axis=1)[:, None]).max() < 1e-10
        assert np.ptp(alone[:, :4], axis=1).max() > 1e-4  # the lanes differ


@pytest.mark.parametrize(
    ("speed", "direction_deg", "density", "told"),
    [(0.08, 0.0, 1025.0, 0), (0.14, 180.0, 1025.0, 1), (0.2, 90.0, 1025.0, 0), (0.2, 0.0, 1.225, 0)],
)
def test_a_current_along_the_waves_is_named_from_a_tenth_on(
    speed: float, direction_deg: float, density: float, told: int
) -> None:
    """Of the waves' own speed, g T / (2 pi); neither one across the waves nor wind."""
    zero = [0.0, 0.0, 0.0]
    along = FlowCoefficients(angle=[0.0, np.pi / 2, np.pi], x=[0.6, 0.0, -0.6], y=[0, 0.8, 0], yaw=zero)
    scene = Scene(name="in a current")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_sea(hs=0.5, tp=8.0, direction_deg=0.0, count=40, seed=1)
    flow = scene.add_wind if density < 500.0 else scene.add_current
    at = {"speed": speed * G * 8.0 / (2.0 * np.pi), "direction_deg": direction_deg, "density": density}
    flow(coefficients=along, frontal_area=100.0, lateral_area=500.0, length=115.0, **at)
    with warnings.catch_warnings(record=True, action="always") as seen:
        simulate(scene, t_end=1.0)
    assert [one.category for one in seen].count(CurrentInWavesWarning) == told


def test_a_second_vessel_shares_the_current() -> None:
    scene = ship_in_a_sea(current=Current(speed=0.4, direction_deg=0.0))
    scene.add_vessel(shipped_database(), name="barge", position=(0.0, 60.0, 0.0))
    with pytest.raises(SceneError, match="one current"):
        scene.add_sea(vessel="barge", current=Current(speed=0.5, direction_deg=0.0))
    assert scene.add_sea(vessel="barge").current == Current(speed=0.4, direction_deg=0.0)
