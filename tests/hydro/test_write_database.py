"""What any reader read is written, read back and compared; the table of kinds in command and document."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest

from seacrane.cli import main
from seacrane.errors import FileFormatError, SceneError
from seacrane.hydro import (
    HydroDatabase,
    load_database,
    read_wamit,
    rigid_mass_matrix,
    shipped_database,
    two_barges,
    write_database,
)
from seacrane.hydro.readers.load import FORMATS

SHARED = (
    "wamit", "wamit_fpso", "veres/supply", "aqwa/cylinder.AH1", "aqwa/cylinder.LIS", "orcaflex/testModel.yml",
)  # fmt: skip


@pytest.fixture(scope="module")
def hull() -> HydroDatabase:
    return shipped_database().select(every=6, every_heading=6)


@pytest.mark.parametrize("name", ["hull.nc", "hull.1", "hull"])
def test_round_trip(name: str, hull: HydroDatabase, tmp_path: Path) -> None:
    rows = write_database(database=hull, path=tmp_path / name)
    assert {row.verdict for row in rows if row.check.startswith("written")} == {"pass"} and len(rows) >= 10
    if name == "hull.nc":
        assert np.array_equal(load_database(tmp_path / name).force, hull.force)
        return
    assert sorted(file.name for file in tmp_path.iterdir()) == ["hull.1", "hull.3", "hull.frc", "hull.hst"]
    found = read_wamit(tmp_path / "hull", volume=hull.mass_matrix[0, 0] / hull.rho, g=hull.g)
    assert np.abs(found.force - hull.force).max() <= 1e-6 * np.abs(hull.force).max()
    period, i, j, a, b = (tmp_path / "hull.1").read_text().splitlines()[-1].split()
    assert (i, j) == ("6", "6") and float(period) == pytest.approx(2.0 * np.pi / hull.omega[-1])
    assert float(a) * hull.rho == pytest.approx(hull.added_mass[-1, 5, 5], rel=1e-6)
    assert float(b) * hull.rho * hull.omega[-1] == pytest.approx(hull.damping[-1, 5, 5], rel=1e-6)


def test_what_wamits_files_do_not_hold_is_told(hull: HydroDatabase, tmp_path: Path) -> None:
    rich = dataclasses.replace(hull, quadratic_damping=np.ones(6), memory=shipped_database().memory)
    left_out = [
        row.check for row in write_database(database=rich, path=tmp_path / "a.1") if row.limit is None
    ]
    assert left_out == ["left_out_quadratic_damping", "left_out_memory"]


@pytest.mark.filterwarnings("ignore::seacrane.warnings.SeacraneWarning")
@pytest.mark.parametrize("place", SHARED)
def test_every_kind_becomes_every_kind(place: str, shared: Path, tmp_path: Path) -> None:
    """A real file, as NetCDF and as WAMIT's files; its source tells who read it."""
    if not (shared / place).exists():
        pytest.skip(f"no {shared / place}")
    found = load_database(shared / place)
    assert any(word in found.source for word in ("WAMIT", "VERES", "Aqwa", "OrcaFlex"))
    for name in ("ship.nc", "ship.1"):
        rows = write_database(database=found, path=tmp_path / name)  # type: ignore[arg-type]
        assert "fail" not in {row.verdict for row in rows}, rows


def test_refusals(hull: HydroDatabase, tmp_path: Path) -> None:
    (tmp_path / "there.hst").touch()
    (tmp_path / "folder").mkdir()
    for database, name, answer in (
        (hull, "hull.yml", r"\.yml is not written"),
        (hull, "there.1", "there.hst is there"),
        (hull, "folder", "is a folder"),
        (hull, "folder.1", "another stem"),
        (dataclasses.replace(hull, speed=5.0, memory=None), "a.1", "5 m/s"),
        (two_barges(lid_damping=None), "a.nc", "each hull"),
    ):
        with pytest.raises(SceneError, match=answer):
            write_database(database=database, path=tmp_path / name)  # type: ignore[arg-type]
    write_database(database=dataclasses.replace(hull, name="two\nlines"), path=tmp_path / "hull.1")
    assert (tmp_path / "hull.frc").read_text().startswith("two lines: ")


def test_the_command_asks_for_masses_writes_and_lists(
    hull: HydroDatabase, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["hydro", "--json"]) == 0
    kinds = {row["kind"]: row for row in json.loads(capsys.readouterr().out)}
    assert set(kinds) == {one.name for one in FORMATS} and "mass_matrix" in kinds["AQWA"]["may be given"]
    hull.save(tmp_path / "hull.nc")
    assert main(["hydro", str(tmp_path / "hull.nc"), "--write", str(tmp_path / "out.1")]) == 0
    out = capsys.readouterr().out
    assert out.startswith(hull.source) and "written_force" in out
    with pytest.raises(FileFormatError, match="holds its mass; leave mass_matrix out"):
        load_database(tmp_path / "hull.nc", mass_matrix=np.eye(6))


@pytest.mark.filterwarnings("ignore::seacrane.warnings.SeacraneWarning")
def test_masses_by_argument_and_by_command(
    shared: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A barge whose file has a placeholder of 1 t."""
    pytest.importorskip("yaml", reason="needs the extra 'orcaflex'")
    file = shared / "orcaflex" / "barge_100x30x4_q1.yml"
    if not file.exists():
        pytest.skip(f"no {file}")
    assert main(["hydro", str(file)]) == 1 and "--mass" in capsys.readouterr().err
    given = ["12300", "0", "0", "1.5", "10", "25", "25"]
    assert main(["hydro", str(file), "--mass", *given, "--write", str(tmp_path / "barge.nc"), "--json"]) == 0
    rows = {row["check"]: row["value"] for row in json.loads(capsys.readouterr().out)}
    assert rows["mass_t"] == pytest.approx(12300.0) and rows["written_force"] == 0.0
    inertia = 12.3e6 * np.diag([100.0, 625.0, 625.0])
    matrix = rigid_mass_matrix(12.3e6, np.array([0.0, 0.0, 1.5]), inertia)
    assert load_database(tmp_path / "barge.nc").mass_matrix == pytest.approx(matrix)
    assert load_database(file, mass_matrix=matrix).mass_matrix == pytest.approx(matrix)
