"""Ports scripts of earlier versions: python tools/port_script.py [--write] FILE ...

Without ``--write`` it prints what would change. A call that is gone becomes the call that does its work, in
its place in the text; what the table's note says has to be looked at by hand.
"""

from __future__ import annotations

import argparse
import ast
import difflib
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class Call:
    """What takes the place of a method or a function.

    Its name; what its arguments by place are called now ("" for one that stays by place); keywords with their
    values, and those that go.
    """

    name: str
    places: tuple[str, ...] = ()
    words: Mapping[str, str] = field(default_factory=dict)
    dropped: tuple[str, ...] = ()
    renamed: Mapping[str, str] = field(default_factory=dict)
    note: str = ""


AGAIN = "add_sea puts the vessel into the sea anew: repeat its position, heading_deg, phase and drift there"
FUNCTION = "force is the C function itself, not its address"
LOADED = "it returns what is on disk: .load() is the Result"
BY_BODY = {"mass_matrices": "mass_matrix"}
CALLS = {
    "add_drift": Call("add_sea", words={"drift": "True"}, dropped=("outside",), note=AGAIN),
    "use_actual_position": Call("add_sea", words={"phase": '"actual"'}, note=AGAIN),
    "use_slow_position": Call("add_sea", words={"phase": '"slow"'}, note=AGAIN),
    "add_point_force": Call("add_force", places=("name",)),
    "add_force_table": Call("add_force", places=("name",), renamed={"loads": "force"}),
    "add_function_force": Call("add_force", places=("name",), renamed={"address": "force"}, note=FUNCTION),
    "add_end_stop": Call("add_stop"),
    "add_soft_stop": Call("add_stop"),
    "add_seat": Call("add_stop"),
    "record_coordinate": Call("add_channel", places=("joint",)),
    "add_given_vessel": Call("add_vessel", places=("motion",)),
    "add_vessels": Call("add_vessel", renamed={"group": "what"}),
    "add_seabed": Call("add_contact", words={"on": '"seabed"'}),
    "simulate_stages": Call("simulate", renamed={"stages": "t_end"}),
    "simulate_to_file": Call("simulate", places=("", "to", ""), renamed={"path": "to"}),
    "simulate_stages_to_file": Call(
        "simulate", places=("", "", "to"), renamed={"stages": "t_end", "path": "to"}, note=LOADED
    ),
    "read_bemio_group": Call("read_bemio", renamed=BY_BODY),
    "read_capytaine_group": Call(
        "read_capytaine",
        renamed=BY_BODY | {"restorings": "restoring", "rotation_centres": "rotation_centre"},
    ),
    "read_nemoh_group": Call("read_nemoh", renamed=BY_BODY | {"restorings": "restoring"}),
    "read_wamit_group": Call("read_wamit", renamed=BY_BODY),
}
PASSIVE = re.compile(r"""\b(memory|kind)=(["'])passive\2""")  # a kind of fluid memory that is gone

GONE = {
    "KnuckleBoomCrane": "KnuckleBoomCrane.load() is load_crane(), crane.geometry.tip(...) is crane.tip(...); "
    "bodies and joints are those of crane.parts(...)",
    "JointedCrane": "JointedCrane is Crane, as of load_crane; crane.tip(coordinates=x) is crane.tip(**x)",
}


def ported(text: str) -> tuple[str, list[str]]:
    """The script with the calls of today, and notes with their lines."""
    notes = [
        f"line {text.count(chr(10), 0, found.start()) + 1}: memory by motion takes a limit, and no r2"
        for found in PASSIVE.finditer(text)
    ]
    text = PASSIVE.sub(r"\1=\2by-motion\2", text)
    starts = [0]
    for line in text.encode().splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    data = text.encode()
    for node, new_text, note in sorted(_changes(ast.parse(text)), key=_place, reverse=True):
        assert node.end_lineno and node.end_col_offset is not None
        begin = starts[node.lineno - 1] + node.col_offset
        end = starts[node.end_lineno - 1] + node.end_col_offset
        if b"#" in data[begin:end]:
            note = f"{note}; comments inside it are lost" if note else "comments inside it are lost"
        data = data[:begin] + new_text.encode() + data[end:]
        notes += [f"line {node.lineno}: {note}"] if note else []
    return data.decode(), notes[::-1]


Change = tuple[ast.expr | ast.stmt, str, str]


def _place(change: Change) -> tuple[int, int]:
    return change[0].lineno, change[0].col_offset


def _changes(tree: ast.AST) -> Iterator[Change]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and (old := _called(node.func)) in CALLS:
            new = CALLS[old]
            yield node, _written(node, new), f"{old} is {new.name}; {new.note}".rstrip("; ")
        elif isinstance(node, ast.ImportFrom) and any(one.name in CALLS for one in node.names):
            names = [CALLS[one.name].name if one.name in CALLS else ast.unparse(one) for one in node.names]
            yield node, f"from {node.module} import {', '.join(dict.fromkeys(names))}", ""
        elif isinstance(node, ast.ImportFrom) and (
            gone := [one.name for one in node.names if one.name in GONE]
        ):
            yield node, ast.unparse(node), "; ".join(GONE[name] for name in gone)


def _called(function: ast.expr) -> str:
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def _written(node: ast.Call, new: Call) -> str:
    places = [*new.places, *[""] * len(node.args)]
    by_place = [ast.unparse(one) for one, word in zip(node.args, places, strict=False) if not word]
    words = [f"{word}={ast.unparse(one)}" for one, word in zip(node.args, places, strict=False) if word]
    for one in node.keywords:
        if one.arg not in new.dropped:
            key = new.renamed.get(one.arg or "", one.arg)
            words.append(f"{key}={ast.unparse(one.value)}" if key else ast.unparse(one))
    words += [f"{key}={value}" for key, value in new.words.items()]
    owner = f"{ast.unparse(node.func.value)}." if isinstance(node.func, ast.Attribute) else ""
    return f"{owner}{new.name}({', '.join([*by_place, *words])})"


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
