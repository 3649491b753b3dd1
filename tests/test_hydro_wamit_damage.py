"""WAMIT reader on truncated and altered files: the file and the line, or numbers that are right."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from seacrane.errors import FileFormatError
from seacrane.hydro import HydroDatabase, PartialSetWarning, read_wamit

TABLES = (".1", ".3", ".4", ".hst")
EXACT = (".1", ".3", ".4", ".hst", ".frc")


@pytest.fixture(scope="module")
def small(shared: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The tanker's files cut down to its limits, three periods and three headings."""
    periods = ("-0.100000E+01", "0.000000E+00", "0.653000E+01", "0.863000E+01", "0.104400E+02")
    headings = ("0.000000E+00", "0.900000E+02", "0.180000E+03")
    content = {}
    for suffix in (*EXACT, ".out", ".cfg"):
        lines = (shared / "wamit" / f"tanker{suffix}").read_text().splitlines(keepends=True)
        if suffix == ".1":
            lines = [line for line in lines if line.split()[0] in periods]
        elif suffix in (".3", ".4"):
            lines = [line for line in lines if line.split()[0] in periods and line.split()[1] in headings]
        elif suffix == ".out":
            lines = lines[:122] + [line for line in lines if "Wave period (sec)" in line]
        content[suffix] = "".join(lines)
    return content


@pytest.fixture(scope="module")
def reference(small: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> HydroDatabase:
    """What the undamaged small set holds."""
    return read_wamit(write(tmp_path_factory.mktemp("whole"), small))


def write(folder: Path, content: dict[str, str]) -> Path:
    """The set of files as ``box`` in ``folder``."""
    for suffix, text in content.items():
        (folder / f"box{suffix}").write_text(text, encoding="latin-1")
    return folder


def same(a: HydroDatabase, b: HydroDatabase) -> bool:
    """Whether all numbers agree, bit for bit."""
    names = (
        "omega",
        "heading",
        "added_mass",
        "damping",
        "force",
        "restoring",
        "mass_matrix",
        "linear_damping",
    )
    limits = ("infinite_frequency_added_mass", "zero_frequency_added_mass", "motion_rao")
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in (*names, *limits))


@pytest.mark.parametrize("suffix", EXACT)
def test_every_truncation_at_a_line(
    suffix: str, small: dict[str, str], reference: HydroDatabase, tmp_path: Path
) -> None:
    """Named with its line, unless whole periods of .1, .3 or .4 are gone: then a warning."""
    lines = small[suffix].splitlines(keepends=True)
    needed = lines[:-1] if suffix == ".frc" else lines  # the last line of .frc is not needed
    for kept in range(len(needed)):
        write(tmp_path, small | {suffix: "".join(lines[:kept])})
        try:
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                found = read_wamit(tmp_path)
        except FileFormatError as error:
            assert f"box{suffix}, line" in str(error)
        else:
            assert suffix in (".1", ".3", ".4")
            assert caught and all(warning.category is PartialSetWarning for warning in caught)
            assert set(found.omega) < set(reference.omega)


@pytest.mark.parametrize("suffix", EXACT)
def test_truncation_inside_the_last_number(suffix: str, small: dict[str, str], tmp_path: Path) -> None:
    text = small[suffix].rstrip("\n")
    cut = text[:-3] if suffix == ".frc" else text[:-2]
    write(tmp_path, small | {suffix: cut})
    with pytest.raises(FileFormatError, match=rf"box\{suffix}, line \d+"):
        read_wamit(tmp_path)


@pytest.mark.parametrize("kept", [0, 1, 60, 95, 100, 105, 110, 118, 125, 151, -1])
def test_truncated_listing(
    kept: int, shared: Path, small: dict[str, str], reference: HydroDatabase, tmp_path: Path
) -> None:
    lines = small[".out"].splitlines(keepends=True)
    write(tmp_path, small | {".out": "".join(lines[:kept])})
    if kept == -1:  # behind the longest of the three periods
        assert same(read_wamit(tmp_path), reference)
    else:
        with pytest.raises(FileFormatError, match=r"box\.out, line \d+: the file ends without"):
            read_wamit(tmp_path)


@pytest.mark.parametrize(
    ("suffix", "old", "new", "message"),
    [
        (".1", "1.461084E+03", "1.46x084E+03", r"box\.1, line \d+: '1\.46x084E\+03' is not a number"),
        (".1", "1.461084E+03", "nan", r"box\.1, line \d+: a number is not finite"),
        (".1", "1.461084E+03", "", r"box\.1, line \d+: (no damping|4 or 5 numbers)"),
        (
            ".hst",
            "     6     6   0.000000E+00",
            "     6     7   0.000000E+00",
            r"box\.hst, line 36: motion 7",
        ),
        (
            ".hst",
            "     6     6   0.000000E+00",
            "     6     5   0.000000E+00",
            r"box\.hst, line 36: .* before",
        ),
        (".hst", "1.022150E+04", "-1.022150E+04", "C33 = -1.02"),
        (".frc", "1025.00", "-5", r"box\.frc, line 3: density -5"),
        (".frc", "1025.00", "1000.00", r"density 1000 kg/m3 in \.frc but 1025 in \.out"),
        (".frc", "1 0 1 1 0 0 0 0 1\n", "1 0 1\n", r"box\.frc, line \d+"),
        (".frc", "417428070207.44", "417428x", r"box\.frc, line 11: .*'417428x' is not a number"),
        (".frc", "417428070207.44", "-4", "not positive definite"),
        (
            ".frc",
            "3.93 0.00 2.5\n1\n",
            "3.93 0.00 2.5\n2\n",
            r"box\.frc, line 5: flag 2 of the external mass",
        ),
        (".out", "9.80665", "-9.80665", "gravity -9.80665"),
        (".out", "XBODY =    0.0000", "XBODY =   12.0000", "XBODY, YBODY, PHIBODY are 12, 0, 0"),
        (".out", "Volumes (VOLX", "Volums (VOLX", r"box\.out, line \d+: .* the displaced volumes"),
        (".cfg", "IPERIO=1", "IPERIO=2", r"box\.cfg, line 7: IPERIO=2"),
    ],
)
def test_alterations(
    suffix: str, old: str, new: str, message: str, small: dict[str, str], tmp_path: Path
) -> None:
    assert old in small[suffix]
    write(tmp_path, small | {suffix: small[suffix].replace(old, new, 1)})
    with pytest.raises(FileFormatError, match=message):
        read_wamit(tmp_path)


@pytest.mark.parametrize("suffix", [".3", ".4"])
@pytest.mark.parametrize("column", [3, 4, 5, 6])
def test_modulus_and_parts_have_to_agree(
    suffix: str, column: int, small: dict[str, str], tmp_path: Path
) -> None:
    lines = small[suffix].splitlines(keepends=True)
    words = lines[2].split()
    words[column] = f"{float(words[column]) * 1.01 + 0.5 * (column == 4):.6E}"
    lines[2] = " ".join(words) + "\n"
    write(tmp_path, small | {suffix: "".join(lines)})
    with pytest.raises(FileFormatError, match=rf"box\{suffix}, line 3: modulus .* damaged"):
        read_wamit(tmp_path)


@pytest.mark.parametrize("suffix", TABLES)
def test_lost_and_doubled_lines(suffix: str, small: dict[str, str], tmp_path: Path) -> None:
    lines = small[suffix].splitlines(keepends=True)
    write(tmp_path, small | {suffix: "".join(lines[:20] + lines[21:])})
    with pytest.raises(FileFormatError, match=rf"box\{suffix}, line \d+: .*(missing|of 36)"):
        read_wamit(tmp_path)
    write(tmp_path, small | {suffix: "".join([*lines, lines[20]])})
    with pytest.raises(FileFormatError, match=rf"box\{suffix}, line {len(lines) + 1}: .*given before"):
        read_wamit(tmp_path)


@pytest.mark.filterwarnings("ignore::UserWarning")
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_random_damage_gives_a_database_or_a_named_error(
    data: st.DataObject, small: dict[str, str], tmp_path: Path
) -> None:
    suffix = data.draw(st.sampled_from(sorted(small)))
    text = small[suffix]
    start = data.draw(st.integers(0, len(text) - 1))
    removed = data.draw(st.integers(0, 40))
    inserted = data.draw(st.text(alphabet="0123456789.-+eEDnaif \n\x00é", max_size=12))
    write(tmp_path, small | {suffix: text[:start] + inserted + text[start + removed :]})
    try:
        database = read_wamit(tmp_path)
    except FileFormatError as error:
        assert "box" in str(error)
    else:
        assert np.all(np.isfinite(database.force))
