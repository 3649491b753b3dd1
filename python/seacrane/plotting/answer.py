"""Answers that print as one table, wherever they are shown."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from seacrane.plotting.html import notebook_table
from seacrane.plotting.text import text_table


@dataclass(frozen=True, kw_only=True)
class Table:
    """Columns of texts.

    Attributes
    ----------
    head : Of each column, its unit in brackets.
    rows : Of texts.
    right : Columns that are aligned to the right.
    title : Above the table.
    caption : What a notebook has in its place.
    remarks : Below the table, a line each.
    """

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    right: Collection[int] = ()
    title: str = ""
    caption: str = ""
    remarks: Sequence[str] = ()

    def __str__(self) -> str:
        lines = [self.title] if self.title else []
        if self.rows:
            lines.append(text_table(self.head, self.rows, right=self.right))
        return "\n".join([*lines, *self.remarks])

    def html(self) -> str:
        """For an output cell of a notebook."""
        return notebook_table(
            self.head, self.rows, caption=self.caption or self.title, notes=self.remarks, right=self.right
        )


class Answer(ABC):
    """What says which columns it has, and so prints at a prompt and in a notebook."""

    @abstractmethod
    def _shown(self) -> Table:
        """As it is read."""

    def __str__(self) -> str:
        return str(self._shown())

    def _repr_html_(self) -> str:
        return self._shown().html()
