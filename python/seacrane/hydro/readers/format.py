"""`Format`: one kind of hydrodynamic files, as `load_database` knows it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from seacrane.errors import FileFormatError
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.group.group import HydroGroup

Loaded = HydroDatabase | HydroGroup
SAME_SPEED = 1e-9  # m/s


class ReadAtSpeed(Protocol):
    """Reads the database or group of a speed in m/s at a path; None: the reader's own choice."""

    def __call__(self, path: Path, *, speed: float | None) -> Loaded: ...


@dataclass(frozen=True, kw_only=True)
class Format:
    """One kind of files, of one hull or of several.

    Attributes
    ----------
    name : for messages.
    files : what a path may be, in words.
    can_open : whether a path is a file, stem or folder of this kind; opens no more than it needs to tell.
    read : the database of a speed, or a FileFormatError.
    speeds : forward speeds in m/s, rising, that ``read`` takes.
    at_depth : the database of a water depth in m, of files that may hold several; None: they hold one.
    """

    name: str
    files: str
    can_open: Callable[[Path], bool]
    read: ReadAtSpeed
    speeds: Callable[[Path], tuple[float, ...]]
    at_depth: Callable[[Path, float], Loaded] | None = None


def of_one_speed(read: Callable[[Path], Loaded]) -> ReadAtSpeed:
    """A reader of files that hold one speed, which is the only one that may be asked for."""

    def checked(path: Path, *, speed: float | None) -> Loaded:
        database = read(path)
        if speed is not None and abs(database.speed - speed) > SAME_SPEED:
            raise FileFormatError(f"{path}: of {database.speed:g} m/s, not of speed {speed:g} m/s")
        return database

    return checked


def zero_speed(path: Path) -> tuple[float, ...]:
    """The speeds of files that are always of a vessel at rest."""
    return (0.0,)


def is_file_of(path: Path, suffixes: tuple[str, ...]) -> bool:
    """Whether a path is a file whose name ends in one of ``suffixes``, in either case."""
    return path.suffix.lower() in suffixes and path.is_file()
