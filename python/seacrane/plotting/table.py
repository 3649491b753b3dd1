"""One table: columns of numbers and texts, from which print, notebook, xarray, pandas and CSV follow."""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from html import escape
from itertools import product
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

import numpy as np

from seacrane.inputs.atomic import atomic_write

if TYPE_CHECKING:
    import pandas
    import xarray

READ: dict[str, tuple[float, str]] = {
    "rad": (float(np.degrees(1.0)), "deg"),
    "rad/s": (float(np.degrees(1.0)), "deg/s"),
    "N": (1e-3, "kN"),
    "N m": (1e-3, "kN m"),
    "Pa": (1e-5, "bar"),
}
NOTEBOOK = (  # whose own style would set texts to the right
    ".seacrane td, .seacrane th, .seacrane caption { text-align: left; } "
    ".seacrane td:first-child { white-space: nowrap; } .seacrane td.number { text-align: right; }"
)
WIDTH, LEAST_WIDTH = 110, 40  # letters of a line, and of the column that is wrapped for it


class Verdict(str):
    """A text that is good news or bad, and has its colour on a page; None: neither."""

    good: bool | None

    def __new__(cls, text: str, good: bool | None) -> Verdict:
        made = super().__new__(cls, text)
        made.good = good
        return made


def format_value(value: Any, form: str = ".5g") -> str:
    """A number by its form, a dash where it is not known, integers in full, anything else as it prints."""
    if isinstance(value, str):
        return value
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, (float, np.floating)):
        return "-" if np.isnan(value) else f"{float(value):{form}}"
    if isinstance(value, (list, tuple)):
        return ", ".join(format_value(item, form) for item in value)
    return "" if value is None else str(value)


def read_as(unit: str) -> tuple[float, str]:
    """Factor and unit in which an SI unit is read: kN, kN m, deg; others as they are."""
    return READ.get(unit, (1.0, unit))


@dataclass(frozen=True, kw_only=True, eq=False)
class Column:
    """What a table holds under one name.

    `values` over the axes of the table: numbers in SI units (`unit`), flags or texts; None where nothing
    applies. They print in the unit in which that is read, or as `read` has it (unit and values), below `head`
    (default: the name), by their `form`; numbers below `least` are zero up to rounding. One without a name is
    printed and no data, one that is not `printed` is data alone, over the axes `over` (default: all), with a
    `long_name`.
    """

    values: Any
    name: str = ""
    unit: str = ""
    head: str | None = None
    form: str = ".4g"
    least: float = 0.0
    read: tuple[str, Any] | None = None
    printed: bool = True
    over: Sequence[str] | None = None
    long_name: str = ""

    @property
    def read_unit(self) -> str:
        """The unit in which it is printed."""
        return read_as(self.unit)[1] if self.read is None else self.read[0]

    @property
    def heading(self) -> str:
        """What is printed above it."""
        head, unit = self.name if self.head is None else self.head, self.read_unit
        return f"{head} [{unit}]" if head and unit else head

    def texts(self) -> list[str]:
        """As it is printed, one after another."""
        factor = read_as(self.unit)[0] if self.read is None else 1.0
        values = _flat(self.values if self.read is None else self.read[1])
        if factor != 1.0:
            values = [None if one is None else factor * one for one in values]
        small = (isinstance(one, float) and abs(one) < self.least for one in values)
        shown = zip(values, small, strict=True)
        return [format_value(0.0 if zero else one, self.form) for one, zero in shown]

    def right(self) -> bool:
        """Whether it is aligned to the right, as numbers under a head are."""
        every = [*_flat(self.values), *([] if self.read is None else _flat(self.read[1]))]
        numbers = (isinstance(one, (int, float)) and not isinstance(one, bool) for one in every)
        return bool(self.heading) and any(numbers)

    def variable(self, dims: Sequence[str]) -> tuple[Sequence[str], Any, dict[str, str]]:
        """For xarray: what does not apply is not a number."""
        values = self.values
        if isinstance(values, (list, tuple)):
            values = [np.nan if one is None else one for one in values]
        told = {"units": self.unit, "long_name": self.long_name}
        return self.over or dims, np.array(values), {key: text for key, text in told.items() if text}


def _flat(values: Any) -> list[Any]:
    if isinstance(values, (np.ndarray, np.generic)):
        return list(np.ravel(values).tolist())
    return list(values) if isinstance(values, Iterable) and not isinstance(values, str) else [values]


class Answer(ABC):
    """What says which columns it has: it prints, shows itself in a notebook, and becomes data in SI units."""

    @abstractmethod
    def _shown(self) -> Table:
        """Its columns."""

    def _data(self) -> Table:
        """What it becomes as data, where that is not what it shows."""
        return self._shown()

    def __str__(self) -> str:
        """As a terminal shows it: the last column is wrapped."""
        table = self._shown()
        head, right, rows = table._printed()
        widths = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
        before = sum(widths[:-1]) + 2 * len(widths[:-1])
        lines = [table.title] if table.title else []
        for *first, last in [head, *rows] if rows and any(head) else rows:
            room = max(WIDTH - before, LEAST_WIDTH)
            parts = wrap(last, room, break_long_words=False, break_on_hyphens=False) or [""]
            parts = [last.rjust(widths[-1])] if right[-1] else parts
            cells = zip(first, widths, right, strict=False)
            start = "".join(f"{c.rjust(w) if to else c.ljust(w)}  " for c, w, to in cells)
            lines += [f"{start}{parts[0]}".rstrip(), *(f"{'':{before}}{part}" for part in parts[1:])]
        return "\n\n".join(["\n".join([*lines, *table.remarks]), *map(str, table.below)])

    def html(self) -> str:
        """Its tables alone, for a page; everything that a user may have named is escaped."""
        table = self._shown()
        head, right, rows = table._printed()
        title = escape(table.title)
        shown = f"<p>{title}</p>" if title else ""
        if rows:
            names = "".join(f"<th>{escape(name)}</th>" for name in head)
            top = f"<thead><tr>{names}</tr></thead>" if any(head) else ""
            lines = "\n".join(f"<tr>{''.join(map(_cell, row, right))}</tr>" for row in rows)
            kind = "" if top else ' class="facts"'
            caption = f"<caption>{title}</caption>" if title else ""
            shown = f"<table{kind}>{caption}{top}<tbody>\n{lines}\n</tbody></table>"
        notes = "".join(f'<p class="note">{escape(one)}</p>' for one in table.remarks)
        return shown + notes + "".join(one.html() for one in table.below)

    def __html__(self) -> str:
        """For templates, which take it as it is."""
        return self.html()

    def _repr_html_(self) -> str:
        return f'<div class="seacrane"><style>{NOTEBOOK}</style>{self.html()}</div>'

    def to_xarray(self) -> xarray.Dataset:
        """Columns over their axes, with their units."""
        import xarray

        table = self._data()
        if table.data is not None:
            return table.data.copy()
        dims = [axis.name for axis in table.axes if np.ndim(axis.values)]
        return xarray.Dataset(
            {one.name: one.variable(dims) for one in table.columns if one.name},
            {axis.name: axis.variable([axis.name][: np.ndim(axis.values)]) for axis in table.axes},
            dict(table.attributes),
        )

    def to_dataframe(self) -> pandas.DataFrame:
        """The same columns as a table, over the axes; `attrs["units"]` holds the units that are known."""
        import pandas

        data = self.to_xarray()
        if data.sizes:
            table = data.to_dataframe()
        else:
            table = pandas.DataFrame({name: [values.item()] for name, values in data.items()})
        units = {name: one.attrs["units"] for name, one in data.items() if "units" in one.attrs}
        table.attrs = {**data.attrs, "units": units}
        return table

    def to_csv(self, path: str | os.PathLike[str]) -> Path:
        """Write these columns as comma-separated values, units in brackets; returns the path.

        An older file of that name is replaced, complete or not at all. Raises OSError.
        """
        table, known = self.to_dataframe(), self.to_xarray().variables.items()
        named = {name: f"{name} [{one.attrs['units']}]" for name, one in known if "units" in one.attrs}
        index = [named.get(name, name) for name in table.index.names]
        with atomic_write(Path(path)) as draft:
            table.rename(columns=named).to_csv(draft, index=any(index), index_label=index)
        return Path(path)


@dataclass(frozen=True, kw_only=True, eq=False)
class Table(Answer):
    """Columns over axes. Without an axis it is one row, and prints names beside values.

    A row for each place of the axes, the last of them fastest; a number as an axis has no length. Above
    stands the title, below are remarks, a line each, and the tables `below`. As data it has `attributes`, or
    is `data`.
    """

    columns: Sequence[Column] = ()
    axes: Sequence[Column] = ()
    title: str = ""
    remarks: Sequence[str] = ()
    below: Sequence[Table] = ()
    attributes: Mapping[str, Any] = field(default_factory=dict)
    data: xarray.Dataset | None = None

    def _shown(self) -> Table:
        return self

    def _printed(self) -> tuple[list[str], list[bool], list[tuple[str, ...]]]:
        """Heads, what is aligned to the right, and rows."""
        shown = [one for one in self.columns if one.printed]
        if not self.axes:
            facts: list[tuple[str, ...]] = [(one.name, one.texts()[0], one.read_unit) for one in shown]
            return ["", "value", "unit"], [False, True, False], facts
        every = [*self.axes, *shown]
        places = product(*(axis.texts() for axis in self.axes))
        cells = zip(*(one.texts() for one in shown), strict=True)
        rows: list[tuple[str, ...]] = [(*at, *line) for at, line in zip(places, cells, strict=True)]
        return [one.heading for one in every], [one.right() for one in every], rows


def _cell(text: str, right: bool) -> str:
    kind = "number" if right else ""
    if isinstance(text, Verdict) and text.good is not None:
        kind = "good" if text.good else "bad"
    return f'<td class="{kind}">{escape(text)}</td>' if kind else f"<td>{escape(text)}</td>"


def table_of(head: Sequence[str], rows: Iterable[Iterable[Any]], *, form: str = ".5g", **given: Any) -> Table:
    """A table of rows, which is printed and nothing else."""
    every = zip(head, list(zip(*rows, strict=True)) or [()] * len(head), strict=True)
    first, *others = [Column(head=name, values=one, form=form) for name, one in every]
    return Table(axes=[first], columns=others, **given)


def facts(rows: Iterable[tuple[str, Any]], title: str = "") -> Table:
    """Names beside values."""
    return table_of(("", ""), rows, title=title)


class Named(Protocol):
    """What has a name."""

    @property
    def name(self) -> str: ...


Row = TypeVar("Row", bound=Named)


@dataclass(frozen=True, repr=False)
class Rows(Sequence[Row], Answer):
    """An answer of rows that have names."""

    rows: tuple[Row, ...]

    def __getitem__(self, key: Any) -> Any:
        """By number, or by name; KeyError names those that are there."""
        if not isinstance(key, str):
            return self.rows[key]
        for row in self.rows:
            if row.name == key:
                return row
        known = ", ".join(repr(row.name) for row in self.rows) or "none"
        raise KeyError(f"there is no {key!r}; {self!r} has {known}")

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self)} rows>"

    def names(self, of: str, **given: Any) -> Column:
        """The names of all rows, as an axis."""
        return replace(self.column("name", **given), name=of)

    def column(self, name: str, **given: Any) -> Column:
        """An attribute of all rows."""
        return Column(name=name, values=[getattr(row, name) for row in self.rows], **given)
