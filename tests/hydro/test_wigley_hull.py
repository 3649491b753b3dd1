"""Wigley's hull solved by Capytaine: its relations, and the memory that its motions ask for."""

from __future__ import annotations

import warnings
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hull_shapes import wigley_offsets

from seacrane.hydro import Hull, HydroDatabase, fit_memory, hydro_from_hull
from seacrane.hydro.memory.motion_judge import motion_judge
from seacrane.hydro.readers.band_of_data import first_rough_value

LENGTH, BREADTH, DRAUGHT = 100.0, 10.0, 6.25


@cache
def wigley() -> HydroDatabase:
    pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    hull = Hull.from_offsets(wigley_offsets(LENGTH, BREADTH, DRAUGHT, 8)).remeshed(stations=28, girth=5)
    return hydro_from_hull(
        hull, center_of_gravity=(0.0, 0.0, -2.0), omega=np.linspace(0.1, 2.2, 31), method="capytaine",
        heading=np.radians(np.arange(0.0, 181.0, 15.0)), roll_damping_fraction=0.03, trusted_band=(0.2, 1.9),
    )  # fmt: skip


@pytest.mark.warns("FloatingPositionWarning")
def test_its_restoring_is_that_of_the_parabolas_and_its_data_obey_the_relations() -> None:
    """Volume 4/9 L B T, waterplane 2/3 L B, metacentric radius 3/35 B^2 / T."""
    database = wigley()
    volume = 4.0 / 9.0 * LENGTH * BREADTH * DRAUGHT
    assert database.mass_matrix[0, 0] == pytest.approx(1025.0 * volume, rel=0.02)
    assert database.restoring[2, 2] == pytest.approx(1025.0 * 9.81 * 2.0 / 3.0 * LENGTH * BREADTH, rel=0.01)
    height = 3.0 / 35.0 * BREADTH**2 / DRAUGHT - 3.0 / 8.0 * DRAUGHT + 2.0
    assert database.restoring[3, 3] == pytest.approx(1025.0 * 9.81 * volume * height, rel=0.03)
    rows = [row for row in replace(database, memory=None).check() if "memory" not in row.check]
    judged = [row for row in rows if row.check.startswith(("damping_from_forces", "kramers_kronig"))]
    assert len(judged) == 12 and all(row.verdict == "pass" for row in judged), judged
    assert first_rough_value(database) is None


def test_a_memory_by_motion_keeps_what_one_by_pair_does_not() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        few, many = (fit_memory(database=wigley(), kind=kind) for kind in ("by-motion", "per-pair"))
    judge = motion_judge(wigley(), (0.2, 1.9))
    assert judge.error_of(few).worst < 0.0101
    assert judge.error_of(many).worst > 0.02
    assert few.states < 0.6 * many.states
