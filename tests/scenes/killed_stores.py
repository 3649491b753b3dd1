"""Ensembles killed at their file operations, then called again: python killed_stores.py KIND COUNT SEED.

Each attempt is a process of its own that is killed just before it opens, makes, renames or removes something
in its store, from the making of the store's folder on. The same call then has to go on to the same numbers,
and to leave nothing but what an ensemble that was never killed has.
"""

from __future__ import annotations

import os
import random
import signal
import sys
import tempfile
import traceback
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4  # noqa: F401 (what attempts import would take most of their time)
import xarray
from ensemble_studies import KEEP, fails_in_the_middle, lowest, storm

from seacrane import Kept, ensemble
from seacrane.ensembles import Ensemble

STARTS = {
    "source": fails_in_the_middle, "over": {"start": [1.0, 2.0, 3.0, 4.0, 5.0]},
    "keep": {"track": KEEP["track"], "lowest": lowest}, "t_end": 1.0, "dt_out": 0.5, "pack": 2,
}  # fmt: skip
STORMS: dict[str, Any] = {
    "source": storm, "over": {"seed": range(1, 41), "height": [1.0, 2.0]}, "until": {"far.mpm": 0.02},
    "keep": {"far": Kept(channel="position", what="maximum", names={"body": "bob", "axis": "x"})},
    "t_end": 0.5, "dt_out": 0.5, "pack": 10,
}  # fmt: skip
KINDS: dict[str, dict[str, Any]] = {"netcdf": STARTS, "netcdf until": STORMS}
OPERATIONS = {"open", "os.mkdir", "os.rename", "os.remove", "os.link", "os.truncate"}
DONE, KILLED = 0, -signal.SIGKILL


def main(kind: str, count: str = "20", seed: str = "1") -> int:
    """The first attempts at the first operations, the others anywhere; 1 where some went wrong."""
    warnings.simplefilter("ignore")
    given, chance, attempts = KINDS[kind], random.Random(f"{kind} {seed}"), int(count)
    failed = killed = 0
    with tempfile.TemporaryDirectory() as within:
        folder = Path(within) / "whole" / "store"
        folder.parent.mkdir()
        total = Path(within) / "total"
        assert apart(lambda: _counted(folder, given, 0, total)) == DONE
        operations = int(total.read_text())
        early = list(range(1, 1 + min(attempts // 2, operations)))
        for at in early + [chance.randint(1, operations) for _ in range(attempts - len(early))]:
            store = Path(within) / str(len(list(Path(within).iterdir()))) / "store"
            store.parent.mkdir()
            killed += apart(lambda: _counted(store, given, at, None)) == KILLED  # noqa: B023
            if apart(lambda: _goes_on(store, given, folder)) != DONE:  # noqa: B023
                print(f"{kind}: killed at operation {at} of {operations}, went wrong", flush=True)
                failed += 1
    print(f"{kind}: {attempts} attempts, {killed} killed, {failed} went wrong", flush=True)
    return int(failed + (killed < 0.9 * attempts) > 0)


def apart(work: Callable[[], None]) -> int:
    """How a process ends that does it."""
    number = os.fork()
    if not number:
        status = 1
        try:
            work()
            status = DONE
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(status)
    return os.waitstatus_to_exitcode(os.waitpid(number, 0)[1])


def _counted(store: Path, given: dict[str, Any], at: int, total: Path | None) -> None:
    """Run it; at an operation of this number on files of the store the process is killed."""
    count = 0

    def watch(event: str, arguments: tuple[Any, ...]) -> None:
        nonlocal count
        if event in OPERATIONS and str(arguments[0]).startswith(str(store)):
            count += 1
            if count == at:
                os.kill(os.getpid(), signal.SIGKILL)

    sys.addaudithook(watch)
    ensemble(**given, store=store)
    if total is not None:
        total.write_text(str(count))


def _goes_on(store: Path, given: dict[str, Any], whole: Path) -> None:
    """Raise AssertionError where the same call does not leave what was left where nothing was killed."""
    resumed = ensemble(**given, store=store)
    plain = ensemble(**given)
    for found in (resumed, Ensemble.load(store)):
        xarray.testing.assert_identical(found.dataset.load(), plain.dataset)
    assert resumed.certainty == plain.certainty
    names = [{str(path.relative_to(one)) for path in one.rglob("*")} for one in (store, whole)]
    assert names[0] == names[1], names[0] ^ names[1]


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
