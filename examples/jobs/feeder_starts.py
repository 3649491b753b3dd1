"""Lift 50 t off a feeder barge at 200 times in 20 seas: how the peak of the hook load is distributed."""

import sys

import numpy as np

from seacrane import MotionRaos, Scene, Stage, Until, ensemble

MASS, EA, RATE = 50e3, 2e8, 0.4  # kg, N, m/s
OMEGA = [0.3, 0.5, 0.7, 0.9, 1.1, 1.4, 1.8, 2.4]  # rad/s
HEAVE = [0.98, 0.92, 0.80, 0.60, 0.38, 0.15, 0.02, 0.0]  # m/m in head waves, in phase with them
raos = MotionRaos(omega=OMEGA, heading=[np.pi], values=np.outer(HEAVE, [0, 0, 1, 0, 0, 0])[None])

scene = Scene(name="feeder lifts")
scene.add_crane(base="ground", foot=(0.0, 0.0, 12.0), s1=2.0, s2=1.0, held=True)
x, y, _ = scene.place_of("tip")
scene.add_vessel(motion=raos, name="barge", position=(x, y, 0.0), duration=800.0)
scene.add_sea(vessel="barge", hs=1.5, tp=8.0, direction_deg=180.0)
scene.add_hoist(mass=MASS, size=(6, 4, 4), on="barge", height=3.0, EA=EA, slack=1.5, winch={"lag": 0.2})
raised = Until.release("load on barge")
lift = Stage(name="lift", until=raised, maximum_duration=60.0, commands={"hoist.rate": -RATE})


def by_hand(result):
    """Weight, and what a mass on a spring takes of the speed and the push of the deck at lift-off, N."""
    at = np.searchsorted(result.time, result.stages[0].end)
    k, rise = EA / result["line_unstretched_length"][at, 0], result.select("velocity", body="barge", axis="z")
    push, speed = MASS * np.gradient(rise, result.time)[at], RATE - rise[at]
    return MASS * scene.gravity + np.hypot(push, speed * np.sqrt(k * MASS))


lifts = ensemble(
    scene, stages=[lift, Stage(name="raised", duration=5.0)], dt_out=0.05,
    over={"seed": range(20), "start_time": np.arange(60.0, 660.0, 60.0)},
    keep={"peak": "hook_load.max", "by_hand": by_hand}, store=sys.argv[1] if sys.argv[1:] else None,
)  # fmt: skip
print(lifts.distribution("peak"))
off = abs(lifts.dataset.peak / lifts.dataset.by_hand - 1.0)
print(
    f"each peak is within {float(off.max()):.1%} of its own by hand and half within {float(off.median()):.1%}"
)
