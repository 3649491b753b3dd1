"""Four slings of which one is 30 mm short, and tanks that take the heel out: who carries what?"""

import numpy as np
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

from seacrane import Scene, shipped_database, statics
from seacrane.scene import Tank

MASS, EA, LONG, SHORT, G = 78e3, 5e7, 7.0, 0.03, 9.80665  # kg, N, m, m, m/s2
LUGS = np.array([(3.0, 2.0, 1.5), (3.0, -2.0, 1.5), (-3.0, -2.0, 1.5), (-3.0, 2.0, 1.5)])  # m

scene = Scene(name="short sling")
scene.add_vessel(shipped_database())
scene.add_crane(slew=-np.pi / 2, s1=2.0, s2=2.0)
slings = {"length": LONG, "EA": EA, "points": LUGS}
scene.add_hoist(mass=MASS, size=(7, 5, 3), length=10.0, EA=4e8, block_mass=2e3, slings=slings)
loose = scene.loads["hoist sling 1"].length.evaluate(0.0)[0, 0]
scene.replace("hoist sling 1", length=loose - SHORT)
heel = np.degrees(statics(scene)["heel"].item())
places = {"port": (0, 11, 4), "starboard": (0, -11, 4), "fore": (30, 0, 4)}
tanks = {name: Tank(point=place, capacity=2e6, content=1.1e6) for name, place in places.items()}
changes = scene.add_ballast(tanks=tanks).changes
rest = statics(scene)

lengths = loose - SHORT * np.array([1, 0, 0, 0])


def energy(pose: np.ndarray) -> float:
    """Of the load below the hook: strain of the slings, and weight, MJ; place in m, turn as a vector."""
    ends = pose[:3] + Rotation.from_rotvec(pose[3:]).apply(LUGS)
    strain = np.maximum(np.linalg.norm(ends, axis=1) / lengths - 1.0, 0.0)
    return (0.5 * EA * (strain**2 * lengths).sum() + MASS * G * pose[2]) / 1e6


found = minimize(energy, [0, 0, -7.5, 0, 0, 0], tol=1e-13, method="BFGS").x
ends = found[:3] + Rotation.from_rotvec(found[3:]).apply(LUGS)
by_hand = EA * np.maximum(np.linalg.norm(ends, axis=1) / lengths - 1.0, 0.0)
for i, hand in enumerate(by_hand, 1):
    tension = rest[f"line tension hoist sling {i}"].item()
    print(f"sling {i} carries {tension / 1e3:6.2f} kN, by hand {hand / 1e3:6.2f} kN")
