"""Reading a scene, state, database or result runs no code: nothing in the package could."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

CALLS = {"eval", "exec", "compile", "__import__", "execfile"}
MODULES = {
    "pickle",
    "cPickle",
    "_pickle",
    "dill",
    "cloudpickle",
    "joblib",
    "shelve",
    "marshal",
    "runpy",
    "code",
}
# A .py script named on the command line is run, as the command says; YAML is read by a safe loader; an
# ensemble hands its study to workers as bytes, which are in no file.
ALLOWED = {
    "ensembles/job.py": {"pickle"},
    "cli/scene_source.py": {"run_path", "runpy"},
    "hydro/readers/orcaflex_model.py": {"yaml.load"},
}
YAML = {"load", "load_all", "full_load", "unsafe_load", "Loader", "FullLoader", "UnsafeLoader"}


def offences(path: Path) -> list[str]:
    """Names in a file by which data could become code."""
    found = []
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names if alias.name.split(".")[0] in MODULES]
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] in MODULES:
            found.append(str(node.module))
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) and node.id in CALLS:
            found.append(node.id)
        elif isinstance(node, ast.Attribute):
            owner = node.value.id if isinstance(node.value, ast.Name) else ""
            if node.attr in {"exec_module", "run_path", "run_module", "read_pickle", "unsafe_load"}:
                found.append(node.attr)
            elif owner == "yaml" and node.attr in YAML:
                found.append(f"yaml.{node.attr}")
        elif isinstance(node, ast.keyword) and node.arg == "allow_pickle":
            found.append(node.arg)
    return found


def test_nothing_in_the_package_turns_data_into_code(repository: Path) -> None:
    package = repository / "python" / "seacrane"
    files = sorted(package.rglob("*.py"))
    assert len(files) > 100
    for path in files:
        allowed = ALLOWED.get(path.relative_to(package).as_posix(), set())
        assert set(offences(path)) <= allowed, path
    loader = (package / "hydro" / "readers" / "orcaflex_model.py").read_text()
    assert 'loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)' in loader
    assert loader.count("yaml.load(") == loader.count("yaml.load(text, Loader=loader)") == 1


@pytest.mark.parametrize(
    "text",
    [
        "import pickle", "from pickle import loads", "eval(x)", "exec(x)", "importlib.util.x.exec_module(m)",
        "yaml.load(x)", "yaml.load(x, Loader=yaml.FullLoader)", "np.load(p, allow_pickle=True)", "f = eval",
    ],
)  # fmt: skip
def test_the_search_finds(text: str, tmp_path: Path) -> None:
    (tmp_path / "file.py").write_text(text)
    assert offences(tmp_path / "file.py")
