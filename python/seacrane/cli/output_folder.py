"""The folder that a command writes to."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path


def output_folder(
    name: str, *, holds: Iterable[str] = (), overwrite: bool = True, called: str = "--out "
) -> Path:
    """The folder, made if absent.

    Parameters
    ----------
    holds : Files that will be written into it.
    overwrite : Whether those may replace earlier ones.
    called : What stands before the name where it is told.

    Raises OSError if it cannot be made, something else has its name, or it holds an earlier one of those
    files.
    """
    folder = Path(name)
    earlier = [] if overwrite else [file for file in holds if (folder / file).exists()]
    if earlier:
        raise FileExistsError(
            f"{called}{name} holds an earlier {', '.join(earlier)}; give another folder, or --overwrite"
        )
    if folder.exists() and not folder.is_dir():
        raise OSError(f"{called}{name} is a file; name a folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OSError(f"could not make the folder {called}{name}: {error.strerror or error}") from error
    return folder
