"""A ship in waves against Cummins' equation, solved by other means: its integral, its roots."""

from __future__ import annotations

from typing import Any

import pytest
from reference_problems.problems import decays, ship_in_a_wave


@pytest.mark.parametrize(
    ("memory", "settings"),
    [("states", {"integrator": "dop853", "rtol": 1e-11}), ("convolution", {"integrator": "rk4", "dt": 0.02})],
    ids=["states", "convolution"],
)
def test_a_wave_from_rest_by_the_integral_over_the_past(memory: str, settings: dict[str, Any]) -> None:
    """6e-7 of each motion's largest value, in waves of 1e-5 m: the engine's rotations are finite."""
    assert ship_in_a_wave(memory, **settings).difference < 2e-6


@pytest.mark.parametrize("motion", ["heave", "roll", "pitch"])
def test_period_and_decrement_of_free_decay(motion: str) -> None:
    for found in decays(f"vessel {motion}"):
        assert found.difference < 2e-6 * found.expected, found
