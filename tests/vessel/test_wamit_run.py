"""Runs on a real ship's WAMIT files: regular waves return the motions that WAMIT wrote."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from test_vessel import complex_amplitude, regular_wave

from seacrane import cases, load_database, simulate
from seacrane.hydro import HydroDatabase

AMPLITUDE = 1e-4  # m
T_END = 1500.0  # s: the tanker's slowest memory and motions have decayed
POINTS = [(135.0, 0.45), (135.0, 0.60), (90.0, 0.70), (160.0, 0.35)]  # deg and rad/s


@pytest.fixture(scope="module")
def tanker(shared: Path) -> HydroDatabase:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return load_database(shared / "wamit")


@pytest.mark.parametrize(("heading_deg", "omega"), POINTS)
def test_regular_wave_returns_the_files_motion(
    tanker: HydroDatabase, heading_deg: float, omega: float
) -> None:
    """Springs off; by convolution, which has no fit, so that what is left is the files' own 1 %."""
    heading = int(np.argmin(np.abs(np.degrees(tanker.heading) - heading_deg)))
    frequency = int(np.argmin(np.abs(tanker.omega - omega)))
    at = float(tanker.omega[frequency])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scene = cases.vessel(database=tanker, hs=0.0, mooring_period=None, memory="convolution")
    scene.waves = regular_wave(
        tanker,
        omega=at,
        heading_deg=float(np.degrees(tanker.heading[heading])),
        amplitude=AMPLITUDE,
        phase=0.3,
    )
    period = 2.0 * np.pi / at
    run = simulate(scene, t_end=T_END, dt_out=period / 16.0, rtol=1e-9, channels=["vessel_motion"])
    found = complex_amplitude(run, at, start=T_END - 6.0 * period) / (AMPLITUDE * np.exp(0.3j))
    assert tanker.motion_rao is not None
    source = tanker.motion_rao[heading, frequency]
    largest = np.abs(tanker.motion_rao[:, frequency]).max(axis=0)
    np.testing.assert_array_less(np.abs(found - source), 0.01 * largest)
