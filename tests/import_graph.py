"""The imports of a package, read from its sources: what each module names, where, and in which rooms.

A room is a package's folder, or a module that lies in no room. Stubs of public faces count as sources.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path


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
    """All imports of one module of a package by another; those of its compiled core left out."""
    files = modules(package)
    return [
        Import(source, target, hidden)
        for source, path in files.items()
        for target, hidden in _imported(ast.parse(path.read_text(encoding="utf-8")), package.name, files)
        if target != source
    ]


def _imported(
    node: ast.AST, package: str, files: Mapping[str, Path], hidden: bool = False
) -> Iterator[tuple[str, bool]]:
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.ImportFrom):
            assert child.level == 0, f"relative import of {child.module}"
            whole = [f"{child.module}.{entry.name}" for entry in child.names]
            yield from ((name, hidden) for name in _inside(whole, package, files))
        elif isinstance(child, ast.Import):
            whole = [entry.name for entry in child.names]
            yield from ((name, hidden) for name in _inside(whole, package, files))
        function = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef)
        yield from _imported(child, package, files, hidden or function)


def _inside(names: list[str], package: str, files: Mapping[str, Path]) -> Iterator[str]:
    """Of the package's own, the modules that dotted names mean: a module, or the one that holds the name."""
    for name in names:
        top, _, inner = name.partition(".")
        if top == package and inner.split(".")[0] != "_core":
            yield inner if inner in files else inner.rpartition(".")[0]


def circles(arrows: Mapping[str, set[str]]) -> list[list[str]]:
    """Sets of nodes that reach each other (Tarjan 1972), each sorted."""
    number: dict[str, int] = {}
    lowest: dict[str, int] = {}
    path: list[str] = []
    found: list[list[str]] = []

    def visit(node: str) -> None:
        number[node] = lowest[node] = len(number)
        path.append(node)
        for other in arrows.get(node, ()):
            if other not in number:
                visit(other)
            if other in path:
                lowest[node] = min(lowest[node], lowest[other])
        if lowest[node] == number[node]:
            at = path.index(node)
            if len(path) - at > 1:
                found.append(sorted(path[at:]))
            del path[at:]

    for node in list(arrows):
        if node not in number:
            visit(node)
    return found
