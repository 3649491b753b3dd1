"""``seacrane view``: a result, or a scene at its start, as one page in three dimensions."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from seacrane.cli.scene_source import is_result, load_scene

if TYPE_CHECKING:
    from seacrane.result import Result
    from seacrane.scene.scene import Scene


def run(arguments: argparse.Namespace) -> int:
    """Refuse before the work what could not be written after it."""
    page = Path(arguments.out)
    if page.is_dir():
        raise IsADirectoryError(f"--out {page} is a folder; name the page, such as {page / 'lift.html'}")
    if page.exists() and not arguments.overwrite:
        raise FileExistsError(f"--out {page} is there already; give another name, or --overwrite")
    from seacrane.pictures.view import view

    shown = view(_subject(arguments))
    print(f"saved {shown.save(page, overwrite=arguments.overwrite)}")
    return 0


def _subject(arguments: argparse.Namespace) -> Result | Scene:
    """What the file holds, by its content."""
    source = str(arguments.source)
    if not is_result(source):
        return load_scene(source, arguments, scripts=False)[1]
    from seacrane.result import Result

    return Result.load(source)
