"""Inserts worked examples into the code: ``python tools/additions.py screw cash_karp [--into FOLDER]``.

An addition is a folder of ``docs/additions``: its new files, where they belong, and ``additions.toml``, which
says after which words of a file what is inserted. The words stand once in that file. Blanks and line breaks
between them do not matter, so that what others add or wrap beside them does not either.
"""

from __future__ import annotations

import argparse
import re
import shutil
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ADDITIONS = ROOT / "docs" / "additions"


@dataclass(frozen=True)
class Insertion:
    """`text` goes behind the words `after` of a file."""

    file: str
    after: str
    text: str

    def into(self, root: Path) -> None:
        """Insert; raises ValueError where the words are not there, or more than once."""
        path = root / self.file
        old = path.read_text(encoding="utf-8")
        path.write_text(old[: self.place(old)] + self.text + old[self.place(old) :], encoding="utf-8")

    def place(self, text: str) -> int:
        """Where the words end; raises ValueError."""
        words = r"\s+".join(re.escape(word) for word in self.after.split())
        found = [match.end() for match in re.finditer(words, text)]
        if len(found) != 1:
            raise ValueError(f"{self.file} holds {self.after!r} {len(found)} times; it has to hold it once")
        return found[0]


@dataclass(frozen=True)
class Addition:
    """A worked example."""

    name: str
    about: str
    insertions: tuple[Insertion, ...]
    new: tuple[str, ...]  # files, relative to the repository

    @property
    def touched(self) -> set[str]:
        return {*self.new, *(one.file for one in self.insertions)}

    def into(self, root: Path) -> None:
        """Add it to the code in a folder; raises ValueError where it does not fit."""
        for insertion in self.insertions:
            insertion.into(root)
        for file in self.new:
            if (root / file).exists():
                raise ValueError(f"{file} is there already")
            (root / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ADDITIONS / self.name / file, root / file)


def addition(name: str) -> Addition:
    """The worked example of a name."""
    folder = ADDITIONS / name
    table = tomllib.loads((folder / "additions.toml").read_text(encoding="utf-8"))
    files = (path.relative_to(folder) for path in sorted(folder.rglob("*.[hc]pp")))
    insertions = tuple(Insertion(**one) for one in table["insert"])
    return Addition(name, table["about"], insertions, tuple(file.as_posix() for file in files))


NAMES = sorted(path.parent.name for path in ADDITIONS.glob("*/additions.toml"))


def main() -> None:
    """Insert the additions that are named."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("name", nargs="+", choices=NAMES)
    parser.add_argument("--into", type=Path, default=ROOT, help="another copy of the repository")
    options = parser.parse_args()
    for name in options.name:
        addition(name).into(options.into)


if __name__ == "__main__":
    main()
