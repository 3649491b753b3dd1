"""`write_database`: what any reader has read, for seacrane or for programs that read WAMIT's files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import FileFormatError, SceneError
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import mass_of, mass_scales
from seacrane.hydro.database.check import CheckRow, at_most, info
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.database.netcdf import save_database
from seacrane.hydro.readers.wamit import read_wamit
from seacrane.hydro.readers.wamit_tables import INFINITE_FREQUENCY_PERIOD, ZERO_FREQUENCY_PERIOD
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.caller import silently
from seacrane.inputs.checked import flag_of
from seacrane.inputs.frames import MOTIONS
from seacrane.inputs.keywords import named
from seacrane.warnings import SourceWarning

OURS, WAMIT = (".nc",), (".1", ".3", ".hst", ".frc")
COMPARED = ("omega", "heading", "added_mass", "damping", "restoring", "mass_matrix", "linear_damping",
            "force", "infinite_frequency_added_mass", "zero_frequency_added_mass")  # fmt: skip
UNWRITTEN = ("quadratic_damping", "roll_damping", "additional", "motion_rao", "memory", "drift")  # in WAMIT's
DIGITS = 1e-6  # of seven, by the largest of a table
OPTIONS = "1 0 1 0 0 0 0 0 0"  # of .frc: which files there are


@named
def write_database(
    *, database: HydroData, path: str | PathLike[str], overwrite: bool = False
) -> list[CheckRow]:
    """Write a database, read it back, and compare.

    Parameters
    ----------
    database : of one hull at zero speed, about its reference point.
    path : ``.nc`` for everything, in NetCDF of seacrane; a name that ends in ``.1``, or in nothing, for
        WAMIT's ``.1``, ``.3``, ``.hst`` and ``.frc`` (mass and linear damping; none of a database without a
        mass) of that stem, length scale 1.
    overwrite : replace files of these names.

    Returns
    -------
    list of CheckRow : the largest difference of each table by its largest entry, which may be 1e-6 in WAMIT's
        seven digits and 0 in NetCDF; and ``left_out_...`` of what WAMIT's files do not hold.

    Raises
    ------
    SceneError : of several hulls or a moving one, a name of another kind, or files that are there.
    """
    target = Path(path)
    if not isinstance(database, HydroData):
        raise SceneError(f"{target}: a {type(database).__name__}; write each hull, as group[name], by itself")
    if not target.name or target.is_dir():
        raise SceneError(f"write_database: {target} is a folder; give the name of a file in it")
    flag_of("write_database: overwrite", overwrite)
    ours = target.suffix.lower() in OURS
    if not ours and target.suffix not in ("", *WAMIT):
        raise SceneError(
            f"{target}: {target.suffix} is not written; give a name in {OURS[0]} (NetCDF of seacrane) or in "
            f"{WAMIT[0]} (WAMIT's {' '.join(WAMIT)})"
        )
    stem = target if ours else target.with_suffix("")
    if stem.is_dir():  # read back, it would be what is in there
        raise SceneError(f"write_database: {stem} is a folder; give WAMIT's files another stem")
    files = [target] if ours else [stem.with_name(stem.name + suffix) for suffix in WAMIT]
    there = [] if overwrite else [file.name for file in files if file.exists()]
    if there:
        raise SceneError(f"{target}: {', '.join(there)} is there; give another name, or overwrite=True")
    if ours:
        save_database(database, target)
        return _compared(database, HydroDatabase.load(target), 0.0)
    if database.speed != 0.0:
        raise SceneError(f"{target}: the database is of {database.speed:g} m/s; WAMIT's files are of none")
    weighs = database.mass_matrix is not None
    if not weighs:
        files.pop().unlink(missing_ok=True)  # of a database with one, which would be read back
    for file, lines in zip(files, (_radiation, _waves, _stiffness, _control), strict=False):
        with atomic_write(file) as draft:
            draft.write_text("".join(line + "\n" for line in lines(database)))
    given = {"volume": mass_scales(database)[0] / database.rho, "rho": database.rho, "depth": database.depth}
    with silently(SourceWarning):  # of what was told when the database was read
        back = read_wamit(stem, g=database.g, motions=_solved(database), **given)
    if not isinstance(back, HydroDatabase):
        raise FileFormatError(f"{stem}: was read back as several hulls; use another name")
    lacking = UNWRITTEN if weighs else (*UNWRITTEN, "linear_damping")
    unwritten = [name for name in lacking if np.any(_told(getattr(database, name)))]
    left_out = [info(f"left_out_{name}", 1.0) for name in unwritten]
    return _compared(database, back, DIGITS, unwritten) + left_out


def _solved(database: HydroData) -> list[str]:
    """Motions that have loads and matrices: strip theory has none in surge."""
    matrices = np.any(database.added_mass, axis=(0, 1)) | np.any(database.damping, axis=(0, 1))
    there = matrices & np.any(database.force, axis=(0, 1))
    return [name for name, kept in zip(MOTIONS, there, strict=True) if kept]


def _told(value: Any) -> Any:
    """Whether anything is there, of arrays, tuples and objects that may be None."""
    return value if isinstance(value, np.ndarray) else bool(value is not None and value != ())


def _compared(
    database: HydroData, back: HydroData, limit: float, unwritten: Sequence[str] = ()
) -> list[CheckRow]:
    rows = []
    for name in COMPARED:
        wanted, found = getattr(database, name), getattr(back, name)
        if wanted is not None and name not in unwritten:
            same = found is not None and np.shape(found) == np.shape(wanted)
            size = max(float(np.abs(wanted).max()), np.finfo(float).tiny)
            off = float(np.abs(found - wanted).max()) / size if same else np.inf
            rows.append(at_most(f"written_{name}", off, limit))
    return rows


def _numbers(*values: Any) -> str:
    return "".join(f"{value:15.6E}" for value in values)


def _radiation(database: HydroData) -> Iterator[str]:
    """Period, i, j, A, B; the limits have no damping."""
    limits = {ZERO_FREQUENCY_PERIOD: database.zero_frequency_added_mass,
              INFINITE_FREQUENCY_PERIOD: database.infinite_frequency_added_mass}  # fmt: skip
    for period, table in limits.items():
        if table is not None:
            for i, j in np.ndindex(6, 6):
                yield f"{_numbers(period)}{i + 1:6d}{j + 1:6d}{_numbers(table[i, j] / database.rho)}"
    for omega, a, b in zip(database.omega, database.added_mass, database.damping, strict=True):
        for i, j in np.ndindex(6, 6):
            both = _numbers(a[i, j] / database.rho, b[i, j] / (database.rho * omega))
            yield f"{_numbers(2.0 * np.pi / omega)}{i + 1:6d}{j + 1:6d}{both}"


def _waves(database: HydroData) -> Iterator[str]:
    """Period, heading, i, modulus, phase, real and imaginary part."""
    for n, omega in enumerate(database.omega):
        for heading, loads in zip(np.degrees(database.heading), database.force[:, n], strict=True):
            for i, load in enumerate(loads / (database.rho * database.g)):
                numbers = _numbers(abs(load), np.degrees(np.angle(load)), load.real, load.imag)
                yield f"{_numbers(2.0 * np.pi / omega, heading)}{i + 1:6d}{numbers}"


def _stiffness(database: HydroData) -> Iterator[str]:
    for i, j in np.ndindex(6, 6):
        yield f"{i + 1:6d}{j + 1:6d}{_numbers(database.restoring[i, j] / (database.rho * database.g))}"


def _control(database: HydroData) -> Iterator[str]:
    """Form 2: density, centre of gravity, and external mass, damping and stiffness as they are."""
    mass = mass_of(database)
    x, y, z = mass[1, 5] / mass[0, 0], mass[2, 3] / mass[0, 0], mass[0, 4] / mass[0, 0]
    yield f"{' '.join(database.name.split())[:60]}: written by seacrane"
    yield OPTIONS
    yield f"{database.rho:.9g}"
    yield _numbers(x, y, z)
    for matrix in (mass, database.linear_damping):
        yield "1"
        yield from _matrix(matrix)
    yield "0"
    yield "0"


def _matrix(matrix: Array) -> Iterable[str]:
    return ("".join(f"{value:18.9E}" for value in row) for row in matrix)
