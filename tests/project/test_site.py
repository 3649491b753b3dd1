"""The site: its navigation holds every document and its pages every public name; a wrong link fails it."""

from __future__ import annotations

import importlib
import inspect
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import seacrane

ROOT = Path(__file__).resolve().parents[2]
LISTED = re.compile(r"^- \[[^]]+\]\(([^)]+)\)", re.MULTILINE)
INDEX = "# Site\n\nA first page.\n\n## To read\n\n- [Page](page.md): words\n- [Interface](api.md)\n"
PAGE = "# Navigation\n\nSee `docs/api.md`, [the package](../python) and [its list](../python/names.pyi).\n"


def test_the_first_page_lists_every_document() -> None:
    docs = ROOT / "docs"
    listed = {(docs / link).resolve() for link in LISTED.findall((docs / "index.md").read_text("utf-8"))}
    there = {*docs.glob("*.md"), *ROOT.glob("*.md"), *(ROOT / "benchmarks").glob("**/*.md")}
    for folder in ("examples", "studies", "tests"):
        there |= {*(ROOT / folder).glob("*/README.md")}
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


@pytest.mark.slow("builds a site")
def test_a_small_site_builds_and_fails_by_a_wrong_link(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With the site's own settings; without the pages of docstrings, which take longer than all others."""
    for package in ("furo", "myst_nb"):
        pytest.importorskip(package, reason="the site's packages are missing: pip install seacrane[docs]")
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "site"))
    offline, docs = importlib.import_module("offline"), tmp_path / "docs"
    shutil.copytree(ROOT / "docs" / "site", docs / "site", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "docs" / "conf.py", docs)
    (tmp_path / "python").mkdir()
    (tmp_path / "python" / "names.pyi").write_text("", encoding="utf-8")
    formulas = "\nA root $\\sqrt{m g}$ in a line.\n\n$$ H = \\frac{\\omega^2}{C_{44}} $$\n"
    api = "# Python interface\n\n`seacrane.Scene` and others.\n"
    for name, text in {"index": INDEX, "page": PAGE + formulas, "api": api}.items():
        (docs / f"{name}.md").write_text(text, encoding="utf-8")
    options = ["-W", "--keep-going", "-q", "-c", "docs", "-D", "include_patterns=docs/*.md", ".", "out"]
    command = [sys.executable, "-m", "sphinx", *options]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "out" / "docs" / "page.html").read_text(encoding="utf-8")
    navigation, _, article = page.partition("<article")
    assert 'href="api.html"' in article, "a document named in code letters is linked"
    assert "names.pyi" in page, "a file of code can be downloaded"
    assert "To read" in navigation, "the lists of the first page are the navigation"
    assert article.count("<math ") == 2 and "<msqrt>" in article and "$" not in article
    assert offline.outside(tmp_path / "out") == [], "the site opens without a network"
    for text, words in (("[Gone](gone.md)", "gone.md"), ("$\\nonsense{x}$", "nonsense")):
        (docs / "page.md").write_text(f"# Page\n\n{text}\n", encoding="utf-8")
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode != 0 and words in done.stderr
