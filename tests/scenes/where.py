"""Where something belongs, for messages of tests that find it missing."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def at(file: str, words: str) -> str:
    """The file and the number of its first line with these words."""
    lines = (ROOT / file).read_text(encoding="utf-8").splitlines()
    return f"{file}:{next(i for i, line in enumerate(lines, start=1) if words in line)}"


def in_header_of(kind: str) -> str:
    """Where the header of a kind of load says what it is."""
    words, loads = f'kind = "{kind}"', sorted((ROOT / "cpp/seacrane/elements/loads").glob("*.hpp"))
    found = next(path for path in loads if words in path.read_text(encoding="utf-8"))
    return at(found.relative_to(ROOT).as_posix(), words)
