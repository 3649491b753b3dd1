"""`load_database`: any file that a reader can open."""

from __future__ import annotations

from dataclasses import replace
from os import PathLike
from pathlib import Path

import numpy as np

from seacrane.errors import FileFormatError
from seacrane.hydro.data.data_warnings import warn_of_data
from seacrane.hydro.data.long_waves import warn_of_long_waves
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.group.group import HydroGroup
from seacrane.hydro.group.parts import afloat
from seacrane.hydro.readers import aqwa, bemio, capytaine, nemoh, orcaflex, veres, wamit
from seacrane.hydro.readers.as_read import Given
from seacrane.hydro.readers.format import Format, Loaded
from seacrane.inputs.caller import silently
from seacrane.inputs.keywords import named
from seacrane.warnings import RoughDataWarning


def _read_ours(path: Path, *, mass_matrix: Given | None = None) -> HydroDatabase:
    """A file of seacrane; a mass is given where it was written without one."""
    database = HydroDatabase.load(path)
    if mass_matrix is None:
        return database
    if database.mass_matrix is not None:
        raise FileFormatError(f"{path}: holds its mass; leave mass_matrix out")
    return replace(database, mass_matrix=np.asarray(mass_matrix, dtype=float))


OURS = Format(  # any NetCDF file but Capytaine's: one of no known kind is refused by what it lacks of ours
    name="seacrane",
    files="a NetCDF file (.nc) of seacrane",
    looks="attribute `format` of seacrane; what `HydroDatabase.save` writes",
    can_open=capytaine.is_netcdf,
    read=_read_ours,
    takes=("mass_matrix",),
    speeds=lambda path: (HydroDatabase.load(path).speed,),
)
FORMATS = (capytaine.FORMAT, OURS, *(kind.FORMAT for kind in (veres, wamit, orcaflex, aqwa, bemio, nemoh)))
NAMED = 5  # files in a message
SAME_DEPTH = 1e-6
SAME_SPEED = 1e-9  # m/s


@named
def load_database(
    path: str | PathLike[str],
    *,
    speed: float | None = None,
    depth: float | None = None,
    trusted_band: tuple[float, float] | None = None,
    mass_matrix: Given | None = None,
) -> HydroDatabase | HydroGroup:
    """Read a hydrodynamic database of any supported kind: of several hulls in one water, a `HydroGroup`.

    NetCDF of seacrane or Capytaine (told apart by content), ShipX/VERES or WAMIT (folder, stem or any file of
    the set), OrcaFlex (a text model, or MaFreDo's form), Aqwa (.AH1 or .LIS), BEMIO's HDF5 (of WEC-Sim),
    NEMOH (a folder). ``source`` tells as what it was read, and what of it was left out. Hulls of a group are
    moved to reference points on the still water, as scenes need them (`HydroGroup.at`).

    Parameters
    ----------
    path : file, folder or stem.
    speed : forward speed in m/s, for VERES files that hold several (`available_speeds`); by default the one
        nearest to zero.
    depth : m (inf: deep), for Capytaine's files that hold several; any other file has to be of it.
    trusted_band : (low, high) in rad/s, in place of what the files say. Files that do not tell their panels
        are trusted as far as their matrices are smooth (`HydroDatabase.trusted_band`; None: to the end).
    mass_matrix : (6, 6) in SI about the file's own reference point, in place of the file's; of several hulls
        by name.

    Raises
    ------
    FileFormatError : nothing readable at ``path``, or not of that speed or depth; the message names the file,
        the line where there is one, and the supported kinds.
    ValueError : a ``trusted_band`` that is none, or that holds none of the frequencies.

    Warns
    -----
    RoughDataWarning : matrices that jump, in files that do not tell their panels.
    DampingWarning, HeadingGapWarning, WaterMismatchWarning : what was read will give wrong motions; of a
        group, those of a hull.
    """
    found, source = _format_of(Path(path))
    if trusted_band is None:
        database = _read(found, source, speed, depth, mass_matrix)
    else:
        with silently(RoughDataWarning):
            database = _trusted(_read(found, source, speed, depth, mass_matrix), trusted_band)
    if isinstance(database, HydroGroup):
        database = afloat(database)
    for hull in database.hulls.values() if isinstance(database, HydroGroup) else [database]:
        warn_of_data(hull)
        warn_of_long_waves(hull)
    return database


def load_hull(
    path: str | PathLike[str],
    *,
    speed: float | None = None,
    depth: float | None = None,
    trusted_band: tuple[float, float] | None = None,
    mass_matrix: Given | None = None,
) -> HydroDatabase:
    """`load_database` of one hull.

    Raises
    ------
    FileFormatError : as `load_database`, and of several hulls.
    """
    found = load_database(path, speed=speed, depth=depth, trusted_band=trusted_band, mass_matrix=mass_matrix)
    if isinstance(found, HydroGroup):
        raise FileFormatError(
            f"{path}: holds bodies {', '.join(found.names)[:200]}, and one hull is needed; take "
            f"load_database(path)[{found.names[0]!r}], or all by Scene.add_vessel"
        )
    return found


def _read(
    found: Format, path: Path, speed: float | None, depth: float | None, mass_matrix: Given | None
) -> Loaded:
    """What is of a speed and a depth, where they are asked for, with a mass matrix in place of the file's."""
    asked = {"speed": speed, "depth": depth, "mass_matrix": mass_matrix}
    if mass_matrix is not None and "mass_matrix" not in found.takes:
        raise FileFormatError(f"{path}: files of {found.name} hold their mass; leave mass_matrix out")
    database = found.read(path, **{name: asked[name] for name in found.takes if asked[name] is not None})
    if speed is not None and "speed" not in found.takes and abs(database.speed - speed) > SAME_SPEED:
        raise FileFormatError(f"{path}: of {database.speed:g} m/s, not of speed {speed:g} m/s")
    if depth is not None and not np.isclose(database.depth, depth, rtol=SAME_DEPTH, atol=0.0):
        raise FileFormatError(
            f"{path}: is of a depth of {database.depth:g} m, not of {depth:g} m; leave depth out, or compute "
            "a database of that depth"
        )
    return database


def _trusted(database: Loaded, band: tuple[float, float]) -> Loaded:
    """With the band asked for; a memory fitted over another one is dropped."""
    low, high = (float(value) for value in band)
    if not np.any((database.omega >= low) & (database.omega <= high)):
        raise ValueError(
            f"database {database.name!r}: the band {low:.4g} to {high:.4g} rad/s holds no frequency; give a "
            f"trusted_band within {database.omega[0]:.4g} to {database.omega[-1]:.4g} rad/s"
        )
    return replace(database, trusted_band=(low, high), memory=None)


def available_speeds(path: str | PathLike[str]) -> tuple[float, ...]:
    """Forward speeds in m/s, rising, that `load_database` can read at ``path``.

    Raises
    ------
    FileFormatError : as `load_database`.
    """
    found, source = _format_of(Path(path))
    return found.speeds(source)


def _format_of(path: Path) -> tuple[Format, Path]:
    """The first format that can open a path, and what it shall open: of a folder perhaps its one file."""
    kinds = [one for one in FORMATS if one.can_open(path)]
    names = list(dict.fromkeys(one.name for one in kinds))
    if path.is_dir() and len(names) > 1:
        raise FileFormatError(f"{path}: the folder holds {' and '.join(names)} files; name one of them")
    if kinds:
        return kinds[0], path
    inside = sorted(path.iterdir()) if path.is_dir() else []
    files = [file for file in inside if any(one.can_open(file) for one in FORMATS)]
    if len(files) == 1:
        return _format_of(files[0])
    if files:
        listed = ", ".join(file.name for file in files[:NAMED])
        raise FileFormatError(f"{path}: the folder holds several files ({listed}), name one of them")
    problem = "the folder holds nothing of a known kind" if path.is_dir() else "not of a known kind"
    raise FileFormatError(
        f"{path}: {problem if path.exists() else 'no such file'}; supported: "
        + ", ".join(one.files for one in FORMATS)
        + "; `seacrane hydro` without a path lists by what they are known"
    )
