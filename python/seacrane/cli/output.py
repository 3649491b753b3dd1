"""What commands write: values as JSON, and the folder of their files."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any


def to_json(value: Any) -> str:
    """JSON text; arrays become lists, and numbers that JSON has no word for become null."""
    return json.dumps(_plain(value), indent=2, allow_nan=False)


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):  # arrays and scalars of NumPy
        value = value.tolist()
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if isinstance(value, (str, int, float, type(None))) else str(value)


def output_folder(
    name: str, *, holds: Iterable[str] = (), overwrite: bool = True, called: str = "--out "
) -> Path:
    """The folder, made if absent; `called` stands before its name where it is told.

    Raises OSError if it cannot be made, something else has its name, or it holds one of the files `holds`
    and none may be replaced.
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


def stem_of(path: Path) -> str:
    """The name of a result's file without its endings."""
    return path.name.removesuffix(".partial").removesuffix(".nc")
