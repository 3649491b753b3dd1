"""The trusted band of files that do not tell their panels: sound and damaged data, real files."""

from __future__ import annotations

import dataclasses
import logging
import warnings
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

from seacrane.hydro import HydroDatabase, load_database, read_capytaine, read_wamit, shipped_database
from seacrane.hydro.data.data_warnings import warn_of_data
from seacrane.hydro.readers.band_of_data import first_rough_value
from seacrane.warnings import DampingWarning, RoughDataWarning


def rough_from(database: HydroDatabase) -> float | None:
    """Frequency of the first jump, rad/s."""
    found = first_rough_value(database)
    return None if found is None else float(database.omega[found[0]])


def scales(database: HydroDatabase) -> tuple[np.ndarray, np.ndarray]:
    """What A and B of each pair vary by, (6, 6)."""
    a = np.ptp(np.diagonal(database.added_mass, axis1=1, axis2=2), axis=0)
    b = np.diagonal(database.damping, axis1=1, axis2=2).max(axis=0)
    return np.sqrt(np.outer(a, a)), np.sqrt(np.outer(b, b))


def test_noise_is_found_where_it_begins_and_nothing_in_sound_data(shared: Path) -> None:
    """The shipped hull has a lid; thinned to steps of 0.3 rad/s its curves are coarse, and still no noise."""
    base = shipped_database()
    for sound in (*(base.select(every=n) for n in (1, 2, 4, 6)), load_database(shared / "veres" / "supply")):
        assert rough_from(sound) is None
    noise = np.random.default_rng(3).normal(size=(2, len(base.omega), 6, 6))
    noise = (noise + noise.swapaxes(2, 3)) / np.sqrt(2.0)
    for above in (1.3, 1.6, 2.0, 2.4):
        for level in (0.01, 0.03):
            part = level * noise * (base.omega >= above - 1e-9)[:, None, None]
            of_a, of_b = (one * scale for one, scale in zip(part, scales(base), strict=True))
            noisy = {"added_mass": base.added_mass + of_a, "damping": base.damping + of_b}
            found = rough_from(dataclasses.replace(base, **noisy, memory=None))
            assert found is not None and abs(found - above) < 2.5 * 0.05


def test_a_spike_of_an_irregular_frequency_is_found_and_named() -> None:
    base = shipped_database()
    at = int(np.searchsorted(base.omega, 1.8))
    for j, k, name in ((2, 2, "A33"), (4, 4, "B55"), (1, 3, "B24")):
        matrix = "damping" if name.startswith("B") else "added_mass"
        table = getattr(base, matrix).copy()
        for pair in {(j, k), (k, j)}:
            table[at, *pair] += 0.03 * scales(base)[name.startswith("B")][pair]
        found = first_rough_value(dataclasses.replace(base, memory=None, **{matrix: table}))
        assert found is not None and at - 2 <= found[0] <= at and found[1] == name
    damping = base.damping.copy()  # a peak of one step in long waves, as of a moonpool, is kept
    damping[int(np.searchsorted(base.omega, 0.8)), 2, 2] *= 1.5
    assert rough_from(dataclasses.replace(base, damping=damping, memory=None)) is None
    added_mass = base.added_mass.copy()  # what symmetry forbids does not count
    added_mass[::2, 0, 1] += 0.1 * scales(base)[0][0, 1]
    noisy = dataclasses.replace(base, added_mass=added_mass, memory=None)
    assert rough_from(noisy) is None
    assert rough_from(dataclasses.replace(noisy, port_starboard_symmetric=False)) is not None


def test_the_tanker_without_its_panels_comes_near_their_band(shared: Path, tmp_path: Path) -> None:
    """Eight panels a wave are 2.47 rad/s; its added mass in heave jumps from there on."""
    counted = load_database(shared / "wamit").trusted_band
    for file in (shared / "wamit").glob("tanker.*"):
        lines = file.read_bytes().split(b"\n")
        (tmp_path / file.name).write_bytes(b"\n".join(line for line in lines if b"Total panels" not in line))
    with pytest.warns(RoughDataWarning, match=r"A33 jumps at 2\.7.* ends at 2\.503 .*load_database") as told:
        found = load_database(tmp_path)
    assert told[0].filename == __file__
    assert found.trusted_band == pytest.approx(counted, rel=0.02)
    assert found.port_starboard_symmetric  # which the same line of the listing tells
    with warnings.catch_warnings():
        warnings.simplefilter("error", RoughDataWarning)
        assert load_database(tmp_path, trusted_band=(0.2, 1.9)).trusted_band == (0.2, 1.9)
    for band, message in (
        ((7.0, 8.0), r"7 to 8 rad/s .* within 0\.0383"),
        ((1.9, 0.2), r"1\.9 to 0\.2 rad/s"),
    ):
        with pytest.raises(ValueError, match=message):
            load_database(tmp_path, trusted_band=band)


@cache
def bare_barge() -> Any:
    """Capytaine's dataset of a box barge 60 x 20 x 4 m without a lid."""
    capytaine = pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    mesh = capytaine.mesh_parallelepiped(size=(60.0, 20.0, 8.0), resolution=(16, 6, 4)).immersed_part()
    dofs = capytaine.rigid_body_dofs(rotation_center=(0.0, 0.0, 0.0))
    body = capytaine.FloatingBody(mesh=mesh, dofs=dofs, name="barge", center_of_mass=(0.0, 0.0, 2.0))
    body.inertia_matrix = body.compute_rigid_body_inertia()
    body.hydrostatic_stiffness = body.compute_hydrostatic_stiffness()
    coords = {
        "omega": np.arange(0.8, 2.21, 0.05),
        "wave_direction": np.radians([0.0, 45.0, 90.0, 135.0, 180.0]),
    }
    coords |= {"radiating_dof": list(body.dofs), "water_depth": [np.inf]}
    return capytaine.BEMSolver().fill_dataset(xarray.Dataset(coords=coords), body, progress_bar=False)


@pytest.mark.warns(sometimes=["AsymmetryWarning"])
def test_the_first_irregular_frequency_of_a_barge_ends_its_band(tmp_path: Path) -> None:
    """Panels without a lid fail at the eigenfrequencies of the water inside the box, known in closed form.

    omega^2 = g k coth(k T), k = pi sqrt(1 / L^2 + 1 / B^2) [Faltinsen 1990, Sea Loads, section 4].
    """
    capytaine = pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    capytaine.export_dataset(str(tmp_path / "barge.nc"), bare_barge())
    with pytest.warns(RoughDataWarning):
        found = read_capytaine(tmp_path / "barge.nc")
    k = np.pi * np.hypot(1.0 / 60.0, 1.0 / 20.0)
    irregular = np.sqrt(9.81 * k / np.tanh(k * 4.0))
    assert irregular - 4 * 0.05 < found.trusted_band[1] < irregular
    with pytest.warns(DampingWarning):
        warn_of_data(dataclasses.replace(found, trusted_band=None))
    with warnings.catch_warnings():
        warnings.simplefilter("error", DampingWarning)
        warn_of_data(found)


@pytest.fixture(scope="module")
def fpso(tmp_path_factory: pytest.TempPathFactory) -> HydroDatabase:
    """The bare barge's WAMIT files as Capytaine exports them, without ``.out``, its own motions in ``.4``.

    Matrices are made symmetric first, as that export exchanges rows and columns.
    """
    capytaine = pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    exported = pytest.importorskip("capytaine.io.wamit", reason="capytaine 3 is needed: pip install .[hydro]")
    dataset, folder = bare_barge().copy(), tmp_path_factory.mktemp("fpso")
    for name in ("added_mass", "radiation_damping"):
        table = dataset[name]
        other = table.rename({"radiating_dof": "influenced_dof", "influenced_dof": "radiating_dof"})
        dataset[name] = 0.5 * (table + other.transpose(*table.dims))
    exported.export_to_wamit(dataset, str(folder / "fpso"), exports=("1", "3", "hst"))
    rao = np.conj(capytaine.post_pro.rao(dataset).transpose("omega", "wave_direction", "radiating_dof"))
    motions = rao.sel(radiating_dof=["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]).values
    period, heading = 2.0 * np.pi / dataset.omega.values, np.degrees(dataset.wave_direction.values)
    with (folder / "fpso.4").open("w") as file:
        for (n, m, i), x in np.ndenumerate(motions):
            polar = f"{abs(x):.6e} {np.degrees(np.angle(x)):.6e}"
            file.write(f"{period[n]:.6e} {heading[m]:.6e} {i + 1} {polar} {x.real:.6e} {x.imag:.6e}\n")
    with pytest.warns(RoughDataWarning):
        return read_wamit(
            folder / "fpso", volume=60.0 * 20.0 * 4.0, g=9.81, rho=1000.0,
            mass_matrix=dataset.inertia_matrix.values,
        )  # fmt: skip


def closure(database: HydroDatabase) -> dict[str, str]:
    """Verdicts of the motions; too few frequencies are left for a memory."""
    rows = database.select(every=3).check()
    return {row.check.removeprefix("motion_rao_"): row.verdict for row in rows if "motion_rao" in row.check}


def test_the_like_of_an_fpso_passes_its_self_check(fpso: HydroDatabase) -> None:
    """No count of panels, irregular frequencies, motions by another code: sound where it is trusted."""
    assert closure(fpso) == dict.fromkeys(("surge", "sway", "heave", "roll", "pitch", "yaw"), "pass")
    for motion, name in ((4, "pitch"), (5, "yaw")):
        scale = np.ones(6)
        scale[motion] = 1.03
        assert closure(dataclasses.replace(fpso, force=fpso.force * scale))[name] == "fail"
    # Yaw of a barge in head, beam and following seas is nothing; its noise is no fault of the file.
    found = fpso.select(heading=[0, 2, 4])
    motions = found.motion_rao.copy()
    assert np.abs(motions[..., 5]).max() < 1e-4 * np.abs(motions[..., 4]).max()
    motions[..., 5] *= 2.0
    assert closure(dataclasses.replace(found, motion_rao=motions))["yaw"] == "pass"
