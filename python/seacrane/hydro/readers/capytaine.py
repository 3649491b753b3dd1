"""Reader of Capytaine's NetCDF datasets, by the names of variables, dimensions and degrees of freedom.

Capytaine's axes and wave directions (rad, direction of travel) are ours when x of the mesh points forward;
its time factor is exp(-i omega t), so complex values are conjugated. Matrices refer to the rotation centre of
the degrees of freedom, phases to the origin of the mesh; forces on a body alone are shifted to zero phase at
the former.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array, Complex
from seacrane.errors import FileFormatError
from seacrane.hydro.data.frozen import reading
from seacrane.hydro.readers.as_read import Asked, Given, left_out, rising_directions
from seacrane.hydro.readers.format import Format, Loaded, is_file_of, is_kind
from seacrane.hydro.readers.of_bodies import floating_body, hull_or_group, of_each
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_netcdf
from seacrane.inputs.shown import shown
from seacrane.warnings import AssumedReferenceWarning, MissingMotionsWarning

if TYPE_CHECKING:
    import xarray

MOTION_NAMES = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
READ = (
    "added_mass", "radiation_damping", "inertia_matrix", "hydrostatic_stiffness", "excitation_force",
    "Froude_Krylov_force", "diffraction_force", "rotation_center", "draught", "rho", "g", "forward_speed",
)  # fmt: skip
NETCDF = (".nc", ".nc4")
SAME_DEPTH = 1e-9  # of it
NAMED = 8  # depths in a message
MATRIX = ("influenced_dof", "radiating_dof")


def _of_wavenumber(k: Array, g: float, depth: float) -> Array:
    """omega^2 = g k tanh(k h)."""
    return np.asarray(np.sqrt(g * k * (1.0 if np.isinf(depth) else np.tanh(k * depth))))


MEASURES: dict[str, Callable[[Array, float, float], Array]] = {
    "freq": lambda value, g, depth: 2.0 * np.pi * value,
    "period": lambda value, g, depth: 2.0 * np.pi / value,
    "wavenumber": _of_wavenumber,
    "wavelength": lambda value, g, depth: _of_wavenumber(2.0 * np.pi / value, g, depth),
}


def read_capytaine(
    path: str | PathLike[str],
    *,
    depth: float | None = None,
    mass_matrix: Given | None = None,
    restoring: Given | None = None,
    rotation_centre: Given | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> Loaded:
    """Read a dataset that Capytaine wrote to NetCDF (complex values split into ``re`` and ``im``).

    Parameters
    ----------
    path : file with ``added_mass``, ``radiation_damping`` and either ``excitation_force`` or
        ``Froude_Krylov_force`` and ``diffraction_force``, for rigid motions of one body or of several, heave
        among them, at zero speed, over omega, freq, period, wavenumber or wavelength. Frequencies 0 and
        infinity become limits of the added mass. Motions are found by name, of several bodies
        "<body>__Surge" and so on.
    depth : m, which of the file's water depths; needed where it has several (inf: deep water).
    mass_matrix, restoring : (6, 6) in SI about the rotation centre, of several bodies by name; they take the
        place of ``inertia_matrix`` and ``hydrostatic_stiffness``, and are needed where the file lacks these,
        or has not all six motions.
    rotation_centre : (3,) m from the origin of the mesh, of several bodies by name; of files that do not tell
        it (before Capytaine 3).
    motions : names of those that were solved for, where some were not: a motion without added mass and
        damping is refused unless it is left out here.
    leave_out : rad/s of frequencies to do without, such as those at which a solution failed.

    Returns
    -------
    HydroDatabase : of one body, about its rotation centre; port-starboard symmetric if the matrices are, to
        2 %.
    HydroGroup : of several, in the order of the file; its origin is that of the mesh. Draughts are the
        file's; lengths and breadths, and draughts that it lacks, are those of the equivalent box.

    Warns
    -----
    MissingMotionsWarning : some of the six motions are not in the file.
    AssumedReferenceWarning : neither the file nor the caller tells the rotation centre.

    Raises
    ------
    FileFormatError : the file is missing, damaged or no Capytaine dataset; the message names the variable.
    """
    import xarray

    source = Path(path)
    asked = Asked(
        where=source, reader="read_capytaine", mass_matrix=mass_matrix, restoring=restoring, motions=motions,
        leave_out=leave_out,
    )  # fmt: skip
    with reading(source, "a Capytaine dataset", NETCDF_ERRORS):
        with open_netcdf(source), xarray.open_dataset(source) as opened:
            dataset = opened.load()
        return _convert(asked, _of_depth(source, dataset, depth), rotation_centre)


def _bodies(dataset: xarray.Dataset, dimension: str) -> list[str]:
    """Names of the bodies of the degrees of freedom, in their order; "" where they name none."""
    if dimension not in dataset.coords:
        return [""]
    labels = [str(label).rpartition("__")[0] for label in np.ravel(dataset[dimension].values)]
    return list(dict.fromkeys(labels))


def _of_depth(path: Path, dataset: xarray.Dataset, depth: float | None) -> xarray.Dataset:
    """The results in one water depth: the one there is, or the one asked for."""
    there = np.array([np.inf])
    if "water_depth" in dataset.coords:
        there = np.ravel(np.asarray(dataset["water_depth"].values, dtype=float))
    if depth is None and len(there) == 1:
        return dataset
    found = np.flatnonzero(np.isclose(there, np.nan if depth is None else depth, rtol=SAME_DEPTH, atol=0.0))
    if found.size == 0:
        listed = ", ".join(f"{value:g}" for value in there[:NAMED])
        other = "" if depth is None else f", not {depth:g} m"
        raise FileFormatError(
            f"{path}: holds water depths {listed} m{other}; choose one by load_database(path, depth=...)"
        )
    return dataset.isel(water_depth=int(found[0])) if "water_depth" in dataset.dims else dataset


def is_capytaine(path: Path) -> bool:
    """Whether a NetCDF file holds radiation results by Capytaine's names."""
    return is_kind(
        open_netcdf(path), lambda file: "added_mass" in file.variables and "radiating_dof" in file.dimensions
    )


def _convert(asked: Asked, dataset: xarray.Dataset, rotation_centre: Given | None) -> Loaded:
    path = asked.where
    rho, g, depth = _water(path, dataset)
    names = _bodies(dataset, MATRIX[0])
    several = len(names) > 1
    complete = asked.mass_matrix is not None and asked.restoring is not None
    dataset, solved = _by_motion(path, _over_omega(path, dataset, g, depth), names, given=complete)
    dataset = _single(path, dataset)
    omega = np.asarray(dataset["omega"].values, dtype=float)
    if len(np.unique(omega)) < len(omega) or np.any(np.isnan(omega)) or np.any(omega < 0.0):
        raise FileFormatError(
            f"{path}: omega {shown(omega.tolist())} holds repeated, negative or undefined values"
        )
    draughts = _by_body(dataset, "draught", names)
    weighs = "inertia_matrix" in dataset or asked.mass_matrix is not None or draughts is None
    masses: Sequence[Array | None] = [None] * len(names)
    if weighs:  # asked for where it is all that tells the draught
        masses = _matrices(asked, dataset, "inertia_matrix", "mass_matrix", names)
    stiffness = _matrices(asked, dataset, "hydrostatic_stiffness", "restoring", names)
    if "wave_direction" not in dataset.coords:
        raise FileFormatError(f"{path}: wave_direction is missing; solve diffraction problems too")
    raw = np.ravel(np.asarray(dataset["wave_direction"].values, dtype=float))
    if np.any(np.abs(raw) > 2.0 * np.pi + 1e-6):
        raise FileFormatError(f"{path}: wave_direction reaches {np.abs(raw).max():g}; radians are expected")
    direction, order = rising_directions(raw)
    centres = _rotation_centres(asked, dataset, names, rotation_centre)
    bodies = []
    for i, (name, centre, mass, restoring) in enumerate(zip(names, centres, masses, stiffness, strict=True)):
        bodies.append(
            floating_body(
                asked, name or path.stem, several=several, restoring=restoring, water=(rho, g), mass=mass,
                position=centre, draught=None if draughts is None else float(draughts[i]),
            )
        )  # fmt: skip
    version = str(dataset.attrs.get("capytaine_version", "of unknown version"))
    origin, body = "origin of the meshes of Capytaine, on the still waterline", ""
    if not several:
        x, y, z = centres[0]
        origin = f"rotation centre of the Capytaine body, ({x:g}, {y:g}, {z:g}) m from the origin of its mesh"
        named = [dataset[key].values for key in ("body", "body_name") if key in dataset.variables]
        body = f", body {np.ravel(named[0] if named else 'unnamed')[0]}"
    unread = [str(name) for name in dataset.data_vars if name not in READ]
    return hull_or_group(
        replace(asked, motions=solved if asked.motions is None else asked.motions),
        bodies, fix="restoring={name: (6, 6)}", name=path.stem, origin=origin,
        source=f"Capytaine {version}, file {path.name}{body}" + left_out(unread),
        rho=rho, g=g, depth=depth, omega=omega, heading=direction, force=_wave_force(path, dataset)[order],
        added_mass=_real(path, dataset, "added_mass", ("omega", *MATRIX)),
        damping=_real(path, dataset, "radiation_damping", ("omega", *MATRIX)),
    )  # fmt: skip


def _water(path: Path, dataset: xarray.Dataset) -> tuple[float, float, float]:
    """Density, gravity and depth of results of zero speed."""
    found = {"rho": np.nan, "g": np.nan, "water_depth": np.inf, "forward_speed": 0.0}
    for name in found:
        if name in dataset.variables:
            values = np.ravel(np.asarray(dataset[name].values, dtype=float))
            if len(values) != 1:
                raise FileFormatError(
                    f"{path}: {name} has {len(values)} values; select one and write the file again"
                )
            found[name] = float(values[0])
    rho, g, depth, speed = found.values()
    if speed != 0.0:
        raise FileFormatError(f"{path}: forward_speed is {speed:g} m/s; only results of zero speed are read")
    return rho, g, depth


def _single(path: Path, dataset: xarray.Dataset) -> xarray.Dataset:
    """Without the dimensions of one value that a parametric study leaves."""
    known = ("omega", "wave_direction", *MATRIX, "complex", "space_coordinate", "xyz")
    others = [str(name) for name in dataset.dims if name not in known]
    for name in others:
        used = any(name in dataset[key].dims for key in ("added_mass", "radiation_damping") if key in dataset)
        if used and dataset.sizes[name] > 1:
            raise FileFormatError(
                f"{path}: added_mass depends on {name} ({dataset.sizes[name]} values); only omega is "
                "read: select one and write the file again"
            )
    return dataset.isel({name: 0 for name in others if dataset.sizes[name] == 1})


def _by_motion(
    path: Path, dataset: xarray.Dataset, names: list[str], *, given: bool
) -> tuple[xarray.Dataset, list[str]]:
    """The dataset with six motions of each body in our order, zeros where it has none; those of all bodies.

    Motions are found by name, and may be missing where mass matrices and restoring are ``given``.
    """
    several = len(names) > 1
    wanted = [f"{name}__{motion}" if several else motion for name in names for motion in MOTION_NAMES]
    heave = {label for label in wanted if label.endswith("Heave")}
    held: list[set[str]] = []
    for dimension in MATRIX:
        if dimension not in dataset.coords:
            raise FileFormatError(f"{path}: coordinate {dimension} is missing; it is no Capytaine dataset")
        labels = [str(label) for label in dataset[dimension].values]
        if not several and len(_bodies(dataset, dimension)) == 1:
            labels = [label.rpartition("__")[2] for label in labels]
        if not heave <= set(labels) <= set(wanted) or len(set(labels)) < len(labels):
            raise FileFormatError(
                f"{path}: {dimension} holds {', '.join(labels)[:200]}; rigid motions are needed, each once, "
                f"heave among them: {', '.join(wanted)[:200]}"
            )
        dataset = dataset.assign_coords({dimension: labels})
        held.append(set(labels))
    if held[0] != held[1]:
        other = ", ".join(sorted(held[0] ^ held[1]))[:200]
        raise FileFormatError(f"{path}: only one of {' and '.join(MATRIX)} holds {other}; solve for the same")
    missing = [label for label in wanted if label not in held[0]]
    told = ", ".join(missing if several else [label.lower() for label in missing])[:200]
    if missing and not given:
        raise FileFormatError(
            f"{path}: has no {told}; pass mass_matrix and restoring (6, 6) to read_capytaine, or solve for "
            "all six motions"
        )
    if missing:
        warn_caller(
            f"{path}: has no {told}; added mass, damping and wave forces are taken as zero there. Keep the "
            "vessel from these motions, or solve for them",
            MissingMotionsWarning,
        )
    every = {dimension: wanted for dimension in MATRIX}
    whole = dataset.reindex(every, fill_value=0.0) if missing else dataset.sel(every)
    lacking = {label.rpartition("__")[2] for label in missing}
    return whole, [name.lower() for name in MOTION_NAMES if name not in lacking]


def _over_omega(path: Path, dataset: xarray.Dataset, g: float, depth: float) -> xarray.Dataset:
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


def _real(path: Path, dataset: xarray.Dataset, name: str, dimensions: tuple[str, ...]) -> Array:
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


def _matrices(
    asked: Asked, dataset: xarray.Dataset, variable: str, argument: str, names: list[str]
) -> list[Array]:
    """A constant matrix (6, 6) of each body: the caller's, else the block of the file's."""
    given = of_each(asked, argument, names, getattr(asked, argument))
    if given[0] is not None:
        return given
    if variable not in dataset:
        raise FileFormatError(
            f"{asked.where}: {variable} is missing; set body.{variable} before solving, or pass {argument} "
            f"to {asked.reader}"
        )
    whole = _real(asked.where, dataset, variable, MATRIX)
    return [whole[at : at + 6, at : at + 6] for at in range(0, 6 * len(names), 6)]


def _wave_force(path: Path, dataset: xarray.Dataset) -> Complex:
    """Wave excitation (m, n, 6 k) with our time factor; NaN at the limits 0 and infinity."""
    parts: tuple[str, ...] = ("Froude_Krylov_force", "diffraction_force")
    if not all(name in dataset for name in parts):
        parts = ("excitation_force",)
    if not all(name in dataset for name in parts):
        raise FileFormatError(f"{path}: excitation_force is missing; solve diffraction problems too")
    dimensions = ("wave_direction", "omega", "influenced_dof", "complex")
    every = []
    for name in parts:
        if "wave_direction" not in dataset[name].dims:
            dataset = dataset.assign({name: dataset[name].expand_dims("wave_direction")})
        values = _variable(path, dataset, name, dimensions)
        labels = [str(label) for label in values["complex"].values] if "complex" in values.coords else []
        if sorted(labels) != ["im", "re"]:
            raise FileFormatError(
                f"{path}: {name} has parts {shown(labels)}; re and im along complex are needed"
            )
        real, imaginary = (np.asarray(values.sel(complex=part).values, dtype=float) for part in ("re", "im"))
        every.append(real + 1j * imaginary)
    return np.asarray(np.conj(np.sum(every, axis=0)), dtype=complex)


def _rotation_centres(asked: Asked, dataset: xarray.Dataset, names: list[str], given: Given | None) -> Array:
    """Where the rotations of each body turn about (k, 3), from the origin of the mesh."""
    if given is not None:
        return np.array(of_each(asked, "rotation_centre", names, given, (3,)))
    there = _by_body(dataset, "rotation_center", names)
    if there is None and len(names) == 1 and "rotation_center" in dataset.variables:
        there = np.ravel(np.asarray(dataset["rotation_center"].values, dtype=float))[None]
    if there is None:
        point = "{name: (x, y, z)}" if len(names) > 1 else "(x, y, z)"
        warn_caller(
            f"{asked.where}: does not tell the rotation centre of {', '.join(names)[:200] or 'the body'}, as "
            "Capytaine does from version 3 on; the origin of its mesh is taken, and matrices of another "
            f"point would be misread. Give read_capytaine(rotation_centre={point}) in m",
            AssumedReferenceWarning,
        )
        return np.zeros((len(names), 3))
    if there.shape != (len(names), 3) or not np.all(np.isfinite(there)):
        raise FileFormatError(
            f"{asked.where}: the rotation centre is {shown(there.tolist())}; give (x, y, z) in m"
        )
    return there


def _by_body(dataset: xarray.Dataset, variable: str, names: list[str]) -> Array | None:
    """A variable's values by body, in the order of the names; None where the file has none by name."""
    known = variable in dataset.variables and "body" in dataset[variable].dims and "body" in dataset.coords
    there = [str(name) for name in dataset["body"].values] if known else []
    if not known or sorted(there) != sorted(names):
        return None
    values = np.asarray(dataset[variable].transpose("body", ...).values, dtype=float)
    return values[[there.index(name) for name in names]]


def is_netcdf(path: Path) -> bool:
    """Whether a path is a file that says by its name to be NetCDF."""
    return is_file_of(path, NETCDF)


FORMAT = Format(
    name="Capytaine",
    files="a NetCDF file (.nc) of Capytaine",
    looks="variables `added_mass`, `radiation_damping`, dimension `influenced_dof`",
    can_open=lambda path: is_netcdf(path) and is_capytaine(path),
    read=read_capytaine,
    takes=("depth", "mass_matrix"),
)
