"""MaFreDo's NetCDF form (``.dhyd``) of added mass, damping and wave loads: te, kN, phases that lag.

Groups ``mass`` and ``damping`` hold one array by omega, radiating_dof and influenced_dof; ``Surge`` to
``Yaw`` real and imaginary part of the loads by omega and wave_direction (deg, of travel); ``info`` the
symmetry and the phase origin, forward and to port of the point that loads and matrices refer to.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.reading import reading
from seacrane.hydro.readers.orcaflex_model import KILO, Raos, VesselType
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_netcdf
from seacrane.warnings import AssumedSymmetryWarning

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

MATRIX = ("omega", "influenced_dof", "radiating_dof")
SYMMETRIES = ("None", "xz plane", "yz plane", "xz and yz planes", "Circular")
WHOLE = 1e-6  # deg beyond 180 from where headings are of both sides


def read_mafredo(path: Path) -> VesselType:
    """Read a ``.dhyd`` file, which holds neither mass nor stiffness.

    Raises FileFormatError: no such form, damaged, or of different grids in its parts.
    """
    with reading(path, "a MaFreDo database", NETCDF_ERRORS), open_netcdf(path) as file:
        omega, added_mass = _matrices(file["mass"])
        again, damping = _matrices(file["damping"])
        loads = [_loads(file[motion.capitalize()]) for motion in MOTIONS]
        heading_deg, load_omega, _ = loads[0]
        if not np.array_equal(omega, again):
            raise ValueError("added mass and damping have different frequencies")
        for motion, (heading, frequency, _) in zip(MOTIONS, loads, strict=True):
            if not (np.array_equal(heading, heading_deg) and np.array_equal(frequency, load_omega)):
                raise ValueError(f"loads in {motion} and surge have different frequencies or directions")
        info = file.groups.get("info")
        at = np.array([*(_scalar(info, f"phase_origin_{axis}") for axis in (0, 1)), 0.0])
        force = np.conj(np.stack([values for _, _, values in loads], axis=-1)) * KILO
        return VesselType(
            name=path.stem,
            source=f"MaFreDo file {path.name}",
            place="reference point of the MaFreDo database",
            symmetry=_symmetry(path, info, heading_deg),
            omega=omega,
            added_mass=added_mass * KILO,
            damping=damping * KILO,
            loads=Raos(heading_deg, load_omega, force, np.zeros(3), at),
        )


def _matrices(group: Any) -> tuple[FloatArray, FloatArray]:
    """Frequencies (n,), and the group's array (n, 6, 6) with the influenced motion first."""
    found = [variable for variable in group.variables.values() if set(variable.dimensions) == set(MATRIX)]
    if len(found) != 1:
        raise ValueError(f"group {group.name} holds {len(found)} arrays by {', '.join(MATRIX)}")
    array = _by_names(found[0], MATRIX)
    rows, columns = (_motions(group[name]) for name in MATRIX[1:])
    return _numbers(group["omega"]), array[:, rows][:, :, columns]


def _motions(variable: Any) -> list[int]:
    """Places of surge to yaw along a dimension that names them by number or by word."""
    labels = [str(label).lower() for label in np.asarray(variable[...]).tolist()]
    words = MOTIONS if labels[0] in MOTIONS else tuple(str(i) for i in range(6))
    if sorted(labels) != sorted(words):
        raise ValueError(f"{variable.name} holds {', '.join(labels)[:200]}; six motions are needed")
    return [labels.index(word) for word in words]


def _loads(group: Any) -> tuple[FloatArray, FloatArray, ComplexArray]:
    """Directions (m,), frequencies (n,), loads (m, n) of one motion."""
    order = ("wave_direction", "omega")
    real, imaginary = (_by_names(group[name], order) for name in ("real", "imag"))
    return _numbers(group[order[0]]), _numbers(group[order[1]]), np.asarray(real + 1j * imaginary)


def _by_names(variable: Any, order: tuple[str, ...]) -> FloatArray:
    """A variable's numbers with its dimensions in that order."""
    axes = [variable.dimensions.index(name) for name in order]
    return np.asarray(_unmasked(variable).transpose(axes))


def _unmasked(variable: Any) -> FloatArray:
    """A variable's numbers; NaN where the file holds none, which NetCDF hands over masked."""
    return np.asarray(np.ma.filled(np.ma.asarray(variable[...]).astype(float), np.nan))


def _numbers(variable: Any) -> FloatArray:
    """A coordinate, which must be a list of finite numbers (infinity excepted for frequencies)."""
    values = np.ravel(_unmasked(variable))
    if values.size == 0 or np.any(np.isnan(values)) or np.any(np.isneginf(values)):
        raise ValueError(f"{variable.name} is empty or holds undefined values")
    return values


def _scalar(info: Any, name: str) -> float:
    if info is None or name not in info.variables:
        return 0.0
    value = float(_unmasked(info[name]))
    if not np.isfinite(value):
        raise ValueError(f"{name} is {value}")
    return value


def _symmetry(path: Path, info: Any, heading_deg: FloatArray) -> str:
    """The plane(s) of symmetry; files of old versions do not say."""
    if info is not None and "symmetry" in info.variables:
        return SYMMETRIES[int(np.asarray(info["symmetry"][...]))]
    one_side = bool(np.all(np.mod(heading_deg, 360.0) <= 180.0 + WHOLE))
    guess = "xz plane" if one_side else "None"
    warn_caller(
        f"{path}: does not say which symmetry the vessel has; with directions up to {heading_deg.max():g} "
        f"deg {guess!r} is taken, and loads from the other side follow from that guess",
        AssumedSymmetryWarning,
    )
    return guess
