"""A load is set down on a heaving deck: feet of unequal height, re-hits, peaks, and what waiting is worth.

Usage: python landing.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Curve, Scene, simulate
from seacrane.answers import contact_hits

GRAVITY = 9.80665  # m/s2
HEAVE, OMEGA = 0.4, 2.0 * np.pi / 8.0  # m, rad/s
MASS, EA, LENGTH = 40e3, 2.0e8, 25.0  # kg, N, m
FEET = [(-2.0, -1.5, -1.0), (2.0, -1.5, -1.0), (2.0, 1.5, -0.95), (-2.0, 1.5, -1.0)]  # one is 5 cm short


def landing(rate: float) -> Scene:
    """A load that hangs 1 m over a deck and is lowered at `rate` (m/s)."""
    scene = Scene(name="landing", gravity=GRAVITY)
    scene.add_body(name="barge", mass=5e6, inertia=(1e9,) * 3, velocity=(0.0, 0.0, HEAVE * OMEGA))
    scene.add_joint(kind="prismatic", name="heave", first="ground", second="barge", axis=(0.0, 0.0, 1.0))
    scene.add_driver(joint="heave", curve=Curve.harmonic(amplitude=HEAVE, omega=OMEGA, phase=-0.5 * np.pi))
    scene.add_body(name="load", mass=MASS, size=(4.0, 3.0, 2.0), position=(0.0, 0.0, 2.6))
    scene.add_contact("load", on="barge", points=FEET, friction=0.3, name="feet")
    scene.add_line(
        name="wire", first="ground", second="load", first_point=(0.0, 0.0, LENGTH + 3.6),
        second_point=(0.0, 0.0, 1.0), EA=EA, tension_at_start=MASS * GRAVITY,
    )  # fmt: skip
    scene.add_winch(line="wire", rate=Curve.quintic(start_time=2.0, end_time=4.0, start=0.0, end=rate))
    return scene


runs = {}
print(" rate  hits  re-hits  fastest m/s  peak kN  dynamic factor  without damping kN")
for rate in (0.1, 0.3, 0.6):
    runs[rate] = result = simulate(landing(rate), t_end=40.0, dt_out=0.005)
    hits = contact_hits(result, "feet")
    hardest = max(hits, key=lambda hit: hit.peak)
    print(
        f"{rate:5.1f} {len(hits):5d} {sum(hit.number > 1 for hit in hits):8d} "
        f"{max(hit.speed for hit in hits):12.3f} {hardest.peak / 1e3:8.1f} {hardest.dynamic_factor:15.2f} "
        f"{hardest.undamped / 1e3:19.1f}"
    )

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, rows = plt.subplots(3, 1, figsize=(8.0, 7.0), sharex=True, layout="constrained")
    for row, (rate, result) in zip(rows, runs.items(), strict=True):
        for i in range(len(FEET)):
            press = result.select("contact_press", contact_point=f"feet.{i + 1}")
            row.plot(result.time, press / 1e3, linewidth=0.9, label=f"foot {i + 1}")
        row.set(ylabel="press [kN]", title=f"lowered at {rate:g} m/s", xlim=(5.0, 35.0))
    figure.legend(*rows[0].get_legend_handles_labels(), ncols=4, loc="outside upper right")
    rows[-1].set(xlabel="time [s]")
    figure.savefig(Path(sys.argv[1]) / "landing.png", dpi=110)
