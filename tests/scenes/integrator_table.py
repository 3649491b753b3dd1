"""Writes the table of integrators in docs/integrators.md, from the list of the core."""

from __future__ import annotations

from pathlib import Path

from seacrane import _core

PAGE = Path(__file__).parents[2] / "docs" / "integrators.md"
BEGIN, END = "<!-- made by tests/scenes/integrator_table.py -->\n", "<!-- end -->\n"


def _order(method: _core.Integrator) -> str:
    if method.lowest_order < method.order:
        return f"{method.lowest_order} to {method.order}"
    return f"{method.order}({method.error_order})" if method.error_order else f"{method.order}"


def _setting(method: _core.Integrator) -> str:
    return "`rtol`" if method.setting == "rtol" else f"`dt`, {method.default:g} s"


def integrator_table() -> str:
    """One row per method: what it is, and what it is there for."""
    head = ("name", "kind", "order", "inside a step", "set by", "joints kept by", "there for")
    rows = [
        (f"`{m.name}`", m.kind, _order(m), str(m.dense_order or "varies"), _setting(m), m.joints, m.purpose)
        for m in _core.integrators()
    ]
    lines = [head, ("---",) * len(head), *rows]
    return BEGIN + "".join(f"| {' | '.join(line)} |\n" for line in lines) + END


if __name__ == "__main__":
    text = PAGE.read_text(encoding="utf-8")
    before, after = text.split(BEGIN)[0], text.split(END)[1]
    PAGE.write_text(before + integrator_table() + after, encoding="utf-8")
