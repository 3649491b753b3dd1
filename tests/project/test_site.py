"""The site: its navigation holds every document and its pages every public name; a wrong link fails it."""

from __future__ import annotations

import importlib
import inspect
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import chromium
import pytest

import seacrane

ROOT = Path(__file__).resolve().parents[2]
LISTED = re.compile(r"^- \[[^]]+\]\(([^)]+)\)", re.MULTILINE)
INDEX = "# Site\n\nA first page.\n\n## To read\n\n- [Page](page.md): words\n- [Interface](api.md)\n"
NOTEBOOK = """---
file_format: mystnb
kernelspec:
  name: python3
---

# Notebook

```{{code-cell}} ipython3
with open({path!r}, "a") as log:
    log.write("run;")
print(6 * 7, "is printed")
```
"""
PAGE = "# Navigation\n\nSee `docs/api.md`, [the package](../python) and [its list](../python/names.pyi).\n"


@pytest.fixture
def face(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "site"))
    return importlib.import_module("public_face")


def test_the_first_page_lists_every_document() -> None:
    docs = ROOT / "docs"
    listed = {(docs / link).resolve() for link in LISTED.findall((docs / "index.md").read_text("utf-8"))}
    there = {*docs.glob("*.md"), *ROOT.glob("*.md"), *(ROOT / "benchmarks").glob("**/*.md")}
    there |= {
        path for folder in ("examples", "studies", "tests") for path in (ROOT / folder).glob("*/README.md")
    }
    assert listed == there - {docs / "index.md"}


def test_every_public_name_is_on_one_page_once(face: Any) -> None:
    """Pages follow the order of the work; a name of two homes stands under the shorter one."""
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


@pytest.fixture
def small_site(tmp_path: Path) -> Path:
    """The site's own settings with two short documents."""
    pytest.importorskip("furo", reason="the site's packages are missing: pip install seacrane[docs]")
    pytest.importorskip("myst_nb", reason="the site's packages are missing: pip install seacrane[docs]")
    docs = tmp_path / "docs"
    shutil.copytree(ROOT / "docs" / "site", docs / "site", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "docs" / "conf.py", docs)
    (tmp_path / "python").mkdir()
    (tmp_path / "python" / "names.pyi").write_text("", encoding="utf-8")
    texts = {"index": INDEX, "page": PAGE, "api": "# Python interface\n\n`seacrane.Scene` and others.\n"}
    for name, text in texts.items():
        (docs / f"{name}.md").write_text(text, encoding="utf-8")
    return tmp_path


@pytest.fixture
def offline(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "site"))
    return importlib.import_module("offline")


def build(site: Path, *more: str) -> subprocess.CompletedProcess[str]:
    """Without the pages of docstrings, which take longer than all others; `make docs` builds them."""
    options = ["-W", "--keep-going", "-q", "-c", "docs", "-D", "include_patterns=docs/*.md", *more]
    command = [sys.executable, "-m", "sphinx", *options, ".", "out"]
    return subprocess.run(command, cwd=site, capture_output=True, text=True, check=False)


@pytest.mark.slow("builds a site")
def test_a_small_site_builds_and_fails_by_a_wrong_link(small_site: Path, offline: Any) -> None:
    formulas = "\nA root $\\sqrt{m g}$ in a line.\n\n$$ H = \\frac{\\omega^2}{C_{44}} $$\n"
    (small_site / "docs" / "page.md").write_text(PAGE + formulas, encoding="utf-8")
    done = build(small_site)
    assert done.returncode == 0, done.stderr
    page = (small_site / "out" / "docs" / "page.html").read_text(encoding="utf-8")
    navigation, _, article = page.partition("<article")
    assert 'href="api.html"' in article, "a document named in code letters is linked"
    assert "names.pyi" in page, "a file of code can be downloaded"
    assert 'href="../python"' not in page
    assert "To read" in navigation, "the lists of the first page are the navigation"
    assert (
        article.count("<math ") == 2 and "<msqrt>" in article and "<mfrac>" in article and "$" not in article
    )
    assert "url=docs/index.html" in (small_site / "out" / "index.html").read_text(encoding="utf-8")
    assert (small_site / "docs" / "api" / "scene.rst").is_file()
    assert offline.outside(small_site / "out") == [], "the site opens without a network"
    for text, words in (("[Gone](gone.md)", "gone.md"), ("$\\nonsense{x}$", "nonsense")):
        (small_site / "docs" / "page.md").write_text(f"# Page\n\n{text}\n", encoding="utf-8")
        failed = build(small_site)
        assert failed.returncode != 0 and words in failed.stderr


def test_signatures_say_what_the_code_says(small_site: Path) -> None:
    (small_site / "docs" / "index.md").write_text(INDEX + "- [Entry](entry.md)\n", encoding="utf-8")
    entries = {
        "seacrane.hydro.HydroDatabase.force_at": "method", "seacrane.hydro.HydroDatabase.select": "method",
        "seacrane.analysis.Balance": "class", "seacrane.analysis.Balance.vessel_wrench": "property",
    }  # fmt: skip
    lines = [f"```{{eval-rst}}\n.. auto{kind}:: {name}\n```" for name, kind in entries.items()]
    (small_site / "docs" / "entry.md").write_text("# Entry\n\n" + "\n\n".join(lines), encoding="utf-8")
    done = build(small_site)
    assert done.returncode == 0, done.stderr
    page = (small_site / "out" / "docs" / "entry.html").read_text(encoding="utf-8").split("<article")[1]
    words = re.sub(r"<[^>]+>", "", page)
    assert "ArrayLike" in words and "NDArray[complex128]" in words and "NDArray[integer]" in words
    assert "Mapping[str, NDArray[float64]]" in words and "NDArray[float64] | None" in words
    assert not re.search("SupportsArray|NestedSequence|TypeAlias|dtype", words)


@pytest.mark.slow("makes a site")
def test_a_site_holds_pages_and_runs_a_notebook_once(small_site: Path, offline: Any) -> None:
    pytest.importorskip("ipykernel", reason="the site's packages are missing: pip install seacrane[docs]")
    log = small_site / "log"
    shutil.copy(ROOT / "docs" / "live.md", small_site / "docs")
    (small_site / "docs" / "view.md").write_text("# View\n", encoding="utf-8")
    (small_site / "docs" / "notebook.md").write_text(NOTEBOOK.format(path=str(log)), encoding="utf-8")
    links = "- [Live](live.md)\n- [View](view.md)\n- [Notebook](notebook.md)\n"
    (small_site / "docs" / "index.md").write_text(INDEX + links, encoding="utf-8")
    for _ in range(2):
        done = build(small_site, "--fresh-env")
        assert done.returncode == 0, done.stderr
    assert log.read_text() == "run;", "the second build takes the outputs of the first"
    site = small_site / "out" / "docs"
    assert "42 is printed" in (site / "notebook.html").read_text(encoding="utf-8")
    assert 'src="case2.html' in (site / "live.html").read_text(encoding="utf-8")
    assert 'id="data"' in (site / "case2.html").read_text(encoding="utf-8")
    assert offline.outside(small_site / "out") == []


@pytest.mark.slow("makes a site")
def test_the_search_finds_without_a_network(small_site: Path) -> None:
    command = chromium.found()
    if command is None:
        pytest.skip("no Chromium: install Debian's package chromium")
    assert build(small_site).returncode == 0
    address = (small_site / "out" / "search.html").as_uri()
    with chromium.tab(command) as tab:
        tab.ask("Page.navigate", url=f"{address}?q=navigation")
        tab.wait_for("document.querySelector('#search-results li a') !== null")
        assert "page.html" in tab.value("document.querySelector('#search-results li a').href")
        assert all(one.startswith(("file:", "data:")) for one in tab.requests), tab.requests
