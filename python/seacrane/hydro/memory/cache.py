"""Fitted memory models that were made before: of this process, of the package, and in a folder on disk.

A model is known by a digest of all that its fit looks at: the database's numbers, the settings of the fit,
and the version of the fit. The package holds that of the shipped hull. The folder is
``~/.cache/seacrane/memory`` (``$XDG_CACHE_HOME/seacrane/memory`` where that is set). ``SEACRANE_CACHE``
names another one, and ``SEACRANE_CACHE=off`` keeps nothing on disk. Files are written atomically, and one
that cannot be read is made anew.
"""

from __future__ import annotations

import hashlib
import json
import os
import zipfile
import zlib
from dataclasses import asdict, dataclass, fields
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.files.atomic import atomic_write
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.memory_model import (
    FitRow,
    MemoryBlock,
    MemoryModel,
    MotionError,
    MotionFit,
    Passivity,
)

VERSION = 2  # raised with every change of a fit
VARIABLE, OFF = "SEACRANE_CACHE", "off"
MOST_BYTES = 10_000_000
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
BLOCK_ARRAYS = ("outputs", "inputs", "A", "B", "C", "D", "state_scale")
MATRICES = ("added_mass", "additional_added_mass", "additional_stiffness")

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
    named = os.environ.get(VARIABLE)
    if named is not None and named.strip().lower() in ("", OFF):
        return None
    if named is not None:
        return Path(named) / "memory"
    base = os.environ.get("XDG_CACHE_HOME")
    try:
        return (Path(base) if base else Path.home() / ".cache") / "seacrane" / "memory"
    except RuntimeError:  # there is no home
        return None


def shipped_folder() -> Path:
    """Models that come with the package; `tools/ship_memory.py` writes them."""
    return Path(str(files("seacrane") / "data" / "memory"))


def kept_fit(database: HydroData, settings: FitSettings) -> MemoryModel | None:
    """The model that this fit gave before, or None."""
    name = digest(database, settings)
    if name in _of_process:
        return _of_process[name]
    for folder in (shipped_folder(), cache_folder()):
        if folder is None:
            continue
        try:
            model = _read(folder / f"{name}.npz")
        except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile, zlib.error):
            continue
        return _of_process.setdefault(name, model)
    return None


def keep_fit(database: HydroData, settings: FitSettings, model: MemoryModel) -> None:
    """Keep a model for the next time; a folder that cannot be written is passed over."""
    name = digest(database, settings)
    _of_process[name] = model
    folder = cache_folder()
    if folder is None:
        return
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with atomic_write(folder / f"{name}.npz") as draft, draft.open("wb") as file:
            np.savez(file, **_arrays(model))
    except OSError:
        return


def digest(database: HydroData, settings: FitSettings) -> str:
    """Of everything that a fit depends on, as hexadecimal text."""
    parts = hashlib.sha256(json.dumps([VERSION, asdict(settings)]).encode())
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


def _arrays(model: MemoryModel) -> dict[str, Any]:
    head: dict[str, Any] = {
        "band": model.band,
        "r2": model.r2,
        "rows": [asdict(row) for row in model.rows],
        "passivity": asdict(model.passivity),
        "causes": [block.cause for block in model.blocks],
    }
    out: dict[str, Any] = {name: getattr(model, name) for name in MATRICES}
    if model.motion is not None:
        motion = model.motion
        head["motion"] = {"limit": motion.limit, "floor": motion.floor, "left_out": motion.left_out}
        out["seas"], out["peaks"] = motion.error.seas, motion.error.peaks
    for i, block in enumerate(model.blocks):
        out |= {f"{i}_{name}": getattr(block, name) for name in BLOCK_ARRAYS}
    return out | {"head": np.frombuffer(json.dumps(head).encode(), dtype=np.uint8)}


def _read(path: Path) -> MemoryModel:
    if path.stat().st_size > MOST_BYTES:
        raise ValueError("too large for a memory model")
    with path.open("rb") as stream, np.load(stream) as file:
        arrays = {name: file[name] for name in file.files}
    head = json.loads(arrays["head"].tobytes())
    motion = head.get("motion")
    return MemoryModel(
        blocks=tuple(
            MemoryBlock(cause=cause, **{name: arrays[f"{i}_{name}"] for name in BLOCK_ARRAYS})
            for i, cause in enumerate(head["causes"])
        ),
        **{name: arrays[name] for name in MATRICES},
        band=(float(head["band"][0]), float(head["band"][1])),
        r2=float(head["r2"]),
        rows=tuple(FitRow(**row) for row in head["rows"]),
        passivity=Passivity(**head["passivity"]),
        motion=None
        if motion is None
        else MotionFit(
            limit=float(motion["limit"]),
            error=MotionError(seas=arrays["seas"], peaks=arrays["peaks"]),
            floor=float(motion["floor"]),
            left_out=tuple((int(j), int(k)) for j, k in motion["left_out"]),
        ),
    )
