"""Which cylinder forces does a crane motion need? By algebra with everything prescribed, and by a driven run.

Usage: python which_cylinder_forces.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, simulate
from seacrane.analysis import driven, inverse_dynamics
from seacrane.crane import Payload

MOVE = {"slew": (0.0, -np.pi / 2), "main": (0.0, 1.0), "knuckle": (0.0, 1.0)}  # rad, m, m
JOINTS = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}


def crane(payload: Payload | None) -> Scene:
    """The crane on the ground with its three motions prescribed by references."""
    scene = Scene(name="crane")
    scene.add_crane(base="ground", payload=payload)
    for name, (start, end) in MOVE.items():
        reference = Curve.quintic(start_time=0.0, end_time=20.0, start=start, end=end)
        scene.add_actuator(name=name, joint=JOINTS[name], reference=reference)
    return scene


times = np.linspace(0.0, 20.0, 41)
algebra = inverse_dynamics(crane(None), times=times)
empty = simulate(driven(crane(None)), t_end=20.0, dt_out=0.5)
loaded = simulate(driven(crane(Payload(mass=10e3))), t_end=20.0, dt_out=0.5)

for i, name in enumerate(("main", "knuckle")):
    force, swinging = empty["cylinder_force"][:, i], loaded["cylinder_force"][:, i]
    print(f"{name:8} empty {force.min() / 1e3:8.1f} to {force.max() / 1e3:8.1f} kN", end="")
    print(f", with 10 t {swinging.min() / 1e3:8.1f} to {swinging.max() / 1e3:8.1f} kN", end="")
    print(f"; algebra and simulation differ by {np.abs(algebra[name] - force).max():.1e} N")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots()
    axes.plot(empty.time, empty["cylinder_force"] / 1e3, label=["main, empty", "knuckle, empty"])
    axes.plot(loaded.time, loaded["cylinder_force"] / 1e3, "--", label=["main, 10 t", "knuckle, 10 t"])
    axes.set(xlabel="time [s]", ylabel="cylinder force [kN]")
    axes.legend()
    figure.savefig(Path(sys.argv[1]) / "which_cylinder_forces.png")
