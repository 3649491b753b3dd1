"""Vessels that leave the place, the heading, the speed or the mooring that their loads hold for are named."""

from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np
import pytest

from seacrane import Result, Scene, simulate
from seacrane.analysis.hull_range import LARGEST_PHASE, slowly
from seacrane.analysis.left_range import findings
from seacrane.description.outline import ship_size
from seacrane.hydro import SpherePart, shipped_database
from seacrane.inputs.frames import rotation_about_z
from seacrane.run import Run
from seacrane.warnings import (
    ForwardSpeedWarning,
    LargeHeelWarning,
    MeanPositionWarning,
    MooringTurnWarning,
    NoWaveLoadsWarning,
    ScatteredWavesWarning,
)

G = 9.80665


def moored(*, hs: float = 1.0, **vessel: Any) -> Scene:
    scene = Scene(name="moored")
    scene.add_vessel(shipped_database(), name="hull", **vessel)
    if hs:
        scene.add_sea(vessel="hull", hs=hs, tp=8.0, direction_deg=0.0, count=40)
    return scene


def told(scene: Scene, **settings: Any) -> tuple[Result, dict[type[Warning], str]]:
    with warnings.catch_warnings(record=True, action="always") as caught:
        result = simulate(scene, **{"t_end": 200.0, "dt_out": 0.5, **settings})
    return result, {w.category: str(w.message) for w in caught}


def stiffness(scene: Scene) -> Any:
    return np.asarray(scene.vessels["hull"].mooring_stiffness)


def test_a_drift_along_the_waves_beyond_the_phase_warns_and_across_them_does_not() -> None:
    allowed = LARGEST_PHASE / ((2.0 * np.pi / 8.0) ** 2 / G)
    for along, across, expected in ((0.6, 0.0, False), (2.0, 0.0, True), (0.0, 2.0, False)):
        scene = moored()
        # A force that comes at once, and follows the hull, overshoots to twice its displacement less damping.
        push = 0.6 * allowed * np.array([along, across, 0.0]) * stiffness(scene)
        scene.add_force("hull", name="tug", force=push, body_axes=True)
        result, found = told(scene)
        assert set(found) == ({MeanPositionWarning} if expected else set())
        if expected:
            assert str(result.stats["validity"]) == found[MeanPositionWarning]


def test_motions_of_wave_frequency_are_no_drift_and_slow_ones_pass_the_low_pass() -> None:
    scene = moored()
    time = np.arange(0.0, 1000.0, 0.5)
    motion = np.zeros((time.size, 6))
    motion[:, 0] = 8.0 * np.sin(2.0 * np.pi / 8.0 * time)
    motion[:, 5] = np.radians(15.0) * np.sin(2.0 * np.pi / 7.0 * time)
    assert not findings(scene, time, {"vessel_motion": motion}, {})
    within = slowly(time, motion, 8.0)[40:-40]  # at its ends a run has half the outputs to take means of
    assert np.abs(within[:, 0]).max() < 0.05 * 8.0 and np.abs(within[:, 5]).max() < 0.05 * np.radians(15.0)
    values = np.sin(2.0 * np.pi / 200.0 * time)[:, None]
    assert np.abs(slowly(time, values, 8.0)).max() == pytest.approx(1.0, abs=0.03)


def test_a_ship_under_way_warns_of_its_place_and_of_its_speed() -> None:
    scene = moored(hs=0.0, mooring=None)
    scene.replace("hull", kind="body", velocity=(5.0, 0.0, 0.0))
    assert not told(scene, t_end=60.0)[1]
    scene.add_sea(vessel="hull", hs=1.0, count=40)
    result, found = told(scene, t_end=60.0)
    assert result["vessel_motion"][-1, 0] > 100.0
    assert set(found) >= {MeanPositionWarning, ForwardSpeedWarning}
    scene.waves = None
    scene.add_sea(vessel="hull", hs=1.0, count=40, phase="actual")
    assert set(told(scene, t_end=60.0)[1]) == {ForwardSpeedWarning}


def test_a_hull_that_turns_beyond_its_mooring_warns() -> None:
    """A steady moment beyond the spring's at half a turn: it turns for ever."""
    for share, expected in ((0.4, False), (1.3, True)):
        scene = moored(hs=0.0)
        lever = 40.0
        force = 0.5 * share * np.pi * float(stiffness(scene)[2]) / lever
        for side in (1.0, -1.0):  # a couple
            at = {"point": (side * lever, 0.0, 0.0), "force": (0.0, side * force, 0.0), "body_axes": True}
            scene.add_force("hull", name=f"thruster {side:+.0f}", **at)
        _, found = told(scene, t_end=400.0)
        assert (MooringTurnWarning in found) == expected


def test_the_second_hull_is_judged_too() -> None:
    scene = moored()
    scene.add_vessel(shipped_database(), name="barge", position=(0.0, 80.0, 0.0))
    righting = float(np.asarray(scene.vessels["barge"].restoring)[3, 3])
    scene.add_force("barge", name="weight", point=(0.0, 20.0, 0.0), force=(0.0, 0.0, -0.5 * righting / 20.0))
    _, found = told(scene, t_end=60.0)
    assert "'barge': roll reaches" in found[LargeHeelWarning]
    assert NoWaveLoadsWarning in found


def lowered(
    *, y: float, x: float = 0.0, z: float = -3.0, hs: float | None = 2.0, heading: float = 0.0, **more: Any
) -> Scene:
    """A load in the water beside the shipped hull, y and x in her axes."""
    scene = Scene(name="lowered")
    scene.add_vessel(shipped_database(), position=(40.0, -20.0, 0.0), heading_deg=heading)
    if hs is not None:
        scene.add_sea(hs=hs, tp=9.0, direction_deg=150.0, seed=2)
    place = rotation_about_z(np.radians(heading)) @ [x, y, z] + [40.0, -20.0, 0.0]
    scene.add_body(name="load", mass=9e3, inertia=(9e3, 9e3, 9e3), position=place)
    parts = [SpherePart(diameter=2.0, point=(0.0, 0.0, dz)) for dz in (0.0, 4.0)]
    scene.add_immersed("load", parts=parts, **more)
    return scene


def scattered(scene: Scene) -> list[str]:
    with warnings.catch_warnings(record=True, action="always") as caught:
        Run(scene, 1.0)
    return [str(one.message) for one in caught if one.category is ScatteredWavesWarning]


BREADTH = ship_size(lowered(y=50.0).bodies["vessel"])[1]


def test_a_part_within_a_breadth_is_told_with_both_lengths() -> None:
    (message,) = scattered(lowered(y=-(0.5 * BREADTH + 6.0), heading=65.0))
    away, across = (float(one) for one in re.findall(r"(\S+) m\b", message)[:2])
    assert away == pytest.approx(6.0, abs=0.01)
    assert across == pytest.approx(BREADTH, rel=1e-2)


@pytest.mark.parametrize(
    ("place", "near"),
    [
        ({"y": 1.45}, True),  # of the breadth, from the centre plane
        ({"y": 1.55}, False),
        ({"y": 1.45, "hs": None}, False),
        ({"y": 0.0, "x": 1000.0}, False),
        ({"y": 1.0, "z": -200.0}, False),  # where hardly a wave is left
    ],
)
def test_it_is_told_where_it_counts(place: dict[str, Any], near: bool) -> None:
    given = {**place, "y": place["y"] * BREADTH}
    assert bool(scattered(lowered(**given))) == near


def test_a_factor_that_is_stated_is_not_told_and_multiplies_the_waves() -> None:
    """Half of the waves twice is the waves: a load far from all hulls, in a linear sea."""
    assert not scattered(lowered(y=0.0, wave_factor=1.3))
    half, whole = (
        simulate(lowered(y=500.0, hs=hs, wave_factor=factor), 5.0, channels=["position"], rtol=1e-9)
        for hs, factor in ((4.0, 0.5), (2.0, 1.0))
    )
    one, other = (run.select("position", body="load") for run in (half, whole))
    assert one == pytest.approx(other, abs=1e-7)
