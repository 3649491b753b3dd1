"""Reading a scene, state, database or result runs no code: nothing in the package could."""

from __future__ import annotations

import ast
from pathlib import Path

CALLS = {"eval", "exec", "compile", "__import__", "execfile"}
MODULES = {"pickle", "cPickle", "_pickle", "dill", "cloudpickle", "joblib", "shelve", "marshal", "runpy",
           "code"}  # fmt: skip
# A .py script named on the command line is run, as the command says; YAML is read by a safe loader; an
# ensemble hands its study to workers as bytes, which are in no file.
ALLOWED = {"ensembles/job.py": {"pickle"}, "cli/scene_source.py": {"run_path", "runpy"},
           "hydro/readers/orcaflex_model.py": {"yaml.load"}}  # fmt: skip
YAML = {"load", "load_all", "full_load", "unsafe_load", "Loader", "FullLoader", "UnsafeLoader"}
METHODS = {"exec_module", "run_path", "run_module", "read_pickle", "unsafe_load"}


def offences(text: str) -> set[str]:
    """Names in a module by which data could become code."""
    found = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names if alias.name.split(".")[0] in MODULES}
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] in MODULES:
            found.add(str(node.module))
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) and node.id in CALLS:
            found.add(node.id)
        elif isinstance(node, ast.Attribute):
            owner = node.value.id if isinstance(node.value, ast.Name) else ""
            found |= {node.attr} & METHODS
            if owner == "yaml" and node.attr in YAML:
                found.add(f"yaml.{node.attr}")
        elif isinstance(node, ast.keyword) and node.arg == "allow_pickle":
            found.add(node.arg)
    return found


def test_nothing_in_the_package_turns_data_into_code(repository: Path) -> None:
    package = repository / "python" / "seacrane"
    files = sorted(package.rglob("*.py"))
    assert len(files) > 100
    for path in files:
        assert offences(path.read_text()) <= ALLOWED.get(path.relative_to(package).as_posix(), set()), path
    loader = (package / "hydro" / "readers" / "orcaflex_model.py").read_text()
    assert 'loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)' in loader
    assert loader.count("yaml.load(") == loader.count("yaml.load(text, Loader=loader)") == 1


def test_the_search_finds() -> None:
    for text in (
        "import pickle", "from pickle import loads", "eval(x)", "exec(x)", "importlib.util.x.exec_module(m)",
        "yaml.load(x)", "yaml.load(x, Loader=yaml.FullLoader)", "np.load(p, allow_pickle=True)", "f = eval",
    ):  # fmt: skip
        assert offences(text), text
