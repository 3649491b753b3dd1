"""Scenes whose elements follow a curve of time, for tests of kinks."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from named import on_joint

from seacrane import Curve, FlowCoefficients, Scene

CART = 4.0  # kg


def cart(speed: float = 0.0) -> Scene:
    """A mass on a rail along x, without gravity."""
    return on_joint("cart", mass=CART, gravity=0.0, velocity=(speed, 0, 0))


def sprung(frequency: float, damping_ratio: float = 0.0, *, speed: float = 0.0, rest: float = 0.0) -> Scene:
    """The cart on a spring and a damper to `rest`; rad/s."""
    scene = cart(speed)
    scene.add_actuator(name="hold", joint="rail", stiffness=CART * frequency**2, reference=rest,
                       damping=2.0 * damping_ratio * CART * frequency)  # fmt: skip
    return scene


def slewing(torque: Curve | float = 0.0, **actuator: object) -> Scene:
    """A rotor with a payload on a wire of 18 m."""
    scene = Scene(name="slewing", gravity=9.81)
    scene.add_body("rotor", mass=1e5, inertia=(2e7,) * 3)
    scene.add_body("payload", mass=2e4, inertia=(1e3,) * 3, position=(25, 0, 12))
    scene.add_joint("slew", kind="revolute", first="ground", second="rotor", point=(0, 0, 0), axis=(0, 0, 1))
    ends = {"point": (25, 0, 30), "second_point": (25, 0, 12)}
    scene.add_joint("wire", kind="distance", first="rotor", second="payload", **ends)
    scene.add_actuator(name="drive", joint="slew", feed_forward=torque, **actuator)
    return scene


def driven_by(element: str, curve: Curve) -> Scene:
    """A cart with a rod below it, moved by what follows a curve; loads act against a soft spring."""
    scene = cart()
    scene.gravity = 9.81
    scene.add_body("rod", mass=1.0, inertia=(0.1,) * 3, position=(0, 0, -0.8))
    scene.add_joint("pin", kind="revolute", first="cart", second="rod", point=(0, 0, 0), axis=(0, 1, 0))
    if element in ("feed-forward", "force table", "wind"):
        scene.add_spring("hold", first="ground", second="cart", first_point=(-500, 0, 0), stiffness=6.0,
                         damping=1.0, natural_length=500.0)  # fmt: skip
    if element == "feed-forward":
        scene.add_actuator("rail", name="drive", feed_forward=curve)
    elif element == "reference":
        scene.add_actuator("rail", name="drive", stiffness=40.0, damping=12.0, reference=curve)
    elif element == "driver":
        scene.add_driver("rail", curve=curve)
    elif element == "force table":  # takes the curve at every half second
        times, loads = np.linspace(0.0, 20.0, 41), np.zeros((41, 6))
        loads[:, 0] = curve.evaluate(times)[:, 0]
        scene.add_force("cart", name="push", times=times, force=loads)
    else:
        angle, areas = np.linspace(0.0, np.pi, 13), {"frontal_area": 0.5, "lateral_area": 0.5, "length": 1.0}
        drag = FlowCoefficients(angle=angle, x=0.8 * np.cos(angle), y=0.0 * angle, yaw=0.0 * angle)
        scene.add_wind(coefficients=drag, speed=curve, direction_deg=0.0, body="cart", **areas)
    return scene


ELEMENTS: dict[str, Callable[[Curve], Scene]] = {
    name: partial(driven_by, name) for name in ("feed-forward", "reference", "driver", "force table", "wind")
}


def random_curve(rng: np.random.Generator, *, continuous: bool = False) -> Curve:
    """Two to six stretches, each of which goes on from the one before with a jump of its value, rate or
    acceleration, or of nothing below them; `continuous`: value and rate do not jump."""
    starts = np.concatenate([[0.5], 0.5 + np.cumsum(rng.uniform(0.3, 5.0, int(rng.integers(1, 6))))])
    pieces = []
    value = rate = 0.0
    for start, end in zip(starts, [*starts[1:], starts[-1] + 3.0], strict=True):
        kind = rng.integers(3)
        if kind == 0 and not continuous:
            value += rng.normal()
        if kind == 1 and not continuous:
            rate = 0.5 * rng.normal()
        acceleration, span = 0.4 * rng.normal(), end - start
        target = rng.normal()  # the cubic brings the curve near it
        cubic = (target - value - rate * span - 0.5 * acceleration * span**2) / span**3
        pieces.append([value, rate, 0.5 * acceleration, cubic, 0.0, 0.0])
        value, rate = (value + rate * span + 0.5 * acceleration * span**2 + cubic * span**3,
                       rate + acceleration * span + 3.0 * cubic * span**2)  # fmt: skip
    end = [value, rate if continuous else 0.0, 0.0, 0.0, 0.0, 0.0]
    return Curve.pieces(starts=[*starts, starts[-1] + 3.0], coefficients=[*pieces, end])


def random_slew(rng: np.random.Generator) -> Scene:
    """Slewing by torque or by reference, the payload on a rod or on a wire, with a stop or without."""
    curve = random_curve(rng)
    if rng.random() < 0.5:
        scene = slewing(scaled(curve, 2e6))
    else:
        scene = slewing(0.0, stiffness=4e7, damping=3e7, reference=scaled(curve, 0.3))
    if rng.random() < 0.5:
        scene.add_line(joint="wire", rung="rigid")
    kind = rng.integers(4)
    if kind == 0:
        scene.add_stop(joint="slew", minimum=-0.15, maximum=0.15, stiffness=3e8, damping=0.3)
    elif kind == 1:
        scene.add_stop(joint="slew", minimum=-0.15, maximum=0.15, restitution=0.3)
    elif kind == 2:
        scene.add_friction(joint="slew", load=3e5, speed=0.02)
    return scene


def random_cart(rng: np.random.Generator) -> Scene:
    """A cart and its pendulum behind a random curve, with a stop or without."""
    element = str(rng.choice(list(ELEMENTS)))
    scene = ELEMENTS[element](random_curve(rng, continuous=element == "driver"))
    if element != "driver" and rng.random() < 0.4:
        if rng.random() < 0.5:
            scene.add_stop(joint="rail", minimum=-0.3, maximum=0.3, stiffness=2e3, damping=0.2)
        else:
            scene.add_stop(joint="rail", minimum=-0.3, maximum=0.3)
    return scene


def random_snatch(rng: np.random.Generator) -> Scene:
    """A ball on a wire, thrown so that it may go slack and snatch."""
    scene, length = Scene(name="snatch"), rng.uniform(1.0, 4.0)
    velocity = (np.sqrt(9.81 * length) * rng.uniform(0.5, 2.1), 0.3 * rng.normal(), 0.0)
    low = (0.0, 0.0, -length)
    scene.add_body("ball", mass=3.0, inertia=(0.1, 0.2, 0.3), position=low, velocity=velocity)
    ends = {"point": (0, 0, 0), "second_point": low}
    scene.add_joint("wire", kind="distance", first="ground", second="ball", **ends)
    scene.add_line(joint="wire", rung="rigid")
    return scene


def scaled(curve: Curve, factor: float) -> Curve:
    pieces = curve.to_pieces()
    return Curve.pieces(starts=pieces["starts"],
                        coefficients=(factor * np.array(pieces["coefficients"])).tolist())  # fmt: skip


def random_kinked(rng: np.random.Generator) -> Scene:
    """Kinks, stops, wires and slewing, by turns."""
    make = rng.choice(np.array([random_slew, random_slew, random_cart, random_cart, random_snatch]))
    scene: Scene = make(rng)
    return scene
