"""Drafts of files, beside those whose names they will take, and what killed processes left of them."""

from __future__ import annotations

import contextlib
import hashlib
import os
import platform
import re
import secrets
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

# Machine, process and chance.
_DRAFT = re.compile(r"\.(?P<target>.+)\.(?P<here>[0-9a-f]{6})-(?P<process>[0-9a-f]+)-[0-9a-f]{8}\.tmp")


def draft_of(target: Path) -> Path:
    """A new name beside a file."""
    return target.with_name(f".{target.name}.{_here()}-{os.getpid():x}-{secrets.token_hex(4)}.tmp")


def is_draft(path: Path) -> bool:
    """Whether it has the name of a draft."""
    return _DRAFT.fullmatch(path.name) is not None


def remove_left(target: Path) -> None:
    """Remove the drafts of a file whose processes, of this machine, are no more."""
    _remove(target.parent, lambda name: name["target"] == target.name and _is_gone(name))


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
