"""Capytaine reader: the shipped hull written in Capytaine's layout, a fresh Capytaine run, damaged files."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

from seacrane import Scene
from seacrane.errors import FileFormatError, SceneError
from seacrane.hydro import HydroDatabase, load_database, read_capytaine, shipped_database
from seacrane.sea import SeaState, WaveSystem, jonswap
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import MissingMotionsWarning

ORDER = [4, 1, 5, 0, 3, 2]  # Capytaine's users may name their degrees of freedom in any order
NAMES = np.array(["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"])
OMEGA = slice(5, 40, 5)
HEADING = slice(None, None, 3)


def in_file(matrices: np.ndarray) -> np.ndarray:
    return matrices[..., ORDER, :][..., ORDER]


def layout(centre: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> xarray.Dataset:
    """Part of the shipped hull as Capytaine writes it; ``centre``: the reference point in the mesh."""
    base = shipped_database()
    omega, direction, zero = base.omega[OMEGA], base.heading[HEADING], np.zeros((1, 6, 6))
    limits = base.infinite_frequency_added_mass[None], base.zero_frequency_added_mass[None]
    added_mass = np.concatenate([limits[0], base.added_mass[OMEGA][::-1], limits[1]])
    damping = np.concatenate([zero, base.damping[OMEGA][::-1], zero])
    along = centre[0] * np.cos(direction) + centre[1] * np.sin(direction)
    at_mesh_origin = np.exp(-1j * np.outer(along, omega**2 / base.g))[:, :, None]
    force = np.conj(base.force[HEADING, OMEGA] * at_mesh_origin)[:, ::-1, ORDER].swapaxes(0, 1)
    undefined = np.full((1, len(direction), 6), np.nan + 1j * np.nan)
    excitation = np.concatenate([undefined, force, undefined])
    part = 0.3 * excitation + 1e3
    matrix = ("influenced_dof", "radiating_dof")
    waves = ("complex", "omega", "wave_direction", "influenced_dof")
    parts = {"Froude_Krylov_force": part, "diffraction_force": excitation - part}
    parts["excitation_force"] = excitation
    return xarray.Dataset(
        {
            "added_mass": (("omega", *matrix), in_file(added_mass)),
            "radiation_damping": (("omega", *matrix), in_file(damping)),
            "inertia_matrix": (matrix, in_file(base.mass_matrix)),
            "hydrostatic_stiffness": (matrix, in_file(base.restoring)),
            **{name: (waves, np.stack([one.real, one.imag])) for name, one in parts.items()},
        },
        {
            "omega": np.concatenate([[np.inf], omega[::-1], [0.0]]), "wave_direction": direction,
            "influenced_dof": NAMES[ORDER], "radiating_dof": NAMES[ORDER], "complex": ["re", "im"],
            "rho": base.rho, "g": base.g, "water_depth": np.inf, "forward_speed": 0.0, "body": "hull",
            "rotation_center": ("space_coordinate", np.array(centre)),
        },
        {"capytaine_version": "3.0.0"},
    )  # fmt: skip


def read(dataset: xarray.Dataset, folder: Path, **given: Any) -> HydroDatabase:
    dataset.to_netcdf(folder / "hull.nc", engine="netcdf4")
    return read_capytaine(folder / "hull.nc", **given)


@pytest.mark.parametrize("centre", [(0.0, 0.0, 0.0), (55.3, -2.0, 0.0)])
def test_the_shipped_hull_comes_back(centre: tuple[float, float, float], tmp_path: Path) -> None:
    base, found = shipped_database(), read(layout(centre), tmp_path)
    assert np.array_equal(found.omega, base.omega[OMEGA])
    assert np.array_equal(found.heading, base.heading[HEADING])
    for name in ("added_mass", "damping"):
        assert np.array_equal(getattr(found, name), getattr(base, name)[OMEGA])
    for name in ("infinite_frequency_added_mass", "zero_frequency_added_mass", "restoring", "mass_matrix"):
        assert np.array_equal(getattr(found, name), getattr(base, name))
    scale = np.abs(base.force).max(axis=(0, 1))
    assert np.all(np.abs(found.force - base.force[HEADING, OMEGA]) <= 1e-12 * scale)
    assert (found.rho, found.g, found.depth, found.speed) == (base.rho, base.g, np.inf, 0.0)
    assert found.port_starboard_symmetric == (centre[1] == 0.0)
    if found.port_starboard_symmetric:  # told apart from our own files
        found.save(tmp_path / "ours.nc")
        assert np.array_equal(load_database(tmp_path / "ours.nc").force, found.force)
    assert 0.8 * base.length < found.length < base.length
    assert found.length * found.breadth * found.draught == pytest.approx(base.mass_matrix[0, 0] / base.rho)


def test_layouts_of_other_runs(tmp_path: Path) -> None:
    """Excitation alone, parameters of one value, dofs with a body, directions between -pi and 2 pi."""
    base, dataset = shipped_database(), layout()
    found = read(dataset.drop_vars(["Froude_Krylov_force", "diffraction_force"]), tmp_path)
    assert found.force == pytest.approx(base.force[HEADING, OMEGA], rel=1e-12)
    study = dataset.drop_vars(["water_depth", "rho"]).expand_dims({"water_depth": [np.inf], "rho": [1025.0]})
    names = [f"hull__{name}" for name in study["radiating_dof"].values]
    found = read(study.assign_coords(radiating_dof=names, influenced_dof=names), tmp_path)
    assert np.array_equal(found.added_mass, base.added_mass[OMEGA])
    more = [
        dataset.isel(wave_direction=[at]).assign_coords(wave_direction=[angle])
        for at, angle in ((3, -0.5), (0, 2.0 * np.pi))
    ]
    how: dict[str, Any] = {"data_vars": "minimal", "coords": "minimal", "compat": "override", "join": "outer"}
    found = read(xarray.concat([dataset, *more], dim="wave_direction", **how), tmp_path)
    assert len(found.heading) == dataset.sizes["wave_direction"] + 1
    assert found.heading[-1] == pytest.approx(2.0 * np.pi - 0.5)
    assert np.array_equal(found.force[-1], found.force[3])


def test_one_of_several_depths_is_chosen(tmp_path: Path) -> None:
    base, deep = shipped_database(), layout()
    shallow = deep.assign_coords(water_depth=20.0)
    shallow["added_mass"] = 1.5 * deep["added_mass"]
    how: dict[str, Any] = {"data_vars": "all", "coords": "minimal", "compat": "override", "join": "exact"}
    both = xarray.concat([shallow, deep], dim="water_depth", **how)
    for name in ("inertia_matrix", "hydrostatic_stiffness"):
        both[name] = deep[name]
    for given, words in (({}, "choose one"), ({"depth": 30.0}, "not 30 m")):
        with pytest.raises(FileFormatError, match=f"depths 20, inf m.*{words}"):
            read(both, tmp_path, **given)
    for depth, factor in ((20.0, 1.5), (np.inf, 1.0)):
        found = read(both, tmp_path, depth=depth)
        assert found.added_mass == pytest.approx(factor * base.added_mass[OMEGA], rel=1e-12)
        assert found.depth == load_database(tmp_path / "hull.nc", depth=depth, speed=0.0).depth == depth
    base.save(tmp_path / "deep.nc")
    with pytest.raises(FileFormatError, match="depth of inf m, not of 20 m"):
        load_database(tmp_path / "deep.nc", depth=20.0)
    with pytest.raises(FileFormatError, match="not of speed 3 m/s"):
        load_database(tmp_path / "hull.nc", depth=20.0, speed=3.0)
    scene = Scene()
    scene.add_vessel(replace(base, depth=20.0), memory="convolution")
    deep_sea = SeaState(systems=[WaveSystem(spectrum=jonswap(hs=1.0, tp=9.0), direction_deg=0.0)])
    with pytest.raises(SceneError, match=r"inf m deep, .* 20 m, .*SeaState\(depth=20\)"):
        scene.add_sea(sea=deep_sea)
    scene.add_sea(hs=1.0, tp=9.0)
    assert scene.waves.depth == 20.0


@pytest.mark.parametrize("measure", ["freq", "period", "wavenumber", "wavelength"])
def test_any_measure_of_frequency(measure: str, tmp_path: Path) -> None:
    """Solved for periods or wavelengths, with the limits 0 and infinity, in shallow water."""
    dataset = layout()
    dataset["water_depth"] = 60.0
    by_omega = read(dataset, tmp_path)
    omega = dataset["omega"].values
    between = (omega > 0.0) & np.isfinite(omega)
    k = omega.copy()  # 0 and infinity stay
    k[between] = wavenumber(omega[between], g=shipped_database().g, depth=60.0)
    with np.errstate(divide="ignore"):
        values = {"freq": omega / (2.0 * np.pi), "period": 2.0 * np.pi / omega, "wavenumber": k,
                  "wavelength": 2.0 * np.pi / k}[measure]  # fmt: skip
    other = dataset.rename(omega=measure).assign_coords({measure: values})
    found = read(other.assign_coords(omega=(measure, omega)), tmp_path)
    assert found.omega == pytest.approx(by_omega.omega, rel=1e-12)
    assert np.array_equal(found.added_mass, by_omega.added_mass)
    assert found.infinite_frequency_added_mass == pytest.approx(by_omega.infinite_frequency_added_mass)
    assert found.force == pytest.approx(by_omega.force, rel=1e-9)


def test_motions_and_matrices_that_are_missing(tmp_path: Path) -> None:
    base, dataset = shipped_database(), layout()
    given = {"mass_matrix": base.mass_matrix, "restoring": base.restoring}
    names = dataset["radiating_dof"].values
    three = [i for i, name in enumerate(names) if name in ("Surge", "Heave", "Pitch")]
    with pytest.warns(MissingMotionsWarning, match="no sway, roll, yaw"):
        found = read(dataset.isel(radiating_dof=three, influenced_dof=three), tmp_path, **given)
    kept = np.ix_([0, 2, 4], [0, 2, 4])
    for name in ("added_mass", "damping"):
        matrices = getattr(found, name)
        assert np.array_equal(matrices[:, *kept], getattr(base, name)[OMEGA][:, *kept])
        assert not matrices[:, [1, 3, 5]].any() and not matrices[:, :, [1, 3, 5]].any()
    assert not found.force[..., [1, 3, 5]].any()
    bare = dataset.drop_vars(["inertia_matrix", "hydrostatic_stiffness"])
    with pytest.raises(FileFormatError, match=r"hydrostatic_stiffness is missing; .* pass restoring"):
        read(bare, tmp_path, mass_matrix=base.mass_matrix)
    assert np.array_equal(read(bare, tmp_path, **given).restoring, base.restoring)


DAMAGE: list[tuple[Any, str]] = [
    (lambda d: d.assign_coords(forward_speed=2.5), "forward_speed is 2.5"),
    (lambda d: d.assign_coords(wave_direction=d.wave_direction * 57.3), "180.* radians"),
    (lambda d: d.isel(radiating_dof=[0, 1, 3, 4, 5, 5]), "radiating_dof .* each once"),
    (lambda d: d.assign_coords(radiating_dof=[f"{i % 2}__{n}" for i, n in enumerate(NAMES)]), "each once"),
    (lambda d: d.isel(omega=[1, 1, 2]), "repeated"), (lambda d: d.expand_dims(trim=[0.0, 1.0]), "on trim"),
    (lambda d: d.assign(diffraction_force=d.diffraction_force * np.nan), "force.* is .*nan"),
    (lambda d: d.drop_vars("rho").expand_dims(rho=[1000.0, 1025.0]), "rho has 2 values"),
]  # fmt: skip


def test_damage_is_named(tmp_path: Path) -> None:
    for damage, message in DAMAGE:
        with pytest.raises(FileFormatError, match=rf"hull\.nc: .*({message})"):
            read(damage(layout()), tmp_path)


def solved_barge(x: float, y: float, turn: Any = None) -> xarray.Dataset:
    """A barge centred at ``x``, ``y`` of the mesh, turning about it or ``turn``, solved by Capytaine.

    In deep water: in finite depth it fits at random points, up to 0.4 % from run to run.
    """
    capytaine = pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    centre = (x, y, 0.0)
    mesh = capytaine.mesh_parallelepiped(size=(24.0, 8.0, 4.0), center=centre, resolution=(12, 4, 4))
    dofs = capytaine.rigid_body_dofs(rotation_center=turn or centre)
    body = capytaine.FloatingBody(
        mesh=mesh.immersed_part(), dofs=dofs, center_of_mass=(x, y, 0.5), name="barge"
    )
    body.inertia_matrix = body.compute_rigid_body_inertia()
    body.hydrostatic_stiffness = body.compute_hydrostatic_stiffness()
    wanted = {"omega": [0.6, 0.9, 1.2, 1.5], "wave_direction": np.radians(np.arange(0.0, 181.0, 15.0))}
    study = xarray.Dataset(coords=wanted | {"radiating_dof": list(body.dofs)})
    solved: xarray.Dataset = capytaine.BEMSolver().fill_dataset(study, [body], progress_bar=False)
    return solved


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_what_turns_about_another_centre_is_what_at_makes(tmp_path: Path) -> None:
    """The same panels, twice solved. Not the inertia: Capytaine mixes two centres in it."""
    import capytaine

    found = []
    for centre in ((3.0, 0.0, 0.0), (-2.0, 1.5, -1.0)):
        capytaine.export_dataset(tmp_path / "barge.nc", solved_barge(3.0, 0.0, turn=centre))
        found.append(replace(load_database(tmp_path / "barge.nc"), port_starboard_symmetric=False))
    there, second = found[0].at((-5.0, 1.5, -1.0)), found[1]
    for name in ("added_mass", "damping", "restoring"):
        wanted = getattr(second, name)
        scale = np.sqrt(np.abs(np.diagonal(wanted, axis1=-2, axis2=-1)).reshape(-1, 6).max(axis=0))
        scale[scale == 0.0] = scale.max()
        error = np.abs(getattr(there, name) - wanted) / np.outer(scale, scale)
        assert error.max() < 1e-10, name
    assert np.abs(there.force - second.force).max() < 1e-12 * np.abs(second.force).max()
