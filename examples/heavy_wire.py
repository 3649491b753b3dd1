"""A load on 1000 m of wire that weighs half as much: its rest and its bounce, and both by hand.

Usage: python heavy_wire.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, equilibrium, natural_modes, simulate
from seacrane.result import heavy_line_tension
from seacrane.scene import spline_curve

LOAD, WIRE, LENGTH, EA = 24e3, 12.0, 1000.0, 2e8  # kg, kg/m, m, N
G = 9.80665

scene = Scene(name="heavy wire")
scene.add_body(name="tip", mass=1e3, inertia=(1e3, 1e3, 1e3))
scene.add_joint(kind="prismatic", name="heave", first="ground", second="tip", axis=(0, 0, 1))
scene.add_driver(name="sea", joint="heave", curve=Curve.constant(value=0.0))
scene.add_body(name="load", mass=LOAD, inertia=(4e4, 4e4, 4e4), position=(0, 0, -LENGTH))
scene.add_line(
    name="wire", bodies=["tip", "load"], points=[(0, 0, 0), (0, 0, 0)], EA=EA, length=LENGTH,
    wire={"mass_per_length": WIRE, "segments": 20},
)  # fmt: skip
rest = equilibrium(scene)
held = simulate(scene, t_end=0.1, start=rest, channels=["position", "line_tension"])

upper, lower = heavy_line_tension(held, line="wire")[0]
stretch = -LENGTH - held.select("position", body="load")[0, 2]
print(f"tension at the tip   {upper / 1e3:7.2f} kN, by hand {(LOAD + WIRE * LENGTH) * G / 1e3:7.2f} kN")
print(f"tension at the load  {lower / 1e3:7.2f} kN, by hand {LOAD * G / 1e3:7.2f} kN")
print(
    f"stretch              {stretch:7.4f} m,  by hand {(LOAD + WIRE * LENGTH / 2) * G * LENGTH / EA:7.4f} m"
)

# Of a bar with a mass at its end: omega L / c tan(omega L / c) = wire / load, c^2 = EA / mass per length.
share = WIRE * LENGTH / LOAD
turn = np.sqrt(share / (1.0 + share / 3.0))
for _ in range(20):
    turn -= (turn * np.tan(turn) - share) / (np.tan(turn) + turn / np.cos(turn) ** 2)
by_hand = 2.0 * np.pi * LENGTH / turn / np.sqrt(EA / WIRE)
bounce = min(natural_modes(scene, state=rest).natural_period, key=lambda period: abs(period - by_hand))
print(f"period of its bounce {bounce:7.4f} s,  by hand {by_hand:7.4f} s")

times = np.arange(0.0, 61.0, 0.1)
ramp = np.sin(np.minimum(times / 16.0, 1.0) * np.pi / 2.0) ** 2
heave = spline_curve(times=times, values=ramp * np.sin(np.pi * times / 4.0))
scene.replace("sea", curve=heave)
result = simulate(scene, t_end=60.0, start=rest, dt_out=0.05)
tension = heavy_line_tension(result, line="wire")
ranges = np.ptp(tension[result.time > 20.0], axis=0) / 1e3
print(f"the tip heaves by 1 m in 8 s: tension ranges over {ranges[0]:.1f} and {ranges[1]:.1f} kN")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots()
    axes.plot(result.time, tension / 1e3, label=["at the tip", "at the load"])
    axes.set(xlabel="time [s]", ylabel="tension [kN]")
    axes.legend()
    figure.savefig(Path(sys.argv[1]) / "heavy_wire.png")
