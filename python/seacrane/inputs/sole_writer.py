"""A file that one writer has for itself: locked by POSIX where there is fcntl, else as Windows does."""

from __future__ import annotations

import os
from importlib import import_module
from pathlib import Path
from types import ModuleType

# The last that Windows can lock. It keeps others from reading what is locked: most files end before.
LOCKED_BYTE = 2**31 - 2
REMOVES_OPEN_FILES = os.name != "nt"


def opened(path: Path) -> int:
    """Number of the file, made if absent, open for reading and writing in this process alone."""
    alone: int = getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_NOINHERIT", 0)
    return os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0) | alone, 0o666)


def claim(number: int) -> bool:
    """Lock an open file until it is closed; False if another writer has it.

    A file system or a platform that cannot lock counts as free.
    """
    fcntl, msvcrt = _module("fcntl"), _module("msvcrt")
    try:
        if fcntl is not None:
            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
        elif msvcrt is not None:
            os.lseek(number, LOCKED_BYTE, os.SEEK_SET)
            msvcrt.locking(number, msvcrt.LK_NBLCK, 1)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        pass  # a file system that cannot lock
    finally:
        os.lseek(number, 0, os.SEEK_SET)
    return True


def write_at(number: int, data: bytes | memoryview, place: int) -> int:
    """Write at a place of an open file; the count of bytes written."""
    os.lseek(number, place, os.SEEK_SET)
    return os.write(number, data)


def _module(name: str) -> ModuleType | None:
    try:
        return import_module(name)
    except ImportError:
        return None
