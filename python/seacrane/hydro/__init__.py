"""Hydrodynamics of the vessel: databases, their readers and self-check, fluid memory."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from os import PathLike
from pathlib import Path

from seacrane.errors import FileFormatError
from seacrane.hydro.capytaine import is_capytaine, read_capytaine
from seacrane.hydro.certificate import (
    PassivityCertificate,
    PassivityError,
    passivity_certificate,
    require_passive,
)
from seacrane.hydro.check import CheckRow, memory_rows
from seacrane.hydro.database import AdditionalMatrices, HydroDatabase, RollDamping
from seacrane.hydro.memory import fit_memory
from seacrane.hydro.memory_model import FitRow, MemoryBlock, MemoryModel, Passivity
from seacrane.hydro.memory_trade import MemoryTradeRow, memory_trade
from seacrane.hydro.motion import motion_response, natural_frequency
from seacrane.hydro.retardation import RetardationModel, retardation_functions
from seacrane.hydro.veres import find_stem, read_veres
from seacrane.hydro.vessel import (
    MemoryFitWarning,
    RigidPart,
    RollDampingWarning,
    VesselParameters,
    rigid_mass_matrix,
    vessel_parameters,
)
from seacrane.hydro.wamit import (
    AssumedDensityWarning,
    AssumedInertiaWarning,
    PartialSetWarning,
    is_wamit,
    read_wamit,
)

__all__ = [
    "AdditionalMatrices",
    "AssumedDensityWarning",
    "AssumedInertiaWarning",
    "CheckRow",
    "FitRow",
    "HydroDatabase",
    "MemoryBlock",
    "MemoryFitWarning",
    "MemoryModel",
    "MemoryTradeRow",
    "PartialSetWarning",
    "Passivity",
    "PassivityCertificate",
    "PassivityError",
    "RetardationModel",
    "RigidPart",
    "RollDamping",
    "RollDampingWarning",
    "VesselParameters",
    "fit_memory",
    "load_database",
    "memory_rows",
    "memory_trade",
    "motion_response",
    "natural_frequency",
    "passivity_certificate",
    "read_capytaine",
    "read_veres",
    "read_wamit",
    "require_passive",
    "retardation_functions",
    "rigid_mass_matrix",
    "shipped_database",
    "vessel_parameters",
]

NETCDF = (".nc", ".nc4")
SUPPORTED = (
    "a NetCDF file (.nc) of seacrane or Capytaine, a ShipX/VERES folder, stem or file (.re7 with .re8 and "
    ".re1), or a WAMIT folder, stem or file (.1 .3 .hst .out, with .4 and .frc)"
)


def load_database(path: str | PathLike[str]) -> HydroDatabase:
    """Read a hydrodynamic database of any supported kind.

    NetCDF of seacrane or Capytaine (told apart by content), ShipX/VERES or WAMIT (folder, stem or any file of
    the set).

    Raises
    ------
    FileFormatError : nothing readable at ``path``; the message names the file, the line where there is one,
        and the supported kinds.
    """
    source = Path(path)
    if source.is_dir():
        return _load_folder(source)
    if source.is_file() and source.suffix.lower() in NETCDF:
        return _load_netcdf(source)
    if _is_veres(source):
        return read_veres(source)
    if is_wamit(source):
        return read_wamit(source)
    problem = "not of a known kind" if source.exists() else "no such file"
    raise FileFormatError(f"{source}: {problem}; supported: {SUPPORTED}")


def _load_netcdf(file: Path) -> HydroDatabase:
    """Capytaine's dataset, or else ours."""
    return read_capytaine(file) if is_capytaine(file) else HydroDatabase.load(file)


def _load_folder(folder: Path) -> HydroDatabase:
    """The one database that a folder holds."""
    suffixes = {file.suffix.lower() for file in folder.iterdir()}
    veres, wamit = bool(suffixes & {".re7", ".re8"}), is_wamit(folder)
    if veres and wamit:
        raise FileFormatError(f"{folder}: the folder holds VERES and WAMIT files; name one of them")
    if veres:
        return read_veres(folder)
    if wamit:
        return read_wamit(folder)
    files = sorted(file for file in folder.iterdir() if file.suffix.lower() in NETCDF)
    if len(files) == 1:
        return _load_netcdf(files[0])
    found = "several NetCDF files, name one" if files else "nothing of a known kind"
    raise FileFormatError(f"{folder}: the folder holds {found}; supported: {SUPPORTED}")


def _is_veres(path: Path) -> bool:
    """Whether a .re7 or .re8 file belongs to the stem of ``path``."""
    stem = find_stem(path)
    names = [stem.name + suffix for suffix in (".re7", ".RE7", ".re8", ".RE8")]
    return any((stem.parent / name).is_file() for name in names)


@cache
def shipped_database() -> HydroDatabase:
    """The database of the 115 m hull that comes with the package, memory included; read once, immutable."""
    return HydroDatabase.load(Path(str(files("seacrane") / "data" / "hull_115.nc")))
