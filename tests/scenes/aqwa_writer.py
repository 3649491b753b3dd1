"""Aqwa's files as its 2020 version lays them out: the database in ASCII, and what is read of a listing."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from seacrane.hydro import HydroDatabase, HydroGroup
from seacrane.hydro.data.heading_circle import phase_at
from seacrane.hydro.readers.aqwa_files import LOADS, MOTIONS, ROWS, Run

HEAD = "* CREATED BY A TEST\n* ADDED MASS AND DAMPING ARE OUTPUT, IF LHFR OPTION IS ON\n"
PARAMETERS = "* * * * H Y D R O D Y N A M I C   P A R A M E T E R S   F O R   S T R U C T U R E   1 * * * *"


def run_of(hull: HydroDatabase, centre: Iterable[float]) -> Run:
    """A database as Aqwa has it, about a centre of gravity in the axes of the database."""
    moved, (x, y, z) = hull.at(tuple(centre)), centre
    return Run(
        water=(hull.depth if np.isfinite(hull.depth) else 1000.0, hull.rho, hull.g), omega=hull.omega,
        heading_deg=np.degrees(moved.heading), centres=np.array([[x, y, z]]), masses=moved.mass_matrix[None],
        stiffness=moved.restoring[None], volumes=np.array([hull.mass_matrix[0, 0] / hull.rho]),
        added_mass=moved.added_mass, damping=moved.damping, force=moved.force,
        draughts=np.array([hull.draught]), motion=moved.motion_rao,
        limits={"infinite_frequency_added_mass": moved.infinite_frequency_added_mass},
    )  # fmt: skip


def run_of_group(group: HydroGroup) -> Run:
    """The same of a group, whose bodies are taken to be about their centres of gravity."""
    centres = np.array([body.position for body in group.bodies])
    ahead = [phase_at(at, group.omega, group.heading, group.g, group.depth) for at in centres]
    return Run(
        water=(group.depth, group.rho, group.g), omega=group.omega, heading_deg=np.degrees(group.heading),
        centres=centres, masses=np.array([body.mass_matrix for body in group.bodies]),
        stiffness=np.array([body.restoring for body in group.bodies]),
        volumes=np.array([body.mass_matrix[0, 0] / group.rho for body in group.bodies]),
        added_mass=group.added_mass, damping=group.damping,
        force=group.force * np.repeat(np.concatenate(ahead, axis=2), 6, axis=2),
    )  # fmt: skip


def _lines(indices: Iterable[int], values: np.ndarray, digits: int = 4) -> list[str]:
    """Rows of six numbers, the first behind its indices."""
    rows = np.reshape(values, (-1, min(6, np.size(values))))
    texts = ["".join(f"{value:{digits + 8}.{digits}E}" for value in row) for row in rows]
    first = "".join(f"{i:3d}" for i in indices)
    return [f"{first:11}{texts[0]}", *(" " * 11 + text for text in texts[1:])]


def ah1(run: Run, digits: int = 4) -> str:
    """The database; phases are written with as many digits as all else."""
    count, n, m = len(run.centres), len(run.omega), len(run.heading_deg)
    lines: list[str] = []
    for i in range(1, count + 1):
        lines.append(f"{i:3d}{m:3d}{n:4d}  " + " ".join(f"{value:.7f}" for value in run.heading_deg))
        lines += [" " * 12 + " ".join(f"{w:.10f}" for w in run.omega[at : at + 6]) for at in range(0, n, 6)]
    lines.append("GENERAL")
    lines += [f"{i:3d} " + " ".join(map(str, run.water)) + "     0     0" for i in range(1, count + 1)]
    own = {"COG": run.centres, "DRAFT": run.draughts, "DISPLACEMENT": run.volumes, "MASS": run.masses,
           "HYDSTIFFNESS": run.stiffness, "FIDD": run.other_damping}  # fmt: skip
    for name, values in own.items():
        if values is not None:
            lines.append(name)
            for i in range(count):
                lines += _lines([i + 1], values[i], 10)
    limits = {"ADDEDMASS_HF": run.limits.get("infinite_frequency_added_mass")}
    for name, tables in {"ADDEDMASS": run.added_mass, "DAMPING": run.damping, **limits}.items():
        if tables is None:
            continue
        lines.append(name)
        for i, j in np.ndindex(count, count):
            rows, columns = slice(6 * i, 6 * i + 6), slice(6 * j, 6 * j + 6)
            for k, table in enumerate(np.reshape(tables, (-1, 6 * count, 6 * count)), start=1):
                numbers = [i + 1, j + 1] if tables is limits["ADDEDMASS_HF"] else [i + 1, j + 1, k]
                lines += _lines(numbers, table[rows, columns], digits)
    lines.append("FORCERAO")
    for i, h, k in np.ndindex(count, m, n):
        load = run.force[h, k, 6 * i : 6 * i + 6]
        values = np.concatenate([np.abs(load), -np.degrees(np.angle(load))])
        lines += _lines([i + 1, h + 1, k + 1], values, digits)
    return HEAD + "\n".join(lines) + "\n"


def listing(run: Run) -> str:
    """The pages of a listing that are read, with the digits that it has."""
    depth, rho, g = run.water
    (x, y, z), mass = run.centres[0], run.masses[0]
    lines = [
        f" WATER  DEPTH  . . . . . . = {depth:.4f}", f" DENSITY  OF  WATER  . . . = {rho:.3f}",
        f" ACCELERATION  DUE  TO GRAVITY . . = {g:.3f}",
        f"    T O T A L       1118        {mass[0, 0]:.4E}  {mass[0, 0] * g:.4E}",
        " INERTIA MATRIX " + "\n\n ".join(" ".join(f"{value:.3E}" for value in row) for row in mass[3:, 3:]),
        " * * * * W A V E   F R E Q U E N C I E S / P E R I O D S   A N D   D I R E C T I O N S * * * *",
    ]  # fmt: skip
    for k, w in enumerate(run.omega, start=1):
        first = f"{1:6d}" if k == 1 else " " * 6
        hertz, number = w / (2.0 * np.pi), w**2 / g
        lines.append(
            f"{first}{k:6d} {w:9.5f} {hertz:9.5f} {1 / hertz:7.2f} {number:10.5f} {2 * np.pi / number:10.2f} "
            f"{1.0:8.2f} {1.0:8.2f} {1.0:8.2f}   *UNDEFINED"
        )
    lines += [" STRUCTURE  DIRECTIONS   1", f" STRUCTURE C.O.G.       GX= {x:.4f}  GY= {y:.4f}  GZ= {z:.4f}",
              f"  MESH BASED DISPLACEMENT  . . . . . . . .   = {run.volumes[0]:.5E}", PARAMETERS]  # fmt: skip
    lines += ["   STIFFNESS MATRIX", *_rows(run.stiffness[0])]
    for w, a, b in zip(run.omega, run.added_mass, run.damping, strict=True):
        lines.append(f"   WAVE PERIOD = {2 * np.pi / w:7.3f}   WAVE FREQUENCY = {w:7.4f}")
        lines += ["   ADDED  MASS", *_rows(a), "   DAMPING", *_rows(b)]
    limit = run.limits.get("infinite_frequency_added_mass")
    if limit is not None:
        lines.append(" WAVE FREQUENCY =  100.0000(RAD/S)     ENCOUNTER FREQUENCY =  100.0000(RAD/S)")
        lines += ["   ADDED MASS", *_rows(limit)]
    turns = np.repeat([1.0, 180.0 / np.pi], 3)
    tables = {LOADS: run.force, MOTIONS: None if run.motion is None else run.motion * turns}
    for title, table in tables.items():
        for degrees, rows in zip(run.heading_deg, () if table is None else table, strict=False):
            lines.append(f"   {title}")
            for k, (w, row) in enumerate(zip(run.omega, rows, strict=True)):
                pairs = zip(np.abs(row), -np.degrees(np.angle(row)), strict=True)
                direction = f"{degrees:9.2f}" if k == 0 else " " * 9
                told = "".join(f" {size:.2E} {phase:7.2f}" for size, phase in pairs)
                lines.append(f" {2 * np.pi / w:7.2f} {w:7.3f} {direction} {told}")
    return "\n".join([*lines, "   VEL R.A.O.S-VARIATION WITH WAVE PERIOD/FREQUENCY"]) + "\n"


def _rows(matrix: np.ndarray) -> list[str]:
    return [
        f"  {name:>3} " + " ".join(f"{value:13.4E}" for value in row)
        for name, row in zip(ROWS, matrix, strict=True)
    ]
