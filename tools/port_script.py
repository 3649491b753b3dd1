"""Ports scripts of earlier versions: python tools/port_script.py [--write] FILE ...

Without ``--write`` it prints what would change. A call that is gone becomes the call that does its work, in
its place in the text; what the table's note says has to be looked at by hand.
"""

from __future__ import annotations

import argparse
import ast
import difflib
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class Call:
    """What takes the place of a method: its name, keywords with their values, and those that go."""

    name: str
    words: Mapping[str, str] = field(default_factory=dict)
    dropped: tuple[str, ...] = ()
    note: str = ""


AGAIN = "add_sea puts the vessel into the sea anew: repeat its position, heading_deg, phase and drift there"
CALLS = {
    "add_drift": Call("add_sea", {"drift": "True"}, ("outside",), AGAIN),
    "use_actual_position": Call("add_sea", {"phase": '"actual"'}, (), AGAIN),
    "use_slow_position": Call("add_sea", {"phase": '"slow"'}, (), AGAIN),
}


def ported(text: str) -> tuple[str, list[str]]:
    """The script with the calls of today, and notes with their lines."""
    lines = [0]
    for line in text.encode().splitlines(keepends=True):
        lines.append(lines[-1] + len(line))
    data, notes = text.encode(), []
    for node in sorted(_calls(ast.parse(text)), key=lambda one: (one.lineno, one.col_offset), reverse=True):
        assert isinstance(node.func, ast.Attribute) and node.end_lineno and node.end_col_offset is not None
        new = CALLS[node.func.attr]
        begin = lines[node.lineno - 1] + node.col_offset
        end = lines[node.end_lineno - 1] + node.end_col_offset
        data = data[:begin] + _written(node, new).encode() + data[end:]
        notes.append(f"line {node.lineno}: {node.func.attr} is {new.name}; {new.note}".rstrip("; "))
    return data.decode(), notes[::-1]


def _calls(tree: ast.AST) -> Iterator[ast.Call]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in CALLS:
            yield node


def _written(node: ast.Call, new: Call) -> str:
    assert isinstance(node.func, ast.Attribute)
    given = [ast.unparse(one) for one in node.args]
    given += [ast.unparse(one) for one in node.keywords if one.arg not in new.dropped]
    given += [f"{key}={value}" for key, value in new.words.items()]
    return f"{ast.unparse(node.func.value)}.{new.name}({', '.join(given)})"


def main() -> int:
    """Print what changes in each file, or write it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE")
    parser.add_argument("--write", action="store_true", help="replace the files")
    args = parser.parse_args()
    for path in args.files:
        text = path.read_text(encoding="utf-8")
        new, notes = ported(text)
        if args.write and new != text:
            path.write_text(new, encoding="utf-8")
        elif new != text:
            sys.stdout.writelines(
                difflib.unified_diff(
                    text.splitlines(keepends=True), new.splitlines(keepends=True), str(path), str(path)
                )
            )
        sys.stdout.writelines(f"{path}, {note}\n" for note in notes)
    return 0


if __name__ == "__main__":
    sys.exit(main())
