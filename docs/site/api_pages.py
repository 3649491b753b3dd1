"""A page for each room of the public face: what the room is, a table of its names, then their docstrings."""

from __future__ import annotations

import inspect
from importlib import import_module
from pathlib import Path

import public_face


def write(folder: Path) -> None:
    """Write the pages; those of rooms that are gone vanish, those that stay as they are keep their date."""
    folder.mkdir(exist_ok=True)
    pages = {
        folder / f"{_title(room).lower()}.rst": page(room, names)
        for room, names in public_face.pages().items()
    }
    for old in set(folder.glob("*.rst")) - set(pages):
        old.unlink()
    for path, text in pages.items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def page(room: str, names: list[str]) -> str:
    """One page as reStructuredText."""
    title = _title(room)
    table = [".. autosummary::", "", *(f"   ~{name}" for name in names), ""]
    entries = [line for name in names for line in _entry(name)]
    return "\n".join([title, "=" * len(title), "", public_face.about(room), "", *table, *entries])


def _title(room: str) -> str:
    return room.strip("_").capitalize()


def _entry(name: str) -> list[str]:
    module, _, own = name.rpartition(".")
    value = getattr(import_module(module), own)
    head = [f".. currentmodule:: {module}", ""]
    if not inspect.isclass(value):
        return [*head, f".. autofunction:: {own}", ""]
    bases = ["   :show-inheritance:"] if issubclass(value, BaseException) else []
    return [*head, f".. autoclass:: {own}", "   :members:", *bases, ""]
