"""What wave loads cost per evaluation: summed, from a table, at the actual position."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from seacrane import Scene
from seacrane.hydro import HydroDatabase, shipped_database
from seacrane.scene import HullLoads, Waves
from seacrane.scene.sea_loads import force_by_heading
from seacrane.sea import ExactWaveLoad, WaveTable, jonswap

from .scaling import exponent
from .section import Section
from .sources import HULL, STEPS, WATER
from .timing import evaluation_ns

COUNTS = (10, 30, 100, 300, 1_000, 3_000, 10_000)
LARGE = 100  # exponents are fitted from here on, where fixed costs no longer show
BAND = (0.3, 2.5)  # rad/s
REPEATS = 5


def wave_loads() -> Iterator[list[Any]]:
    """One evaluation with waves less one without, by number of components and kind of evaluation."""
    database = shipped_database()
    calm = Scene(name="calm")
    calm.add_vessel(database, memory="per-pair")
    rows = [_row(calm, database, count) for count in COUNTS]
    slopes = [exponent(list(COUNTS), [row[k] for row in rows], LARGE) for k in range(1, 4)]
    yield from (*rows, ["exponent", *slopes, None, None])


def _row(calm: Scene, database: HydroDatabase, count: int) -> list[Any]:
    waves = _sea(database, count)
    kinds = {
        "calm": None,
        "exact": replace(waves, evaluation="exact"),
        "table": waves,
        "actual": waves.changed(force_by_heading=force_by_heading(database, waves.omega)),
    }
    models, setup, cost = {}, {}, dict.fromkeys(kinds, np.inf)
    for kind, sea in kinds.items():
        scene = calm.copy(waves=sea)
        start = time.thread_time()
        models[kind] = scene.compile()
        setup[kind] = (time.thread_time() - start) * 1e3
    for _ in range(REPEATS):  # in turn, so that all kinds meet the same disturbances
        for kind, model in models.items():
            calls = max(200, 400_000 // count) if kind in ("exact", "actual") else 20_000
            cost[kind] = min(cost[kind], evaluation_ns(model, repeats=1, count=calls))
    exact = ExactWaveLoad(waves.components(), transfer=waves.hull().transfer)
    above = [cost[kind] - cost["calm"] for kind in ("exact", "table", "actual")]
    return [count, *above, WaveTable(exact).step, setup["table"]]


def _sea(database: HydroDatabase, count: int) -> Waves:
    """JONSWAP, Hs 2 m, Tp 8 s, at equally spaced frequencies."""
    first = int(np.ceil(BAND[0] / ((BAND[1] - BAND[0]) / count)))
    step = BAND[0] / first
    omega = step * (first + np.arange(count))
    omega = omega[omega <= BAND[1]]
    spectrum = jonswap(hs=2.0, tp=8.0)
    density = np.array([spectrum.density(w) for w in omega])
    direction = np.radians(135.0)
    transfer = np.concatenate([database.force_at(part, direction) for part in np.array_split(omega, 10)])
    return Waves(
        omega=omega,
        amplitude=np.sqrt(2.0 * density * step),
        phase=np.random.default_rng(1).uniform(0.0, 2.0 * np.pi, omega.size),
        direction=np.full(omega.size, direction),
        hulls={"vessel": HullLoads(transfer=transfer)},
    )


SECTION = Section(
    title="Wave loads",
    text=(
        "The vessel alone in waves less the vessel in calm water, ns per evaluation; calls 25 ms apart, as "
        "in a run. The table's knots are made on the way and are part of it. Set-up is the time to compile "
        "the scene. Exponent: slope in "
        f"logarithms from {LARGE} components on."
    ),
    head=["components", "exact sum", "table", "actual position", "table, knots s apart", "set-up table [ms]"],
    rows=wave_loads,
    sources=(*STEPS, *WATER, *HULL),
)  # fmt: skip
