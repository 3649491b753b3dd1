"""Where outcomes are kept as they come: in memory, or a file for each pack in a folder."""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Protocol

from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.pack_file import read_pack, write_pack
from seacrane.errors import FileFormatError, SceneError
from seacrane.files.atomic import atomic_write
from seacrane.files.sole_writer import claim, opened
from seacrane.files.whole_file import read_whole

STUDY = "study.json"
FORMAT = "seacrane-ensemble"
LARGEST_STUDY = 256 * 2**20  # bytes; a million members of a few parameters


class Store(Protocol):
    """Keeps the outcomes of packs by their number."""

    def done(self) -> set[int]:
        """Numbers of the packs that are there."""

    def keep(self, pack: int, outcomes: list[Outcome]) -> None:
        """Take a pack."""

    def of(self, pack: int) -> list[Outcome]:
        """Of one pack that is there."""

    def outcomes(self) -> Iterator[Outcome]:
        """Of all packs that are there, in order."""


class Memory:
    """A store for as long as the process lives."""

    def __init__(self) -> None:
        self._packs: dict[int, list[Outcome]] = {}

    def done(self) -> set[int]:
        return set(self._packs)

    def keep(self, pack: int, outcomes: list[Outcome]) -> None:
        self._packs[pack] = outcomes

    def of(self, pack: int) -> list[Outcome]:
        return self._packs[pack]

    def outcomes(self) -> Iterator[Outcome]:
        for pack in sorted(self._packs):
            yield from self._packs[pack]


class Folder:
    """A file for each pack; one process writes."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def done(self) -> set[int]:
        return {int(path.stem.removeprefix("pack_")) for path in self.path.glob("pack_*.nc")}

    def keep(self, pack: int, outcomes: list[Outcome]) -> None:
        write_pack(self._file(pack), outcomes)

    def of(self, pack: int) -> list[Outcome]:
        return read_pack(self._file(pack))

    def outcomes(self) -> Iterator[Outcome]:
        for pack in sorted(self.done()):
            yield from read_pack(self._file(pack))

    def _file(self, pack: int) -> Path:
        return self.path / f"pack_{pack:07d}.nc"


@contextlib.contextmanager
def folder_of(path: str | os.PathLike[str], study: Mapping[str, Any]) -> Iterator[Folder]:
    """The folder of a study, made where it is not there, for one writer at a time.

    Parameters
    ----------
    path : path
        Its parent must exist.
    study : mapping
        Plain data: "identity", and what is needed to read the folder later.

    Raises
    ------
    SceneError
        If the folder holds another study, or something else.
    FileExistsError
        If another process writes it.
    """
    folder = Path(path)
    if not folder.parent.is_dir():
        raise SceneError(f"store {str(folder)!r}: there is no folder {folder.parent}; create it first")
    if folder.exists() and not folder.is_dir():
        raise SceneError(f"store {str(folder)!r} is a file; give the name of a folder")
    folder.mkdir(exist_ok=True)
    if not (folder / STUDY).exists() and any(one.name != "writer.lock" for one in folder.iterdir()):
        raise SceneError(f"store {str(folder)!r} holds something else than an ensemble; give another folder")
    lock = opened(folder / "writer.lock")
    try:
        if not claim(lock):
            raise FileExistsError(
                f"store {str(folder)!r}: another process is writing it; wait, or give another"
            )
        _require_same(folder, study)
        yield Folder(folder)
    finally:
        os.close(lock)


def study_in(folder: Path) -> dict[str, Any]:
    """What a folder says that it is. Raises FileFormatError."""
    path = folder / STUDY
    if not path.is_file():
        raise FileFormatError(f"{folder}: is no ensemble, it has no {STUDY}")
    try:
        data = json.loads(read_whole(path, LARGEST_STUDY, "it is no study of ours"))
    except ValueError as error:
        raise FileFormatError(f"{path}: is no JSON: {error}") from error
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise FileFormatError(f'{path}: is no study, it has no "format": "{FORMAT}"')
    return data


def _require_same(folder: Path, study: Mapping[str, Any]) -> None:
    """Write what the folder is, or refuse a folder of another study."""
    whole = {"format": FORMAT, **study}
    path = folder / STUDY
    if not path.exists():
        with atomic_write(path) as draft:
            draft.write_text(json.dumps(whole), encoding="utf-8")
        return
    there = study_in(folder).get("identity", {})
    here = study["identity"]
    other = [key for key in {**here, **there} if there.get(key) != here.get(key)]
    if other:
        raise SceneError(
            f"store {str(folder)!r} is of another study: {', '.join(other)} differ; give another folder, or "
            f"remove this one ({_told(there, here, other[0])})"
        )


def _told(there: Mapping[str, Any], here: Mapping[str, Any], key: str) -> str:
    return f"{key}: {str(there.get(key))[:80]} there, {str(here.get(key))[:80]} here"
