"""What runs by night, one row after the other: ``python tools/nightly.py [ROW ...]`` (``make nightly``).

Each row is a target of the Makefile. A row that fails does not stop the next; what it printed is in
``out/nightly/<row>.log``. The table of all rows, with commit and date, goes to ``docs/nightly.md``, to be
committed; a call that names rows only prints its own. Exit code 1 if a row failed.
"""

from __future__ import annotations

import argparse
import datetime
import os
import shlex
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LOGS = ROOT / "out" / "nightly"
TABLE = ROOT / "docs" / "nightly.md"
# What `make` is called with, and what a reader of the table is told.
ROWS = {
    "tests": ("python-test PYTEST_ARGS='-m slow'", "slow Python tests"),
    "sanitizers": (
        "cpp-sanitize SANITIZE_BUILD=build/sanitize-all SANITIZE_NOT= UNITY=OFF",
        "C++ tests, every check of AddressSanitizer and UBSan, each file compiled by itself",
    ),
    "threads": ("cpp-tsan", "C++ tests of threads under ThreadSanitizer"),
    "bits": ("bits", "results kept in `bits.json`"),
    "validation": ("validation", "every comparison of validation and measurements"),
    "site": ("docs", "the site, notebooks executed"),
    "wheel": ("wheel", "sdist and wheel with all notebooks, tried where no compiler is"),
}


@dataclass(frozen=True)
class Outcome:
    """How a row ended: s of processor time and of the wall, and the exit code."""

    row: str
    cpu: float
    wall: float
    code: int


def run(row: str) -> Outcome:
    """Run one row; its output goes to its log."""
    LOGS.mkdir(parents=True, exist_ok=True)
    began = time.monotonic()
    with (LOGS / f"{row}.log").open("wb") as log:
        command = ["make", "--no-print-directory", *shlex.split(ROWS[row][0])]
        child = subprocess.Popen(command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        try:
            _, status, usage = os.wait4(child.pid, 0)
        except KeyboardInterrupt:
            child.wait()
            raise
    child.returncode = os.waitstatus_to_exitcode(status)
    return Outcome(row, usage.ru_utime + usage.ru_stime, time.monotonic() - began, child.returncode)


def table(outcomes: list[Outcome]) -> str:
    """The table in Markdown."""
    lines = ["| what | CPU s | wall s | passed |", "| --- | --- | --- | --- |"]
    for one in outcomes:
        passed = "yes" if one.code == 0 else f"**no**, exit code {one.code}"
        lines.append(f"| {ROWS[one.row][1]} | {one.cpu:.0f} | {one.wall:.0f} | {passed} |")
    cpu, wall = sum(one.cpu for one in outcomes), sum(one.wall for one in outcomes)
    return "\n".join(
        [*lines, f"| all | {cpu:.0f} | {wall:.0f} | {'yes' if passed_all(outcomes) else '**no**'} |"]
    )


def passed_all(outcomes: list[Outcome]) -> bool:
    """Whether every row passed."""
    return all(one.code == 0 for one in outcomes)


def commit() -> str:
    """The commit that was run, and whether files differ from it."""
    found = _git("rev-parse", "--short=10", "HEAD")
    return f"{found} with changes" if _git("status", "--porcelain") else found


def document(outcomes: list[Outcome], commit: str) -> str:
    """The page of the last night."""
    day = datetime.date.today().isoformat()
    return (
        "# The last night\n\nWritten by `make nightly`, which runs what takes longer than `make test` may "
        f"([contributing](contributing.md#by-day-and-by-night)).\n\nCommit {commit}, {day}, "
        f"{os.cpu_count()} cores.\n\n{table(outcomes)}\n"
    )


def _git(*words: str) -> str:
    done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.strip()


def main() -> int:
    """Run the rows that are asked for, print their table, keep it where all were."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("rows", nargs="*", metavar="ROW", help=f"of {', '.join(ROWS)}; default all")
    asked = parser.parse_args().rows or list(ROWS)
    if unknown := sorted(set(asked) - ROWS.keys()):
        parser.error(f"no row {', '.join(unknown)}; there are {', '.join(ROWS)}")
    outcomes: list[Outcome] = []
    state = commit()
    try:
        for row in asked:
            print(f"{len(outcomes) + 1} of {len(asked)}, {row}: {ROWS[row][1]}", flush=True)
            outcomes.append(run(row))
            print(
                f"    {outcomes[-1].wall:.0f} s, {'passed' if outcomes[-1].code == 0 else 'FAILED'}",
                flush=True,
            )
    except KeyboardInterrupt:
        print(f"stopped in {asked[len(outcomes)]}; what ran:")
        print(table(outcomes))
        return 130
    print(table(outcomes))
    if asked == list(ROWS):
        TABLE.write_text(document(outcomes, state), encoding="utf-8")
        print(f"written to {TABLE.relative_to(ROOT)}: commit it")
    return 0 if passed_all(outcomes) else 1


if __name__ == "__main__":
    sys.exit(main())
