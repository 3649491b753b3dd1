"""Axes of time: runs of hours, days and weeks."""

from __future__ import annotations

import numpy as np

from seacrane import Scene, cases
from seacrane.accuracy.case import Case
from stability_atlas.axis import Axis
from stability_atlas.crane_axes import WAVES

HOUR = 3600.0  # s
OUTPUTS = 200


def _lift(hours: float) -> Case:
    """Case 2."""
    return Case(scene=cases.case2(count=WAVES), t_end=HOUR * hours, dt_out=HOUR * hours / OUTPUTS)


def _vessel(hours: float) -> Case:
    """The vessel alone in waves, its memory passive."""
    scene = cases.vessel(count=WAVES, memory="by-motion")
    return Case(scene=scene, t_end=HOUR * hours, dt_out=HOUR * hours / OUTPUTS)


def _pendulum(hours: float) -> Case:
    """A pendulum of 100 m without damping, let go at 0.1 rad."""
    scene = Scene(name="pendulum")
    length = 100.0
    scene.add_body(
        name="bob", mass=1e4, inertia=(1e4, 1e4, 1e4), position=length * np.array([0.1, 0.0, -0.995])
    )
    scene.add_joint(
        kind="revolute", name="pin", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0)
    )
    return Case(scene=scene, t_end=HOUR * hours, dt_out=HOUR * hours / OUTPUTS)


AXES = (
    Axis(name="hours-of-lift", title="Case 2 for hours", label="duration [h]", values=(0.02, 0.1),
         quick=(0.02,), long=(0.5, 3.0, 24.0), case=_lift),
    Axis(name="hours-of-vessel", title="The vessel alone in waves for hours", label="duration [h]",
         values=(0.1, 0.5), quick=(0.1,), long=(24.0, 1000.0), long_limit_s=400.0, case=_vessel),
    Axis(name="hours-of-pendulum", title="A pendulum without damping for hours", label="duration [h]",
         values=(0.1, 1.0), quick=(0.1,), long=(3.0, 24.0, 1000.0), case=_pendulum),
)  # fmt: skip
