"""Writes the tables of channels, readers and integrators into their documents, from what is registered."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from seacrane import _core
from seacrane.description.channels import CHANNELS, FIXED, Channel
from seacrane.hydro.readers.format import told_of
from seacrane.hydro.readers.load import FORMATS

DOCS = Path(__file__).parents[1] / "docs"
BEGIN, END = "<!-- begin: tools/document_tables.py -->\n", "<!-- end -->\n"


def _table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    return "".join(f"| {' | '.join(line)} |\n" for line in (head, ("---",) * len(head), *rows))


def _channel(name: str, channel: Channel) -> tuple[str, ...]:
    optional = set(channel.dims_of_several) - set(channel.dims)
    dims = ", ".join(f"({dim})" if dim in optional else dim for dim in channel.dims_of_several)
    made_of = f"; from {' or '.join(f'`{part}`' for part in channel.made_of)}" if channel.made_of else ""
    text = channel.long_name + made_of + ("" if channel.by_default else "; on request")
    return f"`{name}`", dims, channel.unit, text


def _channels() -> str:
    fixed = "".join(f"- `{dim}`: {', '.join(names)}\n" for dim, names in FIXED.items())
    rows = (_channel(name, channel) for name, channel in CHANNELS.items())
    return _table(("channel", "dimensions", "unit", "what it is"), rows) + f"\n{fixed}"


def _readers() -> str:
    rows = (
        (name, files, looks, ", ".join(f"`{one}`" for one in given.split(", ") if one))
        for name, files, looks, given in told_of(FORMATS)
    )
    return _table(("kind", "files", "known by", "may be given"), rows)


def _order(method: _core.Integrator) -> str:
    if method.lowest_order < method.order:
        return f"{method.lowest_order} to {method.order}"
    return f"{method.order}({method.error_order})" if method.error_order else f"{method.order}"


def _integrators() -> str:
    rows = (
        (f"`{m.name}`", m.kind, _order(m), str(m.dense_order or "varies"),
         "`rtol`" if m.setting == "rtol" else f"`dt`, {m.default:g} s", m.joints, m.purpose)
        for m in _core.integrators()
    )  # fmt: skip
    head = ("name", "kind", "order", "inside a step", "set by", "joints kept by", "there for")
    return _table(head, rows)


TABLES: dict[str, Callable[[], str]] = {
    "channels.md": _channels, "hydrodynamics.md": _readers, "integrators.md": _integrators,
}  # fmt: skip


def current(name: str) -> str:
    """A document with its table made anew."""
    before, _, rest = (DOCS / name).read_text(encoding="utf-8").partition(BEGIN)
    return before + BEGIN + TABLES[name]() + END + rest.partition(END)[2]


if __name__ == "__main__":
    for document in TABLES:
        (DOCS / document).write_text(current(document), encoding="utf-8")
