"""Checks the record, or makes it: ``PYTHONPATH=tools python -m bits [--record] [--scenes NAME ...]``."""

from __future__ import annotations

import argparse
import json
import multiprocessing
import sys
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from fnmatch import fnmatchcase
from pathlib import Path
from queue import SimpleQueue
from typing import Any

from tqdm import tqdm

import bits.scenes  # noqa: F401  fills the list
from bits.case import CASES
from bits.compare import Change, Difference, Renamed, changes, differences
from bits.record import Record, recorded
from bits.versions import versions

FILE = Path(__file__).parents[2] / "tests" / "bits.json"
TOLERANCE = 1e-12
FORMAT = 1


def arguments(given: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m bits", description=__doc__)
    parser.add_argument("--record", action="store_true", help="write the record, and compare nothing")
    parser.add_argument(
        "--scenes", nargs="+", metavar="NAME", default=["*"], help="names or patterns, as lines/*"
    )
    parser.add_argument(
        "--tolerance", type=float, default=TOLERANCE, help="largest relative difference (%(default)g)"
    )
    parser.add_argument("--jobs", type=int, default=1, help="processes at a time")
    parser.add_argument("--file", type=Path, default=FILE, help="the record (%(default)s)")
    return parser.parse_args(given)


def chosen(patterns: Iterable[str], known: Iterable[str]) -> list[str]:
    """The names that patterns mean; SystemExit for a pattern that means none."""
    names = list(known)
    for pattern in patterns:
        if not any(fnmatchcase(name, pattern) for name in names):
            raise SystemExit(f"no scene is called {pattern!r}; there are: {', '.join(names)}")
    return [name for name in names if any(fnmatchcase(name, pattern) for pattern in patterns)]


def run_all(names: Sequence[str], jobs: int) -> Iterator[tuple[str, Record | str]]:
    """Each scene with its record, or with what went wrong; in their order."""
    workers: SimpleQueue[ProcessPoolExecutor] = SimpleQueue()
    for _ in range(jobs):
        workers.put(_worker())

    def one(name: str) -> Record | str:
        worker = workers.get()
        try:
            return worker.submit(recorded, name).result()
        except BrokenProcessPool:
            worker = _worker()  # for the next scene
            return "its process ended"
        except Exception as error:
            return f"{type(error).__name__}: {error}"
        finally:
            workers.put(worker)

    with ThreadPoolExecutor(jobs) as threads:
        bar = tqdm(threads.map(one, names), total=len(names), delay=2.0, unit="scene", disable=None)
        yield from zip(names, bar, strict=True)
    for _ in range(jobs):
        workers.get().shutdown()


def _worker() -> ProcessPoolExecutor:
    return ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn"))


def as_text(value: Any, depth: int = 6, pad: str = "") -> str:
    """JSON with a line for each channel."""
    if not isinstance(value, dict) or not value or depth == 0:
        return json.dumps(value)
    rows = (f"{pad} {json.dumps(key)}: {as_text(part, depth - 1, pad + ' ')}" for key, part in value.items())
    return "{\n" + ",\n".join(rows) + f"\n{pad}}}"


def make(names: Sequence[str], asked: argparse.Namespace) -> int:
    """Write the record, unless a scene fails; where not all are asked for, the others stay as they are."""
    told = versions()
    kept: Record = {}
    if len(names) < len(CASES):
        before = json.loads(asked.file.read_text(encoding="utf-8"))
        if before["versions"] != told:
            raise SystemExit(
                f"{asked.file} was made with {before['versions']}, here is {told}: record all scenes"
            )
        kept = before["scenes"]
    good = True
    for name, found in run_all(names, asked.jobs):
        if isinstance(found, str):
            tqdm.write(f"{name:40} FAILED: {found}")
            good = False
        else:
            kept[name] = found
    if not good:
        print(f"{asked.file} stays as it is")
        return 1
    scenes = {name: kept[name] for name in CASES if name in kept}
    text = as_text({"format": FORMAT, "versions": told, "scenes": scenes})
    asked.file.write_text(text + "\n", encoding="utf-8")
    print(f"{asked.file}: {len(scenes)} scenes, {len(text) / 1e6:.2f} MB")
    return 0


def told_of(
    name: str, found: list[Difference], tolerance: float, allowed: Sequence[Change]
) -> tuple[str, bool]:
    """One line on a scene, and whether it is as it should be."""
    if not found:
        return f"{name:40} same bits", True
    expected = {one: one.expected(name, allowed) for one in found if one.size > tolerance}
    bad = [one for one, change in expected.items() if change is None]
    more = f", and {len(bad) - 1} more" if len(bad) > 1 else ""
    reasons = sorted({f"expected: {change.reason}" for change in expected.values() if change})
    line = f"{(bad or found)[0]}{more}" + "".join(f"; {reason}" for reason in reasons)
    return f"{name:40} {line}", not bad


def check(names: Sequence[str], asked: argparse.Namespace) -> int:
    """Run again, and tell of each scene in a line what differs from the record."""
    before = json.loads(asked.file.read_text(encoding="utf-8"))
    for what, now in versions().items():
        if before["versions"].get(what) != now:
            print(f"recorded with {what} {before['versions'].get(what)}, here is {now}")
    renamed, allowed = Renamed.read(), changes()
    good = True
    for name, found in run_all(names, asked.jobs):
        if isinstance(found, str):
            line, well = f"{name:40} FAILED: {found}", False
        elif name not in before["scenes"]:
            line, well = f"{name:40} not in the record: record it", False
        else:
            told = differences(before["scenes"][name], found, renamed)
            line, well = told_of(name, told, asked.tolerance, allowed)
        tqdm.write(line)
        good = good and well
    for name in before["scenes"].keys() - CASES.keys():
        tqdm.write(f"{name:40} in the record, and no scene any more")
        good = False
    print("as recorded" if good else "not as recorded")
    return 0 if good else 1


def main(given: Sequence[str] | None = None) -> int:
    asked = arguments(given)
    names = chosen(asked.scenes, CASES)
    return make(names, asked) if asked.record else check(names, asked)


if __name__ == "__main__":
    sys.exit(main())
