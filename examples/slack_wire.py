"""A ball on a wire, thrown so fast that the wire goes slack and snatches: when, where, and what it costs.

Usage: python slack_wire.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Scene, simulate

LENGTH, SPEED, GRAVITY = 2.0, 8.0, 9.80665  # m, m/s, m/s2

scene = Scene(name="slack wire", gravity=GRAVITY)
scene.add_body(
    name="ball", mass=3.0, inertia=(0.1, 0.1, 0.1), position=(0.0, 0.0, -LENGTH), velocity=(SPEED, 0.0, 0.0)
)
scene.add_line(name="wire", rung="rigid", first="ground", second="ball")
result = simulate(scene, t_end=3.0, dt_out=0.005, rtol=1e-9)
x, z = (result.select("position", body="ball", axis=axis) for axis in "xz")
tension = result.select("tension", link="wire")

slack, taut = result.events
# where the tension m (v^2 / L + g cos) is zero
angle = np.degrees(np.arccos((2.0 * GRAVITY * LENGTH - SPEED**2) / (3.0 * GRAVITY * LENGTH)))
there = simulate(scene, t_end=slack.time, dt_out=slack.time, rtol=1e-9).select("position", body="ball")[-1]
found = np.degrees(np.arctan2(there[0], -there[2]))
print(f"slack at {slack.time:.6f} s, {found:.6f} deg from the bottom (closed form: {angle:.6f} deg)")
print(f"taut at {taut.time:.6f} s: impulse {taut.impulse:.3f} N s, energy lost {taut.energy_lost:.3f} J")
print(f"largest energy balance {np.abs(result['energy_balance']).max():.1e} J")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (path, pull, lost) = plt.subplots(1, 3, figsize=(10.0, 3.3), layout="constrained")
    turn = np.linspace(0.0, 2.0 * np.pi, 200)
    path.plot(LENGTH * np.cos(turn), LENGTH * np.sin(turn), color="0.8", linewidth=0.8)
    for holds, label in ((tension > 0.0, "taut"), (tension == 0.0, "slack")):
        path.plot(np.where(holds, x, np.nan), np.where(holds, z, np.nan), label=label)
    path.set(xlabel="x [m]", ylabel="z [m]", aspect="equal")
    path.legend()
    pull.plot(result.time, tension)
    pull.set(xlabel="time [s]", ylabel="tension [N]")
    lost.plot(result.time, result["impact_loss"], color="tab:red")
    lost.set(xlabel="time [s]", ylabel="energy lost in impacts [J]")
    for axes in (pull, lost):
        for event in result.events:
            axes.axvline(event.time, color="0.7", linewidth=0.8, linestyle="--")
    figure.savefig(Path(sys.argv[1]) / "slack_wire.png", dpi=110)
