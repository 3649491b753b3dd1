"""Every table of benchmarks tells which engine measured it, and a check names those of another one."""

from __future__ import annotations

import importlib
import json
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def engine(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    return importlib.import_module("measure.engine")


@pytest.fixture
def house(tmp_path: Path) -> Path:
    """A repository of one file, and a folder for tables."""
    (tmp_path / "cpp" / "seacrane").mkdir(parents=True)
    (tmp_path / "cpp" / "seacrane" / "one.hpp").write_text("double two() { return 2.0; }  // m\n")
    (tmp_path / "benchmarks" / "results").mkdir(parents=True)
    return tmp_path


def test_code_changes_the_engine_and_comments_and_layout_do_not(engine: Any, house: Path) -> None:
    first = engine.engine(house)
    for text, same in (
        ("/// Two.\ndouble two() {\n  return 2.0; /* m */\n}\n", True),
        ("double two() { return 3.0; }", False),
    ):
        (house / "cpp" / "seacrane" / "one.hpp").write_text(text)
        engine.engine.cache_clear()
        assert (engine.engine(house) == first) == same
    assert engine.code_of('say("a // b  c");  // d') == 'say("a // b  c");'
    assert engine.code_of("char c = '\"'; // \"\n int i;") == "charc='\"';inti;"


def test_a_table_of_another_engine_is_named(
    engine: Any, house: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One made of tables is of their engine."""
    table = importlib.import_module("measure.table")
    monkeypatch.setattr(engine, "engine", lambda root=house, real=engine.engine: real(house))
    folder = house / "benchmarks" / "results"
    parts = [folder / "one.csv", folder / "two.csv"]
    parts[0].write_text("scene,ms\n")
    assert engine.of_another(house) == [parts[0]] and "not recorded" in engine.words(parts[0])
    for part in parts:
        table.write(part, ("scene", "ms"), [("case2", "4")])
    assert engine.of_another(house) == []
    assert f"engine {engine.engine()}, " in engine.words(parts[0])
    table.write(folder / "facts.csv", ("ms",), [("4",)], of=parts)
    assert engine.measured(folder / "facts.csv") == engine.measured(parts[0]) is not None
    told = json.loads((folder / engine.LIST).read_text())
    told["two.csv"]["engine"] = "0" * 12
    (folder / engine.LIST).write_text(json.dumps(told))
    table.write(folder / "facts.csv", ("ms",), [("4",)], of=parts)
    assert engine.measured(folder / "facts.csv") is None
