"""Currents that change the waves a vessel meets are named."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from seacrane import FlowCoefficients, Scene, simulate
from seacrane.hydro import shipped_database
from seacrane.warnings import CurrentInWavesWarning

ALONG = FlowCoefficients(angle=[0.0, np.pi / 2, np.pi], x=[0.6, 0.0, -0.6], y=[0, 0.8, 0], yaw=[0, 0, 0])
PEAK_SPEED = 9.80665 * 8.0 / (2.0 * np.pi)  # m/s, of waves of 8 s: k U / w is U by it


def told(*, speed: float, direction_deg: float, density: float = 1025.0) -> list[str]:
    scene = Scene(name="in a current")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_sea(hs=0.5, tp=8.0, direction_deg=0.0, count=40, seed=1)
    flow = scene.add_wind if density < 500.0 else scene.add_current
    flow(
        coefficients=ALONG, speed=speed, direction_deg=direction_deg, frontal_area=100.0, lateral_area=500.0,
        length=115.0, density=density,
    )  # fmt: skip
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        simulate(scene, t_end=1.0)
    return [str(one.message) for one in seen if one.category is CurrentInWavesWarning]


@pytest.mark.parametrize("direction_deg", [0.0, 180.0])
def test_a_current_along_the_waves_is_named_from_a_tenth_on(direction_deg: float) -> None:
    assert not told(speed=0.08 * PEAK_SPEED, direction_deg=direction_deg)
    (message,) = told(speed=0.14 * PEAK_SPEED, direction_deg=direction_deg)
    assert "vessel 'vessel'" in message and "current 'current'" in message


def test_a_current_across_the_waves_and_wind_are_not() -> None:
    assert not told(speed=0.2 * PEAK_SPEED, direction_deg=90.0)
    assert not told(speed=0.2 * PEAK_SPEED, direction_deg=0.0, density=1.225)
