"""The site: its navigation holds every document and its pages every public name."""

from __future__ import annotations

import importlib
import inspect
import re
from pathlib import Path

import pytest

import seacrane

ROOT = Path(__file__).resolve().parents[2]
LISTED = re.compile(r"^- \[[^]]+\]\(([^)]+)\)", re.MULTILINE)


def test_the_first_page_lists_every_document() -> None:
    docs = ROOT / "docs"
    listed = {(docs / link).resolve() for link in LISTED.findall((docs / "index.md").read_text("utf-8"))}
    places = ("*", "docs/*", "benchmarks/**/*", "python/**/*", "*/*/README")
    there = {path for place in places for path in ROOT.glob(f"{place}.md")}
    assert listed == there - {docs / "index.md"}


def test_every_public_name_is_on_one_page_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """A name of two homes stands under the shorter one."""
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "site"))
    face = importlib.import_module("public_face")
    pages = face.pages()
    names = [name.rpartition(".")[2] for page in pages.values() for name in page]
    assert len(names) == len(set(names))
    for module in (seacrane, *(getattr(seacrane, page) for page in pages)):
        shown = {one: getattr(module, one) for one in dir(module) if not one.startswith("_")}
        public = {one for one, what in shown.items() if inspect.isroutine(what) or inspect.isclass(what)}
        assert public <= set(names), module.__name__
    tree = (ROOT / "docs" / "api.md").read_text("utf-8")
    assert re.findall(r"^api/(\w+)$", tree, re.MULTILINE) == list(pages)
    assert "seacrane.HydroDatabase" in pages["hydro"] and "seacrane.hydro.HydroDatabase" not in pages["hydro"]
    assert face.homes()["seacrane.scene.scene.Scene"] == "seacrane.Scene"
