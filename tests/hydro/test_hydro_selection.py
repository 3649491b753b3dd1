"""HydroDatabase.select: part of the frequencies and headings, the stored numbers."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from seacrane.hydro import AdditionalMatrices, DriftCoefficients, HydroDatabase, RollDamping, shipped_database


def full() -> HydroDatabase:
    """The shipped hull with every part that depends on frequency or heading."""
    base = shipped_database()
    rng = np.random.default_rng(3)
    n, m = len(base.omega), len(base.heading)
    return dataclasses.replace(
        base,
        motion_rao=rng.normal(size=(m, n, 6)) + 1j * rng.normal(size=(m, n, 6)),
        roll_damping=RollDamping(
            linear=rng.random(n), quadratic=rng.random(n), linearised=rng.random((m, n))
        ),
        additional=(
            AdditionalMatrices(
                cause="roll tanks",
                added_mass=rng.normal(size=(n, 6, 6)),
                damping=rng.normal(size=(n, 6, 6)),
                restoring=rng.normal(size=(n, 6, 6)),
            ),
        ),
        drift=DriftCoefficients(
            heading=np.array([0.0, 1.0]), omega=np.array([0.5, 1.0]), coefficient=rng.random((2, 2, 6))
        ),
    )


def test_selected_values_are_the_stored_ones() -> None:
    base = full()
    part = base.select(omega=(0.5, 1.5), heading=[3, 0, -1], every=2)
    rows = np.flatnonzero((base.omega >= 0.5) & (base.omega <= 1.5))[::2]
    headings = np.array([0, 3, len(base.heading) - 1])
    assert np.array_equal(part.omega, base.omega[rows]) and np.array_equal(
        part.heading, base.heading[headings]
    )
    assert np.array_equal(part.force, base.force[headings][:, rows])
    assert base.motion_rao is not None and base.roll_damping is not None and part.roll_damping is not None
    assert np.array_equal(part.motion_rao, base.motion_rao[headings][:, rows])  # type: ignore[arg-type]
    assert np.array_equal(part.roll_damping.linearised, base.roll_damping.linearised[headings][:, rows])
    assert np.array_equal(part.roll_damping.linear, base.roll_damping.linear[rows])
    assert np.array_equal(part.damping, base.damping[rows])
    assert np.array_equal(part.additional[0].damping, base.additional[0].damping[rows])
    assert part.drift is base.drift and np.array_equal(part.restoring, base.restoring)
    assert not part.force.flags.writeable
    assert part.trusted_band == (part.omega[0], part.omega[-1])


def test_a_heading_range_may_cross_zero() -> None:
    full_turn = dataclasses.replace(shipped_database().at((0.0, 1.0, 0.0)), memory=None)
    part = full_turn.select(heading=(np.radians(-20.0), np.radians(10.0)))
    assert np.degrees(part.heading) == pytest.approx([0.0, 5.0, 10.0, 340.0, 345.0, 350.0, 355.0])


def test_memory_stays_with_all_its_frequencies() -> None:
    base = shipped_database()
    assert base.select(heading=slice(0, None, 2)).memory is base.memory
    assert base.select().memory is base.memory
    assert base.select(omega=slice(1, None)).memory is None
    assert base.select(omega=(0.0, 2.0)).trusted_band == (0.3, base.omega[base.omega <= 2.0][-1])
    assert base.select(omega=[20]).trusted_band == base.trusted_band


@pytest.mark.parametrize(
    ("choice", "message"),
    [
        ({"omega": (2.0, 1.0)}, r"omega = \(2.0, 1.0\) is no range"),
        ({"omega": (1.0, np.nan)}, "is no range"),
        ({"omega": (1.0, 2.0, 3.0)}, "is no range"),
        ({"omega": (5.0, 6.0)}, "leaves nothing of 0.1 to 3.1 rad/s"),
        ({"omega": []}, "leaves nothing"),
        ({"omega": [0, 99]}, "counts beyond its 61 values"),
        ({"omega": [0.5, 1.5]}, "neither a range"),
        ({"omega": [1, 1]}, "names a value twice"),
        ({"heading": [[0, 1]]}, "neither a range"),
        ({"omega": (2.6, 3.0)}, "outside the trusted band 0.3 to 2.5"),
        ({"every": 0}, "every = 0; give a positive whole number"),
        ({"every_heading": 1.5}, "every_heading = 1.5"),
    ],
)
def test_a_choice_that_makes_no_sense(choice: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        shipped_database().select(**choice)
