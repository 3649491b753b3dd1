"""A controller in Python, called 20 times a second: a cart calms the pendulum that hangs from it.

The controller reads what would be measured and sets the force on the cart, which holds until the next call.

Usage: python sampled_controller.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import SampledController, Scene, simulate

scene = Scene(name="cart")
scene.add_body(name="cart", mass=100.0, inertia=[10.0, 10.0, 10.0])
scene.add_body(name="load", mass=20.0, inertia=[0.1, 0.1, 0.1], position=(1.0, 0.0, -2.0))
scene.add_joint(kind="prismatic", name="rail", first="ground", second="cart", axis=(1, 0, 0))
scene.add_joint(kind="revolute", name="pin", first="cart", second="load", point=(0, 0, 0), axis=(0, -1, 0))
scene.add_actuator(name="drive", joint="rail")
scene.add_channel(joint="rail")
scene.add_channel(joint="pin")


def follow_the_load(time: float, measured: dict) -> dict:
    """Push the cart after the swing, and back to the middle of its rail."""
    cart, _ = measured["coordinate"]
    cart_rate, swing_rate = measured["coordinate_rate"]
    return {"drive.force": -60.0 * cart - 200.0 * cart_rate + 300.0 * swing_rate}


def tip(result) -> np.ndarray:
    """Where the load is relative to the cart, m."""
    return result.select("position", body="load", axis="x") - result.select("position", body="cart", axis="x")


calmed = simulate(scene, t_end=30.0, controllers=[SampledController(period=0.05, function=follow_the_load)])
free = simulate(scene, t_end=30.0)
for name, result in (("free", free), ("controlled", calmed)):
    print(f"{name:10}  largest swing in the last 10 s: {np.abs(tip(result)[result.time > 20.0]).max():.3f} m")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots()
    axes.plot(free.time, tip(free), label="free")
    axes.plot(calmed.time, tip(calmed), label="controlled")
    axes.set(xlabel="time [s]", ylabel="load beside the cart [m]")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.savefig(Path(sys.argv[1]) / "sampled_controller.png", bbox_inches="tight")
