"""Writes the table of formats into docs/hydrodynamics.md, from the readers that are registered."""

from __future__ import annotations

from pathlib import Path

from seacrane.hydro.readers.format import told_of
from seacrane.hydro.readers.load import FORMATS

DOCUMENT = Path(__file__).parents[1] / "docs" / "hydrodynamics.md"
BEGIN, END = "<!-- begin: tools/reader_table.py -->\n", "<!-- end -->\n"


def table() -> str:
    """The generated block, its marks included."""
    rows = "".join(
        f"| {name} | {files} | {looks} | {', '.join(f'`{one}`' for one in given.split(', ') if one)} |\n"
        for name, files, looks, given in told_of(FORMATS)
    )
    return f"{BEGIN}| kind | files | known by | may be given |\n|---|---|---|---|\n{rows}{END}"


def current(text: str) -> str:
    """A document with the block made anew."""
    before, _, rest = text.partition(BEGIN)
    return before + table() + rest.partition(END)[2]


if __name__ == "__main__":
    DOCUMENT.write_text(current(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")
