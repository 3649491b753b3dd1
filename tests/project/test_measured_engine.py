"""A table is fresh while its own sources are those that it was measured with, whatever else changes."""

from __future__ import annotations

import importlib
import json
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
GLOBS = ("cpp/one", "python/*.py")


@pytest.fixture
def sources(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    return importlib.import_module("measure.sources")


@pytest.fixture
def house(tmp_path: Path) -> Path:
    """A repository of two rooms of C++ and a module."""
    for room in ("one", "two"):
        (tmp_path / "cpp" / room).mkdir(parents=True)
        (tmp_path / "cpp" / room / "a.hpp").write_text("double two() { return 2.0; }  // m\n")
    (tmp_path / "python").mkdir()
    (tmp_path / "python" / "a.py").write_text('"""Two."""\n\nTWO = 2.0\n')
    return tmp_path


def digest(sources: Any, house: Path) -> str:
    sources._digest_of.cache_clear()
    return str(sources.digest(GLOBS, house))


def test_a_table_is_stale_by_its_own_sources_alone(
    sources: Any, house: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sources, "digest", lambda globs, root=house, real=sources.digest: real(globs, root))
    monkeypatch.setattr(sources, "engine", lambda: "0123456789ab")
    table = importlib.import_module("measure.table")
    path = house / "results" / "speed.csv"
    assert sources.stale(path, GLOBS) == "never measured"
    table.write(path, ("scene", "ms"), [("case2", "4")], globs=GLOBS, cpu_s=1.25)
    assert sources.stale(path, GLOBS) == ""
    assert "engine 0123456789ab, " in sources.words(path)
    (house / "cpp" / "two" / "a.hpp").write_text("double two() { return 3.0; }\n")
    assert sources.stale(path, GLOBS) == ""
    (house / "cpp" / "one" / "a.hpp").write_text("double two() { return 3.0; }\n")
    sources._digest_of.cache_clear()
    assert sources.stale(path, GLOBS) == "its sources have changed"
    told = json.loads((path.parent / sources.LIST).read_text())
    assert told["speed.csv"]["cpu_s"] == 1.2
    table.write(path, ("scene", "ms"), [("case2", "4")])
    assert sources.stale(path, GLOBS) == "its sources were not recorded"


@pytest.mark.parametrize(
    ("file", "text", "same"),
    [
        ("cpp/one/a.hpp", "/// Two.\ndouble two() {\n  return 2.0; /* m */\n}\n", True),
        ("cpp/one/a.hpp", "double two() { return 3.0; }", False),
        ("python/a.py", '"""Another."""\n# a comment\nTWO   = 2.0\n', True),
        ("python/a.py", '"""Two."""\n\nTWO = 3.0\n', False),
    ],
)
def test_code_counts_and_comments_and_layout_do_not(
    sources: Any, house: Path, file: str, text: str, same: bool
) -> None:
    before = digest(sources, house)
    (house / file).write_text(text)
    assert (digest(sources, house) == before) is same


def test_texts_of_code_keep_their_blanks_and_a_glob_of_nothing_is_refused(sources: Any, house: Path) -> None:
    assert sources.code_of('say("a // b  c");  // d') == 'say("a // b  c");'
    assert sources.code_of("char c = '\"'; // \"\n int i;") == "charc='\"';inti;"
    with pytest.raises(ValueError, match="cpp/three"):
        sources.digest(("cpp/three",), house)


def test_there_are_at_most_forty_and_each_is_a_file_that_the_page_shows(sources: Any) -> None:
    run = importlib.import_module("run")
    files = {section.path for section in run.SECTIONS}
    assert len(files) == len(run.SECTIONS) <= run.MOST == 40
    assert files == set((ROOT / "benchmarks" / "results").glob("*.csv"))
    page = run.README.read_text(encoding="utf-8")
    for section in run.SECTIONS:
        assert f"<!-- table benchmarks/results/{section.path.name} -->\n| " in page
        assert sources.digest(section.globs), "each source exists"
    assert page == run.readme(), "python benchmarks/run.py writes it"
