"""Exudyn's reeving and hydraulic actuator: the engine agrees with their records, which a run anew gives."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

pytestmark = pytest.mark.warns(sometimes=["UnitWarning"])


@pytest.fixture(params=["reeving", "hydraulics"])
def compared(request: pytest.FixtureRequest, modules: Any) -> Any:
    """The module that compares."""
    return modules(f"compared.{request.param}")


def test_the_engine_agrees_with_the_record(compared: Any) -> None:
    rows = list(compared.exudyn(np.array(compared.recorded())))
    assert rows and not [row.compared for row in rows if row.difference > row.limit]


def test_exudyn_gives_its_record(compared: Any) -> None:
    pytest.importorskip("exudyn", reason="needs the package 'exudyn', as `make bench` installs it")
    assert_allclose(np.array(compared.peer.run()), compared.recorded(), atol=1e-6, rtol=1e-8)
