"""A load on the deck of a rolling barge: at which roll it slides, and how far with each roll.

Usage: python sliding_on_deck.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, simulate

HEIGHT, PERIOD, FRICTION, GRAVITY = 5.0, 8.0, 0.3, 9.80665  # m above the axis of roll, s, 1, m/s2
OMEGA = 2.0 * np.pi / PERIOD
FEET = [(-2.0, -2.0, 0.0), (2.0, -2.0, 0.0), (2.0, 2.0, 0.0), (-2.0, 2.0, 0.0)]


def on_deck(roll: float) -> Scene:
    """The barge rolls by `roll` (rad) from its largest speed on, and the load with it."""
    scene = Scene(name="sliding on deck", gravity=GRAVITY)
    turning = (roll * OMEGA, 0.0, 0.0)
    scene.add_body(name="barge", mass=2e6, inertia=(1e8, 1e9, 1e9), angular_velocity=turning)
    scene.add_joint(kind="revolute", name="roll", first="ground", second="barge", axis=(1.0, 0.0, 0.0))
    scene.add_driver(joint="roll", curve=Curve.harmonic(amplitude=roll, omega=OMEGA, phase=-0.5 * np.pi))
    scene.add_body(
        name="load", mass=50e3, size=(4.0, 4.0, 2.0), position=(0.0, 0.0, HEIGHT), angular_velocity=turning,
        velocity=(0.0, -roll * OMEGA * HEIGHT, 0.0),
    )  # fmt: skip
    scene.add_contact(
        "load", on="barge", points=FEET, place=(0.0, 0.0, HEIGHT + 0.01), friction=FRICTION, name="feet"
    )
    scene.add_channel("load on deck", expression="load.y in barge")
    return scene


# at the height of the load, gravity along the deck and the deck's own acceleration add up
roll = np.radians(np.linspace(1.0, 25.0, 2401))
needed = (GRAVITY * np.sin(roll) + HEIGHT * OMEGA**2 * roll) / (GRAVITY * np.cos(roll))
limit = np.degrees(np.interp(FRICTION, needed, roll))
print(f"closed form: a load with friction {FRICTION} slides beyond a roll of {limit:.3f} deg")

runs = {}
for degrees in (10.0, 12.5, 13.5, 15.0):
    runs[degrees] = result = simulate(on_deck(np.radians(degrees)), t_end=5.0 * PERIOD, dt_out=0.05)
    slides = sum(event.kind == "slip" for event in result.events if event.name == "feet.1")
    lost = float(result.select("load_state", state_name="feet.friction_loss")[-1])
    print(f"{degrees:5.1f} deg: slides {slides:2d} times, friction takes {lost / 1e3:8.3f} kJ")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (place, pressed) = plt.subplots(2, 1, figsize=(8.0, 5.0), sharex=True, layout="constrained")
    for degrees, result in runs.items():
        place.plot(result.time, result.curve("own[load on deck]"), label=f"{degrees:g} deg")
        pressed.plot(result.time, result.select("contact_press", contact_point="feet.1") / 1e3)
    place.set(ylabel="load over the deck [m]")
    figure.legend(title="roll", ncols=4, loc="outside upper right")
    pressed.set(xlabel="time [s]", ylabel="press of a foot [kN]")
    figure.savefig(Path(sys.argv[1]) / "sliding_on_deck.png", dpi=110)
