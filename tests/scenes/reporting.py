"""What a run of the tests tells: a table of what items cost, and progress in a few lines."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest


class TimesTable:
    """Writes a table of what items cost, the dearest first; those below SHOWN s together."""

    SHOWN = 0.2

    def __init__(self, file: Path) -> None:
        self.file = file
        self.rows: list[tuple[str, float, float]] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Take the seconds of an item from its last report."""
        for name, value in report.user_properties:
            if name == "seconds":
                self.rows.append((report.nodeid, *value))

    def pytest_sessionfinish(self) -> None:
        """Write, when all have run."""
        self.rows.sort(key=lambda row: -row[1])
        shown = [row for row in self.rows if row[1] >= self.SHOWN]
        rest = self.rows[len(shown) :]
        sums = [(f"{len(rest)} others", *(sum(row[k] for row in rest) for k in (1, 2)))]
        lines = [(name, f"{cpu:.2f}", f"{wall:.2f}") for name, cpu, wall in shown + sums]
        self.file.parent.mkdir(parents=True, exist_ok=True)
        with self.file.open("w", newline="", encoding="utf-8") as out:
            csv.writer(out, lineterminator="\n").writerows([("item", "cpu_s", "wall_s"), *lines])


class Tenths:
    """Tells of progress once in a tenth of the items, and of what fails at once."""

    def __init__(self) -> None:
        self.all = self.done = 0

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Know how many there are."""
        self.all = len(session.items)

    def pytest_xdist_node_collection_finished(self, node: object, ids: list[str]) -> None:
        """Know how many there are: workers collect all."""
        self.all = len(ids)

    @pytest.hookimpl(tryfirst=True)
    def pytest_report_teststatus(self, report: pytest.TestReport) -> tuple[str, str, str] | None:
        """No letter for what went as it should."""
        if report.passed and report.when == "call" and not hasattr(report, "wasxfail"):
            return "passed", "", ""
        return ("skipped", "", "") if report.skipped and not hasattr(report, "wasxfail") else None

    def pytest_runtest_logfinish(self, nodeid: str) -> None:
        """Count, and tell."""
        self.done += 1
        if self.done * 10 // self.all > (self.done - 1) * 10 // self.all:
            print(f"{self.done} of {self.all}", flush=True)
