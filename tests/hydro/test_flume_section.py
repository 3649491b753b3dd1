"""The section in a flume's depth: against strip theory in deep water, energy, the committed file."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import _core
from seacrane.hydro import HydroDatabase

ROOT = Path(__file__).resolve().parents[2]
WATER: dict[str, float] = {"rho": 1000.0, "g": 9.81}


@pytest.fixture
def flume(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(str(ROOT / "tools" / "flume_section"))
    return importlib.import_module("flume_database")


def test_in_deep_water_it_is_the_section_of_the_strip_theory(flume: Any) -> None:
    """Another method: panels all round the water here, sources on the section alone there."""
    omega = 4.0
    found = flume.section_in_flume(flume.outline(1.0), omega, depth=3.0, fineness=2.0, **WATER)
    other = _core.section_radiation(points=flume.outline(1.0)[::-1], omega=[omega], panels=40, **WATER)
    for name in ("added_mass", "damping"):
        theirs = np.diag(other[name][0])
        assert np.diag(getattr(found, name)) == pytest.approx(theirs, rel=0.015)
    assert np.abs(found.radiated) == pytest.approx(np.abs(other["wave_amplitude"][0]), rel=0.01)


def test_energy_is_kept_and_phases_of_radiated_waves_give_the_reflection(flume: Any) -> None:
    """|R|^2 = cos^2 of the angle between the waves that sway and heave radiate, for a symmetric section."""
    found = flume.section_in_flume(flume.outline(1.0), 5.0, depth=1.0, **WATER)
    assert abs(found.reflected) ** 2 + abs(found.transmitted) ** 2 == pytest.approx(1.0, abs=0.005)
    between = np.angle(found.radiated[0]) - np.angle(found.radiated[1])
    assert abs(found.reflected) ** 2 == pytest.approx(np.cos(between) ** 2, abs=0.01)
    k, h = found.wavenumber, 1.0
    speed = 0.5 * 5.0 / k * (1.0 + 2.0 * k * h / np.sinh(2.0 * k * h))
    radiated = 2.0 * 1000.0 * 9.81 * speed * np.abs(found.radiated) ** 2 / 5.0**2
    assert np.diag(found.damping) == pytest.approx(radiated, rel=0.01)


def test_the_committed_database_is_what_the_script_computes(flume: Any) -> None:
    database = HydroDatabase.load(flume.PLACE)
    at = int(np.argmin(np.abs(database.omega - 7.004)))
    found = flume.section_in_flume(
        flume.outline(), float(database.omega[at]), depth=flume.DEPTH, fineness=flume.FINENESS, **WATER
    )
    assert flume.LENGTH * np.diag(found.damping) == pytest.approx(
        np.diag(database.damping[at])[1:4], rel=1e-6
    )
    assert flume.LENGTH * found.force == pytest.approx(database.force[0, at, 1:4], rel=1e-6)
    assert flume.drift_of(found) == pytest.approx(database.drift.coefficient[0, at, 1], rel=1e-6)
    assert database.depth == 1.0
