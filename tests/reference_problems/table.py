"""The comparisons that docs/validation.md shows."""

from __future__ import annotations

from collections.abc import Iterator

from .comparison import Comparison
from .problems import (
    bricard_loop,
    decays,
    flyball_governor,
    four_bar_row,
    heavy_top,
    regular_wave_response,
    ship_in_a_wave,
    simple_pendulum,
    spatial_slider_crank,
    squeezer,
    wing_nut,
)


def mechanisms() -> Iterator[Comparison]:
    for formulation in ("redundant", "recursive"):
        yield simple_pendulum(formulation=formulation, rtol=1e-10)
        yield four_bar_row(formulation=formulation, integrator="dop853", rtol=1e-10)
        yield squeezer(formulation=formulation, integrator="verner76", rtol=1e-8)
        yield squeezer(published=True, formulation=formulation, integrator="verner76", rtol=1e-8)
        yield bricard_loop(formulation=formulation, integrator="dop853", rtol=1e-9)
        yield flyball_governor(formulation=formulation, integrator="dopri5", rtol=1e-6)
        yield heavy_top(formulation=formulation, integrator="dop853", rtol=1e-9)
        yield heavy_top(published=True, formulation=formulation, integrator="dop853", rtol=1e-9)
        yield wing_nut(formulation=formulation, rtol=1e-10)
        yield spatial_slider_crank(formulation=formulation, integrator="dop853", rtol=1e-10)


def ships() -> Iterator[Comparison]:
    for memory in ("states", "convolution"):
        yield ship_in_a_wave(memory, integrator="dop853", rtol=1e-11)
    for motion in ("heave", "roll", "pitch"):
        yield from decays(f"vessel {motion}")
    yield from regular_wave_response()
