"""Imports of the Python package and includes of the C++ sources, read from the files: who names whom."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np
from scipy.sparse.csgraph import connected_components


@dataclass(frozen=True)
class Import:
    """Module ``source`` imports from ``target``, names without the package's; ``hidden``: in a function."""

    source: str
    target: str
    hidden: bool


def modules(package: Path) -> dict[str, Path]:
    """File of each module below a package's folder; of a package with a stub, the stub."""
    found: dict[str, Path] = {}
    for path in sorted([*package.rglob("*.py"), *package.rglob("__init__.pyi")]):
        parts = path.relative_to(package).with_suffix("").parts
        found[".".join(part for part in parts if part != "__init__")] = path
    return found


def room(module: str, files: Mapping[str, Path]) -> str:
    """The room that a module lies in; a package's own ``__init__`` lies in the package."""
    is_package = files[module].stem == "__init__"
    return module if is_package or "." not in module else module.rpartition(".")[0]


def imports(package: Path) -> list[Import]:
    """All imports of one module of a package by another; those of its compiled core left out.

    A public module is a list of names from anywhere and imports nothing by itself: what comes through it is
    imported from the module that has it.
    """
    files, through = modules(package), _public(package)
    return [
        Import(source, target, hidden)
        for source, path in files.items()
        if path.suffix == ".py"
        for target, hidden in _imported(
            ast.parse(path.read_text(encoding="utf-8")), package.name, files, through
        )
        if target != source
    ]


def _public(package: Path) -> dict[str, str]:
    """The home of each name of each public module, by both names within the package."""
    found = {}
    for stub in package.rglob("__init__.pyi"):
        face = "".join(f"{part}." for part in stub.parent.relative_to(package).parts)
        for line in stub.read_text(encoding="utf-8").splitlines():
            if line.startswith(f"from {package.name}."):
                _, home, _, _, _, name = line.split()
                found[f"{face}{name}"] = f"{home.partition('.')[2]}.{name}"
    return found


def _imported(
    node: ast.AST, package: str, files: Mapping[str, Path], through: Mapping[str, str], hidden: bool = False
) -> Iterator[tuple[str, bool]]:
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.ImportFrom | ast.Import):
            home = ""
            if isinstance(child, ast.ImportFrom):
                assert child.level == 0, f"relative import of {child.module}"
                home = f"{child.module}."
            whole = [f"{home}{entry.name}" for entry in child.names]
            yield from ((name, hidden) for name in _inside(whole, package, files, through))
        function = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef)
        yield from _imported(child, package, files, through, hidden or function)


def _inside(
    names: list[str], package: str, files: Mapping[str, Path], through: Mapping[str, str]
) -> Iterator[str]:
    """Of the package's own, the modules that dotted names mean: a module, or the one that holds the name."""
    for name in names:
        top, _, inner = name.partition(".")
        inner = through.get(inner, inner)
        if top == package and inner.split(".")[0] != "_core":
            yield inner if inner in files else inner.rpartition(".")[0]


def circles(arrows: Mapping[str, set[str]]) -> list[list[str]]:
    """Sets of nodes that reach each other, each sorted."""
    nodes = sorted({*arrows, *chain(*arrows.values())})
    graph = np.array([[other in arrows.get(node, ()) for other in nodes] for node in nodes])
    count, part = connected_components(graph, connection="strong")
    parts = [[node for node, one in zip(nodes, part, strict=True) if one == i] for i in range(count)]
    return [one for one in parts if len(one) > 1]


def arrows_between_rooms(folder: Path) -> dict[str, set[str]]:
    """Folders of C++ sources, and those that each includes from."""
    found: dict[str, set[str]] = {}
    for path in folder.rglob("*.[ch]pp"):
        own = found.setdefault(path.parent.relative_to(folder).as_posix(), set())
        for name in re.findall(rf'#include "{folder.name}/([^"]+)"', path.read_text(encoding="utf-8")):
            own.add(Path(name).parent.as_posix())
    return {own: others - {own} for own, others in found.items()}
