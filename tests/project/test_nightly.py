"""The night goes on after a failure, tells of each row, and keeps lines of rows that did not run."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest


@pytest.fixture
def nightly(repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    spec = importlib.util.spec_from_file_location("nightly", repository / "tools" / "nightly.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "nightly", module)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "ROWS", {"bad": ("no-such-target", "fails"), "good": ("--version", "passes")})
    monkeypatch.setattr(module, "LOGS", tmp_path / "logs")
    monkeypatch.setattr(module, "TABLE", repository / "out" / "test_nightly.md")
    (repository / "out").mkdir(exist_ok=True)
    module.TABLE.write_text("| fails | 1 | 2 | yes | abc | 2026-01-01 |\n", encoding="utf-8")
    return module


def test_a_row_that_fails_does_not_stop_the_next(
    nightly: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["nightly.py"])
    assert nightly.main() == 1
    text = nightly.TABLE.read_text(encoding="utf-8")
    assert "| fails |" in text and "**no**, exit code 2" in text and "2026-01-01" not in text
    assert "| passes |" in text and "| yes |" in text
    assert "no-such-target" in (nightly.LOGS / "bad.log").read_text()


def test_a_row_alone_leaves_the_lines_of_others(nightly: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["nightly.py", "good"])
    assert nightly.main() == 0
    text = nightly.TABLE.read_text(encoding="utf-8")
    assert "| fails | 1 | 2 | yes | abc | 2026-01-01 |" in text and "| passes |" in text
