"""Natural periods of vessel, crane and hanging payload, and their motions in a sea, without a run.

Usage: python frequency_domain.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import cases, linear_model, natural_modes, response_statistics
from seacrane.sea import jonswap

scene = cases.case2(hs=0.0)
linear = linear_model(scene)
print(natural_modes(linear).table())

statistics = {
    body: response_statistics(
        linear, spectrum=jonswap(hs=0.5, tp=11.0), direction=np.radians(180.0), body=body
    )
    for body in ("vessel", "payload")
}
print("\nHs 0.5 m, Tp 11 s, head sea; most probable largest amplitude of three hours")
for body, motion in statistics.items():
    for axis, name in enumerate(("surge", "sway", "heave")):
        significant, largest = motion.significant_double_amplitude[axis], motion.most_probable_largest[axis]
        print(f"{body:8}{name:6} significant double amplitude {significant:6.3f} m, largest {largest:6.3f} m")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (upper, lower) = plt.subplots(2, sharex=True)
    for body, motion in statistics.items():
        upper.semilogy(motion.omega, np.abs(motion.rao[:, 0]), label=f"{body} surge")
        lower.semilogy(motion.omega, np.abs(motion.rao[:, 2]), label=f"{body} heave")
    for axes in (upper, lower):
        axes.set(ylabel="[m/m]", ylim=(1e-3, None))
        axes.legend()
    lower.set(xlabel="frequency [rad/s]", xlim=(0.3, 2.0))
    figure.savefig(Path(sys.argv[1]) / "frequency_domain.png", bbox_inches="tight")
