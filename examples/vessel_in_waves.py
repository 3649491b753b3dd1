"""A vessel alone in a sea from ahead and port: how much it moves in each of its six motions.

Usage: python vessel_in_waves.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import cases, simulate

scene = cases.vessel(hs=2.0, tp=8.0, wave_direction_deg=135.0, seed=1)
result = simulate(scene, t_end=300.0, dt_out=0.5)

motion = result["vessel_motion"].copy()
motion[:, 3:] = np.degrees(motion[:, 3:])
print(f"realised Hs {result.stats['realised_hs']:.2f} m, {result.stats['wave_components']} components")
for name, values in zip(result.coords["motion"], motion.T, strict=True):
    unit = "m" if name in ("surge", "sway", "heave") else "deg"
    print(f"{name:6} standard deviation {values[100:].std():7.3f} {unit}")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (upper, lower) = plt.subplots(2, sharex=True)
    upper.plot(result.time, motion[:, :3], label=result.coords["motion"][:3])
    lower.plot(result.time, motion[:, 3:], label=result.coords["motion"][3:])
    upper.set(ylabel="[m]")
    lower.set(xlabel="time [s]", ylabel="[deg]")
    for axes in (upper, lower):
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.savefig(Path(sys.argv[1]) / "vessel_in_waves.png", bbox_inches="tight")
