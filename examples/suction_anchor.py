"""A suction anchor goes down through waves with its hatch open, and comes up with it open, and shut.

Usage: python suction_anchor.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Result, Scene, simulate
from seacrane.hydro import Compartment, CylinderPart

G, RHO, MASS, D, H = 9.80665, 1025.0, 90e3, 6.0, 12.0  # m/s2, kg/m3, kg, m, m
AREA, HATCH, RATE, AIR = np.pi / 4.0 * D**2, 1.0, 0.25, 101325.0 - 2339.0  # m2, m2, m/s, Pa over vapour's
UP = ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0))  # the cylinder's x is up
MOUTH = {"point": (0.0, 0.0, -H / 2.0), "area": AREA}
OPEN = {"openings": [MOUTH, {"point": (0.0, 0.0, H / 2.0), "area": HATCH}]}
SHUT = {"openings": [MOUTH], "air": "shut", "exponent": 1.0}


def lift(height: float, rate: float, inside: float, **hatch: object) -> Result:
    """On a wire, its middle at a height, with some water inside."""
    scene = Scene(name="suction anchor", gravity=G)
    scene.add_body("anchor", mass=MASS, size=(D, D, H), position=(0.0, 0.0, height))
    scene.add_line(
        "wire", first="ground", second="anchor", first_point=(0.0, 0.0, 60.0), second_point=(0.0, 0.0, H / 2),
        EA=5e8, tension_at_start=MASS * G,
    )  # fmt: skip
    scene.add_winch("wire", rate=Curve.quintic(start_time=2.0, end_time=4.0, start=0.0, end=rate), lag=0.1)
    shell = CylinderPart(length=H, diameter=D, axes=UP, strips=1, end_drag=0.0)
    water = Compartment(
        name="inside", area=AREA, height=H, point=(0.0, 0.0, -H / 2), initial=inside * AREA * H, **hatch
    )
    scene.add_immersed("anchor", parts=[shell], inside=water, density=RHO)
    scene.add_sea(vessel=None, hs=1.0, tp=7.0, direction_deg=0.0, seed=4)
    return simulate(scene, t_end=80.0, dt_out=0.05, start="rest")


runs = {
    "down, hatch open": lift(7.0, RATE, 0.0, **OPEN),
    "up, hatch open": lift(-8.0, -RATE, 1.0, **OPEN),
    "up, hatch shut": lift(-8.0, -RATE, 1.0, **SHUT),
}
column = AIR / (RHO * G)
print(f"steel alone                     {MASS * G / 1e3:6.0f} kN")
print(f"and a column as high as air lifts, {column:.2f} m: {(MASS * G + AIR * AREA) / 1e3:.0f} kN")
for name, run in runs.items():
    pull = run["line_tension"][:, 0] / 1e3
    print(f"{name:18s} most {pull.max():6.0f} kN, least {pull.min():6.0f} kN, at last {pull[-1]:6.0f} kN")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (above, below) = plt.subplots(2, sharex=True, figsize=(8.0, 6.0), layout="constrained")
    for name, run in runs.items():
        above.plot(run.time, run["line_tension"][:, 0] / 1e3, label=name)
        below.plot(run.time, run.select("load_state", state_name="inside.volume"))
    above.set_ylabel("pull [kN]")
    above.legend()
    below.set_ylabel("water inside [m3]")
    below.set_xlabel("time [s]")
    figure.savefig(Path(sys.argv[1]) / "suction_anchor.png", dpi=90)
