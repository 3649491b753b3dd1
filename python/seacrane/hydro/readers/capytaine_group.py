"""Reader of Capytaine's datasets of several bodies; axes, phases and time factor as in `read_capytaine`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.group_body import GroupBody
from seacrane.hydro.group.group import HydroGroup
from seacrane.hydro.readers.as_read import as_read, frequencies_kept, mass_of_file
from seacrane.hydro.readers.band_of_data import with_band_of_group
from seacrane.hydro.readers.capytaine import (
    MATRIX,
    MOTION_NAMES,
    NETCDF,
    bodies_of,
    directions,
    frequencies,
    from_dataset,
    is_capytaine,
    limit_of,
    of_depth,
    over_omega,
    real_values,
    single,
    water_of,
    wave_force,
)
from seacrane.hydro.readers.format import Format, is_file_of, of_one_speed, zero_speed
from seacrane.hydro.readers.of_bodies import box_of, group_symmetric, of_each, require_own_hydrostatics
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import AssumedReferenceWarning

if TYPE_CHECKING:
    import xarray

FloatArray = NDArray[np.float64]
Given = Mapping[str, ArrayLike]


def read_capytaine_group(
    path: str | PathLike[str],
    *,
    depth: float | None = None,
    mass_matrices: Given | None = None,
    restorings: Given | None = None,
    rotation_centres: Given | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> HydroGroup:
    """Read a dataset of several bodies that Capytaine wrote to NetCDF.

    Parameters
    ----------
    path : file as of `read_capytaine`, of two or more bodies, each with all six rigid motions, which are
        found by name: "<body>__Surge" and so on, in any order.
    depth : m, which of the file's water depths; needed where it has several (inf: deep water).
    mass_matrices, restorings : by body, (6, 6) in SI about its rotation centre; in the place of the blocks of
        ``inertia_matrix`` and ``hydrostatic_stiffness``.
    rotation_centres : by body, (3,) m from the origin of the mesh; of files that do not hold them.
    motions : names of those that were solved for, where some were not: a motion without added mass and
        damping is refused unless it is left out here.
    leave_out : rad/s of frequencies to do without, such as those at which a solution failed.

    Returns
    -------
    HydroGroup : its origin is that of the mesh. Bodies are named as in the file, and in its order. Draughts
        are the file's; lengths and breadths, and draughts that it lacks, are those of the equivalent box.

    Warns
    -----
    AssumedReferenceWarning : neither the file nor the caller tells the rotation centres.

    Raises
    ------
    FileFormatError : the file is missing, damaged or no such dataset; the message names body and variable.
    """
    source = Path(path)
    given = _Given(mass_matrices, restorings, rotation_centres, leave_out)
    found = from_dataset(
        source,
        lambda dataset: as_read(
            source,
            "read_capytaine_group",
            _convert(source, of_depth(source, dataset, depth), given),
            motions,
        ),
    )
    require_own_hydrostatics(source, found, "restorings={name: (6, 6)}")
    return with_band_of_group(found)


class _Given:
    """What the caller says by body."""

    def __init__(
        self,
        masses: Given | None,
        restorings: Given | None,
        centres: Given | None,
        leave_out: ArrayLike | None,
    ) -> None:
        self.masses, self.restorings, self.centres = masses, restorings, centres
        self.leave_out = leave_out


def _convert(path: Path, dataset: xarray.Dataset, given: _Given) -> HydroGroup:
    rho, g, depth = water_of(path, dataset)
    names = bodies_of(dataset)
    centres = _rotation_centres(path, dataset, names, given)
    draughts = _by_body(dataset, "draught", names)
    dataset = single(path, _by_name(path, over_omega(path, dataset, g, depth), names), bodies=True)
    omega, rows = frequencies(path, dataset)
    added_mass = real_values(path, dataset, "added_mass", ("omega", *MATRIX))
    damping = real_values(path, dataset, "radiation_damping", ("omega", *MATRIX))
    direction, order = directions(path, dataset)
    force = wave_force(path, dataset)[order]
    tables = {"added_mass": added_mass[rows], "damping": damping[rows], "force": force[:, rows]}
    rows = rows[frequencies_kept(path, "read_capytaine_group", omega[rows], tables, given.leave_out)]
    masses = _blocks(path, dataset, "inertia_matrix", names, given.masses)
    restorings = _blocks(path, dataset, "hydrostatic_stiffness", names, given.restorings)
    bodies = []
    for i, (name, centre, mass, restoring) in enumerate(zip(names, centres, masses, restorings, strict=True)):
        box = box_of(path, name, restoring, float(mass[0, 0]) / rho, rho * g)
        if given.masses is None:
            asked = f"read_capytaine_group(mass_matrices={{{name!r}: ...}})"
            mass = mass_of_file(f"{path}: {name}", asked, mass, box=tuple(box.values()))
        if draughts is not None:
            box["draught"] = float(draughts[i])
        bodies.append(
            GroupBody(
                name=name,
                position=centre,
                mass_matrix=mass,
                restoring=restoring,
                **box,
            )
        )
    version = str(dataset.attrs.get("capytaine_version", "of unknown version"))
    return HydroGroup(
        name=path.stem,
        bodies=tuple(bodies),
        omega=omega[rows],
        heading=direction,
        added_mass=added_mass[rows],
        damping=damping[rows],
        infinite_frequency_added_mass=limit_of(added_mass, np.isinf(omega)),
        zero_frequency_added_mass=limit_of(added_mass, omega == 0.0),
        force=force[:, rows],
        rho=rho,
        g=g,
        depth=depth,
        port_starboard_symmetric=group_symmetric(bodies, added_mass[rows]),
        origin="origin of the meshes of Capytaine, on the still waterline",
        source=f"Capytaine {version}, file {path.name}",
    )


def _by_name(path: Path, dataset: xarray.Dataset, names: list[str]) -> xarray.Dataset:
    """The dataset with six motions of each body, in our order, found by name."""
    wanted = [f"{name}__{motion}" for name in names for motion in MOTION_NAMES]
    for dimension in MATRIX:
        if dimension not in dataset.coords:
            raise FileFormatError(f"{path}: coordinate {dimension} is missing; it is no Capytaine dataset")
        labels = [str(label) for label in dataset[dimension].values]
        missing = sorted(set(wanted) - set(labels), key=wanted.index)
        others = sorted(set(labels) - set(wanted))
        if missing or others or len(labels) > len(wanted):
            wrong = (
                f"lacks {missing[0]}" if missing else f"holds {(others or labels)[0]} beside rigid motions"
            )
            raise FileFormatError(
                f"{path}: {dimension} {wrong[:100]}; bodies {', '.join(names)[:200]} need the six rigid "
                "motions, each once"
            )
        dataset = dataset.assign_coords({dimension: labels})
    return dataset.sel({dimension: wanted for dimension in MATRIX})


def _rotation_centres(path: Path, dataset: xarray.Dataset, names: list[str], given: _Given) -> FloatArray:
    """Where the rotations of each body turn about (k, 3), from the origin of the meshes."""
    if given.centres is not None:
        return np.array(of_each(path, "rotation_centres", names, given.centres, (3,)))
    there = _by_body(dataset, "rotation_center", names)
    if there is not None and there.shape == (len(names), 3):
        return there
    warn_caller(
        f"{path}: does not tell about which points {', '.join(names)} turn; the origin of the meshes is "
        "taken "
        "for all. Give read_capytaine_group(rotation_centres={name: (x, y, z)}) in m, or write the file with "
        "Capytaine 3",
        AssumedReferenceWarning,
    )
    return np.zeros((len(names), 3))


def _by_body(dataset: xarray.Dataset, variable: str, names: list[str]) -> FloatArray | None:
    """A variable's values by body, in the order of the names; None where the file has none by name."""
    if (
        variable not in dataset.variables
        or "body" not in dataset[variable].dims
        or "body" not in dataset.coords
    ):
        return None
    there = [str(name) for name in dataset["body"].values]
    if sorted(there) != sorted(names):
        return None
    values = np.asarray(dataset[variable].transpose("body", ...).values, dtype=float)
    return values[[there.index(name) for name in names]]


def _blocks(
    path: Path, dataset: xarray.Dataset, variable: str, names: list[str], given: Given | None
) -> list[FloatArray]:
    """A matrix (6, 6) of each body: the caller's, else the block of the file's."""
    if given is not None:
        return of_each(path, variable, names, given, (6, 6))
    if variable not in dataset:
        raise FileFormatError(
            f"{path}: {variable} is missing; set it for each body before solving, or give "
            "read_capytaine_group "
            f"{'mass_matrices' if variable == 'inertia_matrix' else 'restorings'}"
        )
    whole = real_values(path, dataset, variable, MATRIX)
    if not np.all(np.isfinite(whole)):
        raise FileFormatError(f"{path}: {variable} holds values that are not finite; set it for each body")
    return [whole[6 * i : 6 * i + 6, 6 * i : 6 * i + 6] for i in range(len(names))]


def _can_open(path: Path) -> bool:
    return is_file_of(path, NETCDF) and is_capytaine(path) and len(from_dataset(path, bodies_of)) > 1


FORMAT = Format(
    name="Capytaine",
    files="a NetCDF file (.nc) of Capytaine",
    can_open=_can_open,
    read=of_one_speed(read_capytaine_group),
    speeds=zero_speed,
    at_depth=lambda path, depth: read_capytaine_group(path, depth=depth),
)
