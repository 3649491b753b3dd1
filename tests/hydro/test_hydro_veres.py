"""ShipX/VERES reader: values and conventions on a real ship's files, damaged files."""

from __future__ import annotations

import json
import re
import shutil
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane.errors import FileFormatError
from seacrane.hydro import (
    HydroDatabase,
    VeresHydrostatics,
    load_database,
    read_veres,
    read_veres_hydrostatics,
)
from seacrane.warnings import HydrostaticsWarning, PartialSetWarning

TO_OURS = np.array([-1, -1, 1, -1, -1, 1])
BOTH = np.outer(TO_OURS, TO_OURS)


@pytest.fixture(scope="module")
def supply(shared: Path) -> Path:
    return shared / "veres" / "supply"


@pytest.fixture(scope="module")
def expected(supply: Path) -> dict[str, Any]:
    """Reference values that came with the files."""
    return json.loads((supply / "expected.json").read_text())  # type: ignore[no-any-return]


@pytest.fixture(scope="module")
def database(supply: Path) -> HydroDatabase:
    """The supply vessel as our reader reads it; nothing about it warns."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return load_database(supply)


@pytest.fixture
def copy(supply: Path, tmp_path: Path) -> Path:
    for suffix in (".re1", ".re2", ".re7", ".re8", ".hyd"):
        shutil.copyfile(supply / f"input{suffix}", tmp_path / f"input{suffix}")
    return tmp_path


def of_heading(database: HydroDatabase, heading_deg: float) -> int:
    """Index of a VERES heading (0 head sea) in the database."""
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
            assert np.array_equal(table[at, k], TO_OURS * (np.array(values) @ [1.0, 1j]))
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


def test_drift_against_the_reference_values(
    database: HydroDatabase, expected: dict[str, Any], tmp_path: Path
) -> None:
    factors, drift = expected["drift_dimensional_factor"], database.drift
    for key, coefficients in expected["drift_file_coeff"].items():
        k, h = (int(part) for part in key.split(","))
        load = np.array(coefficients) * TO_OURS[[0, 1, 5]] * [factors["Fx"], factors["Fy"], factors["Mz"]]
        place = of_heading(database, expected["heading_deg"][h])
        assert drift.coefficient[place, k, [0, 1, 5]] == pytest.approx(load, rel=1e-6)
    assert not np.any(drift.coefficient[:, :, 2:5])
    assert np.array_equal(drift.omega, database.omega) and np.array_equal(drift.heading, database.heading)
    # Short waves are reflected: astern, to starboard, in beam seas near rho g L / 2 and not beyond it.
    astern, beam = drift.coefficient[of_heading(database, 0.0)], drift.coefficient[of_heading(database, 90.0)]
    assert np.all(astern[drift.omega > 0.5, 0] < 0.0) and np.all(beam[drift.omega > 0.5, 1] < 0.0)
    assert 0.9 < -beam[-1, 1] / (0.5 * database.rho * database.g * database.length) <= 1.0
    database.save(tmp_path / "ship.nc")
    assert np.array_equal(load_database(tmp_path / "ship.nc").drift.coefficient, drift.coefficient)


def test_folder_stem_or_any_file_will_do(supply: Path, copy: Path, database: HydroDatabase) -> None:
    for name in ("input", "input.re7", "input.hyd"):
        assert np.array_equal(load_database(supply / name).force, database.force)
    for suffix in (".re7", ".re8"):
        shutil.copyfile(copy / f"input{suffix}", copy / f"other{suffix}")
    with pytest.raises(FileFormatError, match="input, other"):
        load_database(copy)
    for file in list(copy.iterdir()):
        file.rename(file.with_suffix(file.suffix.upper()))
    assert len(load_database(copy / "input").omega) == 36


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
    """Falling frequencies are read into rising ones."""
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
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            read_veres(copy)
        assert [one.category for one in caught] == [HydrostaticsWarning] * bool(message)
        assert all(re.search(message, str(one.message)) for one in caught)
