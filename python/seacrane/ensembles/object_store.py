"""The store of an ensemble in an object store, such as "s3://bucket/storms", through fsspec.

An object is there whole or not at all, as a pack is. There are no locks: that one process writes is up to who
starts them. Two that write the same study write the same packs.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator, Mapping
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from seacrane.ensembles.dataset import Outcome
from seacrane.ensembles.store import Folder, Store
from seacrane.ensembles.study_folder import STUDY, claimed, require_same, study_in, write_study
from seacrane.errors import FileFormatError, SceneError


class Objects(Folder):
    """As `Folder`; each file passes through a folder of this process on its way."""

    def __init__(self, url: str) -> None:
        self._within = TemporaryDirectory(prefix="seacrane-")
        super().__init__(Path(self._within.name))
        self.url = url
        try:
            self._files, self._root = import_module("fsspec.core").url_to_fs(url)
        except ImportError as error:
            raise SceneError(
                f"store {url!r} takes fsspec, and the package of its kind ({error}): pip install "
                "'seacrane[objects]'"
            ) from error
        except ValueError as error:
            raise SceneError(f"store {url!r}: {error}; give a folder, or a URL that fsspec knows") from error

    def _names(self) -> Iterator[str]:
        self._files.invalidate_cache()
        if self._files.exists(self._root):
            yield from (str(one).rpartition("/")[2] for one in self._files.ls(self._root, detail=False))

    def __setitem__(self, pack: int, outcomes: list[Outcome]) -> None:
        super().__setitem__(pack, outcomes)
        self.put(self._file(pack))

    def __getitem__(self, pack: int) -> list[Outcome]:
        path = self._file(pack)
        if pack in self._fresh:
            return super().__getitem__(pack)
        if not self.get(path):
            raise FileFormatError(f"{self.url}: has no {path.name}; run the ensemble again")
        try:
            return super().__getitem__(pack)
        finally:
            path.unlink()

    def size(self, pack: int) -> int:
        return int(self._files.size(self._object(self._file(pack))))

    def put(self, path: Path) -> None:
        """Move a file there."""
        self._files.pipe_file(self._object(path), path.read_bytes())
        path.unlink()

    def get(self, path: Path) -> bool:
        """Fetch a file, if it is there."""
        with contextlib.suppress(FileNotFoundError):
            path.write_bytes(self._files.cat_file(self._object(path)))
            return True
        return False

    def _object(self, path: Path) -> str:
        return f"{self._root.rstrip('/')}/{path.name}"


def opened_store(path: str | os.PathLike[str]) -> Folder:
    """The store at a path or URL, whose `path` holds the study; FileFormatError where a URL has none."""
    if not is_url(path):
        return Folder(Path(path))
    store = Objects(str(path))
    if not store.get(store.path / STUDY):
        raise FileFormatError(f"{path}: is no ensemble, it has no {STUDY}")
    return store


@contextlib.contextmanager
def claimed_store(path: str | os.PathLike[str], study: Mapping[str, Any]) -> Iterator[Folder]:
    """The store of a study at a path or URL, made where it is not there; as `claimed`."""
    if not is_url(path):
        with claimed(path, study) as folder:
            yield Folder(folder)
        return
    store = Objects(str(path))
    there = store.get(store.path / STUDY)
    if not there and any(store._names()):
        raise SceneError(f"store {path!r} holds something else than an ensemble; give another")
    require_same(store.path, study)
    if not there:
        store.put(store.path / STUDY)
    yield store


def note(store: Store, name: str, told: Any) -> None:
    """Tell something in the study of a store, if it has one; None: take it out."""
    if not isinstance(store, Folder):
        return
    distant = store if isinstance(store, Objects) else None
    if distant is not None:
        distant.get(store.path / STUDY)
    data = study_in(store.path)
    if data.get(name) != told:
        write_study(store.path, {one: value for one, value in data.items() if one != name} | {name: told})
    if distant is not None:
        distant.put(store.path / STUDY)


def folder_of(what: str, path: str | os.PathLike[str]) -> Path:
    """A folder here; SceneError for a URL, of which a path would make one of its name."""
    if is_url(path):
        raise SceneError(
            f"{what} is {os.fspath(path)!r}; give a folder: object stores are of `ensemble` alone"
        )
    return Path(path)


def is_url(path: str | os.PathLike[str]) -> bool:
    """Whether it is a URL, as of an object store."""
    return "://" in os.fspath(path)
