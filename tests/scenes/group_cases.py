"""Two hulls in one water for tests, and files of them as each code writes them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import xarray
from test_hydro_nemoh import control, write_hydrostatics, write_tables

from seacrane.hydro import HydroGroup, shipped_database

MOTIONS = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
FEEDER = (6.0, 38.0, -1.5)  # m, reference point of the second hull
HEIGHT = 1.5  # m, of the first one's reference point above the still waterline


def written_pair(*, heading: float = 0.0) -> HydroGroup:
    """A hull twice, with coupling blocks of any numbers, so that no transposition goes unseen."""
    hull = shipped_database().select(every=8, every_heading=3)
    pair = HydroGroup.from_databases(databases={"crane": hull, "feeder": hull},
                                     positions={"crane": (0.0, 0.0, HEIGHT), "feeder": FEEDER},
                                     headings={"feeder": heading}, name="pair")  # fmt: skip
    draw = np.random.default_rng(33)
    size = np.sqrt(np.abs(np.diagonal(pair.added_mass, axis1=1, axis2=2)).max(axis=0))
    coupling = np.kron(1.0 - np.eye(2), np.ones((6, 6))) * np.outer(size, size)
    shape = pair.added_mass.shape
    infinite = pair.infinite_frequency_added_mass
    return replace(pair, added_mass=pair.added_mass + 0.1 * coupling * draw.standard_normal(shape),
                   damping=pair.damping + 0.1 * coupling * draw.standard_normal(shape),
                   infinite_frequency_added_mass=infinite + 0.1 * coupling * draw.standard_normal(shape[1:]),
                   zero_frequency_added_mass=None,
                   force=pair.force * (1.0 + 0.1 * draw.standard_normal(pair.force.shape[2])),
                   trusted_band=None)  # fmt: skip


def capytaine_dataset(group: HydroGroup) -> xarray.Dataset:
    """As Capytaine 3 writes it, degrees of freedom and bodies in an order of their own."""
    labels = np.array([f"{name}__{motion}" for name in group.names for motion in MOTIONS])
    order = np.random.default_rng(1).permutation(len(labels))
    first = [int(i) for i in order if labels[i].startswith(group.names[0])][:1]
    order = np.concatenate([first, [i for i in order if i not in first]])  # bodies are named by first place
    omega = np.append(group.omega, np.inf)
    infinite = group.infinite_frequency_added_mass
    square = np.ix_(range(len(omega)), order, order)
    added_mass = np.concatenate([group.added_mass, infinite[None]])
    damping = np.concatenate([group.damping, np.zeros((1, *group.damping.shape[1:]))])
    force = np.concatenate([group.force, np.full_like(group.force[:, :1], np.nan)], axis=1)
    turned = np.conj(force).transpose(1, 0, 2)[:, :, order]
    matrix = ("influenced_dof", "radiating_dof")
    waves = ("complex", "omega", "wave_direction", "influenced_dof")
    bodies = group.names[::-1]
    by_name = {body.name: body for body in group.bodies}
    centres = (("body", "space_coordinate"), np.array([by_name[name].position for name in bodies]))
    return xarray.Dataset({"added_mass": (("omega", *matrix), added_mass[square]),
                           "radiation_damping": (("omega", *matrix), damping[square]),
                           "excitation_force": (waves, np.stack([turned.real, turned.imag])),
                           "inertia_matrix": (matrix, group.mass_matrix[np.ix_(order, order)]),
                           "hydrostatic_stiffness": (matrix, group.restoring[np.ix_(order, order)]),
                           "draught": ("body", [by_name[name].draught for name in bodies])},
                          {"omega": omega, "wave_direction": group.heading, "complex": ["re", "im"],
                           "body": list(bodies), "influenced_dof": labels[order],
                           "radiating_dof": labels[order], "rho": group.rho, "g": group.g,
                           "space_coordinate": ["x", "y", "z"], "rotation_center": centres,
                           "water_depth": np.inf, "forward_speed": 0.0},
                          {"capytaine_version": "3.0.0"})  # fmt: skip


def capytaine_file(group: HydroGroup, folder: Path) -> Path:
    path = folder / "pair.nc"
    capytaine_dataset(group).to_netcdf(path)
    return path


def nemoh_folder(group: HydroGroup, folder: Path) -> Path:
    """A project of NEMOH 3, waves measured at (10, -4)."""
    (folder / "Results").mkdir()
    (folder / "Mesh").mkdir()
    head, bodies = [], []
    for body in group.bodies:
        lines = control(body.position).splitlines()
        head, body_lines = lines[:4], lines[7:]
        body_lines[1] = f"mesh\\{body.name}.dat ! Mesh"
        bodies += body_lines
    text = [*head, "10. -4. ! XEFF YEFF", "--- Bodies ---", f"{len(group)} ! Number of bodies", *bodies]
    (folder / "Nemoh.cal").write_text("\n".join(text) + "\n")
    write_tables(group, folder / "Results", (10.0, -4.0), old=False)
    for i, body in enumerate(group.bodies):
        volume = body.mass_matrix[0, 0] / group.rho
        write_hydrostatics(folder / "Mesh", f"_{i}", body.restoring, body.position, volume)
    return folder


def wamit_files(group: HydroGroup, folder: Path, *, numbers: bool = True) -> Path:
    """A set of WAMIT files; without ``numbers`` the listing alone, in which phases are whole degrees."""
    turns = np.tile([0, 0, 0, 1, 1, 1], len(group))
    rho, g = group.rho, group.g
    infinite = group.infinite_frequency_added_mass
    periods = 2.0 * np.pi / group.omega
    listing = ["WAMIT  Version 7.2", "Input from Geometric Data Files:"]
    listing += [f"   N=  {i}     {name}.gdf" for i, name in enumerate(group.names, start=1)]
    listing += [f"Gravity:  {g:.6f}   Length scale:  1.00000", "Water depth:   infinite"]
    listing += [f"Water density:   {rho:.3f}"]
    for i, body in enumerate(group.bodies, start=1):
        c = body.restoring / (rho * g)
        x, y, z = body.position
        listing += [
            f"Body number: N= {i}   Total panels:  100",
            f"XBODY = {x:.4f} YBODY = {y:.4f} ZBODY = {z:.4f} PHIBODY = {np.degrees(body.heading):.4f}",
            "Volumes (VOLX,VOLY,VOLZ): " + f" {body.mass_matrix[0, 0] / rho:.4f}" * 3,
            "Center of Buoyancy (Xb,Yb,Zb): 0.0 0.0 -3.0",
            f"C(3,3),C(3,4),C(3,5): {c[2, 2]:.10E} {c[2, 3]:.10E} {c[2, 4]:.10E}",
            f"C(4,4),C(4,5),C(4,6): {c[3, 3]:.10E} {c[3, 4]:.10E} {c[3, 5]:.10E}",
            f"C(5,5),C(5,6): {c[4, 4]:.10E} {c[4, 5]:.10E}",
            "Center of Gravity  (Xg,Yg,Zg): 0.0 0.0 0.0",
        ]
    entries = [(i, j) for i in range(len(turns)) for j in range(len(turns))]
    rows = [f"0.0 {i + 1} {j + 1} {infinite[i, j] / rho:.10E}" for i, j in entries]
    listing += ["Wave period = zero  Wavenumber = infinite", "   ADDED-MASS COEFFICIENTS"]
    listing += [f"{i + 1} {j + 1} {infinite[i, j] / rho:.10E}" for i, j in entries]
    waves = []
    for n, period in enumerate(periods):
        listing += [f"Wave period (sec) = {period:.12E}", "   ADDED-MASS AND DAMPING COEFFICIENTS"]
        for i, j in entries:
            a, b = group.added_mass[n, i, j] / rho, group.damping[n, i, j] / (rho * group.omega[n])
            listing.append(f"{i + 1} {j + 1} {a:.10E} {b:.10E}")
            rows.append(f"{period:.12E} {i + 1} {j + 1} {a:.10E} {b:.10E}")
        listing.append("   DIFFRACTION EXCITING FORCES AND MOMENTS")
        for m, heading in enumerate(np.degrees(group.heading)):
            listing.append(f"  Wave Heading (deg) : {heading:.8f}")
            for i, force in enumerate(group.force[m, n] / (rho * g)):
                size, phase = abs(force), np.degrees(np.angle(force))
                listing.append(f"{i + 1} {size:.10E} {phase:.0f}")
                told = f"{size:.10E} {phase:.8f} {force.real:.10E} {force.imag:.10E}"
                waves.append(f"{period:.12E} {heading:.8f} {i + 1} {told}")
        listing.append("   SURGE, SWAY & YAW DRIFT FORCES (Momentum Conservation)")
        listing.append("1 1.0 2.0")
    (folder / "pair.out").write_text("\n".join(listing) + "\n")
    if numbers:
        stiff = group.restoring / (rho * g)
        (folder / "pair.1").write_text("\n".join(rows) + "\n")
        (folder / "pair.3").write_text("\n".join(waves) + "\n")
        lines = [f"{i + 1} {j + 1} {stiff[i, j]:.10E}" for i, j in entries]
        (folder / "pair.hst").write_text("\n".join(lines) + "\n")
    return folder


def bemio_file(group: HydroGroup, folder: Path) -> Path:
    """An HDF5 file; its bodies turn about their centres of gravity, which are the reference points here."""
    path = folder / "pair.h5"
    rho, g = group.rho, group.g
    infinite = group.infinite_frequency_added_mass
    with h5py.File(path, "w") as file:
        told = {"rho": rho, "g": g, "scaled": 0.0, "water_depth": b"infinite", "w": group.omega}
        for name, value in (told | {"wave_dir": np.degrees(group.heading)}).items():
            file[f"simulation_parameters/{name}"] = value
        for i, body in enumerate(group.bodies):
            of, at = f"body{i + 1}/hydro_coeffs", slice(6 * i, 6 * i + 6)
            force = group.force[:, :, at].transpose(2, 0, 1) / (rho * g)
            values = {
                f"body{i + 1}/properties/name": body.name.encode(),
                f"body{i + 1}/properties/cg": body.position,
                f"body{i + 1}/properties/disp_vol": body.mass_matrix[0, 0] / rho,
                f"{of}/added_mass/all": group.added_mass[:, at].transpose(1, 2, 0) / rho,
                f"{of}/added_mass/inf_freq": infinite[at] / rho,
                f"{of}/radiation_damping/all": group.damping[:, at].transpose(1, 2, 0) / rho / group.omega,
                f"{of}/linear_restoring_stiffness": body.restoring / (rho * g),
                f"{of}/excitation/re": force.real,
                f"{of}/excitation/im": force.imag,
            }
            for name, value in values.items():
                file[name] = value
    return path
