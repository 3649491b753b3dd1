"""Impacts and stops against closed forms."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from event_scenes import GRAVITY, HEIGHT, MASS, ball

from seacrane import simulate

from .row import Row


def bouncing_ball() -> Iterator[Row]:
    """A ball that loses half its speed at each bounce."""
    result = simulate(ball(), t_end=2.0, dt_out=0.05, rtol=1e-8)
    speed = np.sqrt(2.0 * GRAVITY * HEIGHT) * 0.5 ** np.arange(5)
    times = (speed[0] + np.concatenate([[0.0], np.cumsum(2.0 * speed[1:])])) / GRAVITY
    lost = 0.375 * MASS * speed**2
    events = result.events[:5]
    subject, reference = "Wires, stops, events", "closed form"
    yield Row(
        subject=subject, compared="bouncing ball: times of five bounces", reference=reference, unit="s",
        difference=float(np.abs([e.time - t for e, t in zip(events, times, strict=True)]).max()), limit=1e-9,
        test="run/test_events.py",
    )  # fmt: skip
    yield Row(
        subject=subject, compared="bouncing ball: energy lost in five bounces", reference=reference, unit="",
        difference=float(np.abs([e.energy_lost / w - 1.0 for e, w in zip(events, lost, strict=True)]).max()),
        limit=1e-8, test="run/test_events.py",
    )  # fmt: skip
