"""Lifts of ensembles, at the top level of a module so that other processes find them."""

from __future__ import annotations

import os
import time
from dataclasses import replace
from pathlib import Path

import named
import numpy as np

from seacrane import Curve, HydroDatabase, Kept, Result, Scene
from seacrane.ensembles.study import with_values
from seacrane.hydro import DriftCoefficients, shipped_database


def drifting_hull() -> HydroDatabase:
    """The shipped hull, with mean drift forces."""
    hull = shipped_database()
    mean = np.tile([-2e4, 3e4, 0.0, 0.0, 0.0, 1e5], (len(hull.heading), len(hull.omega), 1))
    drift = DriftCoefficients(heading=hull.heading, omega=hull.omega, coefficient=mean)
    return replace(hull, drift=drift)


HEAVE_STUDY = """format = "seacrane lift"
version = 2
vessel = { database = "hull_115", memory = "none" }
sea = { seed = 7, hs_m = 1.5, tp_s = 8, count = 20 }
run = { t_end_s = 2 }
[study]
over = { seed = { first = 1, count = 20 }, hs = [2.0, 1.0], bodies.vessel.mass = [1.1e7, 1e7] }
keep = [{ name = "heave", channel = "position", names = { body = "vessel", axis = "z" } }]
"""
SWING = {"t_end": 2.0, "rtol": 1e-6, "dt_out": 0.1}


def pendulum(*, mass: float = 2.0, start: float = 1.0) -> Scene:
    return named.pendulum(mass=mass, arm=start)


def luffed(*, turned: bool = False, behind: bool = False, driven: bool = False) -> Scene:
    """An arm on a hinge, held by a cylinder between ground and arm, with a load on a rod.

    The same joints close where the cylinder is turned by half about its line, and behind the dead centre.
    """
    scene = Scene(name="luffed")
    angle, foot = 0.8, np.array([1.0, 0.0, 0.0])
    tip = 1.5 * np.array([np.cos(angle), 0.0, np.sin(angle)])
    line = (tip - foot) / np.linalg.norm(tip - foot)
    down = np.array([0.0, 0.0, -0.7])
    places = {"arm": tip, "barrel": foot + 0.2 * line, "rod": tip - 0.2 * line, "load": tip + down}
    for name, place in places.items():
        scene.add_body(name=name, mass=5.0, inertia=(0.1, 0.2, 0.3), position=place)
    hinge = {"kind": "revolute", "name": "hinge", "first": "ground", "second": "arm"}
    scene.add_joint(**hinge, point=(0, 0, 0), axis=(0, 1, 0))
    cross = {"kind": "universal", "name": "cross", "first": "ground", "second": "barrel"}
    scene.add_joint(**cross, point=foot, axis=(0, 1, 0), second_axis=np.cross(line, (0, 1, 0)))
    scene.add_joint(
        "ram", kind="prismatic", first="barrel", second="rod", point=0.5 * (foot + tip), axis=line
    )
    scene.add_joint(kind="spherical", name="ball", first="rod", second="arm", point=tip)
    scene.add_joint(kind="revolute", name="eye", first="arm", second="load", point=tip, axis=(0, 1, 0))
    if driven:
        scene.add_driver(joint="ram", curve=Curve.harmonic(amplitude=0.02, omega=3.0, phase=0.5 * np.pi))
    leaning = float(np.arctan2(line[2], line[0]))
    half = {"arm": angle, "barrel": leaning, "rod": leaning}  # of the turn to behind
    moved = {}
    if behind:
        moved |= {f"bodies.{name}.position": scene.bodies[name].position * (1, 1, -1) for name in half}
        moved["bodies.load.position"] = tip * (1, 1, -1) + down
        moved |= {f"bodies.{name}.quaternion": (np.cos(a), 0.0, np.sin(a), 0.0) for name, a in half.items()}
    if turned:
        moved |= {f"bodies.{name}.quaternion": (0.0, *line) for name in ("barrel", "rod")}
    return with_values(scene, moved)


def lowest(result: Result) -> float:
    return float(result["position"][..., 2].min())


KEEP = {
    "track": Kept(channel="position", names={"body": "bob"}, interval=0.5),
    "highest": Kept(channel="position", what="maximum", names={"body": "bob", "axis": "z"}, after=1.0),
    "mean": Kept(channel="position", what="mean", names={"body": "bob"}),
    "scatter": Kept(channel="position", what="standard_deviation", names={"body": "bob", "axis": "x"}),
    "lowest": lowest,
}


def fails_in_the_middle(*, start: float) -> Scene:
    if start == 3.0:
        raise ValueError("no such start")
    return pendulum(start=start)


def dies_once(*, start: float, mark: str) -> Scene:
    """The process that describes member 3 ends at once, as long as the mark is not there."""
    child = os.environ.get("SEACRANE_TEST_PARENT") != str(os.getpid())
    if start == 3.0 and child and not Path(mark).exists():
        time.sleep(0.3)  # others come back first
        Path(mark).touch()
        os._exit(1)
    return pendulum(start=start)


def storm(*, seed: int, height: float = 1.0) -> Scene:
    """A pendulum whose speed at the start is drawn by the seed, so that its largest swing is Gumbel's."""
    random = np.random.default_rng(seed)
    scene = Scene(name="storm")
    push = 0.5 + 0.05 * height * float(random.gumbel())
    low = (0.0, 0.0, -1.0)
    scene.add_body("bob", mass=1.0, inertia=(0.1, 0.1, 0.1), position=low, velocity=(push, 0.0, 0.0))
    scene.add_joint("rail", kind="prismatic", first="ground", second="bob", point=low, axis=(1, 0, 0))
    return scene


def bad_storm(*, seed: int, height: float) -> Scene:
    if height > 1.0 or seed == 3:
        raise ValueError("no such storm")
    return storm(seed=seed, height=height)


def storm_that_parts(*, seed: int) -> Scene:
    """The largest 45 % of the seeds fail."""
    if np.random.default_rng(seed).gumbel() > 0.5:
        raise ValueError("the line parted")
    return storm(seed=seed)


def cart(*, seed: int, mass: float, kind: str = "prismatic", stiffness: float = 40.0) -> Scene:
    """A cart that a spring holds and a driver pulls by another; the seed is its speed at the start."""
    scene = Scene(name="cart")
    scene.add_body(name="tug", mass=2.0, size=(1.0, 1.0, 1.0))
    scene.add_joint("rail", kind="prismatic", first="ground", second="tug", axis=(1.0, 0.0, 0.0))
    scene.add_driver("rail", curve=0.0)
    scene.add_body("cart", mass=mass, size=(1, 1, 1), position=(3.0, 0, 0), velocity=(0.1 * seed, 0, 0))
    scene.add_joint("track", kind=kind, first="ground", second="cart", axis=(1.0, 0.0, 0.0))
    scene.add_spring("tow", first="tug", second="cart", stiffness=stiffness, damping=1.0, natural_length=3.0)
    return scene
