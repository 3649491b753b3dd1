"""Operability of loads in water: the linear route and what it refuses, slack of each line by runs."""

from __future__ import annotations

import numpy as np
from operability_scenes import vessel

from seacrane import Criterion, equilibrium, simulate
from seacrane.analysis.rest_state import held
from seacrane.hydro import SpherePart
from seacrane.operability.linear_channels import LinearSeas

MASS, DIAMETER, RHO, G = 30e3, 2.5, 1025.0, 9.80665  # kg, m, kg/m3, m/s2
TOP = (-50.0, 0.0, 20.0)


def test_channels_of_the_linear_model_under_water_are_those_of_a_run() -> None:
    """A sphere 6 m deep below the stern: waves load it and the ship, and go into its acceleration."""
    scene, weight = vessel(hs=0.002), (MASS - RHO * np.pi / 6.0 * DIAMETER**3) * G
    scene.add_body("load", mass=MASS, size=(2.0, 2.0, 2.0), position=(TOP[0], TOP[1], -6.0))
    path = {"bodies": ["vessel", "load"], "points": [TOP, (0.0, 0.0, 0.0)]}
    scene.add_line("wire", **path, EA=2e7, tension_at_start=weight, damping_ratio=0.05)
    scene.add_point("ball", body="load")
    scene.add_spring("swing", first="vessel", second="load", first_point=TOP, damping_ratio=0.05)
    scene.add_immersed("load", parts=[SpherePart(diameter=DIAMETER, drag=0.0)], density=RHO)
    criteria = (
        Criterion(channel="line_tension", names={"line": "wire"}, maximum=1e6),
        Criterion(channel="position", names={"body": "load", "axis": "x"}, maximum=1.0),
        Criterion(channel="point_acceleration", names={"point": "ball", "axis": "x"}, maximum=1.0),
    )
    rest = equilibrium(scene)
    still = held(scene).copy(waves=scene.waves)
    linear = LinearSeas(still, rest, criteria)
    start, told = linear.in_waves(still.waves, 0.0, 0.5 * np.arange(61))
    run = simulate(
        still, t_end=30.0, start=start, dt_out=0.5, rtol=1e-8, channels=[one.channel for one in criteria]
    )
    found = np.stack([run.curve(one.channel, **one.names) for one in criteria], axis=1)
    assert np.all(np.std(found - told, axis=0) < 0.02 * np.std(told, axis=0))
