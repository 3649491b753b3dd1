"""A pendulum: a body on a hinge, let go from the horizontal; its period depends on how far it swings.

Usage: python pendulum.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Scene, simulate

scene = Scene(name="pendulum")
scene.add_body(name="bob", mass=2.0, inertia=[0.01, 0.01, 0.01], position=(1.0, 0.0, 0.0))
scene.add_joint(kind="revolute", name="hinge", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0))
scene.add_channel(joint="hinge")
result = simulate(scene, t_end=10.0, dt_out=0.01)

angle = result["coordinate"][:, 0] - np.pi / 2  # from hanging straight down
rises = np.flatnonzero((angle[:-1] < 0) & (angle[1:] >= 0))
crossings = result.time[rises] - angle[rises] * 0.01 / (angle[rises + 1] - angle[rises])
small = 2 * np.pi * np.sqrt(1.005 / 9.80665)  # the bob turns, too
print(f"period               {np.diff(crossings).mean():.4f} s (small swings: {small:.4f} s)")
print(f"largest hinge force  {np.linalg.norm(result['reaction_force'][:, 0], axis=1).max():.2f} N")
print(f"energy balance       {np.abs(result['energy_balance']).max():.1e} J")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots()
    axes.plot(result.time, np.degrees(angle))
    axes.set(xlabel="time [s]", ylabel="angle from hanging [deg]")
    figure.savefig(Path(sys.argv[1]) / "pendulum.png")
