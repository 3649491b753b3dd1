"""Documents agree with the files that they show, and name and link what exists."""

from __future__ import annotations

import re
import runpy
import subprocess
import sys
from functools import lru_cache
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
PLACES = ("*.md", "docs/*.md", "benchmarks/**/*.md", "notebooks/*.md")
PLACES += ("examples/*/*.md", "studies/*/*.md", "tests/*/*.md", "python/**/*.md")  # beside what they describe
DOCUMENTS = [path for place in PLACES for path in sorted(ROOT.glob(place))]
NAMES = [str(path.relative_to(ROOT)) for path in DOCUMENTS]
FENCED = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\[[^]]*\]\((?!https?:)([^)#\s]*)(?:#([^)\s]+))?\)")
FOLDERS = "benchmarks|cpp|docs|examples|notebooks|python|studies|tests|tools"
QUOTED = re.compile(rf"`((?:{FOLDERS})/[\w./-]*\w/?)`")


def test_no_table_is_older_than_its_file() -> None:
    command = [sys.executable, "benchmarks/documents.py", "--check"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, f"{done.stderr}python benchmarks/documents.py fills them"


def test_tables_of_what_is_registered_are_current() -> None:
    made = runpy.run_path(str(ROOT / "tools" / "document_tables.py"))
    for name in made["TABLES"]:
        text = (ROOT / "docs" / name).read_text(encoding="utf-8")
        assert text == made["current"](name), "run python tools/document_tables.py"


FILE = "benchmarks/results/wave-loads.csv"


def test_a_table_that_differs_from_its_file_is_found(modules: Any) -> None:
    documents = modules("documents")
    mark = f"<!-- table {FILE}; columns: components; rows: components = 10 | 300 -->"
    told = f"<p><sub>{documents.words(ROOT / FILE)}</sub></p><!-- end of table -->"
    stale = f"{mark}\n| components |\n| ---: |\n| 10 |\n{told}"
    assert documents.filled(stale) == stale.replace("| 10 |\n", "| 10 |\n| 300 |\n")


@pytest.mark.parametrize("name", NAMES)
def test_links_pictures_and_files_that_a_document_names_are_there(name: str) -> None:
    path = ROOT / name
    text = path.read_text(encoding="utf-8")
    for file, anchor in LINK.findall(FENCED.sub("", text)):
        target = path.parent / file if file else path
        assert target.exists(), f"{name} links to {file}"
        assert not anchor or anchor in anchors(target), f"{name} links to {file}#{anchor}"
    if name != "CHANGELOG.md":
        assert [file for file in QUOTED.findall(text) if not (ROOT / file).exists()] == []


@lru_cache
def anchors(path: Path) -> set[str]:
    """Of the headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.+)$", FENCED.sub("", path.read_text(encoding="utf-8")), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}
