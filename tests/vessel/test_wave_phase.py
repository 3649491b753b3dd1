"""Wave loads at the vessel's actual position and heading, against the mean ones and closed forms."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Curve, Scene, SceneError, _core, simulate
from seacrane.hydro import HydroDatabase, shipped_database
from seacrane.scene import ByHeading, HullLoads, Waves

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

Array = NDArray[np.float64]
G = 9.80665
TIMES = np.array([0.0, 0.4, 17.3, 99.0, 1234.5])


@cache
def database() -> HydroDatabase:
    return shipped_database()


def spread_sea(count: int = 60) -> _core.WaveComponents:
    """Components of many directions, some of them alike, as spread seas have them."""
    rng = np.random.default_rng(4)
    return _core.WaveComponents(
        omega=np.sort(rng.uniform(0.35, 2.0, count)),
        amplitude=rng.uniform(0.01, 0.2, count),
        phase=rng.uniform(0.0, 6.28, count),
        direction=np.repeat(rng.uniform(-4.0, 8.0, count // 3), 3),
    )


def positioned(waves: _core.WaveComponents) -> _core.PositionedWaveLoad:
    heading, _ = database().full_circle()
    values = database().force_at(np.array(waves.omega)[None, :], heading[:, None])
    return _core.PositionedWaveLoad(waves, headings=heading, transfer=values)


@pytest.mark.parametrize(
    ("x", "y", "yaw"), [(0.0, 0.0, 0.0), (31.0, -12.0, 0.0), (-250.0, 80.0, 0.7), (4.0, 9.0, -9.0)]
)
def test_a_fixed_vessel_gets_the_mean_load_of_its_place_and_heading(x: float, y: float, yaw: float) -> None:
    waves = spread_sea()
    transfer = database().force_at(waves.omega, np.array(waves.direction) - yaw)
    mean = _core.ExactWaveLoad(waves, transfer=transfer, position=(x, y))
    load = positioned(waves)
    for t in TIMES:
        force, drift, elevation = load.evaluate(t, x=x, y=y, yaw=yaw)
        # Rounding of phases, of spline weights and of the sum.
        assert np.all(np.abs(force - mean.evaluate(t)) < 1e-12 * mean.magnitude())
        assert elevation == pytest.approx(float(mean.elevation(t)), abs=1e-11)
        assert np.all(drift == 0.0)


def test_moving_a_vessel_moves_its_load_as_calculus_says() -> None:
    waves, load = spread_sea(), positioned(spread_sea())
    t, x, y, h = 12.0, 3.0, -2.0, 1e-3
    travel = np.array(waves.wavenumber) * np.cos(waves.direction)
    phasor = waves.amplitude * np.exp(1j * (np.array(waves.omega) * t + waves.phase))
    phasor = phasor * np.exp(-1j * (travel * x + np.array(waves.wavenumber) * np.sin(waves.direction) * y))
    transfer = database().force_at(waves.omega, waves.direction)
    expected = ((-1j * travel * phasor) @ transfer).real
    got = (load.evaluate(t, x=x + h, y=y)[0] - load.evaluate(t, x=x - h, y=y)[0]) / (2.0 * h)
    scale = np.abs(transfer).T @ waves.amplitude
    assert np.all(np.abs(got - expected) < 1e-7 * scale)
    # The whole time derivative along a path is that in time plus that in place.
    speed = 4.0
    rate = ((1j * (np.array(waves.omega) - travel * speed) * phasor) @ transfer).real
    along = (
        load.evaluate(t + h, x=x + speed * h, y=y)[0] - load.evaluate(t - h, x=x - speed * h, y=y)[0]
    ) / (2.0 * h)
    assert np.all(np.abs(along - rate) < 1e-5 * scale)


def regular_sea(*, omega: float, direction_deg: float) -> Waves:
    direction = np.radians(direction_deg)
    heading, _ = database().full_circle()
    return Waves(
        omega=np.array([omega]),
        amplitude=np.array([0.8]),
        phase=np.array([0.3]),
        direction=np.array([direction]),
        hulls={
            "vessel": HullLoads(
                transfer=database().force_at(np.array([omega]), direction),
                force_by_heading=ByHeading(
                    heading=heading, values=database().force_at(np.array([omega])[None, :], heading[:, None])
                ),
            )
        },
    )


@pytest.mark.warns("ForwardSpeedWarning")
@pytest.mark.parametrize(("direction_deg", "yaw"), [(180.0, 0.0), (0.0, 0.0), (130.0, 0.4)])
def test_a_towed_vessel_meets_the_encounter_frequency(direction_deg: float, yaw: float) -> None:
    speed, omega = 5.0, 0.9
    scene = Scene(name="towed")
    scene.add_vessel(database(), mooring_period=None, memory="none")
    scene.add_joint(kind="free", name="tow", first="ground", second="vessel", axis=(0.0, 0.0, 1.0))
    ahead = Curve.pieces(starts=[0.0], coefficients=[[0.0, speed, 0.0, 0.0, 0.0, 0.0]])
    for coordinate in ("x", "y", "z", "roll", "pitch", "yaw"):
        curve = Curve.constant(value=yaw if coordinate == "yaw" else 0.0)
        scene.add_driver(joint="tow", coordinate=coordinate, curve=ahead if coordinate == "x" else curve)
    scene.waves = regular_sea(omega=omega, direction_deg=direction_deg)
    result = simulate(scene, t_end=60.0, dt_out=0.25)
    encounter = omega - omega**2 / G * speed * np.cos(np.radians(direction_deg))
    assert abs(encounter - omega) > 0.2
    transfer = database().force_at(omega, np.radians(direction_deg) - yaw)
    wave = 0.8 * np.exp(1j * (encounter * result.time + 0.3))
    expected = (wave[:, None] * transfer).real
    # Positions come from the driven joint, to 1e-9 m and better.
    np.testing.assert_allclose(result.channels["wave_elevation"], wave.real, atol=1e-8)
    error = np.abs(result.channels["wave_force"] - expected).max(axis=0)
    assert np.all(error < 1e-7 * np.abs(transfer).max())


def actual_scene(*, evaluation: str = "table", **changes: Any) -> Scene:
    scene = Scene(name="actual")
    scene.add_vessel(database(), mooring_period=100.0)
    scene.add_sea(hs=3.0, tp=8.0, direction_deg=60.0, count=40)
    scene.use_actual_position()
    assert scene.waves is not None
    scene.waves = replace(scene.waves.changed(**changes), evaluation=evaluation)
    return scene


@pytest.mark.warns("MeanHeadingWarning")
def test_a_free_vessel_feels_where_it_is_and_its_energy_balances() -> None:
    scene = actual_scene()
    result = simulate(scene, t_end=60.0, dt_out=0.5, rtol=1e-8)
    assert np.abs(result.channels["energy_balance"]).max() < 1e-6 * result.channels["absolute_work"][-1]
    assert scene.waves is not None
    load = positioned(scene.waves.components())
    motion = result.channels["vessel_motion"]
    at = [load.evaluate(t, x=m[0], y=m[1], yaw=m[5]) for t, m in zip(result.time, motion, strict=True)]
    scale = np.abs(result.channels["wave_force"]).max(axis=0)
    assert np.all(np.abs([force for force, _, _ in at] - result.channels["wave_force"]) < 1e-9 * scale)
    mean = actual_scene(force_by_heading=None)
    other = simulate(mean, t_end=60.0, dt_out=0.5, rtol=1e-8)
    assert np.abs(other.channels["wave_force"] - result.channels["wave_force"]).max() > 0.02 * scale.max()


def test_turning_ship_and_sea_together_changes_nothing() -> None:
    """Motions in axes of the mean heading know nothing of where north is."""
    motions = []
    for turn in (0.0, 0.6):
        scene = Scene(name="turned")
        scene.add_vessel(database(), mooring_period=100.0)
        hull = scene.bodies["vessel"]
        scene.bodies["vessel"] = _core.Body(
            name="vessel",
            mass=hull.mass,
            inertia=hull.inertia,
            center_of_mass=hull.center_of_mass,
            quaternion=(np.cos(turn / 2.0), 0.0, 0.0, np.sin(turn / 2.0)),
        )
        scene.add_sea(hs=3.0, tp=8.0, direction_deg=60.0 + np.degrees(turn), count=40)
        scene.use_actual_position()
        motions.append(simulate(scene, t_end=60.0, dt_out=1.0, rtol=1e-9).channels["vessel_motion"])
    assert np.all(np.abs(motions[0] - motions[1]) < 1e-6 * np.abs(motions[0]).max(axis=0))


def test_far_beyond_the_fast_sines_the_load_is_still_right() -> None:
    waves = spread_sea()
    transfer = database().force_at(waves.omega, waves.direction)
    mean = _core.ExactWaveLoad(waves, transfer=transfer)
    # Phases of 6e6 rad are rounded to 1e-9.
    error = np.abs(positioned(waves).evaluate(3e6)[0] - mean.evaluate(3e6))
    assert np.all(error < 1e-8 * mean.magnitude())


def test_a_scene_file_keeps_the_loads_of_all_headings(tmp_path: Path) -> None:
    scene = actual_scene()
    scene.save(tmp_path / "scene.json")
    again = Scene.load(tmp_path / "scene.json")
    assert scene.waves is not None
    assert again.waves is not None
    assert again.waves.hull().force_by_heading is not None
    assert scene.waves.hull().force_by_heading is not None
    np.testing.assert_array_equal(
        again.waves.hull().force_by_heading.values, scene.waves.hull().force_by_heading.values
    )
    first, second = (simulate(s, t_end=5.0, dt_out=1.0) for s in (scene, again))
    np.testing.assert_array_equal(first.channels["vessel_motion"], second.channels["vessel_motion"])


def test_what_makes_no_sense_is_refused_by_name() -> None:
    with pytest.raises(SceneError, match="needs a sea; call add_sea first"):
        Scene(name="calm").use_actual_position()
    with pytest.raises(SceneError, match="choose evaluation='exact'"):
        actual_scene(evaluation="fft").compile()
    force = positioned_values()
    with pytest.raises(SceneError, match=r"values need the shape \(\d+, 40, 6\)"):
        actual_scene(force_by_heading=ByHeading(heading=force.heading, values=force.values[:, :3])).compile()
    with pytest.raises(SceneError, match="at most 45 deg apart"):
        actual_scene(force_by_heading=ByHeading(heading=force.heading[::-1], values=force.values)).compile()
    broken = np.array(force.values)
    broken[1, 2, 3] = np.nan
    with pytest.raises(SceneError, match="value of component 2 is nan"):
        actual_scene(force_by_heading=ByHeading(heading=force.heading, values=broken)).compile()
    scene = actual_scene(drift=np.zeros((40, 6)))
    with pytest.raises(SceneError, match="needs drift_by_heading"):
        scene.compile()
    with pytest.raises(ValueError, match="not finite"):
        positioned(spread_sea()).evaluate(float("nan"))
    paper = Scene(name="paper")
    paper.add_vessel(database(), kinematics="paper")
    paper.waves = actual_scene().waves
    with pytest.raises(SceneError, match="yaw_following"):
        paper.compile()


def test_headings_must_cover_the_circle() -> None:
    scene = Scene()
    scene.add_vessel(replace(database(), name="beam only").select(heading=(1.0, 2.0)))
    scene.add_sea(hs=3.0, tp=8.0, direction_deg=90.0, count=40)
    with pytest.raises(SceneError, match=r"database 'beam only': headings .* leave gaps above 45 deg"):
        scene.use_actual_position()


def positioned_values() -> ByHeading:
    waves = actual_scene().waves
    assert waves is not None
    assert waves.hull().force_by_heading is not None
    return waves.hull().force_by_heading
