"""Files that appear complete under their name, or not at all, and their drafts."""

from __future__ import annotations

import contextlib
import hashlib
import os
import platform
import re
import secrets
import shutil
import stat
from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path

# Machine, process and chance.
_DRAFT = re.compile(r"\.(?P<target>.+)\.(?P<here>[0-9a-f]{6})-(?P<process>[0-9a-f]+)-[0-9a-f]{8}\.tmp")


@contextlib.contextmanager
def atomic_write(path: Path, *, tidy: bool = True) -> Iterator[Path]:
    """A draft beside `path` that takes its name if the block succeeds, and is removed if it fails.

    Where `path` is a link, the file that it names is replaced, not the link. What processes that were killed
    left of the same file is removed, but where `tidy` is False.

    Raises OSError naming the target, the cause and the space left, if the draft cannot be written, or if what
    has the name is a folder, a device or write-protected.
    """
    target = path.resolve()
    draft = draft_of(target)
    try:
        require_replaceable(path)
        if tidy:
            _remove(target.parent, lambda name: name["target"] == target.name and _is_gone(name))
        yield draft
        with draft.open("rb+") as file:
            os.fsync(file.fileno())
        draft.replace(target)
        sync_folder(target.parent)
    except OSError as error:
        kind = FileNotFoundError if isinstance(error, FileNotFoundError) else OSError
        raise kind(f"could not write {path}: {error}{space_left(target.parent)}") from error
    finally:
        _discard(draft)


def require_replaceable(path: Path) -> None:
    """Raise OSError unless a file may get this name."""
    if not path.resolve().parent.is_dir():
        raise FileNotFoundError(f"there is no folder {path.parent}; create it first")
    if not path.exists():
        return
    mode = path.stat().st_mode
    if stat.S_ISDIR(mode):
        raise OSError("it is a folder; give the name of a file")
    if not stat.S_ISREG(mode):
        raise OSError("it is a device, a pipe or a socket; give the name of a file")
    if not mode & 0o222:
        raise OSError("it is write-protected; give another name, or chmod u+w")


def sync_folder(folder: Path) -> None:
    """Have the disk hold the names in a folder."""
    if os.name == "nt":  # folders cannot be opened there
        return
    number = os.open(folder, os.O_RDONLY)
    try:
        with contextlib.suppress(OSError):  # file systems that cannot
            os.fsync(number)
    finally:
        os.close(number)


def space_left(folder: Path) -> str:
    try:
        return f" ({shutil.disk_usage(folder).free / 1e6:.0f} MB free in {folder})"
    except OSError:
        return ""


def _discard(draft: Path) -> None:
    """Its room too: a library that failed to write it holds it open, and would keep it to the end of the
    process."""
    with contextlib.suppress(FileNotFoundError):
        found = draft.stat()
        draft.unlink()
        null = os.open(os.devnull, os.O_RDWR)
        for number in map(int, os.listdir("/dev/fd")):
            with contextlib.suppress(OSError):  # of the folder that was listed
                if os.path.samestat(os.fstat(number), found):
                    os.dup2(null, number, inheritable=False)
        os.close(null)


def draft_of(target: Path) -> Path:
    """A new name beside a file."""
    return target.with_name(f".{target.name}.{_here()}-{os.getpid():x}-{secrets.token_hex(4)}.tmp")


def is_draft(path: Path) -> bool:
    """Whether it has the name of a draft."""
    return _DRAFT.fullmatch(path.name) is not None


def remove_all(folder: Path, targets: re.Pattern[str]) -> None:
    """Remove every draft of files of these names; for who knows that nobody else writes there."""
    _remove(folder, lambda name: targets.fullmatch(name["target"]) is not None)


def _remove(folder: Path, wanted: Callable[[re.Match[str]], bool]) -> None:
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            found = _DRAFT.fullmatch(entry.name)
            if found and wanted(found) and entry.is_file(follow_symlinks=False):
                with contextlib.suppress(OSError):
                    os.unlink(entry.path)


def _is_gone(name: re.Match[str]) -> bool:
    if os.name == "nt" or name["here"] != _here():
        return False
    try:
        os.kill(int(name["process"], 16), 0)
    except ProcessLookupError:
        return True
    except (OSError, OverflowError):  # another user's, or no number of a process
        return False
    return False


@lru_cache(maxsize=1)
def _here() -> str:
    """Where numbers of processes mean what they do here: the machine, or the container in it."""
    inside = ""
    with contextlib.suppress(OSError):
        inside = os.readlink("/proc/self/ns/pid")
    return hashlib.sha256(f"{platform.node()} {inside}".encode()).hexdigest()[:6]
