"""Exudyn's reeving: the engine agrees with its record, which a run anew gives where Exudyn is."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose


@pytest.fixture
def reeving(monkeypatch: pytest.MonkeyPatch, repository: Path) -> Any:
    """The module that compares."""
    monkeypatch.syspath_prepend(str(repository / "benchmarks"))
    return importlib.import_module("compared.reeving")


def test_the_engine_agrees_with_the_record(reeving: Any) -> None:
    rows = list(reeving.exudyn(np.array(reeving.recorded())))
    assert rows
    for row in rows:
        assert row.difference <= row.limit, row.compared


def test_exudyn_gives_its_record(reeving: Any) -> None:
    pytest.importorskip("exudyn", reason="needs the package 'exudyn', as `make bench` installs it")
    assert_allclose(np.array(reeving.peer.run()), reeving.recorded(), atol=1e-6, rtol=1e-8)
