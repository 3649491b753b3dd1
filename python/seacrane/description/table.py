"""The elements of one kind, by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NoReturn, TypeVar

Element = TypeVar("Element")


class Table(dict[str, Element]):
    """Elements of one kind by name, in the order in which they were added; a name that is not there says so.

    Parameters
    ----------
    kind : str
        What its elements are called, such as "point force".
    """

    kind: str

    def __init__(self, kind: str, elements: Mapping[str, Element] | None = None) -> None:
        super().__init__(elements or {})
        self.kind = kind

    def __missing__(self, name: object) -> NoReturn:
        known = ", ".join(map(repr, self)) or "none"
        raise KeyError(f"there is no {self.kind} {name!r}; the scene has {known}")
