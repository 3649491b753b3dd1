"""Lifts with contact: landing, guides, fenders, stages, rest on a deck, and what is said of their hits."""

from __future__ import annotations

import numpy as np
import pytest
from contact_scenes import GRAVITY

from seacrane import Curve, Scene, Stage, Until, equilibrium, shipped_database, simulate, simulate_stages
from seacrane.answers import contact_hits

MASS, EA = 40e3, 2.0e8


def hung(height: float, *, short: float = 0.0, rate: float = 0.0) -> Scene:
    """A load on a wire, its feet `height` over the ground, one of them shorter, lowered from 2 s on."""
    scene = Scene(name="landing", gravity=GRAVITY)
    scene.add_body(name="load", mass=MASS, size=(4.0, 3.0, 2.0), position=(0.0, 0.0, height + 1.0))
    points = [(-2.0, -1.5, -1.0), (2.0, -1.5, -1.0), (2.0, 1.5, -1.0 + short), (-2.0, 1.5, -1.0)]
    scene.add_contact("load", on="ground", points=points, friction=0.3, name="feet")
    scene.add_line(name="wire", first="ground", second="load", first_point=(0.0, 0.0, height + 25.0),
                   second_point=(0.0, 0.0, 1.0), EA=EA, tension_at_start=MASS * GRAVITY)  # fmt: skip
    scene.add_winch(line="wire", rate=Curve.quintic(start_time=1.0, end_time=2.0, start=0.0, end=rate))
    return scene


def test_four_feet_of_unequal_height_land_and_their_hits_are_told() -> None:
    result = simulate(hung(0.5, short=0.05, rate=0.4), t_end=12.0, dt_out=0.002)
    hits = contact_hits(result, "feet")
    first = {hit.point: hit for hit in hits if hit.number == 1}
    assert set(first) == {f"feet.{i}" for i in range(1, 5)}
    assert first["feet.3"].begin > max(first[f"feet.{i}"].begin for i in (1, 2, 4))
    assert max(hit.number for hit in hits) > 1  # it rocks: some feet hit again
    for i in (1, 2, 4):
        assert first[f"feet.{i}"].speed == pytest.approx(0.4, rel=0.05)
    for i in (2, 4):  # those beside the short one carry the load
        assert first[f"feet.{i}"].peak == pytest.approx(first[f"feet.{i}"].undamped, rel=0.15)
    press = np.asarray(result["contact_press"])
    total = sum(hit.impulse for hit in hits)
    assert total == pytest.approx(float(np.trapezoid(press.sum(axis=1), result.time)), rel=1e-3)
    # the ground's and the wire's impulse against that of weight is the change of momentum, none at both ends
    tension = np.asarray(result.select("line_tension", line="wire"))
    given = total + float(np.trapezoid(tension, result.time))
    assert given == pytest.approx(MASS * GRAVITY * 12.0, rel=1e-3)
    assert np.asarray(result["contact_press"])[-1].sum() == pytest.approx(MASS * GRAVITY, rel=1e-3)


def test_a_fender_gives_by_its_table() -> None:
    scene = Scene(name="fender", gravity=GRAVITY)
    weight = 1000.0 * GRAVITY
    scene.add_body(name="load", mass=1000.0, inertia=(1e3,) * 3, position=(0.0, 0.0, 0.0))
    table = [(0.0, 0.0), (0.1, 0.5 * weight), (0.2, 2.0 * weight)]
    scene.add_contact("load", on="ground", points=[(0.0, 0.0, 0.0)], table=table, damping=2.0)
    result = simulate(scene, t_end=20.0, dt_out=0.05)
    assert float(result["contact_gap"][-1, 0]) == pytest.approx(-(0.1 + 0.5 / 15.0), abs=1e-4)
    deepest = -float(result["contact_gap"].min())
    assert np.abs(result["energy_balance"]).max() < 1e-6 * weight * deepest


def test_stages_end_on_contact_and_when_all_feet_are_clear() -> None:
    stages = [
        Stage(name="without", duration=1.0),
        Stage(
            name="lower", connect=["feet"], until=Until.contact("feet"), maximum_duration=20.0,
            commands={"wire.rate": 0.2},
        ),
        Stage(name="slack", duration=2.0, commands={"wire.rate": 0.0}),
        Stage(name="lift", until=Until.release("feet"), maximum_duration=20.0, commands={"wire.rate": -0.1}),
        Stage(name="raise", until=Until.clear("feet", minimum=0.5), maximum_duration=20.0),
    ]  # fmt: skip
    result = simulate_stages(hung(0.5), stages)
    gap = np.asarray(result["contact_least_gap"])[:, 0]
    spans = {span.name: span for span in result.stages}
    for name, level in (("lower", 0.0), ("lift", 0.0), ("raise", 0.5)):
        assert np.interp(spans[name].end, result.time, gap) == pytest.approx(level, abs=1e-6)


def test_a_load_rests_on_the_deck_of_a_ship() -> None:
    scene = Scene(name="on deck")
    scene.add_vessel(shipped_database())
    (hull,) = scene.vessels
    scene.add_body(name="load", mass=50e3, size=(4, 3, 2), position=(10.0, 0.0, 9.0))
    deck = np.array([10.0, 0.0, 8.0]) - scene.place_of(hull)
    feet = [(x, y, -1.0) for x in (-2.0, 2.0) for y in (-1.5, 1.5)]
    scene.add_contact("load", on=hull, points=feet, place=deck, friction=0.3, name="feet")
    rest = equilibrium(scene)
    assert rest.load_states["feet.1.anchor_x"] == pytest.approx(-2.0, abs=1e-3)
    still = simulate(scene, t_end=20.0, start="rest", dt_out=1.0)
    moved = np.asarray(still.select("position", body="load"))
    assert np.abs(moved - moved[0]).max() < 1e-6
    assert not still.events
    press = np.asarray(still["contact_press"])
    assert press.sum(axis=1) == pytest.approx(50e3 * scene.gravity, rel=1e-3)
