"""A winch starts to hoist 20 t on an elastic wire: at once, and with a bound on its acceleration.

Usage: python winch_and_wire.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Scene, simulate

G, MASS, RATE, LENGTH, STIFFNESS = 9.80665, 20e3, 1.0, 50.0, 1.5e8  # m/s2, kg, m/s, m, N
HANGS = MASS * G / STIFFNESS * LENGTH  # m, stretch under the weight


def hoisted(**winch: float) -> Scene:
    """The load at rest on its wire, and a winch that is commanded to haul in from the start."""
    scene = Scene(name="winch and wire")
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0, 0, -LENGTH - HANGS))
    scene.add_line(
        name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=STIFFNESS, length=LENGTH,
        damping_ratio=0.001,
    )  # fmt: skip
    scene.add_winch(line="hoist", rate=-RATE, **winch)
    return scene


at_once = simulate(hoisted(), t_end=8.0, dt_out=0.005)
softly = simulate(hoisted(maximum_acceleration=0.3, lag=0.1), t_end=8.0, dt_out=0.005)

weight, k = MASS * G / 1e3, STIFFNESS / LENGTH
jump = RATE * np.sqrt(k * MASS) / 1e3
print(f"weight and v sqrt(k m)       {weight:.1f} + {jump:.1f} = {weight + jump:.1f} kN")
first = at_once["line_tension"][at_once.time < 0.3].max() / 1e3
print(f"first peak, from one instant {first:.1f} kN")
print(f"weight and 2 m a             {weight + 2.0 * MASS * 0.3 / 1e3:.1f} kN")
print(f"peak at 0.3 m/s2             {softly['line_tension'].max() / 1e3:.1f} kN")
paid = softly["line_unstretched_length"][:, 0]
print(f"hauled in after 8 s          {paid[0] - paid[-1]:.2f} m")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    for run, label in ((at_once, "at once"), (softly, "0.3 m/s2")):
        plt.plot(run.time, run["line_tension"] / 1e3, label=label)
    plt.legend()
    plt.xlabel("time [s]")
    plt.ylabel("tension [kN]")
    plt.savefig(Path(sys.argv[1]) / "winch_and_wire.png")
