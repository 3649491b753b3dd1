"""Data are what their files say, or refused: kinds of files by reader."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
import test_hydro_nemoh
from orcaflex_writer import hull_part, model
from orcaflex_writer import write as write_model
from test_hydro_capytaine import OMEGA, in_file, layout
from test_hydro_nemoh import bemio_values, written
from veres_writer import VeresRun

from seacrane import Lift, Scene
from seacrane.cli import main
from seacrane.errors import FileFormatError, SceneError
from seacrane.hydro import (
    HydroDatabase,
    fit_memory,
    load_database,
    motion_response,
    read_bemio,
    read_capytaine,
    read_nemoh,
    read_orcaflex,
    read_veres,
    read_wamit,
    shipped_database,
    vessel_parameters,
    write_database,
)
from seacrane.hydro.database.figures import hydro_sheets
from seacrane.hydro.readers.text_records import number_of_word
from seacrane.scene.file import scene_digest
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import AssumedReferenceWarning, FloatingPositionWarning, WaterMismatchWarning

pytestmark = pytest.mark.filterwarnings(
    "ignore::seacrane.warnings.RoughDataWarning",
    "ignore::seacrane.warnings.PartialSetWarning",
)

UPPER = np.triu(np.ones((6, 6)))
BASE = shipped_database().select(every=6, every_heading=6)
PLACE = np.array([-50.0, 0.0, 0.0])  # of NEMOH's rotations from the centre of gravity


def wamit(base: HydroDatabase, folder: Path) -> Path:
    rho, g = base.rho, base.g
    one, three = [], []
    for n, w in enumerate(base.omega):
        period = 2.0 * np.pi / w
        for i, j in np.ndindex(6, 6):
            a, b = base.added_mass[n, i, j] / rho, base.damping[n, i, j] / rho / w
            one.append(f"{period:.9E} {i + 1} {j + 1} {a:.9E} {b:.9E}")
        for h, beta in enumerate(np.degrees(base.heading)):
            for i, f in enumerate(base.force[h, n] / rho / g):
                said = f"{abs(f):.9E} {np.degrees(np.angle(f)):.9E} {f.real:.9E} {f.imag:.9E}"
                three.append(f"{period:.9E} {beta:.9E} {i + 1} {said}")
    hst = [f"{i + 1} {j + 1} {base.restoring[i, j] / rho / g:.9E}" for i, j in np.ndindex(6, 6)]
    for suffix, lines in ((".1", one), (".3", three), (".hst", hst)):
        (folder / f"ship{suffix}").write_text("\n".join(lines) + "\n")
    return folder


def read_wamit_set(path: Path, **given: Any) -> HydroDatabase:
    volume = BASE.mass_matrix[0, 0] / BASE.rho
    return read_wamit(
        path, **{"volume": volume, "g": BASE.g, "rho": BASE.rho, "mass_matrix": BASE.mass_matrix} | given
    )


def nemoh(base: HydroDatabase, folder: Path) -> Path:
    test_hydro_nemoh.write_project(base, folder / "ship")
    return folder / "ship"


def capytaine(base: HydroDatabase, folder: Path, **changes: Any) -> Path:
    """Of the shipped hull with the matrices of ``base``, which has its frequencies, over them."""
    data = layout()
    rows = np.isfinite(data.omega.values) & (data.omega.values > 0.0)
    for name, table in (("added_mass", base.added_mass), ("radiation_damping", base.damping)):
        values = data[name].values.copy()
        values[rows] = in_file(table[::-1])
        data[name] = (data[name].dims, values)
    data["hydrostatic_stiffness"] = (data["hydrostatic_stiffness"].dims, in_file(base.restoring))
    data.assign(changes).to_netcdf(folder / "ship.nc", engine="netcdf4")
    return folder / "ship.nc"


def of_capytaine() -> HydroDatabase:
    base = shipped_database()
    return base.select(omega=list(range(*OMEGA.indices(base.omega.size))), every_heading=3)


READERS: dict[str, tuple[Callable[[], HydroDatabase], Callable[..., Path], Callable[..., HydroDatabase]]] = {
    "wamit": (lambda: BASE, wamit, read_wamit_set),
    "nemoh": (lambda: BASE, nemoh, read_nemoh),
    "capytaine": (of_capytaine, capytaine, read_capytaine),
    "orcaflex": (hull_part, lambda base, folder: write_model(folder, model(base)), read_orcaflex),
    "bemio": (lambda: BASE, lambda base, to: written(bemio_values(base), to / "ship.h5"), read_bemio),
}


@pytest.mark.parametrize("reader", READERS)
def test_half_a_matrix_is_completed(reader: str, tmp_path: Path) -> None:
    source, write, read = READERS[reader]
    base = source()
    if reader == "bemio":  # whose halves are about the centre of gravity
        values = bemio_values(base)
        for name in ("added_mass/all", "radiation_damping/all"):
            values[f"body1/hydro_coeffs/{name}"][np.tril_indices(6, -1)] = 0.0
        found = read(written(values, tmp_path / "ship.h5"))
        for mine in (found.added_mass, found.damping):
            assert np.abs(mine - mine.swapaxes(1, 2)).max() <= 1e-9 * np.abs(mine).max()
        return
    half = replace(base, added_mass=base.added_mass * UPPER, damping=base.damping * UPPER)
    found = read(write(half, tmp_path))
    for name in ("added_mass", "damping"):
        theirs = getattr(base, name)
        whole = theirs * UPPER + (theirs * np.triu(np.ones((6, 6)), 1)).swapaxes(1, 2)
        assert np.abs(getattr(found, name) - whole).max() <= 1e-6 * np.abs(theirs).max()


@pytest.mark.parametrize("reader", READERS)
def test_motions_that_were_not_solved_are_refused(reader: str, tmp_path: Path) -> None:
    source, write, read = READERS[reader]
    base = source()
    there = np.outer(*[np.array([1.0, 0.0, 1.0, 0.0, 1.0, 0.0])] * 2)
    names = ("added_mass", "damping", "infinite_frequency_added_mass")
    path = write(
        replace(base, **{name: getattr(base, name) * there for name in names}, memory=None), tmp_path
    )
    with pytest.raises(FileFormatError, match=r"sway, roll, yaw .*motions=\("):
        read(path)
    if reader != "capytaine":  # its files name the motions that they hold
        found = read(path, motions=("surge", "heave", "pitch"))
        assert not found.added_mass[:, 1].any() and found.added_mass[:, 2].any()
    if reader == "wamit":
        waves = wamit(base, tmp_path) / "ship.3"
        lines = waves.read_text().splitlines(True)
        waves.write_text("".join(line for line in lines if line.split()[2] != "6"))
        with pytest.raises(FileFormatError, match="yaw has no wave force"):
            read(tmp_path)
        found = read(tmp_path, motions=("surge", "sway", "heave", "roll", "pitch"))
        assert not found.force[..., 5].any()


@pytest.mark.parametrize("reader", READERS)
def test_a_hull_that_turns_over_is_read_and_told(reader: str, tmp_path: Path) -> None:
    source, write, read = READERS[reader]
    base = source()
    restoring = base.restoring.copy()
    restoring[3, 3] = restoring[4, 4] = -0.05 * base.mass_matrix[0, 0] * base.g
    with pytest.warns(FloatingPositionWarning, match="C44 is .* turns over by itself"):
        found = read(write(replace(base, restoring=restoring), tmp_path))
    assert found.restoring[3, 3] == pytest.approx(restoring[3, 3], rel=1e-6)


def test_nemoh_stiffness_is_of_the_centre_of_gravity_and_its_tables_over_hz_and_s(tmp_path: Path) -> None:
    """Rotations about the stern; KH about the centre of gravity, or about the stern as of Capytaine."""
    stern = BASE.at(PLACE)
    for about, stiffness in (("gravity", BASE.restoring), ("stern", stern.restoring)):
        folder = nemoh(replace(stern, restoring=stiffness), tmp_path / about)
        words = (folder / "mesh/Hydrostatics.dat").read_text().splitlines()
        words[0] = f"XF = 0.0 - XG = {test_hydro_nemoh.CENTRE[0] - PLACE[0]:.4f}"
        (folder / "mesh/Hydrostatics.dat").write_text("\n".join(words) + "\n")
        found = read_nemoh(folder)
        assert found.restoring[4, 4] == pytest.approx(stern.restoring[4, 4], rel=1e-6), about
    for unit, factor, power in (("f (Hz)", 0.5 / np.pi, 1.0), ("T (s)", 2.0 * np.pi, -1.0)):
        folder = nemoh(BASE, tmp_path / unit[0])
        for file in (folder / "results").iterdir():
            lines = file.read_text().replace('"w (rad/s)"', f'"{unit}"').splitlines()
            for i, line in enumerate(lines):
                if line[:1].isdigit():
                    omega, rest = line.split(maxsplit=1)
                    lines[i] = f"{factor * float(omega) ** power:.12E} {rest}"
            file.write_text("\n".join(lines) + "\n")
        found = read_nemoh(folder)
        assert found.omega == pytest.approx(BASE.omega, rel=1e-9)
        assert found.added_mass == pytest.approx(BASE.added_mass, rel=1e-9, abs=1.0)


def test_a_frequency_that_failed_is_named_and_left_out_on_request(tmp_path: Path) -> None:
    values = bemio_values(BASE)
    values["body1/hydro_coeffs/added_mass/all"][2, 2, 3] = np.nan
    data = layout((55.3, 0.0, 0.0))
    data["radiation_damping"][3, 0, 0] = np.nan
    data.to_netcdf(tmp_path / "ship.nc", engine="netcdf4")
    for read, path, omega in (
        (read_bemio, written(values, tmp_path / "ship.h5"), values["simulation_parameters/w"][3]),
        (read_capytaine, tmp_path / "ship.nc", float(data.omega[3])),
    ):
        with pytest.raises(FileFormatError, match=rf"values at {omega:.5g} rad/s .*leave_out"):
            read(path)
        assert omega not in read(path, leave_out=[omega]).omega
    given = {"leave_out": [float(data.omega[3])]}  # and a file that does not tell its rotation centre
    data.drop_vars("rotation_center").to_netcdf(tmp_path / "old.nc", engine="netcdf4")
    with pytest.warns(AssumedReferenceWarning, match="rotation_centre="):
        assumed = read_capytaine(tmp_path / "old.nc", **given)
    told = read_capytaine(tmp_path / "old.nc", rotation_centre=(55.3, 0.0, 0.0), **given)
    k = wavenumber(told.omega, g=told.g, depth=told.depth)
    assert told.force[0] == pytest.approx(assumed.force[0] * np.exp(55.3j * k)[:, None], rel=1e-9)


@pytest.mark.parametrize("reader", ["wamit", "nemoh", "capytaine", "bemio", "veres"])
def test_what_is_left_out_of_files_is_told(reader: str, tmp_path: Path) -> None:
    source, write, read = READERS.get(reader, (None, None, read_veres))
    if reader == "veres":
        path = VeresRun().write(tmp_path)
    elif reader == "capytaine":
        path = write(source(), tmp_path, kochin=("wave_direction", np.zeros(layout().wave_direction.size)))
    else:
        path = write(source(), tmp_path)
    assert reader == "capytaine" or "left out" not in read(path).source
    more = {"wamit": "ship.5p", "nemoh": "IRF.tec", "capytaine": "kochin", "bemio": "mean_drift/momentum",
            "veres": "box.re5"}[reader]  # fmt: skip
    if reader == "bemio":
        with h5py.File(path, "a") as file:
            file[f"body1/hydro_coeffs/{more}/val"] = np.zeros(3)
            file["body1/hydro_coeffs/added_mass/components/1_1"] = np.zeros(3)  # again what is read
    elif reader != "capytaine":
        folder = path if path.is_dir() else path.parent
        (folder / ("results" if reader == "nemoh" else "") / more).touch()
    assert read(path).source.endswith(f"; left out: {more}")


def test_numbers_of_fortran(tmp_path: Path) -> None:
    for word, value in (("1.2-101", 1.2e-101), ("-1.2+03", -1200.0), ("1.5D-02", 0.015), (".5E1", 5.0)):
        assert number_of_word(word) == pytest.approx(value, rel=1e-12)
    for word in ("*****", "1_000", "nan", "1E999"):
        with pytest.raises(ValueError, match="number"):
            number_of_word(word)
    path = wamit(BASE, tmp_path) / "ship.3"
    plain = read_wamit_set(tmp_path).force
    path.write_text(path.read_text().replace("E-0", "-00").replace("E-1", "-01").replace("E+0", "D+0"))
    assert np.array_equal(read_wamit_set(tmp_path).force, plain)


FOLDERS = ("aqwa", "fdi", "orcaflex", "qtf_oc4", "rm3", "veres", "wamit", "wamit_fpso")
ANSWERS = {  # of a file that has one of these in its place: the start of its source, or why it is refused
    ".AH1": "Aqwa file", ".LIS": "Aqwa file", "testModel.yml": "OrcaFlex model", ".nc": "Capytaine 2",
    "rm3.out": "WAMIT 7", "supply/input.": "ShipX/VERES", "/tanker.": "WAMIT 6", "/fpso.": "WAMIT 6",
    "barge_": "a placeholder; give read_orcaflex", "refcase_": "not positive definite: no mass or no inertia",
    "Nemoh.cal": "check whether they are this body's own", ".tec": "check whether they are this body's own",
    ".12d": "are of second order", "s175/input.": "re7: no such file", "_U0.re7": "re8: no such file",
}  # fmt: skip


@pytest.mark.filterwarnings("ignore::seacrane.warnings.SeacraneWarning")
def test_every_shared_file_is_read_or_refused_by_name(shared: Path) -> None:
    """All that is hydrodynamic data there; a set is read once, by the first of its files."""
    files = sorted(file for one in FOLDERS for file in (shared / one).rglob("*") if file.is_file())
    if not files:
        pytest.skip(f"no {shared / FOLDERS[0]}")
    sets: set[Path] = set()
    for file in files:
        answer = next((said for part, said in ANSWERS.items() if part in str(file)), "not of a known kind")
        if file.with_suffix("") in sets and answer.startswith(("WAMIT", "ShipX")):
            continue
        sets.add(file.with_suffix(""))
        try:
            assert load_database(file).source.startswith(answer)
        except FileFormatError as error:
            assert answer in str(error) and str(shared / file.relative_to(shared).parts[0]) in str(error)


@pytest.mark.filterwarnings("ignore::seacrane.warnings.VesselWarning")
@pytest.mark.parametrize("reader", ["wamit", "nemoh", "bemio"])
def test_a_set_without_masses_asks_for_them_where_a_vessel_is_made(
    reader: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In Python, lift file and command alike; it is read, moved, checked and written without."""
    _, write, read = READERS[reader]
    (tmp_path / "files").mkdir()
    files = write(BASE, tmp_path / "files")
    found = read(files, **({"mass_matrix": None} if reader == "wamit" else {}))
    assert found.mass_matrix is None and found.at(PLACE).mirror().mass_matrix is None
    assert not {"mass_t", "natural_period_roll_s", "memory_states"} & {row.check for row in found.check()}
    assert "no mass" in repr(found) and "motion" not in hydro_sheets(found)
    for name in ("bare.nc", "bare.1"):
        rows = write_database(database=found, path=tmp_path / name, overwrite=True)
        assert {row.verdict for row in rows} <= {"pass", "info"}
    assert not (tmp_path / "bare.frc").exists()
    asks = rf"'{found.name}': mass_matrix is not known: .*{found.name}.* holds none; .*mass_matrix=.*--mass"
    for needs in (
        motion_response,
        vessel_parameters,
        lambda one: fit_memory(database=one),
        lambda one: one.with_roll_damping(fraction=0.05),
        lambda one: Scene(name="sea").add_vessel(one, memory="none"),
    ):
        with pytest.raises(SceneError, match=asks):
            needs(found)
    bare, mass = tmp_path / "bare.nc", BASE.mass_matrix
    lift = f'format = "seacrane lift"\nversion = 2\n[vessel]\nmemory = "none"\ndatabase = "{bare}"\n'
    (tmp_path / "bare.toml").write_text(lift)
    with pytest.raises(FileFormatError, match=r"bare.toml line 3: .*mass_matrix in \[vessel\]"):
        Lift.load(tmp_path / "bare.toml").scene()
    (tmp_path / "mass.toml").write_text(f"{lift}mass_matrix = {mass.tolist()}\n")
    scene = Scene()
    scene.add_vessel(load_database(bare, mass_matrix=mass), memory="none")
    assert scene_digest(Lift.load(tmp_path / "mass.toml").scene()) == scene_digest(scene)
    with pytest.warns(WaterMismatchWarning, match=r"its mass needs 0.001"):
        load_database(bare, mass_matrix=1e-3 * mass)
    slips = {"in t, or a placeholder": 1e-3 * mass, "not symmetric": np.tril(mass, -1) * 1.5 + np.triu(mass)}
    turning = mass.copy()
    turning[3:, 3:] *= 1e3
    for told, slip in {**slips, "inertia has a radius of": turning}.items():
        with pytest.raises(FileFormatError, match=told):
            read(files, mass_matrix=slip)
    assert main(["hydro", str(bare), "--mass", "100", "0", "0", "0", "-5", "9", "9"]) == 1
    assert "radii of gyration above zero" in capsys.readouterr().err
    assert main(["hydro", str(bare)]) == 0 and "mass_t" not in capsys.readouterr().out
    assert main(["hydro", str(bare), "--memory", "by-motion"]) == 1 and "--mass" in capsys.readouterr().err


@pytest.mark.parametrize("mass", [1e-3, "none"])
def test_placeholder_masses_are_asked_for(mass: Any, tmp_path: Path) -> None:
    hull = hull_part()
    told = model(hull)
    draught = told["VesselTypes"][0]["Draughts"][0]
    draught["DisplacedVolume"] = float(BASE.mass_matrix[0, 0] / BASE.rho)
    inertia = next(name for name in draught if name.startswith("MomentOfInertia"))
    draught[inertia] = (np.eye(3) * (1e-3 if mass == 1e-3 else 0.0)).tolist()
    draught["Mass"] = mass if mass == 1e-3 else draught["Mass"]
    path = write_model(tmp_path, told)
    with pytest.raises(FileFormatError, match=r"read_orcaflex\(mass_matrix="):
        read_orcaflex(path)
    assert np.array_equal(read_orcaflex(path, mass_matrix=hull.mass_matrix).mass_matrix, hull.mass_matrix)
    tiny = (("influenced_dof", "radiating_dof"), np.eye(6))
    with pytest.raises(FileFormatError, match=r"mass is 1 kg, .* placeholder"):
        read_capytaine(capytaine(of_capytaine(), tmp_path, inertia_matrix=tiny))
