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
from seacrane.hydro import HydroDatabase, load_database, read_bemio, read_nemoh, shipped_database
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


def write_project(base: HydroDatabase, folder: Path) -> None:
    """A project folder as NEMOH 2 leaves it, results to twelve digits."""
    (folder / "results").mkdir(parents=True)
    (folder / "mesh").mkdir()
    (folder / "Nemoh.cal").write_text(control(CENTRE))
    radiation = ['VARIABLES="w (rad/s)"', *(f'"A\t1\t{i}" "B\t1\t{i}"' for i in range(1, 7))]
    for j in range(6):
        radiation.append(f'Zone t="Motion of body   1 in DoF   {j + 1}",I= {len(base.omega)},F=POINT')
        for i, omega in enumerate(base.omega):
            pairs = np.stack([base.added_mass[i, :, j], base.damping[i, :, j]], axis=1).ravel()
            radiation.append(" ".join(f"{value:.12E}" for value in (omega, *pairs)))
    (folder / "results" / "RadiationCoefficients.tec").write_text("\n".join(radiation) + "\n")
    k = wavenumber(base.omega, g=base.g, depth=np.inf)
    waves = ['VARIABLES="w (rad/s)"', *(f'"abs(F\t1\t{i})" "angle(F\t1\t{i})"' for i in range(1, 7))]
    for heading, forces in zip(base.heading, base.force, strict=True):
        degrees = np.degrees(heading)
        waves.append(f'Zone t="Excitation force - beta = {degrees:.6f} deg",I= {len(k)},F=POINT')
        at_mesh = np.conj(forces * np.exp(-1j * CENTRE[0] * np.cos(heading) * k)[:, None])
        for omega, force in zip(base.omega, at_mesh, strict=True):
            pairs = np.stack([np.abs(force), np.angle(force)], axis=1).ravel()
            waves.append(" ".join(f"{value:.12E}" for value in (omega, *pairs)))
    (folder / "results" / "ExcitationForce.tec").write_text("\n".join(waves) + "\n")
    np.savetxt(folder / "mesh" / "KH.dat", base.restoring, fmt="%.12E")
    volume = base.mass_matrix[0, 0] / base.rho
    gravity = CENTRE + np.array([0.0, 0.0, 1.5])
    lines = [f"{axis}F = 0.0 - {axis}G = {at:7.4f}" for axis, at in zip("XYZ", gravity, strict=True)]
    (folder / "mesh" / "Hydrostatics.dat").write_text("\n".join([*lines, f"Displacement = {volume:.10E}\n"]))


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
