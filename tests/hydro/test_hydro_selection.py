"""HydroDatabase.select: part of the frequencies and headings, the stored numbers."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest
from test_hydro_transform import full

from seacrane.hydro import shipped_database


def test_selected_values_are_the_stored_ones() -> None:
    base = full()
    part = base.select(omega=(0.5, 1.5), heading=[3, 0, -1], every=2)
    rows = np.flatnonzero((base.omega >= 0.5) & (base.omega <= 1.5))[::2]
    headings = np.array([0, 3, len(base.heading) - 1])
    assert len(rows) > 1 and np.array_equal(part.heading, base.heading[headings])
    for name in ("omega", "added_mass", "damping"):
        assert np.array_equal(getattr(part, name), getattr(base, name)[rows])
    for name in ("force", "motion_rao"):
        assert np.array_equal(getattr(part, name), getattr(base, name)[headings][:, rows])
    one, other = part.roll_damping, base.roll_damping
    assert one is not None and other is not None
    assert np.array_equal(one.linearised, other.linearised[headings][:, rows])
    assert np.array_equal(one.linear, other.linear[rows])
    assert np.array_equal(part.additional[0].damping, base.additional[0].damping[rows])
    assert part.drift is base.drift and np.array_equal(part.restoring, base.restoring)
    assert not part.force.flags.writeable
    assert part.trusted_band == (part.omega[0], part.omega[-1])


def test_ranges_cross_zero_and_memory_stays_with_all_its_frequencies() -> None:
    base = shipped_database()
    full_turn = dataclasses.replace(base.at((0.0, 1.0, 0.0)), memory=None)
    part = full_turn.select(heading=(np.radians(-20.0), np.radians(10.0)))
    assert np.degrees(part.heading) == pytest.approx([0.0, 5.0, 10.0, 340.0, 345.0, 350.0, 355.0])
    assert base.select(heading=slice(0, None, 2)).memory is base.memory
    assert base.select().memory is base.memory
    assert base.select(omega=slice(1, None)).memory is None
    assert base.select(omega=(0.0, 2.0)).trusted_band == (0.3, base.omega[base.omega <= 2.0][-1])
    assert base.select(omega=[20]).trusted_band == base.trusted_band


def test_a_choice_that_makes_no_sense() -> None:
    table: list[tuple[dict[str, Any], str]] = [
        ({"omega": (2.0, 1.0)}, "no range"), ({"omega": (1.0, np.nan)}, "no range"),
        ({"omega": (1.0, 2.0, 3.0)}, "no range"), ({"omega": (5.0, 6.0)}, "leaves nothing"),
        ({"omega": []}, "leaves nothing"), ({"omega": [0, 99]}, "beyond its 61"),
        ({"omega": [0.5, 1.5]}, "neither a range"), ({"omega": [1, 1]}, "twice"),
        ({"heading": [[0, 1]]}, "neither a range"), ({"omega": (2.6, 3.0)}, "trusted band 0.3 to 2.5"),
        ({"every": 0}, "every = 0"), ({"every_heading": 1.5}, "every_heading = 1.5"),
    ]  # fmt: skip
    for choice, message in table:
        with pytest.raises(ValueError, match=message):
            shipped_database().select(**choice)
