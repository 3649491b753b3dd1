"""The public face: few names at the top, closed modules by subject, a name refused with its place."""

from __future__ import annotations

import ast
import importlib
import subprocess
import sys
import warnings
from pathlib import Path
from types import ModuleType

import pytest

import seacrane

NAMES_NOW: list[str] = list(seacrane.__dict__["homes"])  # `__all__` leaves out what Python has too
MODULES = [name for name in NAMES_NOW if isinstance(getattr(seacrane, name), ModuleType)]
STUBS = [stub.parent.relative_to(Path(seacrane.__file__).parent) for stub in
         Path(seacrane.__file__).parent.rglob("__init__.pyi")]  # fmt: skip


def module_of(name: str) -> ModuleType:
    return importlib.import_module(f"seacrane.{name}")


def names_of(name: str) -> list[str]:
    return [one for one in dir(module_of(name)) if not one.startswith("_")]


def test_the_top_is_short_enough_to_be_read_and_a_name_is_of_one_subject() -> None:
    assert len(dir(seacrane)) <= 80
    home = {name: module for module in MODULES for name in names_of(module)}
    assert len(home) == sum(len(names_of(module)) for module in MODULES)
    for name in set(NAMES_NOW) - set(MODULES) - {"__version__"}:
        assert getattr(module_of(home[name]), name) is getattr(seacrane, name)
    space: dict[str, object] = {"warnings": warnings}
    exec("from seacrane import *", space)
    assert space["warnings"] is warnings and space["Scene"] is seacrane.Scene


@pytest.mark.parametrize("place", STUBS, ids=str)
def test_a_face_shows_its_stub_in_its_order(place: Path) -> None:
    stub = Path(seacrane.__file__).parent / place / "__init__.pyi"
    listed = [one for one in ast.parse(stub.read_text()).body if isinstance(one, ast.ImportFrom)]
    face = importlib.import_module(".".join(("seacrane", *place.parts)))
    names = [one.names[0].asname for one in listed]
    assert [name for name in names if name in face.__all__] == face.__all__
    assert set(names) - set(face.__all__) <= {"statistics", "warnings"}
    assert dir(face) == sorted(str(name) for name in names)


def test_no_module_within_takes_the_place_of_a_name() -> None:
    """`seacrane.pictures.view` is a function and a file, `seacrane.ensembles.ensemble` and others too."""
    code = (
        "import importlib, pkgutil, types, seacrane\n"
        "for one in pkgutil.walk_packages(seacrane.__path__, 'seacrane.'):\n"
        "    if 'lanes' not in one.name and '__main__' not in one.name: importlib.import_module(one.name)\n"
        f"for name in {MODULES}:\n"
        "    module = getattr(seacrane, name)\n"
        "    for one in dir(module):\n"
        "        assert one.startswith('_') or not isinstance(getattr(module, one), types.ModuleType), one\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_a_name_is_refused_with_its_place_or_the_nearest() -> None:
    elsewhere = [
        (name, module)
        for module in MODULES
        for name in names_of(module)
        if name not in NAMES_NOW and callable(getattr(module_of(module), name))
    ]
    assert len(elsewhere) > 100
    for name, module in elsewhere:
        told = rf"'seacrane' .*'{name}'; it is seacrane\.{module}\.{name}$"
        with pytest.raises(AttributeError, match=told):
            getattr(seacrane, name)
        with pytest.raises(ImportError, match=told):
            exec(f"from seacrane import {name}")
    for module, name, told in (
        (seacrane, "simulat", "'simulate'"), (seacrane.analysis, "simulate", r"seacrane\.simulate$"),
    ):  # fmt: skip
        with pytest.raises(AttributeError, match=told):
            getattr(module, name)
