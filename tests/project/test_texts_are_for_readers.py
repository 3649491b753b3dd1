"""What decides reads fields, never a text that is written for people."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

# Functions that read the text of an error, or hand it to one that does; fields are to take its place.
KNOWN = {
    "hydro/readers/orcaflex_model.py:_document",
}


def is_text(node: ast.AST, errors: set[str]) -> bool:
    """Whether it is `str(error)` or `repr(error)`."""
    if not (isinstance(node, ast.Call) and ast.unparse(node.func) in ("str", "repr")):
        return False
    return any(isinstance(one, ast.Name) and one.id in errors for one in ast.walk(node))


def is_read(text: ast.AST, parent: ast.AST) -> bool:
    """By a comparison, a method with arguments, or a function, except one that raises."""
    if isinstance(parent, ast.Call):
        name = ast.unparse(parent.func).rpartition(".")[2].lstrip("_")
        raises = name[:1].isupper() or name.startswith("fail")
        if text not in parent.args:  # its own method: `split()` without arguments leaves its words
            return bool(parent.args)
        return not raises and name not in ("str", "print", "len")
    return isinstance(parent, ast.Compare)


def readers(source: str) -> set[str]:
    """Names of functions that read the text of an error that they caught or were given."""
    found = set()
    for function in (one for one in ast.walk(ast.parse(source)) if isinstance(one, ast.FunctionDef)):
        nodes = list(ast.walk(function))
        errors = {one.name for one in nodes if isinstance(one, ast.ExceptHandler) and one.name}
        given = [one for one in nodes if isinstance(one, ast.arg) and one.annotation]
        errors |= {one.arg for one in given if re.search(r"(Error|Exception)\b", ast.unparse(one.annotation))}
        named = [one for one in nodes if isinstance(one, ast.Assign) and is_text(one.value, errors)]
        texts = {ast.unparse(target) for one in named for target in one.targets}
        for parent in nodes:
            parts = list(ast.iter_child_nodes(parent))
            if isinstance(parent, ast.Call) and isinstance(parent.func, ast.Attribute):
                parts.append(parent.func.value)
            for node in parts:
                text = is_text(node, errors) or (isinstance(node, ast.Name) and node.id in texts)
                if text and is_read(node, parent):
                    found.add(function.name)
    return found


def test_no_decision_reads_the_text_of_an_error(repository: Path) -> None:
    package = repository / "python" / "seacrane"
    found = {
        f"{path.relative_to(package).as_posix()}:{name}"
        for path in package.rglob("*.py")
        for name in readers(path.read_text(encoding="utf-8"))
    }
    assert found == KNOWN


@pytest.mark.parametrize(
    ("read", "told"),
    [
        ("'slack' in str(error)", True), ("str(error).partition('() ')[2]", True),
        ("re.search('a', str(error))", True),
        ("_about(str(error))", True), ("text.startswith('a')", True),
        ("' '.join(text.split())", False), ("self.document.fail(3, text)", False),
        ("SceneError(str(error))", False), ("f'{str(error)[:9]}'", False), ("error.code == 3", False),
    ],
)  # fmt: skip
def test_reading_is_seen(read: str, told: bool) -> None:
    handler = f"except ValueError as error:\n  text = str(error)\n  return {read}"
    assert readers(f"def one():\n try: two()\n {handler}") == ({"one"} if told else set())


def test_what_is_structured_is_not_text_in_the_stats(repository: Path) -> None:
    files = (repository / "python" / "seacrane").rglob("*.py")
    assert [path for path in files if "json.loads(str(" in path.read_text(encoding="utf-8")] == []
