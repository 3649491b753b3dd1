"""A package's public names from its stub, each imported when it is first used.

``__init__.pyi`` beside a package's ``__init__.py`` is the one list of its names, a line "from home import
name as name" for each: type checkers and editors read it, and so does this module.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any

from seacrane.renamed import NAMES

Face = tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]


def face(package: str, file: str) -> Face:
    """``__getattr__``, ``__dir__`` and ``__all__`` of a package, for its ``__init__.py`` at ``file``."""
    homes = _homes(f"{file}i")

    def get(name: str) -> Any:
        if package == "seacrane" and name in NAMES:  # an AttributeError would lose its text in an import
            raise ImportError(
                f"{package} has no {name!r} since 0.3; it is 'seacrane.{NAMES[name]}'", name=name
            )
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        home = homes[name]
        value = import_module(f"{home}.{name}") if home == package else getattr(import_module(home), name)
        setattr(sys.modules[package], name, value)
        return value

    return get, lambda: sorted(homes), sorted(homes)


def _homes(stub: str) -> dict[str, str]:
    """The module of each name that a stub imports; a package's own modules come from the package itself."""
    with open(stub, encoding="utf-8") as file:
        lines = [line.split() for line in file if line.startswith("from ")]
    return {name: home for _, home, _, _, _, name in lines}
