"""A table that somebody decides by: what it tells, how it is measured, and which sources it depends on."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import sources
from .table import write

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "benchmarks" / "results"


@dataclass(frozen=True, kw_only=True)
class Section:
    """One table with its heading and the sentences that say how it was measured.

    Attributes
    ----------
    title, text, head : what a reader sees.
    rows : measures them.
    sources : files, folders or globs that the numbers depend on, besides the module of `rows`.
    name : of its file; "": from the title.
    of : tables that it is made of.
    needs : what has to be there before it can be measured, in words; "" where all is.
    """

    title: str
    text: str
    head: Sequence[str]
    rows: Callable[[], Iterable[Sequence[Any]]]
    sources: Sequence[str] = ()
    name: str = ""
    of: Sequence[str] = ()
    needs: Callable[[], str] = str

    @property
    def path(self) -> Path:
        """Of its published file: the name, or the title in lower-case words joined by hyphens."""
        name = self.name or re.sub(r"[^a-z0-9]+", "-", self.title.lower()).strip("-")
        return RESULTS / f"{name}.csv"

    @property
    def globs(self) -> tuple[str, ...]:
        """Its sources, and the module that measures it."""
        own = Path(inspect.getfile(inspect.unwrap(self.rows))).resolve()
        return (*self.sources, own.relative_to(ROOT).as_posix())

    def measure(self, *, cpu: Callable[[], float], path: Path | None = None) -> None:
        """Measure and write the table, with what measured it and what that took by a clock in s."""
        before = cpu()
        rows = [[cell(value) for value in row] for row in self.rows()]
        of = [RESULTS / f"{name}.csv" for name in self.of]
        write(path or self.path, self.head, rows, of=of, globs=self.globs, cpu_s=cpu() - before)

    @property
    def stale(self) -> str:
        """Why it has to be measured again; "" where it has not."""
        return sources.stale(self.path, self.globs)

    @property
    def marked(self) -> str:
        """Heading, text, and a mark that `benchmarks/documents.py` fills with the table."""
        mark = f"<!-- table {self.path.relative_to(ROOT).as_posix()} -->\n<!-- end of table -->"
        return f"### {self.title}\n\n{self.text}\n\n{mark}\n"


def cell(value: Any) -> str:
    """As it is published, numbers to three significant digits."""
    if value is None:
        return ""
    return significant(value) if isinstance(value, float) else str(value)


def significant(value: float, digits: int = 3) -> str:
    """A number with so many significant digits, without an exponent where it stays short."""
    text = f"{value:.{digits}g}"
    if "e" in text and 1.0 <= abs(value) < 1e7:
        return f"{value:.0f}"
    return text
