"""Peak of a lift-off over wire, mass, crane and speed, in 200 lifts: which of them matters?"""

import numpy as np

from seacrane import Scene, ensemble
from seacrane.ensembles import LatinHypercube

ROPE, TIP, SLACK = 30.0, 20e3, 0.05  # m, kg of the crane's tip, m
RANGES = {
    "ea": (1e8, 6e8),
    "mass": (20e3, 60e3),
    "crane": (1e7, 2e8),
    "speed": (0.05, 0.8),
}  # N, kg, N/m, m/s


def lift(*, ea: float, mass: float, crane: float, speed: float) -> Scene:
    """A load on a quay below a tip on a spring, and a winch that takes up its slack."""
    scene = Scene(name="lift-off")
    scene.add_body(name="tip", mass=TIP, inertia=(1e4, 1e4, 1e4), position=(0, 0, ROPE), gravity=False)
    scene.add_joint(kind="prismatic", name="boom", first="ground", second="tip", axis=(0, 0, 1))
    scene.add_actuator(joint="boom", stiffness=crane, damping=0.04 * np.sqrt(crane * TIP))
    scene.add_body(name="load", mass=mass, inertia=(5e4, 5e4, 5e4))
    scene.add_joint(kind="weld", name="quay", first="ground", second="load")
    scene.add_stop(joint="quay")
    ends = {"bodies": ["tip", "load"], "points": [(0, 0, 0), (0, 0, 0)]}
    scene.add_line(name="hoist", **ends, EA=ea, length=ROPE + SLACK, damping_ratio=0.01)
    scene.add_winch(line="hoist", rate=-speed, lag=0.05)
    return scene


over = LatinHypercube(ranges=RANGES, count=200, seed=1)
study = ensemble(lift, over=over, keep={"peak": "line_tension[hoist].max"}, t_end=6.0, dt_out=0.005)
ea, mass, crane, speed = (study.dataset[name].to_numpy() for name in RANGES)
g = lift(ea=1e8, mass=2e4, crane=1e7, speed=0.1).gravity
factor, k = study.dataset.peak.to_numpy() / (mass * g), 1 / (ROPE / ea + 1 / crane)
by_hand = 1 + speed / g * np.sqrt(k / mass)  # a mass on a spring that is met at a speed
print(f"factors {factor.min():.2f} to {factor.max():.2f}, by hand {by_hand.min():.2f} to {by_hand.max():.2f}")
off = np.median(abs(factor / by_hand - 1))
print(f"half of the {factor.size} lifts are within {off:.1%} of their own by hand")
powers = np.column_stack([np.ones(factor.size), *map(np.log, (ea, mass, crane, speed))])
found, hand = (np.linalg.lstsq(powers, np.log(one - 1), rcond=None)[0][1:] for one in (factor, by_hand))
for name, one, two in zip(RANGES, found, hand, strict=True):
    print(f"factor - 1 goes with {name:5} to the power {one:5.2f}, by hand {two:5.2f}")
