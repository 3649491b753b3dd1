"""ShipX/VERES reader: values and conventions on a real ship's files, damage, forward speed.

No file of a moving ship is at hand: the sets are written from the documented layout, with the speed terms of
strip theory, and their motions are solved exactly at the encounter frequencies.
"""

from __future__ import annotations

import dataclasses
import json
import re
import shutil
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from veres_writer import BOTH, MASS, RESTORING, ROLL, TO_FILE, VeresRun, added_mass, damping

import seacrane
from seacrane.errors import FileFormatError
from seacrane.hydro import (
    HydroDatabase,
    VeresHydrostatics,
    available_speeds,
    fit_memory,
    load_database,
    motion_response,
    read_veres,
    read_veres_hydrostatics,
    vessel_parameters,
)
from seacrane.hydro.data.motion import encounter_frequency
from seacrane.warnings import (
    EncounterFrequencyWarning,
    HydrostaticsWarning,
    PartialSetWarning,
    SeveralSpeedsWarning,
)


@pytest.fixture(scope="module")
def supply(shared: Path) -> Path:
    return shared / "veres" / "supply"


@pytest.fixture(scope="module")
def expected(supply: Path) -> dict[str, Any]:
    return json.loads((supply / "expected.json").read_text())  # type: ignore[no-any-return]


@pytest.fixture(scope="module")
def database(supply: Path) -> HydroDatabase:
    """The supply vessel as our reader reads it; nothing about it warns."""
    return load_database(supply)


@pytest.fixture
def copy(supply: Path, tmp_path: Path) -> Path:
    for suffix in (".re1", ".re2", ".re7", ".re8", ".hyd"):
        shutil.copyfile(supply / f"input{suffix}", tmp_path / f"input{suffix}")
    return tmp_path


def of_heading(database: HydroDatabase, heading_deg: float) -> int:
    direction = np.radians(heading_deg + 180.0)
    distance = np.abs(np.angle(np.exp(1j * (database.heading - direction))))
    assert distance.min() < 1e-9
    return int(distance.argmin())


def test_header_and_matrices_are_the_reference_values(
    database: HydroDatabase, expected: dict[str, Any]
) -> None:
    head = expected["header"]
    assert (database.rho, database.g, database.speed) == (head["rho"], head["g"], 0.0)
    assert (database.length, database.breadth, database.draught) == (head["Lpp"], head["B"], head["T"])
    assert database.omega == pytest.approx(expected["omega"], rel=1e-12)
    assert len(database.heading) == head["nhead"]
    assert database.infinite_frequency_added_mass is None
    ours, raw = expected["xfwd_yport_zup"]["at_file_origin"], expected["raw_file_axes"]
    assert np.array_equal(database.mass_matrix, np.array(ours["M"]))
    assert np.array_equal(database.restoring, np.array(ours["C"]))
    for key, matrix in ours["A"].items():
        assert np.array_equal(database.added_mass[int(key)], np.array(matrix))
        assert np.array_equal(database.damping[int(key)], BOTH * np.array(raw["B"][key]))
    headings = len(database.heading)
    for name, table in (("A", database.added_mass), ("B", database.damping)):
        for key, value in ((f"sum_{name}", np.sum(table * BOTH)), (f"sum_abs_{name}", np.sum(np.abs(table)))):
            ratio = raw["A_checksum"][key] / value
            assert ratio == pytest.approx(1.0 if ratio < 2.0 else headings, rel=1e-12)
    (extra,) = database.additional  # kept apart, and of roll alone
    assert extra.added_mass[:, 3, 3] == pytest.approx(raw["A_additional_44"], rel=1e-12)
    assert extra.damping[:, 3, 3] == pytest.approx(raw["B_additional_44"], rel=1e-12)
    others = np.ones((6, 6), dtype=bool)
    others[3, 3] = False
    assert not np.any(extra.added_mass[:, others]) and not np.any(extra.restoring)
    roll = database.roll_damping
    for key, values in raw["roll_linear_quadratic_linearised"].items():
        k, h = (int(part) for part in key.split(","))
        at = of_heading(database, expected["heading_deg"][h])
        assert [roll.linear[k], roll.quadratic[k], roll.linearised[at, k]] == pytest.approx(values, rel=1e-12)
    amplitude = np.abs(database.motion_rao[:, :, 3]) * roll.linearised_amplitude
    rebuilt = 8.0 / (3.0 * np.pi) * roll.quadratic * database.omega * amplitude
    assert rebuilt == pytest.approx(roll.linearised, rel=1e-5)


def test_forces_and_motions_are_the_reference_values(
    database: HydroDatabase, expected: dict[str, Any]
) -> None:
    for reference, table in (("force", database.force), ("motion", database.motion_rao)):
        for key, values in expected[f"{reference}_rao_file_axes"].items():
            k, h = (int(part) for part in key.split(","))
            at = of_heading(database, expected["heading_deg"][h])
            assert np.array_equal(table[at, k], TO_FILE * (np.array(values) @ [1.0, 1j]))
    for key, values in expected["xfwd_yport_zup"]["at_file_origin"]["force_rao"].items():
        frequency, direction = key.split(",mu=")
        found = database.force_at(expected["omega"][int(frequency)], np.radians(float(direction)))
        reference = np.array(values) @ [1.0, 1j]
        assert np.abs(found - reference).max() < 1e-9 * np.abs(reference).max()
    port, starboard = (database.force_at(1.0, np.radians(degrees)) for degrees in (135.0, 225.0))
    assert port == pytest.approx(np.array([1, -1, 1, -1, 1, -1]) * starboard, rel=1e-6)
    assert database.force[:, 0, 2].real == pytest.approx(database.restoring[2, 2], rel=0.03)
    # zeta = a exp(i(wt - k x cos b)): in a long head sea pitch follows -d zeta/dx = i k cos b.
    head = of_heading(database, 0.0)
    slope = 1j * database.omega[0] ** 2 / database.g * np.cos(database.heading[head])
    assert database.motion_rao[head, 0, 4] == pytest.approx(slope, rel=0.1)


def test_drift_against_the_reference_values(database: HydroDatabase, expected: dict[str, Any]) -> None:
    factors, drift = expected["drift_dimensional_factor"], database.drift
    for key, coefficients in expected["drift_file_coeff"].items():
        k, h = (int(part) for part in key.split(","))
        load = np.array(coefficients) * TO_FILE[[0, 1, 5]] * [factors["Fx"], factors["Fy"], factors["Mz"]]
        place = of_heading(database, expected["heading_deg"][h])
        assert drift.coefficient[place, k, [0, 1, 5]] == pytest.approx(load, rel=1e-6)
    assert not np.any(drift.coefficient[:, :, 2:5])
    assert np.array_equal(drift.omega, database.omega) and np.array_equal(drift.heading, database.heading)


def test_wave_forces_follow_from_motions_and_what_is_missing_is_told(
    copy: Path, database: HydroDatabase
) -> None:
    """Without .re8: forces in the digits that motions have, nothing left to compare."""
    (copy / "input.re1").rename(copy / "away")
    assert read_veres(copy).motion_rao is None
    (copy / "away").rename(copy / "input.re1")
    for suffix in (".re8", ".re2", ".hyd"):
        (copy / f"input{suffix}").unlink()
    with pytest.warns(PartialSetWarning, match=r"no \.re8"):
        found = load_database(copy)
    scale = np.abs(database.force).max(axis=(0, 1))
    inside = database.omega <= 2.0
    assert np.all(np.abs(found.force - database.force)[:, inside] <= 2e-3 * scale)
    assert found.motion_rao is None and found.drift is None
    (copy / "input.re1").unlink()
    with pytest.raises(FileFormatError, match=r"input\.re8: no such file, nor \.re1"):
        read_veres(copy / "input")


MUTATIONS = [  # suffix, line counted from 1, its text, and what is said
    (".re7", 7, "-1025.0 9.81", "header .* differ"), (".re7", 11, "1 19 37 6", "counts are wrong"),
    (".re7", 12, "0 0 0 0 0 0", "differ|positive definite"), (".re7", 18, "5 0 0 5.38592 6", "no speed"),
    (".re7", 22, "0 1e6 0 x 0 0", "line 22: .*'x'"),
    (".re7", 22, "0.0 0.28169215E+09 0.0 0.0 0.0 0.0", "depend on the heading"),
    (".re8", 11, "0 0 0 5.4 6", "motion point differ"), (".re8", 12, "5.0", "headings differ"),
    (".re8", 13, "0.11", "frequencies of heading number 2"), (".re8", 14, "2 1.0 1.0", r"motions \[2.0, 2.0"),
]  # fmt: skip


def test_mutations_are_refused(copy: Path) -> None:
    for suffix, number, text, message in MUTATIONS:
        path = copy / f"input{suffix}"
        sound = path.read_text()
        lines = sound.splitlines()
        lines[number - 1] = text
        path.write_text("\n".join(lines) + "\n")
        with pytest.raises(FileFormatError, match=message):
            read_veres(copy)
        path.write_text(sound)
    text = (copy / "input.re2").read_text()
    for old, new, message in (
        ("   1.0472  ", "   1.0572  ", "frequencies differ"), ("0.82800003E+02", "0.92800003E+02", "header"),
    ):  # fmt: skip
        (copy / "input.re2").write_text(text.replace(old, new))
        with pytest.raises(FileFormatError, match=rf"input\.re2: {message}"):
            read_veres(copy)


def test_frequencies_in_any_order(copy: Path, database: HydroDatabase) -> None:
    (copy / "input.re2").unlink()
    for suffix, head, block in ((".re8", 11, 7), (".re1", 11, 7), (".re7", 18, 38)):
        path = copy / f"input{suffix}"
        lines = path.read_text().splitlines()
        out, position = lines[:head], head
        for _ in range(19):
            out.append(lines[position])
            blocks = [lines[position + 1 + k * block : position + 1 + (k + 1) * block] for k in range(36)]
            out += [line for part in reversed(blocks) for line in part]
            position += 1 + 36 * block
        path.write_text("\n".join(out) + "\n")
    turned = read_veres(copy)
    for name in ("omega", "added_mass", "damping", "restoring", "mass_matrix", "force", "motion_rao"):
        assert np.array_equal(getattr(turned, name), getattr(database, name))


def test_hydrostatics(supply: Path) -> None:
    assert read_veres_hydrostatics(supply / "input.hyd") == VeresHydrostatics(
        length=82.8, breadth=19.2, draught=6.0, sinkage=0.0, trim_deg=0.0, displacement=6362210.0, kb=3.334,
        vcg=7.3, lcb=36.014, lcg=36.014, cb=0.651, cw=0.870, gm_transverse=2.144, gm_longitudinal=103.628,
        r44=6.72, r55=20.7, r66=20.7,
    )  # fmt: skip


def test_hydrostatics_that_contradict_the_matrices(copy: Path) -> None:
    text = (copy / "input.hyd").read_text()
    for old, new, message in (
        ("6362.21*", "6442.21*", "displacement 6.44221e[+]06 against 6.36221e[+]06"),
        ("2.144*", "2.344*", r"gm_transverse 2.344 against 2.14\d+"),
        ("7.300*", "7.400*", "vcg 7.4 against"),
        ("                   36.014*", "                   35.014*", "lcb 35.014 against 36.014"),
        ("36.000        36.014*", "36.000*       36.214", ""),  # the marked one agrees
        ("36.000        36.014*", "36.000        37.014*", "lcg 37.014 against 36.014"),
        ("6.720*", "6.920*", "r44 6.92 against"), ("r55     20.700*", "r55     21.700*", "r55 21.7"),
        ("19.200", "18.200", "breadth 18.2 against 19.2"),
    ):  # fmt: skip
        assert old in text
        (copy / "input.hyd").write_text(text.replace(old, new, 1))
        with warnings.catch_warnings(record=True, action="always") as caught:
            read_veres(copy)
        assert [one.category for one in caught] == [HydrostaticsWarning] * bool(message)
        assert all(re.search(message, str(one.message)) for one in caught)


G = 9.81


def closure(database: HydroDatabase) -> dict[str, float]:
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
            read_veres(VeresRun(speeds=(5.0,), **given).write(tmp_path))
