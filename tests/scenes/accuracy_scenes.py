"""Random lifts with bounds, winches that reach their minimum length, bursts and several lines.

And judges of what `simulate(accuracy=...)` promises on them.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
from heave_scenes import heaving
from kink_scenes import random_kinked

from seacrane import Curve, Scene, SeacraneError, simulate
from seacrane import scene as of
from seacrane.accuracy.quantities import compare
from seacrane.arrays import Array

G = 9.80665
OTHERS = ("dop853", "verner65", "verner76", "tsit5")  # judges, the first two that the run did not take
AGREED = 0.1  # of what was promised, between both judges
T_END, DT_OUT = 8.0, 0.1  # s
ENDS = ("held", "beyond", "refused", "not judgeable")  # refused by name; not judgeable: judges differ


def move(rng: np.random.Generator, *, end: float, start: float = 0.0) -> Curve:
    """A quintic from one value to another within a few seconds."""
    begin = float(rng.uniform(0.2, 1.0))
    return Curve.quintic(start_time=begin, end_time=begin + rng.uniform(0.3, 4.0), start=start, end=end)


def hung(rng: np.random.Generator, *, drop: float = 0.0) -> tuple[Scene, float, Array]:
    """A load that swings a little below a fixed block; its mass and the place."""
    scene = Scene(name="hoist")
    mass, depth = float(10.0 ** rng.uniform(2.5, 4.3)), float(rng.uniform(4.0, 15.0))
    angle, turn = rng.uniform(0.0, 0.15), rng.uniform(0.0, 2.0 * np.pi)
    place = depth * np.array([np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), -np.cos(angle)])
    scene.add_body("load", mass=mass, inertia=(0.5 * mass,) * 3, position=place + np.array([0.0, 0.0, drop]),
                   velocity=(*rng.normal(0.0, 0.2, 2), 0.0))  # fmt: skip
    return scene, mass, place


def winched(rng: np.random.Generator) -> Scene:
    """Hauled in, in two of three scenes to the minimum length; with or without lag, bounds and a tugger."""
    scene, mass, place = hung(rng)
    falls = int(rng.integers(1, 3))
    scene.add_line(
        name="hoist", bodies=(["ground", "load"] * falls)[: falls + 1],
        points=np.zeros((falls + 1, 3)), EA=float(mass * G * 10.0 ** rng.uniform(1.3, 2.8)),
        tension_at_start=mass * G / falls, damping_ratio=float(rng.choice([0.0, 0.02, 0.1])),
    )  # fmt: skip
    length = falls * float(np.linalg.norm(place))
    speed = float(rng.uniform(0.1, 0.8)) * falls
    rate: Curve | float = -speed if rng.random() < 0.3 else move(rng, end=-speed)
    options = {"rate": rate}
    if rng.random() < 0.65:
        options["minimum_length"] = 0.94 * length - min(speed * float(rng.uniform(0.5, 4.0)), 0.7 * length)
    if rng.random() < 0.6:
        options["lag"] = float(rng.choice([0.05, 0.2, 0.5]))
        if rng.random() < 0.6:
            options["maximum_acceleration"] = float(rng.uniform(0.2, 2.0))
    if rng.random() < 0.5:
        options["maximum_rate"] = speed * float(rng.uniform(0.4, 1.2))
    scene.add_winch("hoist", **options)
    if rng.random() < 0.4:
        add_tugger(rng, scene, mass, place)
    return scene


def add_tugger(rng: np.random.Generator, scene: Scene, mass: float, place: Array) -> None:
    """From the side, by its length or on a winch that holds a tension; it may go slack."""
    away = np.array([rng.uniform(6.0, 12.0), rng.uniform(-3.0, 3.0), place[2] + rng.uniform(-1.0, 1.0)])
    length = float(np.linalg.norm(away - place)) * float(rng.uniform(0.99, 1.005))
    scene.add_line(name="tugger", bodies=["ground", "load"], points=[away, (0.0, 0.0, 0.0)],
                   EA=float(mass * G * rng.uniform(1.0, 10.0)), length=length, damping_ratio=0.1)  # fmt: skip
    if rng.random() < 0.5:
        tension = 0.05 * mass * G
        scene.add_winch("tugger", tension=tension, tension_gain=float(rng.uniform(0.1, 0.5)) / tension,
                        dead_band=float(rng.choice([0.0, 0.1])) * tension,
                        maximum_rate=float(rng.uniform(0.2, 1.0)), lag=0.2,
                        minimum_length=0.5 * length)  # fmt: skip


def shared(rng: np.random.Generator) -> Scene:
    """A load on two or three lines from blocks apart, or on one with a smaller load below it."""
    scene = Scene(name="shared")
    mass, depth = float(10.0 ** rng.uniform(2.5, 4.3)), float(rng.uniform(4.0, 10.0))
    scene.add_body("load", mass=mass, inertia=(0.5 * mass,) * 3, position=(0.0, 0.0, -depth),
                   velocity=rng.normal(0.0, 0.3, 3), angular_velocity=rng.normal(0.0, 0.1, 3))  # fmt: skip
    count = int(rng.integers(1, 4))
    stiffness = float(mass * G * 10.0 ** rng.uniform(1.3, 2.5))
    for i in range(count):
        turn = 2.0 * np.pi * i / count
        side = 0.0 if count == 1 else 1.0
        block = side * np.array([2.5 * np.cos(turn), 2.5 * np.sin(turn), 0.0])
        eye = side * np.array([0.6 * np.cos(turn), 0.6 * np.sin(turn), 0.3])
        reach = float(np.linalg.norm(block - eye - [0.0, 0.0, -depth]))
        changing = Curve.harmonic(start_time=0.0, offset=reach * rng.uniform(0.985, 1.003),
                                  amplitude=rng.uniform(0.0, 0.1), omega=rng.uniform(0.5, 2.0))  # fmt: skip
        scene.add_line(name=f"line {i}", bodies=["ground", "load"], points=[block, eye], EA=stiffness,
                       length=changing, damping_ratio=float(rng.choice([0.02, 0.1])))  # fmt: skip
    if count == 1:
        small = mass * float(rng.uniform(0.1, 0.5))
        scene.add_body("below", mass=small, inertia=(0.5 * small,) * 3, position=(0.3, 0.0, -depth - 3.0))
        scene.add_line("pendant", "load", "below", EA=0.3 * stiffness,
                       tension_at_start=small * G * float(rng.uniform(0.3, 1.0)),
                       damping_ratio=0.05)  # fmt: skip
    return scene


def snatched(rng: np.random.Generator) -> Scene:
    """A load that falls some centimetres into its slack line, on a guide or free to swing."""
    scene, mass, place = hung(rng, drop=float(rng.uniform(0.005, 0.3)))
    if rng.random() < 0.5:
        guide = {"kind": "planar", "first": "ground", "second": "load"}
        scene.add_joint("guide", point=(0, 0, 0), axis=(0, 1, 0), **guide)
    stiffness, length = float(mass * G * 10.0 ** rng.uniform(1.0, 2.3)), float(np.linalg.norm(place))
    scene.add_line("hoist", "ground", "load", EA=stiffness, length=length,
                   damping_ratio=float(rng.uniform(0.02, 0.3)))  # fmt: skip
    return scene


def compensated(rng: np.random.Generator) -> Scene:
    """A heaving block whose winch compensates within bounds on rate and stroke."""
    omega, amplitude = float(rng.uniform(0.5, 1.2)), float(rng.uniform(0.3, 1.5))
    scene = heaving(amplitude=amplitude, omega=omega)
    mass = float(10.0 ** rng.uniform(3.0, 4.3))
    scene.add_body("load", mass=mass, inertia=(0.5 * mass,) * 3, position=(0, 0, 5))
    scene.add_line("hoist", "ship", "load", first_point=(0, 0, 20),
                   EA=float(mass * G * 10.0 ** rng.uniform(1.5, 3.0)), tension_at_start=mass * G,
                   damping_ratio=0.05)  # fmt: skip
    scene.add_winch("hoist", lag=float(rng.choice([0.0, 0.1])))
    bounds = {}
    if rng.random() < 0.5:
        bounds["maximum_rate"] = amplitude * omega * float(rng.uniform(0.3, 1.1))
    if rng.random() < 0.5:
        bounds["maximum_stroke"] = amplitude * float(rng.uniform(0.4, 1.1))
    scene.add_heave_compensation("ahc", body="ship", point=(0, 0, 20), winch="hoist", high_pass=0.0,
                                 drive=of.Drive(**bounds))  # fmt: skip
    return scene


def on_oil(rng: np.random.Generator) -> Scene:
    """A load on a vertical cylinder that is moved, and whose hose may burst."""
    scene = Scene(name="on oil")
    area, stroke = float(10.0 ** rng.uniform(-2.3, -1.5)), float(rng.uniform(0.6, 1.5))
    mass, standing = area * float(rng.uniform(4e6, 1.2e7)) / G, float(rng.uniform(0.3, 0.7)) * stroke
    scene.add_body("load", mass=mass, inertia=(mass,) * 3, position=(0.0, 0.0, 1.0 + standing))
    scene.add_joint("guide", kind="prismatic", first="ground", second="load", axis=(0, 0, 1), point=(0, 0, 0))
    speed = float(rng.uniform(0.05, 0.3))
    piston = of.Piston(viscous_friction=mass * float(10.0 ** rng.uniform(-0.3, 1.0)))
    lag, air = float(rng.choice([0.0, 5e-3, 0.05])), float(rng.choice([0.0, 0.002, 0.01]))
    makeup = area * float(rng.uniform(0.1, 1.0)) if rng.random() < 0.6 else 0.0
    valve = of.Valve(rated_flow=area * speed, rated_drop=1e6, spool_lag=lag)
    oil: dict[str, Any] = {"piston": piston, "oil": of.Oil(air=air), "valve": valve,
                           "pump": of.Pump(pressure=25e6, makeup_flow=makeup)}  # fmt: skip
    if rng.random() < 0.3:
        oil["relief"] = of.Relief(pressure=1.3 * mass * G / area + 4e6, flow=area * speed)
    if rng.random() < 0.3:
        gas = {"volume": area * stroke * 0.3, "pressure": 0.5 * mass * G / area}
        oil["accumulator"] = of.Accumulator(**gas, flow=area * speed)
    if rng.random() < 0.65:
        hole = area * float(10.0 ** rng.uniform(-2.7, -1.2))
        oil["rupture"] = of.Rupture(time=float(rng.uniform(0.5, 3.0)), area=hole)
        if rng.random() < 0.3:
            oil["counterbalance"] = of.Counterbalance(pressure=1.5 * mass * G / area + 5e6, flow=area * speed)
    if rng.random() < 0.5:
        oil["command"] = move(rng, end=float(rng.uniform(-1.0, 1.0)))
    else:
        goal = float(rng.uniform(0.2, 0.8)) * stroke
        oil |= {"valve": replace(valve, gain=float(rng.uniform(1.0, 5.0))),
                "reference": move(rng, start=standing, end=goal)}  # fmt: skip
    scene.add_hydraulic_cylinder("ram", first="ground", second="load", full_area=area,
                                 rod_side_area=area * rng.uniform(0.5, 0.9), retracted_length=1.0,
                                 stroke=stroke, **oil)  # fmt: skip
    return scene


KINDS: tuple[Callable[[np.random.Generator], Scene], ...] = (
    winched, winched, shared, snatched, compensated, on_oil, on_oil, on_oil, random_kinked, random_kinked,
)  # fmt: skip


def said(**about: Any) -> SimpleNamespace:
    """What was asked of a scene, promised and found; `end` is one of ENDS."""
    return SimpleNamespace(**{"told": 0.0, "error": 0.0, "why": ""} | about)


def scene_of(number: int, *, seed: int) -> tuple[Scene, float]:
    """A scene, and the part of its motion that is asked for."""
    rng = np.random.default_rng([seed, number])
    scene = KINDS[number % len(KINDS)](rng)
    return scene, float(10.0 ** rng.uniform(-4.5, -2.0))


def word(number: int, *, seed: int) -> SimpleNamespace:
    """What `accuracy=` promises on one scene, judged by two other methods at tighter tolerances."""
    scene, part = scene_of(number, seed=seed)
    span = {"t_end": T_END, "dt_out": DT_OUT, "channels": ["position"]}
    with warnings.catch_warnings(action="ignore"):
        rough = position(scene, integrator="verner76", rtol=1e-6, **span)
        limit = part * max(float(np.abs(rough - rough[0]).max()), 0.01)
        try:
            result = simulate(scene, accuracy={"position": limit}, **span)
        except SeacraneError as refused:
            return said(number=number, scene=scene.name, end="refused", limit=limit, why=str(refused))
        method, told = str(result.stats["integrator"]), float(result.stats["error_estimate_position"])
        found = np.asarray(result["position"])
        judges = judged(scene, method, result.settings["rtol"], span)
    known = {"number": number, "scene": scene.name, "limit": limit, "told": told, "integrator": method}
    if isinstance(judges, str):
        return said(**known, end="not judgeable", why=judges)
    one, other = judges
    apart = compare(one, other).largest
    if apart > AGREED * limit:
        return said(**known, end="not judgeable", why=f"judges are {apart:.3g} m apart")
    error = compare(other, found).largest
    return said(**known, end="held" if error <= limit else "beyond", error=error)


def judged(scene: Scene, method: str, rtol: float, span: dict[str, Any]) -> tuple[Array, Array] | str:
    """Positions by two other methods, 10 and 100 times tighter; or why there are none."""
    first, second = [name for name in OTHERS if name != method][:2]
    try:
        one = position(scene, integrator=first, rtol=min(0.1 * rtol, 1e-7), **span)
        return one, position(scene, integrator=second, rtol=min(0.01 * rtol, 1e-8), **span)
    except SeacraneError as error:
        return str(error)


def position(scene: Scene, **settings: Any) -> Array:
    return np.asarray(simulate(scene, **settings)["position"])


def told(words: Sequence[SimpleNamespace]) -> str:
    """Counts, and every scene that did not hold."""
    ends = {end: sum(one.end == end for one in words) for end in ENDS}
    low = sum(one.error > one.told for one in words if one.end in ("held", "beyond"))
    lines = [f"{len(words)} scenes: {ends}, {low} above their estimate"]
    return "\n".join(lines + [f"  {vars(one)}" for one in words if one.end != "held"])
