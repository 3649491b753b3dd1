"""Runs on real ships' files: regular waves return the motions of VERES, to the fit's error, and of WAMIT."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from test_vessel import complex_amplitude, regular_wave

from seacrane import Scene, cases, load_database, simulate
from seacrane.hydro import HydroDatabase, fit_memory, vessel_parameters
from seacrane.hydro.data.hydro_data import RollDamping
from seacrane.hydro.data.motion import motion_response
from seacrane.warnings import InfiniteFrequencyWarning

Complex = NDArray[np.complex128]
AMPLITUDE = 1e-4  # m: adrift the heading wanders in proportion
SLOW = pytest.mark.slow("a long regular wave; one of them runs by day")
POINTS = [(7, 26), *(pytest.param(*at, marks=SLOW) for at in ((5, 10), (5, 20), (13, 14), (16, 29)))]


@pytest.fixture(scope="module")
def supply(shared: Path) -> HydroDatabase:
    """With its memory per pair, as `cases` take it."""
    database = load_database(shared / "veres" / "supply")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", InfiniteFrequencyWarning)
        return replace(database, memory=fit_memory(database=database, kind="per-pair"))


def at_file_damping(database: HydroDatabase, heading: int, frequency: int) -> HydroDatabase:
    """The database with the linear and linearised roll damping that the file's motions hold at one point."""
    value = database.roll_damping.linear[frequency] + database.roll_damping.linearised[heading, frequency]
    n, m = len(database.omega), len(database.heading)
    roll = RollDamping(linear=np.full(n, value), quadratic=np.zeros(n), linearised=np.zeros((m, n)))
    return replace(database, roll_damping=roll)


def simulated_rao(
    database: HydroDatabase, scene: Scene, heading: int, frequency: int, *, t_end: float = 800.0,
    rtol: float = 1e-11,
) -> Complex:  # fmt: skip
    omega = float(database.omega[frequency])
    period = 2.0 * np.pi / omega
    scene.waves = regular_wave(
        database, omega=omega, heading_deg=float(np.degrees(database.heading[heading])), amplitude=AMPLITUDE,
        phase=0.3,
    )  # fmt: skip
    run = simulate(scene, t_end=t_end, dt_out=period / 16.0, rtol=rtol, channels=["vessel_motion"])
    return complex_amplitude(run, omega, start=t_end - 6.0 * period) / (AMPLITUDE * np.exp(0.3j))


def fitted_rao(database: HydroDatabase) -> Complex:
    memory = vessel_parameters(database).memory
    added_mass, damping = memory.frequency_response(database.omega)
    more_mass, more_damping = memory.additional_response(database.omega)
    return motion_response(database, added_mass=added_mass + more_mass, damping=damping + more_damping)


@pytest.mark.parametrize(("heading", "frequency"), POINTS)  # of the file
def test_regular_wave_returns_the_files_motion(supply: HydroDatabase, heading: int, frequency: int) -> None:
    """The run is on the fitted frequency-domain solution; its distance from the file is the fit's."""
    database = at_file_damping(supply, heading, frequency)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", InfiniteFrequencyWarning)
        scene = cases.vessel(database=database, hs=0.0, mooring_period=None)
    found = simulated_rao(database, scene, heading, frequency)
    source, fit = supply.motion_rao[heading, frequency], fitted_rao(database)[heading, frequency]
    np.testing.assert_array_less(np.abs(found - fit), 1e-3 * np.abs(fit) + 1e-9)
    np.testing.assert_array_less(np.abs(found - source), np.abs(fit - source) + 1e-3 * np.abs(source) + 1e-9)
    # The fit was asked for R2 = 0.99, 10 % of rms; roll, with its tanks, shows most of it.
    np.testing.assert_array_less(np.abs(fit - source) / np.abs(source), [0.01, 0.02, 0.09, 0.12, 0.02, 0.03])


@pytest.fixture(scope="module")
def tanker(shared: Path) -> HydroDatabase:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return load_database(shared / "wamit")


@pytest.mark.parametrize(("deg", "omega"), [(135.0, 0.45), (135.0, 0.60), (90.0, 0.70), (160.0, 0.35)])
def test_regular_wave_returns_wamits_motion(tanker: HydroDatabase, deg: float, omega: float) -> None:
    """Of the tanker, by convolution, which has no fit, so that what is left is the files' own 1 %."""
    heading = int(np.argmin(np.abs(np.degrees(tanker.heading) - deg)))
    frequency = int(np.argmin(np.abs(tanker.omega - omega)))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scene = cases.vessel(database=tanker, hs=0.0, mooring_period=None, memory="convolution")
    # Its slowest memory and motions decay in 1500 s.
    found = simulated_rao(tanker, scene, heading, frequency, t_end=1500.0, rtol=1e-9)
    largest = np.abs(tanker.motion_rao[:, frequency]).max(axis=0)
    np.testing.assert_array_less(np.abs(found - tanker.motion_rao[heading, frequency]), 0.01 * largest)
