"""The public names of the package by module, in the order of their lists, each under its shortest address."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import Any

import seacrane


def pages() -> dict[str, list[str]]:
    """Public classes and functions by module: each is of one module, and many stand at the top too."""
    return {
        module: [
            f"seacrane.{name}" if name in seacrane.__dict__["homes"] else f"seacrane.{module}.{name}"
            for name in _callables(face)
        ]
        for module, face in _modules().items()
    }


def homes() -> dict[str, str]:
    """The public name of each class and function, by the name under which its own module knows it."""
    values = {public: _value(public) for names in pages().values() for public in names}
    return {f"{value.__module__}.{value.__qualname__}": public for public, value in values.items()}


def about(module: str) -> str:
    """What the module says about itself."""
    return (import_module(f"seacrane.{module}").__doc__ or "").strip()


def _value(public: str) -> Any:
    module, _, name = public.rpartition(".")
    return getattr(import_module(module), name)


def _modules() -> dict[str, ModuleType]:
    faces = {name: getattr(seacrane, name) for name in seacrane.__dict__["homes"]}
    return {name: face for name, face in faces.items() if isinstance(face, ModuleType)}


def _callables(face: ModuleType) -> list[str]:
    """A module without a list of public names offers all that it defines."""
    names = getattr(face, "__all__", [name for name in vars(face) if not name.startswith("_")])
    return [name for name in names if callable(getattr(face, name))]
