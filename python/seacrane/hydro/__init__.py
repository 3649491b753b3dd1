"""Hydrodynamics of the vessel: databases, their readers and self-check, fluid memory."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from os import PathLike
from pathlib import Path

from seacrane.errors import FileFormatError
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
from seacrane.hydro.veres import find_stem, read_veres
from seacrane.hydro.vessel import (
    MemoryFitWarning,
    RigidPart,
    RollDampingWarning,
    VesselParameters,
    rigid_mass_matrix,
    vessel_parameters,
)

__all__ = [
    "AdditionalMatrices",
    "CheckRow",
    "FitRow",
    "HydroDatabase",
    "MemoryBlock",
    "MemoryFitWarning",
    "MemoryModel",
    "MemoryTradeRow",
    "Passivity",
    "PassivityCertificate",
    "PassivityError",
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
    "read_veres",
    "require_passive",
    "rigid_mass_matrix",
    "shipped_database",
    "vessel_parameters",
]

NETCDF = (".nc", ".nc4")
SUPPORTED = "a seacrane NetCDF file (.nc), or a ShipX/VERES folder, stem or file (.re7 with .re8 and .re1)"


def load_database(path: str | PathLike[str]) -> HydroDatabase:
    """Read a hydrodynamic database of any supported kind: our NetCDF, or ShipX/VERES (folder, stem or file).

    Raises
    ------
    FileFormatError : nothing readable at ``path``; the message names the file, the line where there is one,
        and the supported kinds.
    """
    source = Path(path)
    if source.is_dir():
        return _load_folder(source)
    if source.is_file() and source.suffix.lower() in NETCDF:
        return HydroDatabase.load(source)
    if _is_veres(source):
        return read_veres(source)
    problem = "not of a known kind" if source.exists() else "no such file"
    raise FileFormatError(f"{source}: {problem}; supported: {SUPPORTED}")


def _load_folder(folder: Path) -> HydroDatabase:
    """The one database that a folder holds."""
    suffixes = {file.suffix.lower() for file in folder.iterdir()}
    if suffixes & {".re7", ".re8"}:
        return read_veres(folder)
    files = sorted(file for file in folder.iterdir() if file.suffix.lower() in NETCDF)
    if len(files) == 1:
        return HydroDatabase.load(files[0])
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
