"""Two hulls by Capytaine: its own motions, waves between far hemispheres, a mirrored pair."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from scipy.special import hankel2, j0

from seacrane.hydro import HydroGroup, read_capytaine

capytaine = pytest.importorskip("capytaine")
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.RoughDataWarning")
RADIUS = 5.0  # m
LONG, OMEGA = 0.35, 0.8  # rad/s
DISTANCES = (100.0, 550.0, 3000.0)  # m


def hemisphere(name: str, x: float, y: float) -> Any:
    mesh = capytaine.mesh_sphere(radius=RADIUS, center=(x, y, 0.0), resolution=(6, 8)).immersed_part()
    dofs = capytaine.rigid_body_dofs(rotation_center=(x, y, 0.0))
    body = capytaine.FloatingBody(mesh=mesh, dofs=dofs, center_of_mass=(x, y, -1.0), name=name)
    body.inertia_matrix = body.compute_rigid_body_inertia(rho=1025.0)
    body.hydrostatic_stiffness = body.compute_hydrostatic_stiffness(rho=1025.0)
    return body


def solved(bodies: tuple[Any, Any], omega: list[float], heading: list[float]) -> xarray.Dataset:
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    both = bodies[0] + bodies[1]
    coords = {"omega": omega, "wave_direction": heading, "radiating_dof": list(both.dofs), "rho": [1025.0]}
    return capytaine.BEMSolver().fill_dataset(xarray.Dataset(coords=coords), both, progress_bar=False)


def as_group(dataset: xarray.Dataset, folder: Path) -> HydroGroup:
    path = folder / "pair.nc"
    capytaine.export_dataset(path, dataset)
    group = read_capytaine(path)
    assert isinstance(group, HydroGroup)
    return group


def near_pair() -> xarray.Dataset:
    bodies = hemisphere("near", 2.0, -3.0), hemisphere("far", 8.0, 9.0)
    return solved(bodies, [0.7, 1.1], [0.5, 2.0])


def both_motions(folder: Path) -> tuple[np.ndarray, np.ndarray]:
    dataset = near_pair()
    group = as_group(dataset, folder)
    own = capytaine.post_pro.rao(dataset)
    labels = [f"{name}__{motion}" for name in group.names for motion in ("Surge", "Sway", "Heave")]
    theirs = own.sel(radiating_dof=labels).transpose("wave_direction", "omega", "radiating_dof")
    return group.motion_rao[:, :, [0, 1, 2, 6, 7, 8]], np.conj(theirs.values)


def test_motions_are_capytaines_own(tmp_path: Path) -> None:
    """Phases, order and coupling are those of its own solution; without the coupling they are others."""
    mine, theirs = both_motions(tmp_path)
    assert np.abs(mine - theirs).max() < 1e-6 * np.abs(theirs).max()
    uncoupled = as_group(near_pair(), tmp_path).without_coupling().motion_rao
    assert np.abs(uncoupled[:, :, [2, 8]] - theirs[:, :, [2, 5]]).max() > 0.02


def apart(distance: float, folder: Path) -> HydroGroup:
    bodies = hemisphere("one", 0.0, 0.0), hemisphere("two", distance, 0.0)
    return as_group(solved(bodies, [LONG, OMEGA], [0.0]), folder)


def turned_twice(folder: Path) -> np.ndarray:
    """exp(2 i d) by frequency, of a hemisphere that nothing is near."""
    force = apart(1e4, folder)["one"].force[0, :, 2]
    return np.asarray((force / np.abs(force)) ** 2)


def coupling_of(group: HydroGroup) -> np.ndarray:
    """(B12 + i w A12) / B11 in heave by frequency."""
    coupled = group.damping[:, 2, 8] + 1j * group.omega * group.added_mass[:, 2, 8]
    return np.asarray(coupled / group.damping[:, 2, 2])


@pytest.fixture(scope="module")
def turned(tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    return turned_twice(tmp_path_factory.mktemp("far"))


@pytest.mark.parametrize("distance", DISTANCES)
def test_far_hemispheres_couple_as_point_sources(distance: float, turned: np.ndarray, tmp_path: Path) -> None:
    """Z12 / B11 = exp(2 i d) H0(k R), with the phase d of the heave force, as reciprocity and Haskind say.

    In waves long beside the body d vanishes: B12 / B11 = J0(k R). The coupling falls as R^-1/2, from 0.1 to
    3 km.
    """
    group = apart(distance, tmp_path)
    k = group.omega**2 / group.g
    coupled = coupling_of(group)
    assert coupled[1] == pytest.approx(turned[1] * hankel2(0, k[1] * distance), rel=0.03)
    assert coupled[0].real == pytest.approx(j0(k[0] * distance), abs=0.01)
    falling = np.abs(coupled[1]) * np.sqrt(0.5 * np.pi * k[1] * distance)
    assert falling == pytest.approx(1.0, rel=0.03)
