"""A service crane whose bodies and joints are in a URDF file, on a vessel in waves.

Its jib cylinder closes a loop, which URDF cannot say: a table beside the file does.
Usage: python crane_from_urdf.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, shipped_database, simulate, statics
from seacrane.crane import Payload, load_crane
from seacrane.plotting.panel import new_figure

crane = load_crane("service_arm_5t")
print(f"{crane.data.name}: {crane.mass:.0f} kg, bodies {', '.join(crane.mass_properties)}")

scene = Scene(name="service crane")
scene.add_vessel(shipped_database())
load = Payload(mass=1.5e3, size=(1.2, 1.2, 1.0), link_length=1.5)
foot, pose = (-20.0, -8.0, 6.0), {"slew": -1.2, "jib": 0.3}
scene.add_crane(crane, foot=foot, coordinates=pose, payload=load, held=True)
print(statics(scene, coordinates={"telescope": [0.0, 1.5, 3.0]}))

# Out with the telescope while the ship rolls: the driver that held it follows a curve.
del scene.drivers["telescope.displacement"]
out = Curve.quintic(start_time=10.0, end_time=30.0, start=0.0, end=2.5)
scene.add_driver(joint="telescope", curve=out)
scene.add_sea(hs=1.5, tp=8.0, direction_deg=90.0, seed=1)
result = simulate(scene, t_end=60.0, dt_out=0.1)
force = result["cylinder_force"] / 1e3
tension = result["link_tension"] / 1e3
print(f"jib cylinder {np.min(force[:, 0]):.1f} to {np.max(force[:, 0]):.1f} kN")
print(f"link {tension.min():.2f} to {tension.max():.2f} kN, at rest {load.mass * scene.gravity / 1e3:.2f} kN")

if len(sys.argv) > 1:
    folder = Path(sys.argv[1])
    figure = new_figure(figsize=(7.0, 4.5))
    above, below = figure.subplots(2, 1, sharex=True)
    for i, name in enumerate(result.coords["cylinder"]):
        above.plot(result.time, force[:, i], label=name)
    above.set_ylabel("cylinder force [kN]")
    above.legend()
    below.plot(result.time, tension, label="link")
    below.set(xlabel="time [s]", ylabel="tension [kN]")
    below.legend()
    figure.savefig(folder / "crane_from_urdf.png", dpi=130)
