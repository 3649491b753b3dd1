"""Lift 50 t off a feeder barge that moves by its RAOs, with a fixed crane: lift-off and its peak."""

import numpy as np

from seacrane import MotionRaos, Scene, Stage, Until, simulate

MASS, EA, RATE, LATE, DECK, SLACK = 50e3, 2e8, 0.4, 0.7, 3.0, 0.25  # kg, N, m/s, s by ramp and lag, m, m
OMEGA = [0.3, 0.5, 0.7, 0.9, 1.1, 1.4, 1.8, 2.4]  # rad/s
HEAVE = [0.98, 0.92, 0.80, 0.60, 0.38, 0.15, 0.02, 0.0]  # m/m in head waves, in phase with them
raos = MotionRaos(omega=OMEGA, heading=[np.pi], values=np.outer(HEAVE, [0, 0, 1, 0, 0, 0])[None])

scene = Scene(name="feeder lift")
scene.add_crane(base="ground", foot=(0.0, 0.0, 12.0), s1=2.0, s2=1.0, held=True)
x, y, _ = scene.place_of("tip")
scene.add_vessel(motion=raos, name="barge", position=(x, y, 0.0))
scene.add_sea(vessel="barge", hs=1.5, tp=8.0, direction_deg=180.0, seed=2)
scene.add_hoist(mass=MASS, size=(6, 4, 4), on="barge", height=DECK, EA=EA, slack=SLACK, winch={"lag": 0.2})
lift = Stage(
    name="lift", until=Until.release("load on barge"), maximum_duration=60.0, commands={"hoist.rate": -RATE}
)
stages = [Stage(name="wait", duration=30.0), lift, Stage(name="raised", duration=30.0)]
result = simulate(scene, stages, dt_out=0.02)

at = np.searchsorted(result.time, result.stages[1].end)
heave, rise = (result.select(name, body="barge", axis="z") for name in ("position", "velocity"))
hook, k = result["line_tension"][:, 0], EA / result["line_unstretched_length"][at, 0]
weight, push = MASS * scene.gravity, MASS * np.gradient(rise, result.time)[at]
snap = np.hypot(push, (RATE - rise[at]) * np.sqrt(k * MASS))
for name, run, by_hand in (
    ("lift-off after, s", result.time[at] - 30.0, (SLACK + (weight + push) / k + heave[at]) / RATE + LATE),
    ("hook load at lift-off, kN", hook[at] / 1e3, (weight + push) / 1e3),
    ("largest hook load, kN", hook.max() / 1e3, (weight + snap) / 1e3),
):
    print(f"{name:26} {run:7.2f}, by hand {by_hand:7.2f}")
