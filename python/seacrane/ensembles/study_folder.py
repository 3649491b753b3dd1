"""The folder of one study: what it says that it is, and one writer at a time."""

from __future__ import annotations

import contextlib
import json
import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.drafts import is_draft, remove_all
from seacrane.inputs.file_version import FILE_VERSION, require_file_version
from seacrane.inputs.json_text import json_of
from seacrane.inputs.sole_writer import claim, opened
from seacrane.inputs.whole_file import read_whole

STUDY, LOCK = "study.json", "writer.lock"
FORMAT = "seacrane-ensemble"
OURS = re.compile(r"study\.json|pack_\d+\.nc")
LARGEST_STUDY = 256 * 2**20  # bytes; a million members of a few parameters


@contextlib.contextmanager
def claimed(path: str | os.PathLike[str], study: Mapping[str, Any]) -> Iterator[Path]:
    """The folder of a study, made where it is not there, for one writer at a time.

    Parameters
    ----------
    path : Its parent must exist.
    study : Plain data: "identity", and what is needed to read the folder later.

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
    if folder.suffix == ".zarr":
        raise SceneError(
            f"store {str(folder)!r}: is a folder of NetCDF files; give another name, and export what it "
            f"holds: Ensemble.load(folder).dataset.to_zarr({folder.name!r})"
        )
    if folder.exists() and not folder.is_dir():
        raise SceneError(f"store {str(folder)!r} is a file; give the name of a folder")
    if not (folder / STUDY).exists() and _holds_files(folder):
        raise SceneError(f"store {str(folder)!r} holds something else than an ensemble; give another folder")
    folder.mkdir(exist_ok=True)
    lock = opened(folder / LOCK)
    try:
        if not claim(lock):
            raise FileExistsError(
                f"store {str(folder)!r}: another process is writing it; wait, or give another"
            )
        remove_all(folder, OURS)
        _require_same(folder, study)
        yield folder
    finally:
        os.close(lock)


def study_in(folder: Path) -> dict[str, Any]:
    """What a folder says that it is. Raises FileFormatError."""
    path = folder / STUDY
    if not path.is_file():
        raise FileFormatError(f"{folder}: is no ensemble, it has no {STUDY}")
    data = json_of(read_whole(path, LARGEST_STUDY, "it is no study of ours"), str(path))
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise FileFormatError(f'{path}: is no study, it has no "format": "{FORMAT}"')
    require_file_version(path, data.get("version"))
    return data


def _holds_files(folder: Path) -> bool:
    return any(not one.is_dir() and one.name != LOCK and not is_draft(one) for one in folder.rglob("*"))


def _require_same(folder: Path, study: Mapping[str, Any]) -> None:
    """Write what the folder is, or refuse a folder of another study."""
    whole = {"format": FORMAT, "version": FILE_VERSION, **study}
    path = folder / STUDY
    if not path.exists():
        with atomic_write(path, tidy=False) as draft:
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
