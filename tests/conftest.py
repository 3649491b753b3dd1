"""Fixtures shared by all tests, the marks of slow tests, and what each test costs."""

from __future__ import annotations

import importlib
import os
import signal
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from reporting import Tenths, TimesTable

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
# What tests of several rooms share is found from each, and by the processes that they start.
ROOMS = [
    str(REPOSITORY / "tests"),
    *(str(room) for room in sorted((REPOSITORY / "tests").glob("*/")) if not (room / "__init__.py").exists()),
]
sys.path[:0] = ROOMS
os.environ["PYTHONPATH"] = os.pathsep.join([*ROOMS, *filter(None, [os.environ.get("PYTHONPATH")])])


@pytest.fixture(scope="session")
def repository() -> Path:
    """Root of the source tree."""
    return REPOSITORY


@pytest.fixture(params=["redundant", "recursive"])
def formulation(request: pytest.FixtureRequest) -> str:
    """Each of the two, where a test holds in both."""
    return str(request.param)


@pytest.fixture
def modules(repository: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], Any]:
    """Imports a module of the benchmarks."""
    monkeypatch.syspath_prepend(str(repository / "benchmarks"))
    return importlib.import_module


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


def pytest_addoption(parser: pytest.Parser) -> None:
    """`--times FILE`: what each item costs, as CSV; `--brief`: a line a tenth instead of a dot an item."""
    parser.addoption(
        "--times", metavar="FILE", type=Path, help="write processor and wall seconds of each item"
    )
    parser.addoption("--brief", action="store_true", help="tell of progress once in a tenth of the items")


def pytest_configure(config: pytest.Config) -> None:
    """Write and tell where all reports arrive: not in the workers of xdist."""
    if hasattr(config, "workerinput"):
        return
    if file := config.getoption("--times"):
        config.pluginmanager.register(TimesTable(file))
    if config.getoption("--brief"):
        config.pluginmanager.register(Tenths())


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """A slow test says why it is slow. Warnings that a test expects are no errors, by night no others."""
    for item in items:
        if item.get_closest_marker("slow"):
            item.add_marker(pytest.mark.filterwarnings("default::UserWarning"))
        for name in set.union(*_warned(item)):
            item.add_marker(pytest.mark.filterwarnings(f"always::seacrane.warnings.{name}"))
        for mark in item.iter_markers("slow"):
            if len(mark.args) != 1 or not mark.args[0]:
                raise pytest.UsageError(f'{item.nodeid}: say why it is slow: @pytest.mark.slow("why")')


def _warned(item: pytest.Item) -> tuple[set[str], set[str]]:
    """Names of the warnings that an item's marks expect, and of those that some of its kind give."""
    marks = list(item.iter_markers("warns"))
    always = {name for mark in marks for name in mark.args}
    return always, {name for mark in marks for name in mark.kwargs.get("sometimes", ())}


@pytest.hookimpl(wrapper=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> Iterator[None]:
    """A test gives the warnings that its mark names, and passes on all others."""
    expected, sometimes = _warned(pyfuncitem)
    if not expected | sometimes:
        return (yield)
    with warnings.catch_warnings(record=True) as told:
        result = yield
    for one in told:
        if one.category.__name__ not in expected | sometimes:
            warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
    if missing := expected - {one.category.__name__ for one in told}:
        pytest.fail(f"{', '.join(sorted(missing))} did not come, which the test's mark expects")
    return result


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Keep the start of an item; what has begun, its reports tell."""
    item.stash[STARTED] = _seconds()
    return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[None]) -> Iterator[None]:
    """The last report of an item has its processor and wall seconds, child processes included."""
    report = yield
    if call.when == "teardown":
        spent = (now - then for now, then in zip(_seconds(), item.stash[STARTED], strict=True))
        report.user_properties.append(("seconds", tuple(spent)))
    return report


STARTED = pytest.StashKey[tuple[float, float]]()


def _seconds() -> tuple[float, float]:
    """Seconds of processor time, of this process and of those that have ended, and of the wall."""
    return sum(os.times()[:4]), time.perf_counter()
