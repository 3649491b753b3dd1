"""What measured a table, and whether the sources that it depends on are still the same."""

from __future__ import annotations

import ast
import hashlib
import json
import re
from collections.abc import Sequence
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from seacrane.inputs.atomic import atomic_write

from .machine import processor

ROOT = Path(__file__).resolve().parents[2]
LIST = "measured.json"  # in a folder of tables: by file, what measured it
KINDS = (".hpp", ".cpp", ".in", ".cmake", ".py", ".json", ".toml", ".nc", ".csv", ".txt")
# What the compiler reads, group 1, among comments and blanks. Comments of CMake count as code.
TOKENS = re.compile(r"""//[^\n]*|/\*.*?\*/|\s+|("(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])'|.)""", re.DOTALL)

ENGINE = ("cpp/seacrane", "cpp/bindings", "cpp/lanes", "cmake")
STEPS = (
    *(f"cpp/seacrane/{room}" for room in ("compile", "dynamics", "integrate", "math", "model", "run")),
    "cpp/seacrane/elements/*.hpp", "cpp/seacrane/elements/joints", "cmake",
)  # fmt: skip
WATER = ("cpp/seacrane/hydro", "cpp/seacrane/sea", "python/seacrane/sea")
RUN = ("python/seacrane/run", "python/seacrane/scene", "python/seacrane/description")
HULL = ("python/seacrane/hydro", "python/seacrane/data/*.nc")
CRANE = (
    *STEPS, *WATER, *RUN, *HULL, "python/seacrane/crane", "python/seacrane/cases.py",
    "python/seacrane/data/cranes/*.toml",
)  # fmt: skip
LINE = ("cpp/seacrane/elements/loads/*line*", "cpp/seacrane/elements/loads/*span*")
LANES = ("cpp/seacrane/lanes", "cpp/lanes", "python/seacrane/ensembles")


def code_of(text: str) -> str:
    """C++ without comments, and without blanks outside its texts."""
    return TOKENS.sub(lambda found: found[1] or "", text)


def python_of(text: str) -> str:
    """Python without comments, layout and docstrings."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        first = body[0] if isinstance(body, list) and body else None
        if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
            body.remove(first)
    return ast.dump(tree)


@cache
def _digest_of(path: Path) -> str:
    """Of the code of one file."""
    if path.suffix in (".hpp", ".cpp", ".in"):
        data = code_of(path.read_text(encoding="utf-8")).encode()
    elif path.suffix == ".py":
        data = python_of(path.read_text(encoding="utf-8")).encode()
    else:
        data = path.read_bytes()
    return hashlib.sha256(data).hexdigest()


def digest(globs: Sequence[str], root: Path = ROOT) -> str:
    """Of the sources that globs name; a folder is all that lies below it.

    Raises ValueError where a glob names nothing: it was moved or mistyped.
    """
    files: set[Path] = set()
    for glob in globs:
        found = [one for path in root.glob(glob) for one in (path.rglob("*") if path.is_dir() else [path])]
        found = [path for path in found if path.suffix in KINDS]
        if not found:
            raise ValueError(f"no source is called {glob}")
        files.update(found)
    told = "".join(f"{path.relative_to(root).as_posix()} {_digest_of(path)}\n" for path in sorted(files))
    return hashlib.sha256(told.encode()).hexdigest()[:12]


def engine(root: Path = ROOT) -> str:
    """A digest of the sources that make the compiled core. Comments and layout do not count."""
    return digest(ENGINE, root)


def record(
    table: Path, *, globs: Sequence[str] = (), of: Sequence[Path] = (), cpu_s: float | None = None
) -> None:
    """Note beside a table that this engine measured it now, and the sources of then.

    A table made `of` others is of the engine of the first one.
    """
    told: dict[str, Any] = {
        "engine": engine(), "seacrane": version("seacrane"), "machine": processor(),
        "day": datetime.now(UTC).date().isoformat(),
    }  # fmt: skip
    if of:
        told = {key: value for key, value in (measured(of[0]) or {}).items() if key in told}
    if globs:
        told["sources"] = digest(globs)
    if cpu_s is not None:
        told["cpu_s"] = round(cpu_s, 1)
    known = _list(table.parent) | {table.name: told}
    known = {name: known[name] for name in sorted(known) if (table.parent / name).is_file()}
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(one)}" for name, one in known.items())
    with atomic_write(table.parent / LIST) as draft:
        draft.write_text(f"{{\n{lines}\n}}\n", encoding="utf-8")


def measured(table: Path) -> dict[str, Any] | None:
    """What measured a table; None where nobody noted it."""
    return _list(table.parent).get(table.name)


def words(table: Path) -> str:
    """The same for a reader, in one line."""
    told = measured(table)
    if not told:
        return "Engine and machine not recorded."
    return f"seacrane {told['seacrane']}, engine {told['engine']}, {told['machine']}, {told['day']}."


def stale(table: Path, globs: Sequence[str]) -> str:
    """Why a table has to be measured again; "" where its sources are those that it was measured with."""
    if not table.is_file():
        return "never measured"
    told = measured(table) or {}
    if "sources" not in told:
        return "its sources were not recorded"
    return "" if told["sources"] == digest(globs) else "its sources have changed"


def _list(folder: Path) -> dict[str, dict[str, Any]]:
    path = folder / LIST
    return dict(json.loads(path.read_text(encoding="utf-8"))) if path.is_file() else {}
