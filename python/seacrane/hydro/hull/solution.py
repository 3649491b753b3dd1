"""What a method of hydrodynamics finds for a hull, how it is made symmetric, and the panels of Capytaine."""

from __future__ import annotations

import logging
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seacrane.arrays import Array, Complex
from seacrane.hydro.hull.hull import Hull
from seacrane.hydro.readers.capytaine import MOTION_NAMES

ALONG = 1e-9  # rad: headings this close to 0 or 180 deg are along the ship
MOST_PANELS = 8000  # 16 bytes for each pair of panels, two matrices: 2 GB
PANELS_PER_WAVE = 8.0
LID_PANEL = 1.2  # of the hull's panels


@dataclass(frozen=True, kw_only=True, eq=False)
class HullSolution:
    """Radiation and excitation of a hull about its origin, in the conventions of `HydroDatabase`.

    Attributes
    ----------
    omega, heading, rho, g : (n,) rad/s and (m,) rad at which it was found, and kg/m3, m/s2 of its water.
    added_mass, damping : (n, 6, 6).
    added_mass_zero, added_mass_infinite : (6, 6) limits, or None where the method has none.
    force : (m, n, 6) complex, per metre of wave amplitude.
    method : how it was found, in words.
    trusted_band : (low, high) in rad/s within which the method and its panels can be relied upon.
    """

    omega: Array
    heading: Array
    rho: float
    g: float
    added_mass: Array
    damping: Array
    added_mass_zero: Array | None
    added_mass_infinite: Array
    force: Complex
    method: str
    trusted_band: tuple[float, float]


def symmetric_solution(solution: HullSolution) -> HullSolution:
    """The solution with symmetric matrices, and zero where port-starboard symmetry forbids it to be other.

    Its text says how much that took.
    """
    zero = solution.added_mass_zero
    removed = []
    for matrix in (solution.added_mass, solution.damping):
        scale = np.sqrt(np.abs(np.diagonal(matrix, axis1=-2, axis2=-1)).max(axis=0))
        change = np.abs(matrix - _symmetrised(matrix))
        removed.append(_largest_share(change, np.outer(scale, scale)))
    force = solution.force.copy()
    force[np.abs(np.sin(solution.heading)) < ALONG, :, 1::2] = 0.0  # sway, roll, yaw in head, following seas
    change = np.abs(solution.force - force).max(axis=(0, 1))
    noise = _largest_share(change, np.abs(solution.force).max(axis=(0, 1)))
    return replace(
        solution, added_mass=_symmetrised(solution.added_mass), damping=_symmetrised(solution.damping),
        added_mass_zero=None if zero is None else _symmetrised(zero),
        added_mass_infinite=_symmetrised(solution.added_mass_infinite), force=force,
        method=(
            f"{solution.method}; matrices made symmetric, which removed up to {max(removed):.4f} of the "
            "geometric mean of the largest diagonals; motions that port-starboard symmetry forbids set to "
            f"zero, which removed up to {noise:.1e} of the largest force"
        ),
    )  # fmt: skip


def _symmetrised(matrix: Array) -> Array:
    """(..., 6, 6) without the entries that port-starboard symmetry forbids; its symmetric part."""
    parity = np.arange(6) % 2
    kept = np.where(parity[:, None] == parity, matrix, 0.0)
    return np.asarray(0.5 * (kept + kept.swapaxes(-1, -2)))


def _largest_share(change: Array, whole: Array) -> float:
    return float((change / np.where(whole > 0.0, whole, 1.0)).max())


def capytaine_solution(
    hull: Hull, *, omega: Array, heading: Array, rho: float, g: float,
    lid_panel_radius: float | None = None,
) -> HullSolution:  # fmt: skip
    """Radiation and diffraction with a lid on the waterplane against irregular frequencies.

    The trusted band ends where the wave is eight panels long.

    Raises ImportError: Capytaine is not installed; ValueError: too many panels for the memory of a computer.
    """
    capytaine = import_capytaine("method 'capytaine'", "use method 'strip', which needs nothing")
    if len(hull.panels) > MOST_PANELS:
        raise ValueError(
            f"hull {hull.name!r}: {len(hull.panels)} panels are too many for Capytaine's dense matrices "
            f"(limit {MOST_PANELS}); use hull.remeshed(stations=..., girth=...)"
        )
    vertices = hull.panels.reshape(-1, 3)
    faces = np.arange(len(vertices)).reshape(-1, 4)
    mesh = capytaine.Mesh(vertices=vertices, faces=faces, name=hull.name)
    lid = mesh.generate_lid(faces_max_radius=lid_panel_radius or LID_PANEL * hull.panel_size)
    dofs = capytaine.rigid_body_dofs(rotation_center=(0.0, 0.0, 0.0))
    body = capytaine.FloatingBody(mesh=mesh, lid_mesh=lid, dofs=dofs, name=hull.name)
    solved = _solved(capytaine, body, omega, heading, rho, g)
    names = list(MOTION_NAMES)
    added_mass, damping = (
        table.transpose("omega", "influenced_dof", "radiating_dof").sel(
            influenced_dof=names, radiating_dof=names
        )
        for table in (solved.added_mass, solved.radiation_damping)
    )
    force = (solved.diffraction_force + solved.Froude_Krylov_force).sel(omega=omega, influenced_dof=names)
    force = force.transpose("wave_direction", "omega", "influenced_dof")
    shortest = PANELS_PER_WAVE * hull.panel_size
    return HullSolution(
        omega=omega,
        heading=heading,
        rho=rho,
        g=g,
        added_mass=added_mass.sel(omega=omega).values,
        damping=damping.sel(omega=omega).values,
        added_mass_zero=added_mass.sel(omega=0.0).values,
        added_mass_infinite=added_mass.sel(omega=np.inf).values,
        force=np.conj(force.values),  # Capytaine's time factor is exp(-i omega t)
        method=f"Capytaine {capytaine.__version__}, {mesh.nb_faces} hull and {lid.nb_faces} lid panels",
        trusted_band=(float(omega[0]), float(np.sqrt(2.0 * np.pi * g / shortest))),
    )


def _solved(capytaine: Any, body: Any, omega: Array, heading: Array, rho: float, g: float) -> Any:
    """Capytaine's dataset at the frequencies, at zero and at infinity (where it leaves out diffraction)."""
    import xarray

    wanted = xarray.Dataset(
        coords={
            "omega": np.concatenate([omega, [0.0, np.inf]]),
            "radiating_dof": list(MOTION_NAMES),
            "wave_direction": heading,
            "water_depth": [np.inf],
            "rho": [rho],
            "g": g,
        }
    )
    solved = capytaine.BEMSolver().fill_dataset(wanted, body, progress_bar=False)
    for axis in ("omega", "wave_direction"):
        if axis not in solved.dims:
            solved = solved.expand_dims(axis)
    return solved.squeeze([axis for axis in ("water_depth", "rho", "g") if axis in solved.dims], drop=True)


def import_capytaine(what: str, instead: str) -> Any:
    """The module, which reports errors alone; or an ImportError that says what to do."""
    try:
        import capytaine
    except ImportError as error:
        raise ImportError(
            f"{what} needs Capytaine 3, which is not installed: pip install 'seacrane[hydro]'; or {instead}"
        ) from error
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    return capytaine
