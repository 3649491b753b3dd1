"""Loads on elastic lines and winches, with the numbers of their closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Curve, Scene

G = 9.80665
MASS, STIFFNESS = 20e3, 3e6  # kg, N/m: of the load and of the line at its start


def hung(*, length: float = 10.0, damping: float = 0.0, stretch: float = MASS * G / STIFFNESS, falls: int = 1,
         **load: Any) -> Scene:  # fmt: skip
    """A load below a fixed block, stretched by its own weight; `length` is that of one fall, unstretched."""
    scene = Scene(name="hung")
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0.0, 0.0, -length - stretch),
                   **load)  # fmt: skip
    blocks = ["ground", "load"] * falls
    scene.add_line(name="hoist", bodies=blocks[: falls + 1], points=np.zeros((falls + 1, 3)),
                   EA=STIFFNESS * length / falls, length=falls * length, damping_ratio=damping,
                   mass=MASS / falls**2)  # fmt: skip
    return scene


def swinging(**winch: Any) -> Scene:
    """A load that swings below a block on a winch."""
    scene = Scene(name="swinging")
    scene.add_body(name="load", mass=2e3, inertia=(300.0, 400.0, 500.0), position=(3.0, 0.5, -8.0),
                   velocity=(0.0, 0.8, 0.0), angular_velocity=(0.1, 0.2, 0.3))  # fmt: skip
    scene.add_line(name="hoist", bodies=["ground", "load"], points=[(0, 0, 0), (0.1, -0.2, 0.9)], EA=4e6,
                   length=7.65)  # fmt: skip
    pay_out = Curve.quintic(start_time=0.3, end_time=2.0, start=0.0, end=0.6)
    scene.add_winch(line="hoist", **{"rate": pay_out, "lag": 0.2} | winch)
    return scene


def on_deck() -> Scene:
    """A load that a winch lifts off its seat."""
    scene = Scene(name="on deck")
    scene.add_body(name="load", mass=2e3, inertia=(300.0, 300.0, 300.0))
    scene.add_joint(kind="prismatic", name="guide", first="ground", second="load", point=(0, 0, 0),
                    axis=(0, 0, 1))  # fmt: skip
    scene.add_stop(joint="guide", minimum=0.0)
    scene.add_line(name="hoist", bodies=["ground", "load"], points=[(0, 0, 10), (0, 0, 0)], EA=2e6,
                   length=10.05)  # fmt: skip
    scene.add_winch(line="hoist", rate=-0.2, lag=0.2)
    return scene


SWINGING_WINCH: dict[str, Any] = {
    "rate": Curve.harmonic(start_time=0.0, offset=0.0, amplitude=0.5, omega=2.1), "maximum_rate": 0.4,
    "maximum_acceleration": 0.6, "lag": 0.15,
}  # fmt: skip


def on_arm(load: tuple[float, float, float]) -> Scene:
    """A swinging arm that carries a block, and a load at a place."""
    scene = Scene(name="on arm")
    scene.add_body(name="arm", mass=800.0, inertia=(50.0, 900.0, 900.0), position=(2.0, 0.0, 0.0))
    scene.add_joint(kind="revolute", name="pin", first="ground", second="arm", point=(0, 0, 0),
                    axis=(0, 1, 0))  # fmt: skip
    scene.add_actuator(joint="pin", stiffness=4e6, damping=3e5)
    scene.add_body(name="cleat", mass=50.0, inertia=(5.0, 5.0, 5.0), position=(3.5, 0.0, 0.2))
    scene.add_joint(kind="weld", name="bolts", first="arm", second="cleat", point=(3.5, 0, 0))
    scene.add_body(name="load", mass=1500.0, inertia=(200.0, 250.0, 300.0), position=load)
    return scene


def reeved() -> Scene:
    """A tackle of two falls below the arm's block, and a tugger on a third body."""
    scene = on_arm((4.2, 0.1, -5.0))
    scene.add_line(name="hoist", bodies=["ground", "cleat", "load", "cleat"],
                   points=[(0.0, 0.0, 2.0), (0.3, 0.0, 0.1), (0.0, 0.0, 0.5), (0.4, 0.2, 0.1)], EA=3e6,
                   length=13.4, damping_ratio=0.05)  # fmt: skip
    scene.add_winch(line="hoist", **SWINGING_WINCH)
    tugger = Curve.harmonic(start_time=0.0, offset=7.2, amplitude=0.1, omega=3.0)
    scene.add_line(name="tugger", bodies=["ground", "load"], points=[(10.0, 3.0, -5.0), (0.5, 0, 0)], EA=2e4,
                   length=tugger)  # fmt: skip
    return scene


def busy() -> Scene:
    """A swinging load that is hauled in by a drum, with a tension held and a brake that closes on the way."""
    haul = Curve.quintic(start_time=0.3, end_time=1.0, start=0.0, end=-0.4)
    shut = Curve.quintic(start_time=2.0, end_time=2.3, start=0.0, end=1.0)
    return swinging(rate=haul, tension=30e3, tension_gain=3e-5, dead_band=500.0, drum_inertia=400.0,
                    drum_radius=0.4, maximum_rate=0.8, maximum_tension=26e3, maximum_power=5e3, brake=shut,
                    brake_capacity=28e3, brake_give=0.01)  # fmt: skip


def settled(scene: Scene, *, settling: float = 0.2, **change: Any) -> Scene:
    """The scene with all its lines quasi-static."""
    for name, load in list(scene.loads.items()):
        if type(load).__name__ == "Line":
            scene.replace(name, rung="quasi-static", settling=settling, **change)
    return scene


def taut() -> Scene:
    """`reeved` with both lines taut: they feel each other."""
    scene = settled(reeved(), settling=0.1)
    length = Curve.harmonic(start_time=0.0, offset=5.0, amplitude=0.05, omega=3.0)
    scene.replace("tugger", length=length)
    scene.replace("hoist", length=13.7566)  # carries the load from the start
    return scene


def below(place: Any, *, mass: float = MASS, velocity: Any = (0.0, 0.0, 0.0), size: Any = None,
          **line: Any) -> Scene:  # fmt: skip
    """A load at a place, on a line "hoist" from the origin of the ground; alone without words for a line."""
    scene = Scene(name="below")
    shape = {"inertia": 0.5 * mass * np.eye(3)} if size is None else {"size": size}
    scene.add_body(name="load", mass=mass, position=place, velocity=velocity, **shape)
    if line:
        path = {"bodies": ["ground", "load"], "points": np.zeros((2, 3))}
        scene.add_line(name="hoist", **path | line)
    return scene


def add_led(scene: Scene, name: str, curve: Curve, *, place: Any = (0.0, 0.0, 0.0), **joint: Any) -> None:
    """A body on a slide along z that a curve leads; its joint is "guide", its driver "lead"."""
    scene.add_body(name=name, mass=1e3, inertia=1e3 * np.eye(3), position=place)
    way = {"kind": "prismatic", "first": "ground", "second": name, "point": place, "axis": (0, 0, 1)}
    scene.add_joint(name="guide", **way | joint)
    scene.add_driver(name="lead", joint="guide", curve=curve)
