"""What it costs to make a sea and to read it."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Scene, SeaState, WaveSystem
from seacrane.hydro import HydroDatabase, shipped_database
from seacrane.sea import cos_2s, jonswap, torsethaugen

from .section import Section
from .timing import best_seconds

COUNTS = (200, 2_000, 10_000)
TIMES, X = np.linspace(0.0, 100.0, 101)[:, None], np.linspace(-50.0, 50.0, 10)  # s, m


def seas(*, repeats: int, counts: tuple[int, ...] = COUNTS) -> Section:
    """CPU time by number of components; elevation and flow per component, point and time."""
    database = shipped_database()
    return Section(
        title="Seas",
        text=(
            "CPU time by number of components, each with a direction of its own. In ms: to realise a sea, "
            "with the search for a repetition within three hours, and to put it into a scene. In ns: "
            f"elevation and flow, per component, point and time. Best of {repeats}."
        ),
        head=["components", "JONSWAP, ms", "Torsethaugen, ms", "`add_sea`, ms", "elevation, ns", "flow, ns"],
        rows=[_row(database, count, repeats) for count in counts],
    )


def _row(database: HydroDatabase, count: int, repeats: int) -> list[Any]:
    sea, other = (
        SeaState(
            systems=[WaveSystem(spectrum=spectrum, direction_deg=135.0, spreading=cos_2s(6.0), count=count)],
            seed=1,
        )
        for spectrum in (jonswap(hs=2.0, tp=8.0), torsethaugen(hs=2.0, tp=8.0))
    )
    waves = sea.realise().waves

    def loads() -> None:
        scene = Scene(name="sea")
        scene.add_vessel(database)
        scene.add_sea(sea=sea)

    calls = (lambda: sea.realise().repeat, lambda: other.realise().repeat, loads)
    preparing = [best_seconds(call, repeats=repeats) for call in calls]
    reading = [
        best_seconds(lambda: waves.elevation(TIMES, x=X, y=0.0), repeats=repeats),
        best_seconds(lambda: waves.kinematics(time=TIMES, x=X, y=0.0, z=-5.0), repeats=repeats),
    ]
    evaluations = count * TIMES.size * X.size
    return [count, *(1e3 * s for s in preparing), *(1e9 * s / evaluations for s in reading)]
