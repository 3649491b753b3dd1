"""What reading a file may cost: a base and so much per byte, of processor time and of memory."""

from __future__ import annotations

import contextlib
import functools
import os
import resource
import signal
from collections.abc import Callable, Iterator
from typing import Any

# What readers import with their first file is no cost of that file.
import h5py  # noqa: F401
import scipy.signal.windows  # noqa: F401
import xarray  # noqa: F401

SECONDS, SECONDS_PER_BYTE = 1.0, 20e-6  # of processor time; the slowest reader, of YAML, takes some 2e-6
MEMORY, MEMORY_PER_BYTE = 32 * 2**20, 64  # bytes; JSON's smallest lists and objects take some 30
UNFOLDING = 5.0  # s in place of the first, where arrays may be compressed
ARRAYS = 4  # copies of an array
PAGE = resource.getpagesize()


class TooDear(Exception):
    """A case took more than its size allows."""


class Hang(BaseException):
    """As `TooDear`, of time; no reader may take it for a mistake in the file."""


@contextlib.contextmanager
def bounded(size: int, announced: Callable[[], int] | None = None) -> Iterator[None]:
    """Raise if the block takes more than a file of so many bytes may. `announced` gives the bytes of arrays,
    where these may be compressed."""
    seconds = (SECONDS if announced is None else UNFOLDING) + SECONDS_PER_BYTE * size

    def hang(*_: Any) -> None:
        raise Hang(f"{size} bytes took more than {seconds:.3g} s of processor time")

    handler = signal.signal(signal.SIGVTALRM, hang)
    before = _forget_peak()
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, handler)
    taken = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 - before
    most = MEMORY + MEMORY_PER_BYTE * size
    if taken > most and announced is not None:
        most += ARRAYS * announced()
    if taken > most:
        raise TooDear(f"{size} bytes took {taken / 2**20:.0f} MiB of memory, more than {most / 2**20:.0f}")


@functools.cache
def _open() -> tuple[int, int]:
    """Open for good: a case may take no longer than its reader."""
    return os.open("/proc/self/clear_refs", os.O_WRONLY), os.open("/proc/self/statm", os.O_RDONLY)


def _forget_peak() -> int:
    """Bytes in memory now, from where its peak counts (on Linux; elsewhere the peak of all cases so far)."""
    with contextlib.suppress(OSError):
        clear, statm = _open()
        os.pwrite(clear, b"5", 0)
        return int(os.pread(statm, 200, 0).split()[1]) * PAGE
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
