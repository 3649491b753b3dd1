"""The folder that `--out` names."""

from __future__ import annotations

from pathlib import Path


def output_folder(name: str) -> Path:
    """The folder, made if absent.

    Raises
    ------
    OSError
        If it cannot be made, or something else has its name.
    """
    folder = Path(name)
    if folder.exists() and not folder.is_dir():
        raise OSError(f"--out {name} is a file; name a folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OSError(f"could not make the folder --out {name}: {error.strerror or error}") from error
    return folder
