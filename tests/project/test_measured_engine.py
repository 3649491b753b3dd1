"""A table is fresh while its own sources are those that it was measured with, whatever else changes."""

from __future__ import annotations

import importlib
import json
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
GLOBS = ("cpp/one",)


@pytest.fixture
def sources(modules: Any) -> Any:
    return modules("measure.sources")


def test_a_table_is_stale_by_its_own_sources_alone(
    sources: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = [tmp_path / "cpp" / room / "a.hpp" for room in ("one", "two")]
    for file in files:
        file.parent.mkdir(parents=True)
        file.write_text("double two() { return 2.0; }  // m\n")
    monkeypatch.setattr(
        sources, "digest", lambda globs, root=tmp_path, real=sources.digest: real(globs, root)
    )
    monkeypatch.setattr(sources, "engine", lambda: "0123456789ab")
    table = importlib.import_module("measure.table")
    path = tmp_path / "results" / "speed.csv"
    assert sources.stale(path, GLOBS) == "never measured"
    table.write(path, ("scene", "ms"), [("case2", "4")], globs=GLOBS, cpu_s=1.25)
    assert sources.stale(path, GLOBS) == ""
    assert "engine 0123456789ab, " in sources.words(path)
    files[1].write_text("double two() { return 3.0; }\n")
    assert sources.stale(path, GLOBS) == ""
    files[0].write_text("double two() { return 3.0; }\n")
    sources._digest_of.cache_clear()
    assert sources.stale(path, GLOBS) == "its sources have changed"
    told = json.loads((path.parent / sources.LIST).read_text())
    assert told["speed.csv"]["cpu_s"] == 1.2
    table.write(path, ("scene", "ms"), [("case2", "4")])
    assert sources.stale(path, GLOBS) == "its sources were not recorded"


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
