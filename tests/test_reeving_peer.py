"""Exudyn's reeving, run anew where Exudyn is: its record is what it gives, and the engine agrees with it."""

from __future__ import annotations

import importlib
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose


def test_exudyn_agrees(monkeypatch: pytest.MonkeyPatch, repository: Path) -> None:
    pytest.importorskip("exudyn")
    monkeypatch.syspath_prepend(str(repository / "benchmarks"))
    reeving = importlib.import_module("compared.reeving")
    rows = np.array(reeving.peer.run())
    assert_allclose(rows, reeving.recorded(), atol=1e-6, rtol=1e-8)
    for row in reeving.exudyn(rows):
        assert row.difference <= row.limit, row.compared
