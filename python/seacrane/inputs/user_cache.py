"""Results of long work that are kept for the next process, each in a file named by a digest of its data.

The folders are in ``~/.cache/seacrane`` (``$XDG_CACHE_HOME/seacrane`` where that is set). ``SEACRANE_CACHE``
names another place, and ``SEACRANE_CACHE=off`` keeps nothing on disk. Files are written atomically.
"""

from __future__ import annotations

import os
from pathlib import Path

from seacrane.inputs.atomic import atomic_write

VARIABLE, OFF = "SEACRANE_CACHE", "off"
MOST_BYTES = 10_000_000


def user_cache(kind: str) -> Path | None:
    """Where results of a kind are kept; None where nothing is kept on disk."""
    named = os.environ.get(VARIABLE)
    if named is not None and named.strip().lower() in ("", OFF):
        return None
    if named is not None:
        return Path(named) / kind
    base = os.environ.get("XDG_CACHE_HOME")
    try:
        return (Path(base) if base else Path.home() / ".cache") / "seacrane" / kind
    except RuntimeError:  # there is no home
        return None


def read_kept(path: Path) -> bytes:
    """What a file holds; raises OSError, or ValueError for one that is larger than any result."""
    if path.stat().st_size > MOST_BYTES:
        raise ValueError(f"{path}: too large for a kept result")
    return path.read_bytes()


def keep_file(folder: Path | None, name: str, data: bytes) -> None:
    """Keep a result for the next time; a folder that cannot be written is passed over."""
    if folder is None:
        return
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with atomic_write(folder / name) as draft:
            draft.write_bytes(data)
    except OSError:
        return
