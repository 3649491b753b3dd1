"""The sea at points before a run, in a run, and on a current; the current of a scene in its hull's load."""

from __future__ import annotations

import numpy as np
import pytest

from seacrane import (
    FlowCoefficients,
    Lift,
    Outputs,
    Run,
    Scene,
    SeaState,
    WaveSystem,
    _core,
    shipped_database,
    simulate,
)
from seacrane.ensembles.other_sea import require_same_sea, with_sea
from seacrane.errors import SceneError
from seacrane.run.lanes import module_of
from seacrane.scene import Waves
from seacrane.sea import Current, cos_2s, jonswap
from seacrane.warnings import BlockedWavesWarning

G = 9.80665


def regular(
    *, period: float = 12.0, depth: float = float("inf"), direction: float = 0.0, **more: object
) -> Scene:
    """A scene of nothing but one wave of 1 m."""
    scene = Scene(name="wave")
    one = np.ones(1)
    scene.waves = Waves(
        omega=2.0 * np.pi / period * one, amplitude=one, phase=0.0 * one, direction=direction * one,
        hulls={}, depth=depth, **more,
    )  # fmt: skip
    return scene


def ship_in_a_sea(**sea: object) -> Scene:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), position=(30.0, -12.0, 0.0))
    scene.add_sea(**({"hs": 2.0, "tp": 8.0, "direction_deg": 160.0, "seed": 3} | sea))
    return scene


def add_mark(scene: Scene, name: str, place: tuple[float, float, float]) -> None:
    """A point that does not move."""
    scene.add_body(name=name, mass=1.0, inertia=(1.0, 1.0, 1.0), position=place)
    scene.add_joint(kind="weld", name=f"{name} holds", first="ground", second=name, point=place)
    scene.add_point(name, body=name, point=(0.0, 0.0, 0.0))


def test_the_numbers_of_a_regular_wave_in_shallow_water() -> None:
    scene = regular(depth=20.0, stretching="none")
    at = scene.sea_at(points={"ten": (0.0, 0.0, -10.0)}, times=[0.0, 9.0]).sel(point="ten")
    crest, quarter = at.isel(time=0), at.isel(time=1)
    assert float(crest.velocity.sel(axis="x")) == pytest.approx(0.617051, rel=1e-6)
    assert float(quarter.velocity.sel(axis="z")) == pytest.approx(0.241005, rel=2e-6)
    assert float(crest.pressure) == pytest.approx(1025.0 * 7.832828, rel=1e-7)
    assert at.velocity.attrs["units"] == "m/s"


def test_points_by_name_of_the_scene_and_above_the_water() -> None:
    scene = ship_in_a_sea()
    scene.add_point("bow", body="vessel", point=(50.0, 0.0, -3.0))
    by_name = scene.sea_at(points=["bow"], times=[0.0, 5.0])
    by_place = scene.sea_at(points=[(80.0, -12.0, -3.0), (80.0, -12.0, 30.0)], times=[0.0, 5.0])
    assert np.array_equal(by_name.velocity.sel(point="bow"), by_place.velocity.sel(point=0))
    assert np.array_equal(by_place.elevation.sel(point=0), by_place.elevation.sel(point=1))
    assert not by_place.submerged.sel(point=1).any()
    assert not by_place.velocity.sel(point=1).any()


def test_the_stretched_pressure_is_the_hydrostatic_one_at_the_surface() -> None:
    scene = ship_in_a_sea()
    eta = float(scene.sea_at(points=[(1.0, 2.0, 0.0)], times=7.0).elevation[0, 0])
    at = scene.sea_at(points=[(1.0, 2.0, eta)], times=7.0)
    assert bool(at.submerged[0, 0])
    assert float(at.pressure[0, 0]) == pytest.approx(1025.0 * G * eta, rel=1e-12)


@pytest.mark.parametrize("phase", ["mean", "slow", "actual"])
def test_a_vessel_and_a_point_at_its_place_see_one_wave(phase: str) -> None:
    scene = ship_in_a_sea(spreading=8.0, phase=phase)
    scene.add_point("here", body="vessel", point=(0.0, 0.0, 0.0))
    add_mark(scene, "there", (30.0, -12.0, -2.0))
    result = simulate(
        scene, t_end=6.0, dt_out=0.5, channels=["wave_elevation", "point_wave", "point_position"]
    )
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


def test_several_wave_systems_in_one_sea() -> None:
    wind = WaveSystem(spectrum=jonswap(hs=1.5, tp=6.0), direction_deg=180.0, spreading=cos_2s(6.0))
    swell = WaveSystem(spectrum=jonswap(hs=1.0, tp=13.0), direction_deg=250.0)
    scene = Scene(name="two systems")
    scene.add_sea(vessel=None, sea=SeaState(systems=[wind, swell], seed=2, depth=80.0))
    assert scene.waves is not None
    times = np.arange(0.0, 20.0, 0.7)
    at = scene.sea_at(points=[(4.0, 5.0, -6.0)], times=times)
    plain = scene.waves.components().kinematics(time=times, x=4.0, y=5.0, z=-6.0)
    # Compiling leaves out components of a share of 1e-9.
    assert np.abs(at.velocity[:, 0] - plain.velocity).max() < 1e-8
    assert np.abs(at.acceleration[:, 0] - plain.acceleration).max() < 1e-8
    assert np.abs(at.pressure[:, 0] - plain.dynamic_pressure).max() < 1e-4


@pytest.mark.parametrize(("speed", "wavenumber"), [(1.0, 0.054478), (-1.0, 0.075592)])
def test_wavenumbers_on_a_current(speed: float, wavenumber: float) -> None:
    scene = regular(period=8.0, current=Current(speed=speed, direction_deg=0.0))
    assert scene.waves is not None
    assert float(scene.waves.components().wavenumber[0]) == pytest.approx(wavenumber, rel=1e-5)
    at = scene.sea_at(points=[(0.0, 0.0, -500.0)], times=0.0)
    assert np.allclose(at.velocity[0, 0], [speed, 0.0, 0.0], atol=1e-9)


def test_a_profile_is_linear_between_depths_and_held_beyond() -> None:
    current = Current(depth=[0.0, 20.0, 60.0], speed=[1.0, 0.5, 0.0], direction_deg=[0.0, 0.0, 90.0])
    assert np.allclose(current.velocity([5.0, -10.0, -40.0, -99.0])[:, 0], [1.0, 0.75, 0.25, 0.0])
    speed, direction = current.mean(10.0)
    assert (speed, direction) == pytest.approx((0.875, 0.0))
    assert current.mean(0.0) == pytest.approx((1.0, 0.0))
    scene = Scene(name="flow")
    scene.add_sea(vessel=None, hs=0.0, current=current)
    at = scene.sea_at(points=[(0.0, 0.0, -10.0), (3.0, 0.0, -40.0)], times=[1.0])
    assert np.allclose(at.velocity[0], [[0.75, 0.0, 0.0], [0.25, 0.0, 0.0]])
    assert not at.elevation.any()
    assert not at.acceleration.any()


def test_waves_that_the_current_stops_are_left_out_and_told() -> None:
    scene = Scene(name="against")
    against = Current(speed=1.5, direction_deg=180.0)
    with pytest.warns(BlockedWavesWarning, match=r"stops waves above 1\.6\d* rad/s"):
        scene.add_sea(vessel=None, hs=2.0, tp=8.0, direction_deg=0.0, current=against)
    assert scene.waves is not None
    assert scene.waves.omega.max() < G / (4.0 * 1.5)
    assert len(scene.waves.omega) < scene.waves.provenance.wave_components == 200


def test_a_current_keeps_frequencies_and_loads_of_a_hull_but_not_its_phases_elsewhere() -> None:
    still = ship_in_a_sea()
    flowing = ship_in_a_sea(current=Current(speed=0.5, direction_deg=160.0))
    a, b = still.waves, flowing.waves
    assert a is not None
    assert b is not None
    assert np.array_equal(a.omega, b.omega)
    assert np.array_equal(a.amplitude, b.amplitude)
    assert np.array_equal(a.hull().transfer, b.hull().transfer)
    at = {"points": [(0.0, 0.0, 0.0), (30.0, -12.0, 0.0)], "times": [3.0]}
    one, other = still.sea_at(**at).elevation[0], flowing.sea_at(**at).elevation[0]
    assert float(one[0]) == pytest.approx(float(other[0]), abs=1e-12)
    assert abs(float(one[1] - other[1])) > 1e-3


def test_the_current_of_the_sea_is_what_a_hull_feels_and_is_counted_once() -> None:
    around = np.radians([0.0, 45.0, 90.0, 135.0, 180.0])
    c = FlowCoefficients(
        angle=around,
        x=[0.6, 0.4, 0.0, -0.4, -0.6],
        y=[0.0, 0.6, 0.8, 0.6, 0.0],
        yaw=[0.0, 0.1, 0.0, -0.1, 0.0],
    )
    areas = {"frontal_area": 100.0, "lateral_area": 600.0, "length": 100.0}
    profile = Current(depth=[0.0, 6.0], speed=[1.0, 0.4], direction_deg=90.0)
    scene = ship_in_a_sea(current=profile)
    load = scene.add_current(c, draught=6.0, **areas)
    assert load.speed.evaluate([0.0])[0, 0] == pytest.approx(0.7)
    assert load.direction == pytest.approx(np.pi / 2.0)
    with pytest.raises(SceneError, match="the sea has a current"):
        scene.add_current(c, name="second", speed=1.0, direction_deg=90.0, **areas)
    with pytest.raises(SceneError, match="has no speed or no direction_deg"):
        ship_in_a_sea().add_current(c, **areas)


def test_files_keep_current_and_stretching(tmp_path: object) -> None:
    scene = ship_in_a_sea(
        current=Current(depth=[0.0, 30.0], speed=[0.5, 0.1], direction_deg=[10.0, 20.0]), stretching="none"
    )
    scene.save(f"{tmp_path}/scene.json")
    again = Scene.load(f"{tmp_path}/scene.json")
    assert again == scene
    assert again.waves is not None
    assert again.waves.current == scene.waves.current
    assert again.waves.stretching == "none"


def test_a_second_vessel_shares_the_current() -> None:
    scene = ship_in_a_sea(current=Current(speed=0.4, direction_deg=0.0))
    scene.add_vessel(shipped_database(), name="barge", position=(0.0, 60.0, 0.0))
    with pytest.raises(SceneError, match="a scene has one current"):
        scene.add_sea(vessel="barge", current=Current(speed=0.5, direction_deg=0.0))
    waves = scene.add_sea(vessel="barge")
    assert waves is not None
    assert waves.current == Current(speed=0.4, direction_deg=0.0)
    assert set(waves.hulls) == {"vessel", "barge"}


def test_a_lift_file_gives_the_current(tmp_path: object) -> None:
    path = f"{tmp_path}/flow.toml"
    with open(path, "w") as file:
        file.write(
            'format = "seacrane lift"\nversion = 2\n\n[[vessel]]\ndatabase = "hull_115"\n\n'
            "[[sea]]\nhs_m = 1.5\ntp_s = 9.0\ndirection_deg = 180.0\n"
            'stretching = "none"\ncurrent = { depth_m = [0.0, 40.0], speed_m_per_s = [0.8, 0.2], '
            "direction_deg = [90.0, 90.0] }\n\n[run]\nt_end_s = 1.0\n"
        )
    waves = Lift.load(path).scene().waves
    assert waves is not None
    assert waves.current == Current(depth=[0.0, 40.0], speed=[0.8, 0.2], direction_deg=90.0)
    assert waves.stretching == "none"


def test_points_by_what_makes_no_sense() -> None:
    scene = regular(depth=20.0)
    for points, message in (
        ([(0.0, 0.0, -21.0)], "above the sea floor at z = -20"),
        ([(0.0, 0.0)], r"give \(n, 3\)"),
        (["bow"], "there is no body 'bow'"),
        ([(0.0, np.nan, 0.0)], "give finite ones in m"),
    ):
        with pytest.raises(SceneError, match=message):
            scene.sea_at(points=points, times=[0.0])
    with pytest.raises(SceneError, match="has no sea"):
        Scene(name="calm").sea_at(points=[(0.0, 0.0, 0.0)], times=[0.0])
    with pytest.raises(SceneError, match="stretching is 'vertical'"):
        ship_in_a_sea(stretching="vertical")
    with pytest.raises(SceneError, match="give 2 finite numbers, one for each depth"):
        Current(depth=[0.0, 5.0], speed=[1.0, 2.0, 3.0], direction_deg=0.0)
    with pytest.raises(SceneError, match="increasing"):
        Current(depth=[5.0, 0.0], speed=1.0, direction_deg=0.0)


def test_another_sea_for_a_compiled_model_is_another_field() -> None:
    def scene(seed: int) -> Scene:
        out = ship_in_a_sea(seed=seed)
        add_mark(out, "deep", (10.0, 0.0, -4.0))
        return out

    given = {"t_end": 1.0, "outputs": Outputs(dt_out=0.5, channels=["point_wave"])}
    waves = scene(7).waves
    assert waves is not None
    again, alone = Run(scene(3), **given).in_sea(waves), Run(scene(7), **given)
    for run in (again, alone):
        run.advance(1.0)
    assert np.array_equal(again.result()["point_wave"], alone.result()["point_wave"])
    expected = scene(7).sea_at(points=["deep"], times=again.result().time)
    seen = again.result().select("point_wave", point="deep", water="velocity_x")
    assert np.abs(seen - expected.velocity[:, 0, 0]).max() < 1e-12


@pytest.mark.warns("BlockedWavesWarning")
def test_members_of_a_study_keep_the_current() -> None:
    scene = ship_in_a_sea(current=Current(speed=1.5, direction_deg=340.0), stretching="none")
    require_same_sea(scene, ["seed", "hs"])
    waves = with_sea(scene, {"seed": 9}).waves
    assert waves is not None
    assert waves.current == Current(speed=1.5, direction_deg=340.0)
    assert waves.stretching == "none"


@pytest.mark.skipif(module_of(4) is None, reason="no lanes on this processor, or in this build")
def test_each_lane_is_in_its_own_sea() -> None:
    def scene(seed: int) -> Scene:
        out = ship_in_a_sea(seed=seed, count=40, current=Current(speed=0.1 * seed, direction_deg=160.0))
        out.add_body(name="box", mass=5e3, inertia=(8e3, 8e3, 8e3), position=(40.0, -12.0, -9.0))
        out.add_spring("wire", first="vessel", second="box", lengths=[0.0, 90.0], forces=[0.0, 9e5])
        out.add_load(
            _core.ImmersedSpan(
                name="span", first="vessel", second="box", density=1025.0, diameter=0.3, length=20.0,
                drag_coefficient=1.2, drag_coefficient_along=0.01,
            )
        )  # fmt: skip
        return out

    evaluator = _core.LaneEvaluator(module_of(4), [scene(seed).compile() for seed in (1, 2, 3, 4)])
    start, rng = evaluator.start(), np.random.default_rng(1)
    for t in (0.0, 0.7, 4.1):
        state = start + 1e-3 * rng.normal(size=start.shape)
        alone, side_by_side = evaluator.scalar_derivative(t, state), evaluator.derivative(t, state)
        assert np.abs((side_by_side - alone) / np.abs(alone).max(axis=1)[:, None]).max() < 1e-10
        assert np.ptp(alone[:, :4], axis=1).max() > 1e-4  # the lanes differ
