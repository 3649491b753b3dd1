"""Reader of Capytaine's NetCDF datasets, by the names of variables, dimensions and degrees of freedom.

Capytaine's axes and wave directions (rad, direction of travel) are ours when x of the mesh points forward;
its time factor is exp(-i omega t), so complex values are conjugated. Matrices refer to the rotation centre of
the degrees of freedom, phases to the origin of the mesh; forces are shifted to zero phase at the former.
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.files.netcdf_limits import NETCDF_ERRORS, open_netcdf
from seacrane.hydro.data.heading_circle import PORT_STARBOARD
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.readers.equivalent_box import equivalent_box
from seacrane.hydro.readers.format import Format, is_file_of, of_one_speed, zero_speed
from seacrane.inputs.shown import shown
from seacrane.sea.dispersion import wavenumber

if TYPE_CHECKING:
    import xarray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

MOTION_NAMES = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
NETCDF = (".nc", ".nc4")
MATRIX = ("influenced_dof", "radiating_dof")
SYMMETRY_TOLERANCE = 0.02


def read_capytaine(
    path: str | PathLike[str], *, mass_matrix: ArrayLike | None = None, restoring: ArrayLike | None = None
) -> HydroDatabase:
    """Read a dataset that Capytaine wrote to NetCDF (complex values split into ``re`` and ``im``).

    Parameters
    ----------
    path : file with ``added_mass``, ``radiation_damping`` and either ``excitation_force`` or
        ``Froude_Krylov_force`` and ``diffraction_force``, for the six rigid motions of one body, zero speed,
        one water depth. Frequencies 0 and infinity become the limits of the added mass.
    mass_matrix, restoring : (6, 6) in SI about the rotation centre; they take the place of
        ``inertia_matrix`` and ``hydrostatic_stiffness``, and are needed where the file lacks these.

    Returns
    -------
    HydroDatabase : length, breadth and draught are those of the equivalent box; port-starboard symmetric if
        the matrices are, to 2 %.

    Raises
    ------
    FileFormatError : the file is missing, damaged or no Capytaine dataset; the message names the variable.
    """
    source = Path(path)
    if not source.is_file():
        raise FileFormatError(f"{source}: no such file; give the path of a Capytaine NetCDF file")
    import xarray

    try:
        with open_netcdf(source), xarray.open_dataset(source) as opened:
            dataset = opened.load()
        return _convert(source, dataset, mass_matrix, restoring)
    except FileFormatError:
        raise
    except NETCDF_ERRORS as error:
        raise FileFormatError(
            f"{source}: cannot be read as a Capytaine dataset ({str(error)[:200]}); write it again"
        ) from error


def is_capytaine(path: Path) -> bool:
    """Whether a NetCDF file holds radiation results by Capytaine's names."""
    try:
        with open_netcdf(path) as file:
            return "added_mass" in file.variables and "radiating_dof" in file.dimensions
    except FileFormatError:
        raise
    except NETCDF_ERRORS:
        return False


def _convert(
    path: Path, dataset: xarray.Dataset, mass_matrix: ArrayLike | None, restoring: ArrayLike | None
) -> HydroDatabase:
    rho, g = _number(path, dataset, "rho"), _number(path, dataset, "g")
    if not (rho > 0.0 and g > 0.0):
        raise FileFormatError(f"{path}: rho is {rho:g} kg/m3 and g {g:g} m/s2; positive ones are needed")
    depth = _number(path, dataset, "water_depth", default=np.inf)
    speed = _number(path, dataset, "forward_speed", default=0.0)
    if speed != 0.0:
        raise FileFormatError(f"{path}: forward_speed is {speed:g} m/s; only results of zero speed are read")
    dataset = _single(path, _by_motion(path, dataset))
    omega = _omega(path, dataset)
    finite = (omega > 0.0) & np.isfinite(omega)
    rows = np.flatnonzero(finite)[np.argsort(omega[finite])]
    if rows.size == 0:
        raise FileFormatError(f"{path}: omega holds no finite positive frequency; solve for some")
    added_mass = _real(path, dataset, "added_mass", ("omega", *MATRIX))
    damping = _real(path, dataset, "radiation_damping", ("omega", *MATRIX))
    mass = _matrix(path, dataset, "inertia_matrix", "mass_matrix", mass_matrix)
    stiffness = _matrix(path, dataset, "hydrostatic_stiffness", "restoring", restoring)
    direction, order = _directions(path, dataset)
    force = _force(path, dataset)[order][:, rows]
    centre = _rotation_centre(dataset)
    box = equivalent_box(stiffness, float(mass[0, 0]) / rho, rho * g)
    version = str(dataset.attrs.get("capytaine_version", "of unknown version"))
    body = str(np.ravel(_name(dataset))[0])
    return HydroDatabase(
        name=path.stem,
        omega=omega[rows],
        heading=direction,
        added_mass=added_mass[rows],
        damping=damping[rows],
        infinite_frequency_added_mass=_limit(added_mass, np.isinf(omega)),
        zero_frequency_added_mass=_limit(added_mass, omega == 0.0),
        restoring=stiffness,
        mass_matrix=mass,
        force=force * _phase_at(centre, omega[rows], direction, g, depth),
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
        port_starboard_symmetric=_symmetric(added_mass[rows], centre),
    )


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


def _single(path: Path, dataset: xarray.Dataset) -> xarray.Dataset:
    """Without the dimensions of one value that a parametric study leaves."""
    known = ("omega", "wave_direction", *MATRIX, "complex", "space_coordinate", "xyz")
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


def _by_motion(path: Path, dataset: xarray.Dataset) -> xarray.Dataset:
    """The dataset with its degrees of freedom in our order, found by name."""
    for dimension in MATRIX:
        if dimension not in dataset.coords:
            raise FileFormatError(f"{path}: coordinate {dimension} is missing; it is no Capytaine dataset")
        labels = [str(label) for label in dataset[dimension].values]
        bodies = {label.rpartition("__")[0] for label in labels}
        if len(bodies) > 1:
            raise FileFormatError(
                f"{path}: {dimension} names several bodies ({', '.join(sorted(bodies))[:200]}); one is read"
            )
        plain = [label.rpartition("__")[2] for label in labels]
        if sorted(plain) != sorted(MOTION_NAMES):
            raise FileFormatError(
                f"{path}: {dimension} holds {', '.join(plain)[:200]}; the six rigid motions "
                f"{', '.join(MOTION_NAMES)} are needed"
            )
        dataset = dataset.isel({dimension: [plain.index(name) for name in MOTION_NAMES]})
    return dataset


def _omega(path: Path, dataset: xarray.Dataset) -> FloatArray:
    """Frequencies in rad/s; the main frequency must be omega."""
    if "omega" not in dataset.dims or "omega" not in dataset.coords:
        raise FileFormatError(
            f"{path}: no dimension omega; solve for omega (rad/s), or swap the dimension before writing"
        )
    omega = np.asarray(dataset["omega"].values, dtype=float)
    if len(np.unique(omega)) < len(omega) or np.any(np.isnan(omega)) or np.any(omega < 0.0):
        raise FileFormatError(
            f"{path}: omega {shown(omega.tolist())} holds repeated, negative or undefined values"
        )
    return omega


def _real(path: Path, dataset: xarray.Dataset, name: str, dimensions: tuple[str, ...]) -> FloatArray:
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
    return _real(path, dataset, name, MATRIX)


def _directions(path: Path, dataset: xarray.Dataset) -> tuple[FloatArray, NDArray[np.intp]]:
    """Directions in [0, 2 pi), rising, and their places in the file; a full turn beside 0 is dropped."""
    if "wave_direction" not in dataset.coords:
        raise FileFormatError(f"{path}: wave_direction is missing; solve diffraction problems too")
    raw = np.ravel(np.asarray(dataset["wave_direction"].values, dtype=float))
    if np.any(np.abs(raw) > 2.0 * np.pi + 1e-6):
        raise FileFormatError(f"{path}: wave_direction reaches {np.abs(raw).max():g}; radians are expected")
    wrapped = np.mod(raw, 2.0 * np.pi)
    wrapped[2.0 * np.pi - wrapped < 1e-9] = 0.0
    order = np.argsort(wrapped, kind="stable")
    new = np.append(True, np.diff(wrapped[order]) > 1e-9)
    return wrapped[order][new], order[new]


def _force(path: Path, dataset: xarray.Dataset) -> ComplexArray:
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


def _rotation_centre(dataset: xarray.Dataset) -> FloatArray:
    """Where the rotations turn about, from the origin of the mesh (which it is where the file is silent)."""
    if "rotation_center" not in dataset.variables:
        return np.zeros(3)
    return np.asarray(np.ravel(dataset["rotation_center"].values), dtype=float)


def _phase_at(
    centre: FloatArray, omega: FloatArray, direction: FloatArray, g: float, depth: float
) -> ComplexArray:
    """Factor (m, n, 1) that gives waves of zero phase at the centre: exp(+i k (x cos b + y sin b))."""
    along = centre[0] * np.cos(direction) + centre[1] * np.sin(direction)
    return np.asarray(np.exp(1j * np.outer(along, wavenumber(omega, g=g, depth=depth))))[:, :, None]


def _limit(matrices: FloatArray, where: NDArray[np.bool_]) -> FloatArray | None:
    """The matrix at a limiting frequency, if it is there."""
    found = matrices[where]
    return found[0] if len(found) and np.all(np.isfinite(found)) else None


def _symmetric(added_mass: FloatArray, centre: FloatArray) -> bool:
    """Whether motions that a port-starboard symmetric hull keeps apart are apart."""
    peak = np.sqrt(np.abs(np.diagonal(added_mass, axis1=1, axis2=2)).max(axis=0))
    scale = np.outer(peak, peak)
    mixed = np.outer(PORT_STARBOARD, PORT_STARBOARD) < 0.0
    largest = np.abs(added_mass).max(axis=0)
    return bool(centre[1] == 0.0 and np.all(largest[mixed] <= SYMMETRY_TOLERANCE * scale[mixed]))


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
)
