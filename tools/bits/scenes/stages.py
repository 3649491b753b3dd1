"""Lifts in stages: commands, conditions, connections and releases."""

from __future__ import annotations

import numpy as np

from bits.case import by, case
from bits.scenes.parts import UP, G, with_load
from seacrane import Curve, Frame, Move, Scene, Stage, Until, shipped_database
from seacrane.hydro import BoxPart

HOOK = {"bodies": ["ground", "load"], "points": [(0.0, 0.0, 21.0), (0.0, 0.0, 0.0)]}


def lift_off() -> list[Stage]:
    free, high = Until.release("on deck"), Until.length("hoist", maximum=19.7)
    return [
        Stage(name="hold", duration=0.5),
        Stage(name="lift off", until=free, maximum_duration=60.0, commands={"hoist.rate": -0.1}),
        Stage(name="raise", until=high, maximum_duration=60.0, commands={"hoist.rate": -0.4}),
        Stage(name="stop", duration=1.0, commands={"hoist.rate": 0.0}),
        Stage(name="let go", duration=0.5, release=["hoist"]),
    ]


@case(by("dopri5", "redundant"), by("rk4", "redundant", dt=0.01), stages=lift_off)
def off_a_seat() -> Scene:
    scene = with_load((0, 0, 1.0), mass=20e3)
    scene.add_joint(kind="weld", name="on deck", first="ground", second="load", point=(0, 0, 0))
    scene.add_stop(joint="on deck")
    scene.add_line(name="hoist", **HOOK, EA=5e7, length=20.1)
    scene.add_winch(line="hoist")
    return scene


def hoisting() -> list[Stage]:
    low = Until.channel("position", body="load", axis="z", maximum=1.2)
    return [
        Stage(name="raise", duration=1.0, commands={"hoist.rate": -0.4}),
        Stage(name="stop", duration=0.53, commands={"hoist.rate": 0.0}),
        Stage(name="lower", until=low, maximum_duration=9.0, commands={"hoist.rate": Move(to=0.5, over=1.0)}),
    ]


@case(by("dopri5"), by("cvode-bdf", "redundant"), stages=hoisting)
def swinging_on_a_winch() -> Scene:
    scene = with_load((3.0, 0.0, 1.07), mass=20e3, velocity=(0, 0.8, 0))
    scene.add_line(name="hoist", **HOOK, EA=5e7, length=20.1, damping_ratio=0.1)
    scene.add_winch(line="hoist")
    return scene


def meet() -> list[Stage]:
    return [Stage(name="fly", duration=0.5), Stage(name="coupled", duration=1.0, connect=["shackle"])]


@case(by("dopri5"), by("dop853", "redundant"), stages=meet)
def met_and_coupled() -> Scene:
    """Two bodies in space that are welded when they meet."""
    scene = Scene(name="meeting", gravity=0.0)
    scene.add_body(name="hook", mass=2.0, inertia=(0.5, 0.6, 0.7), velocity=(0.0, 0.3, 0.0))
    near = {"position": (1.0, 0.15, 0.3), "velocity": (0.0, 0.0, -0.6)}
    scene.add_body(name="load", mass=5.0, inertia=(1.5, 2.0, 2.5), **near)
    frames = {
        "first_frame": Frame(point=(0.4, 0, 0), axes=np.eye(3)),
        "second_frame": Frame(point=(-0.6, 0, 0), axes=np.eye(3)),
    }
    scene.add_joint(kind="weld", name="shackle", first="hook", second="load", **frames)
    return scene


def from_a_barge() -> list[Stage]:
    within = {"maximum_duration": 60.0}
    free, down = Until.release("on barge"), Until.contact("platform")
    slew = {"hoist.rate": -0.2, "slew": Move(to=0.1, over=2.5)}
    return [
        Stage(name="lift off", until=free, commands={"hoist.rate": -0.3}, **within),
        Stage(name="slew", duration=3.0, commands=slew),
        Stage(name="lower", until=down, connect=["above platform"], commands={"hoist.rate": 0.3}, **within),
        Stage(name="slacken", until=Until.tension("hoist", maximum=0.0), **within),
        Stage(name="let go", duration=0.5, release=["hoist"]),
    ]


@case(by("dopri5", rtol=1e-5), by("tsit5", rtol=1e-5), stages=from_a_barge, dt_out=0.1)
def from_a_barge_to_a_platform() -> Scene:
    scene = Scene(name="to a platform", gravity=G)
    jib, head = scene.add_crane(base="ground", s1=1.5, s2=1.0).tip
    for joint, name in (("A", "slew"), ("main_cylinder", "main"), ("knuckle_cylinder", "knuckle")):
        scene.add_driver(joint=joint, name=name, curve=Curve.constant(value=0.0))
    x, y, z = scene.place_of("tip")
    scene.add_body(name="barge", mass=1e6, inertia=(1e8,) * 3, position=(x, y, 0.0))
    scene.add_joint(kind="prismatic", name="heave", first="ground", second="barge", axis=UP)
    scene.add_driver(joint="heave", curve=Curve.harmonic(amplitude=0.1, omega=0.8))
    scene.add_body(name="load", mass=20e3, inertia=(5e4,) * 3, position=(x, y, 2.0))
    scene.add_joint(kind="weld", name="on barge", first="barge", second="load")
    scene.add_stop(joint="on barge")
    path = {"bodies": [jib, "load"], "points": [head, (0, 0, 0)]}
    scene.add_line(name="hoist", **path, EA=5e7, length=z - 2.0 + 0.05)
    scene.add_winch(line="hoist", maximum_acceleration=0.5, lag=0.2)
    scene.add_joint(kind="free", name="above platform", first="ground", second="load")
    scene.add_stop(joint="above platform", coordinate="z", minimum=0.3, name="platform")
    return scene


def lowered() -> list[Stage]:
    deep = Until.depth("load", minimum=1.5)
    return [
        Stage(name="above", duration=1.0),
        Stage(name="lower", until=deep, maximum_duration=90.0, commands={"hoist.rate": 0.6}),
        Stage(name="below", duration=1.0, commands={"hoist.rate": 0.0}, release=["tag"]),
    ]


@case(by("dopri5"), by("rk4", dt=0.01), stages=lowered, dt_out=0.1)
def through_the_surface() -> Scene:
    """From a given ship's crane into its sea, with heave compensation and a tagline."""
    scene = Scene(name="splash zone", gravity=G)
    scene.add_vessel(motion=shipped_database(), duration=120.0)
    scene.add_sea(hs=1.5, tp=6.0, direction_deg=165.0, seed=1, count=50)
    jib, head = scene.add_crane(slew=-np.pi / 2.0, s1=1.0, s2=2.0).tip
    scene.add_hoist(mass=40e3, size=(6, 4, 3), height=0.5, EA=3e8, block_mass=1.5e3, winch={"lag": 0.2})
    scene.add_heave_compensation("active", body=jib, point=head, winch="hoist", lag=0.1, high_pass=0.02)
    scene.add_immersed("load", parts=[BoxPart(size=(6, 4, 3), fill=0.2, perforation=0.3, slam=5.0)])
    x, y, _ = scene.place_of("load")
    tag = {"bodies": ["ground", "load"], "points": [(x + 30.0, y, 6.0), (3.0, 0, 0)]}
    scene.add_line(name="tag", **tag, EA=2e5, tension_at_start=2e3)
    return scene
