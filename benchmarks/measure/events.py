"""Errors of a wire that goes slack and snatches, against SciPy with its own events."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from seacrane import simulate

from .section import Section
from .sources import RUN, STEPS

TESTS = Path(__file__).resolve().parents[2] / "tests"
T_END, DT_OUT = 2.2, 0.02  # s
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
SIZES = (0.08, 0.04, 0.02, 0.01)  # s


def slack_wire() -> Iterator[list[Any]]:
    """Times of slack and snatch and the path of the ball, by `dopri5` and by `rk4`."""
    sys.path.insert(0, str(TESTS / "scenes"))
    from event_scenes import pendulum, scipy_pendulum

    time = np.arange(0.0, T_END + 0.5 * DT_OUT, DT_OUT)
    path, events = scipy_pendulum(time, 0.0)

    def row(**settings: Any) -> list[Any]:
        name, value = next((key, settings[key]) for key in ("rtol", "dt") if key in settings)
        run = simulate(pendulum(), t_end=T_END, dt_out=DT_OUT, **settings)
        found = [event.time for event in run.events[:2]]
        distance = np.linalg.norm(run.select("position", body="ball")[:, [0, 2]] - path, axis=1)
        errors = [
            float(f"{error:.1e}") for error in (*np.abs(np.subtract(found, events[:2])), distance.max())
        ]
        return [settings["integrator"], f"{name} {value:g}", *errors, run.stats["evaluations"]]

    yield from (row(integrator="dopri5", rtol=rtol) for rtol in TOLERANCES)
    yield from (row(integrator="rk4", dt=dt) for dt in SIZES)


SECTION = Section(
    title="A wire that goes slack",
    text=(
        "A ball of 3 kg on a wire of 2 m is thrown so fast that the wire goes slack and snatches. The table "
        f"gives the errors of both times, and the largest error of its place until {T_END} s, against "
        "SciPy's `solve_ivp` at 1e-12 with events of its own."
    ),
    head=["integrator", "setting", "slack, s", "snatch, s", "path, m", "evaluations"],
    rows=slack_wire,
    sources=(*STEPS, *RUN),
)
