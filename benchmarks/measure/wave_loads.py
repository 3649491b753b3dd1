"""What wave loads cost per evaluation: summed, from a table, from an FFT, at the actual position."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import Any

import numpy as np

from seacrane import ByHeading, Scene, Waves
from seacrane.hydro import HydroDatabase, shipped_database
from seacrane.sea import ExactWaveLoad, WaveTable, jonswap
from seacrane.vessel import add_vessel

from .section import Section
from .timing import evaluation_ns

COUNTS = (10, 200, 2_000, 10_000)
BAND = (0.3, 2.5)  # rad/s


def wave_loads(*, repeats: int, counts: tuple[int, ...] = COUNTS) -> Section:
    """One evaluation with waves less one without, by number of components and kind of evaluation."""
    database = shipped_database()
    calm = Scene(name="calm")
    add_vessel(calm, database)
    still = evaluation_ns(calm.compile(), repeats=repeats)
    rows = [_row(calm, database, count, still, repeats) for count in counts]
    return Section(
        title="Wave loads",
        text=(
            "The vessel alone in waves less the vessel in calm water, ns per evaluation; calls 25 ms apart, as in "
            "a run. The table's knots are made on the way and are part of it. Set-up is the compilation of the "
            "scene; equally spaced frequencies, so that the FFT's series holds one period, 2 pi / step."
        ),
        head=["components", "exact sum", "table", "FFT series", "actual position", "table, knots s apart",
              "set-up table [ms]", "set-up FFT [ms]", "FFT series covers [h]"],
        rows=rows,
    )  # fmt: skip


def _row(calm: Scene, database: HydroDatabase, count: int, still: float, repeats: int) -> list[Any]:
    waves = _sea(database, count)
    heading, _ = database.full_circle()
    chosen = heading[:: max(1, len(heading) // 24)]  # every 15 deg: the cost does not depend on it
    values = database.force_at(waves.omega[None, :], chosen[:, None])
    kinds = {
        "exact": replace(waves, evaluation="exact"),
        "table": waves,
        "fft": replace(waves, evaluation="fft"),
        "actual": replace(waves, force_by_heading=ByHeading(heading=chosen, values=values)),
    }
    cost, setup = {}, {}
    for kind, sea in kinds.items():
        scene = calm.copy(waves=sea)
        start = time.thread_time()
        model = scene.compile()
        setup[kind] = (time.thread_time() - start) * 1e3
        calls = 4_000 if kind in ("table", "fft") else max(100, min(4_000, 800_000 // count))
        cost[kind] = evaluation_ns(model, repeats=repeats, count=calls) - still
    exact = ExactWaveLoad(waves.components(), transfer=waves.transfer)
    step = WaveTable(exact, relative_bound=waves.relative_bound).step
    period_h = 2.0 * np.pi / (waves.omega[1] - waves.omega[0]) / 3600.0
    return [count, *(cost[kind] for kind in ("exact", "table", "fft", "actual")), step, setup["table"],
            setup["fft"], period_h]  # fmt: skip


def _sea(database: HydroDatabase, count: int) -> Waves:
    """JONSWAP, Hs 2 m, Tp 8 s, at equally spaced frequencies, multiples of the step."""
    first = int(np.ceil(BAND[0] / ((BAND[1] - BAND[0]) / count)))
    step = BAND[0] / first
    omega = step * (first + np.arange(count))
    omega = omega[omega <= BAND[1]]
    spectrum = jonswap(hs=2.0, tp=8.0)
    density = np.array([spectrum.density(w) for w in omega])
    direction = np.radians(135.0)
    return Waves(
        body="vessel",
        omega=omega,
        amplitude=np.sqrt(2.0 * density * step),
        phase=np.random.default_rng(1).uniform(0.0, 2.0 * np.pi, omega.size),
        direction=np.full(omega.size, direction),
        transfer=database.force_at(omega, direction),
    )
