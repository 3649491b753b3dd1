"""Hang an 80 t nacelle on a 10 t block and four slings: periods of the double pendulum, pull in a sling."""

import numpy as np
from scipy.linalg import eigh

from seacrane import Scene, equilibrium, natural_modes, simulate

M1, M2, L1, L2 = 10e3, 80e3, 15.0, 6.0  # kg and m: block on the wire, load on the slings
SIZE, LUGS = np.array([12.0, 4.0, 5.0]), [(x, y, 2.5) for x in (5.0, -5.0) for y in (2.0, -2.0)]  # m

scene = Scene(name="nacelle")
scene.add_vessel(motion="rest")
scene.add_crane(slew=-np.pi / 2, s1=3.5, s2=2.0, held=True)
leg = float(np.linalg.norm([5.0, 2.0, L2]))
slings = {"length": leg, "EA": 1e8 * leg, "points": LUGS}
scene.add_hoist(mass=M2, size=SIZE, length=L1, stiffness=4e8, block_mass=M1, slings=slings, damping=False)
rest = equilibrium(scene)

inertia, drop, g = M2 / 12 * (SIZE @ SIZE - SIZE**2), L2 + 2.5, scene.gravity
found = natural_modes(scene, state=rest).natural_period
for axis, name in enumerate("xy"):
    stiffness = np.diag([(M1 + M2) * g * L1, M2 * g * drop])
    mass = [[(M1 + M2) * L1**2, M2 * L1 * drop], [M2 * L1 * drop, M2 * drop**2 + inertia[axis]]]
    for by_hand in 2 * np.pi / np.sqrt(eigh(stiffness, mass)[0]):
        print(
            f"period about {name}, s     {found[abs(found - by_hand).argmin()]:7.3f}, by hand {by_hand:7.3f}"
        )
still = simulate(scene, 1.0, start=rest)
sling = still.select("line_tension", line="hoist sling 1")[0] / 1e3
print(f"tension of a sling, kN  {sling:7.2f}, by hand {M2 * g / 4 * leg / L2 / 1e3:7.2f}")
