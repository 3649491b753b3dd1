"""Forward speed: several speeds in VERES files, matrices by encounter frequency, closure at speed.

No file of a moving ship is at hand: the sets are written from the documented layout, with the speed terms of
strip theory, and their motions are solved exactly at the encounter frequencies.
"""

from __future__ import annotations

import dataclasses
import warnings
from pathlib import Path

import numpy as np
import pytest
from veres_writer import BOTH, MASS, RESTORING, ROLL, TO_FILE, VeresRun, added_mass, damping

import seacrane
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
from seacrane.hydro.data.encounter import encounter_frequency
from seacrane.warnings import EncounterFrequencyWarning, PartialSetWarning, SeveralSpeedsWarning

G = 9.81


def closure(database: HydroDatabase) -> dict[str, float]:
    """The motion rows of the self-check."""
    return {row.check: row.value for row in database.check() if row.check.startswith("motion_rao")}


def written(folder: Path, *speeds: float, count: int = 5, **leave_out: list[float]) -> Path:
    run = VeresRun(speeds=speeds, omega=np.linspace(0.2, 2.4, count))
    return run.write(folder, leave_out={f".{suffix}": values for suffix, values in leave_out.items()})


@pytest.mark.filterwarnings("ignore::seacrane.warnings.EncounterFrequencyWarning")  # five frequencies only
def test_one_of_several_speeds_is_read(tmp_path: Path) -> None:
    stem = written(tmp_path, 4.0, -1.0, 8.0, count=9)
    assert available_speeds(stem) == available_speeds(tmp_path) == (-1.0, 4.0, 8.0)
    with pytest.warns(SeveralSpeedsWarning, match=r"speeds -1, 4, 8 m/s; -1 m/s is read"):
        assert load_database(stem).speed == -1.0
    written(tmp_path, 0.0, 4.0)
    with pytest.raises(FileFormatError, match="no speed 3 m/s; the files hold 0, 4 m/s"):
        load_database(stem, speed=3.0)
    written(tmp_path, 0.0, 4.0, 8.0, re8=[8.0], re2=[0.0])
    with pytest.warns(PartialSetWarning, match=r"speeds 0, 8 m/s are not in every file .* ones, 4 m/s"):
        assert load_database(stem).speed == 4.0
    # Knots in m/s: seven digits in .re1 and .re8, five decimals in .re2.
    written(tmp_path, 0.0, 5.1444446, 10.288889, re7=[5.1444446, 10.288889])
    with pytest.warns(PartialSetWarning, match=r"speeds 5\.14444, 10\.2889 m/s are not in every file"):
        assert load_database(stem).speed == 0.0
    written(tmp_path, 4.0, 4.0)
    with pytest.raises(FileFormatError, match=r"box\.re7: speed 4 m/s is given twice"):
        load_database(stem)


@pytest.mark.parametrize("version", [1, 2])
def test_what_was_written_comes_back(version: int, tmp_path: Path) -> None:
    """In our axes and order of headings, to the bit, of the speed that is chosen; at rest it closes."""
    run = VeresRun(speeds=(0.0, 4.0), version=version, omega=np.linspace(0.2, 2.4, 9))
    stem = run.write(tmp_path)
    beam = int(np.flatnonzero(run.heading_deg == 90.0)[0])
    order = np.argsort((run.heading_deg + 180.0) % 360.0)
    for speed in run.speeds:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found = load_database(stem, speed=speed)
        assert found.speed == speed and found.additional == ()
        assert np.degrees(found.heading) == pytest.approx(((run.heading_deg + 180.0) % 360.0)[order])
        for mine, file in zip((found.added_mass, found.damping), run.matrices(speed), strict=True):
            assert np.array_equal(mine, file[beam] * BOTH)
        assert np.array_equal(found.mass_matrix, MASS) and np.array_equal(found.restoring, RESTORING)
        assert np.array_equal(found.force, (run.force() * TO_FILE)[order])
        assert np.array_equal(found.motion_rao, (run.motion(speed) * TO_FILE)[order])
        assert np.array_equal(found.roll_damping.quadratic, np.full(9, ROLL[1]))
        assert "1.5 m aft of midship" in found.origin
        head = int(np.argmin(np.abs(found.drift.heading - np.pi)))
        load = (speed + 0.3) * found.rho * found.g * found.breadth**2
        assert found.drift.coefficient[head, 0, 5] == pytest.approx(load)
    still = load_database(stem, speed=0.0).select(every=2)  # too few for a memory
    assert max(closure(still).values()) < 1e-12


@pytest.mark.parametrize("speed", [2.0, 5.0, -3.0])
def test_motions_close_at_speed(speed: float, tmp_path: Path) -> None:
    """Head sea to overtaken following sea, by splines through 51 frequencies, and not at another speed."""
    database = read_veres(VeresRun(speeds=(speed,)).write(tmp_path))
    assert len(closure(database)) == 6 and max(closure(database).values()) < 1e-5
    encounter = encounter_frequency(database)
    assert (encounter.min() < 0.0) == (speed == 5.0)  # waves that the ship overtakes
    w = database.omega
    # Ours: 180 deg is a head sea, which is met more often.
    for degrees, expected in ((180.0, w + speed * w**2 / G), (0.0, w - speed * w**2 / G), (270.0, w)):
        place = int(np.argmin(np.abs(database.heading - np.radians(degrees))))
        assert encounter[place] == pytest.approx(expected, rel=1e-12)
    if speed == 5.0:
        for other in (1e-3, 2.5, -5.0):
            assert closure(dataclasses.replace(database, speed=other))["motion_rao_heave"] > 0.1


def test_what_forward_speed_leaves_unknown_or_forbids(tmp_path: Path) -> None:
    moving = read_veres(VeresRun(speeds=(5.0,)).write(tmp_path))
    solved, encounter = motion_response(moving), np.abs(encounter_frequency(moving))
    outside = (encounter > moving.omega[-1] * (1 + 1e-9)) | (encounter < moving.omega[0] * (1 - 1e-9))
    assert 0.1 < outside.mean() < 0.5
    assert np.array_equal(np.isnan(solved[:, :, 0]), outside)
    rows = {row.check: row for row in moving.check()}
    assert all(np.isfinite(row.value) for row in rows.values())
    assert rows["symmetry_added_mass"].verdict == "info"
    assert rows["symmetry_added_mass"].value > 0.03  # the terms of opposite sign
    assert not any(name.startswith(("memory", "damping_from_forces")) for name in rows)
    for use in (vessel_parameters, fit_memory, seacrane.cases.vessel):
        with pytest.raises(ValueError, match=r"forward speed 5 m/s; .* speed=0"):
            use(database=moving)


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


def test_headings_that_disagree_or_leave_a_range_out_are_named(tmp_path: Path) -> None:
    for given, message in (
        ({"heading_error": 0.1}, r"same encounter frequency by up to 2\d"),
        ({"heading_deg": np.array([0.0, 30.0])}, r"cover encounter frequencies 0\.1599 to .*beam sea"),
    ):
        with pytest.warns(EncounterFrequencyWarning, match=message):
            found = read_veres(VeresRun(speeds=(5.0,), **given).write(tmp_path))
        assert np.all(np.isfinite(found.added_mass))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read_veres(VeresRun(speeds=(5.0,), heading_error=0.001).write(tmp_path))
