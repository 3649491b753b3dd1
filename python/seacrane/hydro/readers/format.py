"""`Format`: one kind of hydrodynamic files, as `load_database` knows it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from inspect import signature
from pathlib import Path
from typing import Any

from seacrane.errors import FileFormatError
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.group.group import HydroGroup
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS

Loaded = HydroDatabase | HydroGroup


@dataclass(frozen=True, kw_only=True)
class Format:
    """One kind of files, of one hull or of several.

    Attributes
    ----------
    name : for messages.
    files : what a path may be, in words.
    looks : by what such a file is known when it is opened.
    can_open : whether a path is a file, stem or folder of this kind; opens no more than it needs to tell.
    read : the database, of files that hold several the reader's own choice; or a FileFormatError.
    takes : "speed" (m/s) or "depth" (m), by which `read` chooses where files may hold several; "mass_matrix",
        where they may hold none.
    speeds : forward speeds in m/s, rising; by default zero alone.
    """

    name: str
    files: str
    looks: str
    can_open: Callable[[Path], bool]
    read: Callable[..., Loaded]
    takes: tuple[str, ...] = ()
    speeds: Callable[[Path], tuple[float, ...]] = lambda path: (0.0,)


def told_of(formats: Sequence[Format]) -> list[tuple[str, str, str, str]]:
    """Rows of a table: name, files, by what they are known, and which arguments the reader has for what such
    files may lack or hold several of."""
    usual = {"path", "kind", "motions", "leave_out"}
    return [
        (
            one.name,
            one.files,
            one.looks,
            ", ".join(n for n in signature(one.read).parameters if n not in usual),
        )
        for one in formats
    ]


def is_file_of(path: Path, suffixes: tuple[str, ...]) -> bool:
    """Whether a path is a file whose name ends in one of ``suffixes``, in either case."""
    return path.suffix.lower() in suffixes and path.is_file()


def is_kind(opened: Any, holds: Callable[[Any], bool]) -> bool:
    """Whether a NetCDF or HDF5 file opens, and holds what those of a kind do. Raises where it is refused."""
    try:
        with opened as file:
            return holds(file)
    except FileFormatError:
        raise
    except NETCDF_ERRORS:
        return False


def sibling(stem: Path, suffix: str) -> Path | None:
    """File of a set of one stem with that suffix, in either case."""
    places = [stem.parent / (stem.name + one) for one in (suffix, suffix.upper())]
    return next((place for place in places if place.is_file()), None)


def unread(stem: Path, read: Collection[str]) -> list[str]:
    """Names of the files of one stem but those of the suffixes that are ``read``."""
    every = (file for file in sorted(stem.parent.iterdir()) if file.with_suffix("") == stem)
    return [file.name for file in every if file.suffix.lower() not in read]


def stem_of(path: Path, kind: str, leading: tuple[str, ...], suffixes: Collection[str]) -> Path:
    """Common stem (folder and name without suffix) of the set of files that ``path`` points to.

    In a folder it is that of the one file with the first of the ``leading`` suffixes that is there.
    """
    if not path.is_dir():
        own = sibling(path, leading[0]) is None and path.suffix.lower() in suffixes
        return path.with_suffix("") if own else path
    files = sorted(path.iterdir())
    by_suffix = [[one.with_suffix("") for one in files if one.suffix.lower() == each] for each in leading]
    stems = list(dict.fromkeys(next((some for some in by_suffix if some), [])))
    if len(stems) != 1:
        found = ", ".join(stem.name for stem in stems) or "none"
        raise FileFormatError(
            f"{path}: one {leading[0]} file is needed in a {kind} folder, found: {found}; give the stem"
        )
    return stems[0]
