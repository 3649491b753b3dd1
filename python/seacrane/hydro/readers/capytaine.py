"""Reader of Capytaine's NetCDF datasets, by the names of variables, dimensions and degrees of freedom.

Capytaine's axes and wave directions (rad, direction of travel) are ours when x of the mesh points forward;
its time factor is exp(-i omega t), so complex values are conjugated. Matrices refer to the rotation centre of
the degrees of freedom, phases to the origin of the mesh; forces are shifted to zero phase at the former.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.heading_circle import keeps_sides_apart
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.readers.as_read import as_read, frequencies_kept, mass_of_file
from seacrane.hydro.readers.band_of_data import with_band_of_data
from seacrane.hydro.readers.equivalent_box import equivalent_box
from seacrane.hydro.readers.format import Format, is_file_of, of_one_speed, zero_speed
from seacrane.hydro.readers.wave_directions import phase_at, rising_directions
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_netcdf
from seacrane.inputs.shown import shown
from seacrane.warnings import AssumedReferenceWarning, MissingMotionsWarning

if TYPE_CHECKING:
    import xarray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
Read = TypeVar("Read")

MOTION_NAMES = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
NETCDF = (".nc", ".nc4")
SAME_DEPTH = 1e-9  # of it
NAMED = 8  # depths in a message
MATRIX = ("influenced_dof", "radiating_dof")


def _of_wavenumber(k: FloatArray, g: float, depth: float) -> FloatArray:
    """omega^2 = g k tanh(k h)."""
    return np.asarray(np.sqrt(g * k * (1.0 if np.isinf(depth) else np.tanh(k * depth))))


MEASURES: dict[str, Callable[[FloatArray, float, float], FloatArray]] = {
    "freq": lambda value, g, depth: 2.0 * np.pi * value,
    "period": lambda value, g, depth: 2.0 * np.pi / value,
    "wavenumber": _of_wavenumber,
    "wavelength": lambda value, g, depth: _of_wavenumber(2.0 * np.pi / value, g, depth),
}


def read_capytaine(
    path: str | PathLike[str],
    *,
    depth: float | None = None,
    mass_matrix: ArrayLike | None = None,
    restoring: ArrayLike | None = None,
    rotation_centre: ArrayLike | None = None,
    leave_out: ArrayLike | None = None,
) -> HydroDatabase:
    """Read a dataset that Capytaine wrote to NetCDF (complex values split into ``re`` and ``im``).

    Parameters
    ----------
    path : file with ``added_mass``, ``radiation_damping`` and either ``excitation_force`` or
        ``Froude_Krylov_force`` and ``diffraction_force``, for rigid motions of one body, heave among them,
        at zero speed and one water depth, over omega, freq, period, wavenumber or wavelength. Frequencies 0
        and infinity become the limits of the added mass.
    depth : m, which of the file's water depths; needed where it has several (inf: deep water).
    mass_matrix, restoring : (6, 6) in SI about the rotation centre; they take the place of
        ``inertia_matrix`` and ``hydrostatic_stiffness``, and are needed where the file lacks these, or has
        not all six motions.
    rotation_centre : (3,) m from the origin of the mesh, of files that do not tell it (before Capytaine 3).
    leave_out : rad/s of frequencies to do without, such as those at which a solution failed.

    Returns
    -------
    HydroDatabase : length, breadth and draught are those of the equivalent box; port-starboard symmetric if
        the matrices are, to 2 %.

    Warns
    -----
    MissingMotionsWarning : some of the six motions are not in the file.
    AssumedReferenceWarning : neither the file nor the caller tells the rotation centre.

    Raises
    ------
    FileFormatError : the file is missing, damaged or no Capytaine dataset; the message names the variable.
    """
    source = Path(path)
    given = _Given(mass_matrix, restoring, rotation_centre, leave_out)
    return with_band_of_data(
        from_dataset(source, lambda dataset: _convert(source, of_depth(source, dataset, depth), given))
    )


@dataclass(frozen=True, eq=False)
class _Given:
    """What the caller says."""

    mass: ArrayLike | None
    restoring: ArrayLike | None
    centre: ArrayLike | None
    leave_out: ArrayLike | None


def from_dataset(path: Path, convert: Callable[[xarray.Dataset], Read]) -> Read:
    """What ``convert`` makes of the file's dataset; any damage is a FileFormatError."""
    if not path.is_file():
        raise FileFormatError(f"{path}: no such file; give the path of a Capytaine NetCDF file")
    import xarray

    try:
        with open_netcdf(path), xarray.open_dataset(path) as opened:
            dataset = opened.load()
        return convert(dataset)
    except FileFormatError:
        raise
    except NETCDF_ERRORS as error:
        raise FileFormatError(
            f"{path}: cannot be read as a Capytaine dataset ({str(error)[:200]}); write it again"
        ) from error


def bodies_of(dataset: xarray.Dataset) -> list[str]:
    """Names of the bodies that ``influenced_dof`` names, in its order; "" where it names none."""
    if MATRIX[0] not in dataset.coords:
        return [""]
    labels = [str(label).rpartition("__")[0] for label in np.ravel(dataset[MATRIX[0]].values)]
    return list(dict.fromkeys(labels))


def of_depth(path: Path, dataset: xarray.Dataset, depth: float | None) -> xarray.Dataset:
    """The results in one water depth: the one there is, or the one asked for."""
    if "water_depth" not in dataset.coords:
        there = np.array([np.inf])
    else:
        there = np.ravel(np.asarray(dataset["water_depth"].values, dtype=float))
    listed = ", ".join(f"{value:g}" for value in there[:NAMED])
    if depth is None:
        if len(there) > 1:
            raise FileFormatError(
                f"{path}: holds water depths {listed} m; choose one by load_database(path, depth=...)"
            )
        return dataset
    found = np.flatnonzero(np.isclose(there, depth, rtol=SAME_DEPTH, atol=0.0))
    if found.size == 0:
        raise FileFormatError(f"{path}: holds water depths {listed} m, not {depth:g} m; choose one of them")
    return dataset.isel(water_depth=int(found[0])) if "water_depth" in dataset.dims else dataset


def is_capytaine(path: Path) -> bool:
    """Whether a NetCDF file holds radiation results by Capytaine's names."""
    try:
        with open_netcdf(path) as file:
            return "added_mass" in file.variables and "radiating_dof" in file.dimensions
    except FileFormatError:
        raise
    except NETCDF_ERRORS:
        return False


def _convert(path: Path, dataset: xarray.Dataset, given: _Given) -> HydroDatabase:
    rho, g, depth = water_of(path, dataset)
    dataset = over_omega(path, dataset, g, depth)
    complete = given.mass is not None and given.restoring is not None
    dataset, solved = _by_motion(path, dataset, given=complete)
    dataset = single(path, dataset)
    omega, rows = frequencies(path, dataset)
    added_mass = real_values(path, dataset, "added_mass", ("omega", *MATRIX))
    damping = real_values(path, dataset, "radiation_damping", ("omega", *MATRIX))
    mass = _matrix(path, dataset, "inertia_matrix", "mass_matrix", given.mass)
    stiffness = _matrix(path, dataset, "hydrostatic_stiffness", "restoring", given.restoring)
    direction, order = directions(path, dataset)
    force = wave_force(path, dataset)[order]
    tables = {"added_mass": added_mass[rows], "damping": damping[rows], "force": force[:, rows]}
    rows = rows[frequencies_kept(path, "read_capytaine", omega[rows], tables, given.leave_out)]
    force = force[:, rows]
    centre = _rotation_centre(path, dataset, given.centre)
    box = equivalent_box(stiffness, float(mass[0, 0]) / rho, rho * g)
    if given.mass is None:
        mass = mass_of_file(path, "read_capytaine(mass_matrix=...)", mass, box=box)
    version = str(dataset.attrs.get("capytaine_version", "of unknown version"))
    body = str(np.ravel(_name(dataset))[0])
    found = HydroDatabase(
        name=path.stem,
        omega=omega[rows],
        heading=direction,
        added_mass=added_mass[rows],
        damping=damping[rows],
        infinite_frequency_added_mass=limit_of(added_mass, np.isinf(omega)),
        zero_frequency_added_mass=limit_of(added_mass, omega == 0.0),
        restoring=stiffness,
        mass_matrix=mass,
        force=force * phase_at(centre, omega[rows], direction, g, depth),
        rho=rho,
        g=g,
        depth=depth,
        length=box[0],
        breadth=box[1],
        draught=box[2],
        origin=(
            f"rotation centre of the Capytaine body, ({centre[0]:g}, {centre[1]:g}, {centre[2]:g}) m from "
            "the origin of its mesh"
        ),
        source=f"Capytaine {version}, file {path.name}, body {body}",
        port_starboard_symmetric=bool(centre[1] == 0.0 and keeps_sides_apart(added_mass[rows])),
    )
    return as_read(path, "read_capytaine", found, solved)


def water_of(path: Path, dataset: xarray.Dataset) -> tuple[float, float, float]:
    """Density, gravity and depth of results of zero speed."""
    rho, g = _number(path, dataset, "rho"), _number(path, dataset, "g")
    if not (rho > 0.0 and g > 0.0):
        raise FileFormatError(f"{path}: rho is {rho:g} kg/m3 and g {g:g} m/s2; positive ones are needed")
    depth = _number(path, dataset, "water_depth", default=np.inf)
    speed = _number(path, dataset, "forward_speed", default=0.0)
    if speed != 0.0:
        raise FileFormatError(f"{path}: forward_speed is {speed:g} m/s; only results of zero speed are read")
    return rho, g, depth


def _number(path: Path, dataset: xarray.Dataset, name: str, default: float | None = None) -> float:
    """A scalar coordinate, or one of a single value."""
    if name not in dataset.variables:
        if default is not None:
            return default
        raise FileFormatError(f"{path}: {name} is missing; write the file with Capytaine's coordinates")
    values = np.ravel(np.asarray(dataset[name].values, dtype=float))
    if len(values) != 1:
        raise FileFormatError(f"{path}: {name} has {len(values)} values; select one and write the file again")
    return float(values[0])


def single(path: Path, dataset: xarray.Dataset, *, bodies: bool = False) -> xarray.Dataset:
    """Without the dimensions of one value that a parametric study leaves."""
    known = ("omega", "wave_direction", *MATRIX, "complex", "space_coordinate", "xyz", *["body"] * bodies)
    for name in [str(name) for name in dataset.dims if name not in known]:
        used = any(name in dataset[key].dims for key in ("added_mass", "radiation_damping") if key in dataset)
        if used and dataset.sizes[name] > 1:
            raise FileFormatError(
                f"{path}: added_mass depends on {name} ({dataset.sizes[name]} values); only omega is "
                "read: select one and write the file again"
            )
        if dataset.sizes[name] == 1:
            dataset = dataset.isel({name: 0})
    return dataset


def _by_motion(path: Path, dataset: xarray.Dataset, *, given: bool) -> tuple[xarray.Dataset, tuple[str, ...]]:
    """The dataset with the six motions in our order, found by name, and those it has; others have zeros.

    ``given``: mass matrix and restoring are, so that motions may be missing.
    """
    for dimension in MATRIX:
        if dimension not in dataset.coords:
            raise FileFormatError(f"{path}: coordinate {dimension} is missing; it is no Capytaine dataset")
        labels = [str(label) for label in dataset[dimension].values]
        bodies = {label.rpartition("__")[0] for label in labels}
        if len(bodies) > 1:
            raise FileFormatError(
                f"{path}: {dimension} names several bodies ({', '.join(sorted(bodies))[:200]}); "
                "load_database and "
                "read_capytaine_group read them"
            )
        plain = [label.rpartition("__")[2] for label in labels]
        if not set(plain) <= set(MOTION_NAMES) or len(set(plain)) < len(plain) or "Heave" not in plain:
            raise FileFormatError(
                f"{path}: {dimension} holds {', '.join(plain)[:200]}; rigid motions are needed, each once, "
                f"heave among them: {', '.join(MOTION_NAMES)}"
            )
        dataset = dataset.assign_coords({dimension: plain})
    plain = [str(label) for label in dataset[MATRIX[0]].values]
    if set(plain) != {str(label) for label in dataset[MATRIX[1]].values}:
        raise FileFormatError(f"{path}: {' and '.join(MATRIX)} name different motions; solve for the same")
    missing = [name for name in MOTION_NAMES if name not in plain]
    if missing and not given:
        raise FileFormatError(
            f"{path}: has no {', '.join(missing).lower()}; pass mass_matrix and restoring (6, 6) to "
            "read_capytaine, or solve for all six motions"
        )
    if missing:
        warn_caller(
            f"{path}: has no {', '.join(missing).lower()}; added mass, damping and wave forces are taken as "
            "zero there. Keep the vessel from these motions, or solve for them",
            MissingMotionsWarning,
        )
    every = {dimension: list(MOTION_NAMES) for dimension in MATRIX}
    whole = dataset.reindex(every, fill_value=0.0) if missing else dataset.sel(every)
    return whole, tuple(name.lower() for name in MOTION_NAMES if name in plain)


def over_omega(path: Path, dataset: xarray.Dataset, g: float, depth: float) -> xarray.Dataset:
    """The dataset over omega (rad/s), whichever measure of frequency it was solved for."""
    if "omega" in dataset.dims:
        return dataset
    found = [name for name in MEASURES if name in dataset.dims and name in dataset.coords]
    if len(found) != 1:
        raise FileFormatError(
            f"{path}: no dimension omega, freq, period, wavenumber or wavelength with its values; solve for "
            "one of these, and write it with the dataset"
        )
    measure = found[0]
    with np.errstate(divide="ignore", invalid="ignore"):
        omega = MEASURES[measure](np.asarray(dataset[measure].values, dtype=float), g, depth)
    plain = dataset.drop_vars([name for name in ("omega", *MEASURES) if name in dataset.coords])
    return plain.rename({measure: "omega"}).assign_coords(omega=omega)


def frequencies(path: Path, dataset: xarray.Dataset) -> tuple[FloatArray, NDArray[np.intp]]:
    """Frequencies in rad/s as they are, and the places of those that are positive and finite, rising."""
    omega = np.asarray(dataset["omega"].values, dtype=float)
    if len(np.unique(omega)) < len(omega) or np.any(np.isnan(omega)) or np.any(omega < 0.0):
        raise FileFormatError(
            f"{path}: omega {shown(omega.tolist())} holds repeated, negative or undefined values"
        )
    finite = (omega > 0.0) & np.isfinite(omega)
    rows = np.flatnonzero(finite)[np.argsort(omega[finite])]
    if rows.size == 0:
        raise FileFormatError(f"{path}: omega holds no finite positive frequency; solve for some")
    return omega, rows


def real_values(path: Path, dataset: xarray.Dataset, name: str, dimensions: tuple[str, ...]) -> FloatArray:
    """A variable's values with its dimensions in the given order."""
    return np.asarray(_variable(path, dataset, name, dimensions).values, dtype=float)


def _variable(path: Path, dataset: xarray.Dataset, name: str, dimensions: tuple[str, ...]) -> Any:
    if name not in dataset:
        raise FileFormatError(f"{path}: variable {name} is missing; write the whole Capytaine dataset")
    variable = dataset[name]
    if set(variable.dims) != set(dimensions):
        raise FileFormatError(
            f"{path}: {name} has dimensions {', '.join(map(str, variable.dims))[:200]}; "
            f"{', '.join(dimensions)} are needed"
        )
    return variable.transpose(*dimensions)


def _matrix(
    path: Path, dataset: xarray.Dataset, name: str, argument: str, given: ArrayLike | None
) -> FloatArray:
    """A constant matrix (6, 6): the caller's, else the file's."""
    if given is not None:
        return np.asarray(given, dtype=float)
    if name not in dataset:
        raise FileFormatError(
            f"{path}: {name} is missing; set body.{name} before solving (compute_rigid_body_inertia, "
            f"compute_hydrostatic_stiffness), or pass {argument} to read_capytaine"
        )
    return real_values(path, dataset, name, MATRIX)


def directions(path: Path, dataset: xarray.Dataset) -> tuple[FloatArray, NDArray[np.intp]]:
    """As `rising_directions`, of the file."""
    if "wave_direction" not in dataset.coords:
        raise FileFormatError(f"{path}: wave_direction is missing; solve diffraction problems too")
    raw = np.ravel(np.asarray(dataset["wave_direction"].values, dtype=float))
    if np.any(np.abs(raw) > 2.0 * np.pi + 1e-6):
        raise FileFormatError(f"{path}: wave_direction reaches {np.abs(raw).max():g}; radians are expected")
    return rising_directions(raw)


def wave_force(path: Path, dataset: xarray.Dataset) -> ComplexArray:
    """Wave excitation (m, n, 6) with our time factor; NaN at the limits 0 and infinity."""
    parts = ("Froude_Krylov_force", "diffraction_force")
    names = parts if all(name in dataset for name in parts) else ("excitation_force",)
    if names == ("excitation_force",) and "excitation_force" not in dataset:
        raise FileFormatError(
            f"{path}: neither excitation_force nor {' and '.join(parts)} are there; solve diffraction "
            "problems too"
        )
    dimensions = ("wave_direction", "omega", "influenced_dof")
    total = np.sum([_complex(path, dataset, name, dimensions) for name in names], axis=0)
    return np.asarray(np.conj(total), dtype=complex)


def _complex(path: Path, dataset: xarray.Dataset, name: str, dimensions: tuple[str, ...]) -> ComplexArray:
    """A complex variable from its parts re and im along the dimension ``complex``."""
    if "wave_direction" not in dataset[name].dims:
        dataset = dataset.assign({name: dataset[name].expand_dims("wave_direction")})
    values = _variable(path, dataset, name, (*dimensions, "complex"))
    labels = [str(label) for label in values["complex"].values] if "complex" in values.coords else []
    if sorted(labels) != ["im", "re"]:
        raise FileFormatError(f"{path}: {name} has parts {shown(labels)}; re and im along complex are needed")
    real, imaginary = (np.asarray(values.sel(complex=part).values, dtype=float) for part in ("re", "im"))
    return np.asarray(real + 1j * imaginary)


def _rotation_centre(path: Path, dataset: xarray.Dataset, given: ArrayLike | None) -> FloatArray:
    """Where the rotations turn about, from the origin of the mesh (which it is where nothing tells)."""
    told = given if "rotation_center" not in dataset.variables else dataset["rotation_center"].values
    if told is None:
        warn_caller(
            f"{path}: does not tell about which point the body turns, as Capytaine tells from version 3 on; "
            "the origin of its mesh is taken, and matrices of another point would be misread. Give "
            "read_capytaine(rotation_centre=(x, y, z)) in m",
            AssumedReferenceWarning,
        )
        return np.zeros(3)
    centre = np.ravel(np.asarray(told, dtype=float))
    if centre.shape != (3,) or not np.all(np.isfinite(centre)):
        raise FileFormatError(f"{path}: the rotation centre is {shown(told)}; give (x, y, z) in m")
    return centre


def limit_of(matrices: FloatArray, where: NDArray[np.bool_]) -> FloatArray | None:
    """The matrix at a limiting frequency, if it is there."""
    found = matrices[where]
    return found[0] if len(found) and np.all(np.isfinite(found)) else None


def _name(dataset: xarray.Dataset) -> Any:
    for key in ("body", "body_name"):
        if key in dataset.variables:
            return dataset[key].values
    return "unnamed"


def _can_open(path: Path) -> bool:
    return is_file_of(path, NETCDF) and is_capytaine(path)


FORMAT = Format(
    name="Capytaine",
    files="a NetCDF file (.nc) of Capytaine",
    can_open=_can_open,
    read=of_one_speed(read_capytaine),
    speeds=zero_speed,
    at_depth=lambda path, depth: read_capytaine(path, depth=depth),
)
