"""Scenes of the tests of operability, and a load on a soft wire that goes slack."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Criterion, Scene, cases

HEAVE = Criterion(channel="vessel_motion", names={"motion": "heave"}, maximum=0.8, motion=True,
                  exposure=900.0, name="heave")  # fmt: skip
PITCH = Criterion(channel="vessel_motion", names={"motion": "pitch"}, maximum=0.03, statistic="significant",
                  name="pitch")  # fmt: skip
SHORT: dict[str, Any] = {"duration": 900.0, "start_up": 100.0, "seeds": range(1, 6), "rtol": 1e-3}
HANGING_MASS, SOFT_PERIOD, WIRE = 5e3, 8.0, 10.0  # kg, s, m
WEIGHT = HANGING_MASS * 9.80665


def vessel(**sea: Any) -> Scene:
    return cases.vessel(**{"hs": 1.0, "tp": 8.0, **sea})


def soft_wire() -> Scene:
    """A load below the stern on a wire so soft that it resonates with the waves."""
    scene = vessel()
    spring = HANGING_MASS * (2.0 * np.pi / SOFT_PERIOD) ** 2
    top = (-50.0, 0.0, 30.0)
    scene.add_body("load", mass=HANGING_MASS, inertia=(HANGING_MASS,) * 3,
                   position=(top[0], 0.0, top[2] - WIRE - WEIGHT / spring))  # fmt: skip
    scene.add_line(name="wire", bodies=["vessel", "load"], points=[top, (0.0, 0.0, 0.0)], EA=spring * WIRE,
                   length=WIRE)  # fmt: skip
    scene.add_spring("swing", first="vessel", second="load", first_point=top, damping_ratio=0.05)
    return scene
