"""Reader of NEMOH's results in Tecplot form, as NEMOH 2 writes them and Capytaine exports them.

The files are described in `seacrane.hydro.readers.nemoh_files`. The stiffness is about the centre of gravity,
and that of Capytaine's exports about the rotation centre.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.hydro.data.hydro_group_data import GroupBody
from seacrane.hydro.data.reading import reading
from seacrane.hydro.database.transform import motion_transform
from seacrane.hydro.readers.as_read import as_read, finished
from seacrane.hydro.readers.format import Format, Loaded
from seacrane.hydro.readers.nemoh_files import (
    CONTROL,
    EXCITATION,
    RADIATION,
    Water,
    found_file,
    needed,
    project_of,
    read_control,
    read_hydrostatics,
    read_solution,
    read_stiffness,
    sought,
)
from seacrane.hydro.readers.of_bodies import Given, floating_body, hull_or_group, of_each_or_none
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import AssumedDensityWarning

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
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
    mass_matrix : (6, 6) in SI about the rotation centre, of several bodies by name; by default the displaced
        mass at the centre of gravity with usual radii of gyration.
    restoring : (6, 6) in SI about the rotation centre, of several bodies by name, in the place of ``KH.dat``.
    motions : names of those that were solved for, where some were not: a motion without added mass and
        damping is refused unless it is left out here.
    leave_out : rad/s of frequencies to do without, such as those at which a solution failed (NaN).

    Returns
    -------
    HydroDatabase : of one body, about its rotation centre.
    HydroGroup : of several, named as their mesh files, in the order of ``Nemoh.cal``; its origin is that of
        the meshes. Lengths, breadths and draughts are those of the equivalent boxes.

    Warns
    -----
    AssumedDensityWarning : no ``Nemoh.cal``: density, gravity, depth and rotation centre are the arguments.
    AssumedInertiaWarning : no ``mass_matrix``.

    Raises
    ------
    FileFormatError : a file is missing, truncated or damaged, or the hydrostatics of a body are not its own;
        the message names it and the line or the body.
    """
    folder = project_of(Path(path))
    results = found_file(folder, RADIATION), found_file(folder, EXCITATION)
    control = sought(folder, CONTROL)
    if control is not None:
        water = read_control(control)
    else:
        centre = np.asarray(rotation_centre, dtype=float)
        water = Water(float(rho), float(g), float(depth), centre[None], (0.0, 0.0), ["body"])
        warn_caller(
            f"{folder}: has no {CONTROL}; {rho:g} kg/m3, {g:g} m/s2, depth {depth:g} m and rotations about "
            f"{tuple(centre.tolist())} m are taken",
            AssumedDensityWarning,
        )
    masses = of_each_or_none(folder, "mass_matrix", water.names, mass_matrix)
    restorings = of_each_or_none(folder, "restoring", water.names, restoring)
    hulls = [
        _Hull(name, at, *_hydrostatics(folder, water, i), mass, own)
        for i, (name, at, mass, own) in enumerate(
            zip(water.names, water.centres, masses, restorings, strict=True)
        )
    ]
    files = [*results, control, *(file for hull in hulls for file in (hull.stiffness, hull.hydrostatics))]
    told = folder / ", ".join(file.name for file in files if file is not None)
    with reading(told):
        made = _convert(folder, results, control, water, hulls, leave_out)
        found = as_read(told, "read_nemoh", made, motions)
    return finished(told, found, "restoring={name: (6, 6)} and mass_matrix")


@dataclass(frozen=True, eq=False)
class _Hull:
    """One body: the point that it turns about, its files, and what the caller gives."""

    name: str
    centre: FloatArray
    stiffness: Path | None
    hydrostatics: Path | None
    mass: FloatArray | None
    restoring: FloatArray | None


def _hydrostatics(folder: Path, water: Water, index: int) -> tuple[Path | None, Path | None]:
    """``KH.dat`` and ``Hydrostatics.dat`` of one body, or of one among several."""
    number = f"_{index}" if len(water.names) > 1 else ""
    return sought(folder, f"KH{number}.dat"), sought(folder, f"Hydrostatics{number}.dat")


def _convert(
    folder: Path,
    results: tuple[Path, Path],
    control: Path | None,
    water: Water,
    hulls: list[_Hull],
    leave_out: ArrayLike | None,
) -> Loaded:
    solved = read_solution(*results, control, water.names, leave_out)
    usual = "centre of gravity" if control is not None else "rotation centre"
    bodies = []
    for i, hull in enumerate(hulls):
        lift = solved.force[:, 0, 6 * i : 6 * i + 6]
        bodies.append(_body(folder, water, hull, lift, usual))
    x, y, z = water.centres[0]
    return hull_or_group(
        bodies,
        name=folder.resolve().name,
        omega=solved.omega,
        heading=solved.direction,
        added_mass=solved.added_mass,
        damping=solved.damping,
        force=solved.force,
        waves_from=water.phase_origin,
        rho=water.rho,
        g=water.g,
        depth=water.depth,
        origin=(
            f"rotation centre of the NEMOH body, ({x:g}, {y:g}, {z:g}) m from the origin of its mesh"
            if len(bodies) == 1
            else "origin of the meshes of NEMOH, on the still waterline"
        ),
        source=f"NEMOH results in folder {folder.resolve().name}",
    )


def _body(folder: Path, water: Water, hull: _Hull, lift: ComplexArray, usual: str) -> GroupBody:
    """One body; ``lift`` (m, 6) are its wave forces of the lowest frequency."""
    several = len(water.names) > 1
    number = f"_{water.names.index(hull.name)}" if several else ""
    told, restoring = folder, hull.restoring
    if restoring is None:
        told = needed(hull.stiffness, folder / f"KH{number}.dat")
        restoring = read_stiffness(told)
        if hull.hydrostatics is not None:
            gravity = read_hydrostatics(hull.hydrostatics)[0]
            restoring = _stiffness_about(hull.centre, restoring, gravity=gravity, lift=lift, usual=usual)
    if hull.mass is not None and several:  # hydrostatics of several may be those of all together
        gravity, volume = hull.centre, float(hull.mass[0, 0]) / water.rho
    else:
        gravity, volume = read_hydrostatics(needed(hull.hydrostatics, folder / f"Hydrostatics{number}.dat"))
    whose = f" of {hull.name}" if several else ""
    return floating_body(
        told,
        hull.name,
        several=several,
        position=hull.centre,
        restoring=restoring,
        volume=volume,
        water=(water.rho, water.g),
        mass=hull.mass,
        centre=gravity - hull.centre,
        lacks=f"NEMOH's results hold no mass matrix{whose}, pass mass_matrix to read_nemoh",
    )


def _stiffness_about(
    centre: FloatArray, stiffness: FloatArray, *, gravity: FloatArray, lift: ComplexArray, usual: str
) -> FloatArray:
    """A floating body's stiffness (6, 6) about ``centre``.

    The file gives it about its centre of gravity or about ``centre``, without saying so; heights make no
    difference. A long wave lifts the body at its centre of flotation, which tells which of both.

    Parameters
    ----------
    centre, gravity : (3,) m, in one frame.
    lift : (m, 6) wave forces of the lowest frequency, about ``centre``.
    usual : "centre of gravity" or "rotation centre", what is taken where the waves do not tell.
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


def _can_open(path: Path) -> bool:
    return path.name in (RADIATION, EXCITATION, CONTROL) or (
        path.is_dir() and sought(project_of(path), RADIATION) is not None
    )


FORMAT = Format(
    name="NEMOH",
    files="a NEMOH folder (RadiationCoefficients.tec, ExcitationForce.tec, KH.dat, Hydrostatics.dat)",
    can_open=_can_open,
    read=read_nemoh,
)
