"""VERES drift coefficients, hydrostatics and version 1, on the supply vessel's files; damaged ones too."""

from __future__ import annotations

import json
import re
import shutil
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from veres_writer import VeresRun

from seacrane.errors import FileFormatError
from seacrane.hydro import (
    HydroDatabase,
    VeresHydrostatics,
    load_database,
    read_veres,
    read_veres_hydrostatics,
)
from seacrane.hydro.readers.veres_files import read_matrices
from seacrane.warnings import HydrostaticsWarning

TO_OURS = np.array([-1.0, -1.0, 1.0])  # surge, sway, yaw


@pytest.fixture(scope="module")
def supply(shared: Path) -> Path:
    """Folder of the supply vessel's files."""
    return shared / "veres" / "supply"


@pytest.fixture(scope="module")
def database(supply: Path) -> HydroDatabase:
    """The supply vessel; nothing about it warns."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return load_database(supply)


@pytest.fixture
def copy(supply: Path, tmp_path: Path) -> Path:
    """A writable copy of all files."""
    for suffix in (".re1", ".re2", ".re7", ".re8", ".hyd"):
        shutil.copy(supply / f"input{suffix}", tmp_path)
        (tmp_path / f"input{suffix}").chmod(0o644)
    return tmp_path


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """A small written set with a hydrostatics file that agrees with it."""
    folder = tmp_path_factory.mktemp("small")
    VeresRun(omega=np.linspace(0.3, 2.0, 4), heading_deg=np.array([0.0, 90.0, 180.0])).write(folder)
    content = {suffix: (folder / f"box{suffix}").read_text() for suffix in (".re1", ".re2", ".re7", ".re8")}
    return content | {".hyd": HYD}


HYD = """99
Length between perpendiculars    (m)     60.000
Breadth                          (m)     14.000
Draught, midship                 (m)      5.000
Displacement                (tonnes)    4310.00       4300.00*
Vertical center of gravity,      VCG      6.000*
Longitudinal center of bouyancy, LCB                   28.500*
Transverse metacentric height,   GMt                    1.422*
"""


def write(folder: Path, content: dict[str, str]) -> Path:
    """The set of files as ``box`` in ``folder``."""
    for suffix, text in content.items():
        (folder / f"box{suffix}").write_text(text, encoding="latin-1")
    return folder


def test_drift_against_the_reference_values(database: HydroDatabase, supply: Path) -> None:
    expected: dict[str, Any] = json.loads((supply / "expected.json").read_text())
    factors = expected["drift_dimensional_factor"]
    drift = database.drift
    assert drift is not None
    for key, coefficients in expected["drift_file_coeff"].items():
        k, h = (int(part) for part in key.split(","))
        direction = np.mod(np.radians(expected["heading_deg"][h]) + np.pi, 2.0 * np.pi)
        place = int(np.argmin(np.abs(np.exp(1j * drift.heading) - np.exp(1j * direction))))
        load = np.array(coefficients) * TO_OURS * [factors["Fx"], factors["Fy"], factors["Mz"]]
        assert drift.coefficient[place, k, [0, 1, 5]] == pytest.approx(load, rel=1e-6)
    assert not np.any(drift.coefficient[:, :, 2:5])
    assert np.array_equal(drift.omega, database.omega)
    assert np.array_equal(drift.heading, database.heading)


def test_drift_pushes_where_the_waves_go(database: HydroDatabase) -> None:
    """Short waves are reflected: in beam seas the load comes near rho g L / 2 and does not exceed it."""
    drift = database.drift
    assert drift is not None
    at = {degrees: int(np.argmin(np.abs(drift.heading - np.radians(degrees)))) for degrees in (180, 270)}
    waves = drift.omega > 0.5
    assert np.all(drift.coefficient[at[180], waves, 0] < 0.0)  # head sea, astern
    assert np.all(drift.coefficient[at[270], waves, 1] < 0.0)  # towards starboard
    wall = 0.5 * database.rho * database.g * database.length
    assert 0.9 < -drift.coefficient[at[270], -1, 1] / wall <= 1.0


def test_drift_survives_our_netcdf(database: HydroDatabase, tmp_path: Path) -> None:
    database.save(tmp_path / "ship.nc")
    again = load_database(tmp_path / "ship.nc").drift
    assert again is not None and database.drift is not None
    assert np.array_equal(again.coefficient, database.drift.coefficient)


def test_drift_is_optional(copy: Path) -> None:
    (copy / "input.re2").unlink()
    found = read_veres(copy)
    assert found.drift is None
    assert "no .re2: no drift" in found.source


def test_drift_of_another_run_is_refused(copy: Path) -> None:
    text = (copy / "input.re2").read_text()
    (copy / "input.re2").write_text(text.replace("   1.0472  ", "   1.0572  "))
    with pytest.raises(FileFormatError, match=r"input\.re2: frequencies differ from the \.re7 file"):
        read_veres(copy)
    (copy / "input.re2").write_text(text.replace("0.82800003E+02", "0.92800003E+02"))
    with pytest.raises(FileFormatError, match=r"input\.re2: header"):
        read_veres(copy)


def test_hydrostatics(supply: Path) -> None:
    found = read_veres_hydrostatics(supply / "input.hyd")
    assert found == VeresHydrostatics(
        length=82.8, breadth=19.2, draught=6.0, sinkage=0.0, trim_deg=0.0, displacement=6362210.0, kb=3.334,
        vcg=7.3, lcb=36.014, lcg=36.014, cb=0.651, cw=0.870, gm_transverse=2.144, gm_longitudinal=103.628,
        r44=6.72, r55=20.7, r66=20.7,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("6362.21*", "6442.21*", r"displacement 6.44221e\+06 against 6.36221e\+06"),
        ("2.144*", "2.344*", r"gm_transverse 2.344 against 2.14\d+"),
        ("103.628*", "99.628*", r"gm_longitudinal 99.628 against 103"),
        ("                   36.014*", "                   35.014*", r"lcb 35.014 against 36.014"),
        ("36.000        36.014*", "36.000*       36.214", ""),  # the marked one agrees
        ("36.000        36.014*", "36.000        37.014*", r"lcg 37.014 against 36.014"),
        ("7.300*", "7.400*", r"vcg 7.4 against 7.3"),
        ("6.720*", "6.920*", r"r44 6.92 against 6.72"),
        ("r55     20.700*", "r55     21.700*", r"r55 21.7 against 20.7"),
        ("19.200", "18.200", r"breadth 18.2 against 19.2"),
    ],
)
def test_hydrostatics_that_contradict_the_matrices(copy: Path, old: str, new: str, message: str) -> None:
    text = (copy / "input.hyd").read_text()
    assert old in text
    (copy / "input.hyd").write_text(text.replace(old, new, 1))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        read_veres(copy)
    assert len(caught) == bool(message)
    for warning in caught:
        assert warning.category is HydrostaticsWarning
        assert re.search(message, str(warning.message))


def test_version_1_of_the_supply_vessel(copy: Path, database: HydroDatabase) -> None:
    """The same file without its version line and additional blocks, which is how version 1 is documented."""
    lines = (copy / "input.re7").read_text().splitlines()
    out = lines[:9] + lines[10:18]
    position = 18
    for _ in range(19):
        out.append(lines[position])
        position += 1
        for _ in range(36):
            block = lines[position : position + 38]
            out += [block[0], *block[1:7], *block[13:19], *block[25:31], block[37]]
            position += 38
    (copy / "input.re7").write_text("\n".join(out) + "\n")
    assert read_matrices(copy / "input.re7").version == 1
    found = read_veres(copy)
    assert found.additional == ()
    for name in ("added_mass", "damping", "restoring", "mass_matrix", "force", "omega", "motion_rao"):
        assert np.array_equal(getattr(found, name), getattr(database, name))
    assert found.roll_damping is not None and database.roll_damping is not None
    assert np.array_equal(found.roll_damping.linearised, database.roll_damping.linearised)
    (copy / "input.re7").write_text("\n".join(out[:-20]) + "\n")
    with pytest.raises(FileFormatError, match=r"input\.re7, line \d+: .* truncated"):
        read_veres(copy)


def test_the_small_set_is_sound(small: dict[str, str], tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert read_veres(write(tmp_path, small)).drift is not None


def test_every_truncation_of_hyd_is_noticed_or_leaves_a_row_out(tmp_path: Path) -> None:
    lines = HYD.splitlines()
    whole = tmp_path / "box.hyd"
    for kept in range(len(lines)):
        whole.write_text("\n".join(lines[:kept]))
        if kept < 2:
            with pytest.raises(FileFormatError, match=r"box\.hyd: none of the rows"):
                read_veres_hydrostatics(whole)
        else:
            assert read_veres_hydrostatics(whole).length == 60.0
            whole.write_text("\n".join([*lines[: kept - 1], lines[kept - 1][:36]]))  # before its number
            with pytest.raises(FileFormatError, match=rf"box\.hyd, line {kept}: .*truncated"):
                read_veres_hydrostatics(whole)
