"""Reader of Ansys Aqwa: its database in ASCII (``.AH1``, options AHD1 and LHFR), and its listing (``.LIS``).

Axes and wave directions are ours. Matrices, stiffness and loads are about each structure's centre of gravity
and in SI; a positive phase comes after the crest has passed that centre (Aqwa Reference Manual, "Phase
Angle"), so that loads are |F| exp(-i phase) in our exp(+i omega t), with zero phase at the centre's x and y.
"""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from seacrane.errors import FileFormatError
from seacrane.hydro.data.frozen import reading
from seacrane.hydro.data.heading_circle import phase_at
from seacrane.hydro.readers.aqwa_files import Run, read_database, read_listing
from seacrane.hydro.readers.as_read import Asked, Given, left_out, rising_degrees
from seacrane.hydro.readers.format import Format, Loaded, sibling, stem_of
from seacrane.hydro.readers.of_bodies import floating_body, hull_or_group, of_each

DATABASE, LISTING = ".ah1", ".lis"
MOTION_LIMIT = np.full(6, 0.02)  # loads of three digits


def read_aqwa(
    path: str | PathLike[str],
    *,
    mass_matrix: Given | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> Loaded:
    """Read Aqwa's database in ASCII (``.AH1``), or the listing (``.LIS``) of one structure.

    Parameters
    ----------
    path : the file; or folder or stem, of which ``.AH1`` is read where both are there.
    mass_matrix : (6, 6) in SI about the centre of gravity, in place of the file's; of several by name.
    motions, leave_out : as `read_capytaine` takes them.

    Returns
    -------
    HydroDatabase : of one structure, about the point of the still waterline above its centre of gravity; of
        a listing with the motions that it holds as ``motion_rao``.
    HydroGroup : of several, "structure1" on, each about its centre of gravity.

    Warns
    -----
    RoundedPhaseWarning : the loads are those of a listing, in three digits.

    Raises
    ------
    FileFormatError : the file is missing, truncated or damaged, a listing of several structures, or its mass
        is a placeholder; the message names the file and the line.
    """
    file = _file_of(Path(path))
    asked = Asked(
        where=file, reader="read_aqwa", mass_matrix=mass_matrix, motions=motions, leave_out=leave_out
    )
    with reading(file):
        run = read_listing(file) if file.suffix.lower() == LISTING else read_database(file)
        return _convert(asked, run)


def is_aqwa(path: Path) -> bool:
    """Whether a path is such a file, or a folder or stem of one."""
    if path.is_dir():
        return any(file.suffix.lower() in (DATABASE, LISTING) for file in path.iterdir())
    return path.suffix.lower() in (DATABASE, LISTING) or sibling(path, DATABASE) is not None


def _file_of(path: Path) -> Path:
    if path.is_file():
        return path
    stem = stem_of(path, "Aqwa", (DATABASE, LISTING), (DATABASE, LISTING))
    found = sibling(stem, DATABASE) or sibling(stem, LISTING)
    if found is None:
        raise FileFormatError(f"{path}: no such file; give Aqwa's .AH1, or its .LIS of one structure")
    return found


def _convert(asked: Asked, run: Run) -> Loaded:
    depth, rho, g = run.water
    several = len(run.centres) > 1
    for what, values in (
        ("frequency", run.omega),
        ("displacement", run.volumes),
        ("depth", np.array([depth])),
    ):
        if not np.all(values > 0.0):
            raise FileFormatError(f"{asked.where}: a {what} of {values.min():g}; give a positive one")
    names = [f"structure{i}" for i in range(1, len(run.centres) + 1)]
    masses = of_each(asked, "mass_matrix", names, asked.mass_matrix)
    bodies = [
        floating_body(
            asked, name, several=several, water=(rho, g), restoring=run.stiffness[i],
            mass=run.masses[i] if masses[i] is None else masses[i], displaced=float(run.volumes[i]),
            position=run.centres[i], draught=None if run.draughts is None else float(run.draughts[i]),
            linear_damping=None if run.other_damping is None else np.diag(run.other_damping[i]),
        )
        for i, name in enumerate(names)
    ]  # fmt: skip
    degrees, order = rising_degrees(run.heading_deg)
    heading, force = np.radians(degrees), run.force[order]
    if several:  # all about the one origin
        ahead = [phase_at(-centre, run.omega, heading, g, depth) for centre in run.centres]
        force = force * np.repeat(np.concatenate(ahead, axis=2), 6, axis=2)
    x, y, z = run.centres[0]
    return hull_or_group(
        asked, bodies, fix="a file that was written anew", at=(0.0, 0.0, -z),
        waves_from=(0.0, 0.0) if several else (x, y),
        alone={
            "origin": f"on the still waterline, above the centre of gravity at ({x:g}, {y:g}, {z:g}) m",
            "motion_rao": None if run.motion is None else run.motion[order],
            "motion_rao_limit": MOTION_LIMIT,
        },
        name=asked.where.stem, source=f"Aqwa file {asked.where.name}" + left_out(run.left_out),
        origin="origin of Aqwa's fixed reference axes, on the still waterline",
        rho=rho, g=g, depth=depth, omega=run.omega, heading=heading, force=force,
        added_mass=run.added_mass, damping=run.damping, **run.limits,
    )  # fmt: skip


FORMAT = Format(
    name="AQWA",
    files="Aqwa's database in ASCII (.AH1), or its listing (.LIS) of one structure",
    looks="`.AH1`: comments with `*`, then `GENERAL`, `COG`, `MASS`; `.LIS`: titles as `* * * * H Y D R O`",
    can_open=is_aqwa,
    read=read_aqwa,
    takes=("mass_matrix",),
)
