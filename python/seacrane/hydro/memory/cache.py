"""Fitted memory models that were made before: of this process, of the package, and in a folder on disk.

A model is known by a digest of all that its fit looks at: the database's numbers, the settings of the fit,
and the version of the fit. The package holds that of the shipped hull. The folder is ``memory`` of the
user's cache (`seacrane.inputs.user_cache`). A file that cannot be read is made anew.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass, fields
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.hydro.data.hydro_group_data import Hydrodynamics
from seacrane.hydro.data.memory_model import MemoryModel
from seacrane.hydro.data.packed import NOT_PACKED, packed, unpacked
from seacrane.hydro.memory.motion_judge import SHIP, length_of, peak_periods
from seacrane.inputs.user_cache import keep_file, read_kept, user_cache

VERSION = 2  # raised with every change of a fit
USED = (
    "omega",
    "heading",
    "added_mass",
    "damping",
    "restoring",
    "mass_matrix",
    "force",
    "infinite_frequency_added_mass",
    "linear_damping",
    "port_starboard_symmetric",
)
SUFFIX = ".memory"

_of_process: dict[str, MemoryModel] = {}


@dataclass(frozen=True, kw_only=True)
class FitSettings:
    """What a fit was asked: ``target`` is the R2 or the limit, ``known`` whether A_inf was given."""

    kind: str
    band: tuple[float, float]
    target: float
    known: bool


def cache_folder() -> Path | None:
    """Where models are kept; None where nothing is kept on disk."""
    return user_cache("memory")


def shipped_folder() -> Path:
    """Models that come with the package; `tools/ship_memory.py` writes them."""
    return Path(str(files("seacrane") / "data" / "memory"))


def kept_fit(database: Hydrodynamics, settings: FitSettings) -> MemoryModel | None:
    """The model that this fit gave before, or None."""
    name = digest(database, settings)
    if name in _of_process:
        return _of_process[name]
    for folder in (shipped_folder(), cache_folder()):
        if folder is None:
            continue
        try:
            model = _read(folder / f"{name}{SUFFIX}")
        except (OSError, *NOT_PACKED):
            continue
        return _of_process.setdefault(name, model)
    return None


def keep_fit(database: Hydrodynamics, settings: FitSettings, model: MemoryModel) -> None:
    """Keep a model for the next time; a folder that cannot be written is passed over."""
    name = digest(database, settings)
    _of_process[name] = model
    keep_file(cache_folder(), f"{name}{SUFFIX}", packed(model))


def digest(database: Hydrodynamics, settings: FitSettings) -> str:
    """The digest of everything that a fit depends on, as hexadecimal text."""
    parts = hashlib.sha256(json.dumps([VERSION, asdict(settings)]).encode())
    length = length_of(database)
    if length < SHIP:  # whose fit is judged in seas of its own
        parts.update(peak_periods(length).tobytes())
    for name in USED:
        _add(parts, name, getattr(database, name))
    if database.roll_damping is not None:
        for entry in fields(database.roll_damping):
            _add(parts, entry.name, getattr(database.roll_damping, entry.name))
    for part in database.additional:
        for name in ("cause", "added_mass", "damping", "restoring"):
            _add(parts, name, getattr(part, name))
    return parts.hexdigest()


def _add(parts: Any, name: str, value: Any) -> None:
    array = np.asarray("none" if value is None else value)
    parts.update(f"{name} {array.dtype} {array.shape} ".encode())
    parts.update(np.ascontiguousarray(array).tobytes())


def _read(path: Path) -> MemoryModel:
    model: MemoryModel = unpacked(read_kept(path), (MemoryModel,))
    return model
