"""Which engine measured a table, and on which machine; and whether that is the engine of these sources."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Sequence
from datetime import UTC, datetime
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path

from .machine import processor

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("cpp/seacrane", "cpp/bindings", "cpp/lanes", "cmake")
NAMES = ("*.hpp", "*.cpp", "*.cmake")
LIST = "measured.json"  # in a folder of tables: by file, what measured it
# What the compiler reads, group 1, among comments and blanks. Comments of CMake count as code.
TOKENS = re.compile(r"""//[^\n]*|/\*.*?\*/|\s+|("(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])'|.)""", re.DOTALL)

SAME = ("engine", "seacrane", "machine")  # what one measurement has to share with another; the day may differ

Measured = dict[str, str]  # "engine", "seacrane", "machine", "day"


def code_of(text: str) -> str:
    """C++ without comments, and without blanks outside its texts."""
    return TOKENS.sub(lambda found: found[1] or "", text)


@lru_cache
def engine(root: Path = ROOT) -> str:
    """A digest of the sources that make the compiled core. Comments and layout do not count."""
    digest = hashlib.sha256()
    files = (path for folder in SOURCES for name in NAMES for path in (root / folder).rglob(name))
    for path in sorted(files):
        text = f"{path.relative_to(root).as_posix()}\n{code_of(path.read_text(encoding='utf-8'))}\n"
        digest.update(text.encode())
    return digest.hexdigest()[:12]


def record(table: Path, of: Sequence[Path] = ()) -> None:
    """Note beside a table that this engine measured it now; where it is made `of` tables, what theirs did."""
    told: Measured | None = {
        "engine": engine(), "seacrane": version("seacrane"), "machine": processor(),
        "day": datetime.now(UTC).date().isoformat(),
    }  # fmt: skip
    if of:
        every = [measured(one) or {} for one in of]
        shared = [[one.get(key) for key in SAME] for one in every]
        same = None not in shared[0] and all(one == shared[0] for one in shared)
        told = max(every, key=lambda one: one.get("day", "")) if same else None
    known = _list(table.parent)
    known.pop(table.name, None)
    if told:
        known[table.name] = told
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(known[name])}" for name in sorted(known))
    (table.parent / LIST).write_text(f"{{\n{lines}\n}}\n", encoding="utf-8")


def measured(table: Path) -> Measured | None:
    """What measured a table; None where nobody noted it."""
    return _list(table.parent).get(table.name)


def words(table: Path) -> str:
    """The same for a reader."""
    told = measured(table)
    if told is None:
        return "Engine and machine not recorded, or of several."
    return f"seacrane {told['seacrane']}, engine {told['engine']}, {told['machine']}, {told['day']}."


def of_another(root: Path = ROOT) -> list[Path]:
    """Published tables that these sources have not measured."""
    tables = sorted(root.glob("benchmarks/**/results/*.csv"))
    return [one for one in tables if (measured(one) or {}).get("engine") != engine(root)]


def _list(folder: Path) -> dict[str, Measured]:
    path = folder / LIST
    if not path.is_file():
        return {}
    found: dict[str, Measured] = json.loads(path.read_text(encoding="utf-8"))
    return found
