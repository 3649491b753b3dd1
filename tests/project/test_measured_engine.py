"""Every table of benchmarks tells which engine measured it, and a check names those of another one."""

from __future__ import annotations

import importlib
import json
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def house(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository of one file, and a folder for tables."""
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    for folder in ("cpp/seacrane", "benchmarks/results"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "cpp" / "seacrane" / "one.hpp").write_text("double two() { return 2.0; }  // m\n")
    return tmp_path


def test_a_table_of_another_engine_is_named(house: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Code changes the engine; comments and layout do not. A table made of tables is of their engine."""
    engine, table = (importlib.import_module(f"measure.{name}") for name in ("engine", "table"))
    first, source = engine.engine(house), house / "cpp" / "seacrane" / "one.hpp"
    for text, same in (
        ("double two() { return 3.0; }", False),
        ("/// Two.\ndouble two() {\n  return 2.0; /* m */\n}\n", True),
    ):
        source.write_text(text)
        engine.engine.cache_clear()
        assert (engine.engine(house) == first) == same
    assert engine.code_of('say("a // b  c");  // d') == 'say("a // b  c");'
    assert engine.code_of("char c = '\"'; // \"\n int i;") == "charc='\"';inti;"
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
