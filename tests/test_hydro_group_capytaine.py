"""Two hulls by Capytaine: its own motions, waves between far hemispheres, and what a mirror does to a pair."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from scipy.special import hankel2, j0

from seacrane.hydro import HydroGroup, read_capytaine_group

capytaine = pytest.importorskip("capytaine")
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.RoughDataWarning")
RADIUS = 5.0  # m
OMEGA = 0.8  # rad/s
DISTANCES = (100.0, 550.0, 3000.0)  # m


def hemisphere(name: str, x: float, y: float) -> Any:
    mesh = capytaine.mesh_sphere(radius=RADIUS, center=(x, y, 0.0), resolution=(6, 8)).immersed_part()
    body = capytaine.FloatingBody(
        mesh=mesh,
        dofs=capytaine.rigid_body_dofs(rotation_center=(x, y, 0.0)),
        center_of_mass=(x, y, -1.0),
        name=name,
    )
    body.inertia_matrix = body.compute_rigid_body_inertia(rho=1025.0)
    body.hydrostatic_stiffness = body.compute_hydrostatic_stiffness(rho=1025.0)
    return body


def solved(bodies: tuple[Any, Any], omega: list[float], heading: list[float]) -> xarray.Dataset:
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    both = bodies[0] + bodies[1]
    wanted = xarray.Dataset(
        coords={
            "omega": omega,
            "wave_direction": heading,
            "radiating_dof": list(both.dofs),
            "rho": [1025.0],
        }
    )
    return capytaine.BEMSolver().fill_dataset(wanted, both, progress_bar=False)


def as_group(dataset: xarray.Dataset, folder: Path) -> HydroGroup:
    path = folder / "pair.nc"
    capytaine.export_dataset(path, dataset)
    return read_capytaine_group(path)


def test_motions_are_capytaines_own(tmp_path: Path) -> None:
    """Places off the axes and waves from the side: phases, order and coupling are those of its own solution."""
    bodies = hemisphere("near", 2.0, -3.0), hemisphere("far", 8.0, 9.0)
    dataset = solved(bodies, [0.7, 1.1], [0.5, 2.0])
    group = as_group(dataset, tmp_path)
    own = capytaine.post_pro.rao(dataset)
    labels = [f"{name}__{motion}" for name in group.names for motion in ("Surge", "Sway", "Heave")]
    theirs = np.conj(own.sel(radiating_dof=labels).transpose("wave_direction", "omega", "radiating_dof").values)
    mine = group.motion_rao[:, :, [0, 1, 2, 6, 7, 8]]
    assert np.abs(mine - theirs).max() < 1e-6 * np.abs(theirs).max()
    assert np.abs(group.without_coupling().motion_rao[:, :, [2, 8]] - theirs[:, :, [2, 5]]).max() > 0.02


def test_far_hemispheres_couple_as_point_sources(tmp_path: Path) -> None:
    """B12 / B11 = J0(k R); the coupling of both falls as |H0(k R)|, which is R^-1/2 from 0.1 to 3 km."""
    k = OMEGA**2 / 9.81
    found = []
    for distance in DISTANCES:
        bodies = hemisphere("one", 0.0, 0.0), hemisphere("two", distance, 0.0)
        group = as_group(solved(bodies, [OMEGA], [0.0]), tmp_path)
        own = group.damping[0, 2, 2]
        coupled = (group.damping[0, 2, 8] + 1j * OMEGA * group.added_mass[0, 2, 8]) / own
        assert coupled.real == pytest.approx(j0(k * distance), abs=0.005)
        assert abs(coupled) == pytest.approx(abs(hankel2(0, k * distance)), rel=0.03)
        found.append(abs(coupled) * np.sqrt(distance))
    assert np.ptp(found) < 0.03 * found[0]
    assert found[1] / np.sqrt(DISTANCES[1]) > 0.13  # still there at half a kilometre


def test_a_mirrored_pair_is_symmetric(tmp_path: Path) -> None:
    """Two alike hulls about the x axis in head seas: heave alike, sway and roll opposite."""
    bodies = hemisphere("port", 0.0, 8.0), hemisphere("starboard", 0.0, -8.0)
    group = as_group(solved(bodies, [0.9], [0.0]), tmp_path)
    port, starboard = (group.motion_rao[0, 0, group.place(name)] for name in group.names)
    mirror = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    assert np.abs(starboard - mirror * port).max() < 1e-4 * np.abs(port).max()
    assert abs(port[1]) > 1e-3
