"""Vessels that leave the place, the heading, the speed or the mooring that their loads hold for are named."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest

from seacrane import Result, Scene, simulate
from seacrane.hydro import shipped_database
from seacrane.validity.hull_range import LARGEST_PHASE, peak_frequency, slowly
from seacrane.validity.left_range import findings
from seacrane.warnings import (
    ForwardSpeedWarning,
    LargeHeelWarning,
    MeanHeadingWarning,
    MeanPositionWarning,
    MooringTurnWarning,
    NoWaveLoadsWarning,
)

G = 9.80665


def moored(*, hs: float = 1.0, **vessel: Any) -> Scene:
    scene = Scene(name="moored")
    scene.add_vessel(shipped_database(), name="hull", **vessel)
    if hs:
        scene.add_sea(vessel="hull", hs=hs, tp=8.0, direction_deg=0.0, count=40)
    return scene


def told(scene: Scene, **settings: Any) -> tuple[Result, dict[type[Warning], str]]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = simulate(scene, **{"t_end": 200.0, "dt_out": 0.5, **settings})
    return result, {w.category: str(w.message) for w in caught}


def pushed(
    scene: Scene, *, surge: float = 0.0, sway: float = 0.0, lever: float = 0.0, body: str = "hull"
) -> Scene:
    """A force that follows the hull, at a lever ahead of its origin."""
    scene.add_point_force(
        name=f"tug at {body}", body=body, point=(lever, 0.0, 0.0), force=(surge, sway, 0.0), body_axes=True
    )
    return scene


def stiffness(scene: Scene) -> Any:
    return np.asarray(scene.vessels["hull"].mooring_stiffness)


def test_a_drift_along_the_waves_beyond_the_phase_warns_and_across_them_does_not() -> None:
    wavenumber = (2.0 * np.pi / 8.0) ** 2 / G
    allowed = LARGEST_PHASE / wavenumber
    for along, across, expected in ((0.6, 0.0, False), (2.0, 0.0, True), (0.0, 2.0, False)):
        scene = moored()
        surge, sway, _ = stiffness(scene)
        # A force that comes at once overshoots to twice its displacement less damping.
        pushed(scene, surge=0.6 * along * allowed * surge, sway=0.6 * across * allowed * sway)
        result, found = told(scene)
        assert (MeanPositionWarning in found) == expected
        assert set(found) <= {MeanPositionWarning}
        if expected:
            assert "'hull': is " in found[MeanPositionWarning]
            assert "phase='slow'" in found[MeanPositionWarning]
            assert str(result.stats["validity"]) == found[MeanPositionWarning]


def test_motions_of_wave_frequency_are_no_drift() -> None:
    scene = moored()
    time = np.arange(0.0, 200.0, 0.5)
    motion = np.zeros((time.size, 6))
    motion[:, 0] = 8.0 * np.sin(2.0 * np.pi / 8.0 * time)
    motion[:, 5] = np.radians(15.0) * np.sin(2.0 * np.pi / 7.0 * time)
    assert not findings(scene, time, {"vessel_motion": motion}, {})
    slow = slowly(time, motion, 8.0)
    within = slow[40:-40]  # at its ends a run has half the outputs to take means of
    assert np.abs(within[:, 0]).max() < 0.05 * 8.0 and np.abs(within[:, 5]).max() < 0.05 * np.radians(15.0)


def test_slow_motions_of_the_mooring_pass_the_low_pass() -> None:
    time = np.arange(0.0, 1000.0, 0.5)
    values = np.sin(2.0 * np.pi / 200.0 * time)[:, None]
    assert np.abs(slowly(time, values, 8.0)).max() == pytest.approx(1.0, abs=0.03)


def test_loads_of_another_heading_than_the_start_warn_at_once() -> None:
    scene = moored(hs=0.0, heading_deg=30.0)
    scene.add_sea(vessel="hull", hs=1.0, direction_deg=0.0, count=40, heading_deg=0.0)
    _, found = told(scene, t_end=60.0)
    assert "'hull': yaw reaches 30" in found[MeanHeadingWarning]
    right = moored(heading_deg=30.0)
    assert not told(right, t_end=60.0)[1]


def test_a_ship_under_way_warns_of_its_place_and_of_its_speed() -> None:
    scene = Scene(name="under way")
    scene.add_vessel(shipped_database(), name="hull", mooring_period=None)
    hull = scene.bodies.pop("hull")
    scene.add_body(
        name="hull", mass=hull.mass, inertia=hull.inertia, center_of_mass=hull.center_of_mass,
        velocity=(5.0, 0.0, 0.0),
    )  # fmt: skip
    _, calm = told(scene, t_end=60.0)
    assert not calm
    scene.add_sea(vessel="hull", hs=1.0, count=40)
    result, found = told(scene, t_end=60.0)
    assert result["vessel_motion"][-1, 0] > 100.0
    assert set(found) >= {MeanPositionWarning, ForwardSpeedWarning}
    assert "makes 4." in found[ForwardSpeedWarning]
    scene.waves = None
    scene.add_sea(vessel="hull", hs=1.0, count=40, phase="actual")
    assert set(told(scene, t_end=60.0)[1]) == {ForwardSpeedWarning}


def test_a_hull_that_turns_beyond_its_mooring_warns() -> None:
    """A steady moment beyond the spring's at half a turn: it turns for ever."""
    for share, expected in ((0.4, False), (1.3, True)):
        scene = moored(hs=0.0)
        lever = 40.0
        moment = share * np.pi * float(stiffness(scene)[2])
        for side in (1.0, -1.0):  # a couple
            scene.add_point_force(
                name=f"thruster {side:+.0f}", body="hull", point=(side * lever, 0.0, 0.0),
                force=(0.0, 0.5 * side * moment / lever, 0.0), body_axes=True,
            )  # fmt: skip
        _, found = told(scene, t_end=400.0)
        assert (MooringTurnWarning in found) == expected
    assert "'hull': passes half a turn" in found[MooringTurnWarning]
    free = moored(hs=0.0, mooring_period=None)
    time, motion = np.array([0.0, 1.0]), np.zeros((2, 6))
    motion[:, 5] = 3.0, -3.0
    assert not findings(free, time, {"vessel_motion": motion}, {})


def test_the_second_hull_is_judged_too() -> None:
    scene = moored()
    scene.add_vessel(shipped_database(), name="barge", position=(0.0, 80.0, 0.0))
    righting = float(np.asarray(scene.vessels["barge"].restoring)[3, 3])
    scene.add_point_force(
        name="weight", body="barge", point=(0.0, 20.0, 0.0), force=(0.0, 0.0, -0.5 * righting / 20.0)
    )
    _, found = told(scene, t_end=60.0)
    assert "'barge': roll reaches" in found[LargeHeelWarning]
    assert found[NoWaveLoadsWarning].startswith("vessel 'barge': floats in the sea that loads 'hull'")
    scene.add_sea(vessel="barge")
    assert NoWaveLoadsWarning not in told(scene, t_end=10.0)[1]


def test_the_peak_is_found_from_the_components() -> None:
    scene = Scene(name="peak")
    scene.add_vessel(shipped_database())
    for tp in (7.0, 10.0, 14.0):
        scene.waves = None
        scene.add_sea(hs=2.0, tp=tp, count=200)
        assert scene.waves is not None
        assert peak_frequency(scene.waves) == pytest.approx(2.0 * np.pi / tp, rel=0.1)
    scene.waves = None
    scene.add_sea(hs=2.0, count=1)
    assert scene.waves is not None
    assert peak_frequency(scene.waves) == pytest.approx(float(scene.waves.omega[0]), rel=1e-12)
