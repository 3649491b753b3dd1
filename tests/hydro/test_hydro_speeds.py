"""Forward speed: several speeds in VERES files, matrices by encounter frequency, closure at speed.

No file of a moving ship is at hand: the sets are written from the documented layout, with the speed terms of
strip theory, and their motions are solved exactly at the encounter frequencies.
"""

from __future__ import annotations

import dataclasses
import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from veres_writer import BOTH, MASS, VeresRun, added_mass, damping

import seacrane
from seacrane.cli import main
from seacrane.errors import FileFormatError
from seacrane.hydro import (
    HydroDatabase,
    available_speeds,
    fit_memory,
    load_database,
    motion_response,
    read_veres,
    vessel_parameters,
)
from seacrane.hydro.data.encounter import encounter_frequency, wavenumber
from seacrane.warnings import EncounterFrequencyWarning, PartialSetWarning, SeveralSpeedsWarning

G = 9.81


def closure(database: HydroDatabase) -> dict[str, float]:
    """The motion rows of the self-check."""
    return {row.check: row.value for row in database.check() if row.check.startswith("motion_rao")}


@pytest.fixture(scope="module")
def moving(tmp_path_factory: pytest.TempPathFactory) -> HydroDatabase:
    """A ship at 5 m/s."""
    return read_veres(VeresRun(speeds=(5.0,)).write(tmp_path_factory.mktemp("moving")))


def test_the_speed_nearest_zero_is_read_with_a_warning(tmp_path: Path) -> None:
    run = VeresRun(speeds=(4.0, -1.0, 8.0), omega=np.linspace(0.2, 2.4, 9))
    stem = run.write(tmp_path)
    assert available_speeds(stem) == available_speeds(tmp_path) == (-1.0, 4.0, 8.0)
    with pytest.warns(SeveralSpeedsWarning, match=r"speeds -1, 4, 8 m/s; -1 m/s is read") as caught:
        database = seacrane.load_database(stem)
    assert caught[0].filename == __file__  # the caller's line, not one of ours
    assert database.speed == -1.0


def test_a_chosen_speed_is_read_without_a_warning(tmp_path: Path) -> None:
    run = VeresRun(speeds=(0.0, 4.0), omega=np.linspace(0.2, 2.4, 9))
    stem = run.write(tmp_path)
    beam = int(np.flatnonzero(run.heading_deg == 90.0)[0])
    for speed in run.speeds:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            database = load_database(stem, speed=speed)
        assert database.speed == speed
        assert np.array_equal(database.added_mass, run.matrices(speed)[0][beam] * BOTH)
        assert np.array_equal(database.damping, run.matrices(speed)[1][beam] * BOTH)
        assert database.drift is not None
        head = int(np.argmin(np.abs(database.drift.heading - np.pi)))
        assert database.drift.coefficient[head, 0, 5] == pytest.approx(
            (speed + 0.3) * database.rho * database.g * database.breadth**2
        )


@pytest.mark.parametrize("speed", [3.0, float("nan"), float("inf")])
def test_a_speed_that_is_not_there_is_named(speed: float, tmp_path: Path) -> None:
    stem = VeresRun(speeds=(0.0, 4.0), omega=np.linspace(0.2, 2.4, 5)).write(tmp_path)
    with pytest.raises(FileFormatError, match=rf"no speed {speed:g} m/s; the files hold 0, 4 m/s"):
        load_database(stem, speed=speed)


@pytest.mark.filterwarnings("ignore::seacrane.warnings.EncounterFrequencyWarning")  # five frequencies only
def test_speeds_that_are_not_in_every_file(tmp_path: Path) -> None:
    run = VeresRun(speeds=(0.0, 4.0, 8.0), omega=np.linspace(0.2, 2.4, 5))
    stem = run.write(tmp_path, leave_out={".re8": [8.0], ".re2": [0.0]})
    with pytest.warns(PartialSetWarning, match=r"speeds 0, 8 m/s are not in every file .* ones, 4 m/s"):
        assert load_database(stem).speed == 4.0
    run.write(tmp_path, leave_out={".re8": [0.0, 8.0], ".re7": [4.0]})
    with pytest.raises(FileFormatError, match=r"no speed is in every file \(box.re7: 0, 8 m/s; box.re8: 4"):
        load_database(stem)


@pytest.mark.filterwarnings("ignore::seacrane.warnings.EncounterFrequencyWarning")
def test_a_speed_that_files_print_with_other_digits_is_listed_once(tmp_path: Path) -> None:
    """Knots in m/s: seven digits in .re1 and .re8, five decimals in .re2."""
    run = VeresRun(speeds=(0.0, 5.1444446, 10.288889), omega=np.linspace(0.2, 2.4, 5))
    stem = run.write(tmp_path, leave_out={".re7": [5.1444446, 10.288889]})
    with pytest.warns(PartialSetWarning, match=r"speeds 5\.14444, 10\.2889 m/s are not in every file"):
        assert load_database(stem).speed == 0.0
    assert available_speeds(stem) == (0.0,)


def test_a_speed_given_twice(tmp_path: Path) -> None:
    stem = VeresRun(speeds=(4.0, 4.0), omega=np.linspace(0.2, 2.4, 5)).write(tmp_path)
    with pytest.raises(FileFormatError, match=r"box\.re7: speed 4 m/s is given twice"):
        load_database(stem)


@pytest.mark.parametrize("speed", [2.0, 5.0, -3.0])
def test_motions_close_at_speed(speed: float, tmp_path: Path) -> None:
    """Head sea to overtaken following sea, by splines through 51 frequencies."""
    database = read_veres(VeresRun(speeds=(speed,)).write(tmp_path))
    assert max(closure(database).values()) < 1e-5
    assert len(closure(database)) == 6
    encounter = encounter_frequency(database)
    assert (encounter.min() < 0.0) == (speed == 5.0)  # waves that the ship overtakes


def test_closure_notices_the_wrong_frequency(moving: HydroDatabase) -> None:
    """Half the speed, or the speed astern, or next to none: the file's motions are missed by far."""
    for speed in (1e-3, 2.5, -5.0):
        wrong = dataclasses.replace(moving, speed=speed)
        assert closure(wrong)["motion_rao_heave"] > 0.1
    assert closure(moving)["motion_rao_heave"] < 1e-5


def test_motions_outside_the_table_are_unknown_and_left_out(moving: HydroDatabase) -> None:
    solved, encounter = motion_response(moving), np.abs(encounter_frequency(moving))
    outside = (encounter > moving.omega[-1] * (1 + 1e-9)) | (encounter < moving.omega[0] * (1 - 1e-9))
    assert 0.1 < outside.mean() < 0.5
    assert np.array_equal(np.isnan(solved[:, :, 0]), outside)
    assert all(np.isfinite(row.value) for row in moving.check())


def test_the_self_check_leaves_out_what_speed_does_not_obey(moving: HydroDatabase) -> None:
    rows = {row.check: row for row in moving.check()}
    assert rows["symmetry_added_mass"].verdict == "info"
    assert rows["symmetry_added_mass"].value > 0.03  # the terms of opposite sign
    assert not any(name.startswith(("memory", "damping_from_forces")) for name in rows)


def test_without_a_beam_sea_the_headings_are_joined(tmp_path: Path) -> None:
    run = VeresRun(speeds=(2.0,), heading_deg=np.array([0.0, 30.0, 60.0, 120.0, 150.0, 180.0]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        database = read_veres(run.write(tmp_path))
    trusted = (database.omega > 0.3) & (database.omega < 2.6)
    for found, exact in (
        (database.added_mass, added_mass(database.omega, 2.0) * BOTH),
        (database.damping, damping(database.omega, 2.0) * BOTH),
    ):
        size = np.sqrt(np.diagonal(exact, axis1=1, axis2=2).max(axis=0))
        assert (np.abs(found - exact)[trusted] / np.outer(size, size)).max() < 2e-3
    assert max(closure(database).values()) < 1e-3


def test_a_range_that_no_heading_covers_is_named(tmp_path: Path) -> None:
    run = VeresRun(speeds=(5.0,), heading_deg=np.array([0.0, 30.0]))
    with pytest.warns(EncounterFrequencyWarning, match=r"cover encounter frequencies 0\.1599 to .*beam sea"):
        database = read_veres(run.write(tmp_path))
    assert np.all(np.isfinite(database.added_mass))


def test_headings_that_disagree_are_named(tmp_path: Path) -> None:
    run = VeresRun(speeds=(5.0,), heading_error=0.1)
    with pytest.warns(
        EncounterFrequencyWarning, match=r"differ at the same encounter frequency by up to 2\d"
    ):
        read_veres(run.write(tmp_path))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        VeresRun(speeds=(5.0,), heading_error=0.001).write(tmp_path)
        read_veres(tmp_path)


def test_the_time_domain_refuses_forward_speed(moving: HydroDatabase) -> None:
    for use in (
        lambda: vessel_parameters(moving),
        lambda: fit_memory(database=moving),
        lambda: seacrane.cases.vessel(database=moving),
    ):
        with pytest.raises(ValueError, match=r"forward speed 5 m/s; .* read the database with speed=0"):
            use()


def test_saved_and_read_back(moving: HydroDatabase, tmp_path: Path) -> None:
    moving.save(tmp_path / "moving.nc")
    assert available_speeds(tmp_path / "moving.nc") == (5.0,)
    again = load_database(tmp_path / "moving.nc", speed=5.0)
    assert np.array_equal(motion_response(again), motion_response(moving), equal_nan=True)
    with pytest.raises(FileFormatError, match="of 5 m/s, not of speed 0 m/s"):
        load_database(tmp_path / "moving.nc", speed=0.0)


@pytest.mark.slow("a real ship")
def test_command_line_reports_a_moving_ship(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    stem = VeresRun(speeds=(3.0,)).write(tmp_path)
    assert main(["hydro", str(stem), "--json", "--out", str(tmp_path / "out")]) == 0
    table = {row["check"]: row for row in json.loads(capsys.readouterr().out)}
    assert table["motion_rao_pitch"]["verdict"] == "pass"
    assert (tmp_path / "out" / "motion.png").is_file()


@pytest.mark.parametrize("depth", [8.0, 50.0, 500.0])
def test_wavenumber_satisfies_the_dispersion_relation(depth: float) -> None:
    omega = np.linspace(0.1, 3.0, 30)
    k = wavenumber(omega, g=G, depth=depth)
    assert G * k * np.tanh(k * depth) == pytest.approx(omega**2, rel=1e-12)


def test_encounter_frequency_of_head_and_following_sea(moving: HydroDatabase) -> None:
    """Ours: 180 deg is a head sea, which is met more often."""
    w = moving.omega
    found = encounter_frequency(moving)
    of: dict[float, Any] = {180.0: w + 5.0 * w**2 / G, 0.0: w - 5.0 * w**2 / G, 270.0: w}
    for degrees, expected in of.items():
        place = int(np.argmin(np.abs(moving.heading - np.radians(degrees))))
        assert found[place] == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("version", [1, 2])
def test_versions_of_re7(version: int, tmp_path: Path) -> None:
    run = VeresRun(version=version, omega=np.linspace(0.2, 2.4, 6))
    database = read_veres(run.write(tmp_path))
    assert np.array_equal(database.mass_matrix, MASS)
    assert database.additional == ()
    assert max(closure(database).values()) < 1e-12
