"""The version of the files that the program itself writes: scenes, results, states, stores of ensembles."""

from __future__ import annotations

from typing import Any

from seacrane.errors import FileFormatError
from seacrane.inputs.shown import shown
from seacrane.version import __version__

FILE_VERSION = "0.4"  # the release that began to write them as they are; raised when one of them changes


def require_file_version(place: object, version: Any) -> None:
    """Raise FileFormatError for a file of another version, or of none."""
    if type(version) is str and version == FILE_VERSION:
        return
    told = "names no version of files" if version is None else f"is of file version {shown(version)}"
    raise FileFormatError(
        f"{place}: {told}, and seacrane {__version__} reads and writes file version {FILE_VERSION!r}; make "
        "it again with this seacrane, or read it with the one that wrote it"
    )
