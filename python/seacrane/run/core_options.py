"""How the core steps a run: the options of a method and its outputs."""

from __future__ import annotations

from collections.abc import Set
from typing import Any

from seacrane import _core
from seacrane.run.method import Method


def core_options(
    method: Method,
    formulation: str,
    *,
    channels: Set[str],
    times: Any,
    capacity: int | None = None,
    extremes: Set[str] = frozenset(),
    trail: Set[str] = frozenset(),
) -> _core.RunOptions:
    """The options of the core for a method, with the channels that it records and when (s).

    `extremes`: those of the channels of which it keeps least and largest values between outputs. `trail`:
    those whose values at every step it keeps.
    """
    return _core.RunOptions(
        formulation=formulation, integrator=method.integrator, scaled_tolerance=method.used_rtol,
        fixed_step=method.dt, max_step=method.maximum_step, spectral_radius=method.spectral_radius,
        energy_limit=method.energy_limit, output_times=times, channels=channels,
        extremes=extremes, trail=trail, capacity=capacity,
    )  # fmt: skip
