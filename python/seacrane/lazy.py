"""A public module's names from its stub, each imported when it is first used.

``__init__.pyi`` beside a package's ``__init__.py`` is the one list of its names, a line "from home import
name as name" for each, in the order of a user's work: type checkers and editors read it, and so does this
module. A name that is not in the list is not there, whatever the package has imported.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Collection
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

TOP = __name__.partition(".")[0]


class Face(ModuleType):
    """A package that shows the names of its stub and nothing else."""

    homes: dict[str, str]

    def __getattr__(self, name: str) -> Any:
        if name not in self.homes:
            raise self._refused(name)
        home = self.homes[name]
        own = home == self.__name__
        value = import_module(f"{home}.{name}") if own else getattr(import_module(home), name)
        super().__setattr__(name, value)
        return value

    def __setattr__(self, name: str, value: Any) -> None:
        """A module within the package that is named as something public does not take its place."""
        if not isinstance(value, ModuleType) or self.homes.get(name, self.__name__) == self.__name__:
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return list(self.homes)

    def _refused(self, name: str) -> Exception:
        """An AttributeError, or an ImportError for ``from seacrane import name``, which hides such words."""
        text = f"module {self.__name__!r} has no attribute {name!r}"
        within = any((Path(path) / f"{name}.py").exists() for path in self.__path__)
        if within or name.startswith("_"):
            return AttributeError(text)
        public, near = _address(name), get_close_matches(name, self.homes, 1)
        if public:
            asked_by = sys._getframe(2).f_code.co_name
            kind = ImportError if asked_by == "_handle_fromlist" else AttributeError
            return kind(f"{text}; it is {public}")
        return AttributeError(text + (f"; did you mean {near[0]!r}?" if near else ""))


def face(package: str, file: str) -> list[str]:
    """Make a package show the names of its stub, which lies beside ``file``; they are its ``__all__``.

    But modules named as one of Python's own, such as `warnings`, which ``import *`` would hide.
    """
    module = sys.modules[package]
    module.__class__ = Face
    module.__dict__["homes"] = _homes(f"{file}i")
    homes: dict[str, str] = module.__dict__["homes"]
    return [name for name, home in homes.items() if home != package or name not in sys.stdlib_module_names]


def _homes(stub: str) -> dict[str, str]:
    """The module of each name that a stub imports; a package's own modules come from the package itself."""
    with open(stub, encoding="utf-8") as file:
        lines = [line.split() for line in file if line.startswith("from ")]
    return {name: home for _, home, _, _, _, name in lines}


def _address(name: str) -> str | None:
    """Where a name is public: at the top before other modules."""
    folder = Path(__file__).parent
    top = _homes(str(folder / "__init__.pyi"))
    if name in top:
        return f"{TOP}.{name}"
    modules = [module for module, home in top.items() if home == TOP]
    return next((f"{TOP}.{one}.{name}" for one in modules if name in _offered(folder / one)), None)


def _offered(place: Path) -> Collection[str]:
    """Names of a public module, read from its file: a stub, or the module itself where it is one file."""
    if place.is_dir():
        return _homes(str(place / "__init__.pyi"))
    stub = place.with_suffix(".pyi")
    text = (stub if stub.exists() else place.with_suffix(".py")).read_text(encoding="utf-8")
    return re.findall(r"^(?:class|def) (\w+)", text, re.MULTILINE)
