"""Where a document links to a table of measurements, the site shows it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

BENCHMARKS = Path(__file__).resolve().parents[2] / "benchmarks"


def show(app: Any, name: str, source: list[str]) -> None:
    """Put the tables into the text of a document that has just been read."""
    if "<!-- place " not in source[0]:
        return
    if str(BENCHMARKS) not in sys.path:
        sys.path.append(str(BENCHMARKS))
    import documents

    source[0] = documents.with_tables(source[0])
