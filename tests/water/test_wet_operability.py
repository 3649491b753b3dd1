"""Operability of loads in water: the linear route and what it refuses, slack of each line by runs."""

from __future__ import annotations

import numpy as np
import pytest
from operability_scenes import vessel

from seacrane import Criterion, Scene, SceneError, allowable_hs, equilibrium, simulate
from seacrane.analysis.rest_state import held
from seacrane.operability.linear_seas import LinearSeas
from seacrane.water import BoxPart, SpherePart

MASS, DIAMETER, RHO, G = 30e3, 2.5, 1025.0, 9.80665  # kg, m, kg/m3, m/s2
TOP = (-50.0, 0.0, 20.0)


def towed(depth: float, **sea: float) -> Scene:
    """A sphere below the stern, its centre at a depth (m)."""
    scene = vessel(**sea)
    scene.add_body("load", mass=MASS, size=(2.0, 2.0, 2.0), position=(TOP[0], TOP[1], -depth))
    volume = np.pi / 6.0 * DIAMETER**3 if depth > 0.5 * DIAMETER else 0.0
    scene.add_line(
        "wire", bodies=["vessel", "load"], points=[TOP, (0.0, 0.0, 0.0)], EA=2e7,
        tension_at_start=(MASS - RHO * volume) * G, damping_ratio=0.05,
    )  # fmt: skip
    scene.add_point("ball", body="load")
    scene.add_pendulum_damping("swing", first="vessel", second="load", first_point=TOP, ratio=0.05)
    scene.add_immersed("load", parts=[SpherePart(diameter=DIAMETER, drag=0.0)], density=RHO)
    return scene


def test_channels_of_the_linear_model_under_water_are_those_of_a_run() -> None:
    """Waves load ship and sphere, and go straight into the sphere's acceleration."""
    criteria = (
        Criterion(channel="line_tension", names={"line": "wire"}, maximum=1e6),
        Criterion(channel="position", names={"body": "load", "axis": "x"}, maximum=1.0),
        Criterion(channel="point_acceleration", names={"point": "ball", "axis": "x"}, maximum=1.0),
    )
    scene = towed(6.0, hs=0.002)
    rest = equilibrium(scene)
    still = held(scene).copy(waves=scene.waves)
    linear = LinearSeas(still, rest, criteria)
    assert still.waves is not None
    start, told = linear.in_waves(still.waves, 0.0, 0.5 * np.arange(61))
    run = simulate(
        still, t_end=30.0, start=start, dt_out=0.5, rtol=1e-8, channels=[one.channel for one in criteria]
    )
    found = np.stack([run.curve(one.channel, **one.names) for one in criteria], axis=1)
    assert np.all(np.std(found - told, axis=0) < 0.02 * np.std(told, axis=0))


def test_waves_on_a_wire_in_water_are_in_the_linear_channels() -> None:
    """Of which one span goes through the surface."""
    criteria = (Criterion(channel="point_acceleration", names={"point": "ball", "axis": "x"}, maximum=1.0),)
    scene = towed(20.0, hs=0.002)
    del scene.loads["wire"]
    scene.add_line(
        "wire", "vessel", "load", first_point=TOP, second_point=(0.0, 0.0, 0.0), EA=2e7, length=39.98,
        rung="with mass", medium="sea", mass_per_length=60.0, diameter=0.2, segments=2,
        drag_coefficient=0.0, drag_coefficient_along=0.0, damping_ratio=0.05,
    )  # fmt: skip
    still = held(scene).copy(waves=scene.waves)
    linear = LinearSeas(still, equilibrium(scene), criteria)
    assert still.waves is not None
    start, told = linear.in_waves(still.waves, 0.0, 0.5 * np.arange(41))
    run = simulate(still, t_end=20.0, start=start, dt_out=0.5, rtol=1e-8, channels=["point_acceleration"])
    found = run.select("point_acceleration", point="ball", axis="x")
    assert np.std(found - told[:, 0]) < 1e-3 * np.std(told)


def test_a_part_that_crosses_the_surface_has_no_linear_route() -> None:
    criterion = Criterion(channel="line_tension", names={"line": "wire"}, maximum=1e6)
    with pytest.raises(SceneError, match=r"immersed part 'load\.1': crosses the surface at rest"):
        allowable_hs(towed(0.5), criteria=[criterion], tp=[8.0], direction_deg=[180.0], domain="frequency")


def test_the_sea_that_keeps_slings_taut_is_found_line_by_line() -> None:
    """A load half in the water beside a ship, by runs: a sling ends it before the wire does."""
    top = (0.0, 25.0, 12.0)
    scene = vessel()
    scene.add_body("block", mass=1e3, size=(0.5, 0.5, 0.5), position=(0.0, 25.0, 3.0))
    scene.add_line(
        "wire", bodies=["vessel", "block"], points=[top, (0.0, 0.0, 0.0)], EA=5e7, tension_at_start=MASS * G
    )
    scene.add_body("load", mass=MASS, size=(4.0, 3.0, 2.0), position=(0.0, 25.0, -3.0))
    corners = [(2.0, 1.5, 1.0), (2.0, -1.5, 1.0), (-2.0, 0.0, 1.0)]
    scene.add_bridle("sling", hook="block", load="load", points=corners, EA=2e7)
    scene.add_immersed("load", parts=[BoxPart(size=(4.0, 3.0, 2.0), fill=0.3)], wave_factor=1.1)
    lines = ["wire", "sling 1", "sling 2", "sling 3"]
    rules = [
        Criterion(channel="slack_margin", names={"weighed": line}, minimum=0.6, exposure=60.0)
        for line in lines
    ]
    table = allowable_hs(
        scene, criteria=rules, tp=7.0, direction_deg=150.0, hs=[1.0, 3.0, 5.0], seeds=[1, 2, 3],
        domain="time", start_up=10.0, duration=70.0, rtol=1e-3,
    ).dataset  # fmt: skip
    by_line = table["by_criterion"].values.ravel()
    assert np.all((by_line > 1.0) & (by_line < 5.0))
    assert float(table["allowable_hs"][0, 0]) == by_line[1:].min() < by_line[0]
