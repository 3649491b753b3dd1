"""Files that appear complete under their name, or not at all."""

from __future__ import annotations

import contextlib
import os
import secrets
import shutil
from collections.abc import Iterator
from pathlib import Path


@contextlib.contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """A draft beside `path` that takes its name if the block succeeds, and is removed if it fails.

    Raises
    ------
    OSError
        Naming the target, the cause and the space left, if the draft cannot be written.
    """
    draft = path.with_name(f".{path.name}.{secrets.token_hex(4)}.tmp")
    try:
        if not path.parent.is_dir():
            raise OSError(f"there is no folder {path.parent}; create it first")
        yield draft
        with draft.open("rb+") as file:
            os.fsync(file.fileno())
        draft.replace(path)
    except OSError as error:
        raise OSError(f"could not write {path}: {error}{space_left(path.parent)}") from error
    finally:
        draft.unlink(missing_ok=True)


def space_left(folder: Path) -> str:
    try:
        return f" ({shutil.disk_usage(folder).free / 1e6:.0f} MB free in {folder})"
    except OSError:
        return ""
