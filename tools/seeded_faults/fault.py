"""A fault: a text that stands once in a file of the sources, and what stands there instead."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Fault:
    """One fault, its file from the root of the tree; of a part of a statement in C++ its type."""

    name: str
    file: str
    old: str
    new: str
    kind: str = ""

    @property
    def in_engine(self) -> bool:
        """Whether it needs a compiler."""
        return self.file.startswith("cpp/")

    def seeded(self, text: str) -> str:
        """The file's text with the fault.

        Raises ValueError where the text has moved on: the fault goes with its code.
        """
        count = text.count(self.old)
        if count != 1:
            raise ValueError(
                f"fault {self.name!r}: its text stands {count} times in {self.file}; mend the fault"
            )
        return text.replace(self.old, self.new)


def faults() -> list[Fault]:
    """All, the package's first: they need no compiler."""
    out: list[Fault] = []
    for table in ("package.toml", "engine.toml"):
        entries = tomllib.loads((HERE / table).read_text(encoding="utf-8"))
        out += [Fault(name=name, **entry) for name, entry in entries.items()]
    return out
