"""What the sea at moving points costs: twenty points in a line or a cloud, by kind of sea and depth."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from seacrane import _core
from seacrane.sea import SeaState, WaveSystem, cos_2s, jonswap

from .section import Section

POINTS = 20
COMPONENTS = 200
STEP = np.array([0.6, 0.1, -0.1])  # m, between points, and the length of each element
SEAS = {"long-crested": None, "short-crested": cos_2s(10.0)}
DEPTHS = {"deep": float("inf"), "30 m": 30.0}


def moving_points(*, repeats: int) -> Section:
    """One evaluation of a stencil, by shape, sea, depth, stretching, and height of its first point."""
    rows = []
    for sea, spreading in SEAS.items():
        for name, depth in DEPTHS.items():
            for stretching in ("none", "wheeler"):
                for height in (-1.0, -12.0):
                    field = _field(spreading, depth, stretching)
                    times = _cost(field, height, repeats)
                    rows.append([sea, name, stretching, height, *times])
    return Section(
        title="The sea at moving points",
        text=(
            f"{POINTS} points, {COMPONENTS} components of JONSWAP (Hs 2 m, Tp 8 s), filter on, cut 1e-5: "
            "elevation, its rate and slopes, velocity, acceleration and pressure at all points. A line of "
            "equal steps goes from point to point by one factor for each component. A cloud begins anew."
        ),
        head=["sea", "depth", "stretching", "first z [m]", "line [us]", "cloud [us]"],
        rows=rows,
    )


def _field(spreading: object, depth: float, stretching: str) -> _core.SeaField:
    system = WaveSystem(
        spectrum=jonswap(hs=2.0, tp=8.0), direction_deg=30.0, spreading=spreading, count=COMPONENTS
    )
    waves = SeaState(systems=[system], seed=1, depth=depth).realise().waves
    return _core.SeaField(waves, stretching=stretching)


def _cost(field: _core.SeaField, height: float, repeats: int) -> tuple[float, float]:
    """us of an evaluation of a line and of a cloud at the same points."""
    evaluator = _core.FlowEvaluator(field, count=POINTS)
    first = np.array([3.0, -2.0, height])
    points = first + STEP * np.arange(POINTS)[:, None]
    extents = np.column_stack([STEP, np.zeros((3, 2))])
    at = {"time": 100.0, "dt": 0.01}

    def best(call: Callable[..., float], count: int) -> float:
        least = np.inf
        for _ in range(repeats):
            start = time.thread_time()
            call(count=count, **at)
            least = min(least, (time.thread_time() - start) / count)
        return 1e6 * float(least)

    line = best(lambda **now: evaluator.repeat_line(first=first, step=STEP, **now), 2000)
    cloud = best(lambda **now: evaluator.repeat_cloud(points=list(points), extents=extents, **now), 500)
    return line, cloud
