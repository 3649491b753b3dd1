"""Which load may hang where? Limits of the cylinders, of the heel and of the crane's table, in one call.

Usage: python load_chart.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Scene, load_chart, statics
from seacrane.crane import Payload, load_crane
from seacrane.hydro import shipped_database
from seacrane.pictures import plot_load_chart

PAYLOAD = 50e3  # kg, with which the ship is upright in the pose described
LIMITS = {"cylinder force main": 12e6, "cylinder force knuckle": 6e6, "heel_deg": 6.0}  # N, N, deg

scene = Scene(name="load chart")
scene.add_vessel(shipped_database(), memory="none")
scene.add_crane(s1=2.0, s2=2.0, payload=Payload(mass=PAYLOAD))
scene.add_ballast()

slews, radii = np.radians([0.0, -45.0, -90.0]), [20.0, 22.0, 24.0, 26.0]
chart = load_chart(scene, slews=slews, radii=radii, limits=LIMITS)
print(chart)

# One point by hand, on a fixed base: the force is linear in the load, F = F0 + m (F1 - F0) by virtual work.
quay = Scene(name="quay")
quay.add_crane(base="ground", s1=2.0, s2=2.0, payload=Payload(mass=PAYLOAD))
crane = load_crane()
empty, one_tonne = (crane.static_cylinder_forces(s1=2.0, s2=2.0, payload_mass=kg)[0] for kg in (0.0, 1e3))
radius = float(statics(quay)["tip radius"])
on_quay = load_chart(quay, radii=radius, limits={"cylinder force main": 12e6})
by_hand = (12e6 - empty) / (one_tonne - empty)
print(f"main cylinder at {radius:.3f} m: {on_quay.allowable[0, 0] / 1e3:.3f} t, by hand {by_hand:.3f} t")

if len(sys.argv) > 1:
    plot_load_chart(chart).savefig(Path(sys.argv[1]) / "load_chart.png", dpi=130)
