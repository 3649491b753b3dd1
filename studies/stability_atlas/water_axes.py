"""Axes of what is in water: how heavy it is, how it enters, what it holds, and lines that hang in it."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Scene, Stage, _core
from seacrane.accuracy.case import Case
from seacrane.hydro import BoxPart, Compartment, CylinderPart, Opening, PlatePart, two_barges
from stability_atlas.axis import Axis

WATER, SIDE, GRAVITY = 1025.0, 2.0, 9.80665  # kg/m3, m, m/s2
PLATE = 4.0  # m
TANK_AREA, TANK_HEIGHT = 4.0, 4.0  # m2, m


def _box(ratio: float, height: float = 0.0, speed: float = 0.0) -> Scene:
    """A box of that density over the water's, its middle at a height."""
    scene = Scene(name="box in water", gravity=GRAVITY)
    mass = ratio * WATER * SIDE**3
    scene.add_body(
        name="load", mass=mass, size=(SIDE, SIDE, SIDE), position=(0.0, 0.0, height),
        velocity=(0.0, 0.0, -speed),
    )  # fmt: skip
    scene.add_immersed("load", parts=[BoxPart(size=(SIDE, SIDE, SIDE), strips=(1, 1), fill=1.0)])
    return scene


def _density(ratio: float) -> Case:
    """It comes up or goes down from where it is half under."""
    return Case(scene=_box(ratio), t_end=3.0, dt_out=0.1)


def _entry(speed: float) -> Case:
    """A box twice as dense as water falls into it with a flat bottom."""
    return Case(scene=_box(2.0, height=1.2, speed=speed), t_end=1.0 + 0.2 / max(speed, 1.0), dt_out=0.05)


def _added_mass(ratio: float) -> Case:
    """A plate deep in the water on a spring, its mass that many times its added mass."""
    scene = Scene(name="plate in water", gravity=GRAVITY)
    added = 0.579 * 0.25 * np.pi * WATER * PLATE**3
    scene.add_body(name="load", mass=ratio * added, size=(PLATE, PLATE, 0.1), position=(0.0, 0.0, -20.0),
                   velocity=(0.0, 0.0, 0.3))  # fmt: skip
    scene.add_immersed("load", parts=[PlatePart(size=(PLATE, PLATE), thickness=0.01)])
    scene.add_spring(
        "rope", first="ground", second="load", first_point=(0.0, 0.0, 10.0), stiffness=4e6 * max(ratio, 1.0),
        natural_length=30.0,
    )  # fmt: skip
    return Case(scene=scene, t_end=5.0, dt_out=0.1)


def _tank(share: float, **openings: Any) -> Scene:
    """A tank on a line, half under, with that share of water inside."""
    scene = Scene(name="tank in water", gravity=GRAVITY)
    scene.add_body(name="tank", mass=2e4, size=(SIDE, SIDE, TANK_HEIGHT))
    scene.add_line(
        name="hoist", bodies=["ground", "tank"], points=[(0.0, 0.0, 30.0), (0.0, 0.0, 0.5 * TANK_HEIGHT)],
        EA=1e8, tension_at_start=2e5, damping_ratio=0.05,
    )  # fmt: skip
    up = ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0))
    shell = CylinderPart(length=TANK_HEIGHT, diameter=2.3, axes=up, strips=1)
    water = Compartment(
        name="inside", area=TANK_AREA, height=TANK_HEIGHT, point=(0.0, 0.0, -0.5 * TANK_HEIGHT),
        initial=share * TANK_AREA * TANK_HEIGHT, **openings,
    )  # fmt: skip
    scene.add_immersed("tank", parts=[shell], inside=water)
    return scene


def _holes(lid: float) -> list[Opening]:
    return [
        Opening(point=(0.0, 0.0, end * 0.5 * TANK_HEIGHT), area=area)
        for end, area in ((-1.0, 0.5), (1.0, lid))
    ]


def _filled(share: float) -> Case:
    """Vented by its lid."""
    return Case(scene=_tank(share, openings=_holes(0.5)), t_end=4.0, dt_out=0.1)


def _shut(share: float) -> Case:
    """Open below, its air shut in above."""
    openings = [Opening(point=(0.0, 0.0, -0.5 * TANK_HEIGHT), area=TANK_AREA)]
    return Case(scene=_tank(share, openings=openings, air="shut", exponent=1.2), t_end=4.0, dt_out=0.1)


def _vent(area: float) -> Case:
    """A third full, and vented by a hole of this area."""
    return Case(scene=_tank(0.3, openings=_holes(area)), t_end=4.0, dt_out=0.1)


def _lowered(rate: float) -> Case:
    """In stages: hangs, goes through the surface at this rate to about 3 m below, and is held there."""
    scene = Scene(name="lowered", gravity=GRAVITY)
    mass = 2.0 * WATER * SIDE**3
    scene.add_body(name="load", mass=mass, size=(SIDE, SIDE, SIDE), position=(0.0, 0.0, 1.5))
    scene.add_line(
        name="hoist", bodies=["ground", "load"], points=[(0.0, 0.0, 30.0), (0.0, 0.0, 1.0)], EA=1e8,
        tension_at_start=mass * GRAVITY, damping_ratio=0.05,
    )  # fmt: skip
    scene.add_winch(line="hoist", lag=0.1)
    scene.add_immersed("load", parts=[BoxPart(size=(SIDE, SIDE, SIDE), strips=(1, 1), fill=0.5)])
    scene.add_sea(vessel=None, hs=1.0, tp=7.0, direction_deg=0.0, gamma=3.3, seed=4, count=40)
    stages = (
        Stage(name="hang", duration=0.5),
        Stage(name="lower", duration=4.5 / rate, commands={"hoist.rate": rate}),
        Stage(name="hold", duration=1.0, commands={"hoist.rate": 0.0}),
    )
    return Case(scene=scene, t_end=1.5, dt_out=0.1, stages=stages)


def _heavy(segments: float, mass: float = 2e4, mass_per_length: float = 60.0) -> Case:
    """A load on a wire with mass of 300 m whose upper end heaves."""
    scene = Scene(name="heavy line", gravity=GRAVITY)
    scene.add_body(name="block", mass=100.0, inertia=(10.0, 10.0, 10.0))
    scene.add_joint(kind="prismatic", name="guide", first="ground", second="block", point=(0, 0, 0))
    scene.add_driver(joint="guide", curve=_core.Curve.harmonic(offset=-0.5, amplitude=0.5, omega=1.0))
    scene.add_body(name="load", mass=mass, inertia=(mass, mass, mass), position=(0.0, 0.0, -300.0))
    scene.add_line(
        name="hoist", bodies=["block", "load"], points=np.zeros((2, 3)), EA=3e8, length=299.9,
        wire={"mass_per_length": mass_per_length, "segments": int(segments)}, damping_ratio=0.02,
    )  # fmt: skip
    return Case(scene=scene, t_end=5.0, dt_out=0.25)


def _wire_over_load(ratio: float) -> Case:
    """The wire's mass over that of its load, with ten segments."""
    wire = 60.0 * 300.0
    return _heavy(10.0, mass=wire / ratio)


def _two_ships(hs: float) -> Case:
    """Two barges side by side in one water."""
    group = two_barges(lid_damping=0.03)
    scene = Scene(name="two barges", gravity=GRAVITY)
    scene.add_vessel(group)
    for number, vessel in enumerate(list(scene.vessels)):
        sea = {"hs": hs, "tp": max(8.0, 4.2 * np.sqrt(hs)), "direction_deg": 180.0, "gamma": 3.3, "seed": 1}
        scene.add_sea(vessel=vessel, **(sea if number == 0 else {}))
    return Case(scene=scene, t_end=20.0, dt_out=0.5)


AXES = (
    Axis(name="water-density", title="A box in water, its density", label="over that of water",
         values=(0.01, 0.1, 0.45, 0.9, 1.1, 2.0, 10.0, 100.0), quick=(0.01, 0.9, 100.0), case=_density),
    Axis(name="water-entry", title="A flat bottom that meets the water", label="speed [m/s]",
         values=(0.01, 0.1, 1.0, 3.0, 10.0, 30.0), quick=(0.01, 3.0, 30.0), case=_entry),
    Axis(name="water-added-mass", title="A plate in water, its mass", label="over its added mass",
         values=(1e-3, 0.01, 0.1, 1.0, 10.0, 1e3), quick=(1e-3, 1.0, 1e3), case=_added_mass),
    Axis(name="water-filled", title="A vented tank, its filling", label="share of its volume",
         values=(0.0, 1e-9, 0.3, 0.9999, 1.0), quick=(0.0, 0.3, 1.0), case=_filled),
    Axis(name="water-shut", title="A tank whose air is shut in, its filling", label="share of its volume",
         values=(0.0, 0.01, 0.5, 0.9, 0.99, 1.0), quick=(0.0, 0.5, 0.99), case=_shut),
    Axis(name="water-vent", title="A tank a third full, its vent", label="area [m2]",
         values=(1e-6, 1e-4, 0.01, 0.1, 1.0), quick=(1e-6, 0.1), case=_vent),
    Axis(name="water-lowered", title="In stages through the surface", label="rate of the winch [m/s]",
         values=(0.01, 0.1, 1.0, 5.0), quick=(0.1, 5.0), case=_lowered),
    Axis(name="line-segments", title="A wire with mass, its segments", label="segments",
         values=(1.0, 3.0, 10.0), quick=(1.0, 10.0), long=(40.0, 100.0, 400.0), case=_heavy),
    Axis(name="line-mass", title="A wire with mass, over the mass of its load", label="wire over load",
         values=(1e-3, 0.1, 1.0, 10.0, 1e3), quick=(1e-3, 1e3), case=_wire_over_load),
    Axis(name="two-ships", title="Two barges in one water", label="Hs [m]",
         values=(0.1, 2.0, 5.0, 10.0), quick=(5.0,), case=_two_ships),
)  # fmt: skip
