"""What runs by night, one row after the other: ``python tools/nightly.py [ROW ...]`` (``make nightly``).

Each row is a target of the Makefile. A row that fails does not stop the next; what it printed is in
``out/nightly/<row>.log``. ``docs/nightly.md`` gets a line of each row that ran, with commit and day, in the
place of its last one; commit it. Exit code 1 if a row failed or was stopped.
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


HEAD = ("what", "CPU s", "wall s", "passed", "commit", "day")


@dataclass(frozen=True)
class Outcome:
    """How a row ended: s of processor time and of the wall, and the exit code."""

    row: str
    cpu: float
    wall: float
    code: int

    def cells(self, commit: str, day: str) -> tuple[str, ...]:
        """Its line of the table."""
        passed = "yes" if self.code == 0 else f"**no**, exit code {self.code}"
        return ROWS[self.row][1], f"{self.cpu:.0f}", f"{self.wall:.0f}", passed, commit, day


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


def table(lines: list[tuple[str, ...]]) -> str:
    """In Markdown."""
    return "\n".join("| " + " | ".join(cells) + " |" for cells in (HEAD, ("---",) * len(HEAD), *lines))


def kept() -> dict[str, tuple[str, ...]]:
    """Lines of the present document, by what they tell of."""
    text = TABLE.read_text(encoding="utf-8") if TABLE.exists() else ""
    lines = [tuple(cell.strip() for cell in line.strip("| ").split("|")) for line in text.splitlines()]
    return {cells[0]: cells for cells in lines if len(cells) == len(HEAD)}


def document(new: list[tuple[str, ...]]) -> str:
    """The page of the last nights: new lines in the place of older ones."""
    lines = kept() | {cells[0]: cells for cells in new}
    ordered = [lines[what] for _, what in ROWS.values() if what in lines]
    return (
        "# The last night\n\nWritten by `make nightly`, which runs what takes longer than `make test` may "
        "([contributing](contributing.md#by-day-and-by-night)). Each line\ntells of the last time that it "
        f"was run, on {os.cpu_count()} cores beside other work.\n\n{table(ordered)}\n"
    )


def commit() -> str:
    """The commit that is run, and whether files differ from it."""
    found = _git("rev-parse", "--short=10", "HEAD")
    changed = _git("status", "--porcelain", "--", ".", f":!{TABLE.relative_to(ROOT)}", ":!.ci/sanitized.txt")
    return f"{found} with changes" if changed else found


def _git(*words: str) -> str:
    done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.strip()


def main() -> int:
    """Run the rows that are asked for, keep and print their lines."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("rows", nargs="*", metavar="ROW", help=f"of {', '.join(ROWS)}; default all")
    asked = parser.parse_args().rows or list(ROWS)
    if unknown := sorted(set(asked) - ROWS.keys()):
        parser.error(f"no row {', '.join(unknown)}; there are {', '.join(ROWS)}")
    outcomes: list[Outcome] = []
    lines: list[tuple[str, ...]] = []
    for row in asked:
        print(f"{len(lines) + 1} of {len(asked)}, {row}: {ROWS[row][1]}", flush=True)
        state, day = commit(), datetime.date.today().isoformat()
        try:
            outcomes.append(run(row))
        except KeyboardInterrupt:
            print(f"stopped in {row}")
            break
        lines.append(outcomes[-1].cells(state, day))
        TABLE.write_text(document(lines), encoding="utf-8")
        print(
            f"    {outcomes[-1].wall:.0f} s, {'passed' if outcomes[-1].code == 0 else 'FAILED'}", flush=True
        )
    print(f"{table(lines)}\nwritten to {TABLE.relative_to(ROOT)}: commit it")
    return int(len(lines) < len(asked) or any(one.code for one in outcomes))


if __name__ == "__main__":
    sys.exit(main())
