"""A run on a real ship's VERES files: regular waves return its motions within the memory fit's error."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from test_vessel import complex_amplitude, impedance, regular_wave

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
    assert database.roll_damping is not None
    value = database.roll_damping.linear[frequency] + database.roll_damping.linearised[heading, frequency]
    n, m = len(database.omega), len(database.heading)
    roll = RollDamping(linear=np.full(n, value), quadratic=np.zeros(n), linearised=np.zeros((m, n)))
    return replace(database, roll_damping=roll)


def simulated_rao(database: HydroDatabase, scene: Scene, heading: int, frequency: int) -> Complex:
    omega = float(database.omega[frequency])
    period = 2.0 * np.pi / omega
    scene.waves = regular_wave(
        database, omega=omega, heading_deg=float(np.degrees(database.heading[heading])), amplitude=AMPLITUDE,
        phase=0.3,
    )  # fmt: skip
    run = simulate(scene, t_end=800.0, dt_out=period / 16.0, rtol=1e-11, channels=["vessel_motion"])
    return complex_amplitude(run, omega, start=800.0 - 6.0 * period) / (AMPLITUDE * np.exp(0.3j))


def fitted_rao(database: HydroDatabase) -> Complex:
    memory = vessel_parameters(database).memory
    added_mass, damping = memory.frequency_response(database.omega)
    more_mass, more_damping = memory.additional_response(database.omega)
    return motion_response(database, added_mass=added_mass + more_mass, damping=damping + more_damping)


@pytest.mark.warns("InfiniteFrequencyWarning")
@pytest.mark.slow("other runs in waves keep theirs by day")
def test_irregular_run_keeps_its_books(shared: Path) -> None:
    run = simulate(cases.vessel(database=shared / "veres" / "supply"))
    assert run.time[-1] == 100.0
    assert run.stats["memory_states"] > 30
    assert np.all(np.isfinite(run["vessel_motion"]))
    assert 0.3 < np.ptp(run["vessel_motion"][:, 2]) < 4.0
    assert np.max(np.abs(run["energy_balance"])) < 1e-6 * run["absolute_work"][-1]


@pytest.mark.parametrize(("heading", "frequency"), POINTS)  # of the file
def test_regular_wave_returns_the_files_motion(supply: HydroDatabase, heading: int, frequency: int) -> None:
    """The run is on the fitted frequency-domain solution; its distance from the file is the fit's."""
    database = at_file_damping(supply, heading, frequency)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", InfiniteFrequencyWarning)
        scene = cases.vessel(database=database, hs=0.0, mooring_period=None)
    found = simulated_rao(database, scene, heading, frequency)
    assert supply.motion_rao is not None
    source, fit = supply.motion_rao[heading, frequency], fitted_rao(database)[heading, frequency]
    np.testing.assert_array_less(np.abs(found - fit), 1e-3 * np.abs(fit) + 1e-9)
    np.testing.assert_array_less(np.abs(found - source), np.abs(fit - source) + 1e-3 * np.abs(source) + 1e-9)
    # The fit was asked for R2 = 0.99, 10 % of rms; roll, with its tanks, shows most of it.
    np.testing.assert_array_less(np.abs(fit - source) / np.abs(source), [0.01, 0.02, 0.09, 0.12, 0.02, 0.03])


@pytest.mark.warns("InfiniteFrequencyWarning")
@pytest.mark.slow("long regular waves")
def test_run_agrees_with_the_impedance_of_its_own_scene(supply: HydroDatabase) -> None:
    """With station keeping and the roll tanks' static stiffness and memory in the model."""
    database = at_file_damping(supply, 5, 20)
    scene = cases.vessel(database=database, hs=0.0, mooring_period=60.0)
    found = simulated_rao(database, scene, 5, 20)
    omega = database.omega[20:21]
    expected = np.linalg.solve(impedance(database, scene, omega)[0], database.force[5, 20])
    np.testing.assert_array_less(np.abs(found - expected), 1e-3 * np.abs(expected))


@pytest.mark.warns("InfiniteFrequencyWarning")
def test_roll_without_the_tanks_would_be_wrong(supply: HydroDatabase) -> None:
    """PITFALLS: dropping the additional matrices changes roll by several times; the run must hold them."""
    index = int(np.argmax(np.abs(supply.motion_rao[5, :, 3]))) if supply.motion_rao is not None else 0
    database = at_file_damping(supply, 5, index)
    with_tanks = np.abs(fitted_rao(database)[5, index, 3])
    bare = replace(database, additional=(), memory=None)
    scene = cases.vessel(database=bare, hs=0.0, mooring_period=None)
    without = np.abs(simulated_rao(bare, scene, 5, index)[3])
    assert abs(without - with_tanks) > 0.2 * with_tanks
