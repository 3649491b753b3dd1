"""Compute the shipped hydrodynamic database with Capytaine: ``python tools/make_database.py``.

A development tool: needs Capytaine 3, which the package itself never imports. Everything that is not the hull
or the numerical grid is converted to the conventions of seacrane (exp(+i omega t); x forward, y port, z up).
"""

from __future__ import annotations

import argparse
import hashlib
import logging
from dataclasses import dataclass, replace
from pathlib import Path

import capytaine
import numpy as np
import xarray as xr
from numpy.typing import NDArray

from seacrane.hydro.database import HydroDatabase
from seacrane.hydro.memory import fit_memory
from seacrane.hydro.motion import natural_frequency
from seacrane.hydro.parametric_hull import Hydrostatics, ParametricHull, panel_hydrostatics
from seacrane.hydro.vessel import rigid_mass_matrix

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

RHO, G = 1025.0, 9.81
MASS = 14.0e6
GM_TRANSVERSE = 3.0
ROLL_DAMPING_FRACTION = 0.05
TRUSTED_BAND = (0.3, 2.5)
STATIONS, GIRTH = 56, 20
LID_PANEL_RADIUS = 1.5
MOTIONS = ["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]
HULL = ParametricHull(
    length=115.0,
    breadth=25.0,
    draught=6.4,
    entrance_length=40.0,
    run_length=34.5,
    transom_breadth_fraction=0.75,
    transom_draught_fraction=0.2,
    section_exponent=6.0,
)
OMEGA = np.round(np.arange(0.1, 3.1001, 0.05), 10)
HEADING = np.radians(np.arange(0.0, 180.1, 5.0))


@dataclass(frozen=True)
class Solution:
    """Capytaine's answer in our conventions, before symmetrising."""

    added_mass: FloatArray
    added_mass_zero: FloatArray
    added_mass_infinite: FloatArray
    damping: FloatArray
    force: ComplexArray
    hull_panels: int
    lid_panels: int


def main() -> None:
    """Compute, fit, save."""
    parser = argparse.ArgumentParser(description=__doc__)
    root = Path(__file__).resolve().parents[1]
    parser.add_argument("--out", type=Path, default=root / "python" / "seacrane" / "data" / "hull_115.nc")
    parser.add_argument(
        "--raw", type=Path, help="keep Capytaine's solution here, and reuse it when it is there"
    )
    arguments = parser.parse_args()
    hull = HULL.scaled_to_volume(MASS / RHO, stations=STATIONS, girth=GIRTH)
    panels = hull.panels(stations=STATIONS, girth=GIRTH)
    solution = solve_or_reuse(panels, arguments.raw)
    database = assemble(hull, panel_hydrostatics(panels), solution)
    database = replace(database, memory=fit_memory(database=database, band=TRUSTED_BAND))
    database.save(arguments.out)
    for row in database.check():
        print(f"{row.check:40s} {row.value:12.4g} {row.verdict}")
    print(f"{arguments.out}: {arguments.out.stat().st_size / 1e3:.0f} kB")


def solve_or_reuse(panels: FloatArray, raw: Path | None) -> Solution:
    """Solve, or read what an earlier run of this script kept."""
    if raw is not None and raw.exists():
        with np.load(raw) as stored:
            return Solution(
                **{name: stored[name] if stored[name].ndim else int(stored[name]) for name in stored}
            )
    solution = solve(panels)
    if raw is not None:
        with raw.open("wb") as file:
            np.savez(file, **vars(solution))
    return solution


def solve(panels: FloatArray) -> Solution:
    """Radiation and diffraction of the hull, with a lid against irregular frequencies."""
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    vertices = panels.reshape(-1, 3)
    mesh = capytaine.Mesh(vertices=vertices, faces=np.arange(len(vertices)).reshape(-1, 4), name="hull_115")
    lid = mesh.generate_lid(faces_max_radius=LID_PANEL_RADIUS)
    dofs = capytaine.rigid_body_dofs(rotation_center=(0.0, 0.0, 0.0))
    body = capytaine.FloatingBody(mesh=mesh, lid_mesh=lid, dofs=dofs, name="hull_115")
    limits = np.array([0.0, np.inf])  # diffraction is undefined there: Capytaine leaves it out
    wanted = xr.Dataset(
        coords={
            "omega": np.concatenate([OMEGA, limits]),
            "radiating_dof": MOTIONS,
            "wave_direction": HEADING,
            "water_depth": [np.inf],
            "rho": [RHO],
            "g": G,
        }
    )
    solved = capytaine.BEMSolver().fill_dataset(wanted, body, progress_bar=False).squeeze()
    order = ("omega", "influenced_dof", "radiating_dof")
    by_name = {"influenced_dof": MOTIONS, "radiating_dof": MOTIONS}
    added_mass = solved.added_mass.transpose(*order).sel(by_name)
    damping = solved.radiation_damping.transpose(*order).sel(by_name).sel(omega=OMEGA)
    force = (solved.diffraction_force + solved.Froude_Krylov_force).sel(omega=OMEGA, influenced_dof=MOTIONS)
    force = force.transpose("wave_direction", "omega", "influenced_dof")
    return Solution(
        added_mass=added_mass.sel(omega=OMEGA).values,
        added_mass_zero=added_mass.sel(omega=0.0).values,
        added_mass_infinite=added_mass.sel(omega=np.inf).values,
        damping=damping.values,
        force=np.conj(force.values),  # Capytaine's time factor is exp(-i omega t)
        hull_panels=mesh.nb_faces,
        lid_panels=lid.nb_faces,
    )


def assemble(hull: ParametricHull, hydrostatics: Hydrostatics, solution: Solution) -> HydroDatabase:
    """The database: symmetrised results, mass and restoring of the hull alone, added roll damping."""
    raw = (solution.added_mass, solution.damping, solution.added_mass_zero, solution.added_mass_infinite)
    added_mass, damping, zero, infinite = (symmetrised(matrix) for matrix in raw)
    removed = max(asymmetry(solution.added_mass), asymmetry(solution.damping))
    force, noise = symmetrised_force(solution.force)
    metacentre = (
        hydrostatics.centre_of_buoyancy[2] + hydrostatics.waterplane_inertia_roll / hydrostatics.volume
    )
    centre_z = float(metacentre - GM_TRANSVERSE)
    restoring = hydrostatics.restoring(rho=RHO, g=G, centre_of_gravity_z=centre_z)
    gyration = np.array([0.36 * hull.breadth, 0.25 * hull.length, 0.25 * hull.length])
    mass_matrix = rigid_mass_matrix(MASS, np.array([0.0, 0.0, centre_z]), MASS * np.diag(gyration**2))
    script = hashlib.sha256(Path(__file__).read_bytes()).hexdigest()
    bare = HydroDatabase(
        name="hull_115",
        omega=OMEGA,
        heading=HEADING,
        added_mass=added_mass,
        damping=damping,
        zero_frequency_added_mass=zero,
        infinite_frequency_added_mass=infinite,
        restoring=restoring,
        mass_matrix=mass_matrix,
        force=force,
        length=hull.length,
        breadth=hull.breadth,
        draught=hull.draught,
        rho=RHO,
        g=G,
        trusted_band=TRUSTED_BAND,
        origin=f"LCG on the still waterline, {hull.origin_from_transom:.4f} m forward of the transom",
        source=(
            f"tools/make_database.py (sha256 {script}) with Capytaine {capytaine.__version__}; {hull}; "
            f"{solution.hull_panels} hull and {solution.lid_panels} lid panels; volume of the panel mesh "
            f"{hydrostatics.volume:.6f} m3; centre of gravity {centre_z:.6f} m above the waterline for GM_T "
            f"{GM_TRANSVERSE} m; matrices made symmetric, which removed up to {removed:.4f} of the geometric "
            "mean of "
            "the largest diagonals; motions that port-starboard symmetry forbids set to zero, which removed "
            "up to "
            f"{noise:.1e} of the largest force; linear roll damping of {ROLL_DAMPING_FRACTION} of critical "
            "added in "
            "linear_damping"
        ),
    )
    return replace(bare, linear_damping=roll_damping(bare))


def symmetrised(matrix: FloatArray) -> FloatArray:
    """Symmetric part of (..., 6, 6), without the entries that port-starboard symmetry forbids."""
    parity = np.arange(6) % 2
    allowed = parity[:, None] == parity
    return np.where(allowed, 0.5 * (matrix + matrix.swapaxes(-1, -2)), 0.0)


def asymmetry(matrix: FloatArray) -> float:
    """Largest change by `symmetrised`, by the geometric mean of the largest diagonals."""
    scale = np.sqrt(np.abs(np.diagonal(matrix, axis1=-2, axis2=-1)).max(axis=0))
    return float((np.abs(matrix - symmetrised(matrix)) / np.outer(scale, scale)).max())


def symmetrised_force(force: ComplexArray) -> tuple[ComplexArray, float]:
    """Forces (m, n, 6) with sway, roll and yaw zero in head and following seas, and the relative size
    removed."""
    clean = force.copy()
    ends = [0, len(HEADING) - 1]
    clean[np.ix_(ends, range(len(OMEGA)), [1, 3, 5])] = 0.0
    return clean, float((np.abs(force - clean).max(axis=(0, 1)) / np.abs(force).max(axis=(0, 1))).max())


def roll_damping(database: HydroDatabase) -> FloatArray:
    """Linear damping (6, 6): a fraction of the critical roll damping at the roll natural frequency."""
    resonance = natural_frequency(database, 3)
    if resonance is None:
        raise ValueError("the roll natural frequency lies outside the database; check GM and inertia")
    inertia = database.mass_matrix[3, 3] + np.interp(resonance, database.omega, database.added_mass[:, 3, 3])
    damping = np.zeros((6, 6))
    damping[3, 3] = ROLL_DAMPING_FRACTION * 2.0 * np.sqrt(database.restoring[3, 3] * inertia)
    return damping


if __name__ == "__main__":
    main()
