"""Errors of what is read, as those of its file."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from seacrane.errors import FileFormatError


@contextmanager
def reading(
    where: object, kind: str = "", errors: tuple[type[Exception], ...] = (ValueError,)
) -> Iterator[None]:
    """Raise what goes wrong within as a FileFormatError that names the file; one that does so stays.

    Parameters
    ----------
    where : file or files.
    kind : what the file should be, where ``errors`` are those of a library that cannot read it.
    """
    try:
        yield
    except FileFormatError:
        raise
    except errors as error:
        told = f"cannot be read as {kind} ({str(error)[:200]}); write it again" if kind else error
        raise FileFormatError(f"{where}: {told}") from error
