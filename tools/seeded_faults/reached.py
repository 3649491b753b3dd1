"""Which tests reach a fault's line, by one run of all under coverage; those that reach little else first."""

from __future__ import annotations

import sqlite3
from pathlib import Path

from coverage import Coverage, CoverageData

SETTINGS = """[run]
source_pkgs = seacrane
parallel = true
patch = subprocess
data_file = {file}
"""


def pytest_runtest_logstart(nodeid: str) -> None:
    """This module is pytest's plugin in that run: what a test and its fixtures reach goes by its name."""
    meter = Coverage.current()
    if meter is not None:
        meter.switch_context(nodeid.partition("[")[0])


def commands(tests: str, folder: Path) -> list[str]:
    """The run, where `folder` does not hold it yet."""
    folder.mkdir(exist_ok=True)
    settings = folder / "settings"
    settings.write_text(SETTINGS.format(file=folder / "lines"), encoding="utf-8")
    python, _, rest = tests.partition(" ")
    meter = f"{python} -m coverage"
    run = f"env PYTHONPATH={Path(__file__).parents[1]} {meter} run --rcfile={settings} {rest} -p {__name__}"
    return [] if (folder / "lines").exists() else [run, f"{meter} combine --rcfile={settings}"]


def tests_of(folder: Path, file: str, line: int) -> tuple[list[str], bool]:
    """Tests that reach a line of a file of the package, and whether imports or child processes do too."""
    data = CoverageData(str(folder / "lines"))
    data.read()
    found: set[str] = set()
    for path in data.measured_files():
        if path.endswith(file.removeprefix("python/")):
            reached = data.contexts_by_lineno(path)
            begun = max((one for one in reached if one <= line), default=0)  # a statement of several lines
            found |= {*reached.get(begun, ())}
    reach = _lines_by_test(folder / "lines")
    return sorted(found - {""}, key=lambda name: reach[name]), "" in found


def _lines_by_test(file: Path) -> dict[str, int]:
    out: dict[str, int] = {}
    with sqlite3.connect(file) as table:
        rows = table.execute("select context, numbits from line_bits join context on context.id = context_id")
        for name, bits in rows:
            out[name] = out.get(name, 0) + int.from_bytes(bits).bit_count()
    return out
