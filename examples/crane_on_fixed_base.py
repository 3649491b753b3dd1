"""A knuckle-boom crane on land lifts 10 t: its cylinders follow smooth references under feedback control.

Usage: python crane_on_fixed_base.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, balance, simulate
from seacrane.analysis import reflected_inertia
from seacrane.crane import Payload

JOINTS = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}
ENDS = {"slew": -np.pi / 2, "main": 1.0, "knuckle": 1.0}  # rad, m, m

scene = Scene(name="crane on a fixed base")
scene.add_crane(base="ground", payload=Payload(mass=10e3))
for name, joint in JOINTS.items():
    scene.add_actuator(name=name, joint=joint)
held, inertia = balance(scene), reflected_inertia(scene)
for name, joint in JOINTS.items():  # the same actuators, now with gains and references
    del scene.actuators[name]
    scene.add_actuator(
        name=name,
        joint=joint,
        stiffness=25.0 * inertia[name],
        damping=8.0 * inertia[name],
        feed_forward=held.loads[name],
        reference=Curve.quintic(start_time=0.0, end_time=30.0, start=0.0, end=ENDS[name]),
    )
result = simulate(scene, t_end=40.0)

print("cylinder forces that hold it at rest [kN]:", {n: round(f / 1e3, 1) for n, f in held.loads.items()})
print(f"payload moves from {result.select('position', body='payload')[0].round(2)} m")
print(f"                to {result.select('position', body='payload')[-1].round(2)} m")
print(f"largest pull in the link  {result['link_tension'].max() / 1e3:.1f} kN")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots()
    axes.plot(result.time, result["cylinder_force"] / 1e3, label=["main", "knuckle"])
    axes.set(xlabel="time [s]", ylabel="cylinder force [kN]")
    axes.legend()
    figure.savefig(Path(sys.argv[1]) / "crane_on_fixed_base.png")
