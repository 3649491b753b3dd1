"""Reader of BEMIO's HDF5 files, into which WEC-Sim turns results of NEMOH, AQWA, WAMIT and Capytaine.

Its axes and its time factor exp(+i omega t) are ours; headings are degrees of travel. Values are without
density and gravity (WEC-Sim documentation, "BEMIO"): A / rho, B / (rho omega), C / (rho g), F / (rho g).
They refer to the centres of gravity, waves have zero phase at the origin. A vessel alone is moved to the
still waterline above its centre of gravity.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.hydro.data.frozen import reading
from seacrane.hydro.readers.as_read import Asked, Given, left_out, rising_directions
from seacrane.hydro.readers.format import Format, Loaded, is_file_of, is_kind
from seacrane.hydro.readers.of_bodies import floating_body, hull_or_group, of_each
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_hdf5

HDF5 = (".h5", ".hdf5")
PARAMETERS = "simulation_parameters"
STIFFNESS = "hydro_coeffs/linear_restoring_stiffness"
READ = re.compile(  # of a body, and what says the same again
    r"properties/(cg|disp_vol|name|body_number)$|hydro_coeffs/(linear_restoring_stiffness|added_mass/(all|inf_freq)"
    r"|radiation_damping/all|excitation/(re|im|mag|phase)|[a-z_]+/components)"
)
DEEP = (b"infinite", b"inf", b"infinity")


def read_bemio(
    path: str | PathLike[str],
    *,
    mass_matrix: Given | None = None,
    motions: Sequence[str] | None = None,
    leave_out: ArrayLike | None = None,
) -> Loaded:
    """Read a BEMIO file (HDF5) of one body or of several, with six motions each.

    Parameters
    ----------
    path : file.
    mass_matrix : (6, 6) in SI about the centre of gravity; of several bodies by name. The file holds none.
    motions, leave_out : as `read_capytaine` takes them.

    Returns
    -------
    HydroDatabase : of one body, about the point of the still waterline above its centre of gravity.
        Port-starboard symmetric if the added mass is, to 2 %.
    HydroGroup : of several, each about its centre of gravity, named as in the file, in its order.
        Lengths, breadths and draughts are those of the equivalent boxes.

    Raises
    ------
    FileFormatError : the file is missing, damaged, or no BEMIO file; the message names the entry.
    """
    source = Path(path)
    asked = Asked(
        where=source, reader="read_bemio", mass_matrix=mass_matrix, motions=motions, leave_out=leave_out
    )
    with reading(source, "a BEMIO file", NETCDF_ERRORS), open_hdf5(source) as file:
        return _convert(asked, file)


def is_bemio(path: Path) -> bool:
    """Whether an HDF5 file holds results by BEMIO's names."""
    return is_kind(open_hdf5(path), lambda file: PARAMETERS in file and "body1" in file)


def _convert(asked: Asked, file: Any) -> Loaded:
    path = asked.where
    entries = sorted(
        (name for name in file if re.fullmatch(r"body\d{1,3}", name)), key=lambda one: int(one[4:])
    )
    if not entries:
        raise FileFormatError(f"{path}: holds no body; write the whole BEMIO file")
    if f"{PARAMETERS}/scaled" in file and _number(path, file, f"{PARAMETERS}/scaled") != 0.0:
        raise FileFormatError(f"{path}: scaled is set, values have density and gravity in; write it unscaled")
    rho, g, depth = (_number(path, file, f"{PARAMETERS}/{name}") for name in ("rho", "g", "water_depth"))
    names = _names(file, entries)
    masses = of_each(asked, "mass_matrix", names, asked.mass_matrix)
    omega = np.ravel(_values(path, file, f"{PARAMETERS}/w"))
    raw = np.radians(np.ravel(_values(path, file, f"{PARAMETERS}/wave_dir")))
    direction, places = rising_directions(raw)
    n, m, size = len(omega), len(raw), 6 * len(entries)

    def of_all(name: str, *shape: int) -> Array:
        """An entry's rows of every body."""
        every = [f"{entry}/hydro_coeffs/{name}" for entry in entries]
        return np.concatenate([_values(path, file, one, (6, *shape)) for one in every])

    bodies = [
        floating_body(
            asked, name, several=len(entries) > 1, water=(rho, g), mass=mass,
            restoring=rho * g * _values(path, file, f"{entry}/{STIFFNESS}", (6, 6)),
            volume=_number(path, file, f"{entry}/properties/disp_vol"),
            position=_values(path, file, f"{entry}/properties/cg").reshape(3),
        )
        for entry, name, mass in zip(entries, names, masses, strict=True)
    ]  # fmt: skip
    waves = of_all("excitation/re", m, n) + 1j * of_all("excitation/im", m, n)
    x, y, z = bodies[0].position
    above = f"above the centre of gravity, which BEMIO has at ({x:g}, {y:g}, {z:g}) m"
    return hull_or_group(
        asked, bodies, fix="a file that was written anew", at=(0.0, 0.0, -z), name=path.stem,
        alone={"origin": f"on the still waterline, {above}"},
        origin="origin of BEMIO's axes, on the still waterline",
        source=f"BEMIO file {path.name}{'' if len(entries) > 1 else f', {entries[0]}'}"
        + left_out(_unread(file, entries)),
        rho=rho, g=g, depth=depth, omega=omega, heading=direction,
        force=np.asarray(rho * g * waves.transpose(1, 2, 0)[places], dtype=complex),
        added_mass=rho * of_all("added_mass/all", size, n).transpose(2, 0, 1),
        infinite_frequency_added_mass=rho * of_all("added_mass/inf_freq", size),
        damping=rho * (of_all("radiation_damping/all", size, n) * omega).transpose(2, 0, 1),
    )  # fmt: skip


def _unread(file: Any, entries: list[str]) -> list[str]:
    """Kinds of arrays of the bodies that nothing is read of."""
    found: list[str] = []
    for entry in entries:
        file[entry].visititems(lambda name, one: found.append(name) if hasattr(one, "shape") else None)
    parts = (name.removeprefix("hydro_coeffs/").split("/") for name in found if not READ.match(name))
    return list(dict.fromkeys("/".join(part[:2]) for part in parts))


def _names(file: Any, entries: list[str]) -> list[str]:
    """Names that the file gives its bodies, each once; those of the entries where that is not so."""
    names = []
    for entry in entries:
        place = f"{entry}/properties/name"
        value = file[place][()] if place in file else b""
        names.append(value.decode("utf-8", "replace").strip() if isinstance(value, bytes) else "")
    return names if all(names) and len(set(names)) == len(names) else entries


def _values(path: Path, file: Any, name: str, shape: tuple[int, ...] | None = None) -> Array:
    """An entry's numbers; of a shape."""
    if name not in file:
        raise FileFormatError(f"{path}: {name} is missing; write the whole BEMIO file")
    values = np.asarray(file[name][()], dtype=float)
    if shape is not None and values.shape != shape:
        raise FileFormatError(
            f"{path}: {name} has shape {values.shape}; {shape} is needed, of six motions for each body"
        )
    return values


def _number(path: Path, file: Any, name: str) -> float:
    """An entry of one number, or of the word with which BEMIO says that water is deep."""
    if name in file and isinstance(word := file[name][()], bytes):
        if word.strip().lower() in DEEP:
            return np.inf
        raise FileFormatError(f"{path}: {name} is {word[:40]!r}; a number is needed")
    values = np.ravel(_values(path, file, name))
    if values.size != 1:
        raise FileFormatError(f"{path}: {name} has {values.size} values; one is needed")
    return float(values[0])


FORMAT = Format(
    name="BEMIO",
    files="an HDF5 file (.h5) of BEMIO",
    looks="groups `simulation_parameters` and `body1`",
    can_open=lambda path: is_file_of(path, HDF5) and is_bemio(path),
    read=read_bemio,
    takes=("mass_matrix",),
)
