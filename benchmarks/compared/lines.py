"""Elastic lines against closed forms, the rigid wire, and each other's rungs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from line_scenes import MASS, G
from multibody_runs import record
from test_line_limits import falling, pendulum

from .row import Row

SUBJECT = "Lines"


def snatches() -> Iterator[Row]:
    """A load that falls into its slack line."""
    settings = {"dt_out": 2e-5, "rtol": 1e-9}
    line = record(falling(3.0, stiffness=3e10, along=0.5), 0.02, **settings)
    wire = record(falling(3.0, stiffness=None, along=0.5), 0.02, **settings)
    impulse = np.trapezoid(line["line_tension"][:, 0], line["time"])
    change = MASS * (wire["velocity"][-1, 0, 2] - wire["velocity"][0, 0, 2] + G * 0.02)
    rigid = "rigid wire of the same restitution"
    yield _row("snatch of 20 t at 3 m/s: impulse", rigid, impulse / change - 1.0, 0.01)
    apart = line["velocity"][-1, 0] - wire["velocity"][-1, 0]
    yield _row("the same: velocity after it", rigid, np.abs(apart).max() / 3.0, 0.01)
    half = np.pi / np.sqrt(3e8 / MASS)
    out = record(falling(2.0, stiffness=3e8, ratio=0.0), 0.01 + 1.5 * half, dt_out=half / 400, rtol=1e-9)
    expected = MASS * G + np.sqrt((MASS * G) ** 2 + 3e8 * MASS * 4.0)
    peak = float(out["line_tension"].max())
    yield _row("peak of a snatch at 2 m/s", "m g + sqrt((m g)^2 + k m v^2)", peak / expected - 1.0, 2e-5)


def rigid_limit() -> Iterator[Row]:
    """A pendulum on a line of 1e9 N against one on a rigid link: errors fall as 1 / EA."""
    settings = {"dt_out": 0.1, "rtol": 1e-9}
    rigid = record(pendulum(None), 6.0, **settings)
    for stretch in ("elastic", "quasi-static"):
        line = record(pendulum(1e9, rung=stretch), 6.0, **settings)
        apart = np.abs(line["line_tension"][10:, 0] - rigid["tension"][10:, 0]).max()
        compared = f"pendulum on a line of 1e9 N, {stretch}: tension"
        yield _row(compared, "rigid link", apart / np.abs(rigid["tension"]).max(), 1e-4)


def _row(compared: str, reference: str, difference: float, limit: float) -> Row:
    return Row(
        subject=SUBJECT, compared=compared, reference=reference, unit="", difference=abs(float(difference)),
        limit=limit, test="lines/test_line_limits.py",
    )  # fmt: skip
