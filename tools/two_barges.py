"""Compute the two barges that come with the package with Capytaine: ``python tools/two_barges.py``.

A development tool: needs Capytaine 3, and takes some minutes. Writes three groups: with a lid of damping
0.01 and 0.03 on the gap, and each hull alone.
"""

from __future__ import annotations

import argparse
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import capytaine
import numpy as np
import xarray
from numpy.typing import NDArray

from seacrane.hydro import GroupBody, HydroDatabase, HydroGroup, fit_memory, load_database, rigid_mass_matrix

RHO = 1025.0  # kg/m3
GAP = 5.0  # m
LID_PANEL = 2.5  # m, radius of panels on the waterplane inside a hull, against irregular frequencies
BAND = (0.25, 1.12)  # rad/s, of the memory: above it is the second mode of the gap
LIDS = {0.01: 0.03, 0.03: 0.03}  # damping of a lid on the gap, and the limit of the memory's fit
ROLL_DAMPING = 0.05  # of critical, with an added inertia of a fifth
BITS = 16  # of the numbers that are kept
OMEGA = np.round(
    np.concatenate([
        [0.12, 0.19, 0.25, 0.31, 0.37, 0.43, 0.49, 0.55, 0.61, 0.67, 0.73, 0.79, 0.85, 0.89],
        np.arange(0.92, 1.29, 0.0125),  # the gap's own modes
        [1.32, 1.4, 1.5, 1.65, 1.8, 2.0],
    ]), 4,
)  # fmt: skip
HEADING = np.radians(np.arange(0.0, 360.0, 30.0))


@dataclass(frozen=True, kw_only=True)
class Barge:
    """Length, breadth, draught, height of the centre of gravity over the water, m; panels along each."""

    name: str
    size: tuple[float, float, float]
    height: float
    panels: tuple[int, int, int]

    def body(self, y: float) -> Any:
        """Capytaine's, about a point amidships on the waterline at `y`."""
        mesh = capytaine.mesh_parallelepiped(
            size=self.size,
            center=(0.0, y, -0.5 * self.size[2]),
            resolution=self.panels,
            missing_sides={"top"},
        )
        body = capytaine.FloatingBody(
            mesh=mesh, lid_mesh=mesh.generate_lid(faces_max_radius=LID_PANEL),
            dofs=capytaine.rigid_body_dofs(rotation_center=(0.0, y, 0.0)),
            center_of_mass=(0.0, y, self.height), name=self.name,
        )  # fmt: skip
        body.hydrostatic_stiffness = body.compute_hydrostatic_stiffness(rho=RHO)
        names = list(body.dofs)
        body.inertia_matrix = xarray.DataArray(
            self.mass_matrix(), dims=("influenced_dof", "radiating_dof"),
            coords={"influenced_dof": names, "radiating_dof": names},
        )  # fmt: skip
        return body

    def mass_matrix(self) -> NDArray[np.float64]:
        """Radii of gyration of 0.36 B and 0.25 L."""
        length, breadth, draught = self.size
        mass = RHO * length * breadth * draught
        inertia = mass * np.diag(np.array([0.36 * breadth, 0.25 * length, 0.25 * length]) ** 2)
        return rigid_mass_matrix(mass, np.array([0.0, 0.0, self.height]), inertia)


CRANE = Barge(name="crane vessel", size=(100.0, 25.0, 5.5), height=2.5, panels=(32, 8, 2))
FEEDER = Barge(name="feeder", size=(60.0, 18.0, 3.5), height=1.0, panels=(20, 6, 2))
ABREAST = 0.5 * (CRANE.size[1] + FEEDER.size[1]) + GAP


def main() -> None:
    """Compute, fit, save."""
    parser = argparse.ArgumentParser(description=__doc__)
    root = Path(__file__).resolve().parents[1]
    parser.add_argument("--out", type=Path, default=root / "python" / "seacrane" / "data" / "two_barges")
    out = parser.parse_args().out
    out.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        pair = solved(CRANE.body(0.0) + FEEDER.body(ABREAST), Path(folder) / "pair.nc")
        single = {one.name: solved(one.body(0.0), Path(folder) / f"{one.name}.nc") for one in (CRANE, FEEDER)}
    assert isinstance(pair, HydroGroup)
    for damping, limit in LIDS.items():
        save(passive(pair.with_lid_damping(damping)), limit, out / f"lid_{damping}.hydro")
    databases = {name: one for name, one in single.items() if isinstance(one, HydroDatabase)}
    places = {CRANE.name: np.zeros(3), FEEDER.name: np.array([0.0, ABREAST, 0.0])}
    alone = HydroGroup.from_databases(databases=databases, positions=places)
    save(replace(alone, trusted_band=BAND), 0.02, out / "alone.hydro")


def solved(body: Any, path: Path) -> HydroDatabase | HydroGroup:
    """Radiation and diffraction of one body or of both."""
    wanted = {
        "omega": [*OMEGA, np.inf],
        "wave_direction": HEADING,
        "radiating_dof": list(body.dofs),
        "rho": [RHO],
    }
    found = capytaine.BEMSolver().fill_dataset(xarray.Dataset(coords=wanted), body, progress_bar=False)
    capytaine.export_dataset(path, found.squeeze("rho") if "rho" in found.dims else found)
    return load_database(path, trusted_band=BAND)


def save(group: HydroGroup, limit: float, path: Path) -> None:
    """With viscous damping of roll and the memory of all motions."""
    tables: dict[str, Any] = {
        key: shortened(getattr(group, key))
        for key in ("added_mass", "damping", "force", "infinite_frequency_added_mass")
    }
    lid = (
        "each hull alone" if group.lid_damping is None else f"lid of damping {group.lid_damping:g} on the gap"
    )
    bodies = tuple(damped(body) for body in group.bodies)
    source = f"Capytaine {capytaine.__version__}, {lid}"
    whole = replace(group, name="two barges", bodies=bodies, source=source, **tables)
    memory = fit_memory(database=whole, limit=limit)
    replace(whole, memory=memory).save(path)
    assert memory.motion is not None
    print(f"{path}: {memory.states} states, {memory.motion.error.worst:.3g} of the motions")


def passive(group: HydroGroup) -> HydroGroup:
    """Without what a lid takes out of a resonance that is no sum of poles: water gives no energy."""
    whole = 0.5 * (group.damping + group.damping.swapaxes(1, 2))
    size = np.sqrt(np.diagonal(whole, axis1=1, axis2=2).max(axis=0))
    values, vectors = np.linalg.eigh(whole / np.outer(size, size))
    kept = np.einsum("nij,nj,nkj->nik", vectors, np.maximum(values, 0.0), vectors)
    return replace(group, damping=kept * np.outer(size, size))


def damped(body: GroupBody) -> GroupBody:
    """With a share of critical in roll."""
    damping = body.linear_damping.copy()
    damping[3, 3] = 2.0 * ROLL_DAMPING * np.sqrt(body.restoring[3, 3] * 1.2 * body.mass_matrix[3, 3])
    return replace(body, linear_damping=damping)


def shortened(values: NDArray[Any]) -> NDArray[Any]:
    """Rounded to so many bits that a packed file is half as long: 2e-5 of each number."""
    parts = np.ascontiguousarray(values)
    mantissa, exponent = np.frexp(parts.view(float))
    return np.asarray(np.ldexp(np.round(mantissa * 2.0**BITS) / 2.0**BITS, exponent).view(parts.dtype))


if __name__ == "__main__":
    main()
