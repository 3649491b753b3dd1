"""Which load may hang at which radius and slew angle, at rest? Cylinders and heel set the limits."""

import numpy as np

from seacrane import Scene, load_chart, shipped_database, statics
from seacrane.crane import FOOT, Payload, load_crane

LOAD, FORCE, HEEL, PORT = 30e3, 12e6, np.radians(5.0), -np.pi / 2  # kg, N, rad, rad

scene = Scene(name="load chart")
scene.add_vessel(shipped_database(), memory="none")
body, point = scene.add_crane(s1=2.0, s2=2.0, payload=Payload(mass=LOAD)).tip
scene.add_ballast()
limits = {"cylinder force main": FORCE, "heel": HEEL}
chart = load_chart(scene, slews=[0.0, PORT], radii=[20.0, 22.0, 24.0, 26.0], limits=limits)
print(chart)

# By hand, to port: more load heels the ship on by m g arm / (displaced weight GM); the heel adds to the arm.
ship = scene.bodies["vessel"].mass
lean = scene.place_of(body=body, point=point)[2] * np.sin(HEEL)  # m
for radius, allowable in zip(chart.radii, chart.allowable[1], strict=True):
    rest = statics(scene, slew=PORT, radius=radius)
    spare = HEEL - np.abs(rest["heel"].item())
    by_hand = LOAD + spare * ship * rest["GM"].item() / (FOOT[1] + radius + lean)
    print(f"to port at {radius:.0f} m: {allowable / 1e3:6.2f} t, by hand {by_hand / 1e3:6.2f} t")

# By hand, aft: the force of the main cylinder is linear in the load, F = F0 + m (F1 - F0), by virtual work.
crane = load_crane()
empty, one = (crane.static_cylinder_forces(s1=2.0, s2=2.0, payload_mass=kg)[0] for kg in (0.0, 1.0))
radius = statics(scene)["tip radius"].item()
aft = load_chart(scene, radii=radius, limits={"cylinder force main": FORCE}).allowable.item()
print(f"aft at {radius:.2f} m: {aft / 1e3:.2f} t, by hand {(FORCE - empty) / (one - empty) / 1e3:.2f} t")
