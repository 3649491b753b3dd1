"""`shipped_database`: the hull that comes with the package."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from pathlib import Path

from seacrane.hydro.database.database import HydroDatabase
from seacrane.inputs.keywords import named


@named
@cache
def shipped_database() -> HydroDatabase:
    """The database of the 115 m hull that comes with the package, memory included; read once, immutable."""
    return HydroDatabase.load(Path(str(files("seacrane") / "data" / "hull_115.nc")))
