"""ShipX/VERES reader: values and conventions on a real ship's files, damaged files."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane.errors import FileFormatError
from seacrane.hydro import HydroDatabase, load_database, read_veres
from seacrane.warnings import PartialSetWarning

TO_OURS = np.array([-1, -1, 1, -1, -1, 1])
KEY = ["0", "9", "19", "24", "27", "31", "35"]


@pytest.fixture(scope="session")
def supply(shared: Path) -> Path:
    """Folder of the supply vessel's files."""
    return shared / "veres" / "supply"


@pytest.fixture(scope="session")
def expected(supply: Path) -> dict[str, Any]:
    """Reference values that came with the files."""
    values: dict[str, Any] = json.loads((supply / "expected.json").read_text())
    return values


@pytest.fixture(scope="session")
def database(supply: Path) -> HydroDatabase:
    """The supply vessel as our reader reads it."""
    return load_database(supply)


def of_heading(database: HydroDatabase, heading_deg: float) -> int:
    """Index of a VERES heading (0 head sea) in the database."""
    direction = np.radians(heading_deg + 180.0)
    distance = np.abs(np.angle(np.exp(1j * (database.heading - direction))))
    assert distance.min() < 1e-9
    return int(distance.argmin())


def complex_of(pairs: Any) -> np.ndarray:
    """Complex array from [re, im] pairs."""
    array = np.array(pairs, dtype=float)
    return np.asarray(array[..., 0] + 1j * array[..., 1])


def test_header(database: HydroDatabase, expected: dict[str, Any]) -> None:
    head = expected["header"]
    assert (database.rho, database.g) == (head["rho"], head["g"])
    assert (database.length, database.breadth, database.draught) == (head["Lpp"], head["B"], head["T"])
    assert database.omega == pytest.approx(expected["omega"], rel=1e-12)
    assert len(database.heading) == head["nhead"]
    assert database.speed == 0.0
    assert database.infinite_frequency_added_mass is None


def test_matrices_in_our_axes(database: HydroDatabase, expected: dict[str, Any]) -> None:
    ours = expected["xfwd_yport_zup"]["at_file_origin"]
    assert np.array_equal(database.mass_matrix, np.array(ours["M"]))
    assert np.array_equal(database.restoring, np.array(ours["C"]))
    for key, matrix in ours["A"].items():
        assert np.array_equal(database.added_mass[int(key)], np.array(matrix))


def test_signs_against_the_raw_file(database: HydroDatabase, expected: dict[str, Any]) -> None:
    both = np.outer(TO_OURS, TO_OURS)
    for key in KEY:
        assert np.array_equal(
            database.damping[int(key)], both * np.array(expected["raw_file_axes"]["B"][key])
        )


def test_checksums_of_all_frequencies(database: HydroDatabase, expected: dict[str, Any]) -> None:
    sums = expected["raw_file_axes"]["A_checksum"]
    both = np.outer(TO_OURS, TO_OURS)
    headings = len(database.heading)
    found = {
        "sum_A": np.sum(database.added_mass * both),
        "sum_B": np.sum(database.damping * both),
        "sum_abs_A": np.sum(np.abs(database.added_mass)),
        "sum_abs_B": np.sum(np.abs(database.damping)),
    }
    for name, value in found.items():
        assert value == pytest.approx(sums[name], rel=1e-12) or headings * value == pytest.approx(
            sums[name], rel=1e-12
        )


def test_additional_matrices_are_kept_apart(database: HydroDatabase, expected: dict[str, Any]) -> None:
    (extra,) = database.additional
    assert extra.added_mass[:, 3, 3] == pytest.approx(expected["raw_file_axes"]["A_additional_44"], rel=1e-12)
    assert extra.damping[:, 3, 3] == pytest.approx(expected["raw_file_axes"]["B_additional_44"], rel=1e-12)
    only_roll = np.ones((6, 6), dtype=bool)
    only_roll[3, 3] = False
    assert not np.any(extra.added_mass[:, only_roll])
    assert not np.any(extra.restoring)


def test_roll_damping_columns(database: HydroDatabase, expected: dict[str, Any]) -> None:
    assert database.roll_damping is not None
    for key, values in expected["raw_file_axes"]["roll_linear_quadratic_linearised"].items():
        k, h = (int(part) for part in key.split(","))
        at = of_heading(database, expected["heading_deg"][h])
        roll = database.roll_damping
        assert [roll.linear[k], roll.quadratic[k], roll.linearised[at, k]] == pytest.approx(values, rel=1e-12)


def test_linearised_roll_damping_belongs_to_its_amplitude(database: HydroDatabase) -> None:
    roll = database.roll_damping
    assert roll is not None
    assert roll.linearised_amplitude is not None
    assert database.motion_rao is not None
    amplitude = np.abs(database.motion_rao[:, :, 3]) * roll.linearised_amplitude
    rebuilt = 8.0 / (3.0 * np.pi) * roll.quadratic * database.omega * amplitude
    assert rebuilt == pytest.approx(roll.linearised, rel=1e-5)


@pytest.mark.parametrize(
    ("reference", "attribute"), [("force_rao_file_axes", "force"), ("motion_rao_file_axes", "motion_rao")]
)
def test_transfer_functions(
    database: HydroDatabase, expected: dict[str, Any], reference: str, attribute: str
) -> None:
    table = getattr(database, attribute)
    for key, values in expected[reference].items():
        k, h = (int(part) for part in key.split(","))
        at = of_heading(database, expected["heading_deg"][h])
        assert np.array_equal(table[at, k], TO_OURS * complex_of(values))


def test_directions_in_our_convention(database: HydroDatabase, expected: dict[str, Any]) -> None:
    for key, values in expected["xfwd_yport_zup"]["at_file_origin"]["force_rao"].items():
        frequency, direction = key.split(",mu=")
        omega = expected["omega"][int(frequency)]
        found = database.force_at(omega, np.radians(float(direction)))
        reference = complex_of(values)
        assert np.abs(found - reference).max() < 1e-9 * np.abs(reference).max()


def test_port_side_by_symmetry(database: HydroDatabase) -> None:
    parity = np.array([1, -1, 1, -1, 1, -1])
    starboard = database.force_at(1.0, np.radians(225.0))
    assert database.force_at(1.0, np.radians(135.0)) == pytest.approx(parity * starboard, rel=1e-6)


def test_long_waves_lift_the_ship_by_its_waterplane(database: HydroDatabase) -> None:
    assert database.force[:, 0, 2].real == pytest.approx(database.restoring[2, 2], rel=0.03)


def test_pitch_follows_the_slope_of_a_long_head_sea(database: HydroDatabase) -> None:
    """zeta = a exp(i(wt - k x cos b)), and pitch follows -d zeta/dx = i k cos b."""
    assert database.motion_rao is not None
    head = of_heading(database, 0.0)
    slope = 1j * database.omega[0] ** 2 / database.g * np.cos(database.heading[head])
    assert database.motion_rao[head, 0, 4] == pytest.approx(slope, rel=0.1)


@pytest.mark.parametrize("name", ["", "input", "input.re7", "input.re8", "input.re1", "input.hyd"])
def test_folder_stem_or_any_file_will_do(supply: Path, name: str, database: HydroDatabase) -> None:
    found = load_database(supply / name if name else supply)
    assert np.array_equal(found.force, database.force)


@pytest.fixture
def copy(supply: Path, tmp_path: Path) -> Path:
    """A writable copy of the three files."""
    for suffix in (".re1", ".re7", ".re8"):
        shutil.copy(supply / f"input{suffix}", tmp_path)
    for file in tmp_path.iterdir():
        file.chmod(0o644)
    return tmp_path


def test_upper_case_suffixes(copy: Path) -> None:
    for file in list(copy.iterdir()):
        file.rename(file.with_suffix(file.suffix.upper()))
    assert len(load_database(copy).omega) == 36
    assert len(load_database(copy / "input").omega) == 36


def test_motions_are_optional(copy: Path) -> None:
    (copy / "input.re1").unlink()
    assert read_veres(copy).motion_rao is None


def test_wave_forces_follow_from_motions(copy: Path, database: HydroDatabase) -> None:
    """Without .re8: forces in the digits that motions have, nothing left to compare."""
    (copy / "input.re8").unlink()
    with pytest.warns(PartialSetWarning, match=r"no \.re8; wave forces are solved from the motions"):
        found = load_database(copy)
    scale = np.abs(database.force).max(axis=(0, 1))
    inside = database.omega <= 2.0
    assert np.all(np.abs(found.force - database.force)[:, inside] <= 2e-3 * scale)
    assert found.motion_rao is None
    for lost in (r"no .re8: wave forces are solved", "no .re2: no drift", "no .hyd: hydrostatics are not"):
        assert lost in found.source
    assert "; no ." not in database.source


@pytest.mark.parametrize(
    ("suffixes", "message"),
    [
        ([".re7"], r"input\.re7: no such file; .* no mass, added mass, .*MotionRaos"),
        ([".re8", ".re1"], r"input\.re8: no such file, nor \.re1"),
    ],
)
def test_missing_files_are_named(copy: Path, suffixes: list[str], message: str) -> None:
    for suffix in suffixes:
        (copy / f"input{suffix}").unlink()
    with pytest.raises(FileFormatError, match=message):
        read_veres(copy / "input")


def test_two_sets_in_one_folder_need_the_stem(copy: Path) -> None:
    for suffix in (".re7", ".re8"):
        shutil.copy(copy / f"input{suffix}", copy / f"other{suffix}")
    with pytest.raises(FileFormatError, match="input, other"):
        load_database(copy)
    assert load_database(copy / "other").name == "other"


@pytest.mark.parametrize("suffix", [".re1", ".re7", ".re8"])
@pytest.mark.parametrize(
    "kept", [0, 1, 5, 6, 7, 8, 9, 10, 11, 12, 17, 18, 19, 20, 21, 60, 1000, 2500, 4805, -40, -2, -1]
)
def test_truncation_names_file_and_line(copy: Path, suffix: str, kept: int) -> None:
    path = copy / f"input{suffix}"
    lines = path.read_bytes().splitlines(keepends=True)
    if kept >= len(lines):
        kept = len(lines) // 3
    path.write_bytes(b"".join(lines[:kept]))
    with pytest.raises(FileFormatError, match=rf"input\{suffix}, line \d+"):
        read_veres(copy)


@pytest.mark.parametrize("suffix", [".re1", ".re7", ".re8"])
@pytest.mark.parametrize("part", [0.1, 0.33, 0.5, 0.77, 0.99])
def test_truncation_inside_a_line(copy: Path, suffix: str, part: float) -> None:
    path = copy / f"input{suffix}"
    data = path.read_bytes()
    path.write_bytes(data[: int(part * len(data))])
    with pytest.raises(FileFormatError, match=rf"input\{suffix}, line \d+"):
        read_veres(copy)


def replace_line(path: Path, number: int, text: str) -> None:
    """Replace one line (counted from 1) of a file."""
    lines = path.read_text().splitlines()
    lines[number - 1] = text
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize(
    ("suffix", "number", "text", "message"),
    [
        (".re7", 7, "0.1025E+04", "density and gravity: 2 numbers"),
        (".re7", 7, "-1025.0 9.81", "header .* differ"),
        (".re7", 8, "82.8 nan 6.0", "line 8: .*'nan' is not a finite"),
        (".re7", 10, "-1 1", "version line '-1 1'"),
        (".re7", 10, "1 19 36 6", "line 11: mass matrix: 6 numbers are expected, found 4"),
        (".re7", 11, "1 19 36 5", "six motions"),
        (".re7", 11, "1 19 0 6", "at least one"),
        (".re7", 11, "1 19 37 6", "counts are wrong"),
        (".re7", 11, "1 19 35 6", "line"),
        (".re7", 11, "1 1000000000 1000000000 6", "counts are wrong"),
        (".re7", 11, "1 19 36.5 6", "whole numbers"),
        (".re7", 11, "2 19 36 6", "counts are wrong"),
        (".re7", 12, "0 0 0 0 0 0", "differ|positive definite"),
        (".re7", 18, "5.0 0.0 0.0 5.38592 6.0", "no speed is in every file"),
        (".re7", 20, "0.2 0.3", "frequency: 1 numbers"),
        (".re7", 22, "0.0 0.28169215E+07 0.0 x 0.0 0.0", "line 22: .*'x' is not a number"),
        (".re7", 22, "0.0 0.28169215E+09 0.0 0.0 0.0 0.0", "depend on the heading"),
        (".re8", 10, "1 18 36 6", "line|differ"),
        (".re8", 11, "0.0 0.0 0.0 5.4 6.0", "motion point differ"),
        (".re8", 12, "5.0", "headings differ"),
        (".re8", 13, "0.11", "frequencies of heading number 2"),
        (".re8", 14, "2 1.0 1.0", r"motions \[2.0, 2.0"),
        (".re8", 14, "1 1.0 inf", "line 14: .*not a finite"),
        (".re1", 14, "1 1.0", "line 14: .*3 numbers"),
    ],
)
def test_mutations_are_refused(copy: Path, suffix: str, number: int, text: str, message: str) -> None:
    replace_line(copy / f"input{suffix}", number, text)
    with pytest.raises(FileFormatError, match=message):
        read_veres(copy)


def test_frequencies_in_any_order(copy: Path, database: HydroDatabase) -> None:
    """A file whose frequencies fall is read into rising ones, everything else with them."""
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
    for name in ("omega", "added_mass", "damping", "force", "motion_rao"):
        assert np.array_equal(getattr(turned, name), getattr(database, name))
