"""Print the requirements that pyproject.toml lists: `build`, `run`, or the name of an extra, one per line."""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path


def requirements(kind: str) -> list[str]:
    """Requirements of one kind, as written in pyproject.toml."""
    settings = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8"))
    if kind == "build":
        return list(settings["build-system"]["requires"])
    if kind == "run":
        return list(settings["project"]["dependencies"])
    return list(settings["project"]["optional-dependencies"][kind])


if __name__ == "__main__":
    print("\n".join(line for kind in sys.argv[1:] for line in requirements(kind)))
