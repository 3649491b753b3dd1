"""Hydrodynamics of a hull by Capytaine: three-dimensional source panels, deep water, zero speed."""

from __future__ import annotations

import logging
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.hull.hull import Hull
from seacrane.hydro.hull.solution import HullSolution
from seacrane.hydro.readers.capytaine import MOTION_NAMES

FloatArray = NDArray[np.float64]

MOST_PANELS = 8000  # 16 bytes for each pair of panels, two matrices: 2 GB
PANELS_PER_WAVE = 8.0
LID_PANEL = 1.2  # of the hull's panels


def capytaine_solution(
    hull: Hull,
    *,
    omega: FloatArray,
    heading: FloatArray,
    rho: float,
    g: float,
    lid_panel_radius: float | None = None,
) -> HullSolution:
    """Radiation and diffraction with a lid on the waterplane against irregular frequencies.

    The trusted band ends where the wave is eight panels long.

    Raises
    ------
    ImportError : Capytaine is not installed.
    ValueError : too many panels for the memory of a computer.
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
    order = ("omega", "influenced_dof", "radiating_dof")
    names = list(MOTION_NAMES)
    matrices = {"influenced_dof": names, "radiating_dof": names}
    added_mass = solved.added_mass.transpose(*order).sel(matrices)
    damping = solved.radiation_damping.transpose(*order).sel(matrices).sel(omega=omega)
    force = (solved.diffraction_force + solved.Froude_Krylov_force).sel(omega=omega, influenced_dof=names)
    force = force.transpose("wave_direction", "omega", "influenced_dof")
    shortest = PANELS_PER_WAVE * hull.panel_size
    return HullSolution(
        added_mass=added_mass.sel(omega=omega).values,
        damping=damping.values,
        added_mass_zero=added_mass.sel(omega=0.0).values,
        added_mass_infinite=added_mass.sel(omega=np.inf).values,
        force=np.conj(force.values),  # Capytaine's time factor is exp(-i omega t)
        method=f"Capytaine {capytaine.__version__}, {mesh.nb_faces} hull and {lid.nb_faces} lid panels",
        trusted_band=(float(omega[0]), float(np.sqrt(2.0 * np.pi * g / shortest))),
    )


def _solved(capytaine: Any, body: Any, omega: FloatArray, heading: FloatArray, rho: float, g: float) -> Any:
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
