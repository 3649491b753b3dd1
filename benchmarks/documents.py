"""Fills the tables of documents from files of measurements: ``python benchmarks/documents.py [--check]``.

A document marks a table by the file that it shows, relative to the repository:

    <!-- table benchmarks/results/wave-loads.csv; columns: components | table; rows: components = 10 | 300 -->
    <!-- end of table -->

Without `columns` and `rows` it shows all of them. Cells are shown as the file holds them, and below them
what measured them. A mark `sources measured` gets where the measured sets are from.
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

from measure.sources import words
from measure.table import markdown, read

ROOT = Path(__file__).resolve().parents[1]
PLACES = ("*.md", "docs/*.md", "benchmarks/**/*.md", "notebooks/*.md")
PLACES += ("examples/*/*.md", "studies/*/*.md", "tests/*/*.md")  # beside what they describe
DOCUMENTS = [path for place in PLACES for path in sorted(ROOT.glob(place))]
BLOCK = re.compile(
    r"^<!-- (?P<word>table|sources) (?P<file>[^;\s]+)(?P<options>(;[^>]*?)?) -->\n"
    r".*?<!-- end of (?P=word) -->",
    re.DOTALL | re.MULTILINE,
)


def filled(text: str) -> str:
    """The document with every marked table as its file has it."""
    makers = {"table": _table, "sources": _sources}
    return BLOCK.sub(lambda match: makers[match["word"]](match), text)


def _table(match: re.Match[str]) -> str:
    head, rows = read(ROOT / match["file"])
    shown = list(range(len(head)))
    for option in match["options"].split(";")[1:]:
        name, value = (part.strip() for part in option.split(":", 1))
        if name == "columns":
            shown = [head.index(column) for column in _items(value)]
        elif name == "rows":
            column, wanted = (part.strip() for part in value.split("=", 1))
            rows = [row for row in rows if row[head.index(column)] in _items(wanted)]
        else:
            raise ValueError(f"{match['file']}: a table has no option {name!r}; give columns or rows")
    table = markdown([head[k] for k in shown], [[row[k] for k in shown] for row in rows])
    told = f"<p><sub>{words(ROOT / match['file'])}</sub></p>"
    return f"<!-- table {match['file']}{match['options']} -->\n{table}\n{told}<!-- end of table -->"


def _sources(match: re.Match[str]) -> str:
    """Where a reader finds each measured set."""
    import measurements

    table = markdown(measurements.SOURCE_HEAD, measurements.sources())
    return f"<!-- sources {match['file']} -->\n{table}\n<!-- end of sources -->"


def _items(text: str) -> list[str]:
    return [item.strip() for item in text.split("|")]


def fill(*, change: bool = True) -> list[Path]:
    """The documents with a table that is not as its file has it; mended unless `change` is False."""
    stale = []
    for path in DOCUMENTS:
        old = path.read_text(encoding="utf-8")
        new = filled(old)
        if new != old:
            stale.append(path)
            if change:
                path.write_text(new, encoding="utf-8")
    return stale


def main() -> int:
    """Fill the documents, or name those that are stale."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--check", action="store_true", help="change nothing; fail where a table is stale")
    check = parser.parse_args().check
    stale = fill(change=not check)
    for path in stale:
        print(f"{path.relative_to(ROOT)}: {'stale' if check else 'filled'}", file=sys.stderr)
    return int(check and bool(stale))


if __name__ == "__main__":
    raise SystemExit(main())
