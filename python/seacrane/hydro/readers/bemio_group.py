"""Reader of BEMIO's HDF5 files of several bodies; axes, scales and phases as in `read_bemio`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.data.group_body import GroupBody
from seacrane.hydro.group.group import HydroGroup
from seacrane.hydro.readers.as_read import as_read, frequencies_kept
from seacrane.hydro.readers.band_of_data import with_band_of_group
from seacrane.hydro.readers.bemio import (
    HDF5,
    PARAMETERS,
    bodies_in,
    from_bemio,
    is_bemio,
    number_of,
    values_of,
    water_in,
)
from seacrane.hydro.readers.format import Format, is_file_of, of_one_speed, zero_speed
from seacrane.hydro.readers.of_bodies import box_of, group_symmetric, of_each, require_own_hydrostatics
from seacrane.hydro.readers.usual_inertia import usual_mass_matrix
from seacrane.hydro.readers.wave_directions import rising_directions

FloatArray = NDArray[np.float64]


def read_bemio_group(
    path: str | PathLike[str],
    *,
    mass_matrices: Mapping[str, ArrayLike] | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> HydroGroup:
    """Read a BEMIO file (HDF5) of several bodies with six motions each.

    Parameters
    ----------
    path : file.
    mass_matrices : by body, (6, 6) in SI about its centre of gravity. The file holds none; by default the
        displaced masses with usual radii of gyration.
    motions : names of those that were solved for, where some were not: a motion without added mass and
        damping is refused unless it is left out here.
    leave_out : rad/s of frequencies to do without, such as those at which a solution failed.

    Returns
    -------
    HydroGroup : each body about its centre of gravity, named as in the file, in its order. Lengths, breadths
        and draughts are those of the equivalent boxes.

    Warns
    -----
    AssumedInertiaWarning : no ``mass_matrices``.

    Raises
    ------
    FileFormatError : the file is missing, damaged, of one body, or no BEMIO file; the message names the
        entry.
    """
    source = Path(path)
    found = from_bemio(
        source,
        lambda file: as_read(
            source, "read_bemio_group", _convert(source, file, mass_matrices, leave_out), motions
        ),
    )
    require_own_hydrostatics(source, found, "a file that was written anew")
    return with_band_of_group(found)


def _convert(
    path: Path, file: Any, masses: Mapping[str, ArrayLike] | None, leave_out: ArrayLike | None
) -> HydroGroup:
    entries = bodies_in(file)
    rho, g, depth = water_in(path, file)
    names = _names(file, entries)
    given = None if masses is None else of_each(path, "mass_matrices", names, masses, (6, 6))
    omega = np.ravel(values_of(path, file, f"{PARAMETERS}/w"))
    order = np.argsort(omega)
    raw = np.radians(np.ravel(values_of(path, file, f"{PARAMETERS}/wave_dir")))
    direction, places = rising_directions(raw)
    n, m, size = len(omega), len(raw), 6 * len(entries)
    added_mass, damping = np.zeros((n, size, size)), np.zeros((n, size, size))
    infinite, force = np.zeros((size, size)), np.zeros((len(direction), n, size), dtype=complex)
    bodies = []
    for i, (entry, name) in enumerate(zip(entries, names, strict=True)):
        of, at = f"{entry}/hydro_coeffs", slice(6 * i, 6 * i + 6)
        a = values_of(path, file, f"{of}/added_mass/all", (6, size, n))
        b = values_of(path, file, f"{of}/radiation_damping/all", (6, size, n)) * omega
        added_mass[:, at], damping[:, at] = (
            rho * a.transpose(2, 0, 1)[order],
            rho * b.transpose(2, 0, 1)[order],
        )
        infinite[at] = rho * values_of(path, file, f"{of}/added_mass/inf_freq", (6, size))
        real, imaginary = (
            values_of(path, file, f"{of}/excitation/{part}", (6, m, n)) for part in ("re", "im")
        )
        force[:, :, at] = rho * g * (real + 1j * imaginary).transpose(1, 2, 0)[places][:, order]
        bodies.append(_body(path, file, entry, name, rho, g, None if given is None else given[i]))
    tables = {"added_mass": added_mass, "damping": damping, "force": force}
    kept = frequencies_kept(path, "read_bemio_group", omega[order], tables, leave_out)
    return HydroGroup(
        name=path.stem,
        bodies=tuple(bodies),
        omega=omega[order][kept],
        heading=direction,
        added_mass=added_mass[kept],
        damping=damping[kept],
        infinite_frequency_added_mass=infinite,
        force=force[:, kept],
        rho=rho,
        g=g,
        depth=depth,
        port_starboard_symmetric=group_symmetric(bodies, added_mass[kept]),
        origin="origin of BEMIO's axes, on the still waterline",
        source=f"BEMIO file {path.name}",
    )


def _names(file: Any, entries: list[str]) -> list[str]:
    """Names that the file gives its bodies, each once; those of the entries where that is not so."""
    names = []
    for entry in entries:
        place = f"{entry}/properties/name"
        value = file[place][()] if place in file else b""
        names.append(value.decode("utf-8", "replace").strip() if isinstance(value, bytes) else "")
    return names if all(names) and len(set(names)) == len(names) else entries


def _body(
    path: Path, file: Any, entry: str, name: str, rho: float, g: float, mass: FloatArray | None
) -> GroupBody:
    stiffness = values_of(path, file, f"{entry}/hydro_coeffs/linear_restoring_stiffness", (6, 6))
    restoring = rho * g * stiffness
    volume = number_of(path, file, f"{entry}/properties/disp_vol")
    centre = np.ravel(values_of(path, file, f"{entry}/properties/cg"))
    if len(centre) != 3:
        raise FileFormatError(f"{path}: {entry}/properties/cg has {len(centre)} values; three are needed")
    box = box_of(path, name, restoring, volume, rho * g)
    if mass is None:
        mass = usual_mass_matrix(
            path,
            f"a BEMIO file holds no mass matrix of {name}, give read_bemio_group(mass_matrices=...)",
            mass=rho * volume,
            centre=np.zeros(3),
            length=box["length"],
            breadth=box["breadth"],
        )
    return GroupBody(
        name=name,
        position=centre,
        mass_matrix=mass,
        restoring=restoring,
        **box,
    )


def _can_open(path: Path) -> bool:
    return is_file_of(path, HDF5) and is_bemio(path) and len(from_bemio(path, bodies_in)) > 1


FORMAT = Format(
    name="BEMIO",
    files="an HDF5 file (.h5) of BEMIO",
    can_open=_can_open,
    read=of_one_speed(read_bemio_group),
    speeds=zero_speed,
)
