"""A lattice boom luffs in on its rope with a load: tension by hand, at rest and as the winch hauls.

Usage: python lattice_crane.py [FOLDER FOR A PICTURE]
"""

import math
import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, simulate, statics
from seacrane.crane import Payload, load_crane
from seacrane.plotting.panel import new_figure

LOAD, START = 60e3, math.radians(45.0)  # kg, rad

crane = load_crane("lattice_boom_100t")
scene = Scene(name="lattice crane")
load = Payload(mass=LOAD, size=(4.0, 4.0, 3.0), link_length=20.0)
scene.add_crane(crane, base="ground", coordinates={"boom": START}, payload=load, held=True)

# At rest, led through poses: the moment about the hinge over twelve falls and their lever arm.
degrees = np.array([15.0, 30.0, 45.0, 60.0, 75.0])
told = statics(scene, coordinates={"boom": np.radians(degrees) - START})
print(told)

center = crane.mass_properties["boom"].center_of_mass
boom = crane.mass_properties["boom"].mass
for angle, tension in zip(np.radians(degrees), told["rope tension boom"], strict=True):
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    middle, head, mast = turn @ center[[0, 2]], turn @ np.array([-48.0, 0.0]), np.array([8.0, 13.0])
    pull = (mast - head) / np.linalg.norm(mast - head)
    moment = -scene.gravity * (boom * middle[0] + LOAD * head[0])
    by_hand = moment / abs(head[0] * pull[1] - head[1] * pull[0]) / 12.0
    print(f"{np.degrees(angle):3.0f} deg: {tension / 1e3:8.3f} kN a fall, by hand {by_hand / 1e3:8.3f} kN")

# The rope as an elastic line on its winch, which hauls 40 m in: a twelfth of it between the blocks.
rate = Curve.quintic(start_time=5.0, end_time=10.0, start=0.0, end=-1.0).then(
    time=40.0, curve=Curve.quintic(start_time=40.0, end_time=45.0, start=-1.0, end=0.0)
)
scene.add_winch("luffing rope", rate=rate)
result = simulate(scene, t_end=60.0, dt_out=0.1)
tension = result["line_tension"][:, 0] / 1e3
height = result["position"][:, list(result.coords["body"]).index("payload"), 2]
print(f"load {height[0]:.2f} to {height[-1]:.2f} m; rope {tension.min():.1f} to {tension.max():.1f} kN")

if len(sys.argv) > 1:
    folder = Path(sys.argv[1])
    figure = new_figure(figsize=(7.0, 4.5))
    above, below = figure.subplots(2, 1, sharex=True)
    above.plot(result.time, tension, label="luffing rope, each fall")
    above.set_ylabel("tension [kN]")
    above.legend()
    below.plot(result.time, height, label="load")
    below.set(xlabel="time [s]", ylabel="height [m]")
    below.legend()
    figure.savefig(folder / "lattice_crane.png", dpi=130)
