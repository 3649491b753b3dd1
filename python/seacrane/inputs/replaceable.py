"""Whether a file may be replaced by what can be made again at any time: a page, a model."""

from __future__ import annotations

from pathlib import Path

GENERATOR = '<meta name="generator" content="seacrane">'  # in the head of every page
HEAD = 1024  # bytes within which a file says who made it


def check_replaceable(path: Path, overwrite: bool | None, *, mark: str) -> None:
    """FileExistsError where a file is to stay: every one without `overwrite`, none with it.

    `overwrite` None: only a file in whose first kB the mark of our own stands may be replaced.
    """
    if overwrite or not path.exists():
        return
    if overwrite is None:
        if path.is_file():
            with path.open("rb") as file:
                if mark.encode() in file.read(HEAD):
                    return
        raise FileExistsError(f"{path} is there and not of seacrane; give another name, or overwrite=True")
    raise FileExistsError(f"{path} is there already; give another name, or overwrite=True")
