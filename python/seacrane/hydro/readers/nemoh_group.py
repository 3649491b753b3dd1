"""Reader of NEMOH's results of several bodies; files, axes and phases as in `read_nemoh`.

Hydrostatics are a file for each body, ``KH_0.dat`` and ``Hydrostatics_0.dat`` on, in the order of
``Nemoh.cal``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path, PureWindowsPath

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.group_body import GroupBody
from seacrane.hydro.group.group import HydroGroup
from seacrane.hydro.readers.as_read import as_read
from seacrane.hydro.readers.band_of_data import with_band_of_group
from seacrane.hydro.readers.format import Format, of_one_speed, zero_speed
from seacrane.hydro.readers.nemoh import (
    CONTROL,
    EXCITATION,
    INNER,
    RADIATION,
    Solution,
    Water,
    blocks,
    can_open_nemoh,
    found_file,
    project_of,
    read_control,
    read_hydrostatics,
    read_stiffness,
    solution,
    sought,
)
from seacrane.hydro.readers.of_bodies import box_of, group_symmetric, of_each, require_own_hydrostatics
from seacrane.hydro.readers.stiffness_point import stiffness_about
from seacrane.hydro.readers.usual_inertia import usual_mass_matrix
from seacrane.hydro.readers.wave_directions import phase_at

FloatArray = NDArray[np.float64]
Given = Mapping[str, ArrayLike]


def read_nemoh_group(
    path: str | PathLike[str],
    *,
    mass_matrices: Given | None = None,
    restorings: Given | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> HydroGroup:
    """Read a folder of NEMOH's results of several bodies.

    Parameters
    ----------
    path : the folder, or a file in it, with ``Nemoh.cal``, which tells the water, the bodies and the points
        that they turn about.
    mass_matrices : by body, (6, 6) in SI about that point; by default the displaced masses at the centres of
        gravity with usual radii of gyration.
    restorings : by body, (6, 6) in SI, in the place of ``KH_0.dat`` on.
    motions : names of those that were solved for, where some were not: a motion without added mass and
        damping is refused unless it is left out here.
    leave_out : rad/s of frequencies to do without, such as those at which a solution failed (NaN).

    Returns
    -------
    HydroGroup : its origin is that of the meshes. Bodies are named as their mesh files, in the order of
        ``Nemoh.cal``. Lengths, breadths and draughts are those of the equivalent boxes.

    Warns
    -----
    AssumedInertiaWarning : no ``mass_matrices``.

    Raises
    ------
    FileFormatError : a file is missing, truncated or damaged, or the hydrostatics of a body are not its own;
        the message names the file and the body.
    """
    folder = project_of(Path(path))
    files = {name: found_file(folder, name) for name in (RADIATION, EXCITATION, CONTROL)}
    water, meshes = read_control(files[CONTROL])
    names = _names(len(water.centres), meshes)
    stiffness, hydrostatics = (_of_bodies(folder, kind, names) for kind in ("KH", "Hydrostatics"))
    read = [file for file in (*files.values(), *stiffness, *hydrostatics) if file is not None]
    told = folder / ", ".join(file.name for file in read)
    given = _Given(
        None if mass_matrices is None else of_each(folder, "mass_matrices", names, mass_matrices, (6, 6)),
        None if restorings is None else of_each(folder, "restorings", names, restorings, (6, 6)),
    )
    try:
        radiation, waves = (blocks(files[name], bodies=len(names)) for name in (RADIATION, EXCITATION))
        if len(radiation) != 6 * len(names):
            raise FileFormatError(
                f"{files[RADIATION]}: {len(radiation)} degrees of freedom; six of each of "
                f"{', '.join(names)} are "
                "needed"
            )
        whole = solution(files[RADIATION], files[EXCITATION], radiation, waves, files[CONTROL])
        solved = whole.kept(files[RADIATION], files[EXCITATION], "read_nemoh_group", leave_out)
        bodies = [
            _body(folder, water, (i, name), given, (stiffness[i], hydrostatics[i]), solved)
            for i, name in enumerate(names)
        ]
        found = as_read(told, "read_nemoh_group", _group(folder, water, bodies, solved), motions)
    except FileFormatError:
        raise
    except ValueError as error:
        raise FileFormatError(f"{told}: {error}") from error
    require_own_hydrostatics(told, found, "restorings={name: (6, 6)} and mass_matrices")
    return with_band_of_group(found)


@dataclass(frozen=True, eq=False)
class _Given:
    """What the caller says, in the order of the bodies; None: nothing."""

    masses: list[FloatArray] | None
    restorings: list[FloatArray] | None


def _names(count: int, meshes: list[str]) -> list[str]:
    """Names of the mesh files, each once; numbers where that is not so."""
    stems = [PureWindowsPath(mesh).stem for mesh in meshes]
    alone = len(stems) == count and len(set(stems)) == count
    return stems if alone else [f"body{i}" for i in range(1, count + 1)]


def _group(folder: Path, water: Water, bodies: list[GroupBody], solved: Solution) -> HydroGroup:
    origin = np.array([-water.phase_origin[0], -water.phase_origin[1]])
    at_mesh = phase_at(origin, solved.omega, solved.direction, water.g, water.depth)
    return HydroGroup(
        name=folder.resolve().name,
        bodies=tuple(bodies),
        omega=solved.omega,
        heading=solved.direction,
        added_mass=solved.added_mass,
        damping=solved.damping,
        force=solved.force * at_mesh,
        rho=water.rho,
        g=water.g,
        depth=water.depth,
        port_starboard_symmetric=group_symmetric(bodies, solved.added_mass),
        origin="origin of the meshes of NEMOH, on the still waterline",
        source=f"NEMOH results in folder {folder.resolve().name}",
    )


def _body(
    folder: Path,
    water: Water,
    which: tuple[int, str],
    given: _Given,
    files: tuple[Path | None, Path | None],
    solved: Solution,
) -> GroupBody:
    index, name = which
    stiffness, hydrostatics = files
    if given.restorings is not None:
        restoring, told = given.restorings[index], folder
    else:
        told = _needed(folder, stiffness, f"KH_{index}.dat", name)
        restoring = read_stiffness(told)
        if hydrostatics is not None:
            restoring = stiffness_about(
                water.centres[index],
                restoring,
                gravity=read_hydrostatics(hydrostatics)[0],
                lift=solved.force[:, 0, 6 * index : 6 * index + 6],
                usual="centre of gravity",
            )
    if given.masses is not None:
        mass = given.masses[index]
        box = box_of(told, name, restoring, float(mass[0, 0]) / water.rho, water.rho * water.g)
    else:
        file = _needed(folder, hydrostatics, f"Hydrostatics_{index}.dat", name)
        gravity, volume = read_hydrostatics(file)
        box = box_of(told, name, restoring, volume, water.rho * water.g)
        mass = usual_mass_matrix(
            folder,
            f"NEMOH's results hold no mass matrix of {name}, give read_nemoh_group(mass_matrices=...)",
            mass=water.rho * volume,
            centre=gravity - water.centres[index],
            length=box["length"],
            breadth=box["breadth"],
        )
    return GroupBody(
        name=name,
        position=water.centres[index],
        mass_matrix=mass,
        restoring=restoring,
        **box,
    )


def _needed(folder: Path, file: Path | None, name: str, body: str) -> Path:
    if file is None:
        raise FileFormatError(
            f"{folder / name}: no such file, nor in results or mesh; it tells {body}'s hydrostatics"
        )
    return file


def _of_bodies(folder: Path, kind: str, names: list[str]) -> list[Path | None]:
    """A file of each body, ``kind_0.dat`` on, in either case, in the folder or its inner ones."""
    places = [place for place in (folder, *(folder / inner for inner in INNER)) if place.is_dir()]
    files = {file.name.lower(): file for place in places[::-1] for file in sorted(place.iterdir())}
    return [files.get(f"{kind}_{i}.dat".lower()) for i in range(len(names))]


def _can_open(path: Path) -> bool:
    if not can_open_nemoh(path):
        return False
    control = sought(project_of(path), CONTROL)
    try:
        return control is not None and len(read_control(control)[0].centres) > 1
    except FileFormatError:
        return False


FORMAT = Format(
    name="NEMOH",
    files="a NEMOH folder (RadiationCoefficients.tec, ExcitationForce.tec, KH.dat, Hydrostatics.dat)",
    can_open=_can_open,
    read=of_one_speed(read_nemoh_group),
    speeds=zero_speed,
)
