"""Contact, limits, seats and joints that close loops."""

from __future__ import annotations

import numpy as np

from bits.case import by, case
from bits.scenes.parts import G, guided, heaving, waving, with_load
from seacrane import Curve, SampledController, Scene

FEET = [(x, y, -0.6) for x in (-1.0, 1.0) for y in (-1.0, 1.0)]


@case(by("dopri5"), by("rk4", "redundant", dt=2e-3), t_end=1.0)
def thrown_onto_a_deck() -> Scene:
    """Feet that land one after the other, slide and stick."""
    lean = (np.cos(0.06), np.sin(0.06), 0.0, 0.0)
    scene = with_load((0, 0, 0.85), quaternion=lean, velocity=(1.5, 0.5, 0.0))
    scene.add_contact("load", points=FEET, on="ground", stiffness=1e6, damping=1.0, friction=0.4, name="feet")
    return scene


@case(by("dopri5"), by("cvode-bdf"), t_end=4.0, dt_out=0.1)
def sliding_on_a_rolling_deck() -> Scene:
    scene = Scene(name="sliding", gravity=G)
    scene.add_body(name="barge", mass=2e6, inertia=(1e8, 1e9, 1e9))
    scene.add_joint(kind="revolute", name="roll", first="ground", second="barge", axis=(1.0, 0.0, 0.0))
    scene.add_driver(joint="roll", curve=waving(0.3, 0.9))
    scene.add_body(name="load", mass=50e3, size=(4.0, 4.0, 2.0), position=(0.0, 0.0, 5.6))
    scene.add_contact(
        "load", on="barge", points=2.0 * np.array(FEET), place=(0, 0, 4.4 + 0.01), friction=0.3, name="feet"
    )
    return scene


@case(by("dopri5"), by("tsit5", "redundant"), t_end=3.0)
def on_a_box_a_post_and_a_seabed() -> Scene:
    scene = with_load((0, 0, 0.7), mass=2e3, velocity=(0.1, 0, 0))
    given = {"points": FEET, "stiffness": 1e6, "damping": 0.8, "friction": 0.2}
    scene.add_contact(
        "load", on="ground", surface="box", size=(8, 4, 0.5), place=(0, 0, -0.3), name="box", **given
    )
    rows = [(0, 0), (0.1, 2e3), (0.3, 2e4)]
    scene.add_contact(
        "load", on="ground", axis=(-1, 0, 0), place=(1.05, 0, 0), points=[(1, 0, 0)], table=rows, name="wall"
    )
    scene.add_contact("load", on="seabed", points=[(0, 0, -0.6)], depth=0.05, stiffness=2e5, friction=0.4)
    return scene


@case(by("dopri5"), by("rk4", "redundant", dt=5e-3), t_end=6.0, dt_out=0.1)
def landing_on_a_heaving_deck() -> Scene:
    scene = heaving(0.3, 1.0)
    scene.add_body(name="load", mass=40e3, size=(4.0, 3.0, 2.0), position=(0.0, 0.0, 1.5))
    feet = [(-2, -1.5, -1), (2, -1.5, -0.97), (2, 1.5, -0.93), (-2, 1.5, -0.98)]
    scene.add_contact("load", on="ship", points=feet, friction=0.3, name="feet")
    ends = {"first": "ground", "second": "load", "first_point": (0, 0, 28.0), "second_point": (0, 0, 1)}
    scene.add_line(name="wire", **ends, EA=2e8, tension_at_start=40e3 * G)
    scene.add_winch(line="wire", rate=Curve.quintic(start_time=0.5, end_time=1.5, start=0.0, end=0.4))
    return scene


@case(by("dopri5"), by("dop853", "redundant", rtol=1e-8), t_end=3.0)
def rigid_wire_that_goes_slack() -> Scene:
    """A ball that is thrown off its circle, and snatches."""
    scene = with_load((0.0, 0.0, -2.0), mass=3.0, velocity=(8.0, 0, 0))
    scene.add_line(name="wire", rung="rigid", first="ground", second="load", restitution=0.3)
    return scene


@case(by("dopri5"), by("ida", "redundant"), t_end=3.0)
def end_stop() -> Scene:
    """A slide that is pushed to and fro between its stops."""
    scene = guided(mass=3.0)
    scene.add_actuator(joint="rail", feed_forward=Curve.harmonic(amplitude=-30.0, omega=2.0))
    scene.add_stop(joint="rail", minimum=-0.5, maximum=4.0, restitution=0.4)
    return scene


@case(by("dopri5"), by("cvode-bdf", "redundant"), t_end=0.5)
def planar_loop() -> Scene:
    """A four-bar of hinges, three of whose rows are redundant."""
    points = np.array([[0.0, 0, 0], [0.3, 0, 0.7], [1.6, 0, 1.0], [1.4, 0, 0]])
    scene = Scene(name="four-bar", gravity=G)
    for i in range(3):
        middle = 0.5 * (points[i] + points[i + 1])
        scene.add_body(name=f"bar {i}", mass=10.0 + 5.0 * i, inertia=(1.0, 1.5, 1.2), position=middle)
    bodies = ["ground", "bar 0", "bar 1", "bar 2", "ground"]
    for i in range(4):
        ends = {"first": bodies[i], "second": bodies[i + 1], "point": points[i]}
        scene.add_joint(kind="revolute", name=f"pin {i}", axis=(0, 1, 0), **ends)
    return scene


def follow(_: float, measured: dict) -> dict:
    """Push the cart after the swing, and back to the middle of its rail."""
    cart, _ = measured["coordinate"]
    cart_rate, swing_rate = measured["coordinate_rate"]
    return {"drive.force": -60.0 * cart - 200.0 * cart_rate + 300.0 * swing_rate}


@case(controllers=[SampledController(period=0.05, function=follow)])
def sampled_controller() -> Scene:
    scene = guided(mass=100.0)
    scene.add_body(name="bob", mass=20.0, inertia=[0.1, 0.1, 0.1], position=(1.0, 0.0, -2.0))
    scene.add_joint(kind="revolute", name="pin", first="load", second="bob", point=(0, 0, 0), axis=(0, -1, 0))
    scene.add_actuator(name="drive", joint="rail")
    scene.add_channel(joint="pin")
    return scene
