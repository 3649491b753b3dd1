"""WAMIT reader: values and conventions on the tanker's files, closure of its motions."""

from __future__ import annotations

import dataclasses
import itertools
import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

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
from seacrane.warnings import AssumedDensityWarning, PartialSetWarning


@pytest.fixture(scope="module")
def tanker(shared: Path) -> Path:
    return shared / "wamit"


@pytest.fixture(scope="module")
def expected(tanker: Path) -> dict[str, Any]:
    return json.loads((tanker / "expected.json").read_text())  # type: ignore[no-any-return]


@pytest.fixture(scope="module")
def database(tanker: Path) -> HydroDatabase:
    """The tanker; a complete set gives no warning."""
    return read_wamit(tanker)


@pytest.fixture
def copy(tanker: Path, tmp_path: Path) -> Path:
    for file in tanker.glob("tanker.*"):
        shutil.copyfile(file, tmp_path / file.name)
    return tmp_path


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert text.count(old) == 1
    path.write_text(text.replace(old, new))


def test_every_number_against_the_reference_values(database: HydroDatabase, expected: dict[str, Any]) -> None:
    assert (database.rho, database.g, database.depth) == (expected["rho"], expected["g"], np.inf)
    assert 2.0 * np.pi / database.omega[::-1] == pytest.approx(expected["periods_s"], rel=1e-12)
    assert np.degrees(database.heading) == pytest.approx(expected["headings_deg"], abs=1e-12)
    assert database.port_starboard_symmetric
    assert np.array_equal(database.mass_matrix, np.array(expected["M"]))
    assert database.restoring == pytest.approx(np.array(expected["C"]), rel=1e-14)
    assert np.array_equal(database.linear_damping, np.array(expected["external_damping"]))
    # PER = -1 is the frequency 0 and PER = 0 the infinite one.
    assert database.zero_frequency_added_mass == pytest.approx(np.array(expected["A_zero_freq"]), rel=1e-14)
    assert database.infinite_frequency_added_mass == pytest.approx(np.array(expected["A_inf"]), rel=1e-14)
    assert database.added_mass[0, 2, 2] == pytest.approx(expected["A_zero_freq"][2][2], rel=0.05)
    assert database.force[0, 0, 2].real == pytest.approx(database.restoring[2, 2], rel=0.02)
    periods = 2.0 * np.pi / database.omega
    for name, key in (("added_mass", "A"), ("damping", "B")):
        for period, matrix in expected[key].items():
            found = getattr(database, name)[int(np.argmin(np.abs(periods - float(period))))]
            assert found == pytest.approx(np.array(matrix), rel=1e-12)
    for name, key in (("force", "force_rao_diffraction"), ("motion_rao", "motion_rao")):
        assert len(expected[key]) == 36
        for label, pairs in expected[key].items():
            period, heading = (float(part.split("=")[1]) for part in label.split(","))
            n = int(np.argmin(np.abs(periods - period)))
            m = int(np.argmin(np.abs(np.degrees(database.heading) - heading)))
            wanted = np.array(pairs) @ [1.0, 1j]
            assert getattr(database, name)[m, n] == pytest.approx(wanted, rel=1e-12, abs=0.0)


def test_closure(database: HydroDatabase, expected: dict[str, Any]) -> None:
    """The motions of the file follow from A, B, C, F and the external damping, as the reference found.

    The reference takes the worst heading by its own largest motion, the check the largest of all headings.
    """
    rows = {row.check: row for row in database.check()}
    long = database.omega <= 2.0 * np.pi / 5.0
    by_heading = motion_errors(database, motion_response(database), database.motion_rao, inside=long)
    for i, motion in enumerate(("surge", "sway", "heave", "roll", "pitch", "yaw")):
        reference = expected["closure_check"]["max_rel_err_by_dof"][i]
        # The reference leaves out 5 s itself, which is where heave and pitch are worst.
        assert by_heading[i] > 0.99 * reference
        if motion not in ("heave", "pitch"):
            assert by_heading[i] == pytest.approx(reference, rel=0.01)
        row = rows[f"motion_rao_{motion}"]
        assert (row.limit, row.verdict) == (0.01, "pass")
        assert 0.01 * reference < row.value <= 1.01 * by_heading[i]
        assert rows[f"damping_from_forces_{motion}"].value < 0.025
    bare = dataclasses.replace(database, linear_damping=np.zeros((6, 6)))
    assert {row.check: row for row in bare.check()}["motion_rao_roll"].verdict == "fail"


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
    edit(copy / "tanker.out", "Water density:     1025.00000", "")
    with pytest.warns(AssumedDensityWarning, match="1025 kg/m3"):
        found = read_wamit(copy)
    assert np.array_equal(found.force, database.force)
    assert np.array_equal(found.mass_matrix, first.mass_matrix)


def test_control_file_as_fortran_reads_it(copy: Path, database: HydroDatabase) -> None:
    """Comments after the numbers, matrices broken anywhere, external stiffness."""
    lines = (copy / "tanker.frc").read_text().split("\n")
    lines[2] += "  density"
    lines[5:11] = [" ".join(lines[5:11])]
    stiff = lines.index("1", 12)
    lines[stiff + 1] = "7e4, 0, 0,\n0 0 0"
    (copy / "tanker.frc").write_text("\n".join(lines))
    found = read_wamit(copy)
    assert np.array_equal(found.mass_matrix, database.mass_matrix)
    assert found.restoring[0, 0] == 7e4
    assert found.restoring[1:, 1:] == pytest.approx(database.restoring[1:, 1:])


def test_common_periods_and_headings_and_limits_of_the_added_mass(
    copy: Path, database: HydroDatabase
) -> None:
    """Periods missing in .3 and a heading missing in .4 are left out everywhere, with a warning.

    Period -1 is zero frequency, period 0 infinite; without its rows the limit is unknown, not zero.
    """
    for suffix, wanted in (
        (".3", lambda words: float(words[0]) < 100.0), (".4", lambda words: float(words[1]) != 40.0),
        (".1", lambda words: words[0] != "0.000000E+00"),
    ):  # fmt: skip
        rows = (copy / f"tanker{suffix}").read_text().splitlines(keepends=True)
        (copy / f"tanker{suffix}").write_text("".join(row for row in rows if wanted(row.split())))
    with pytest.warns(PartialSetWarning) as caught:
        found = read_wamit(copy)
    text = " ".join(str(warning.message) for warning in caught)
    assert "periods 110.01, 121.53" in text and "headings 40 deg" in text
    assert found.infinite_frequency_added_mass is None
    assert np.array_equal(found.zero_frequency_added_mass, database.zero_frequency_added_mass)
    kept = [i for i in range(19) if i != 4]
    assert np.array_equal(found.heading, database.heading[kept])
    assert np.array_equal(found.damping, database.damping[5:])
    for name in ("force", "motion_rao"):
        assert np.array_equal(getattr(found, name), getattr(database, name)[kept, 5:])


def test_length_scale_depth_and_upper_case_suffixes(copy: Path, database: HydroDatabase) -> None:
    """The same ship in units of 2 m: A / 2^k, C / 2^(k-1), X / 2^2 or 2^3, rotations x 2."""
    edit(copy / "tanker.out", "Length scale:        1.00000", "Length scale:        2.00000")
    edit(copy / "tanker.out", "Water depth:        infinite ", "Water depth:       55.00000 ")
    (copy / "tanker.3").write_text("period heading i mod pha re im\n" + (copy / "tanker.3").read_text())
    edit(copy / "tanker.frc", "1 0 1 1 0 0 0 0 1", "1 0 1 2 0 0 0 0 1")
    for suffix in (".out", ".frc", ".hst"):
        (copy / f"tanker{suffix}").rename(copy / f"tanker{suffix.upper()}")
    found = read_wamit(copy)
    assert found.depth == 55.0
    assert found.motion_rao_limit.tolist() == [1e-3] * 6  # of motions from diffraction forces
    for name, at, factor in (
        ("added_mass", (5, 2, 2), 2.0**3), ("added_mass", (5, 2, 4), 2.0**4), ("damping", (5, 4, 4), 2.0**5),
        ("restoring", (2, 2), 2.0**2), ("restoring", (4, 4), 2.0**4), ("force", (3, 5, 2), 2.0**2),
        ("force", (3, 5, 4), 2.0**3), ("motion_rao", (3, 5, 2), 1.0), ("motion_rao", (3, 5, 4), 0.5),
    ):  # fmt: skip
        assert getattr(found, name)[at] == pytest.approx(factor * getattr(database, name)[at]), (name, at)


def test_files_that_are_missing_or_side_by_side(copy: Path, database: HydroDatabase) -> None:
    for name in ("tanker", "tanker.hst"):
        assert np.array_equal(load_database(copy / name).force, database.force)
    (copy / "tanker.4").unlink()  # motions are optional
    assert read_wamit(copy).motion_rao is None
    shutil.copyfile(copy / "tanker.1", copy / "other.1")
    with pytest.raises(FileFormatError, match="other, tanker"):
        load_database(copy)


def test_forces_by_haskind_alone(copy: Path, database: HydroDatabase) -> None:
    """Taken as those by diffraction are; told is what they are."""
    (copy / "tanker.3").rename(copy / "tanker.2")
    with pytest.warns(PartialSetWarning, match=r"tanker\.2: read in place of \.3, .* Haskind"):
        found = read_wamit(copy)
    assert np.array_equal(found.force, database.force) and np.array_equal(
        found.motion_rao, database.motion_rao
    )


def test_motions_alone(copy: Path, database: HydroDatabase) -> None:
    """Forces are solved of them with masses and matrices: those by diffraction as near as the motions are."""
    (copy / "tanker.3").unlink()
    with pytest.warns(PartialSetWarning, match=r"tanker\.4: .* motions that the forces are solved of"):
        found = read_wamit(copy)
    assert found.motion_rao is None
    assert np.abs(motion_response(found) - database.motion_rao).max() < 1e-9
    waves = found.omega < 2.0 * np.pi / 5.0
    sizes = np.abs(database.force[:, waves]).max(axis=(0, 1))
    assert np.all(np.abs(found.force - database.force)[:, waves].max(axis=(0, 1)) < 0.05 * sizes)
    (copy / "tanker.frc").unlink()
    with (
        pytest.warns(PartialSetWarning),
        pytest.raises(FileFormatError, match="only with the masses; give mass"),
    ):
        read_wamit(copy)


@pytest.mark.parametrize(
    ("there", "told"),
    [
        ("4", r"tanker\.1: no such file; .* there are \.4, and no \.1, \.hst$"),
        ("2", r"tanker\.1: no such file; .* there are \.2, and no \.1, \.hst$"),
        ("1 hst out", r"tanker\.3: no such file; .* one of \.3 \(forces by diffraction\), .* and no \.3$"),
        *((kind, rf"there are \.{kind}, and no .* second order") for kind in ("10d", "11d", "12d", "12s")),
    ],
)  # fmt: skip
def test_what_is_missing_is_told(there: str, told: str, tmp_path: Path, tanker: Path) -> None:
    for suffix in there.split():
        (tmp_path / f"tanker.{suffix}").write_text(" 8.0 8.0 0.0 0.0 1 1.0 0.0 1.0 0.0\n")
        if suffix == "out":
            shutil.copyfile(tanker / "tanker.out", tmp_path / "tanker.out")
    with pytest.raises(FileFormatError, match=told):
        load_database(tmp_path / f"tanker.{there.split()[0]}")


def drift_rows(database: HydroDatabase, kind: str) -> tuple[str, np.ndarray]:
    """Text of a file of mean loads at two periods and three headings, and the loads in SI (3, 2, 6)."""
    value = np.random.default_rng(5).normal(size=(3, 2, 6))  # by heading, period
    motions = (1, 2, 6) if kind == ".8" else range(1, 7)
    rows: list[list[float]] = []
    for (p, period), (h, heading) in itertools.product(enumerate((8.0, 12.0)), enumerate((0.0, 90.0, 180.0))):
        for i in motions:
            real = value[h, p, i - 1]
            first = [period, period] if kind.endswith("d") else [period]
            numbers = [heading, heading, i, abs(real), 0.0 if real > 0.0 else 180.0, real, 0.0]
            rows.append([*first, *numbers])
            if not kind.endswith("d"):  # two headings: no single wave
                rows.append([*first, heading, heading + 5.0, *numbers[2:]])
            elif p == 0:  # two periods beat: no mean load
                rows.append([8.0, 12.0, *numbers])
    there = np.isin(np.arange(1, 7), motions)
    text = "\n".join(" ".join(f"{number:.9E}" for number in row) for row in rows) + "\n"
    return text, value[:, ::-1] * database.rho * database.g * there


@pytest.mark.parametrize("kind", [".8", ".9", ".12d", ".11d", ".10d"])
def test_mean_drift(copy: Path, database: HydroDatabase, kind: str) -> None:
    """Of one wave alone, in SI (ULEN is 1); frequencies rise; pressures are taken before momentum (.8)."""
    if kind == ".9":
        (copy / "tanker.8").write_text(drift_rows(database, ".8")[0])
    text, wanted = drift_rows(database, kind)
    (copy / f"tanker{kind}").write_text(text)
    drift = load_database(copy).drift
    assert drift.omega == pytest.approx([2.0 * np.pi / 12.0, 2.0 * np.pi / 8.0])
    assert np.degrees(drift.heading) == pytest.approx([0.0, 90.0, 180.0])
    assert np.abs(drift.coefficient - wanted).max() <= 1e-8 * np.abs(wanted).max()
