"""Reader of NEMOH's results in Tecplot form, as NEMOH 2 writes them and Capytaine exports them.

The files are described in `seacrane.hydro.readers.nemoh_files`. The stiffness is about the centre of gravity,
and that of Capytaine's exports about the rotation centre.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.frozen import reading
from seacrane.hydro.data.hydro_group_data import GroupBody
from seacrane.hydro.database.transform import motion_transform
from seacrane.hydro.readers.as_read import Asked, Given, left_out
from seacrane.hydro.readers.format import Format, Loaded
from seacrane.hydro.readers.nemoh_files import (
    CONTROL,
    EXCITATION,
    RADIATION,
    Water,
    needed,
    project_of,
    read_control,
    read_hydrostatics,
    read_solution,
    read_stiffness,
    sought,
)
from seacrane.hydro.readers.of_bodies import floating_body, hull_or_group, of_each
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import AssumedDensityWarning

SAME_POINT = 1e-6  # m
NEAR = 0.1  # of the distance of both points: the waves have told which


def read_nemoh(
    path: str | PathLike[str],
    *,
    rho: float = 1025.0,
    g: float = 9.81,
    depth: float = np.inf,
    rotation_centre: ArrayLike = (0.0, 0.0, 0.0),
    mass_matrix: Given | None = None,
    restoring: Given | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> Loaded:
    """Read a folder of NEMOH's results of one body or of several, with six motions each.

    Parameters
    ----------
    path : the folder, or a file in it. The files stand in it, or in its ``results`` and ``mesh``.
    rho, g, depth, rotation_centre : kg/m3, m/s2, m and (3,) m from the origin of the mesh, of results of one
        body without ``Nemoh.cal``, such as Capytaine exports; beside it they are not used.
    mass_matrix : (6, 6) in SI about the rotation centre, of several bodies by name. The files hold none.
    restoring : (6, 6) in SI about the rotation centre, of several bodies by name, in the place of ``KH.dat``.
    motions, leave_out : as `read_capytaine` takes them.

    Returns
    -------
    HydroDatabase : of one body, about its rotation centre.
    HydroGroup : of several, named as their mesh files, in the order of ``Nemoh.cal``; its origin is that of
        the meshes. Lengths, breadths and draughts are those of the equivalent boxes.

    Warns
    -----
    AssumedDensityWarning : no ``Nemoh.cal``: density, gravity, depth and rotation centre are the arguments.

    Raises
    ------
    FileFormatError : a file is missing, truncated or damaged, or the hydrostatics of a body are not its own;
        the message names it and the line or the body.
    """
    folder = project_of(Path(path))
    matrices, forces = (needed(sought(folder, name), folder / name) for name in (RADIATION, EXCITATION))
    control = sought(folder, CONTROL)
    if control is not None:
        water, usual = read_control(control), "centre of gravity"
    else:
        centre, usual = np.asarray(rotation_centre, dtype=float), "rotation centre"
        water = Water(float(rho), float(g), float(depth), centre[None], (0.0, 0.0), ["body"])
        warn_caller(
            f"{folder}: has no {CONTROL}; {rho:g} kg/m3, {g:g} m/s2, depth {depth:g} m and rotations about "
            f"{tuple(centre.tolist())} m are taken",
            AssumedDensityWarning,
        )
    asked = Asked(
        where=folder, reader="read_nemoh", mass_matrix=mass_matrix, restoring=restoring, motions=motions,
        leave_out=leave_out,
    )  # fmt: skip
    masses = of_each(asked, "mass_matrix", water.names, mass_matrix)
    restorings = of_each(asked, "restoring", water.names, restoring)
    numbers = [f"_{i}" for i in range(len(water.names))] if len(water.names) > 1 else [""]
    hydrostatics = [[sought(folder, f"{kind}{n}.dat") for kind in ("KH", "Hydrostatics")] for n in numbers]
    files = [matrices, forces, control, *(file for pair in hydrostatics for file in pair)]
    told = replace(asked, where=folder / ", ".join(file.name for file in files if file is not None))
    with reading(told.where):
        solved = read_solution(matrices, forces, control, water.names)
        finite = np.isfinite(solved["force"]).all(axis=(0, 2))
        lifts = solved["force"][:, np.argmin(np.where(finite, solved["omega"], np.inf))]
        bodies = [
            _body(asked, water, i, hydrostatics[i], masses[i], restorings[i], lifts[:, 6 * i :], usual)
            for i in range(len(water.names))
        ]
        x, y, z = water.centres[0]
        origin = f"rotation centre of the NEMOH body, ({x:g}, {y:g}, {z:g}) m from the origin of its mesh"
        if len(bodies) > 1:
            origin = "origin of the meshes of NEMOH, on the still waterline"
        beside = sorted(file for file in matrices.parent.iterdir() if file.is_file() and file not in files)
        unread = left_out([file.name for file in beside])
        return hull_or_group(
            told, bodies, fix="restoring={name: (6, 6)} and mass_matrix", waves_from=water.phase_origin,
            name=folder.resolve().name, origin=origin, rho=water.rho, g=water.g, depth=water.depth, **solved,
            source=f"NEMOH results in folder {folder.resolve().name}{unread}",
        )  # fmt: skip


def _body(
    asked: Asked,
    water: Water,
    index: int,
    files: list[Path | None],
    mass: Array | None,
    restoring: Array | None,
    lift: Complex,
    usual: str,
) -> GroupBody:
    """One body, of its stiffness and its hydrostatics; ``lift`` and ``usual`` as in `_stiffness_about`."""
    name, centre, several = water.names[index], water.centres[index], len(water.names) > 1
    number, told = f"_{index}" if several else "", asked.where
    if restoring is None:
        told = needed(files[0], asked.where / f"KH{number}.dat")
        restoring = read_stiffness(told)
        if files[1] is not None:
            gravity = read_hydrostatics(files[1])[0]
            restoring = _stiffness_about(centre, restoring, gravity=gravity, lift=lift, usual=usual)
    volume = None  # hydrostatics of several may be those of all together: that of the mass
    if mass is None or not several:
        volume = read_hydrostatics(needed(files[1], asked.where / f"Hydrostatics{number}.dat"))[1]
    return floating_body(
        asked, name, where=told, several=several, position=centre, restoring=restoring, volume=volume,
        water=(water.rho, water.g), mass=mass,
    )  # fmt: skip


def _stiffness_about(centre: Array, stiffness: Array, *, gravity: Array, lift: Complex, usual: str) -> Array:
    """A floating body's stiffness (6, 6) about ``centre``; points are (3,) m in one frame.

    The file gives it about its centre of gravity or about ``centre``, without saying so; heights make no
    difference. A long wave lifts the body at its centre of flotation, which tells which of both. ``lift``
    (m, 6) are the wave forces of the lowest frequency; where they do not tell, it is the ``usual`` one.
    """
    away = np.array([centre[0] - gravity[0], centre[1] - gravity[1], 0.0])
    if np.abs(away).max() <= SAME_POINT or stiffness[2, 2] == 0.0:
        return stiffness
    transform = motion_transform(away)
    moved = np.asarray(transform.T @ stiffness @ transform)
    size = float(np.sum(np.abs(lift[:, 2]) ** 2))
    moments = np.sum(lift[:, [4, 3]] * np.conj(lift[:, 2:3]), axis=0).real * (-1.0, 1.0)
    seen = moments / size if size > 0.0 else np.zeros(2)
    flotation = [np.array([-one[2, 4], one[2, 3]]) / one[2, 2] for one in (moved, stiffness)]
    apart = [float(np.hypot(*(seen - point))) for point in flotation]
    told = size > 0.0 and abs(apart[0] - apart[1]) > NEAR * float(np.hypot(*away[:2]))
    return moved if (apart[0] < apart[1] if told else usual == "centre of gravity") else stiffness


FORMAT = Format(
    name="NEMOH",
    files="a NEMOH folder (RadiationCoefficients.tec, ExcitationForce.tec, KH.dat, Hydrostatics.dat)",
    looks="`VARIABLES=` and `Zone t=` of Tecplot, tables of numbers",
    can_open=lambda path: (
        path.name in (RADIATION, EXCITATION, CONTROL)
        or (path.is_dir() and sought(project_of(path), RADIATION) is not None)
    ),
    read=read_nemoh,
    takes=("mass_matrix",),
)
