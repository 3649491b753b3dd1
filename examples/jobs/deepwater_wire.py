"""100 t and the water about it on up to 3,000 m of wire that weighs: its stretch and its bounce."""

import numpy as np
from scipy.optimize import brentq

from seacrane import Scene, equilibrium, natural_modes, simulate

MASS, WATER, WIRE, EA = 100e3, 80e3, 30.0, 6e8  # kg, kg of added mass, kg/m, N


def lowered(length: float) -> Scene:
    """The water's mass moves with the load and has no weight: a force carries it."""
    scene = Scene(name=f"{length:g} m of wire")
    scene.add_body(name="load", mass=MASS + WATER, size=(6, 6, 6), position=(0, 0, -length))
    scene.add_force("load", name="water", force=(0, 0, WATER * scene.gravity))
    wire = {"mass_per_length": WIRE, "segments": 24}
    scene.add_line(
        "wire", bodies=["ground", "load"], points=[(0, 0, 0), (0, 0, 0)], EA=EA, length=length, wire=wire
    )
    return scene


for length in (250.0, 500.0, 1000.0, 1500.0, 2000.0, 3000.0):
    scene = lowered(length)
    rest = equilibrium(scene)
    share = WIRE * length / (MASS + WATER)  # u tan u = share, of a bar with a mass at its end
    turn = brentq(lambda u, share=share: u * np.tan(u) - share, 1e-6, np.pi / 2 - 1e-9)
    by_hand = 2 * np.pi * length / turn / np.sqrt(EA / WIRE)
    periods = natural_modes(scene, state=rest).natural_period
    stretch = (MASS + WIRE * length / 2) * scene.gravity * length / EA
    still = simulate(scene, 0.1, start=rest, channels=["position"])
    found = -length - still.curve("position[load, z]")[0]
    print(
        f"{length:4.0f} m: stretch {found:6.3f} m, by hand {stretch:6.3f} m; "
        f"bounce {periods[abs(periods - by_hand).argmin()]:.3f} s, by hand {by_hand:.3f} s"
    )
