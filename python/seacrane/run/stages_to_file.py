"""A lift in stages whose result is on disk after each of them."""

from __future__ import annotations

import contextlib
from pathlib import Path

from seacrane.result.result import Result
from seacrane.run.staged_run import StagedRun
from seacrane.run.to_file import StreamedResult


def require_free(path: Path, *, overwrite: bool) -> None:
    """FileExistsError for a name that is taken, FileNotFoundError without its folder."""
    if path.exists() and not overwrite:
        raise FileExistsError(f"{path.name} is there already; give another name, or overwrite=True")
    if not path.parent.is_dir():
        raise FileNotFoundError(f"{path}: there is no folder {path.parent}; make it first")


def stages_to_file(run: StagedRun, path: Path, *, overwrite: bool) -> StreamedResult:
    """Carry out a lift, and write its result after each stage.

    The file is whole whenever the process is killed: it then holds the stages that were over, with
    `interrupted` set. Ctrl-C and errors keep the stage that they end, too. The outputs stay in memory.
    """
    require_free(path, overwrite=overwrite)
    try:
        while run.advance():
            run.result().save(path)
    except BaseException as error:
        recorded = getattr(error, "result", None)
        if isinstance(recorded, Result):
            with contextlib.suppress(OSError):  # the error at hand tells more
                recorded.save(path)
        raise
    run.warn()
    return StreamedResult.saved(run.result(), path)
