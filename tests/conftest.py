"""Fixtures shared by all tests."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

# Before anything imports pyplot; child processes started by a test inherit it.
os.environ["MPLBACKEND"] = "Agg"
# Small dense algebra: several BLAS threads in every test worker only get in each other's way.
for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(threads, "1")

# Fits are made here, not taken from what another run left on disk.
os.environ["SEACRANE_CACHE"] = "off"

# A test run in the background of a shell script inherits an ignored SIGINT, and would hand it on to the
# processes that tests interrupt.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

REPOSITORY = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def repository() -> Path:
    """Root of the source tree."""
    return REPOSITORY


@pytest.fixture(scope="session")
def shared() -> Path:
    """Folder with the real ships' files: the one SEACRANE_SHARED names, else ``../shared``."""
    named = os.environ.get("SEACRANE_SHARED")
    if named and not Path(named).is_dir():
        pytest.fail(f"SEACRANE_SHARED={named} is not a folder: correct or unset it")
    folder = Path(named) if named else REPOSITORY.parent / "shared"
    if not folder.is_dir():
        pytest.skip(f"shared data folder absent: no {folder}; set SEACRANE_SHARED to it")
    return folder
