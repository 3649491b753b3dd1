"""Scenes of contact whose motion is known: a ball on a wall, blocks on plates and decks, loads on feet."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Curve, Scene
from seacrane.description.curves import spline_curve

GRAVITY = 9.80665
MASS, STIFFNESS = 2000.0, 8.0e6
FEET = np.array([(x, y, 0.0) for x in (-1.0, 1.0) for y in (-1.0, 1.0)])  # as high as the centre: no tipping
# d v, restitution, deepest compression over v sqrt(m / k): Hunt and Crossley's law in closed form
REBOUNDS = ((0.05, 0.96773858, 0.98380316), (0.1, 0.93747558, 0.96848544), (0.2, 0.88218999, 0.94017135),
            (0.5, 0.74843493, 0.86964311), (1.0, 0.59362426, 0.78339367),
            (2.0, 0.41071969, 0.67133736))  # fmt: skip


def ball(speed: float, damping: float, **contact: Any) -> Scene:
    """A ball that flies against the ground, without gravity, 0.1 m before it."""
    scene = Scene(name="ball", gravity=0.0)
    scene.add_body(name="ball", mass=MASS, inertia=(1.0e3,) * 3, position=(0, 0, 0.1),
                   velocity=(0, 0, -speed))  # fmt: skip
    scene.add_contact("ball", points=[(0.0, 0.0, 0.0)], on="ground", stiffness=STIFFNESS, damping=damping,
                      name="wall", **contact)  # fmt: skip
    return scene


def block(
    scene: Scene, on: str, *, friction: float, hold: float, top: float = 0.0, size: float = 1.0,
    stiffness: float = STIFFNESS, **more: Any
) -> Scene:  # fmt: skip
    """A block on feet that stands where its weight is in balance, on a plane of `on`."""
    sunk = MASS * GRAVITY / (len(FEET) * stiffness)
    body = {"position": (0.0, 0.0, top - sunk)} | more
    scene.add_body(name="block", mass=MASS, inertia=(1.0e3 * size**2,) * 3, **body)
    scene.add_contact("block", points=size * FEET, on=on, place=(0.0, 0.0, top), stiffness=stiffness,
                      friction=friction, hold=hold, name="feet")  # fmt: skip
    return scene


def shaken(*, friction: float = 0.3, hold: float = 1e-4, omega: float = np.pi) -> Scene:
    """A block on a plate that moves by 1 m sin(omega t), at the speed that it keeps on it."""
    scene = Scene(name="shaken plate", gravity=GRAVITY)
    scene.add_body(name="plate", mass=500.0, inertia=(1.0e3,) * 3, velocity=(omega, 0.0, 0.0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="plate", axis=(1.0, 0.0, 0.0))
    curve = Curve.harmonic(amplitude=1.0, omega=omega, phase=-0.5 * np.pi)
    scene.add_driver(joint="rail", curve=curve)
    fastest = 0.5 * np.pi * friction * GRAVITY / omega  # of the block, when the plate has just its speed
    start = fastest - friction * GRAVITY * np.arccos(fastest / omega) / omega
    return block(scene, "plate", friction=friction, hold=hold, velocity=(start, 0.0, 0.0))


def slope(angle_deg: float, *, friction: float = 0.3, hold: float = 1e-3) -> Scene:
    """A block at rest on a slope of the ground that falls along x."""
    angle = np.radians(angle_deg)
    scene = Scene(name="slope", gravity=GRAVITY)
    normal = np.array([np.sin(angle), 0.0, np.cos(angle)])
    sunk = MASS * GRAVITY * np.cos(angle) / (len(FEET) * STIFFNESS)
    half = 0.5 * angle
    scene.add_body(name="block", mass=MASS, inertia=(1.0e3,) * 3, position=-sunk * normal,
                   quaternion=(np.cos(half), 0.0, np.sin(half), 0.0))  # fmt: skip
    scene.add_contact("block", points=FEET, on="ground", axis=normal, stiffness=STIFFNESS, friction=friction,
                      hold=hold, name="feet")  # fmt: skip
    return scene


def rolling(roll_deg: float, *, friction: float = 0.3, hold: float = 1e-4, periods: int = 6) -> Scene:
    """A block with its centre 5 m above the axis of a deck that rolls with 8 s, from rest on."""
    scene = Scene(name="rolling deck", gravity=GRAVITY)
    scene.add_body(name="deck", mass=1.0e5, inertia=(1.0e6,) * 3)
    scene.add_joint(kind="revolute", name="roll", first="ground", second="deck", axis=(1.0, 0.0, 0.0))
    time = np.linspace(0.0, 8.0 * periods, 160 * periods + 1)
    x = np.clip(time / (8.0 * (periods - 1)), 0.0, 1.0)
    angle = np.radians(roll_deg) * x**3 * (10.0 - 15.0 * x + 6.0 * x * x) * np.sin(2.0 * np.pi / 8.0 * time)
    scene.add_driver(joint="roll", curve=spline_curve(times=time, values=angle))
    sunk = MASS * GRAVITY / (len(FEET) * STIFFNESS)
    # small, so that its own turning takes nothing from some feet
    return block(scene, "deck", friction=friction, hold=hold, top=5.0 + sunk, size=0.1)


def spun() -> Scene:
    """A spinning ball that meets another one beside its middle, in free space."""
    scene = Scene(name="two balls", gravity=0.0)
    for name, mass, x, velocity, spin in (
        ("first", 900.0, 0.0, (0.0, 0.3, 0.0), (0.0, 0.0, 0.4)),
        ("second", 400.0, 2.2, (-3.0, 0.1, 0.2), (1.0, -0.5, 2.0)),
    ):
        scene.add_body(name=name, mass=mass, inertia=(0.4 * mass,) * 3, position=(x, 0.3 * x, 0.0),
                       velocity=velocity, angular_velocity=spin)  # fmt: skip
    scene.add_contact("second", points=[(-0.8, -0.1, 0.05)], on="first", surface="box", size=(1.6, 1.6, 1.6),
                      edge=0.3, stiffness=1e6, damping=0.2, friction=0.4, name="touch")  # fmt: skip
    return scene


def thrown() -> Scene:
    """A load that is thrown onto a deck, heeled: its feet land one after the other, slide and stick."""
    scene = Scene(name="thrown", gravity=GRAVITY)
    scene.add_body(name="load", mass=MASS, inertia=(1.2e3, 1.4e3, 1.6e3), position=(0.0, 0.0, 1.2),
                   quaternion=(np.cos(0.06), np.sin(0.06), 0.0, 0.0), velocity=(1.5, 0.5, 0.0))  # fmt: skip
    scene.add_contact("load", points=FEET - (0.0, 0.0, 0.6), on="ground", stiffness=1e6, damping=1.0,
                      friction=0.4, name="feet")  # fmt: skip
    return scene


def lifted(heave: float, omega: float, stretch: float, rate: float, stiffness: float) -> Scene:
    """A load on a barge that heaves by a sine, under a spring whose upper end rises at a steady rate."""
    scene = Scene(name="lifted", gravity=GRAVITY)
    scene.add_body(name="barge", mass=1e6, inertia=(1e6,) * 3, velocity=(0.0, 0.0, heave * omega))
    scene.add_joint(kind="prismatic", name="heave", first="ground", second="barge", axis=(0.0, 0.0, 1.0))
    scene.add_driver(joint="heave", curve=Curve.harmonic(amplitude=heave, omega=omega, phase=-0.5 * np.pi))
    block(scene, "barge", friction=0.3, hold=1e-3, stiffness=stiffness, velocity=(0.0, 0.0, heave * omega))
    scene.add_body(
        name="tip", mass=100.0, inertia=(1.0,) * 3, position=(0.0, 0.0, 10.0), velocity=(0, 0, rate)
    )
    scene.add_joint(kind="prismatic", name="hoist", first="ground", second="tip", axis=(0.0, 0.0, 1.0))
    scene.add_driver(joint="hoist", curve=Curve.table([0.0, 100.0], [0.0, 100.0 * rate]))
    slack = 10.0 + MASS * GRAVITY / (len(FEET) * stiffness)
    scene.add_spring(name="wire", first="block", second="tip", lengths=[0.0, slack, slack + 10.0],
                     forces=[0.0, 0.0, 10.0 * stretch])  # fmt: skip
    return scene
