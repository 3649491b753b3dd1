"""A half immersed sphere that is let go 1 m above its rest, by six programs (IEA OES Task 10)."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from measured_numbers import columns
from measured_row import Array, MeasuredRow, Source

from seacrane import Scene, simulate
from seacrane.hydro import HydroDatabase

SOURCE = Source(
    title="Decay of a sphere",
    repository="NREL/HydroChrono",
    commit="b0de39ed7375fa61ffc45d02751cada0cabf4855",
    licence="MIT",
    about="not measured: heave decay of a sphere by six programs, IEA OES Task 10 (Wendt et al. 2017)",
)
RADIUS, HEIGHT, RHO, G = 5.0, 1.0, 1000.0, 9.81
ABOVE = 50.0  # m: of the spring's upper end
LINEAR = ("ProteusDS_linear", "InWave_linear", "WavEC_linear", "InWaveH_linear")
BY_SURFACE, OVER_HEAVE = "MARIN_nonlinear", "buoyancy over heave"


def rows(folder: Path) -> Iterator[MeasuredRow]:
    told = columns(folder / "decay_1m.csv")
    time = told.pop("time_s")
    linear = np.array([told[name] for name in LINEAR])
    every = np.array(list(told.values()))
    for by, reference, words in (
        ("linear", linear.mean(axis=0), "mean of four linear programs"),
        (OVER_HEAVE, told[BY_SURFACE], f"{BY_SURFACE.partition('_')[0]}, wetted surface of the moment"),
    ):
        ours = decay(time, nonlinear=by == OVER_HEAVE)
        common: dict[str, Any] = {
            "picture": "measured_oes_sphere", "panel": "heave after a release at 1 m", "by": by,
            "x": "time, s", "y": "heave, m", "points": (time[::10], every.mean(axis=0)[::10]),
            "line": (time, ours), "told": "mean of all six",
            "spread": (every.min(axis=0)[::10], every.max(axis=0)[::10]),
            "others": {name.replace("_", ", "): (time, one) for name, one in told.items()},
        }  # fmt: skip
        spread = float((every.max(axis=0) - every.min(axis=0)).max() / np.ptp(every) / 2.0)
        yield MeasuredRow(
            **common, compared=f"heave over 40 s, {words}", at=time, measured=reference, ours=ours,
            of="range", repeats=spread, expected=None,
        )  # fmt: skip
        peaks = every_peak(time, reference)
        tops = np.array([every_peak(time, one)[1][:4] for one in every])
        yield MeasuredRow(
            **common, compared=f"first four peaks, {words}", at=peaks[0][:4], measured=peaks[1][:4],
            ours=every_peak(time, ours)[1][:4], of="value",
            repeats=float((np.ptp(tops, axis=0) / tops.mean(axis=0) / 2.0).max()), expected=None,
        )  # fmt: skip


def decay(time: Array, *, nonlinear: bool) -> Array:
    """Heave at these times; what buoyancy is beside its tangent, a spring with a table gives over heave."""
    scene = Scene(name="sphere", gravity=G)
    database = HydroDatabase.load(Path(__file__).with_suffix(".nc"))
    scene.add_vessel(database, name="sphere", position=(0.0, 0.0, HEIGHT))
    if nonlinear:
        heave = np.linspace(RADIUS, -RADIUS, 401)
        scene.add_spring(
            "buoyancy over heave", first="ground", second="sphere", first_point=(0.0, 0.0, ABOVE),
            lengths=ABOVE - heave, forces=RHO * G * np.pi * heave**3 / 3.0,
        )  # fmt: skip
    result = simulate(scene, t_end=float(time[-1]) + 0.05, dt_out=0.05)
    return np.interp(time, result.time, result["vessel_motion"][:, 2])


def every_peak(time: Array, heave: Array) -> tuple[Array, Array]:
    """Times and heights of the peaks after the start."""
    at = np.flatnonzero((heave[1:-1] > heave[:-2]) & (heave[1:-1] >= heave[2:])) + 1
    return time[at], heave[at]
