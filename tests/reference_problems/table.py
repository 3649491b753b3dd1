"""The comparisons that docs/validation.md shows."""

from __future__ import annotations

from collections.abc import Iterator

from . import problems as p


def mechanisms() -> Iterator[p.Comparison]:
    for formulation in ("redundant", "recursive"):
        for problem, settings in (
            (p.simple_pendulum, {"rtol": 1e-10}), (p.four_bar_row, {"integrator": "dop853", "rtol": 1e-10}),
            (p.squeezer, {"integrator": "verner76", "rtol": 1e-8}),
            (p.squeezer, {"published": True, "integrator": "verner76", "rtol": 1e-8}),
            (p.bricard_loop, {"integrator": "dop853", "rtol": 1e-9}),
            (p.flyball_governor, {"integrator": "dopri5", "rtol": 1e-6}),
            (p.heavy_top, {"integrator": "dop853", "rtol": 1e-9}),
            (p.heavy_top, {"published": True, "integrator": "dop853", "rtol": 1e-9}),
            (p.wing_nut, {"rtol": 1e-10}), (p.spatial_slider_crank, {"integrator": "dop853", "rtol": 1e-10})
        ):  # fmt: skip
            yield problem(formulation=formulation, **settings)


def ships() -> Iterator[p.Comparison]:
    for memory in ("states", "convolution"):
        yield p.ship_in_a_wave(memory, integrator="dop853", rtol=1e-11)
    for motion in ("heave", "roll", "pitch"):
        yield from p.decays(f"vessel {motion}")
    yield from p.regular_wave_response()
