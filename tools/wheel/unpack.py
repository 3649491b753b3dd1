"""An sdist unpacked for a build that keeps its objects."""

from __future__ import annotations

import os
import shutil
import time
from pathlib import Path


def unpack(archive: Path, source: Path) -> None:
    """The files of an archive, each as old as its content.

    An archive gives all files one date of long ago. Objects of another source would look newer than that, and
    end in the wheel.
    """
    fresh = source.with_name("fresh")
    shutil.rmtree(fresh, ignore_errors=True)
    shutil.unpack_archive(archive, fresh)
    for path in (path for path in fresh.rglob("*") if path.is_file()):
        old = source / path.relative_to(fresh)
        same = old.is_file() and old.read_bytes() == path.read_bytes()
        date = old.stat().st_mtime_ns if same else time.time_ns()
        os.utime(path, ns=(date, date))
    shutil.rmtree(source, ignore_errors=True)
    fresh.rename(source)
