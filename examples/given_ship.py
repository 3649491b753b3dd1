"""A load below a barge whose motion is given by displacement RAOs: its hook load, and the same by hand.

Usage: python given_ship.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import MotionRaos, Scene, simulate

# Heave and pitch of a box in long waves: the mean over its length of the water's motion at half its draught.
LENGTH, DRAUGHT, BREADTH = 90.0, 5.0, 30.0
omega = np.arange(0.2, 3.01, 0.05)
k = omega**2 / 9.81
half = 0.5 * k * LENGTH
depth = np.exp(-0.5 * k * DRAUGHT)
heave = depth * np.sin(half) / half
pitch = 3.0 * k * depth * (np.sin(half) - half * np.cos(half)) / half**3
head_sea = np.stack([0 * k, 0 * k, heave, 0 * k, -1j * pitch, 0 * k], axis=1)
raos = MotionRaos(omega=omega, heading=[np.pi], values=[head_sea], name="box barge")

scene = Scene(name="given ship")
scene.add_vessel(motion=raos, name="barge", duration=300.0, size=(LENGTH, BREADTH, DRAUGHT))
scene.add_sea(vessel="barge", hs=2.0, tp=9.0, direction_deg=180.0, seed=4)

MASS, TIP, LOAD = 50e3, np.array([30.0, 20.0, 25.0]), np.array([30.0, 20.0, 22.0])
scene.add_body(name="load", mass=MASS, inertia=(1e5, 1e5, 1e5), position=LOAD)
scene.add_joint(kind="distance", name="wire", first="barge", second="load", point=TIP, second_point=LOAD)
result = simulate(scene, t_end=300.0, dt_out=0.25)

# By hand: the tip's vertical acceleration from the RAOs of heave and pitch; the load follows it.
sea = scene.waves.components()
at_tip = raos.at(sea.omega, sea.direction) @ [0.0, 0.0, 1.0, TIP[1], -TIP[0], 0.0]
complex_acceleration = -(sea.omega**2) * at_tip * sea.amplitude * np.exp(1j * np.array(sea.phase))
acceleration = (np.exp(1j * np.outer(result.time, sea.omega)) @ complex_acceleration).real
by_hand = MASS * (scene.gravity + acceleration)

full = result.time > 20.0  # the motion has grown
hook = result["tension"][:, 0]
weight = MASS * scene.gravity
for name, load in (("run", hook[full]), ("by hand", by_hand[full])):
    print(f"{name:8} hook load {load.mean() / 1e3:6.1f} kN, standard deviation {load.std() / 1e3:5.2f} kN, "
          f"largest {load.max() / 1e3:6.1f} kN, dynamic factor {load.max() / weight:.3f}")  # fmt: skip

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots()
    axes.plot(result.time, hook / 1e3, label="run")
    axes.plot(result.time, by_hand / 1e3, "--", label="by hand")
    axes.set(xlabel="time [s]", ylabel="hook load [kN]", xlim=(0.0, 120.0))
    axes.legend()
    figure.savefig(Path(sys.argv[1]) / "given_ship.png", bbox_inches="tight")
