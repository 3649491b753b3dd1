"""WAMIT reader: values and conventions on the tanker's files, closure of its motions."""

from __future__ import annotations

import dataclasses
import json
import shutil
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane.cli import main
from seacrane.errors import FileFormatError
from seacrane.hydro import (
    HydroDatabase,
    fit_memory,
    load_database,
    motion_response,
    read_wamit,
    rigid_mass_matrix,
    vessel_parameters,
)
from seacrane.hydro.data.motion import motion_errors
from seacrane.result import Result
from seacrane.warnings import (
    AssumedDensityWarning,
    AssumedInertiaWarning,
    PartialSetWarning,
    RoughDataWarning,
)

MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")


@pytest.fixture(scope="module")
def tanker(shared: Path) -> Path:
    """Folder of the tanker's files."""
    return shared / "wamit"


@pytest.fixture(scope="module")
def expected(tanker: Path) -> dict[str, Any]:
    """Reference values that came with the files."""
    values: dict[str, Any] = json.loads((tanker / "expected.json").read_text())
    return values


@pytest.fixture(scope="module")
def database(tanker: Path) -> HydroDatabase:
    """The tanker; a complete set gives no warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return read_wamit(tanker)


@pytest.fixture
def copy(tanker: Path, tmp_path: Path) -> Path:
    """A writable copy of the set."""
    for file in tanker.glob("tanker.*"):
        shutil.copyfile(file, tmp_path / file.name)
    return tmp_path


def edit(path: Path, old: str, new: str) -> None:
    """Replace a text that is there once."""
    text = path.read_text()
    assert text.count(old) == 1
    path.write_text(text.replace(old, new))


def replace_lines(path: Path, first: int, last: int, *new: str) -> None:
    """Replace lines ``first`` to ``last`` (counted from 1) by others."""
    lines = path.read_text().split("\n")
    lines[first - 1 : last] = new
    path.write_text("\n".join(lines))


def test_head(database: HydroDatabase, expected: dict[str, Any]) -> None:
    assert (database.rho, database.g) == (expected["rho"], expected["g"])
    assert database.depth == np.inf
    assert 2.0 * np.pi / database.omega[::-1] == pytest.approx(expected["periods_s"], rel=1e-12)
    assert np.degrees(database.heading) == pytest.approx(expected["headings_deg"], abs=1e-12)
    assert database.port_starboard_symmetric
    assert "6.314" in database.source and "Haskind" in database.source
    assert "still waterline" in database.origin


def test_constant_matrices(database: HydroDatabase, expected: dict[str, Any]) -> None:
    assert np.array_equal(database.mass_matrix, np.array(expected["M"]))
    assert database.restoring == pytest.approx(np.array(expected["C"]), rel=1e-14)
    assert np.array_equal(database.linear_damping, np.array(expected["external_damping"]))


def test_limits_of_the_added_mass(database: HydroDatabase, expected: dict[str, Any]) -> None:
    """PER = -1 is the frequency 0 and PER = 0 the infinite one."""
    assert database.zero_frequency_added_mass == pytest.approx(np.array(expected["A_zero_freq"]), rel=1e-14)
    assert database.infinite_frequency_added_mass == pytest.approx(np.array(expected["A_inf"]), rel=1e-14)
    assert database.added_mass[0, 2, 2] == pytest.approx(expected["A_zero_freq"][2][2], rel=0.05)
    # The shortest waves are beyond the mesh; from 3 s on A33 comes from the side of infinity.
    assert database.added_mass[40, 2, 2] == pytest.approx(expected["A_inf"][2][2], rel=0.2)


@pytest.mark.parametrize(("name", "key"), [("added_mass", "A"), ("damping", "B")])
def test_radiation(database: HydroDatabase, expected: dict[str, Any], name: str, key: str) -> None:
    for period, matrix in expected[key].items():
        index = int(np.argmin(np.abs(2.0 * np.pi / database.omega - float(period))))
        assert getattr(database, name)[index] == pytest.approx(np.array(matrix), rel=1e-12)


@pytest.mark.parametrize(("name", "key"), [("force", "force_rao_diffraction"), ("motion_rao", "motion_rao")])
def test_waves(database: HydroDatabase, expected: dict[str, Any], name: str, key: str) -> None:
    assert len(expected[key]) == 36
    for label, pairs in expected[key].items():
        period, heading = (float(part.split("=")[1]) for part in label.split(","))
        n = int(np.argmin(np.abs(2.0 * np.pi / database.omega - period)))
        m = int(np.argmin(np.abs(np.degrees(database.heading) - heading)))
        parts = np.array(pairs)
        wanted = parts[:, 0] + 1j * parts[:, 1]
        assert getattr(database, name)[m, n] == pytest.approx(wanted, rel=1e-12, abs=0.0)


def test_closure(database: HydroDatabase, expected: dict[str, Any]) -> None:
    """The motions of the file follow from A, B, C, F and the external damping, as the reference found.

    The reference takes the worst heading by its own largest motion, the check the largest of all headings.
    """
    rows = {row.check: row for row in database.check()}
    long = database.omega <= 2.0 * np.pi / 5.0
    by_heading = motion_errors(database, motion_response(database), database.motion_rao, inside=long)
    for i, motion in enumerate(MOTIONS):
        reference = expected["closure_check"]["max_rel_err_by_dof"][i]
        # The reference leaves out 5 s itself, which is where heave and pitch are worst.
        assert by_heading[i] > 0.99 * reference
        if motion not in ("heave", "pitch"):
            assert by_heading[i] == pytest.approx(reference, rel=0.01)
        row = rows[f"motion_rao_{motion}"]
        assert row.limit == 0.01
        assert row.verdict == "pass"
        assert 0.01 * reference < row.value <= 1.01 * by_heading[i]
    for motion in MOTIONS:
        assert rows[f"damping_from_forces_{motion}"].value < 0.025
        assert rows[f"kramers_kronig_{motion}"].verdict == "pass"
    for check in ("symmetry_added_mass", "symmetry_damping", "damping_smallest_eigenvalue"):
        assert rows[check].verdict == "pass"


@pytest.mark.slow("closes a ship")
def test_a_sound_file_that_does_not_count_its_panels_passes(copy: Path) -> None:
    """Its band ends where its matrices begin to jump; shorter waves do not fail its motions."""
    listing = copy / "tanker.out"
    lines = listing.read_bytes().split(b"\n")
    listing.write_bytes(b"\n".join(line for line in lines if b"Total panels" not in line))
    with pytest.warns(RoughDataWarning):
        found = load_database(copy)
    rows = {row.check: row for row in found.check()}
    assert all(rows[f"motion_rao_{motion}"].verdict == "pass" for motion in MOTIONS)
    damaged = dataclasses.replace(found, force=found.force * np.array([1, 1, 1, 1, 1, 1.02]))
    assert {row.check: row for row in damaged.check()}["motion_rao_yaw"].verdict == "fail"


@pytest.mark.parametrize("damage", ["no external damping", "conjugated", "port and starboard"])
def test_closure_notices_damage(database: HydroDatabase, damage: str) -> None:
    change: dict[str, Any] = {
        "no external damping": {"linear_damping": np.zeros((6, 6))},
        "conjugated": {"force": database.force.conj()},
        "port and starboard": {"force": database.force * np.array([1, -1, 1, -1, 1, -1])},
    }[damage]
    rows = {row.check: row for row in dataclasses.replace(database, **change).check()}
    assert rows["motion_rao_roll"].verdict == "fail"
    assert rows["motion_rao_heave"].verdict == ("fail" if damage == "conjugated" else "pass")


def test_long_waves_push_as_hydrostatics_do(database: HydroDatabase) -> None:
    assert database.force[0, 0, 2].real == pytest.approx(database.restoring[2, 2], rel=0.02)


def test_limits_survive_our_netcdf(database: HydroDatabase, tmp_path: Path) -> None:
    database.save(tmp_path / "tanker.nc")
    again = load_database(tmp_path / "tanker.nc")
    for name in ("motion_rao_limit", "motion_rao_floor", "force", "zero_frequency_added_mass"):
        assert np.array_equal(getattr(again, name), getattr(database, name))


@pytest.mark.parametrize("name", ["", "tanker", "tanker.1", "tanker.out", "tanker.frc", "tanker.hst"])
def test_folder_stem_or_any_file_will_do(tanker: Path, database: HydroDatabase, name: str) -> None:
    assert np.array_equal(load_database(tanker / name if name else tanker).force, database.force)


def test_command_line(tanker: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["hydro", str(tanker / "tanker"), "--json"]) == 0
    rows = {row["check"]: row for row in json.loads(capsys.readouterr().out)}
    assert rows["motion_rao_heave"]["verdict"] == "pass"


def test_vessel_of_the_time_domain_keeps_the_inertia(database: HydroDatabase) -> None:
    """The file's yaw inertia exceeds roll + pitch, and M26 is missing: the sum with added mass stays."""
    memory = fit_memory(database=database)
    vessel = vessel_parameters(database, memory=memory)
    moments = np.linalg.eigvalsh(vessel.inertia)
    assert 0.98 * (moments[0] + moments[1]) < moments[2] < moments[0] + moments[1]
    rigid = rigid_mass_matrix(vessel.mass, vessel.center_of_mass, vessel.inertia)
    total = rigid + vessel.added_mass - memory.added_mass
    scale = np.sqrt(np.diagonal(database.mass_matrix))
    assert np.all(np.abs(total - database.mass_matrix) <= 1e-12 * np.outer(scale, scale))


def test_a_run_on_the_tanker(tanker: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    arguments = ["run", "vessel", "--database", str(tanker), "--t-end", "4", "--hs", "2", "--tp", "10"]
    assert main([*arguments, "--out", str(out)]) == 0
    heave = Result.load(out / "vessel.nc").channels["vessel_motion"][:, 2]
    assert np.all(np.isfinite(heave)) and 1e-4 < np.abs(heave).max() < 1.0


def test_first_form_of_frc(copy: Path, database: HydroDatabase) -> None:
    """VCG and radii of gyration about the origin: I = m r |r|; mass = density of .out x mean volume."""
    volume = np.mean([92309.5, 92313.2, 92314.5])
    inertia = database.mass_matrix[3:, 3:] / database.mass_matrix[0, 0]
    radii = np.sign(inertia) * np.sqrt(np.abs(inertia))
    rows = [" ".join(f"{value:.9f}" for value in row) for row in radii]
    (copy / "tanker.frc").write_text("\n".join(["title", "1 0 1 1 0 0 0 0 1", "2.5", *rows, "0", "0", ""]))
    first = read_wamit(copy)
    assert first.mass_matrix[0, 0] == pytest.approx(1025.0 * volume, rel=1e-12)
    wanted = database.mass_matrix.copy()
    wanted[1, 5] = wanted[5, 1] = 3.93 * wanted[0, 0]  # which the matrix of the tanker's own file leaves out
    assert first.mass_matrix == pytest.approx(wanted, rel=1e-6)
    assert not np.any(first.linear_damping)


def test_density_absent(copy: Path, database: HydroDatabase) -> None:
    (copy / "tanker.frc").write_text("t\n1 0 1 1 0 0 0 0 1\n2.5\n17 0 0\n0 64 0\n0 0 66\n0\n")
    edit(copy / "tanker.out", "Water density:     1025.00000", "")
    with pytest.warns(AssumedDensityWarning, match="1025 kg/m3 is taken, and every mass"):
        found = read_wamit(copy)
    assert found.rho == 1025.0
    assert np.array_equal(found.force, database.force)
    assert found.mass_matrix[3, 3] == pytest.approx(1025.0 * 92312.4 * 17.0**2, rel=1e-9)


@pytest.mark.parametrize("how", ["no file", "IMASS = 0"])
def test_mass_absent(copy: Path, how: str) -> None:
    if how == "no file":
        (copy / "tanker.frc").unlink()
    else:
        replace_lines(copy / "tanker.frc", 5, 11, "0")
    with pytest.warns(AssumedInertiaWarning, match="9.46202e.07 kg"):
        found = read_wamit(copy)
    assert found.mass_matrix[0, 0] == pytest.approx(1025.0 * 92312.4, rel=1e-9)
    assert found.mass_matrix[0, 4] == pytest.approx(2.5 * found.mass_matrix[0, 0])
    assert np.any(found.linear_damping) == (how == "IMASS = 0")


def test_control_file_as_fortran_reads_it(copy: Path, database: HydroDatabase) -> None:
    """Comments after the numbers, matrices broken anywhere, external stiffness."""
    lines = (copy / "tanker.frc").read_text().split("\n")
    lines[1] += "  IOPTN"
    lines[2] += "  density"
    lines[5:11] = [" ".join(lines[5:11])]
    stiff = lines.index("1", 12)
    lines[stiff + 1] = "7e4, 0, 0,\n0 0 0"
    (copy / "tanker.frc").write_text("\n".join(lines))
    found = read_wamit(copy)
    assert np.array_equal(found.mass_matrix, database.mass_matrix)
    assert found.restoring[0, 0] == 7e4
    assert found.restoring[1:, 1:] == pytest.approx(database.restoring[1:, 1:])


def test_motions_from_diffraction_forces_have_a_tighter_limit(copy: Path) -> None:
    replace_lines(copy / "tanker.frc", 2, 2, "1 0 1 2 0 0 0 0 1")
    found = read_wamit(copy)
    assert found.motion_rao_limit.tolist() == [1e-3] * 6
    assert "diffraction" in found.source


def test_length_scale(copy: Path, database: HydroDatabase) -> None:
    """The same ship in units of 2 m: A / 2^k, C / 2^(k-1), X / 2^2 or 2^3, rotations x 2."""
    edit(copy / "tanker.out", "Length scale:        1.00000", "Length scale:        2.00000")
    found = read_wamit(copy)
    assert found.added_mass[5, 2, 2] == pytest.approx(2.0**3 * database.added_mass[5, 2, 2])
    assert found.added_mass[5, 2, 4] == pytest.approx(2.0**4 * database.added_mass[5, 2, 4])
    assert found.damping[5, 4, 4] == pytest.approx(2.0**5 * database.damping[5, 4, 4])
    assert found.restoring[2, 2] == pytest.approx(2.0**2 * database.restoring[2, 2])
    assert found.restoring[4, 4] == pytest.approx(2.0**4 * database.restoring[4, 4])
    assert found.force[3, 5, 2] == pytest.approx(2.0**2 * database.force[3, 5, 2])
    assert found.force[3, 5, 4] == pytest.approx(2.0**3 * database.force[3, 5, 4])
    assert found.motion_rao is not None and database.motion_rao is not None
    assert found.motion_rao[3, 5, 2] == database.motion_rao[3, 5, 2]
    assert found.motion_rao[3, 5, 4] == pytest.approx(0.5 * database.motion_rao[3, 5, 4])


def test_common_periods_and_headings(copy: Path, database: HydroDatabase) -> None:
    """Periods missing in .3 and a heading missing in .4 are left out everywhere, with a warning."""
    three, four = copy / "tanker.3", copy / "tanker.4"
    rows = three.read_text().splitlines(keepends=True)
    three.write_text("".join(row for row in rows if float(row.split()[0]) < 100.0))
    rows = four.read_text().splitlines(keepends=True)
    four.write_text("".join(row for row in rows if float(row.split()[1]) != 40.0))
    with pytest.warns(PartialSetWarning) as caught:
        found = read_wamit(copy)
    text = " ".join(str(warning.message) for warning in caught)
    assert "periods 110.01, 121.53" in text and "headings 40 deg" in text
    assert np.array_equal(found.omega, database.omega[5:])
    kept = [i for i in range(19) if i != 4]
    assert np.array_equal(found.heading, database.heading[kept])
    assert np.array_equal(found.force, database.force[kept, 5:])
    assert np.array_equal(found.added_mass, database.added_mass[5:])
    assert found.motion_rao is not None and database.motion_rao is not None
    assert np.array_equal(found.motion_rao, database.motion_rao[kept, 5:])


@pytest.mark.parametrize("limit", ["-0.100000E+01", "0.000000E+00"])
def test_a_limit_of_the_added_mass_is_optional(limit: str, copy: Path, database: HydroDatabase) -> None:
    """Period -1 is zero frequency, period 0 infinite; without its rows the limit is unknown, not zero."""
    rows = (copy / "tanker.1").read_text().splitlines(keepends=True)
    (copy / "tanker.1").write_text("".join(row for row in rows if row.split()[0] != limit))
    found = read_wamit(copy)
    names = ["zero_frequency_added_mass", "infinite_frequency_added_mass"]
    gone, kept = names if limit.startswith("-") else reversed(names)
    assert getattr(found, gone) is None
    assert np.array_equal(getattr(found, kept), getattr(database, kept))
    assert np.array_equal(found.added_mass, database.added_mass)


def test_finite_depth_and_upper_case_suffixes(copy: Path) -> None:
    edit(copy / "tanker.out", "Water depth:        infinite ", "Water depth:       55.00000 ")
    (copy / "tanker.3").write_text("period heading i mod pha re im\n" + (copy / "tanker.3").read_text())
    for suffix in (".out", ".frc", ".hst"):
        (copy / f"tanker{suffix}").rename(copy / f"tanker{suffix.upper()}")
    assert read_wamit(copy).depth == 55.0


def test_motions_are_optional(copy: Path) -> None:
    (copy / "tanker.4").unlink()
    found = read_wamit(copy)
    assert found.motion_rao is None
    assert not [row for row in found.check() if row.check.startswith("motion_rao")]


@pytest.mark.parametrize("suffix", [".1", ".3", ".hst", ".out"])
def test_missing_files_are_named(copy: Path, suffix: str) -> None:
    (copy / f"tanker{suffix}").unlink()
    with pytest.raises(FileFormatError, match=rf"tanker\{suffix}: no such file; WAMIT needs"):
        read_wamit(copy / "tanker")


def test_kinds_side_by_side(copy: Path) -> None:
    shutil.copyfile(copy / "tanker.1", copy / "other.1")
    with pytest.raises(FileFormatError, match="found: other, tanker"):
        load_database(copy)
    (copy / "other.1").unlink()
    (copy / "input.re7").write_text("")
    with pytest.raises(FileFormatError, match="VERES and WAMIT"):
        load_database(copy)
    with pytest.raises(FileFormatError, match=r"not of a known kind; .*VERES.*WAMIT"):
        (copy / "notes.txt").write_text("")
        load_database(copy / "notes.txt")


def drift_rows(database: HydroDatabase, kind: str) -> tuple[str, np.ndarray]:
    """Text of a file of mean loads at two periods and three headings, and the loads in SI (3, 2, 6)."""
    rng = np.random.default_rng(5)
    value = rng.normal(size=(3, 2, 6))  # by heading, period
    periods, headings = (8.0, 12.0), (0.0, 90.0, 180.0)
    motions = (1, 2, 6) if kind == ".8" else range(1, 7)
    lines = []
    for p, period in enumerate(periods):
        for h, heading in enumerate(headings):
            for i in motions:
                real = value[h, p, i - 1]
                first = [period, period] if kind == ".12d" else [period]
                phase = 0.0 if real > 0.0 else 180.0
                numbers = [*first, heading, heading, i, abs(real), phase, real, 0.0]
                lines.append(" ".join(f"{number:.9E}" for number in numbers))
                if kind == ".12d":  # two periods beat: no mean load
                    lines.append(" ".join(f"{n:.9E}" for n in [8.0, 12.0, *numbers[2:]]) if p == 0 else "")
                else:  # two headings: no single wave
                    lines.append(" ".join(f"{n:.9E}" for n in [period, heading, heading + 5.0, *numbers[3:]]))
    there = np.zeros(6)
    there[[i - 1 for i in motions]] = 1.0
    return "\n".join(line for line in lines if line) + "\n", value[
        :, ::-1
    ] * database.rho * database.g * there


@pytest.mark.parametrize("kind", [".8", ".9", ".12d"])
def test_mean_drift(copy: Path, database: HydroDatabase, kind: str) -> None:
    """Of one wave alone, in SI (ULEN is 1); frequencies rise."""
    text, wanted = drift_rows(database, kind)
    (copy / f"tanker{kind}").write_text(text)
    drift = load_database(copy).drift
    assert drift is not None
    assert drift.omega == pytest.approx([2.0 * np.pi / 12.0, 2.0 * np.pi / 8.0])
    assert np.degrees(drift.heading) == pytest.approx([0.0, 90.0, 180.0])
    assert np.abs(drift.coefficient - wanted).max() <= 1e-8 * np.abs(wanted).max()


def test_pressures_are_taken_before_momentum(copy: Path, database: HydroDatabase) -> None:
    for kind in (".8", ".9"):
        (copy / f"tanker{kind}").write_text(drift_rows(database, kind)[0])
    drift = load_database(copy).drift
    assert drift is not None and np.any(drift.coefficient[:, :, 3] != 0.0)


@pytest.mark.parametrize(
    ("row", "column", "value", "message"),
    [
        (4, 2, "9.100000000E+01", "a line of another motion is missing"),
        (4, 7, "5.000000000E+00", "a mean load with an imaginary part of 5"),
        (4, 3, "7.000000000E+00", "motion 7 is not one of 1 to 6"),
        (4, 0, "nan", "a number is not finite"),
        (4, 7, "", "8 numbers are expected, found 7"),
    ],
)
def test_damaged_mean_drift(
    copy: Path, database: HydroDatabase, row: int, column: int, value: str, message: str
) -> None:
    rows = [line.split() for line in drift_rows(database, ".9")[0].splitlines()]
    rows[row][column] = value
    (copy / "tanker.9").write_text("\n".join(" ".join(words) for words in rows) + "\n")
    with pytest.raises(FileFormatError, match=rf"tanker\.9, line \d+: {message}"):
        load_database(copy)


def test_mean_drift_of_no_single_wave(copy: Path, database: HydroDatabase) -> None:
    text = drift_rows(database, ".9")[0].split("\n")
    (copy / "tanker.9").write_text("\n".join(text[1::2]) + "\n")
    with pytest.raises(FileFormatError, match="no row of one period and one heading"):
        load_database(copy)
