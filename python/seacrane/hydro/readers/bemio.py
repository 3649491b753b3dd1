"""Reader of BEMIO's HDF5 files, into which WEC-Sim turns results of NEMOH, AQWA, WAMIT and Capytaine.

Its axes and its time factor exp(+i omega t) are ours; headings are degrees of travel. Values are without
density and gravity (WEC-Sim documentation, "BEMIO"): A / rho, B / (rho omega), C / (rho g), F / (rho g).
They refer to the centre of gravity, waves have zero phase at the origin. The vessel is moved to the still
waterline above its centre of gravity.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.heading_circle import keeps_sides_apart
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.readers.as_read import as_read, frequencies_kept
from seacrane.hydro.readers.band_of_data import with_band_of_data
from seacrane.hydro.readers.equivalent_box import equivalent_box
from seacrane.hydro.readers.format import Format, is_file_of, of_one_speed, zero_speed
from seacrane.hydro.readers.usual_inertia import usual_mass_matrix
from seacrane.hydro.readers.wave_directions import phase_at, rising_directions
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_hdf5

FloatArray = NDArray[np.float64]
Read = TypeVar("Read")

HDF5 = (".h5", ".hdf5")
PARAMETERS = "simulation_parameters"
DEEP = (b"infinite", b"inf", b"infinity")


def read_bemio(
    path: str | PathLike[str],
    *,
    mass_matrix: ArrayLike | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> HydroDatabase:
    """Read a BEMIO file (HDF5) of one body with six motions.

    Parameters
    ----------
    path : file.
    mass_matrix : (6, 6) in SI about the centre of gravity. The file holds none; by default the displaced
        mass with usual radii of gyration.
    motions : names of those that were solved for, where some were not: a motion without added mass and
        damping is refused unless it is left out here.
    leave_out : rad/s of frequencies to do without, such as those at which a solution failed.

    Returns
    -------
    HydroDatabase : about the point of the still waterline above the centre of gravity. Length, breadth and
        draught are those of the equivalent box; port-starboard symmetric if the added mass is, to 2 %.

    Warns
    -----
    AssumedInertiaWarning : no ``mass_matrix``.

    Raises
    ------
    FileFormatError : the file is missing, damaged, of several bodies, or no BEMIO file; the message names
        the entry.
    """
    source = Path(path)
    found = from_bemio(source, lambda file: _convert(source, file, mass_matrix, motions, leave_out))
    return with_band_of_data(found)


def from_bemio(path: Path, convert: Callable[[Any], Read]) -> Read:
    """What ``convert`` makes of the file; any damage is a FileFormatError."""
    if not path.is_file():
        raise FileFormatError(f"{path}: no such file; give the path of a BEMIO file")
    try:
        with open_hdf5(path) as file:
            return convert(file)
    except FileFormatError:
        raise
    except NETCDF_ERRORS as error:
        raise FileFormatError(
            f"{path}: cannot be read as a BEMIO file ({str(error)[:200]}); write it again"
        ) from error


def bodies_in(file: Any) -> list[str]:
    """``body1`` on, as far as there are."""
    return sorted(
        (name for name in file if re.fullmatch(r"body\d{1,3}", name)), key=lambda name: int(name[4:])
    )


def is_bemio(path: Path) -> bool:
    """Whether an HDF5 file holds results by BEMIO's names."""
    try:
        with open_hdf5(path) as file:
            return PARAMETERS in file and "body1" in file
    except FileFormatError:
        raise
    except NETCDF_ERRORS:
        return False


def _convert(
    path: Path,
    file: Any,
    mass_matrix: ArrayLike | None,
    motions: Sequence[str] | None,
    leave_out: ArrayLike | None,
) -> HydroDatabase:
    bodies = bodies_in(file)
    if len(bodies) != 1:
        raise FileFormatError(
            f"{path}: holds {', '.join(bodies)[:200] or 'no body'}; one body is read, several by "
            "load_database "
            "and read_bemio_group"
        )
    body = bodies[0]
    rho, g, depth = water_in(path, file)
    omega = np.ravel(values_of(path, file, f"{PARAMETERS}/w"))
    rising = np.argsort(omega)
    direction, places = rising_directions(
        np.radians(np.ravel(values_of(path, file, f"{PARAMETERS}/wave_dir")))
    )
    n, m = len(omega), len(np.ravel(values_of(path, file, f"{PARAMETERS}/wave_dir")))
    of = f"{body}/hydro_coeffs"
    added_mass = rho * values_of(path, file, f"{of}/added_mass/all", (6, 6, n)).transpose(2, 0, 1)
    damping = rho * (values_of(path, file, f"{of}/radiation_damping/all", (6, 6, n)) * omega).transpose(
        2, 0, 1
    )
    infinite = rho * values_of(path, file, f"{of}/added_mass/inf_freq", (6, 6))
    restoring = rho * g * values_of(path, file, f"{of}/linear_restoring_stiffness", (6, 6))
    parts = (values_of(path, file, f"{of}/excitation/{part}", (6, m, n)) for part in ("re", "im"))
    real, imaginary = parts
    force = rho * g * (real + 1j * imaginary).transpose(1, 2, 0)[places]
    tables = {"added_mass": added_mass[rising], "damping": damping[rising], "force": force[:, rising]}
    order = rising[frequencies_kept(path, "read_bemio", omega[rising], tables, leave_out)]
    added_mass, force = added_mass[order], force[:, order]
    centre = np.ravel(values_of(path, file, f"{body}/properties/cg"))[:3]
    mass = rho * number_of(path, file, f"{body}/properties/disp_vol")
    box = equivalent_box(restoring, mass / rho, rho * g)
    if mass_matrix is None:
        mass_matrix = usual_mass_matrix(
            path, "a BEMIO file holds no mass matrix, pass mass_matrix to read_bemio",
            mass=mass, centre=np.zeros(3), length=box[0], breadth=box[1],
        )  # fmt: skip
    about_gravity = HydroDatabase(
        name=path.stem,
        omega=omega[order],
        heading=direction,
        added_mass=added_mass,
        damping=damping[order],
        infinite_frequency_added_mass=infinite,
        restoring=restoring,
        mass_matrix=np.asarray(mass_matrix, dtype=float),
        force=force * phase_at(centre, omega[order], direction, g, depth),
        rho=rho,
        g=g,
        depth=depth,
        length=box[0],
        breadth=box[1],
        draught=box[2],
        origin="",
        source=f"BEMIO file {path.name}, {body}",
        port_starboard_symmetric=bool(centre[1] == 0.0 and keeps_sides_apart(added_mass)),
    )
    whole = as_read(path, "read_bemio", about_gravity, motions)
    return replace(
        whole.at((0.0, 0.0, -centre[2])),
        origin=(
            f"on the still waterline, above the centre of gravity, which BEMIO has at ({centre[0]:g}, "
            f"{centre[1]:g}, {centre[2]:g}) m"
        ),
    )


def water_in(path: Path, file: Any) -> tuple[float, float, float]:
    """Density, gravity and depth of an unscaled file."""
    if f"{PARAMETERS}/scaled" in file and number_of(path, file, f"{PARAMETERS}/scaled") != 0.0:
        raise FileFormatError(f"{path}: scaled is set, values have density and gravity in; write it unscaled")
    rho, g, depth = (number_of(path, file, f"{PARAMETERS}/{name}") for name in ("rho", "g", "water_depth"))
    if not (rho > 0.0 and g > 0.0 and depth > 0.0):
        raise FileFormatError(
            f"{path}: rho is {rho:g} kg/m3, g {g:g} m/s2, water_depth {depth:g} m; all must be positive"
        )
    return rho, g, depth


def values_of(path: Path, file: Any, name: str, shape: tuple[int, ...] | None = None) -> FloatArray:
    """An entry's numbers; of a shape."""
    if name not in file:
        raise FileFormatError(f"{path}: {name} is missing; write the whole BEMIO file")
    values = np.asarray(file[name][()], dtype=float)
    if shape is not None and values.shape != shape:
        raise FileFormatError(
            f"{path}: {name} has shape {values.shape}; {shape} is needed, of six motions for each body"
        )
    return values


def number_of(path: Path, file: Any, name: str) -> float:
    values = np.ravel(_infinite(path, file, name))
    if values.size != 1:
        raise FileFormatError(f"{path}: {name} has {values.size} values; one is needed")
    return float(values[0])


def _infinite(path: Path, file: Any, name: str) -> FloatArray:
    """Numbers, or the word with which BEMIO says that water is deep."""
    if name in file and isinstance(file[name][()], bytes):
        if file[name][()].strip().lower() in DEEP:
            return np.array(np.inf)
        raise FileFormatError(f"{path}: {name} is {file[name][()][:40]!r}; a number is needed")
    return values_of(path, file, name)


def _can_open(path: Path) -> bool:
    return is_file_of(path, HDF5) and is_bemio(path)


FORMAT = Format(
    name="BEMIO",
    files="an HDF5 file (.h5) of BEMIO",
    can_open=_can_open,
    read=of_one_speed(read_bemio),
    speeds=zero_speed,
)
