"""NEMOH's folders and BEMIO's files written after their descriptions, what Capytaine exports, damage."""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from test_hydro_capytaine import solved_barge

from seacrane.errors import FileFormatError
from seacrane.hydro import HydroDatabase, HydroGroup, load_database, read_bemio, read_nemoh, shipped_database
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import AssumedDensityWarning

CENTRE = np.array([3.0, 0.0, -2.0])  # of the rotations, from the origin of the mesh

RADIATION, WAVES, CONTROL = "results/RadiationCoefficients.tec", "results/ExcitationForce.tec", "Nemoh.cal"
DAMAGE: list[tuple[str, Callable[[str], str], str]] = [
    (RADIATION, lambda text: text[: text.rindex("Zone")], "5 degrees of freedom"),
    (RADIATION, lambda text: text.rstrip().rpartition("\n")[0] + "\n", "other frequencies"),
    (CONTROL, lambda text: text.replace("1 ! Number", "2 ! Number"), "2 bodies with 6"),
    (CONTROL, lambda text: text.replace("-2.0 !", "-1.0 !", 1), "turn about 2 points"),
]  # fmt: skip


def shipped_part() -> HydroDatabase:
    return shipped_database().select(every=6, every_heading=3)


def control(turn: np.ndarray, depth: float = 0.0) -> str:
    motions = [f"1 {x} {y} {z} 0. 0. 0. ! translation" for x, y, z in np.eye(3)]
    motions += [f"2 {x} {y} {z} {turn[0]} {turn[1]} {turn[2]} ! rotation" for x, y, z in np.eye(3)]
    head = ["--- Environment ---", "1025.0 ! RHO", "9.81 ! G", f"{depth} ! DEPTH", "0. 0. ! XEFF YEFF"]
    body = ["--- Bodies ---", "1 ! Number of bodies", "--- Body 1 ---", "ship.dat ! Mesh", "540 300 !"]
    return "\n".join([*head, *body, "6 ! Degrees of freedom", *motions, "6 ! Forces", *motions, "0 !"]) + "\n"


def write_tables(base: HydroDatabase | HydroGroup, folder: Path, place: Any, *, old: bool) -> None:
    """As NEMOH 2 or 3 leaves radiation and waves, to twelve digits, waves measured at a place (x, y)."""
    head, wide, size = ['VARIABLES="w (rad/s)"'], 4 if old else 1, f"I= {len(base.omega)}," if old else ""

    def row(omega: float, one: np.ndarray, other: np.ndarray) -> str:
        return " ".join(f"{value:.12E}" for value in (omega, *np.stack([one, other], axis=1).ravel()))

    radiation = head + [f'"A\t1\t{i}" "B\t1\t{i}"' for i in range(1, 7) if old]
    for j in range(base.added_mass.shape[1]):
        motion = f"Motion of body {j // 6 + 1:{wide}d} in DoF {j % 6 + 1:{wide}d}"
        radiation.append(f'Zone t="{motion}",{size}F=POINT')
        radiation += map(row, base.omega, base.added_mass[:, :, j], base.damping[:, :, j])
    waves = head + [f'"abs(F\t1\t{i})" "angle(F\t1\t{i})"' for i in range(1, 7) if old]
    k = wavenumber(base.omega, g=base.g, depth=np.inf)
    for heading, forces in zip(base.heading, base.force, strict=True):
        waves.append(f'Zone t="Excitation force - beta = {np.degrees(heading):.8f} deg",{size}F=POINT')
        along = place[0] * np.cos(heading) + place[1] * np.sin(heading)
        there = np.conj(forces * np.exp(1j * along * k)[:, None])
        waves += map(row, base.omega, np.abs(there), np.angle(there))
    for name, lines in (("RadiationCoefficients", radiation), ("ExcitationForce", waves)):
        (folder / f"{name}.tec").write_text("\n".join(lines) + "\n")


def write_hydrostatics(folder: Path, number: str, restoring: Any, gravity: Any, volume: float) -> None:
    np.savetxt(folder / f"{'Kh' if number else 'KH'}{number}.dat", restoring, fmt="%.12E")
    lines = [f"{axis}F = 0.0 - {axis}G = {at:7.4f}" for axis, at in zip("XYZ", gravity, strict=True)]
    text = "\n".join([*lines, f"Displacement = {volume:.10E}\n"])
    (folder / f"Hydrostatics{number}.dat").write_text(text)


def write_project(base: HydroDatabase, folder: Path) -> None:
    """A project folder of NEMOH 2."""
    (folder / "results").mkdir(parents=True)
    (folder / "mesh").mkdir()
    (folder / "Nemoh.cal").write_text(control(CENTRE))
    write_tables(base, folder / "results", -CENTRE, old=True)
    gravity, volume = CENTRE + np.array([0.0, 0.0, 1.5]), base.mass_matrix[0, 0] / base.rho
    write_hydrostatics(folder / "mesh", "", base.restoring, gravity, volume)


def assert_same(found: HydroDatabase, base: HydroDatabase, tolerance: float) -> None:
    for name in ("omega", "heading", "added_mass", "damping", "restoring", "force"):
        mine, theirs = getattr(found, name), getattr(base, name)
        assert np.abs(mine - theirs).max() <= tolerance * np.abs(theirs).max(), name


def test_what_was_written_comes_back(tmp_path: Path) -> None:
    base, folder = shipped_part(), tmp_path / "ship"
    write_project(base, folder)
    for inside, depth in (("", np.inf), ("results", np.inf), ("Nemoh.cal", 30.0)):
        if depth == 30.0:
            (folder / inside).write_text(control(CENTRE, depth=depth))
        found = load_database(folder / inside)
        assert (found.name, found.rho, found.g, found.depth) == ("ship", 1025.0, 9.81, depth)
        if depth == np.inf:
            assert_same(found, base, 1e-8)
        assert found.port_starboard_symmetric and found.mass_matrix is None


@pytest.mark.warns("DampingWarning")
def test_what_capytaine_exports(tmp_path: Path) -> None:
    """No Nemoh.cal: water and rotation centre are the caller's. Seven digits are written."""
    capytaine = pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    exported = pytest.importorskip("capytaine.io.legacy", reason="capytaine absent: pip install .[hydro]")
    dataset = solved_barge(10.0, 0.0)
    capytaine.export_dataset(tmp_path / "whole.nc", dataset)
    whole = load_database(tmp_path / "whole.nc")
    (tmp_path / "barge").mkdir()
    exported.write_dataset_as_tecplot_files(tmp_path / "barge", dataset)
    np.savetxt(tmp_path / "barge" / "KH.dat", whole.restoring)
    (tmp_path / "barge" / "Hydrostatics.dat").write_text(
        "XF = 10.0 - XG = 10.0\nYF = 0.0 - YG = 0.0\nZF = -1.0 - ZG = 0.5\nDisplacement = 384.0\n"
    )
    with pytest.warns(AssumedDensityWarning, match=r"has no Nemoh\.cal; 1000 kg/m3, 9.81 m/s2"):
        found = read_nemoh(
            tmp_path / "barge", rho=whole.rho, rotation_centre=(10.0, 0.0, 0.0), mass_matrix=whole.mass_matrix
        )
    assert_same(found, whole, 3e-6)
    assert np.array_equal(found.mass_matrix, whole.mass_matrix)


def test_damage_is_named(tmp_path: Path) -> None:
    base, folder = shipped_part(), tmp_path / "ship"
    write_project(base, folder)
    for file, change, message in DAMAGE:
        text = (folder / file).read_text()
        (folder / file).write_text(change(text))
        with pytest.raises(FileFormatError, match=message):
            read_nemoh(folder, mass_matrix=base.mass_matrix)
        (folder / file).write_text(text)


HEIGHT = 1.9  # m, of the centre of gravity
BODY = "body1/hydro_coeffs"


def bemio_values(base: HydroDatabase, along: float = 0.0) -> dict[str, Any]:
    """Entries of a BEMIO file of a vessel whose centre of gravity is ``along`` m from the waves' origin."""
    low, rho, g = base.at((0.0, 0.0, HEIGHT)), base.rho, base.g
    k = wavenumber(base.omega, g=g, depth=base.depth)
    force = low.force * np.exp(-1j * along * np.outer(np.cos(base.heading), k))[:, :, None]
    backwards = slice(None, None, -1)  # periods rise in a file
    parts = force[:, backwards].transpose(2, 0, 1) / (rho * g)
    damping = low.damping / base.omega[:, None, None] / rho
    return {
        "simulation_parameters/rho": rho,
        "simulation_parameters/g": g,
        "simulation_parameters/scaled": 0.0,
        "simulation_parameters/water_depth": b"infinite",
        "simulation_parameters/w": base.omega[backwards],
        "simulation_parameters/wave_dir": np.degrees(base.heading),
        "body1/properties/cg": np.array([along, 0.0, HEIGHT]),
        "body1/properties/disp_vol": base.mass_matrix[0, 0] / rho,
        f"{BODY}/added_mass/all": low.added_mass[backwards].transpose(1, 2, 0) / rho,
        f"{BODY}/added_mass/inf_freq": low.infinite_frequency_added_mass / rho,
        f"{BODY}/radiation_damping/all": damping[backwards].transpose(1, 2, 0),
        f"{BODY}/linear_restoring_stiffness": low.restoring / (rho * g),
        f"{BODY}/excitation/re": parts.real,
        f"{BODY}/excitation/im": parts.imag,
    }


def written(values: dict[str, Any], path: Path) -> Path:
    with h5py.File(path, "w") as file:
        for name, value in values.items():
            file[name] = value
    return path


@pytest.mark.parametrize("along", [0.0, 12.5])
def test_what_was_written_for_bemio_comes_back(along: float, tmp_path: Path) -> None:
    """Scales, order, phases of an origin elsewhere, from the centre of gravity to the waterline."""
    base = shipped_part()
    path = written(bemio_values(base, along), tmp_path / "ship.h5")
    found = load_database(path)
    for name in ("omega", "heading", "added_mass", "damping", "infinite_frequency_added_mass", "restoring"):
        mine, theirs = getattr(found, name), getattr(base, name)
        assert np.abs(mine - theirs).max() <= 1e-12 * np.abs(theirs).max(), name
    assert np.abs(found.force - base.force).max() <= 1e-11 * np.abs(base.force).max()
    assert (found.rho, found.g, found.depth) == (base.rho, base.g, np.inf)
    assert found.port_starboard_symmetric
    assert found.mass_matrix is None
    values = bemio_values(base, along) | {"simulation_parameters/water_depth": 40.0}
    mass = base.at((0.0, 0.0, HEIGHT)).mass_matrix
    found = read_bemio(written(values, path), mass_matrix=mass)
    assert np.abs(found.mass_matrix - base.mass_matrix).max() <= 1e-9 * np.abs(base.mass_matrix).max()
    assert found.depth == 40.0
