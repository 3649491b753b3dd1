"""Hydrodynamics of the vessel: databases, their readers and self-check, fluid memory."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from os import PathLike
from pathlib import Path

from seacrane.errors import FileFormatError
from seacrane.hydro.database.check import CheckRow, memory_rows
from seacrane.hydro.database.data_warnings import (
    DampingWarning,
    HeadingGapWarning,
    WaterMismatchWarning,
    warn_of_data,
)
from seacrane.hydro.database.database import AdditionalMatrices, HydroDatabase, RollDamping
from seacrane.hydro.database.drift import DriftCoefficients
from seacrane.hydro.database.motion import motion_response, natural_frequency
from seacrane.hydro.database.transform import QuadraticDampingWarning
from seacrane.hydro.hull.by_strip_theory import SubmergedPartWarning
from seacrane.hydro.hull.hull import Hull
from seacrane.hydro.hull.hull_database import FloatingPositionWarning, hydro_from_hull
from seacrane.hydro.hull.hydrostatics import Hydrostatics
from seacrane.hydro.hull.offsets import OffsetTable, read_offset_table
from seacrane.hydro.hull.parametric_hull import ParametricHull
from seacrane.hydro.hull.stl import read_stl
from seacrane.hydro.memory.audit import MemoryMismatchWarning, NonPassiveMemoryWarning
from seacrane.hydro.memory.certificate import (
    PassivityCertificate,
    PassivityError,
    passivity_certificate,
    require_passive,
)
from seacrane.hydro.memory.fit import InfiniteFrequencyWarning, fit_memory
from seacrane.hydro.memory.model import FitRow, MemoryBlock, MemoryModel, Passivity
from seacrane.hydro.memory.retardation import RetardationModel, retardation_functions
from seacrane.hydro.memory.trade import MemoryTradeRow, memory_trade
from seacrane.hydro.readers.capytaine import is_capytaine, read_capytaine
from seacrane.hydro.readers.orcaflex import read_orcaflex
from seacrane.hydro.readers.reader_warnings import (
    AssumedDensityWarning,
    AssumedInertiaWarning,
    AssumedSymmetryWarning,
    EncounterFrequencyWarning,
    HydrostaticsWarning,
    PartialSetWarning,
    SeveralSpeedsWarning,
)
from seacrane.hydro.readers.veres import read_veres
from seacrane.hydro.readers.veres_hydrostatics import VeresHydrostatics, read_veres_hydrostatics
from seacrane.hydro.readers.veres_set import find_stem, veres_speeds
from seacrane.hydro.readers.wamit import is_wamit, read_wamit
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
    "AssumedDensityWarning",
    "AssumedInertiaWarning",
    "AssumedSymmetryWarning",
    "CheckRow",
    "DampingWarning",
    "DriftCoefficients",
    "EncounterFrequencyWarning",
    "FitRow",
    "FloatingPositionWarning",
    "HeadingGapWarning",
    "Hull",
    "HydroDatabase",
    "Hydrostatics",
    "HydrostaticsWarning",
    "InfiniteFrequencyWarning",
    "MemoryBlock",
    "MemoryFitWarning",
    "MemoryMismatchWarning",
    "MemoryModel",
    "MemoryTradeRow",
    "NonPassiveMemoryWarning",
    "OffsetTable",
    "ParametricHull",
    "PartialSetWarning",
    "Passivity",
    "PassivityCertificate",
    "PassivityError",
    "QuadraticDampingWarning",
    "RetardationModel",
    "RigidPart",
    "RollDamping",
    "RollDampingWarning",
    "SeveralSpeedsWarning",
    "SubmergedPartWarning",
    "VeresHydrostatics",
    "VesselParameters",
    "WaterMismatchWarning",
    "available_speeds",
    "fit_memory",
    "hydro_from_hull",
    "load_database",
    "memory_rows",
    "memory_trade",
    "motion_response",
    "natural_frequency",
    "passivity_certificate",
    "read_capytaine",
    "read_offset_table",
    "read_orcaflex",
    "read_stl",
    "read_veres",
    "read_veres_hydrostatics",
    "read_wamit",
    "require_passive",
    "retardation_functions",
    "rigid_mass_matrix",
    "shipped_database",
    "vessel_parameters",
]

NETCDF = (".nc", ".nc4")
ORCAFLEX = (".yml", ".yaml", ".dhyd")
SUPPORTED = (
    "a NetCDF file (.nc) of seacrane or Capytaine, a ShipX/VERES folder, stem or file (.re7 with .re8, .re1, "
    ".re2, .hyd), a WAMIT folder, stem or file (.1 .3 .hst .out, with .4 and .frc), or an OrcaFlex model "
    "(.yml) or MaFreDo file (.dhyd)"
)


def load_database(path: str | PathLike[str], *, speed: float | None = None) -> HydroDatabase:
    """Read a hydrodynamic database of any supported kind.

    NetCDF of seacrane or Capytaine (told apart by content), ShipX/VERES or WAMIT (folder, stem or any file of
    the set), OrcaFlex (a text model, or MaFreDo's form).

    Parameters
    ----------
    path : file, folder or stem.
    speed : forward speed in m/s, for VERES files that hold several (`available_speeds`); by default the one
        nearest to zero.

    Raises
    ------
    FileFormatError : nothing readable at ``path``, or not of that speed; the message names the file, the line
        where there is one, and the supported kinds.

    Warns
    -----
    DampingWarning, HeadingGapWarning, WaterMismatchWarning : what was read will give wrong motions.
    """
    database = _load(Path(path), speed)
    warn_of_data(database)
    return database


def _load(source: Path, speed: float | None) -> HydroDatabase:
    kind = _kind(source)
    if kind == "veres":
        return read_veres(source, speed=speed)
    database = _READERS[kind](_only_file(source))
    if speed is not None and abs(database.speed - speed) > 1e-9:
        raise FileFormatError(f"{source}: of {database.speed:g} m/s, not of speed {speed:g} m/s")
    return database


def available_speeds(path: str | PathLike[str]) -> tuple[float, ...]:
    """Forward speeds in m/s, rising, that `load_database` can read at ``path``.

    Raises
    ------
    FileFormatError : as `load_database`.
    """
    source = Path(path)
    kind = _kind(source)
    if kind == "veres":
        return veres_speeds(source)
    return (HydroDatabase.load(_only_file(source)).speed,) if kind == "seacrane" else (0.0,)


def _kind(source: Path) -> str:
    """Name of the reader for ``source``, a key of ``_READERS`` or "veres"."""
    if source.is_dir():
        return _kind_of_folder(source)
    suffix = source.suffix.lower()
    if source.is_file() and suffix in NETCDF:
        return "capytaine" if is_capytaine(source) else "seacrane"
    if source.is_file() and suffix in ORCAFLEX:
        return "orcaflex"
    if _is_veres(source):
        return "veres"
    if is_wamit(source):
        return "wamit"
    problem = "not of a known kind" if source.exists() else "no such file"
    raise FileFormatError(f"{source}: {problem}; supported: {SUPPORTED}")


def _kind_of_folder(folder: Path) -> str:
    """Name of the reader for the one database that a folder holds."""
    suffixes = {file.suffix.lower() for file in folder.iterdir()}
    veres, wamit = bool(suffixes & {".re7", ".re8"}), is_wamit(folder)
    if veres and wamit:
        raise FileFormatError(f"{folder}: the folder holds VERES and WAMIT files; name one of them")
    if veres or wamit:
        return "veres" if veres else "wamit"
    return _kind(_only_file(folder))


def _only_file(source: Path) -> Path:
    """The one file of a kind that stands alone in a folder; anything but a folder of such as it is."""
    if not source.is_dir() or is_wamit(source):
        return source
    for suffixes in (NETCDF, ORCAFLEX):
        files = sorted(
            file for file in source.iterdir() if file.is_file() and file.suffix.lower() in suffixes
        )
        if len(files) == 1:
            return files[0]
        if files:
            names = ", ".join(file.name for file in files[:5])
            raise FileFormatError(f"{source}: the folder holds several files ({names}), name one of them")
    raise FileFormatError(f"{source}: the folder holds nothing of a known kind; supported: {SUPPORTED}")


_READERS = {
    "seacrane": HydroDatabase.load,
    "capytaine": read_capytaine,
    "wamit": read_wamit,
    "orcaflex": read_orcaflex,
}


def _is_veres(path: Path) -> bool:
    """Whether a .re7 or .re8 file belongs to the stem of ``path``."""
    stem = find_stem(path)
    names = [stem.name + suffix for suffix in (".re7", ".RE7", ".re8", ".RE8")]
    return any((stem.parent / name).is_file() for name in names)


@cache
def shipped_database() -> HydroDatabase:
    """The database of the 115 m hull that comes with the package, memory included; read once, immutable."""
    return HydroDatabase.load(Path(str(files("seacrane") / "data" / "hull_115.nc")))
