"""The public names of the package, from its one list, by the room or the public module where they live."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import Any

import seacrane


def pages() -> dict[str, list[str]]:
    """Full public names by room: each once, as short as it is public, in the order of the list."""
    found: dict[str, list[str]] = {}
    for public, value in _values().items():
        found.setdefault(_room(public, value), []).append(public)
    return dict(sorted(found.items()))


def homes() -> dict[str, str]:
    """The public name of each class and function, by the name under which its own module knows it."""
    return {f"{value.__module__}.{value.__qualname__}": public for public, value in _values().items()}


def about(room: str) -> str:
    """What the room says about itself."""
    return (import_module(f"seacrane.{room}").__doc__ or "").strip()


def _values() -> dict[str, Any]:
    """Every public class and function; of a module's those that the package does not offer itself."""
    short = {f"seacrane.{name}": getattr(seacrane, name) for name in _callables(seacrane)}
    known = [id(value) for value in short.values()]
    longer = {
        f"seacrane.{module}.{name}": getattr(face, name)
        for module, face in _modules().items()
        for name in _callables(face)
        if id(getattr(face, name)) not in known
    }
    return short | longer


def _modules() -> dict[str, ModuleType]:
    faces = {name: getattr(seacrane, name) for name in seacrane.__all__}
    return {name: face for name, face in faces.items() if isinstance(face, ModuleType)}


def _callables(face: ModuleType) -> list[str]:
    """A module without a list of public names offers what it defines itself."""
    if hasattr(face, "__all__"):
        return [name for name in face.__all__ if callable(getattr(face, name))]
    own = {name: value for name, value in vars(face).items() if not name.startswith("_")}
    return [name for name, value in own.items() if getattr(value, "__module__", "") == face.__name__]


def _room(public: str, value: Any) -> str:
    """The public module that offers the value, else the part of the package that holds it."""
    name = public.rpartition(".")[2]
    offered = [room for room, face in _modules().items() if name in _callables(face)]
    return offered[0] if offered else value.__module__.split(".")[1]
