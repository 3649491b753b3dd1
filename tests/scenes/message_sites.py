"""Where the package stops a run or warns, read from its sources: for the test of the documentation."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
PYTHON, CPP = ROOT / "python" / "seacrane", ROOT / "cpp" / "seacrane"
BINDINGS = ROOT / "cpp" / "bindings"
# Checks of descriptions and names: SceneError.
REFUSED_BEFORE_A_RUN = ("model", "compile", "elements", "sea", "strip", "math", "joints", "loads", "hydro")
THROW = re.compile(
    r"throw (?:std::domain_error|IntegrationError|ChatteringError)\("
    r"|\bfail\(|last_error = |reason = |std::string text ="
)
SHORTEST = 18  # shorter are names of calls, such as "the step", before what SUNDIALS says itself
CLASS = re.compile(r"^ *class (\w+)\(([^)]*)\)", re.MULTILINE)
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')


def stops_of_cpp() -> dict[str, str]:
    """Words of every statement that ends a run, by file and line."""
    out: dict[str, str] = {}
    for path in sorted([*CPP.rglob("*.[ch]pp"), *BINDINGS.rglob("*.[ch]pp")]):
        before = path.name == "registry.cpp" or path.parent.name in REFUSED_BEFORE_A_RUN
        text = path.read_text()
        for match in THROW.finditer(text):
            if before and "domain_error" not in match.group():
                continue
            statement = text[match.start() : text.index(";\n", match.end() - 1)]
            words = "".join(LITERAL.findall(statement))
            if len(words) >= SHORTEST:
                out[f"{path.relative_to(ROOT)}:{text.count(chr(10), 0, match.start()) + 1}"] = words
    return out


def stops_of_python() -> dict[str, str]:
    """Words of every `SimulationError(...)`, by file and line."""
    out: dict[str, str] = {}
    for path in sorted(PYTHON.rglob("*.py")):
        text = path.read_text()
        if "SimulationError(" not in text:
            continue
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "SimulationError":
                parts = [n.value for n in ast.walk(node) if isinstance(n, ast.Constant)]
                words = "".join(part for part in parts if isinstance(part, str))
                out[f"{path.relative_to(ROOT)}:{node.lineno}"] = words
    return out


@cache
def stops() -> dict[str, str]:
    """Of both languages."""
    return {**stops_of_cpp(), **stops_of_python()}


@cache
def _bases() -> dict[str, set[str]]:
    """The bases of every class of the package that has some."""
    out: dict[str, set[str]] = {}
    for path in sorted(PYTHON.rglob("*.py")):
        for name, bases in CLASS.findall(path.read_text()):
            out.setdefault(name, set()).update(re.split(r"\W+", bases))
    return out


def classes_of(*bases: str) -> set[str]:
    """Names of the package's classes derived from any of these, or from another such class."""
    found: set[str] = set()
    while more := {name for name, own in _bases().items() if own & (found | {*bases})} - found:
        found |= more
    return found - {*bases}
